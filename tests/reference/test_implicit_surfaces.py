"""The reference's whole shapes, volumes, meshes and pictures of lab 15."""
import time

import numpy as np
import pytest
import scipy.sparse

from course.experiments import demo, drawing, fit_volume, representations
from course.given import inputs, mesh
from course.given.gradcheck import gradcheck
from reference import implicit_surfaces, transforms

BALL, BOX = ("sphere", 0.7), ("box", np.array([0.3, 0.5, 0.6]))
SHAPES = {
    "sphere": BALL,
    "box": BOX,
    "torus": ("torus", 0.6, 0.25),
    "moved": ("moved", np.array([0.2, -0.1, 0.3]), BOX),
    "union": ("union", BOX, ("sphere", 0.5)),
    "intersection": ("intersection", BOX, ("sphere", 0.5)),
    "complement": ("intersection", BALL, ("complement", BOX)),
    "smooth union": ("smooth union", 0.3, ("torus", 0.6, 0.2), BOX),
    "wheel": representations.WHEEL,
}
RIPPLED = ("rippled", 0.1, 8.0, BALL)
LIGHT, COLOUR, BACKGROUND = np.array([-0.5, 0.8, 0.6]), np.array([0.8, 0.6, 0.4]), np.full(3, 0.9)


def camera(aspect=1.5):
    """clip_from_world, looking down from the side at what is around the origin."""
    view = transforms.look_at(np.array([1.0, 2.2, 1.4]), np.zeros(3), np.array([0.0, 1.0, 0.0]))
    return transforms.perspective(np.radians(40), aspect, 0.1, 10.0) @ view


def marched(shape, n):
    points, tetrahedra = implicit_surfaces.tetrahedral_grid(n)
    distance = implicit_surfaces.signed_distance(points, shape)
    return implicit_surfaces.marching_tetrahedra(points, distance, tetrahedra)[:2]


def area(vertices, faces):
    a, b, c = vertices[faces.T]
    return np.linalg.norm(np.cross(b - a, c - a), axis=-1).sum() / 2


def volume(vertices, faces):
    a, b, c = vertices[faces.T]
    return (a * np.cross(b, c)).sum() / 6


# --- shapes ------------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", [*SHAPES.values(), RIPPLED], ids=[*SHAPES, "rippled"])
def test_gradients_of_shapes_are_central_differences(shape):
    """A part's gradient goes to another part, or is lost, in a shape of shapes."""
    points = np.random.default_rng(1).uniform(-1, 1, (30, 3))

    def decisions(points, shape):  # which part is nearest, which side of a box
        gradient = implicit_surfaces.signed_distance_backward(np.ones(len(points)), points, shape)
        return np.abs(gradient) > 1e-12

    gradcheck(implicit_surfaces.signed_distance, implicit_surfaces.signed_distance_backward,
              (points, shape), differentiable=[0], decisions=decisions, name="signed_distance")


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
def test_every_shape_is_lipschitz(shape):
    """Two points differ in distance by more than they are apart: sphere tracing then misses."""
    rng = np.random.default_rng(2)
    p = rng.uniform(-1.5, 1.5, (4000, 3))
    q = p + rng.normal(size=p.shape) * rng.choice([1e-3, 0.1, 1.0], (4000, 1))
    at_p, at_q = (implicit_surfaces.signed_distance(points, shape) for points in (p, q))
    change = at_p - at_q
    assert (np.abs(change) <= np.linalg.norm(p - q, axis=-1) * (1 + 1e-9)).all()


def test_ripples_need_a_larger_constant():
    """The bound that is told for them, 1 + height * frequency, is too small, or far too large."""
    rng = np.random.default_rng(3)
    points = rng.uniform(-1, 1, (50_000, 3))
    slope = implicit_surfaces.signed_distance_backward(np.ones(len(points)), points, RIPPLED)
    steepest = np.linalg.norm(slope, axis=-1).max()
    assert 1.6 < steepest <= 1.8


def test_outside_the_union_is_exact_and_the_intersection_a_bound():
    """What the docstring of union promises, and what it does not."""
    rng = np.random.default_rng(4)
    offset = np.array([0.6, 0.0, 0.0])
    pair = ("sphere", 0.5), ("moved", offset, ("sphere", 0.5))
    points = rng.uniform(-2, 2, (2000, 3))
    distance = implicit_surfaces.signed_distance(points, ("union", *pair))
    nearest = np.minimum(*(np.linalg.norm(points - c, axis=1) for c in (0 * offset, offset))) - 0.5
    np.testing.assert_allclose(distance[nearest > 0], nearest[nearest > 0], atol=1e-12)
    corner = np.array([0.3, 3.0, 0.0])  # the lens's rim is at (0.3, 0.4, 0), not below a sphere
    bound = implicit_surfaces.signed_distance(corner, ("intersection", *pair))
    assert bound < np.linalg.norm(corner - [0.3, 0.4, 0.0]) - 0.01


