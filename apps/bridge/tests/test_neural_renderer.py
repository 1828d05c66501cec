"""neural_renderer's interface: its pictures and gradients are lab 10's."""
import functools
import shutil
from pathlib import Path

import numpy as np
import pytest
from loose_faces import some_corners

torch = pytest.importorskip("torch", reason="PyTorch is not installed: requirements.txt")

from apps.bridge import neural_renderer as nr  # noqa: E402
from course.given import image, mesh  # noqa: E402
from reference import neural_renderer, pipeline, sweep_gradient, transforms  # noqa: E402
from reference import texture_cubes as cubes  # noqa: E402

SIZE = 20
EYES = np.array([[0.6, 1.2, -2.2], [-1.5, -0.4, 2.0]])
LIGHT = cubes.Lights(np.array([0.3, 0.4, 0.5]), np.array([0.6, 0.5, 0.4]),
                     np.array([0.2, 0.9, -0.3]))


def given(*arrays):
    """Arrays as tensors that take gradients."""
    return [torch.tensor(array, requires_grad=True) for array in arrays]


def clip_from_world(eye):
    """Its camera, which looks along z and has x on its right: a mirror of the course's."""
    view = transforms.look_at(eye, np.zeros(3), np.array([0.0, 1.0, 0.0]))
    return np.diag([-1, 1, 1, 1]) @ transforms.perspective(np.pi / 3, 1.0, 0.1, 100.0) @ view


@pytest.mark.parametrize("mode", ["look_at", "look"])
def test_pictures_and_gradients_of_a_batch_are_those_of_lab_10(mode, rng):
    """Rows upside down, light from the other side, an eps or a background of another picture."""
    vertices, faces = mesh.icosphere(20)
    vertices = vertices + 0.1 * rng.standard_normal((2, *vertices.shape))
    textures = np.tile(rng.random((2, len(faces), 1, 1, 1, 3)), (1, 1, 3, 3, 3, 1))
    backgrounds, grad = rng.random((2, 3)), rng.standard_normal((2, 3, SIZE, SIZE))
    renderer = nr.Renderer(SIZE, True, backgrounds, False, mode, light_direction=LIGHT.towards,
                           light_intensity_ambient=1, light_color_ambient=LIGHT.ambient,
                           light_intensity_directional=1, light_color_directional=LIGHT.directional,
                           camera_direction=-EYES)
    renderer.eye = EYES
    inputs = given(vertices, textures)
    got = renderer(inputs[0], torch.tensor(faces).expand(2, -1, -1), inputs[1], "rgb")
    got.backward(torch.tensor(grad))
    outline = functools.partial(sweep_gradient.sweep_backward, eps=renderer.rasterizer_eps)
    for n, eye in enumerate(EYES):
        scene = cubes.LitMesh(vertices[n], faces, textures[n],
                              LIGHT._replace(towards=-LIGHT.towards))
        view = pipeline.View(clip_from_world(eye), SIZE, SIZE, backgrounds[n])
        picture, buffers = cubes.render(scene, view)
        grads = cubes.render_backward(grad[n, :, ::-1].transpose(1, 2, 0), buffers, scene, view,
                                      outline)
        expected = picture[::-1].transpose(2, 0, 1), grads.vertices, grads.textures
        for one, other in zip((got, *(each.grad for each in inputs)), expected, strict=True):
            np.testing.assert_allclose(one[n].detach(), other, atol=1e-9)


@pytest.mark.parametrize("channels", [slice(4), slice(3, 4)])
def test_outlines_are_pulled_by_colour_and_alpha_at_once(channels, rng):
    """max(0, .) of each on its own; or a picture that was not asked for pulls."""
    corners, textures, light = some_corners(rng), np.ones((12, 2, 2, 2, 3)), rng.random((12, 3))
    faces, = given(corners[None])
    lit = torch.tensor(textures * light[:, None, None, None])[None]
    out = nr.rasterize_rgbad(faces, lit, SIZE, False, 0.1, 100, 0.01, (0.1, 0.2, 0.3))
    grad = rng.standard_normal((1, 4, SIZE, SIZE))[:, channels]
    colour = torch.cat([out["rgb"], out["alpha"][:, None]], 1)[:, channels]
    colour.backward(torch.tensor(grad))
    maps = neural_renderer.rasterize(corners, SIZE, SIZE)
    shown = cubes.shade_cubes(maps, corners, textures, light, np.array([0.1, 0.2, 0.3]))
    expected = np.dstack([shown, maps.face_index >= 0])[..., channels]
    np.testing.assert_allclose(colour[0].detach(), np.moveaxis(expected[::-1], -1, 0))
    pulls = sweep_gradient.sweep_backward(np.moveaxis(grad[0, :, ::-1], 0, -1), expected,
                                          maps.face_index, corners, 0.01)
    np.testing.assert_allclose(faces.grad[0], pulls, atol=1e-9)


