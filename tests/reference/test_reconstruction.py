"""The reference's whole search of lab 16, and what goes in and out: folders, GLB, OBJ."""
import io
import json

import numpy as np
import pytest
import trimesh

from course import cli
from course.experiments import captures, demo, drawing, fit_triangle, reconstruct
from course.given import image, mesh, mesh_files
from course.given.gradcheck import gradcheck
from reference import implicit_surfaces, reconstruction

LABS = demo.Labs("reference")
EYE = LABS.pipeline.render, LABS.pipeline.render_backward
BEHIND = np.array([1.0, 0.9, 0.8, 0.0])


def unknowns(n, seed=0):
    """x on a small grid: an uneven ball, of many colours, in a light from one side."""
    rng = np.random.default_rng(seed)
    distance, offsets, albedo, light = reconstruction.start(n)
    points, _ = implicit_surfaces.tetrahedral_grid(n)
    distance = distance + 0.15 + 0.1 * np.sin(3 * points).prod(1)
    light = light + reconstruction.distant_light(np.array([[0.6, 0.8, 0.0]]), np.ones((1, 3)))
    return (distance, offsets + rng.uniform(-0.1, 0.1, offsets.shape) / n,
            rng.uniform(0.2, 0.8, albedo.shape), light)


def views(count=2, size=40):
    """Pictures of a ring that is another shape than x."""
    vertices, faces = mesh.torus(400, 0.5, 0.25)
    cameras = drawing.cameras_around(LABS, count)
    ring = reconstruct.Painted(vertices, faces, reconstruct.paint(vertices))
    pictures = reconstruct.photographs(LABS, ring, reconstruct.daylight(LABS), cameras, size)
    return [(camera, picture, reconstruction.is_outside(picture))
            for camera, picture in zip(cameras, pictures, strict=True)]


# --- gradients ---------------------------------------------------------------------------------

@pytest.mark.parametrize("samples", [1, 2])
@pytest.mark.parametrize("which, h", [(0, 1e-8), (1, 1e-8), (2, 1e-2), (3, 1e-2)],
                         ids=["distance", "offsets", "albedo", "light"])
def test_gradients_follow_the_loss(which, h, samples):
    """A way back is missing: through outlines, normals, shading, or the colours that go along.

    The loss is a square in albedo and light; but of shape, it jumps where a pixel changes its face.
    """
    x, seen = unknowns(5), views()
    used = np.unique(reconstruction.surface(x)[2]) if which < 3 else slice(None)
    direction = np.zeros(x[which].shape)
    direction[used] = np.random.default_rng(3).normal(size=x[which][used].shape)

    def at(h):
        moved = *x[:which], x[which] + h * direction, *x[which + 1:]
        return reconstruction.loss_and_gradients(moved, seen, samples, BEHIND, (1, 0, 0, 0), EYE)

    numeric = (at(h)[0] - at(-h)[0]) / (2 * h)
    assert (at(0)[1][which] * direction).sum() == pytest.approx(numeric, rel=1e-5)


def test_sign_changes_count_in_cells():
    """A weight that means another thing on a finer grid."""
    x = unknowns(5)
    vertices, _, ends, *_ = reconstruction.surface(x)

    def penalty(distance):
        return reconstruction.sign_changes(distance * 2.5, ends) / len(vertices)

    def backward(grad_penalty, distance):
        given = (distance, *x[1:]), views(1), 1, BEHIND
        both = [reconstruction.loss_and_gradients(*given, (0, 0, weight, 0), EYE)[1][0]
                for weight in (1.0, 0.0)]
        return grad_penalty * (both[0] - both[1])

    gradcheck(penalty, backward, (x[0],), name="sign changes")


def test_bumps_are_central_differences_where_normals_are_held():
    """A transposed Laplacian, or a mean for a sum."""
    vertices, faces = mesh.icosphere(80)
    normals, edges = mesh.vertex_normals(vertices, faces), mesh.edges(faces)[0]
    vertices = vertices + np.random.default_rng(0).normal(scale=0.1, size=vertices.shape)
    gradcheck(lambda vertices: np.array(reconstruction.bumps(vertices, normals, edges)),
              lambda grad, vertices: reconstruction.bumps_backward(grad, vertices, normals, edges),
              (vertices,), name="bumps")


