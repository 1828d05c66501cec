"""neural_renderer's interface: its pictures and gradients are lab 10's."""
import functools

import numpy as np
import pytest
from loose_faces import some_corners

torch = pytest.importorskip("torch", reason="PyTorch is not installed: requirements-torch.txt")
from torch.autograd import gradcheck  # noqa: E402

from course.bridge import neural_renderer as nr  # noqa: E402
from course.experiments.folder import lenses  # noqa: E402
from course.given import image, mesh  # noqa: E402
from reference import (  # noqa: E402
    neural_renderer,
    pipeline,
    sweep_gradient,
    texture_cubes,
    transforms,
)

SIZE = 20
MIRROR = np.diag([-1.0, 1, 1, 1])  # its cameras look along z and have x on their right
EYES = np.array([[0.6, 1.2, -2.2], [-1.5, -0.4, 2.0]])
LIGHT = texture_cubes.Lights(np.array([0.3, 0.4, 0.5]), np.array([0.6, 0.5, 0.4]),
                             np.array([0.2, 0.9, -0.3]))


def given(*arrays):
    """Arrays as tensors that take gradients."""
    return [torch.tensor(array, requires_grad=True) for array in arrays]


def clip_from_world(eye):
    view = transforms.look_at(eye, np.zeros(3), np.array([0.0, 1.0, 0.0]))
    return MIRROR @ transforms.perspective(np.pi / 3, 1.0, 0.1, 100.0) @ view


def test_pictures_and_gradients_of_a_batch_are_those_of_lab_10(rng):
    """Rows upside down, light from the other side, an eps or a background of another picture."""
    vertices, faces = mesh.icosphere(20)
    vertices = vertices + 0.1 * rng.standard_normal((2, *vertices.shape))
    textures = rng.random((2, len(faces), 3, 3, 3, 3))
    backgrounds, grad = rng.random((2, 3)), rng.standard_normal((2, 3, SIZE, SIZE))
    renderer = nr.Renderer(
        SIZE, background_color=backgrounds, fill_back=False, camera_mode="look_at",
        light_intensity_ambient=1, light_intensity_directional=1, light_direction=LIGHT.towards,
        light_color_ambient=LIGHT.ambient, light_color_directional=LIGHT.directional)
    renderer.eye = EYES
    inputs = given(vertices, textures)
    got = renderer(inputs[0], torch.tensor(faces).expand(2, -1, -1), inputs[1], "rgb")
    got.backward(torch.tensor(grad))
    outline = functools.partial(sweep_gradient.sweep_backward, eps=renderer.rasterizer_eps)
    for n, eye in enumerate(EYES):
        scene = texture_cubes.LitMesh(vertices[n], faces, textures[n],
                                      LIGHT._replace(towards=-LIGHT.towards))
        view = pipeline.View(clip_from_world(eye), SIZE, SIZE, backgrounds[n])
        picture, buffers = texture_cubes.render(scene, view)
        grads = texture_cubes.render_backward(grad[n, :, ::-1].transpose(1, 2, 0), buffers, scene,
                                              view, outline)
        expected = picture[::-1].transpose(2, 0, 1), grads.vertices, grads.textures
        for one, other in zip((got, *(each.grad for each in inputs)), expected, strict=True):
            np.testing.assert_allclose(one[n].detach(), other, atol=1e-9)


def test_outlines_are_pulled_by_colour_and_alpha_at_once(rng):
    """max(0, .) of each picture on its own; or a picture that was not asked for pulls."""
    corners, textures = some_corners(rng), rng.random((12, 2, 2, 2, 3))
    faces, cubes = given(corners[None], textures[None])
    out = nr.rasterize_rgbad(faces, cubes, SIZE, False, eps=0.01, background_color=(0.1, 0.2, 0.3))
    grads = rng.standard_normal((4, SIZE, SIZE))
    torch.autograd.backward((out["rgb"], out["alpha"]), (torch.tensor(grads[None, :3]),
                                                         torch.tensor(grads[3:])))
    maps = neural_renderer.rasterize(corners, SIZE, SIZE)
    light, grad = np.ones((12, 3)), np.moveaxis(grads[:, ::-1], 0, -1)
    colour = texture_cubes.shade_cubes(maps, corners, textures, light, np.array([0.1, 0.2, 0.3]))
    exact, grad_textures, _ = texture_cubes.shade_cubes_backward(grad[..., :3], maps, corners,
                                                                 textures, light)
    colour = np.dstack([colour, maps.face_index >= 0])
    pulls = sweep_gradient.sweep_backward(grad, colour, maps.face_index, corners, 0.01)
    np.testing.assert_allclose(faces.grad[0], exact + pulls, atol=1e-9)
    np.testing.assert_allclose(cubes.grad[0], grad_textures, atol=1e-9)
    alone, = given(corners[None])
    nr.rasterize_silhouettes(alone, SIZE, False).backward(torch.tensor(grads[3:]))
    pulls = sweep_gradient.sweep_backward(grad[..., 3:], colour[..., 3:], maps.face_index, corners)
    np.testing.assert_allclose(alone.grad[0], pulls, atol=1e-9)


