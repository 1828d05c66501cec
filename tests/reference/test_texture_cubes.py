"""The reference's whole pictures of lab 10: cubes, light, and all of it together."""
import numpy as np
import pytest
from loose_faces import CAMERA
from screen_scenes import camera

from course.given import mesh
from course.given.gradcheck import gradcheck
from reference import interpolation, neural_renderer, pipeline, texture_cubes
from reference.sweep_gradient import sweep_backward
from tests.labs.test_texturing import four_texels

BACKGROUND = np.array([0.1, 0.2])


@pytest.mark.parametrize("face", [-1, 2])
def test_a_pixel_that_sees_no_face_has_no_cube(face):
    """A pixel of the background reads, and writes, beside the cubes."""
    textures, tap = np.ones((2, 2, 2, 2, 1)), np.full((1, 8), 1 / 8)
    look = textures, np.array([face]), np.arange(8)[None], tap
    for call in (lambda: texture_cubes.sample_cubes(*look),
                 lambda: texture_cubes.sample_cubes_backward(np.ones((1, 1)), *look)):
        with pytest.raises(IndexError, match="of 16, counted from 0: leave out pixels that see no"):
            call()


def test_a_linear_picture_comes_back_in_perspective():
    """A cube read without z / z_k bends the picture. Texels beside the face hold other values."""
    clip = np.array([[-1.0, -1.0, 0, 1.0], [4.0, -3.5, 0, 5.0], [2.0, 2.4, 0, 2.5],
                     [-1.2, 2.0, 0, 3.0]])
    faces, uv = np.array([[0, 1, 2], [0, 2, 3]]), np.array([[0.0, 0.0], [1, 0], [1, 1], [0, 1]])
    corners = neural_renderer.corners_of(clip, faces)
    for size in 2, 3, 5:
        textures = texture_cubes.texel_barycentrics(size).reshape(-1, 3) @ uv[faces]
        textures = textures.reshape(2, size, size, size, 2)
        maps = neural_renderer.rasterize(corners, 32, 24)
        got = texture_cubes.shade_cubes(maps, corners, textures, np.ones((2, 2)), np.zeros(2))
        face_index = maps.face_index
        barycentric = interpolation.barycentrics(face_index, clip, faces)
        expected = interpolation.interpolate(uv, faces, face_index, barycentric)
        assert (face_index >= 0).sum() > 200
        np.testing.assert_allclose(got, expected, atol=1e-9)


def test_a_photograph_is_baked_where_uv_say(rng):
    """Image axes swapped, or texels at corners that are not those of uv."""
    image, uv = rng.random((8, 16, 3)), np.array([[0.1, 0.2], [0.8, 0.3], [0.4, 0.9]])
    cube = texture_cubes.bake(image, uv, np.array([[0, 1, 2]]), 4)[0]
    assert cube.shape == (4, 4, 4, 3)
    for corner, texel in zip(uv, (cube[3, 0, 0], cube[0, 3, 0], cube[0, 0, 3]), strict=True):
        index, weight, _ = four_texels(corner, 16, 8, "clamp")
        expected = weight @ image.reshape(-1, 3)[index.astype(int)]
        np.testing.assert_allclose(texel, expected, atol=1e-12)


def test_from_behind_a_face_looks_mirrored(rng):
    """Reversed corners with the cube's axes left in their order."""
    faces, textures = np.array([[0, 1, 2]]), rng.random((1, 3, 3, 3, 2))
    clip = np.array([[-0.9, -0.8, 0, 1.0], [0.9, -0.6, 0, 2.0], [0.3, 0.9, 0, 1.5]])
    both, cubes = texture_cubes.both_sides(faces, textures)
    light = np.ones((2, 2))

    def picture(clip):
        corners = neural_renderer.corners_of(clip, both)
        maps = neural_renderer.rasterize(corners, 24, 16)
        colour = texture_cubes.shade_cubes(maps, corners, cubes, light, BACKGROUND)
        return colour, maps.face_index

    front, front_index = picture(clip)
    back, back_index = picture(clip * [-1, 1, 1, 1])
    assert front_index.max() == 0 and back_index.max() == 1
    np.testing.assert_allclose(back[:, ::-1], front, atol=1e-12)


LIGHTS = texture_cubes.Lights(np.array([0.3, 0.2]), np.array([0.6, 0.9]), np.array([0.4, 0.7, 0.5]))


def test_faces_without_area_or_light_are_constant():
    """0 / 0 in a normal, which a sum over vertices spreads. Or what looks away is darkened."""
    lying = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 3.0], [2.0, 0.0, 0.0]])  # looks up
    corners = np.stack([lying, lying[::-1], np.ones((3, 3))])
    lights = LIGHTS._replace(towards=np.array([0.0, 2.0, 0.0]))
    got = texture_cubes.face_light(corners, *lights)
    np.testing.assert_allclose(got, LIGHTS.ambient + [[1.2, 1.8], [0, 0], [0, 0]])
    grads = texture_cubes.face_light_backward(np.ones((3, 2)), corners, *lights)
    assert not grads[0].any()
    np.testing.assert_allclose(np.concatenate(grads[1:]), [3, 3, 2, 2, 0, 1.5, 0])


