"""What both schemes of lab 11 compose: topology, which meshes are refused, and how to mend them."""
import numpy as np
import pytest
from subdivision_meshes import MOEBIUS, TETRAHEDRON
from triangle_meshes import POLYGONS, each_polygon_mesh

from course.given import mesh
from labkit.checks import assert_equal
from reference import catmull_clark, loop_subdivision, subdivision


@pytest.mark.parametrize("name, expected", [
    ("cube", 2), ("triangles", 0), ("house, open", 1), ("band with a twist", 0)])
def test_euler_characteristic_of_polygons(name, expected):
    """All faces are taken for triangles, or a handle counts once."""
    assert subdivision.euler_characteristic(*POLYGONS[name][1:]) == expected


# --- broken input --------------------------------------------------------------------------------

BROKEN = {
    "three faces at an edge": ([[0, 1, 2], [1, 0, 3], [0, 1, 4]], "the edge between vertices 0 and "
                               "1 has 3 faces: at most two may meet at an edge"),
    "a face twice": ([*TETRAHEDRON, [1, 2, 0]], "the edge between vertices 0 and 1 has 3 faces"),
    "bow tie": ([[0, 1, 2], [0, 3, 4]], "at vertex 0 meet 2 fans of faces that share no edge"),
    "two cones tip to tip": ([[0, 1, 2], [0, 2, 3], [0, 3, 1], [0, 4, 5], [0, 5, 6], [0, 6, 4]],
                             "at vertex 0 meet 2 fans"),
    "a vertex twice": ([[0, 1, 2], [2, 3, 2]], "face 1 names vertex 2 twice"),
    "beyond the vertices": ([[0, 1, 2], [2, 1, 7]], "face 1 names vertex 7, but there are 7"),
    "below 0": ([[0, 1, 2], [2, 1, -1]], "face 1 names vertex -1"),
    "quads": ([[0, 1, 2, 3]], r"faces must be an array \(F, 3\) of integers, F >= 1; got \(1, 4\)"),
    "no faces": (np.zeros((0, 3), int), r"F >= 1; got \(0, 3\)"),
    "one face, no row": ([0, 1, 2], r"\(F, 3\) .* got \(3,\)"),
    "not whole": ([[0.0, 1.0, 2.0]], r"faces must be .* integers, F >= 1; got \(1, 3\) of float64")}


@pytest.mark.parametrize("faces, sentence", BROKEN.values(), ids=BROKEN)
def test_a_broken_mesh_is_refused_in_one_sentence(faces, sentence):
    """A traceback from within NumPy, or a wrong surface."""
    with pytest.raises(ValueError, match=sentence):
        loop_subdivision.loop(np.zeros((7, 3)), faces)
    if "F >= 1" not in sentence and np.ndim(faces) == 2:
        with pytest.raises(ValueError, match=sentence):
            catmull_clark.catmull_clark(np.zeros((7, 3)), np.ravel(faces), np.full(len(faces), 3))


def test_lists_are_arrays_too():
    """A traceback, for a list has no shape."""
    vertices, faces = mesh.icosphere(20)
    new, _ = expected = loop_subdivision.loop(vertices, faces)
    assert_equal(loop_subdivision.loop(vertices.tolist(), faces.tolist()), expected)
    grad = loop_subdivision.loop_backward(new.tolist(), vertices, faces.tolist())
    np.testing.assert_array_equal(grad, loop_subdivision.loop_backward(new, vertices, faces))
    polygons = [part.tolist() for part in POLYGONS["cube"]]
    assert_equal(catmull_clark.catmull_clark(*polygons),
                 catmull_clark.catmull_clark(*POLYGONS["cube"]))
    for matrix in catmull_clark.catmull_clark_matrix, catmull_clark.catmull_clark_limit_matrix:
        np.testing.assert_array_equal(matrix(*polygons[1:], 8).toarray(),
                                      matrix(*POLYGONS["cube"][1:], 8).toarray())


@pytest.mark.parametrize("integer", "bBhHiIqQ")
def test_integers_of_any_type_give_the_same_mesh(integer):
    """Unsigned counts that cannot be summed, or weights of half precision."""
    vertices, corners, counts = POLYGONS["house, open"]
    got = catmull_clark.catmull_clark(vertices, corners.astype(integer), counts.astype(integer))
    assert_equal(got, catmull_clark.catmull_clark(vertices, corners, counts))
    faces = MOEBIUS.astype(integer)
    np.testing.assert_array_equal(loop_subdivision.loop_matrix(faces, 10).toarray(),
                                  loop_subdivision.loop_matrix(MOEBIUS, 10).toarray())


# --- meshes that need a cure ---------------------------------------------------------------------

def test_split_fans_parts_what_touches_in_a_point():
    """A fan that keeps its neighbour's vertex. Faces or their order change. A new gap elsewhere."""
    cones = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [5, 0, 6], [7, 6, 0], [7, 0, 5]])
    corners, origin = subdivision.split_fans(*subdivision.triangles(cones))
    np.testing.assert_array_equal(origin[corners].reshape(-1, 3), cones)
    np.testing.assert_array_equal(np.bincount(origin), [2, 1, 1, 1, 0, 1, 1, 1])
    _, _, is_boundary = subdivision.topology(corners, np.full(6, 3), len(origin))
    assert is_boundary.sum() == 6


@each_polygon_mesh
def test_split_fans_leaves_a_sound_mesh_as_it_is(vertices, corners, counts):
    """Edges are cut, or a vertex comes twice."""
    new, origin = subdivision.split_fans(corners, counts)
    np.testing.assert_array_equal(origin[new], corners)
    np.testing.assert_array_equal(np.sort(origin), np.unique(corners))


def test_split_fans_refuses_what_it_cannot_mend():
    """A face that names a vertex twice becomes another face."""
    with pytest.raises(ValueError, match="face 1 names vertex 2 twice"):
        subdivision.split_fans([0, 1, 2, 2, 3, 2], [3, 3])


def test_the_teapot_in_one_piece():
    """Copies of a vertex are made one, and a fan that touches another in a point gets its own."""
    vertices, faces = mesh.teapot()
    places, place = np.unique(vertices.round(5), axis=0, return_inverse=True)
    welded = place.ravel()[faces]
    with pytest.raises(ValueError, match=r"2 fans of faces .* `split_fans`"):
        loop_subdivision.loop(places, welded)
    corners, origin = subdivision.split_fans(*subdivision.triangles(welded))
    _, _, is_boundary = subdivision.topology(corners, np.full(len(faces), 3), len(origin))
    assert (len(origin), is_boundary.sum()) == (530, 64)
    assert subdivision.euler_characteristic(corners, np.full(len(faces), 3)) == 2
