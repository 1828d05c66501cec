"""The reference's whole pipeline, which lab 9 composes of the labs before: pictures, gradients."""
import functools

import numpy as np
import pytest

from course.given import mesh
from course.given.gradcheck import gradcheck
from reference import antialiasing, scanline, texturing, transforms
from reference import inverse_rendering as inverse

WIDTH, HEIGHT = 26, 19


def camera(angle=0.7, distance=3.2, near=0.1):
    view = transforms.translate(np.array([0.1, -0.2, -distance]))
    view = view @ transforms.rotate(np.array([0.4, 1.0, 0.2]), angle)
    return transforms.perspective(0.9, WIDTH / HEIGHT, near, 20.0) @ view


def soup(rng):
    """Faces that pass through each other and share vertices."""
    return rng.uniform(-1.1, 1.1, (14, 3)), rng.integers(0, 14, (18, 3))


def inside_out(rng):
    """A camera within a box of large faces: some of their vertices lie behind it."""
    positions, faces = mesh.cube(12)
    return 2.2 * positions + rng.uniform(-0.2, 0.2, positions.shape), faces


def half_a_bunny(rng):
    """Faces of less than a pixel, with a boundary."""
    positions, faces = mesh.bunny()
    centre = positions[faces].mean(1)
    return mesh.normalize(positions), faces[centre[:, 0] > np.median(centre[:, 0])]


SCENES = {"cube": (lambda rng: mesh.cube(12), camera()),
          "torus": (lambda rng: mesh.torus(150), camera(1.3, 4.0)),
          "soup": (soup, camera(0.2, 3.0)),
          "vertices behind the camera": (inside_out, camera(0.4, 1.5)),
          "half a bunny": (half_a_bunny, camera(0.9, 2.5))}


def scene(name):
    """positions, faces, colours (V, 2), clip_from_model, background (2,), opposite"""
    rng = np.random.default_rng(5)
    build, clip_from_model = SCENES[name]
    positions, faces = build(rng)
    colours, background = rng.normal(size=(len(positions), 2)), rng.normal(size=2)
    opposite = antialiasing.opposite_vertices(faces)
    return positions, faces, colours, clip_from_model, background, opposite


def decided(clip, face_index, depth, faces, opposite):
    """What a picture decides: faces, pairs, edges, which pixel changes, what is saturated."""
    owner, other, c, ends, *_ = antialiasing.blended_pairs(face_index, depth, clip, faces, opposite)
    return face_index, owner, other, ends, c > 0.5, (c > 0) & (c < 1)


def few(arrays, rows):
    """Check a few rows of large arrays: their values, and what puts them back into copies."""
    def put(*some):
        whole = [array.copy() for array in arrays]
        for array, row, values in zip(whole, rows, some, strict=True):
            array[row] = values
        return whole

    return put, tuple(array[row] for array, row in zip(arrays, rows, strict=True))


def whole_gradcheck(name, render, backward, decisions, arrays, rows):
    """gradcheck by some rows of arrays, and by all of the last one, the matrix.

    render(*arrays) -> picture, buffers; backward(grad_picture, buffers, *arrays);
    decisions(buffers, *arrays). Each scene is rendered once for forward and decisions.
    """
    put, some = few(arrays, [*rows, slice(None)])
    rendered = functools.lru_cache(8)(lambda *raw: render(*restored(raw)))

    def restored(raw):
        return put(*(np.frombuffer(r).reshape(x.shape) for r, x in zip(raw, some, strict=True)))

    def at(inputs):
        return rendered(*(x.tobytes() for x in inputs))

    def some_gradients(grad_picture, *inputs):
        gradients = backward(grad_picture, at(inputs)[1], *put(*inputs))
        assert [g.shape for g in gradients] == [x.shape for x in arrays]
        return tuple(g[row] for g, row in zip(gradients, [*rows, slice(None)], strict=True))

    report = gradcheck(lambda *inputs: at(inputs)[0], some_gradients, some, name=name,
                       decisions=lambda *inputs: decisions(at(inputs)[1], *put(*inputs)))
    assert report.left_out < 0.1 * report.checked