def ball(rng):
    """A small ball, and a View of it."""
    vertices, faces = mesh.icosphere(20)
    textures = rng.random((len(faces), 2, 2, 2, 2))
    return (texture_cubes.LitMesh(vertices, faces, textures, LIGHTS),
            pipeline.View(CAMERA, 12, 8, BACKGROUND))


def test_a_pixel_is_the_mean_of_four(rng):
    """The sum, or one of the four."""
    scene, view = ball(rng)
    fine, _ = texture_cubes.render(scene, view._replace(width=24, height=16), samples=1)
    got, _ = texture_cubes.render(scene, view)
    np.testing.assert_allclose(got, fine.reshape(8, 2, 12, 2, 2).mean((1, 3)), atol=1e-12)


def gradients(grad_picture, scene, view):
    """Those of a scene that is drawn, and then pulled at."""
    _, buffers = texture_cubes.render(scene, view)
    return texture_cubes.render_backward(grad_picture, buffers, scene, view, sweep_backward)


def test_gradients_of_texels_and_lights_are_central_differences(rng):
    """Supersampling without its quarter, a light that is applied to the background."""
    scene, view = ball(rng)

    def lit(textures, lights):
        return scene._replace(textures=textures, lights=texture_cubes.Lights(*lights))

    def backward(grad_picture, textures, *lights):
        grads = gradients(grad_picture, lit(textures, lights), view)
        return grads.textures, *grads.lights

    gradcheck(lambda textures, *lights: texture_cubes.render(lit(textures, lights), view)[0],
              backward, (scene.textures, *LIGHTS), name="render")


def test_where_no_edge_is_in_sight_gradients_of_vertices_are_central_differences(rng):
    """A missing term of the divide, of the light's normals or of z."""
    vertices = np.array([[-30.0, -20.0, -2.0], [40.0, -25.0, 1.0], [0.5, 45.0, -6.0]])
    faces, textures = np.array([[0, 1, 2]]), rng.random((1, 2, 2, 2, 2))
    scene = texture_cubes.LitMesh(vertices, faces, textures, LIGHTS)
    view = pipeline.View(camera((0.0, 0.3, 9.0)), 9, 7, BACKGROUND)

    def backward(grad_picture, vertices):
        return (gradients(grad_picture, scene._replace(vertices=vertices), view).vertices,)

    assert (texture_cubes.render(scene, view)[1].maps.face_index == 0).all()
    gradcheck(lambda vertices: texture_cubes.render(scene._replace(vertices=vertices), view)[0],
              backward, (vertices,), name="vertices")


def test_edges_have_the_gradient_that_outline_gives(rng):
    """The sweep is left out, counted twice, or told of the pixels instead of the samples."""
    scene, view = ball(rng)
    picture, buffers = texture_cubes.render(scene, view)
    grad_picture, told = rng.normal(size=picture.shape), []

    def outline(*inputs):
        told.append(inputs)
        return np.full((len(scene.faces), 3, 3), 0.5) * [1, 1, 0]

    def backward(outline):
        return texture_cubes.render_backward(grad_picture, buffers, scene, view, outline).vertices

    got = backward(outline) - backward(lambda *_: 0)
    expected = neural_renderer.corners_backward(outline(), buffers.clip, scene.faces)
    by_vertex = expected @ view.clip_from_model
    np.testing.assert_allclose(got, by_vertex[:, :3], atol=1e-12)
    grad_colour, colour, face_index, corners = told[0]
    np.testing.assert_allclose(grad_colour[::2, ::2] * 4, grad_picture)
    assert colour.shape[:2] == face_index.shape == (16, 24) and corners.shape == (20, 3, 3)


def test_an_empty_picture_has_no_gradient(rng):
    """Division by no pixels at all."""
    scene, view = ball(rng)
    away = scene._replace(vertices=scene.vertices + [0.0, 0.0, 50.0])
    picture, _ = texture_cubes.render(away, view)
    np.testing.assert_allclose(picture, np.tile(BACKGROUND, (8, 12, 1)))
    grads = gradients(rng.normal(size=picture.shape), away, view)
    assert not grads.vertices.any() and not grads.textures.any()


@pytest.mark.parametrize(("wrong", "samples", "background"), [
    ({"textures": np.ones((19, 2, 2, 2, 2))}, 2, BACKGROUND),
    ({"textures": np.ones((20, 1, 1, 1, 2))}, 2, BACKGROUND),
    ({"lights": LIGHTS[:2]}, 2, BACKGROUND), ({}, 0, BACKGROUND), ({}, True, BACKGROUND),
    ({}, 2, np.zeros(3))])
def test_what_does_not_fit_is_told_in_one_sentence(rng, wrong, samples, background):
    """19 cubes for 20 faces drew a picture, or no samples were a picture of NaN."""
    scene, view = ball(rng)
    with pytest.raises(ValueError, match="expected "):
        texture_cubes.render(scene._replace(**wrong), view._replace(background=background), samples)


def test_a_side_in_pixels_may_be_a_byte(rng):
    """Its square, or twice as much, overflows."""
    scene, view = ball(rng)
    got, _ = texture_cubes.render(scene, view._replace(width=np.int8(70), height=np.int8(40)))
    expected, _ = texture_cubes.render(scene, view._replace(width=70, height=40))
    np.testing.assert_array_equal(got, expected)
