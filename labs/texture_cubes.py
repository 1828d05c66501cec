"""texture_cubes: T^3 texels and one light for each face, and the picture that they make.

Pass 3 of neural_renderer. w and z are a pixel's weights and depth of eqs. (2) and (3), z_k the
depths of its face's corners.

    t_k = (T - 1) w_k z / z_k                  place in the face's cube of T^3 texels          (4)
    colour = sum over 8 taps of texel prod_k a_k,  a_k = t_k - low_k or 1 - that               (5)
    light = A + D max(0, n . l)                n: unit normal, l: towards the light            (6)

All of it has exact gradients, the face of each pixel taken as given. What an edge does to the
picture has none. `render_backward` takes an approximate one, such as sweep_gradient.py has.

Sources: Kato, Ushiku, Harada 2018, and a reading of their rasterizer, neural_renderer. Where it
does something else, the functions say so.
"""
from typing import NamedTuple

import numpy as np

from course.given import inputs

from . import mipmapping, msaa, neural_renderer, pipeline, texturing
from .rasterization import EDGES, scatter


class Lights(NamedTuple):
    """The light everywhere and the light from one side: ambient, directional (C,), towards (3,)."""

    ambient: np.ndarray
    directional: np.ndarray
    towards: np.ndarray


class Scene(NamedTuple):
    """vertices (V, 3), faces (F, 3), textures (F, T, T, T, C) and Lights.

    A Scene of gradients has None for its faces.
    """

    vertices: np.ndarray
    faces: np.ndarray
    textures: np.ndarray
    lights: Lights


class Buffers(NamedTuple):
    """What was found on the way to a picture: clip (V, 4), corners (F, 3, 3), light (F, C), the
    Maps, and the colour of each sample (samples H, samples W, C).
    """

    clip: np.ndarray
    corners: np.ndarray
    light: np.ndarray
    maps: neural_renderer.Maps
    colour: np.ndarray


# --- texture cubes ------------------------------------------------------------------------------


def cube_taps(weight, depth, z, size):  # exercise 10.6 (3 points)
    """Eqs. (4) and (5): which 8 texels of its face's cube a pixel reads, and their weights.

    weight (N, 3), depth (N,) of `rasterize`, z (N, 3) of the face's corners, size = T >= 2
    -> index (N, 8) integers, tap (N, 8). low_k is t_k rounded down, T - 2 at most. Tap n takes
    texel low_k if bit k of n (of value 1, 2, 4 for k = 0, 1, 2) is 0, and low_k + 1 if it is 1.
    Texel [i, j, k] has index i T^2 + j T + k.

    >>> weight, z = np.array([[0.25, 0.25, 0.5]]), np.array([[1.0, 1.0, 4.0]])
    >>> index, tap = cube_taps(weight, np.array([1.6]), z, 2)  # t = 0.4, 0.4, 0.2
    >>> index
    array([[0, 4, 2, 6, 1, 5, 3, 7]])
    >>> tap.round(9)
    array([[0.288, 0.192, 0.192, 0.128, 0.072, 0.048, 0.048, 0.032]])

    Fine print. Rounding may bring t_k above T - 1: that part is cut off.
    """
    raise NotImplementedError("exercise 10.6: cube_taps")


def cube_taps_backward(grad_tap, weight, depth, z, size):  # exercise 10.7 (3 points)
    """Backward of the taps: grad_tap (N, 8) -> grad_weight (N, 3), grad_depth (N,), grad_z (N, 3).

    weight, depth and z count as free here, each for itself. The texels are taken as given.

    >>> weight, z = np.array([[0.25, 0.25, 0.5]]), np.array([[1.0, 1.0, 4.0]])
    >>> grad_tap = np.array([[0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0]])  # their sum is t_0
    >>> grads = cube_taps_backward(grad_tap, weight, np.array([1.6]), z, 2)
    >>> tuple(grad.round(9) + 0.0 for grad in grads)
    (array([[1.6, 0. , 0. ]]), array([0.25]), array([[-0.4,  0. ,  0. ]]))
    """
    raise NotImplementedError("exercise 10.7: cube_taps_backward")


