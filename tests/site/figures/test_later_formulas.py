"""The figures of lectures 11 to 17 compute what the reference computes."""
import itertools

import numpy as np

from course.given import ray_casting
from reference import (
    implicit_surfaces,
    lights,
    marching_tetrahedra,
    shadow_mapping,
    simplification,
    transforms,
)

# Lecture 12: the outline that loses points. A quadric of the plane is one of space with z = 0


def in_space(quadrics):
    """The six numbers of quadrics of the plane (N, 6) as the reference's matrices (N, 4, 4)."""
    xx, xy, yy, xd, yd, dd = np.transpose(quadrics)
    none = 0 * xx
    return np.moveaxis(np.array([[xx, xy, none, xd], [xy, yy, none, yd], [none] * 4,
                                 [xd, yd, none, dd]]), -1, 0)


def test_quadrics_and_best_places(call, agrees):
    """The normal points along the line, b has the other sign, or a length is forgotten."""
    a, b, x = np.random.default_rng(12).normal(size=(3, 60, 2))
    quadrics = np.array(call("collapse", "lineQuadric", a, b))
    step, length = b - a, np.linalg.norm(b - a, axis=1)
    n = np.stack([step[:, 1], -step[:, 0]], -1) / length[:, None]
    planes = np.column_stack([n, np.zeros(60), -(n * a).sum(1)])
    wanted = length[:, None, None] * simplification.plane_quadrics(planes)
    np.testing.assert_allclose(in_space(quadrics), wanted, atol=1e-9)
    sums = quadrics[:30] + quadrics[30:]
    a, b, x = (np.insert(part[:30], 2, 0, axis=1) for part in (a, b, x))
    agrees("collapse", "quadricError", simplification.quadric_error(in_space(sums), x),
           sums, x[:, :2])
    found = call("collapse", "bestAnywhere", sums)
    steep = [n for n, place in enumerate(found) if place]
    assert 20 < len(steep) < 30
    best = simplification.best_anywhere(in_space(sums[steep]) + np.diag([0, 0, 1, 0]))
    np.testing.assert_allclose([found[n] for n in steep], best[:, :2], atol=1e-9)
    agrees("collapse", "bestOnSegment",
           simplification.best_on_segment(in_space(sums), a, b)[0][:, :2],
           sums, a[:, :2], b[:, :2])