def test_what_is_no_shape_is_told_in_one_sentence():
    """A misspelt shape ends in an error about unpacking."""
    points = np.zeros((2, 3))
    for shape in ("cone", 1.0), ("sphere",), 3.0, ("union", BALL):
        with pytest.raises(ValueError, match="there is no shape"):
            implicit_surfaces.signed_distance(points, shape)
        with pytest.raises(ValueError, match="there is no shape"):
            implicit_surfaces.signed_distance_backward(np.ones(2), points, shape)


# --- rays --------------------------------------------------------------------------------------


def test_rays_go_through_the_centres_of_pixels():
    """Rows from above, half a pixel off, or width and height swapped."""
    origins, directions = implicit_surfaces.camera_rays(camera(), 9, 6)
    np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1)
    for t, depth in (0.0, -1.0), (1.7, None):
        screen = transforms.project(origins + t * directions, camera(), 9, 6)
        row, column = np.indices((6, 9)).reshape(2, -1)
        np.testing.assert_allclose(screen[:, 0], column + 0.5, atol=1e-9)
        np.testing.assert_allclose(screen[:, 1], row + 0.5, atol=1e-9)
        if depth is not None:
            np.testing.assert_allclose(screen[:, 2], depth, atol=1e-9)


def test_a_wrong_lipschitz_constant_loses_the_surface():
    """The failure that the lecture shows does not happen, or the right L does not mend it."""
    origins, directions = implicit_surfaces.camera_rays(camera(), 60, 40)
    truth, _ = implicit_surfaces.sphere_trace(origins, directions, RIPPLED, 9.0, 8.0, most=3000)
    right, _ = implicit_surfaces.sphere_trace(origins, directions, RIPPLED, 9.0, 1.8)
    wrong, _ = implicit_surfaces.sphere_trace(origins, directions, RIPPLED, 9.0, 1.0)
    seen = np.isfinite(truth) & np.isfinite(right)
    assert (np.isfinite(right) == np.isfinite(truth)).mean() > 0.995
    assert np.abs(right[seen] - truth[seen]).max() < 1e-3
    assert (wrong[seen] - truth[seen] > 1e-3).mean() > 0.01


def test_a_volume_of_a_wall_is_a_wall():
    """The Laplace density has another integral than the distance promises: 1/2 at the surface."""
    distance = np.linspace(-1, 1, 20_001)
    density = implicit_surfaces.density_of(distance, 0.05)
    assert (np.diff(density) <= 0).all() and density.max() <= 1 / 0.05
    np.testing.assert_allclose(density[10_000], 0.5 / 0.05)
    outside = density[10_000:].sum() * 1e-4
    np.testing.assert_allclose(outside, 0.5, atol=2e-3)  # the optical depth down to the surface


def test_colours_converge_as_the_samples_get_denser():
    """Quadrature is of another order, or not of the integral: fog between two ends."""
    errors = []
    for count in 16, 32, 64:
        points, spacing = implicit_surfaces.ray_samples(
            np.array([[0.0, 0, 0]]), np.array([[0.0, 0, 1]]), 1.0, 3.0, count)
        z = points[..., 2]
        got = implicit_surfaces.volume_render(z, z[..., None], spacing, np.array([5.0]))[0, 0]
        t = np.linspace(1, 3, 200_001)
        light = np.exp(-(t**2 - 1) / 2)
        truth = np.trapezoid(light * t * t, t) + 5 * light[-1]
        errors.append(abs(got - truth))
    order = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (1.9 < order).all() and (order < 2.1).all()


def test_trilinear_weights_give_linear_functions_back():
    """The order of axes differs from the grid's points, or weights are swapped."""
    n, rng = 5, np.random.default_rng(5)
    points, _ = implicit_surfaces.tetrahedral_grid(n)
    plane = points @ [1.0, 20.0, 300.0] + 4.0
    there = np.concatenate([rng.uniform(-1, 1, (200, 3)), points, [[1.0, 1.0, 1.0]]])
    weights = implicit_surfaces.grid_weights(there, n)
    assert scipy.sparse.issparse(weights) and weights.shape == (len(there), (n + 1)**3)
    np.testing.assert_allclose(weights @ plane, there @ [1.0, 20.0, 300.0] + 4.0, atol=1e-10)
    np.testing.assert_allclose(weights.sum(1), 1)
    beyond = implicit_surfaces.grid_weights(np.array([[1.01, 0, 0], [0, -2, 0]]), n)
    assert abs(beyond).sum() == 0


# --- meshes ------------------------------------------------------------------------------------