def sample_cubes(textures, face, index, tap):  # exercise 10.8 (1 point)
    """Eq. (5): textures (F, T, T, T, C), face (N,), index, tap (N, 8) of `cube_taps` -> (N, C).

    >>> textures = np.arange(16.0).reshape(2, 2, 2, 2, 1)
    >>> index, tap = np.array([[0, 4, 2, 6, 1, 5, 3, 7]]), np.array([[0.5, 0.5, 0, 0, 0, 0, 0, 0]])
    >>> sample_cubes(textures, np.array([1]), index, tap)
    array([[10.]])
    """
    raise NotImplementedError("exercise 10.8: sample_cubes")


def sample_cubes_backward(grad_colour, textures, face, index, tap):  # exercise 10.9 (2 points)
    """Backward of eq. (5): grad_colour (N, C) -> grad_textures, shaped like textures, and grad_tap
    (N, 8).

    >>> textures = np.arange(16.0).reshape(2, 2, 2, 2, 1)
    >>> index, tap = np.array([[0, 4, 2, 6, 1, 5, 3, 7]]), np.array([[0.5, 0.5, 0, 0, 0, 0, 0, 0]])
    >>> grad_textures, grad_tap = sample_cubes_backward(np.array([[2.0]]), textures, np.array([1]),
    ...                                                 index, tap)
    >>> grad_textures[1].ravel(), grad_tap
    (array([1., 0., 0., 0., 1., 0., 0., 0.]), array([[16., 24., 20., 28., 18., 26., 22., 30.]]))
    """
    raise NotImplementedError("exercise 10.9: sample_cubes_backward")


def texel_weights(size):
    """Where on a face each texel of its cube lies: barycentrics (T, T, T, 3).

    A face sees the plane i + j + k = T - 1 alone. A texel beside it stands for its foot there, so
    that eight taps of a linear function give back that function. (The original divides i, j, k by
    their sum if this is above T - 1, and else leaves them, with a sum that is not 1.)
    """
    share = np.stack(np.indices((size, size, size)), -1) / (size - 1)
    return share + (1 - share.sum(-1, keepdims=True)) / 3


def bake(image, uv, faces, size):
    """A photograph image (h, w, C) as texture cubes: textures (F, T, T, T, C), bilinear, by uv
    (V, 2) of the corners of faces (F, 3). At the border the image's last texels go on. Two faces at
    an edge agree exactly only if they make a parallelogram in uv.
    """
    at = texel_weights(size).reshape(-1, 3) @ uv[faces]
    texels = mipmapping.texture(image, at, boundary="clamp")
    return texels.reshape(len(faces), size, size, size, -1)


def both_sides(faces, textures):
    """faces (F, 3), textures (F, T, T, T, C) -> the same and, after them, the same from behind."""
    return (np.concatenate([faces, faces[:, ::-1]]),
            np.concatenate([textures, textures.transpose(0, 3, 2, 1, 4)]))


# --- light --------------------------------------------------------------------------------------


def face_light(corners, ambient, directional, towards):  # exercise 10.10 (2 points)
    """Eq. (6): light (F, C) of faces with corners (F, 3, 3) in space, not on screen.

    ambient, directional (C,) are colours. towards = l (3,) points to the light and has any length:
    twice as long is twice as bright. n points to the side that sees the corners counter-clockwise.

    >>> corners = np.array([[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
    >>> face_light(corners, np.array([0.5, 0.0]), np.array([0.0, 2.0]), np.array([1.0, 0.0, 0.25]))
    array([[0.5, 0.5]])

    Fine print. A face with three corners in one place has n = 0.
    """
    raise NotImplementedError("exercise 10.10: face_light")


def face_light_backward(grad_light, corners, ambient,  # exercise 10.11 (3 points)
                        directional, towards):
    """Backward of eq. (6): grad_light (F, C) -> grad_corners (F, 3, 3), grad_ambient (C,),
    grad_directional (C,), grad_towards (3,). Where n . l <= 0, the light is constant.

    >>> corners = np.array([[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
    >>> lights = np.array([0.5]), np.array([2.0]), np.array([1.0, 0.0, 0.25])
    >>> grad_corners, *grads = face_light_backward(np.array([[3.0]]), corners, *lights)
    >>> grads
    [array([3.]), array([0.75]), array([0., 0., 6.])]
    >>> grad_corners + 0.0
    array([[[ 0.,  0.,  3.],
            [ 0.,  0., -3.],
            [ 0.,  0.,  0.]]])
    """
    raise NotImplementedError("exercise 10.11: face_light_backward")