def test_points_on_straight_lines_go_first(call):
    """An edge at a corner is collapsed, although one on a side costs nothing."""
    square = np.array([(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (4, 3), (4, 4), (2, 4), (0, 4),
                       (0, 2)], float)
    states, = call("collapse", "simplify", [square])
    assert [len(state["points"]) for state in states] == [10, 9, 8]
    for state in states:
        assert {(0, 0), (4, 0), (4, 4), (0, 4)} <= {tuple(np.round(point, 9))
                                                    for point in state["points"]}


# Lecture 14: flatland's (x, y) is (x, 0, y) of the world: the light's x axis then lies in it

SCENE = np.array([[0, 0], [5, 0], [5, 1.8], [5.12, 1.8], [5.12, 0], [12, 0]])
PLACES = np.random.default_rng(14).uniform([0.3, 2.6], [11.7, 4], (20, 2))


def in_world(points, y=0.0):
    return np.insert(np.asarray(points, float), 1, y, axis=-1)


def in_flatland(light):
    return {"position": light.position[::2].tolist(), "c00": light.clip_from_light[0, 0],
            "rotation": light.rotation[::2, ::2].tolist()}


def light_at(place):
    """The reference's light at a place of flatland. Its cone holds the scene's directions, from
    a place so near that the reference refuses the scene.
    """
    to = SCENE - place
    light = lights.point_light(in_world(place),
                               in_world(place + to / np.linalg.norm(to, axis=1)[:, None]))
    angle = 2 * np.arctan(1 / light.clip_from_light[0, 0])
    return light._replace(clip_from_light=transforms.perspective(angle, 1.0, 0.1, 20.0))


def strips():
    """The scene, drawn out along the world's y: vertices (V, 3), faces (F, 3)."""
    n, k = len(SCENE), np.arange(len(SCENE) - 1)
    return (np.concatenate([in_world(SCENE, -3), in_world(SCENE, 3)]),
            np.concatenate([np.stack([k, k + 1, k + n + 1], 1),
                            np.stack([k, k + n + 1, k + n], 1)]))


def test_the_light_and_its_map(call, agrees):
    """The axis is not in the middle of what is seen, or a texel holds the farthest depth."""
    made = [light_at(place) for place in PLACES]
    found = call("flatland_shadow", "pointLight", PLACES, [SCENE] * 20)
    for ours, light in zip(found, made, strict=True):
        for name, value in in_flatland(light).items():
            np.testing.assert_allclose(ours[name], value, atol=1e-9)
    agrees("flatland_shadow", "depthMap",
           [shadow_mapping.depth_map(*strips(), light, 25)[12] for light in made],
           [SCENE] * 20, [in_flatland(light) for light in made], 25)


def test_acne_and_leaks_are_where_the_reference_has_them(call):
    """The truth is the map's, the slope is that of the wall, or a place beside the map is read."""
    x = np.concatenate([np.linspace(0.011, 4.97, 200), np.linspace(5.151, 11.97, 300)])
    ground, up = np.stack([x, 0 * x], 1), np.tile([0.0, 0.0, 1.0], (len(x), 1))
    seen = set()
    for place, bias in itertools.product(PLACES[:6], ((0, 0), (0.15, 0), (0.7, 0), (0.02, 1))):
        light = light_at(place)
        row = shadow_mapping.depth_map(*strips(), light, 18)[9]
        found, = call("flatland_shadow", "shadowOf", [ground], [in_flatland(light)], [row], *bias)
        lit = shadow_mapping.hard_shadow(in_world(ground), up, light, np.tile(row, (18, 1)), *bias)
        truth = ray_casting.ray_cast(in_world(ground), *strips(), light)
        wanted = np.where(lit, np.where(truth, "lit", "leak"), np.where(truth, "acne", "dark"))
        assert [one["kind"] for one in found] == wanted.tolist()
        seen |= set(wanted)
    assert seen == {"lit", "dark", "acne", "leak"}


# Lecture 15: the grid of signs


def test_the_ring_and_the_crossings(agrees):
    """The crossing is nearer to the wrong end, or its gradient has the other's sign."""
    rng = np.random.default_rng(15)
    points = rng.normal(size=(50, 2))
    agrees("sign_grid", "torus",
           implicit_surfaces.torus(np.insert(points, 2, 0, axis=1), 0.7, 0.3), points, 0.7, 0.3)
    p_a, p_b, grad_p = rng.normal(size=(3, 50, 3))
    ends = p_a, p_b, -rng.uniform(0.1, 1, 50), rng.uniform(0, 1, 50)
    agrees("sign_grid", "zeroCrossing", marching_tetrahedra.zero_crossing(*ends), *ends)
    wanted = marching_tetrahedra.zero_crossing_backward(grad_p, *ends)[2:]
    agrees("sign_grid", "zeroCrossingBackward", np.transpose(wanted), grad_p, *ends)


def test_the_outline_is_closed_and_its_areas_gradient_is_that_of_its_area(call):
    """A case of a triangle is turned, or the two segments of a vertex pull in opposite directions.
    """
    def area(points):
        (x, y), (ahead_x, ahead_y) = points[begins].T, points[ends].T
        return ((x * ahead_y - y * ahead_x) / 2).sum()

    grid = np.ones((17, 25))
    grid[1:-1, 1:-1] = np.random.default_rng(3).normal(size=(15, 23))
    found, = call("sign_grid", "marchingTriangles", [grid.ravel()])
    begins, ends = np.transpose(found["segments"])
    points = np.array([vertex["p"] for vertex in found["vertices"]])
    every = np.arange(len(points))
    assert len(points) > 300 and 0 < area(points) < 24 * 16 / 64
    assert (np.sort(begins) == every).all() and (np.sort(ends) == every).all()
    gradient, = call("sign_grid", "areaBackward", [found["vertices"]], [found["segments"]])
    step = np.random.default_rng(4).normal(size=points.shape)
    change = (area(points + 1e-4 * step) - area(points - 1e-4 * step)) / 2e-4
    assert np.isclose((gradient * step).sum(), change, atol=1e-9)