def test_depth_is_far_beyond_the_faces_and_no_picture_sees_farther():
    """inf where no face is; near and far are heeded for colours alone."""
    faces = torch.tensor([[[[-3.0, -3, 2], [3, -3, 2], [0, 0.9, 2]],
                           [[-1.0, -1, 1], [1, -1, 1], [0, 0.9, 1]]]])
    for near, far, depths in (0.1, 7, (1, 2, 7)), (1.5, 7, (2, 7)), (0.1, 1.5, (1, 1.5)):
        depth = nr.rasterize_depth(faces, SIZE, False, near, far)
        alpha = nr.rasterize_silhouettes(faces, SIZE, False, near, far)
        assert depth.unique().tolist() == list(depths)
        assert torch.equal(alpha, (depth < far).float())
        renderer = nr.Renderer(SIZE, False, fill_back=False, camera_mode="look", near=near, far=far)
        renderer.camera_mode = "as it is"
        mesh_of = faces.reshape(1, 6, 3), torch.arange(6).reshape(1, 2, 3)
        assert torch.equal(renderer(*mesh_of, mode="depth"), depth)
        assert torch.equal(renderer(*mesh_of, mode="silhouettes"), alpha)


def exact(rng):
    """(name, function, what it has exact gradients for)."""
    points, corners = rng.uniform(-1, 1, (2, 3, 3)) + [0, 0, 3], some_corners(rng)[None]
    cubes = rng.random((1, 12, 2, 2, 2, 3))
    colours = rng.random((2, 2, 3))
    lens = 0.1 * rng.standard_normal((2, 5))
    return {
        "textures": (lambda cubes: nr.rasterize(torch.tensor(corners), cubes, 6), [cubes]),
        "one texel": (lambda cubes: nr.rasterize(torch.tensor(corners), cubes, 6),
                      [cubes[:, :, :1, :1, :1]]),
        "depth": (lambda faces: nr.rasterize_depth(faces, 6), [corners]),
        "light": (lambda faces, cubes, *colours: nr.lighting(faces, cubes, 0.5, 0.4, *colours),
                  [corners, cubes, colours[0, :1], colours[1, :1], colours[0, 1]]),
        "look_at": (nr.look_at, [points, EYES, 0.1 * EYES[::-1]]),
        "look": (nr.look, [points, EYES[0], -EYES, np.array([0.1, 1, 0])]),
        "perspective": (nr.perspective, [points, np.array(25.0)]),
        "projection": (lambda *camera: nr.projection(*camera, 2), [
            points, rng.random((2, 3, 3)), rng.random((2, 3, 3)), rng.random((2, 1, 3)), lens]),
        "points": (nr.get_points_from_angles, list(rng.random((3, 4)))),
    }


@pytest.mark.parametrize("name", exact(np.random.default_rng(0)))
def test_exact_gradients_are_exact(name, rng):
    """A gradient of another, or none, where pixels see what they see."""
    function, inputs = exact(rng)[name]
    assert gradcheck(function, given(*inputs), atol=1e-6)


@pytest.mark.parametrize("by", [nr.look_at, nr.look])
def test_cameras_are_those_of_the_course(by, rng):
    """An axis turned round, a whole angle for a half, an eye of another picture."""
    points = rng.uniform(-1, 1, (2, 5, 3))
    seen = nr.perspective(by(torch.tensor(points), EYES, -EYES if by is nr.look else (0, 0, 0)))
    for n, eye in enumerate(EYES):
        clip = transforms.transform(transforms.to_homogeneous(points[n]), clip_from_world(eye))
        np.testing.assert_allclose(seen[n, :, :2], clip[:, :2] / clip[:, 3:])
        np.testing.assert_allclose(seen[n, :, 2], clip[:, 3])


