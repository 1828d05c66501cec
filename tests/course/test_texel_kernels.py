"""The kernels of textures: the numbers of the functions that they stand for, on any threads."""
from inspect import unwrap

import numpy as np
import pytest
from screen_scenes import soup

from course.given import compiled, mesh
from reference import (
    compiled_pipeline,
    footprint_kernels,
    interpolation,
    mipmapping,
    pipeline,
    pyramid_kernels,
    rasterizer_gradients,
    texel_kernels,
    texturing,
    transforms,
)

SHAPES = (8, 16, 3), (1, 1, 3), (12, 4, 3), (1, 8, 3), (5, 8, 5)
whole = pytest.mark.parametrize("filter_mode", texturing.FILTERS)
anywhere = pytest.mark.parametrize("boundary", texturing.BOUNDARIES)


def places(rng):
    """uv, jacobian and bias: far away, on texels' borders and centres, and levels of all sizes."""
    uv = rng.uniform(-2, 3, (24, 2))
    uv[:4] = [-0.0, 1 - 2.0**-53], [-1 + 2.0**-53, 2.0**-53], [1e300, -1e300], [1.0, -1.0]
    uv[4:14] = rng.integers(-32, 33, (10, 2)) / 16
    jacobian = rng.normal(size=(24, 2, 2)) * 10 ** rng.uniform(-3, 1, (24, 1, 1))
    jacobian[:2], jacobian[2] = 0, jacobian[2] * 1e55
    jacobian[3:5] = np.eye(2) / 8  # levels that are whole numbers
    return uv, jacobian, np.where(np.arange(24) < 5, 0, rng.normal(size=24))


def footprints(rng):
    """Arguments of a look-up, with a jacobian or without one."""
    uv, jacobian, bias = places(rng)
    return (uv, jacobian, 0.0), (uv, jacobian, bias), (uv, None, bias), (uv[:0], jacobian[:0], 0.0)


def require_near(got, expected, what=""):
    """To 1e-12 of the greatest number, and to 1e-15 where all cancel."""
    for one, other in zip(got, expected, strict=True):
        assert np.shape(one) == np.shape(other), what
        if other is not None and np.size(other):
            np.testing.assert_allclose(one, other, rtol=0, err_msg=what,
                                       atol=1e-12 * np.abs(other).max() + 1e-15)


def require_same_bits_on_any_threads(monkeypatch, drawn):
    """Of the arrays that drawn() gives, in small bands."""
    monkeypatch.setattr(pyramid_kernels, "STEP", 7)
    found = []
    for threads in 1, 2, 3:
        monkeypatch.setattr(compiled, "cores", lambda threads=threads: threads)
        found.append([array.tobytes() for array in drawn()])
    assert found == [found[0]] * 3


@anywhere
@whole
def test_colours_are_numpys_to_the_bit(filter_mode, boundary):
    """Another order of a sum, another texel at a border, another logarithm."""
    rng = np.random.default_rng(0)
    for shape in SHAPES:
        image = rng.normal(size=shape)
        for footprint in footprints(rng):
            for max_level in (None, 1):
                given = image, *footprint, filter_mode, boundary, max_level
                expected = unwrap(mipmapping.texture)(*given)
                got = texel_kernels.texture(*given)
                assert got.shape == expected.shape and got.tobytes() == expected.tobytes(), shape


@whole
def test_texels_that_are_not_finite_spoil_the_same_pixels(filter_mode):
    """0 times infinity is left out, so that a pixel looks sound."""
    rng = np.random.default_rng(1)
    uv, jacobian, bias = places(rng)
    for spoilt in (np.inf, np.nan):
        image = np.where(rng.random((8, 16, 3)) < 0.05, spoilt, rng.random((8, 16, 3)))
        with np.errstate(invalid="ignore"):
            expected = unwrap(mipmapping.texture)(image, uv, jacobian, bias, filter_mode)
            got = texel_kernels.texture(image, uv, jacobian, bias, filter_mode)
        np.testing.assert_array_equal(got, expected)
    assert np.isnan(expected).any() and np.isfinite(expected).any()


@anywhere
@whole
def test_gradients_are_numpys(filter_mode, boundary):
    """One of the four gradients, at a border, at a clamped level, or where J = 0."""
    rng = np.random.default_rng(2)
    for shape in SHAPES:
        image = rng.normal(size=shape)
        for footprint in footprints(rng):
            given = (rng.normal(size=(len(footprint[0]), shape[2])), image, *footprint, filter_mode,
                     boundary)
            expected = unwrap(mipmapping.texture_backward)(*given)
            require_near(texel_kernels.texture_backward(*given), expected, str(shape))


@whole
def test_no_number_of_threads_changes_a_bit(filter_mode, monkeypatch):
    """Two threads add to one texel, or in another order."""
    rng = np.random.default_rng(3)
    given = rng.normal(size=(8, 16, 3)), *places(rng), filter_mode, "wrap", None
    upstream = rng.normal(size=(24, 3))
    require_same_bits_on_any_threads(monkeypatch, lambda: [
        texel_kernels.texture(*given), *texel_kernels.texture_backward(upstream, *given)])


@pytest.mark.parametrize("change", [{"filter_mode": "cubic"}, {"uv": np.full((5, 2), np.inf)},
                                    {"jacobian": np.full((5, 2, 2), 1e160)}, {"max_level": -1}])
def test_bad_input_is_told_in_the_same_sentence(change):
    """Kernels read beside their arrays."""
    given = {"image": np.zeros((4, 4, 3)), "uv": np.zeros((5, 2))} | change
    with pytest.raises(ValueError, match="texture expects") as expected:
        unwrap(mipmapping.texture)(**given)
    with pytest.raises(ValueError) as got:
        texel_kernels.texture(**given)
    assert str(got.value) == str(expected.value)