def test_depth_and_a_single_texel_have_exact_gradients(rng):
    """Eight taps of one texel, a depth that knows nothing of x and y, 2 x 2 samples added up."""
    faces, textures = given(some_corners(rng)[None], rng.random((1, 12, 1, 1, 1, 3)))
    assert torch.autograd.gradcheck(lambda faces: nr.rasterize_depth(faces, 6), faces, atol=1e-6)
    pictures = functools.partial(nr.rasterize, faces.detach(), image_size=6)
    assert torch.autograd.gradcheck(pictures, textures)
    torch.testing.assert_close(pictures(textures), pictures(textures.expand(1, 12, 2, 2, 2, 3)))


@pytest.mark.parametrize(("near", "far", "depths"), [
    (0.1, 7, [1, 2, 7]), (1.5, 7, [2, 7]), (0.1, 1.5, [1, 1.5])])
def test_no_picture_sees_beyond_far(near, far, depths):
    """inf where no face is; near and far are heeded for colours alone."""
    vertices = torch.tensor([[[-3.0, -3, 2], [3, -3, 2], [0, 0.9, 2],
                              [-1.0, -1, 1], [1, -1, 1], [0, 0.9, 1]]])
    renderer = nr.Renderer(SIZE, False, near=near, far=far)
    renderer.camera_mode = "as it is"
    depth, alpha = (renderer(vertices, torch.arange(6).reshape(1, 2, 3), mode=mode)
                    for mode in ("depth", "silhouettes"))
    assert depth.unique().tolist() == depths
    assert torch.equal(alpha, (depth < far).float())


def test_a_projection_bends_as_opencvs_lenses_do(rng):
    """Coefficients in another order, rows counted from below, t of another picture."""
    points, t = rng.uniform(-1, 1, (2, 5, 3)), rng.uniform(3, 4, (2, 3))
    K = np.array([[500.0, 3, 320], [0, 510, 240], [0, 0, 1]])
    R = np.stack([transforms.rotate(np.array([0.6, 0, 0.8]), angle)[:3, :3] for angle in (1, 2)])
    k1, k2, p1, p2, k3 = coefficients = np.array([0.1, -0.02, 0.01, 0.03, 0.004])
    got = nr.projection(torch.tensor(points), K, R, t, coefficients, 640)
    for n in range(2):
        x, y, z = R[n] @ points[n].T + t[n][:, None]
        x, y = x / z, y / z
        r2 = x**2 + y**2
        bent = 1 + k1 * r2 + k2 * r2**2 + k3 * r2**3
        u, v, _ = K @ [bent * x + 2 * p1 * x * y + p2 * (r2 + 2 * x**2),
                       bent * y + 2 * p2 * x * y + p1 * (r2 + 2 * y**2), np.ones(5)]
        np.testing.assert_allclose(got[n], np.stack([u / 320 - 1, 1 - v / 320, z], -1))


def test_a_call_may_have_a_camera_of_its_own():
    """A call's K is not heard; arguments in their order mean something else."""
    vertices, faces = map(torch.tensor, mesh.cube(12))
    scene, t = (vertices[None].float(), faces[None]), (0, 0, 4)
    K, R = np.array([[40.0, 0, 20], [0, 40, 20], [0, 0, 1]]), np.eye(3)
    own = nr.Renderer(SIZE, True, (0, 0, 0), True, "projection", K, R, t, None, 40)
    cube = own(*scene, mode="silhouettes")
    assert 0.2 < cube.mean() < 0.8
    K = K * [[2], [2], [1]]
    assert torch.equal(cube, nr.Renderer(SIZE)(*scene, None, "silhouettes", K, R, t, None, 80))
    assert torch.equal(cube, own.render_silhouettes(*scene, K=K, orig_size=80))


def test_faces_are_seen_from_behind_with_their_own_colours(rng):
    """fill_back leaves the cubes' axes, or the light on the other side."""
    vertices = torch.tensor([[[-0.9, -0.8, 1], [0.9, -0.7, 2], [0.1, 0.9, 3]]])
    faces, textures = torch.tensor([[[0, 1, 2]]]), torch.rand(1, 1, 3, 3, 3, 3)
    renderer = nr.Renderer(SIZE, light_direction=(0, 0, -1))
    renderer.camera_mode = "as it is"
    front = renderer.render_rgb(vertices, faces, textures)
    assert torch.equal(front, renderer.render_rgb(vertices, faces.flip(-1),
                                                  textures.transpose(2, 4)))
    renderer.fill_back = False
    rgb, _, alpha = renderer(vertices, faces, textures)
    assert torch.equal(front, rgb) and torch.equal(alpha > 0, rgb.sum(1) > 0)
    assert renderer(vertices, faces.flip(-1), mode="silhouettes").sum() == 0 < front.amax()