def test_a_projection_bends_as_the_courses_lenses_do(rng):
    """Coefficients in another order, rows counted from below, t of another picture."""
    points, t = rng.uniform(-1, 1, (2, 5, 3)), rng.uniform(3, 4, (2, 3))
    K = np.array([[500.0, 3, 320], [0, 510, 240], [0, 0, 1]])
    R = np.stack([transforms.rotate(np.array([0.6, 0, 0.8]), angle)[:3, :3] for angle in (1, 2)])
    k1, k2, p1, p2, k3 = coefficients = np.array([0.1, -0.02, 0.01, 0.03, 0.004])
    got = nr.projection(torch.tensor(points), K, R, t, coefficients, 640)
    for n in range(2):
        x, y, z = R[n] @ points[n].T + t[n][:, None]
        ray = lenses.bent(np.array([x / z, y / z]), (k1, k2, p1, p2, k3, 0))
        u, v, _ = K @ [*ray, np.ones(5)]
        np.testing.assert_allclose(got[n], np.stack([u / 320 - 1, 1 - v / 320, z], -1))


def test_a_renderer_takes_its_camera_from_a_call_or_from_itself():
    """A call's K is not heard; arguments in their order mean something else."""
    vertices, faces = map(torch.tensor, mesh.cube(12))
    scene = vertices[None].float(), torch.cat([faces, faces.flip(1)])[None].int()
    K, R, t = np.array([[40.0, 0, 20], [0, 40, 20], [0, 0, 1]]), np.eye(3), (0, 0, 4)
    own = nr.Renderer(SIZE, True, (0, 0, 0), False, "projection", K, R, t, None, 40)
    other = nr.Renderer(SIZE, fill_back=False)
    cube = own(*scene, mode="silhouettes")
    assert 0.2 < cube.mean() < 0.8
    for same in (other(*scene, None, "silhouettes", K, R, t, None, 40),
                 other.render_silhouettes(*scene, R=R, t=t, K=2 * K * [[1], [1], [0.5]],
                                          orig_size=80)):
        assert torch.equal(cube, same)


def test_faces_are_seen_from_behind_with_their_own_colours(rng):
    """fill_back leaves the cubes' axes, or makes the light of both sides one."""
    vertices = torch.tensor([[[-0.9, -0.8, 1], [0.9, -0.7, 2], [0.1, 0.9, 3]]])
    faces, textures = torch.tensor([[[0, 1, 2]]]), torch.tensor(rng.random((1, 1, 3, 3, 3, 3)))
    renderer = nr.Renderer(SIZE, camera_mode="look_at", light_direction=(0, 0, -1))
    renderer.camera_mode = "as it is"
    front = renderer(vertices, faces, textures.float(), mode="rgb")
    turned = renderer(vertices, faces.flip(-1), textures.float().transpose(2, 4), mode="rgb")
    assert front.amax() > 0.5 and torch.equal(front, turned)
    renderer.fill_back = False
    seen = renderer.render(vertices, faces, textures.float())
    assert torch.equal(seen[0], front)
    assert renderer.render(vertices, faces.flip(-1), textures.float())[2].amax() == 0


def test_textures_come_back_from_a_file(tmp_path, rng):
    """Texels of a neighbour's tile, rows upside down, faces or vertices in another order."""
    vertices, faces = map(torch.tensor, mesh.icosphere(20))
    path = tmp_path / "a ball.obj"
    for size in 2, 3, 5:
        corners = rng.uniform(0.25, 0.75, (len(faces), 1, 1, 3, 3))
        textures = torch.tensor(texture_cubes.texel_barycentrics(size) @ corners)
        nr.save_obj(path, vertices, faces, textures)
        found = nr.load_obj(path, False, size, True)
        assert [each.dtype for each in found] == [torch.float32, torch.int32, torch.float32]
        np.testing.assert_allclose(found[0], vertices, atol=1e-6)
        assert torch.equal(found[1].long(), faces)
        look = nr.Renderer(64, camera_mode="look_at").render_rgb
        pictures = [look(*(each[None] for each in scene)) for scene in (
            found, (vertices, faces, textures))]
        np.testing.assert_allclose(*pictures, atol=1.5 / 255)


WORDS = """# a square, and what else such files hold
mtllib my colours.mtl
v 0 0 1 0.5 0.5 0.5
v 4 0 1
v 4 2 1  # to here
v 0 2 1
vt -0.125 0.5
vt 1.375 0.5
vn 0 0 1
usemtl stripes
f 1/1/1 2/2/1 3/1/1 4/-1/1
usemtl red
f -4//1 2//1 -2//1
f 1 2 3
"""