# --- the picture --------------------------------------------------------------------------------


def seen_samples(maps, corners, size):
    """The N pixels that see a face: face (N,), and for `cube_taps` weight, depth, z and size."""
    seen = maps.face_index >= 0
    face = maps.face_index[seen]
    return face, (maps.weight[seen], maps.depth[seen], corners[face, :, 2], size)


def shade_cubes(maps, corners, textures, light, background):
    """The colour (H, W, C) of every pixel of the Maps.

    corners (F, 3, 3), textures (F, T, T, T, C), light (F, C), background (C,).
    """
    face, samples = seen_samples(maps, corners, textures.shape[1])
    colour = np.full((*maps.face_index.shape, textures.shape[-1]), background, float)
    colour[maps.face_index >= 0] = sample_cubes(textures, face, *cube_taps(*samples)) * light[face]
    return colour


def shade_cubes_backward(grad_colour, maps, corners, textures, light):
    """Backward of `shade_cubes`, and of the maps: grad_colour (H, W, C) -> grad_corners (F, 3, 3),
    grad_textures, grad_light (F, C). (The original leaves out grad_corners.)
    """
    seen = maps.face_index >= 0
    face, samples = seen_samples(maps, corners, textures.shape[1])
    index, tap = cube_taps(*samples)
    # colour = sample * light: the product rule. Each pixel gathers its face's light and z, so
    # their gradients are scattered.
    grad_lit, lit = grad_colour[seen], sample_cubes(textures, face, index, tap)
    grad_light = scatter(grad_lit * lit, face, len(corners))
    grad_textures, grad_tap = sample_cubes_backward(grad_lit * light[face], textures, face, index,
                                                    tap)
    grad_weight, grad_depth = np.zeros(maps.weight.shape), np.zeros(maps.depth.shape)
    grad_weight[seen], grad_depth[seen], grad_z = cube_taps_backward(grad_tap, *samples)
    grad_corners = neural_renderer.rasterize_backward(grad_weight, grad_depth, maps.face_index,
                                                      corners)
    grad_corners[..., 2] += scatter(grad_z, face, len(corners))
    return grad_corners, grad_textures, grad_light


def render(scene, view, samples=2):
    """The original's picture (H, W, C) of a Scene in the pipeline's View, and its Buffers.

    Its antialiasing is samples = 2: 2 x 2 of them in a pixel, and their mean. ValueError, in one
    sentence, for what does not fit.
    """
    inputs.require_cubes(scene, view, samples)
    clip = pipeline.to_clip(scene.vertices, view.clip_from_model)
    corners = neural_renderer.corners_of(clip, scene.faces)
    light = face_light(scene.vertices[scene.faces], *scene.lights)
    maps = neural_renderer.rasterize(corners, samples * view.width, samples * view.height)
    colour = shade_cubes(maps, corners, scene.textures, light, view.background)
    return msaa.box_resolve(colour, samples), Buffers(clip, corners, light, maps, colour)


def render_backward(grad_picture, buffers, scene, view, outline, samples=2):
    """`render` read upwards: grad_picture (H, W, C) -> a Scene of gradients.

    outline(grad_colour, colour, face_index, corners) -> grad_corners (F, 3, 3) is the approximate
    gradient by edges, such as sweep_gradient.sweep_backward. All else is exact.
    """
    clip, corners, light, maps, colour = buffers
    grad_colour = msaa.box_resolve_backward(grad_picture, colour, samples)
    grad_corners, grad_textures, grad_light = shade_cubes_backward(grad_colour, maps, corners,
                                                                   scene.textures, light)
    grad_corners += outline(grad_colour, colour, maps.face_index, corners)
    grad_clip = neural_renderer.corners_backward(grad_corners, clip, scene.faces)
    on_screen, _ = pipeline.to_clip_backward(grad_clip, scene.vertices, view.clip_from_model)
    grad_world, *grad_lights = face_light_backward(grad_light, scene.vertices[scene.faces],
                                                   *scene.lights)
    in_light = scatter(grad_world, scene.faces, len(clip))
    return Scene(on_screen + in_light, None, grad_textures, Lights(*grad_lights))