def test_vertices_that_lie_unevenly_in_a_plane_are_no_bumps():
    """A penalty that pulls vertices about within the surface."""
    vertices, faces = mesh.grid(50)
    vertices[:, :2] += np.random.default_rng(0).uniform(-0.3, 0.3, (len(vertices), 2))
    normals = np.tile([0.0, 0.0, 1.0], (len(vertices), 1))
    assert reconstruction.bumps(vertices, normals, mesh.edges(faces)[0]) == 0


def test_carving_pushes_the_surface_in_where_nothing_should_be_seen():
    """The sign of eq. (6): a ball before an empty picture must shrink, and only where it is seen.
    """
    x, camera = reconstruction.start(8), drawing.cameras_around(LABS, 2)[0]
    empty = np.broadcast_to(BEHIND, (30, 30, 4))
    view = camera, empty, np.ones((30, 30), bool)
    given = x, [view], 1, BEHIND
    grads = [reconstruction.loss_and_gradients(*given, (0, weight, 0, 0), EYE)[1][0]
             for weight in (1.0, 0.0)]
    push, ends = grads[0] - grads[1], reconstruction.surface(x)[2]
    assert push.max() <= 1e-15 and push.min() < 0
    assert -push.sum() == pytest.approx((drawing.seen_mask(LABS, *reconstruction.surface(x)[:2],
                                                        camera, 30)).mean())
    assert set(np.flatnonzero(push)) <= set(ends.ravel())


# --- the state ---------------------------------------------------------------------------------

def test_the_start_is_a_grey_ball():
    """A start that is turned inside out, black, or cut off by the grid."""
    x = reconstruction.start(12)
    vertices, faces, _, normals, albedo = reconstruction.surface(x)
    assert reconstruction.genus(faces) == (1, 0)
    assert np.abs(np.linalg.norm(vertices, axis=1) - 0.85).max() < 0.02
    assert (normals * vertices).sum(1).min() > 0.7
    np.testing.assert_allclose(reconstruction.shade(albedo, normals, x[3]), 0.5)


def test_all_of_the_surface_is_in_the_crossed_cubes():
    """A cube is left out that has a piece of it."""
    x = unknowns(6)
    points, tetrahedra = implicit_surfaces.tetrahedral_grid(6)
    vertices, faces, ends, *_ = reconstruction.surface(x)
    expected = implicit_surfaces.marching_tetrahedra(points + x[1], x[0], tetrahedra)
    for got, whole in zip((vertices, ends), (expected[0], expected[2]), strict=True):
        np.testing.assert_array_equal(got, whole)
    assert sorted(map(tuple, faces)) == sorted(map(tuple, expected[1]))


def test_no_offset_that_is_allowed_turns_a_tetrahedron_over():
    """A surface that goes through itself."""
    points, tetrahedra = implicit_surfaces.tetrahedral_grid(4)
    for seed in range(20):
        offsets = np.random.default_rng(seed).choice([-9.0, 9.0], points.shape)
        x = reconstruction.bounded((points[:, 0], offsets, 0 * points, np.zeros((9, 3))))
        a, b, c, d = (points + x[1])[tetrahedra].swapaxes(0, 1)
        assert (np.cross(b - a, c - a) * (d - a)).sum(1).min() > 0


def test_what_is_not_allowed_is_put_right():
    """A surface that is open at the grid's border, or an albedo above 1."""
    distance, offsets, albedo, light = reconstruction.start(4)
    x = reconstruction.bounded((distance - 9, offsets, 3 * albedo - 0.7, light - 5))
    assert reconstruction.genus(reconstruction.surface(x)[1]) == (1, 0)
    assert x[2].max() <= 1 and (x[3] == light - 5).all()


def test_a_finer_grid_holds_the_same():
    """Axes are swapped on the way to another grid, or light is lost."""
    x = unknowns(8)
    distance, offsets, albedo, light = reconstruction.refine(x, 16)
    points, _ = implicit_surfaces.tetrahedral_grid(16)
    coarse = (np.round(points * 4) == points * 4).all(1)
    np.testing.assert_allclose(distance[coarse], x[0])
    np.testing.assert_allclose(albedo[coarse], x[2])
    assert (offsets == 0).all() and light is x[3]