def test_a_file_is_read_as_it_is_written(tmp_path):
    """Polygons, numbers from the end, corners without uv; a wrap mode, or Kd for a picture."""
    stripes = np.array([[[0.0, 0, 1], [0, 1, 0], [0, 1, 1], [1, 1, 0]]])
    image.write(tmp_path / "stripes.png", stripes)
    (tmp_path / "square.obj").write_text(WORDS)
    (tmp_path / "my colours.mtl").write_text(
        "newmtl red\nKd 1 0 0\nnewmtl stripes\nmap_Kd stripes.png\nKd 1 1 1\n")
    load = functools.partial(nr.load_obj, tmp_path / "square.obj", load_texture=True)
    for wrapping, first, second in (("REPEAT", stripes[0, 3], stripes[0, 1]),
                                    ("MIRRORED_REPEAT", stripes[0, 0], stripes[0, 2]),
                                    ("CLAMP_TO_EDGE", stripes[0, 0], stripes[0, 3]),
                                    ("CLAMP_TO_BORDER", np.zeros(3), np.zeros(3))):
        for is_bilinear in True, False:
            vertices, faces, textures = load(texture_wrapping=wrapping, use_bilinear=is_bilinear)
            np.testing.assert_allclose(textures[0, [3, 0, 0], [0, 3, 0], [0, 0, 3]],
                                       [first, second, first], atol=1e-6)
            np.testing.assert_allclose(textures[1, [3, 0, 0], [0, 3, 0], [0, 0, 3]],
                                       [first, first, second], atol=1e-6)
            assert (textures[2:] == torch.tensor([1.0, 0, 0])).all()
    assert faces.tolist() == [[0, 1, 2], [0, 2, 3], [0, 1, 2], [0, 1, 2]]
    np.testing.assert_allclose(vertices, [[-1, -0.5, 0], [1, -0.5, 0], [1, 0.5, 0], [-1, 0.5, 0]])
    of_file = nr.Mesh.fromobj(tmp_path / "square.obj", load_texture=True, texture_size=2)
    assert (of_file.num_vertices, of_file.num_faces, of_file.texture_size) == (4, 4, 2)
    learned = nr.Mesh.fromobj(tmp_path / "square.obj").textures
    assert learned.requires_grad and learned.shape == (4, 4, 4, 4, 3)


FACES, CUBES = torch.rand(1, 2, 3, 3), torch.rand(1, 2, 2, 2, 2, 3)


@pytest.mark.parametrize(("wrong", "kind", "sentence"), [
    (lambda _: nr.rasterize(FACES[0], CUBES), RuntimeError, r"faces must have the shape \(n, f, 3"),
    (lambda _: nr.rasterize(FACES, CUBES[:, :1]), RuntimeError, r"the shape \(1, 2, 2, 2, 2, 3"),
    (lambda _: nr.rasterize_rgbad(FACES), RuntimeError, "rgb needs textures"),
    (lambda _: nr.rasterize_depth(FACES, imagesize=4), TypeError, "imagesize"),
    (lambda _: nr.look_at(FACES[0, 0], (0, 0, 1)), RuntimeError, r"give those of one mesh as vert"),
    (lambda _: nr.vertices_to_faces(FACES[0], torch.zeros(2, 3)), RuntimeError, r"as faces\[None"),
    (lambda _: nr.Renderer(camera_mode="orbit"), ValueError, "must be projection, look or look_at"),
    (lambda _: nr.Renderer(camera_mode="look")(FACES[0], None, mode="normals"), ValueError,
     "mode must be None, rgb, silhouettes or depth"),
    (lambda _: nr.Renderer()(FACES[0], torch.zeros(2, 1, 3), mode="depth"), RuntimeError,
     "the camera mode projection needs K, R and t"),
    (lambda _: nr.load_obj("no.obj"), FileNotFoundError, "there is no file no.obj"),
    (lambda here: nr.load_obj(here("v 0 0 0\nf 1 2 3")), ValueError, "face 0 names vertex 1"),
    (lambda here: nr.load_obj(here("f a b c")), ValueError, "cannot read .* as a mesh"),
    (lambda here: nr.load_obj(here("v 0 0 0\nv 0 0 1\nf 1 1 2"), load_texture=True), RuntimeError,
     r"names no file of materials"),
    (lambda here: nr.load_obj(here("v 0 0 0\nf 1 1 1"), False, 1, True), RuntimeError, "2 or more"),
    (lambda here: nr.load_obj(here("v 0 0 0\nf 1 1 1")), RuntimeError, "in one place"),
])
def test_what_does_not_fit_gets_one_sentence(wrong, kind, sentence, tmp_path):
    """A traceback out of NumPy, or a picture of something else."""
    def here(text):
        path = tmp_path / "some.obj"
        path.write_text(text)
        return path

    with pytest.raises(kind, match=sentence) as caught:
        wrong(here)
    assert "\n" not in str(caught.value)
