"""The whole pipeline, which joins the labs before lab 9: pictures and their gradients."""
import functools

import numpy as np
import pytest

from course.given import mesh
from course.given.gradcheck import gradcheck
from reference import interpolation, intersections, mipmapping, pipeline, transforms
from reference.pipeline import Colours, Mesh, Texture, View

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


def crossed_balls(rng):
    """Two balls of faces smaller than a pixel, which pass through each other."""
    ball, faces = mesh.icosphere(1_500)
    return (np.concatenate([0.6 * ball + [0.3, 0.1, 0.3], 0.8 * ball - [0.2, 0.1, 0.1]]),
            np.concatenate([faces, faces + len(ball)]))


SCENES = {"cube": (lambda rng: mesh.cube(12), camera()),
          "torus": (lambda rng: mesh.torus(150), camera(1.3, 4.0)),
          "soup": (soup, camera(0.2, 3.0)),
          "vertices behind the camera": (inside_out, camera(0.4, 1.5)),
          "crossed balls": (crossed_balls, camera()),
          "half a bunny": (half_a_bunny, camera(0.9, 2.5))}


def scene(name):
    """A Mesh, Colours of two channels and a View."""
    rng = np.random.default_rng(5)
    build, clip_from_model = SCENES[name]
    shape = pipeline.make_mesh(*build(rng))
    colours, background = rng.normal(size=(len(shape.positions), 2)), rng.normal(size=2)
    return shape, Colours(colours), View(clip_from_model, WIDTH, HEIGHT, background)