@pytest.mark.parametrize("n", [1, 2, 5])
def test_the_grid_fills_the_cube_with_tetrahedra_that_fit(n):
    """Some are turned over, overlap, or meet along crossing diagonals."""
    points, tetrahedra = implicit_surfaces.tetrahedral_grid(n)
    assert points.shape == ((n + 1)**3, 3) and tetrahedra.shape == (6 * n**3, 4)
    a, b, c, d = points[tetrahedra.T]
    volumes = ((b - a) * np.cross(c - a, d - a)).sum(-1) / 6
    np.testing.assert_allclose(volumes, 8 / (6 * n**3))
    triangles = np.sort(tetrahedra[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]].reshape(-1, 3))
    triangles, count = np.unique(triangles, axis=0, return_counts=True)
    on_border = (np.abs(points[triangles].sum(1)) > 3 - 1e-9).any(-1)
    np.testing.assert_array_equal(count, np.where(on_border, 1, 2))


@pytest.mark.parametrize("seed", range(5))
def test_random_fields_give_closed_manifolds_wound_outward(seed):
    """A border, an edge of four faces, two fans at one vertex, or neighbours wound against each
    other: all topologies occur in a field of random signs."""
    n, rng = 9, np.random.default_rng(seed)
    points, tetrahedra = implicit_surfaces.tetrahedral_grid(n)
    distance = rng.normal(size=len(points))
    if seed == 4:
        distance = rng.integers(-1, 2, len(points)).astype(float)  # exactly 0 at a third of them
    border = (np.abs(points) == 1).any(1)
    distance[border] = np.abs(distance[border])
    vertices, faces, _ = implicit_surfaces.marching_tetrahedra(points, distance, tetrahedra)
    inputs.require_mesh(vertices, faces)
    assert_closed_manifold(len(vertices), faces)
    # Each tetrahedron's part of the inside, cut into simplices by the same linear field.
    if seed < 4:
        np.testing.assert_allclose(volume(vertices, faces), inside_volume(points, distance, n),
                                   rtol=0.02)