@pytest.mark.parametrize("name", SCENES)
def test_the_gradients_of_a_picture_are_central_differences(name):
    """A link is left out on the way back, or one of the two ways to the positions."""
    positions, faces, colours, clip_from_model, background, opposite = scene(name)

    def render(positions, colours, clip_from_model):
        return inverse.render(positions, faces, colours, clip_from_model, WIDTH, HEIGHT,
                              background, opposite)

    def backward(grad_picture, buffers, positions, colours, clip_from_model):
        return inverse.render_backward(grad_picture, buffers, positions, faces, colours,
                                       clip_from_model, opposite)

    def decisions(buffers, *_):
        return decided(*buffers[:3], faces, opposite)

    clip, face_index, *_ = render(positions, colours, clip_from_model)[1]
    vertices = np.unique(faces[face_index[face_index >= 0]])
    behind = vertices[clip[vertices, 3] < 0]
    assert (len(behind) > 0) == (name == "vertices behind the camera")
    some = np.unique(np.append(vertices[::len(vertices) // 4][:4], behind[:1]))
    whole_gradcheck(name, render, backward, decisions, (positions, colours, clip_from_model),
                    [some, some])


@pytest.mark.parametrize("filter", ["linear", "linear-mipmap-linear"])
def test_the_gradients_of_a_textured_picture_are_central_differences(filter):
    """The texture's or the footprint's way to the positions is left out."""
    rng = np.random.default_rng(2)
    positions, faces, _, clip_from_model, _, opposite = scene("cube")
    uv, uv_faces = rng.random((20, 2)), rng.permutation(np.arange(36) % 20).reshape(12, 3)
    image, background = rng.normal(size=(16, 8, 2)), rng.normal(size=2)

    def render(positions, uv, image, clip_from_model):
        return inverse.render_textured(positions, faces, uv, uv_faces, image, clip_from_model,
                                       WIDTH, HEIGHT, background, opposite, filter)

    def backward(grad_picture, buffers, positions, uv, image, clip_from_model):
        return inverse.render_textured_backward(grad_picture, buffers, positions, faces, uv,
                                                uv_faces, image, clip_from_model, opposite, filter)

    def decisions(buffers, positions, uv, *_):
        clip, face_index, depth, *at, _ = buffers
        at, footprint = inverse.footprints(uv, uv_faces, face_index, *at)
        level = texturing.mip_level(footprint, 8, 16) if "mipmap" in filter else np.zeros(len(at))
        level = np.floor(np.clip(level, 0, 4))[:, None]
        texels = [np.floor(at * [8, 16] / 2**above - 0.5) for above in (level, level + 1)]
        return *decided(clip, face_index, depth, faces, opposite), level, *texels

    whole_gradcheck(f"textured, {filter}", render, backward, decisions,
                    (positions, uv, image, clip_from_model), [[0, 3, 6], [0, 5, 9], [4, 11]])


def test_a_texture_of_one_colour_is_a_mesh_of_one_colour():
    """The two pictures differ in more than in where the colour comes from."""
    positions, faces, _, clip_from_model, background, opposite = scene("torus")
    colour = np.array([0.2, 0.9])
    colours, image = np.tile(colour, (len(positions), 1)), np.tile(colour, (4, 8, 1))
    expected, _ = inverse.render(positions, faces, colours, clip_from_model, WIDTH, HEIGHT,
                                 background, opposite)
    got, _ = inverse.render_textured(positions, faces, positions[:, :2], faces, image,
                                     clip_from_model, WIDTH, HEIGHT, background, opposite)
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-12)


# --- stuck, and not ----------------------------------------------------------------------------

@pytest.mark.parametrize("name", SCENES)
def test_without_antialiasing_a_mesh_of_one_colour_has_exactly_no_gradient(name):
    """Rounding goes for a gradient: nobody can tell any more that the mesh is stuck."""
    positions, faces, colours, clip_from_model, background, _ = scene(name)
    colours[:] = 0.1, 0.7
    clip = transforms.transform(transforms.to_homogeneous(positions), clip_from_model)
    colour, face_index, _, barycentric = inverse.shade(clip, faces, colours, WIDTH, HEIGHT,
                                                       background)
    upstream = np.random.default_rng(0).normal(size=colour.shape)
    grad_clip, grad_colours = inverse.shade_backward(upstream, clip, faces, colours, face_index,
                                                     barycentric)
    np.testing.assert_array_equal(grad_clip, 0)
    assert grad_colours.any()


def test_a_triangle_finds_its_template_with_antialiasing_alone():
    """The gradient leads away, or ends too early; or the picture without it had one all along."""
    template = np.array([[-0.6, -0.55, 0.0], [0.7, -0.3, 0.0], [-0.1, 0.65, 0.0]])
    start = np.array([[-0.4, -0.3, 0.0], [0.45, -0.45, 0.0], [0.15, 0.45, 0.0]])
    faces, white, black, still = np.array([[0, 1, 2]]), np.ones((3, 1)), np.zeros(1), np.eye(4)
    opposite = antialiasing.opposite_vertices(faces)

    def render(positions):
        return inverse.render(positions, faces, white, still, WIDTH, HEIGHT, black, opposite)

    target, _ = render(template)
    positions, mean, square = start, np.zeros((3, 3)), np.zeros((3, 3))
    for step in range(1, 201):
        picture, buffers = render(positions)
        grad_picture = inverse.squared_error_backward(1.0, picture, target)
        gradient, *_ = inverse.render_backward(grad_picture, buffers, positions, faces, white,
                                               still, opposite)
        clip, face_index, _, barycentric, colour = buffers
        grad_aliased = inverse.squared_error_backward(1.0, colour, target)
        grad_clip, _ = inverse.shade_backward(grad_aliased, clip, faces, white, face_index,
                                              barycentric)
        np.testing.assert_array_equal(grad_clip, 0)
        positions, mean, square = inverse.adam_step(positions, gradient, mean, square, step,
                                                    0.03 * 0.98**step)
    off = (positions - template)[:, :2] * [WIDTH / 2, HEIGHT / 2]
    assert np.linalg.norm(off, axis=1).max() < 0.1


def test_what_two_ways_do_to_a_position_adds_up():
    """A picture of colours inside of one face has one way alone, a silhouette the other."""
    positions, faces, colours, clip_from_model, background, opposite = scene("cube")
    picture, buffers = inverse.render(positions, faces, colours, clip_from_model, WIDTH, HEIGHT,
                                      background, opposite)
    clip, face_index, depth, barycentric, _ = buffers
    arguments = positions, faces, colours, clip_from_model, opposite
    inside = np.zeros(picture.shape)
    blended = antialiasing.blended_pairs(face_index, depth, clip, faces, opposite)[:2]
    untouched = np.setdiff1d(np.flatnonzero(face_index >= 0), np.concatenate(blended))
    assert len(untouched) > 20
    inside.reshape(-1, 2)[untouched] = 1.0
    got, *_ = inverse.render_backward(inside, buffers, *arguments)
    grad_clip, _ = inverse.shade_backward(inside, clip, faces, colours, face_index, barycentric)
    np.testing.assert_allclose(got, (grad_clip @ clip_from_model)[:, :3], rtol=1e-12, atol=1e-12)


def test_the_gradient_of_a_depth_is_added():
    """grad_depth is dropped, or takes the place of the picture's gradient."""
    positions, faces, colours, clip_from_model, background, opposite = scene("cube")

    def render(positions, clip_from_model):
        picture, buffers = inverse.render(positions, faces, colours, clip_from_model, WIDTH, HEIGHT,
                                          background, opposite)
        _, face_index, depth, *_ = buffers
        return np.dstack([picture, np.where(face_index >= 0, depth, 0)]), buffers

    def backward(grad, buffers, positions, clip_from_model):
        grad_positions, _, grad_matrix = inverse.render_backward(
            grad[..., :2], buffers, positions, faces, colours, clip_from_model, opposite,
            grad[..., 2])
        return grad_positions, grad_matrix

    def decisions(buffers, *_):
        return decided(*buffers[:3], faces, opposite)

    whole_gradcheck("picture and depth", render, backward, decisions, (positions, clip_from_model),
                    [[0, 3, 6]])


# --- the regularizer ---------------------------------------------------------------------------

def test_the_energy_of_a_laplacian_has_a_gradient():
    """The 2 is missing, or grad_energy."""
    positions, faces = mesh.icosphere(80)
    edges, _ = mesh.edges(faces)
    gradcheck(inverse.laplacian_energy, inverse.laplacian_energy_backward, (positions, edges),
              differentiable=[0], name="laplacian_energy")


def test_a_rough_mesh_has_more_energy():
    """The sign: a fit would roughen its mesh."""
    positions, faces = mesh.icosphere(320)
    edges, _ = mesh.edges(faces)
    rough = positions + np.random.default_rng(0).normal(0, 0.05, positions.shape)
    smooth, rougher = (inverse.laplacian_energy(x, edges) for x in (positions, rough))
    gradient = inverse.laplacian_energy_backward(1.0, rough, edges)
    smoothed = inverse.laplacian_energy(rough - 0.1 * gradient, edges)
    assert smooth < smoothed < rougher


# --- what comes in -----------------------------------------------------------------------------

def test_a_picture_without_faces_is_the_background():
    """An error, or black, where nothing is to be seen."""
    empty, no_faces = np.zeros((0, 3)), np.zeros((0, 3), int)
    background = np.array([0.3, 0.6])
    arguments = empty, no_faces, np.zeros((0, 2)), camera()
    picture, buffers = inverse.render(*arguments, WIDTH, HEIGHT, background, no_faces)
    np.testing.assert_array_equal(picture, np.broadcast_to(background, (HEIGHT, WIDTH, 2)))
    grads = inverse.render_backward(picture, buffers, *arguments, no_faces)
    assert [grad.shape for grad in grads] == [(0, 3), (0, 2), (4, 4)] and not grads[2].any()


GOOD = {"positions": np.zeros((3, 3)), "faces": np.array([[0, 1, 2]]), "colours": np.zeros((3, 2)),
        "clip_from_model": np.eye(4), "background": np.zeros(2), "opposite": np.full((1, 3), -1),
        "width": 5, "height": 4}
BAD = [("positions", np.zeros((3, 4)), r"positions \(V, 3\).*got \(3, 4\)"),
       ("positions", np.full((3, 3), np.nan), "finite.*NaN"),
       ("faces", np.array([[0.0, 1.0, 2.0]]), "integers.*float64"),
       ("faces", np.array([0, 1, 2]), r"faces \(F, 3\).*got \(3,\)"),
       ("faces", np.array([[0, 1, 3]]), "from 0 to 2.*got 0 to 3"),
       ("faces", np.array([[-1, 1, 2]]), "from 0 to 2.*got -1 to 2"),
       ("colours", np.zeros(3), r"colours \(3, C\).*grey\[:, None\]"),
       ("colours", np.zeros((4, 2)), r"colours \(3, C\).*got \(4, 2\)"),
       ("clip_from_model", np.eye(3), r"clip_from_model \(4, 4\).*got \(3, 3\)"),
       ("background", np.zeros(3), r"background \(2,\).*got \(3,\)"),
       ("background", 0.0, r"background \(2,\).*got a float"),
       ("background", np.array([0.0, np.inf]), "background .*finite.*NaN or infinity"),
       ("positions", [[0.0, 0.0, 0.0]] * 3, r"positions \(V, 3\).*got a list"),
       ("positions", np.zeros((3, 3), complex), "positions.*got complex128"),
       ("positions", np.zeros((0, 3)), "faces|colours"),
       ("colours", None, "colours.*got a NoneType"),
       ("colours", np.full((3, 2), np.nan), "colours.*finite.*NaN"),
       ("colours", np.zeros((3, 0)), "colours of one channel or more"),
       ("clip_from_model", np.full((4, 4), np.inf), "clip_from_model.*finite.*NaN or infinity"),
       ("width", 5.0, "width, an integer.*got 5.0"),
       ("height", -3, "height, an integer.*got -3"),
       ("height", None, "height, an integer.*got None"),
       ("opposite", np.full((1, 3), -1.0), "opposite.*integers.*got float64"),
       ("opposite", np.full((1, 3), 99), "opposite.*from -1 to 2.*got 99 to 99"),
       ("opposite", np.full((2, 3), -1), r"opposite \(1, 3\).*opposite_vertices.*got \(2, 3\)")]

TEXTURED = {"uv": np.zeros((3, 2)), "uv_faces": np.array([[0, 1, 2]]), "image": np.zeros((2, 2, 2))}
BAD_TEXTURED = [("uv", np.zeros((3, 3)), r"uv \(T, 2\).*got \(3, 3\)"),
                ("uv", np.full((3, 2), np.nan), "uv.*finite.*NaN"),
                ("uv_faces", np.array([[0, 1, 3]]), "uv_faces.*from 0 to 2, rows of uv.*0 to 3"),
                ("uv_faces", np.array([[-1, 1, 2]]), "uv_faces.*got -1 to 2"),
                ("uv_faces", np.zeros((2, 3), int), r"uv_faces \(1, 3\).*got \(2, 3\)"),
                ("image", np.zeros((4, 8)), r"image \(h, w, C\).*got \(4, 8\)"),
                ("image", np.array(0.5), r"image \(h, w, C\).*got \(\)"),
                ("image", np.full((2, 2, 2), np.nan), "image.*finite.*NaN"),
                ("image", np.zeros((2, 2, 0)), "image of one channel or more"),
                ("background", np.zeros(3), r"background \(2,\).*got \(3,\)")]


@pytest.mark.parametrize("name, bad, sentence", BAD)
def test_render_says_in_one_sentence_what_does_not_fit(name, bad, sentence):
    """A traceback from the depths of NumPy, or a picture of nonsense."""
    inputs = {**GOOD, name: bad}
    with pytest.raises(ValueError, match=sentence) as error:
        inverse.render(**inputs)
    assert "\n" not in str(error.value)
    if name in ("positions", "background", "opposite"):
        del inputs["colours"]
        with pytest.raises(ValueError, match=sentence):
            inverse.render_textured(**inputs, **TEXTURED)


@pytest.mark.parametrize("name, bad, sentence", BAD_TEXTURED)
def test_render_textured_says_what_does_not_fit(name, bad, sentence):
    """A wrong uv_faces reads memory that is not uv's."""
    inputs = {**GOOD, **TEXTURED, name: bad}
    del inputs["colours"]
    with pytest.raises(ValueError, match=sentence):
        inverse.render_textured(**inputs)


def test_a_gradient_of_another_shape_is_told():
    """A transposed gradient of a picture is taken for what it is not."""
    positions, faces, colours, clip_from_model, background, opposite = scene("cube")
    mesh_and_camera = positions, faces, colours, clip_from_model
    picture, buffers = inverse.render(*mesh_and_camera, WIDTH, HEIGHT, background, opposite)
    with pytest.raises(ValueError, match=r"grad_picture \(19, 26, 2\).*got \(26, 19, 2\)"):
        inverse.render_backward(picture.swapaxes(0, 1), buffers, *mesh_and_camera, opposite)
    with pytest.raises(ValueError, match=r"grad_depth \(19, 26\).*got \(26, 19\)"):
        inverse.render_backward(picture, buffers, *mesh_and_camera, opposite, buffers[2].T)
    uv, image = np.zeros((len(positions), 2)), np.zeros((4, 4, 2))
    textured = positions, faces, uv, faces, image, clip_from_model
    picture, buffers = inverse.render_textured(*textured, WIDTH, HEIGHT, background, opposite)
    with pytest.raises(ValueError, match=r"grad_picture \(19, 26, 2\).*got \(19, 26\)"):
        inverse.render_textured_backward(picture[..., 0], buffers, *textured, opposite)


def test_a_good_scene_is_rendered():
    """The checks refuse what fits."""
    picture, _ = inverse.render(**GOOD)
    assert picture.shape == (4, 5, 2)
    picture, _ = inverse.render(**{**GOOD, "width": np.int64(0)})
    assert picture.shape == (4, 0, 2)
    face_index, _ = scanline.rasterize(np.zeros((3, 4)), GOOD["faces"], 5, 4)
    assert (face_index == -1).all()
