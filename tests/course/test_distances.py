"""Distances to triangles and to meshes: course/given/distances.py."""
import itertools

import numpy as np
import pytest

from course.given import distances, mesh


def nearest(p, corners):
    """The nearest point of the hull of corners: the nearest of all hulls of some of them."""
    found = []
    for count in range(1, len(corners) + 1):
        for some in itertools.combinations(corners, count):
            base, sides = some[0], (np.array(some[1:]).reshape(-1, 3) - some[0]).T
            weights = np.linalg.lstsq(sides, p - base, rcond=None)[0]
            if (weights >= 0).all() and weights.sum() <= 1:
                found.append(base + sides @ weights)
    return min(found, key=lambda q: np.linalg.norm(p - q))


def test_it_is_the_nearest_of_all_candidates():
    """Wrong for an obtuse triangle: the nearest side is chosen by a corner or by a sign."""
    rng = np.random.default_rng(0)
    given = rng.normal(size=(150, 3, 3)) * rng.uniform(0.1, 2, (150, 1, 3))
    p = rng.normal(size=(150, 3)) * 1.5
    expected = np.array([nearest(*pair) for pair in zip(p, given, strict=True)])
    np.testing.assert_allclose(distances.closest_on_triangles(p, given), expected, atol=1e-7)


def test_triangles_without_area_are_sides_or_points():
    """NaN, where corners coincide or lie on a line."""
    a, b, c = np.array([[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [3.0, 0.0, 1.0]])
    p = np.array([[2.5, 4, 0], [0.5, 4, 0], [1, 1, 1], [9, 0, 1], [7, 7, 7]])
    given = np.array([[a, b, c], [c, a, b], [a, a, b], [a, c, c], [b, b, b]])
    expected = np.array([[2.5, 0, 1], [0.5, 0, 1], [1, 0, 1], [3, 0, 1], [2, 0, 1]])
    np.testing.assert_allclose(distances.closest_on_triangles(p, given), expected, atol=1e-12)


@pytest.mark.parametrize("order", [*itertools.permutations(range(3))])
def test_a_normal_made_of_rounding_is_none(order):
    """Three corners and a point on one line in space, where the product of two sides is not 0."""
    sliver = np.array([[0.1, 0.2, 0.3], [0.2, 0.4, 0.6], [0.3, 0.6, 0.9]])[list(order)]
    p = np.array([[0.46881270903010036, 0.9376254180602007, 1.4064381270903012]])
    got = distances.closest_on_triangles(p, sliver[None])
    np.testing.assert_allclose(got, [[0.3, 0.6, 0.9]], atol=1e-12)


def test_closest_points_are_the_nearest_of_all_faces():
    """A face is left out of the search, as is easy with long ones: near by its corner only."""
    vertices, faces = mesh.teapot()
    faces = np.concatenate([faces, [[0, 300, 700]]])
    p = np.random.default_rng(3).uniform(-1.2, 1.2, (60, 3)) * vertices.max(0)
    every = [distances.closest_on_triangles(np.broadcast_to(each, (len(faces), 3)),
                                            vertices[faces]) for each in p]
    expected = [np.linalg.norm(found - each, axis=1).min()
                for found, each in zip(every, p, strict=True)]
    got = distances.distance_to_surface(p, vertices, faces)
    np.testing.assert_allclose(got, expected, rtol=1e-12)
    nearest, closest = distances.closest_faces(p, vertices, faces)
    on_face = distances.closest_on_triangles(p, vertices[faces[nearest]])
    np.testing.assert_allclose(np.linalg.norm(on_face - p, axis=1), expected, rtol=1e-12)
    np.testing.assert_array_equal(closest, on_face)


def test_corners_are_their_own_nearest_points():
    """A ball of rounding's size is missed: no face is found at all."""
    for seed in range(200):
        vertices = np.random.default_rng(seed).normal(size=(3, 3))
        got = distances.closest_points(vertices, vertices, np.array([[0, 1, 2]]))
        np.testing.assert_allclose(got, vertices, atol=1e-12)


CORNER = np.array([[0.0, 0, 0], [3, 0, 0], [0, 4, 0], [0, 0, 1]])


def test_samples_lie_evenly_on_the_surface():
    """More points on small faces, or in one corner of each."""
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    points = distances.sample_surface(CORNER, faces, 40000, np.random.default_rng(0))
    first = points[:, 2] == 0
    assert abs(first.mean() - 0.75) < 0.01
    np.testing.assert_allclose(points[first].mean(0), [1, 4 / 3, 0], atol=0.03)
    np.testing.assert_allclose(points[~first].mean(0), [0, 4 / 3, 1 / 3], atol=0.03)


def test_distances_between_surfaces_have_a_side_each():
    """Both ways are one: a face that is missing is not seen from the other mesh."""
    both, one = np.array([[0, 1, 2], [0, 2, 3]]), np.array([[0, 1, 2]])
    assert max(distances.surface_distances(CORNER, one, CORNER, both)) < 1e-12
    mean, greatest = distances.surface_distances(CORNER, both, CORNER, one)
    np.testing.assert_allclose([mean, greatest], [0.25 / 3, 1], rtol=0.05)