def test_a_run_is_reproducible_from_its_seed():
    """Views come in another order each time."""
    pictures, cameras = zip(*[(picture, camera) for camera, picture, _ in views(5)], strict=True)

    def run(seed):
        stages = (4, 2, 1, 2, 1.0), (6, 1, 2, 2, 0.5)
        return list(reconstruction.fit(pictures, cameras, BEHIND[:3], stages, seed, per_step=2))

    first, again, other = run(1), run(1), run(2)
    assert [n for n, *_ in first] == [4, 4, 6, 6]
    for (_, loss, x), (_, same_loss, same) in zip(first, again, strict=True):
        assert loss == same_loss and all((a == b).all() for a, b in zip(x, same, strict=True))
    assert first[-1][1] != other[-1][1]


def test_a_hole_opens():
    """The search finds no topology: a ring stays a ball."""
    stages = (12, 1, 1, 50, 1.0), (16, 1, 1, 15, 0.5)
    course = list(reconstruct.fit(LABS, "ring", stages, size=48, count=10))
    _, loss, x = course[-1]
    assert reconstruction.genus(reconstruction.surface(x)[1]) == (1, 1)
    assert loss < 0.2 * course[0][1]


def test_without_edges_outlines_have_no_gradient():
    """The ablation leaves a way for outlines open."""
    vertices, faces = mesh.icosphere(80)
    render, render_backward = fit_triangle.without_edges(LABS)
    scene = (LABS.pipeline.make_mesh(vertices, faces),
             LABS.pipeline.Colours(np.ones((len(vertices), 1))),
             LABS.pipeline.View(drawing.cameras_around(LABS, 1)[0], 20, 20, np.zeros(1)))
    picture, buffers = render(*scene)
    assert set(np.unique(picture.round(9))) == {0, 1}
    upstream = np.random.default_rng(0).normal(size=picture.shape)
    grads = render_backward(upstream, buffers, *scene)
    assert np.abs(grads.positions).max() < 1e-12 and np.abs(grads.surface.colours).max() > 0.1


def test_decibels_on_paper():
    """A mean of decibels, or pictures that nobody sees."""
    truth = [np.zeros((2, 2, 4)), np.zeros((2, 2, 4))]
    found = [truth[0], truth[1] + image.to_linear(0.2)]
    assert reconstruct.decibels(found, truth) == pytest.approx(-10 * np.log10(0.02))


# --- what goes out -----------------------------------------------------------------------------

def test_glb_and_obj_hold_the_mesh_and_its_colours(tmp_path):
    """A file that no viewer opens, or with the colours of other vertices."""
    x = unknowns(5)
    place = np.diag([2.0, 2.0, 2.0, 1.0])
    place[:3, 3] = 1.0, 2.0, 3.0
    captures.save(LABS, x, tmp_path / "found.glb", place)
    vertices, faces, _, _, albedo = reconstruction.surface(x)
    vertices = 2 * vertices + [1, 2, 3]
    scene = trimesh.load(io.BytesIO((tmp_path / "found.glb").read_bytes()), file_type="glb",
                         process=False)
    (found,) = scene.geometry.values()
    np.testing.assert_allclose(found.vertices, vertices, atol=1e-6)
    np.testing.assert_array_equal(found.faces, faces)
    np.testing.assert_allclose(found.visual.vertex_attributes["color"][:, :3] / 255, albedo,
                               atol=0.003)
    again = mesh_files.read(tmp_path / "found.obj")
    np.testing.assert_allclose(again[0], vertices, atol=1e-5)
    np.testing.assert_array_equal(again[1], faces)
    first = (tmp_path / "found.obj").read_text().splitlines()[0].split()
    np.testing.assert_allclose(np.array(first[4:], float), image.to_srgb(albedo[0]), atol=0.003)


def test_after_ctrl_c_the_last_good_mesh_is_on_disk(tmp_path):
    """Minutes of work are lost."""
    def stopped():
        yield 5, 0.1, unknowns(5)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        list(captures.watched(LABS, stopped(), 9, tmp_path / "found.glb"))
    assert len(mesh_files.read(tmp_path / "found.obj")[1]) > 50
    assert (tmp_path / "found.glb").read_bytes()[:4] == b"glTF"