def decided(buffers):
    """What a picture decides: faces, pairs, edges, which pixel changes, what is saturated."""
    owner, other, c, ends, _, _, *faces = buffers.pairs
    return buffers.face_index, owner, other, ends, *faces, c > 0.5, (c > 0) & (c < 1)


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

    render(*arrays) -> picture, buffers, backward(grad_picture, buffers, *arrays),
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
    shape, material, view = scene(name)

    def given(positions, colours, clip_from_model):
        return (shape._replace(positions=positions), Colours(colours),
                view._replace(clip_from_model=clip_from_model))

    def render(*arrays):
        return pipeline.render(*given(*arrays))

    def backward(grad_picture, buffers, *arrays):
        grads = pipeline.render_backward(grad_picture, buffers, *given(*arrays))
        return grads.positions, grads.material.colours, grads.clip_from_model

    arrays = shape.positions, material.colours, view.clip_from_model
    clip, face_index, *_ = render(*arrays)[1]
    vertices = np.unique(shape.faces[face_index[face_index >= 0]])
    behind = vertices[clip[vertices, 3] < 0]
    met = intersections.meetings(render(*arrays)[1].pairs, clip)
    assert len(met.c) > 4 or name not in ("crossed balls", "soup")
    assert (len(behind) > 0) == (name == "vertices behind the camera")
    some = np.append(vertices[::len(vertices) // 4][:4], behind[:1])
    some = np.unique(np.append(some, shape.faces[intersections.meeting_faces(met)[:, :1]]))
    whole_gradcheck(name, render, backward, lambda buffers, *_: decided(buffers), arrays,
                    [some, some])


@pytest.mark.parametrize("filter_mode", ["linear", "linear-mipmap-linear"])
def test_the_gradients_of_a_textured_picture_are_central_differences(filter_mode):
    """The texture's or the footprint's way to the positions is left out."""
    rng = np.random.default_rng(2)
    shape, _, view = scene("cube")
    uv, uv_faces = rng.random((20, 2)), rng.permutation(np.arange(36) % 20).reshape(12, 3)
    image, background = rng.normal(size=(16, 8, 2)), rng.normal(size=2)

    def given(positions, uv, image, clip_from_model):
        return (shape._replace(positions=positions), Texture(uv, uv_faces, image, filter_mode),
                View(clip_from_model, WIDTH, HEIGHT, background))

    def render(*arrays):
        return pipeline.render(*given(*arrays))

    def backward(grad_picture, buffers, *arrays):
        grads = pipeline.render_backward(grad_picture, buffers, *given(*arrays))
        return grads.positions, grads.material.uv, grads.material.image, grads.clip_from_model

    def decisions(buffers, positions, uv, *_):
        derivatives = interpolation.barycentrics_derivatives(buffers.face_index, buffers.clip,
                                                             shape.faces)
        at, footprint = pipeline.footprints(uv, uv_faces, buffers, derivatives)
        level = np.where("mipmap" in filter_mode, mipmapping.mip_level(footprint, 8, 16), 0)
        level = np.floor(np.clip(level, 0, 4))[:, None]
        texels = [np.floor(at * [8, 16] / 2**above - 0.5) for above in (level, level + 1)]
        return *decided(buffers), level, *texels

    whole_gradcheck(f"textured, {filter_mode}", render, backward, decisions,
                    (shape.positions, uv, image, view.clip_from_model),
                    [[0, 3, 6], [0, 5, 9], [4, 11]])


# --- stuck, and not ----------------------------------------------------------------------------

@pytest.mark.parametrize("name", SCENES)
def test_without_antialiasing_a_mesh_of_one_colour_has_exactly_no_gradient(name):
    """Rounding goes for a gradient: nobody can tell any more that the mesh is stuck."""
    shape, material, view = scene(name)
    material.colours[:] = 0.1, 0.7
    _, buffers = pipeline.render(shape, material, view)
    upstream = np.random.default_rng(0).normal(size=buffers.colour.shape)
    grad_material, grad_clip = pipeline.interior_backward(upstream, buffers, shape.faces, material)
    np.testing.assert_array_equal(grad_clip, 0)
    assert grad_material.colours.any()


# --- what comes in -----------------------------------------------------------------------------

def test_a_picture_without_faces_is_the_background():
    """An error, or black, where nothing is to be seen."""
    empty = pipeline.make_mesh(np.zeros((0, 3)), np.zeros((0, 3), int))
    background = np.array([0.3, 0.6])
    given = empty, Colours(np.zeros((0, 2))), View(camera(), WIDTH, HEIGHT, background)
    picture, buffers = pipeline.render(*given)
    np.testing.assert_array_equal(picture, np.broadcast_to(background, (HEIGHT, WIDTH, 2)))
    positions, (colours,), matrix = pipeline.render_backward(picture, buffers, *given)
    assert [grad.shape for grad in (positions, colours, matrix)] == [(0, 3), (0, 2), (4, 4)]
    assert not matrix.any()


@pytest.mark.parametrize("dtype", [np.int16, np.uint16, np.uint32, np.uint64])
def test_faces_may_be_integers_of_any_kind(dtype):
    """Unsigned faces, as glTF files hold them, end in an OverflowError of NumPy."""
    shape, colours, view = scene("torus")
    image = np.random.default_rng(0).random((8, 4, 2))

    def rendered_and_back(faces):
        same = pipeline.make_mesh(shape.positions, faces)._replace(faces=faces)
        for material in (colours, Texture(shape.positions[:, :2], faces, image)):
            picture, buffers = pipeline.render(same, material, view)
            yield picture
            yield pipeline.render_backward(picture, buffers, same, material, view).positions

    expected = rendered_and_back(shape.faces)
    for got, wanted in zip(rendered_and_back(shape.faces.astype(dtype)), expected, strict=True):
        np.testing.assert_array_equal(got, wanted)


def test_a_mesh_is_made_of_integers():
    """Floats are cut off to integers, and nobody sees it any more."""
    with pytest.raises(ValueError, match=r"integers from 0 to 2.*of float64"):
        pipeline.make_mesh(np.zeros((3, 3)), np.array([[0.9, 1.9, 2.9]]))


@pytest.mark.parametrize("name", SCENES)
def test_the_outline_belongs_to_these_faces_in_this_order(name):
    """Faces are sorted, or their corners turned, and opposite is still that of before."""
    shape, surface, view = scene(name)
    pipeline.render(shape, surface, view)
    order = np.random.default_rng(0).permutation(len(shape.faces))
    swapped = np.arange(len(order))
    swapped[[0, -1]] = swapped[[-1, 0]]
    for faces in (shape.faces[order], shape.faces[::-1], shape.faces[:, [1, 2, 0]],
                  shape.faces[swapped]):
        with pytest.raises(ValueError, match="of these faces in this order; make_mesh does that"):
            pipeline.render(shape._replace(faces=faces), surface, view)
        pipeline.render(pipeline.make_mesh(shape.positions, faces), surface, view)
    shape.faces[:] = shape.faces[:, [1, 2, 0]]  # in place, after it was found sound
    with pytest.raises(ValueError, match="of these faces in this order; make_mesh does that"):
        pipeline.render(shape, surface, view)


@pytest.mark.parametrize("seed", range(20))
def test_every_mesh_that_is_made_is_rendered(seed):
    """Faces upon each other, edges of many faces and vertices named twice count as a mistake."""
    rng = np.random.default_rng(seed)
    faces = rng.integers(0, 5, (seed, 3))
    faces = np.concatenate([faces, faces[:, ::-1], faces[:4]]).astype(rng.choice(["u1", "i8"]))
    shape = pipeline.make_mesh(rng.normal(size=(5, 3)), faces)
    view = View(camera(), WIDTH, HEIGHT, np.zeros(1))
    pipeline.render(shape._replace(faces=faces), Colours(np.ones((5, 1))), view)


GOOD = {"positions": np.zeros((3, 3)), "faces": np.array([[0, 1, 2]]), "colours": np.zeros((3, 2)),
        "clip_from_model": np.eye(4), "background": np.zeros(2), "opposite": np.full((1, 3), -1),
        "width": 5, "height": 4}
BAD = [("positions", np.zeros((3, 4)), r"positions \(V, 3\).*got \(3, 4\)"),
       ("positions", np.full((3, 3), np.nan), "finite.*NaN"),
       ("faces", np.array([[0.0, 1.0, 2.0]]), "integers.*float64"),
       ("faces", np.array([[0, 1, 3]]), "from 0 to 2.*got 0 to 3"),
       ("colours", np.zeros(3), r"colours \(3, C\).*grey\[:, None\]"),
       ("colours", np.zeros((4, 2)), r"colours \(3, C\).*got \(4, 2\)"),
       ("clip_from_model", np.eye(3), r"clip_from_model \(4, 4\).*got \(3, 3\)"),
       ("background", np.zeros(3), r"background \(2,\).*got \(3,\)"),
       ("positions", [[0.0, 0.0, 0.0]] * 3, r"positions \(V, 3\).*got a list"),
       ("positions", np.zeros((3, 3), complex), "positions.*got complex128"),
       ("colours", None, "colours.*got a NoneType"),
       ("colours", np.zeros((3, 0)), "colours of one channel or more"),
       *((side, size, f"{side}, an integer.*got {size}") for side, size in (
           ("width", 5.0), ("height", -3), ("height", None), ("width", True))),
       ("opposite", np.full((1, 3), -1.0), "opposite.*integers.*got float64"),
       ("opposite", np.full((1, 3), 99), "opposite.*from -1 to 2.*got 99 to 99"),
       ("opposite", np.full((2, 3), -1), r"opposite \(1, 3\).*opposite_corners.*got \(2, 3\)")]

TEXTURED = {"uv": np.zeros((3, 2)), "uv_faces": np.array([[0, 1, 2]]), "image": np.zeros((2, 2, 2))}
BAD_TEXTURED = [("uv", np.zeros((3, 3)), r"uv \(T, 2\).*got \(3, 3\)"),
                ("uv_faces", np.array([[0, 1, 3]]), "uv_faces.*from 0 to 2, rows of uv.*0 to 3"),
                ("uv_faces", np.zeros((2, 3), int), r"uv_faces \(1, 3\).*got \(2, 3\)"),
                ("image", np.zeros((4, 8)), r"image \(h, w, C\).*got \(4, 8\)"),
                ("image", np.zeros((2, 2, 0)), "image of one channel or more")]


def rendered(inputs):
    """`render` of a scene whose parts come by name, with Colours or a Texture."""
    kind = Texture if "uv" in inputs else Colours
    parts = [[inputs[name] for name in part._fields if name in inputs]
             for part in (Mesh, kind, View)]
    return pipeline.render(Mesh(*parts[0]), kind(*parts[1]), View(*parts[2]))


@pytest.mark.parametrize("given, name, bad, sentence", [
    *((GOOD, *row) for row in BAD), *(({**GOOD, **TEXTURED}, *row) for row in BAD_TEXTURED)])
def test_render_says_in_one_sentence_what_does_not_fit(given, name, bad, sentence):
    """A traceback from the depths of NumPy, or a picture of nonsense. Or a wrong uv_faces reads
    memory that is not uv's.
    """
    inputs = {**given, name: bad}
    with pytest.raises(ValueError, match=sentence) as error:
        rendered(inputs)
    assert "\n" not in str(error.value)
    if name in ("positions", "background", "opposite"):
        with pytest.raises(ValueError, match=sentence):
            rendered({**inputs, **TEXTURED})


def test_a_bare_array_is_no_material():
    """An AttributeError, where somebody forgot whether the array holds colours or a texture."""
    shape, material, view = scene("cube")
    with pytest.raises(ValueError, match=r"a material, Colours or a Texture.*got a ndarray"):
        pipeline.render(shape, material.colours, view)


def test_a_gradient_of_another_shape_is_told():
    """A transposed gradient of a picture is taken for what it is not."""
    shape, material, view = scene("cube")
    picture, buffers = pipeline.render(shape, material, view)
    given = buffers, shape, material, view
    with pytest.raises(ValueError, match=r"grad_picture \(19, 26, 2\).*got \(26, 19, 2\)"):
        pipeline.render_backward(picture.swapaxes(0, 1), *given)
    with pytest.raises(ValueError, match=r"grad_depth \(19, 26\).*got \(26, 19\)"):
        pipeline.render_backward(picture, *given, buffers.depth.T)
    texture = Texture(np.zeros((len(shape.positions), 2)), shape.faces, np.zeros((4, 4, 2)))
    picture, buffers = pipeline.render(shape, texture, view)
    with pytest.raises(ValueError, match=r"grad_picture \(19, 26, 2\).*got \(19, 26\)"):
        pipeline.render_backward(picture[..., 0], buffers, shape, texture, view)


def test_a_material_that_does_not_fit_the_picture_is_told():
    """Gradients of another shape come back, or compiled code reads beside an array."""
    shape, surface, view = scene("cube")
    picture, buffers = pipeline.render(shape, surface, view)
    texture = Texture(np.zeros((8, 2)), shape.faces[1:], np.zeros((4, 4, 2)))
    for material, told in ((Colours(surface.colours[:2]), r"colours \(8, 2\); got \(2, 2\)"),
                           (Colours(surface.colours[:, :1]), r"colours \(8, 2\); got \(8, 1\)"),
                           (texture, r"uv_faces \(12, 3\); got \(11, 3\)")):
        with pytest.raises(ValueError, match=told):
            pipeline.render_backward(picture, buffers, shape, material, view)


def test_buffers_are_a_tuple_with_names():
    """Where numba is, they are something else: no index, no _replace."""
    _, buffers = pipeline.render(*scene("cube"))
    assert isinstance(buffers, pipeline.Buffers)
    assert buffers[1] is buffers.face_index and len(buffers) == 6
    assert buffers._replace(depth=None).depth is None


@pytest.mark.parametrize("kind", [np.int8, np.uint8, np.int16, np.uint16, np.int64])
def test_a_side_in_pixels_may_be_of_any_integers(kind):
    """100 times 100 overflows where a byte holds each of them."""
    size = min(np.iinfo(kind).max // 2, 300)
    given = {**GOOD, "positions": np.array([[-1.0, -1, 0], [1, -1, 0], [-1, 1, 0]]),
             "colours": np.ones((3, 2))}
    expected, _ = rendered({**given, "width": size, "height": size})
    got, _ = rendered({**given, "width": kind(size), "height": kind(size)})
    np.testing.assert_array_equal(got, expected)