# --- from the mesh to the look-up, and back ----------------------------------------------------

def inside_a_sphere(face_count=80, width=17, height=13):
    """Buffers of a camera in a sphere, so that some seen faces are in part behind it, the faces,
    and a Texture with seams.
    """
    rng = np.random.default_rng(4)
    vertices, faces = mesh.icosphere(face_count)
    projection = transforms.perspective(1.5, width / height, 0.1, 10.0)
    clip = pipeline.to_clip(vertices + [0.2, 0.1, -0.3], projection)
    uv, uv_faces = rng.uniform(-1, 2, (60, 2)), rng.integers(0, 60, faces.shape)
    return (pipeline.visible(clip, faces, width, height), faces,
            pipeline.Texture(uv, uv_faces, rng.normal(size=(16, 8, 3))))


def soup_of_faces(behind):
    rng = np.random.default_rng(5)
    clip, faces = soup(rng, behind)
    uv, uv_faces = rng.random((40, 2)), rng.integers(0, 40, faces.shape)
    return (pipeline.visible(clip, faces, 16, 15), faces,
            pipeline.Texture(uv, uv_faces, rng.normal(size=(8, 8, 2)), "linear"))


SCENES = {"camera in a sphere": inside_a_sphere, "soup": lambda: soup_of_faces(False),
          "soup behind the camera": lambda: soup_of_faces(True)}
each_scene = pytest.mark.parametrize("scene", SCENES)


def through_numpy(monkeypatch, seen, faces, material, grad_colour):
    """The pipeline's own steps: at, footprint, colour, gradients of the Texture and of clip."""
    for name in "texture", "texture_backward":
        monkeypatch.setattr(mipmapping, name, unwrap(getattr(mipmapping, name)))
    derivatives = interpolation.barycentrics_derivatives(seen.face_index, seen.clip, faces)
    grads, *weights = pipeline.textured_backward(grad_colour, seen, faces, material)
    grad_clip = rasterizer_gradients.rasterize_backward(*weights, None, seen.face_index, seen.clip,
                                                        faces)
    return (*pipeline.footprints(material.uv, material.uv_faces, seen, derivatives),
            pipeline.textured(seen, faces, material), grads, grad_clip)


def require_the_pipelines_numbers(monkeypatch, seen, faces, material):
    grad_colour = np.random.default_rng(6).normal(size=(*seen.face_index.shape,
                                                        material.image.shape[2]))
    at, footprint, colour, grads, grad_clip = through_numpy(monkeypatch, seen, faces, material,
                                                            grad_colour)
    given = seen.clip, seen.face_index
    got = footprint_kernels.footprints(*given, faces, material.uv, material.uv_faces,
                                       footprint_kernels.runs_in_bands(seen.face_index))
    assert [array.tobytes() for array in got] == [at.tobytes(), footprint.tobytes()]
    got = compiled_pipeline.textured(*given, material, faces)
    assert got.shape == colour.shape and got.tobytes() == colour.tobytes()
    found, found_clip = compiled_pipeline.textured_backward(grad_colour, *given, material, faces)
    require_near([found.uv, found.image, found_clip], [grads.uv, grads.image, grad_clip])
    assert found.uv_faces is None and found.filter_mode is None


@each_scene
def test_a_textured_picture_and_its_gradients_are_the_pipelines(scene, monkeypatch):
    """A step between the faces and the texels: each has its own order, and its own derivative."""
    seen, faces, material = SCENES[scene]()
    vertices = faces[np.unique(seen.face_index[seen.face_index >= 0])]
    assert (seen.clip[vertices, 3] < 0).any() == (scene != "soup")
    require_the_pipelines_numbers(monkeypatch, seen, faces, material)


@pytest.mark.skipif(not compiled.is_installed(), reason="plain Python is too slow for it")
def test_a_larger_picture_is_the_pipelines(monkeypatch):
    """What runs in many bands, with many faces of which each covers few pixels."""
    seen, faces, material = inside_a_sphere(20_000, 300, 200)
    image = np.random.default_rng(7).normal(size=(256, 128, 3))
    require_the_pipelines_numbers(monkeypatch, seen, faces, material._replace(image=image))


def test_no_number_of_threads_changes_a_bit_of_a_textured_picture(monkeypatch):
    """Two threads add to one vertex, or a band's first pixel is another one's."""
    seen, faces, material = inside_a_sphere()
    given = seen.clip, seen.face_index, material, faces
    upstream = np.random.default_rng(8).normal(size=(13, 17, 3))

    def drawn():
        grads, grad_clip = compiled_pipeline.textured_backward(upstream, *given)
        return compiled_pipeline.textured(*given), grads.uv, grads.image, grad_clip

    require_same_bits_on_any_threads(monkeypatch, drawn)


def test_a_seen_face_with_a_corner_that_does_not_exist_is_an_index_error():
    """Kernels read beside uv. Faces that nobody sees may name anything."""
    seen, faces, material = inside_a_sphere()
    shown = seen.face_index[0, 0]
    hidden = np.setdiff1d(np.arange(len(faces)), seen.face_index)[0]
    for face in (hidden, shown):
        uv_faces = material.uv_faces.copy()
        uv_faces[face, 1] = 60
        given = (seen.clip, seen.face_index, faces, material.uv, uv_faces,
                 footprint_kernels.runs_in_bands(seen.face_index))
        if face == shown:
            with pytest.raises(IndexError, match="faces name rows"):
                footprint_kernels.footprints(*given)
        else:
            footprint_kernels.footprints(*given)