def test_a_search_that_came_to_nothing_says_so(tmp_path):
    """An empty mesh, or nan, takes the place of a good one."""
    good, empty = unknowns(5), (np.ones(216), *unknowns(5)[1:])
    for loss, x in (np.nan, good), (0.1, empty):
        with pytest.raises(ValueError, match="came to nothing at step 2: are the cameras right"):
            list(captures.watched(LABS, iter([(5, 0.1, good), (5, loss, x)]), 9,
                                  tmp_path / "found.glb"))
        assert len(mesh_files.read(tmp_path / "found.obj")[1]) > 50


# --- what comes in -----------------------------------------------------------------------------

@pytest.fixture
def folder(tmp_path):
    """Two pictures, 24 x 16 pixels, of a ring at (1, 2, 3), and their cameras."""
    vertices, faces = mesh.torus(400, 0.5, 0.25)
    views = []
    for k, side in enumerate(([0.0, 0.0, 4.0], [4.0, 1.0, 0.0])):
        centre = np.array([1.0, 2.0, 3.0])
        view = LABS.transforms.look_at(centre + side, centre, np.array([0.0, 1.0, 0.0]))
        camera = LABS.transforms.perspective(np.radians(30), 1.5, 0.5, 10.0) @ view
        seen = drawing.seen_mask(LABS, vertices + centre, faces, camera, 24)[::1, :]
        picture = np.dstack([np.full((24, 24, 3), 0.5), seen])[4:20]
        image.write(tmp_path / f"{k}.png", picture)
        views.append({"picture": f"{k}.png", "world_from_camera": np.linalg.inv(view).tolist()})
    scene = {"fov_y": 30.0, "centre": [1, 2, 3], "radius": 0.8, "views": views}
    (tmp_path / "cameras.json").write_text(json.dumps(scene))
    return tmp_path


def changed(folder, **changes):
    scene = json.loads((folder / "cameras.json").read_text())
    (folder / "cameras.json").write_text(json.dumps({**scene, **changes}))
    return folder


def test_a_folder_on_paper(folder):
    """The ball's centre is not the grid's, or the aspect is turned over."""
    pictures, cameras, background, world_from_grid = captures.read(LABS, folder)
    assert [picture.shape for picture in pictures] == [(16, 24, 4)] * 2
    assert (background == 1).all()
    np.testing.assert_allclose(world_from_grid @ [0, 0.5, 0, 1], [1, 2.4, 3, 1])
    clip = cameras[0] @ [0.5, -1.0, 0.0, 1.0]  # 0.4 right, 0.8 down, 4 away
    high = 4 * np.tan(np.radians(15))
    np.testing.assert_allclose(clip[:2] / clip[3], [0.4 / (1.5 * high), -0.8 / high])
    assert abs(clip[2]) < clip[3]
    outside = pictures[0][..., 3] == 0
    np.testing.assert_allclose(pictures[0][outside][:, :3], 1)
    np.testing.assert_allclose(pictures[0][~outside][:, :3], image.to_linear(128 / 255))


def test_opaque_pictures_have_silhouettes_by_their_background(folder):
    """The background is taken for the object."""
    for k in 0, 1:
        picture = image.read(folder / f"{k}.png")
        image.write(folder / f"{k}.png", np.where(picture[..., 3:] > 0, picture[..., :3], 0.2))
    changed(folder, background=[51, 51, 51])
    pictures, _, background, _ = captures.read(LABS, folder)
    np.testing.assert_allclose(background, image.to_linear(0.2))
    grey = np.abs(pictures[0][..., :3] - background).max(2) > 0.01
    np.testing.assert_array_equal(pictures[0][..., 3] == 1, grey)


def test_large_pictures_are_made_smaller():
    """Pixels are dropped instead of averaged, or the shape changes."""
    picture = np.random.default_rng(0).uniform(size=(300, 512, 4))
    found = captures.smaller(picture)
    assert found.shape == (76, 128, 4)
    np.testing.assert_allclose(found.mean((0, 1)), picture.mean((0, 1)), atol=1e-3)


MATRIX = np.eye(4)
MATRIX[2, 3] = 5.0


