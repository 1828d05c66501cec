"""The reference's whole search of lab 16: its gradients, its states, and what it finds."""
import numpy as np
import pytest
from found_objects import LABS, photographed, require_follows

from course.given import image, mesh
from course.given.gradcheck import gradcheck
from course.scenes import drawing, fit_triangle, reconstruct, viewing
from reference import marching_tetrahedra, multi_view_fit, reconstruction

BEHIND = np.array([1.0, 0.9, 0.8])


def unknowns(n, seed=0):
    """A Scene on a small grid: an uneven ball, of many colours, in a light from one side."""
    rng = np.random.default_rng(seed)
    x = multi_view_fit.start(n)
    points, _ = marching_tetrahedra.tetrahedral_grid(n)
    lamp = reconstruction.distant_light(np.array([[0.6, 0.8, 0.0]]), np.ones((1, 3)))
    return multi_view_fit.Scene(
        x.distance + 0.15 + 0.1 * np.sin(3 * points).prod(1),
        x.offsets + rng.uniform(-0.1, 0.1, x.offsets.shape) / n,
        rng.uniform(0.2, 0.8, x.albedo.shape), x.light + lamp)


def capture(count=2, size=40):
    """Pictures of a ring that is another shape than the unknowns'."""
    vertices, faces = mesh.torus(400, 0.5, 0.25)
    ring = reconstruct.Painted(vertices, faces, reconstruct.paint(vertices))
    return photographed(ring, reconstruct.daylight(LABS), count, size)._replace(background=BEHIND)


def weights(**chosen):
    """Those that are not named are 0."""
    return multi_view_fit.Weights(0.0, 0.0, 0.0, 0.0)._replace(**chosen)


# --- gradients ---------------------------------------------------------------------------------

@pytest.mark.parametrize("samples", [1, 2])
@pytest.mark.parametrize("which, h", [("distance", 1e-8), ("offsets", 1e-8), ("albedo", 1e-2),
                                      ("light", 1e-2)])
def test_gradients_follow_the_loss(which, h, samples):
    """A way back is missing: through outlines, normals, shading, or the colours that go along.

    In albedo and light the loss is a square. In shape it jumps, where a pixel changes its face.
    """
    x = unknowns(5)
    targets = multi_view_fit.targets_of(capture(), 1, samples)
    part = getattr(x, which)
    used = slice(None) if which == "light" else np.unique(multi_view_fit.surface(x).ends)
    direction = np.zeros(part.shape)
    direction[used] = np.random.default_rng(3).normal(size=part[used].shape)
    require_follows(lambda x: multi_view_fit.loss_and_gradients(x, targets, weights(coverage=1.0)),
                    x, which, direction, h)


def test_sign_changes_count_in_cells():
    """A weight that means another thing on a finer grid."""
    x = unknowns(5)
    found = multi_view_fit.surface(x)
    targets = multi_view_fit.targets_of(capture(1), 1, 1)

    def penalty(distance):
        return reconstruction.sign_changes(distance * 2.5, found.ends)[0] / len(found.vertices)

    def backward(grad_penalty, distance):
        both = [multi_view_fit.loss_and_gradients(x._replace(distance=distance), targets,
                                                  weights(sign_changes=weight))[1].distance
                for weight in (1.0, 0.0)]
        return grad_penalty * (both[0] - both[1])

    gradcheck(penalty, backward, (x.distance,), name="sign changes")


def test_carving_pushes_the_surface_in_where_nothing_should_be_seen():
    """The sign of eq. (6): a ball before an empty picture must shrink, and only where it is seen.
    """
    x, camera = multi_view_fit.start(8), viewing.cameras_around(LABS, 2)[0]
    empty = np.broadcast_to(np.append(BEHIND, 0), (30, 30, 4))
    targets = multi_view_fit.targets_of(multi_view_fit.Capture([empty], [camera], BEHIND), 1, 1)
    grads = [multi_view_fit.loss_and_gradients(x, targets, weights(carving=weight))[1].distance
             for weight in (1.0, 0.0)]
    push, found = grads[0] - grads[1], multi_view_fit.surface(x)
    assert push.max() <= 1e-15 and push.min() < 0
    assert -push.sum() == pytest.approx(
        drawing.seen_mask(LABS, found.vertices, found.faces, camera, 30).mean())
    assert set(np.flatnonzero(push)) <= set(found.ends.ravel())


# --- the state ---------------------------------------------------------------------------------

def test_the_start_is_a_grey_ball():
    """A start that is turned inside out, black, or cut off by the grid."""
    x = multi_view_fit.start(12)
    found = multi_view_fit.surface(x)
    assert reconstruction.genus(found.faces) == (1, 0)
    assert np.abs(np.linalg.norm(found.vertices, axis=1) - 0.85).max() < 0.02
    assert (found.normals * found.vertices).sum(1).min() > 0.7
    np.testing.assert_allclose(reconstruction.shade(found.albedo, found.normals, x.light), 0.5)