def assert_closed_manifold(count, faces):
    start, end = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    along, against = (np.sort(a * count + b) for a, b in ((start, end), (end, start)))
    assert (np.diff(along) > 0).all()           # each directed edge once
    np.testing.assert_array_equal(along, against)
    # Around each vertex one fan: faces at it, joined where they share an edge at it.
    corner = np.arange(faces.size)              # corner 3 f + k is that of vertex k of face f
    previous = 3 * (corner // 3) + (corner + 2) % 3
    by_edge = {(int(a), int(b)): int(c) for a, b, c in zip(start, end, corner, strict=True)}
    flat = faces.ravel()
    neighbour = [by_edge[int(flat[v]), int(flat[p])] for v, p in zip(corner, previous, strict=True)]
    graph = scipy.sparse.coo_array((np.ones(len(corner)), (corner, neighbour)),
                                   shape=(len(corner), len(corner)))
    fans, _ = scipy.sparse.csgraph.connected_components(graph, directed=False)
    assert fans == count == len(np.unique(flat))


def inside_volume(points, distance, n, steps=6):
    """The part of the cube where the field, linear in each tetrahedron, is negative: by samples."""
    samples = (np.arange(steps * n) + 0.5) / (steps * n) * 2 - 1
    at = np.stack(np.meshgrid(samples, samples, samples, indexing="ij"), -1).reshape(-1, 3)
    place = (at + 1) * n / 2
    low = np.floor(place).astype(int)
    part = place - low
    order = np.argsort(-part, axis=1)           # the way along which the cube's corners are visited
    s = distance.reshape(n + 1, n + 1, n + 1)
    corner, value = low.copy(), s[tuple(low.T)]
    for k in range(3):
        axis, last = order[:, k], s[tuple(corner.T)]
        corner[np.arange(len(corner)), axis] += 1
        value = value + part[np.arange(len(corner)), axis] * (s[tuple(corner.T)] - last)
    return (value < 0).mean() * 8


@pytest.mark.parametrize(("shape", "true_area", "true_volume"), [
    (("sphere", 0.8), 4 * np.pi * 0.64, 4 / 3 * np.pi * 0.512),
    (("torus", 0.6, 0.25), 4 * np.pi**2 * 0.15, 2 * np.pi**2 * 0.6 * 0.0625),
], ids=["sphere", "torus"])
def test_area_and_volume_converge_with_the_square_of_the_cell(shape, true_area, true_volume):
    """Vertices are not on the surface to second order, as with the middles of edges."""
    meshes = [marched(shape, n) for n in (12, 24, 48)]
    for measure, truth in (area, true_area), (volume, true_volume):
        errors = np.array([abs(measure(*m) / truth - 1) for m in meshes])
        order = np.log2(errors[:-1] / errors[1:])
        assert (1.8 < order).all() and (order < 2.2).all() and errors[-1] < 5e-3


def test_the_wheel_has_five_holes():
    """A spoke or the bore is lost: V - E + F = 2 - 2 genus."""
    vertices, faces = marched(representations.WHEEL, 48)
    assert_closed_manifold(len(vertices), faces)
    assert len(vertices) - len(mesh.edges(faces)[0]) + len(faces) == 2 - 2 * 5


def test_gradients_of_whole_meshes_are_central_differences():
    """A grid point that many edges share gets the gradient of one; or ends are swapped."""
    n, rng = 2, np.random.default_rng(6)
    points, tetrahedra = implicit_surfaces.tetrahedral_grid(n)
    points = points + rng.uniform(-0.1, 0.1, points.shape)
    distance = rng.choice([-1, 1], len(points)) * rng.uniform(0.3, 1, len(points))
    _, _, ends = implicit_surfaces.marching_tetrahedra(points, distance, tetrahedra)

    def forward(points, distance):
        return implicit_surfaces.marching_tetrahedra(points, distance, tetrahedra)[0]

    def backward(grad_vertices, points, distance):
        return implicit_surfaces.marching_tetrahedra_backward(grad_vertices, ends, points, distance)

    gradcheck(forward, backward, (points, distance), decisions=lambda p, s: s < 0, name="marching")


def test_64_cubed_cells_take_half_a_second_at_most():
    """All tetrahedra are worked on, and not only those that the surface crosses."""
    points, tetrahedra = implicit_surfaces.tetrahedral_grid(64)
    distance = implicit_surfaces.signed_distance(points, ("torus", 0.6, 0.25))
    seconds = []
    for _ in range(3):
        start = time.perf_counter()
        vertices, _, ends = implicit_surfaces.marching_tetrahedra(points, distance, tetrahedra)
        implicit_surfaces.marching_tetrahedra_backward(vertices, ends, points, distance)
        seconds.append(time.perf_counter() - start)
    assert min(seconds) <= 0.5


# --- one object, three representations ---------------------------------------------------------


def test_three_representations_are_one_object():
    """A picture is mirrored, shifted by half a pixel, or of another object."""
    given = representations.WHEEL, camera(), 60, 40, LIGHT, COLOUR, BACKGROUND
    traced, evaluations = implicit_surfaces.render_distance(*given)
    meshed = implicit_surfaces.render_mesh(*given, n=48)
    foggy = implicit_surfaces.render_volume(*given, 1.5, 4.0, beta=0.004, count=160)
    assert traced.shape == meshed.shape == foggy.shape == (40, 60, 3)
    assert evaluations.min() >= 1
    for other, mean, limit in (meshed, 0.015, 0.05), (foggy, 0.03, 0.05):
        difference = np.abs(traced - other).max(-1)
        assert difference.mean() < mean
        assert np.median(difference[evaluations > 8]) < limit
    assert np.abs(traced - traced[:, ::-1]).mean() > 0.03  # so that a mirrored one would be told
    assert np.abs(traced - traced[::-1]).mean() > 0.03


def test_a_ball_opens_to_a_ring():
    """The gradient of distances does not change the topology, or leads elsewhere."""
    goal, n = ("torus", 0.55, 0.25), 14
    points, tetrahedra = implicit_surfaces.tetrahedral_grid(n)
    distance, euler = implicit_surfaces.signed_distance(points, ("sphere", 0.85)), []
    for _ in range(150):
        vertices, faces, ends = implicit_surfaces.marching_tetrahedra(points, distance, tetrahedra)
        off = implicit_surfaces.signed_distance(vertices, goal)
        euler.append(len(vertices) - len(mesh.edges(faces)[0]) + len(faces))
        a, b, c = vertices[faces.T]
        push = np.zeros(vertices.shape)
        for corner in faces.T:
            np.add.at(push, corner, np.cross(b - a, c - a) / 6)
        _, grad_distance = implicit_surfaces.marching_tetrahedra_backward(
            off[:, None] * push, ends, points, distance)
        distance = distance - 3 * (n / 2)**2 * grad_distance
    assert (euler[0], euler[-1]) == (2, 0)
    assert np.abs(off).mean() < 0.1 * 2 / n


def test_a_density_grid_is_found_from_pictures():
    """A gradient of the volume, or of its look-ups, leads elsewhere than to what was seen."""
    labs, size = demo.Labs("reference"), 12
    given = fit_volume.saturn_rays(labs, drawing.cameras_around(labs, 16, longitude=0.2), size)
    volume, losses = fit_volume.fit(labs, given, 12, 100, batch=300)
    new = fit_volume.saturn_rays(labs, drawing.cameras_around(labs, 3, longitude=0.7), size)
    picture = fit_volume.seen(labs, new, volume)
    assert np.mean(losses[-10:]) < losses[0] / 15
    assert -10 * np.log10(np.mean((picture - new.colours)**2)) > 20