def one_view(matrix):
    return [{"picture": "0.png", "world_from_camera": np.asarray(matrix).tolist()}] * 2


@pytest.mark.parametrize("changes, sentence", [
    ({"fov_y": "wide"}, "fov_y in cameras.json must be a finite number, and is wide"),
    ({"fov_y": 190}, "fov_y in cameras.json must be from 1 to 170, and is 190"),
    ({"radius": -1}, "radius in cameras.json must be from 1e-09 to 1e"),
    ({"centre": [1, 2]}, "centre in cameras.json must be 3 finite numbers"),
    ({"views": 7}, "cameras.json must be"),
    ({"views": []}, "at least 2 views are needed"),
    ({"views": [{}, {}]}, 'view 0 in cameras.json needs a "picture"'),
    ({"views": [{"picture": "0.png"}] * 2}, 'view 0 (0.png) in cameras.json needs a "world_from_'),
    ({"views": one_view(np.eye(3))}, "world_from_camera of 0.png in cameras.json must be 4 x 4"),
    ({"views": one_view(MATRIX.T)}, "must have 0, 0, 0, 1 as its last row"),
    ({"views": one_view(MATRIX * [2, 2, 2, 1])}, "must be a rotation and a shift"),
    ({"views": one_view(MATRIX * [-1, 1, 1, 1])}, "is mirrored"),
    ({"centre": [0, 0, 4.5], "views": one_view(MATRIX)}, "stands within the ball"),
    ({"centre": [0, 0, 9], "views": one_view(MATRIX)}, "does not see the object's centre"),
    ({"centre": [0, 3, 0], "views": one_view(MATRIX)}, "does not see the object's centre"),
    ({"fov_y": None}, "must be a finite number, and is missing"),
    ({"fov_y": True}, "must be a finite number, and is True"),
    ({"fov_y": 10**400}, "must be a finite number, and is 1000"),
    ({"background": [300, 0, 0]}, "three numbers from 0 to 255"),
    ({"views": [{"picture": "a\0.png", "world_from_camera": MATRIX.tolist()}] * 2},
     "no file can have such a name"),
    ({"views": [{"picture": "9.png", "world_from_camera": MATRIX.tolist()}] * 2}, "there is no"),
])
def test_what_is_wrong_with_cameras_is_told_in_one_sentence(folder, changes, sentence):
    """A traceback, or a search that cannot find anything."""
    with pytest.raises((ValueError, OSError)) as told:
        captures.read(LABS, changed(folder, **changes))
    assert sentence in str(told.value) and "\n" not in str(told.value)


@pytest.mark.parametrize("picture, sentence", [
    (np.ones((16, 24, 4)), "0.png shows no background"),
    (np.zeros((16, 24, 4)), "0.png shows no object"),
    (np.ones((16, 24, 3)), "0.png has no transparency: give the colour behind the object"),
    (np.eye(16)[..., None] * np.ones(4), "all pictures must have one size"),
])
def test_what_is_wrong_with_pictures_is_told_in_one_sentence(folder, picture, sentence):
    """A silhouette that is everything or nothing."""
    image.write(folder / "0.png", picture)
    with pytest.raises(ValueError, match=sentence):
        captures.read(LABS, folder)


def test_a_folder_without_cameras_and_a_broken_file(folder):
    """A traceback."""
    (folder / "cameras.json").write_text("{")
    with pytest.raises(ValueError, match=r"cameras.json is no JSON: "):
        captures.read(LABS, folder)
    (folder / "cameras.json").unlink()
    with pytest.raises(FileNotFoundError, match=r"there is no file .*cameras.json"):
        captures.read(LABS, folder)


def test_the_command_takes_a_folder(folder, capsys):
    """A folder's name is taken for a scene's, or a scene's for a folder's; or a traceback."""
    (folder / "cameras.json").write_text("{}")
    assert cli.main(["demo", "reconstruct", str(folder)]) == 2
    assert capsys.readouterr().err.startswith("course: cameras.json must be ")
    assert cli.main(["demo", "reconstruct", str(folder / "none")]) == 2
    assert "there is no file" in capsys.readouterr().err
    assert cli.main(["demo", "reconstruct", "bunny", "nonsense"]) == 2
    assert "there is no scene nonsense" in capsys.readouterr().err