def test_all_of_the_surface_is_in_the_crossed_cubes():
    """A cube is left out that has a piece of it."""
    x = unknowns(6)
    points, tetrahedra = marching_tetrahedra.tetrahedral_grid(6)
    found = multi_view_fit.surface(x)
    vertices, faces, ends = marching_tetrahedra.marching_tetrahedra(points + x.offsets, x.distance,
                                                                    tetrahedra)
    np.testing.assert_array_equal(found.vertices, vertices)
    np.testing.assert_array_equal(found.ends, ends)
    assert sorted(map(tuple, found.faces)) == sorted(map(tuple, faces))


def test_no_offset_that_is_allowed_turns_a_tetrahedron_over():
    """A surface that goes through itself."""
    points, tetrahedra = marching_tetrahedra.tetrahedral_grid(4)
    for seed in range(20):
        offsets = np.random.default_rng(seed).choice([-9.0, 9.0], points.shape)
        x = multi_view_fit.bounded(multi_view_fit.Scene(points[:, 0], offsets, 0 * points,
                                                        np.zeros((9, 3))))
        a, b, c, d = (points + x.offsets)[tetrahedra].swapaxes(0, 1)
        assert (np.cross(b - a, c - a) * (d - a)).sum(1).min() > 0


def test_what_is_not_allowed_is_put_right():
    """A surface that is open at the grid's border, or an albedo above 1."""
    ball = multi_view_fit.start(4)
    x = multi_view_fit.bounded(ball._replace(distance=ball.distance - 9,
                                             albedo=3 * ball.albedo - 0.7, light=ball.light - 5))
    assert reconstruction.genus(multi_view_fit.surface(x).faces) == (1, 0)
    assert x.albedo.max() <= 1 and (x.light == ball.light - 5).all()


def test_a_finer_grid_holds_the_same():
    """Axes are swapped on the way to another grid, or light is lost."""
    x = unknowns(8)
    fine = multi_view_fit.refine(x, 16)
    points, _ = marching_tetrahedra.tetrahedral_grid(16)
    coarse = (np.round(points * 4) == points * 4).all(1)
    np.testing.assert_allclose(fine.distance[coarse], x.distance)
    np.testing.assert_allclose(fine.albedo[coarse], x.albedo)
    assert (fine.offsets == 0).all() and fine.light is x.light


def test_a_run_is_reproducible_from_its_seed():
    """Views come in another order each time."""
    given = capture(5)

    def run(seed):
        stages = multi_view_fit.Stage(4, 2, 1, 2, 1.0), multi_view_fit.Stage(6, 1, 2, 2, 0.5)
        return list(multi_view_fit.fit(given, stages, seed, per_step=2))

    first, again, other = run(1), run(1), run(2)
    assert [multi_view_fit.cells(x) for x, _ in first] == [4, 4, 6, 6]
    for (x, loss), (same, same_loss) in zip(first, again, strict=True):
        assert loss == same_loss and all((a == b).all() for a, b in zip(x, same, strict=True))
    assert first[-1][1] != other[-1][1]


def test_a_hole_opens():
    """The search finds no topology: a ring stays a ball."""
    stages = multi_view_fit.Stage(12, 1, 1, 70, 1.0), multi_view_fit.Stage(16, 1, 1, 15, 0.5)
    course = list(reconstruct.fit(LABS, "ring", stages, size=48, count=10))
    x, loss = course[-1]
    assert reconstruction.genus(multi_view_fit.surface(x).faces) == (1, 1)
    assert loss < 0.05 * course[0][1]


def test_without_edges_outlines_have_no_gradient():
    """The ablation leaves a way for outlines open."""
    vertices, faces = mesh.icosphere(80)
    renderer = fit_triangle.without_edges(LABS)
    scene = (LABS.pipeline.make_mesh(vertices, faces),
             LABS.pipeline.Colours(np.ones((len(vertices), 1))),
             LABS.pipeline.View(viewing.cameras_around(LABS, 1)[0], 20, 20, np.zeros(1)))
    picture, buffers = renderer.render(*scene)
    assert set(np.unique(picture.round(9))) == {0, 1}
    upstream = np.random.default_rng(0).normal(size=picture.shape)
    grads = renderer.render_backward(upstream, buffers, *scene)
    assert np.abs(grads.positions).max() < 1e-12 and np.abs(grads.material.colours).max() > 0.1


def test_decibels_on_paper():
    """A mean of decibels, or pictures that nobody sees."""
    truth = [np.zeros((2, 2, 4)), np.zeros((2, 2, 4))]
    found = [truth[0], truth[1] + image.to_linear(0.2)]
    assert reconstruct.decibels(found, truth) == pytest.approx(-10 * np.log10(0.02))