@pytest.mark.parametrize("size", [2, 3, 5])
def test_textures_come_back_from_a_file(size, tmp_path, rng):
    """Texels of a neighbour's tile, rows upside down, faces or vertices in another order."""
    vertices, faces = map(torch.tensor, mesh.icosphere(20))
    corners = rng.uniform(0.25, 0.75, (len(faces), 1, 1, 3, 3))
    textures = torch.tensor(cubes.texel_barycentrics(size) @ corners)
    nr.save_obj(tmp_path / "a ball.obj", vertices, faces, textures)
    found = nr.load_obj(tmp_path / "a ball.obj", False, size, True)
    assert [each.dtype for each in found] == [torch.float32, torch.int32, torch.float32]
    np.testing.assert_allclose(found[0], vertices, atol=1e-6)
    assert torch.equal(found[1].long(), faces)
    look = nr.Renderer(64, camera_mode="look_at").render_rgb
    pictures = [look(*(each[None] for each in scene)) for scene in (
        found, (vertices, faces, textures))]
    np.testing.assert_allclose(*pictures, atol=1.5 / 255)
    again = nr.Mesh.fromobj(tmp_path / "a ball.obj", False, True, size)
    assert torch.equal(again.textures, found[2]) and again.texture_size == size
    assert nr.Mesh.fromobj(tmp_path / "a ball.obj").textures.shape == (len(faces), 4, 4, 4, 3)


COLOURS = "newmtl red\nKd 1 0 0\nnewmtl stripes\nmap_Kd stripes.png\nKd 1 1 1\n"
STRIPES = np.array([[[0.0, 0, 1], [0, 1, 0], [0, 1, 1], [1, 1, 0]]])


@pytest.mark.parametrize("is_bilinear", [True, False])
@pytest.mark.parametrize(("wrapping", "ends"), [
    ("REPEAT", STRIPES[0, [3, 1]]), ("MIRRORED_REPEAT", STRIPES[0, [0, 2]]),
    ("CLAMP_TO_EDGE", STRIPES[0, [0, 3]]), ("CLAMP_TO_BORDER", np.zeros((2, 3)))])
def test_a_file_is_read_as_it_is_written(wrapping, ends, is_bilinear, tmp_path):
    """Polygons, corners without uv; another wrap mode, or Kd for a picture."""
    image.write(tmp_path / "stripes.png", STRIPES)
    (tmp_path / "my colours.mtl").write_text(COLOURS)
    shutil.copy(Path(__file__).with_name("square.obj"), tmp_path)
    vertices, faces, textures = nr.load_obj(tmp_path / "square.obj", True, 4, True, wrapping,
                                            is_bilinear)
    np.testing.assert_allclose(vertices, [[-1, -0.5, 0], [1, -0.5, 0], [1, 0.5, 0], [-1, 0.5, 0]])
    assert faces.tolist() == [[0, 1, 2], [0, 2, 3], [0, 1, 2]]
    at_corners = textures[:, [3, 0, 0], [0, 3, 0], [0, 0, 3]]
    expected = [*ends[[[0, 1, 0], [0, 0, 1]]], 3 * [[1, 0, 0]]]
    np.testing.assert_allclose(at_corners, expected, atol=1e-6)
    assert (textures % 1 != 0).any() == is_bilinear


@pytest.mark.parametrize(("wrong", "kind", "sentence"), [
    (lambda _: nr.rasterize_depth(torch.ones(2, 3, 3)), RuntimeError, r"have the shape \(3, 3, 3"),
    (lambda _: nr.rasterize(torch.ones(1, 2, 3, 3), torch.ones(1, 1, 2, 2, 2, 3)), RuntimeError,
     r"textures.n. must have the shape \(2, 2, 2, 2, 3"),
    (lambda _: nr.rasterize_rgbad(torch.ones(1, 2, 3, 3)), RuntimeError, "rgb needs textures"),
    (lambda _: nr.Renderer(camera_mode="orbit"), ValueError, "projection, look or look_at, not"),
    (lambda _: nr.Renderer()(0, 0, mode="normals"), ValueError, "silhouettes or depth, not"),
    (lambda _: nr.Renderer()(0, torch.ones(2, 1, 3), mode="depth"), RuntimeError, "needs K, R and"),
    (lambda _: nr.rasterize_depth(torch.ones(0, 2, 3, 3)), RuntimeError, "faces must be of at"),
    (lambda _: nr.look_at(torch.ones(2, 3, 3), [[0, 0, 3], [1, 2, 3]], (1, 2, 3)), RuntimeError,
     "the camera of picture 1 looks along up, or its direction or up has no length: move the eye"),
    (lambda _: nr.look(torch.ones(1, 3, 3), (0, 0, 0)), RuntimeError, "picture 0 looks along"),
    (lambda here: nr.load_obj(here), FileNotFoundError, "there is no file"),
    (lambda here: here.write_text("f 1 2 3") and nr.load_obj(here), ValueError, "names vertex 0"),
], ids=range(11))
def test_what_does_not_fit_gets_one_sentence(wrong, kind, sentence, tmp_path):
    """A traceback out of NumPy, or a picture of something else."""
    with pytest.raises(kind, match=sentence) as caught:
        wrong(tmp_path / "some.obj")
    assert "\n" not in str(caught.value)
