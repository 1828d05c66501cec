"""texture_cubes: T^3 texels and one light for each face, and the picture that they make.

Pass 3 of neural_renderer. w and z are a pixel's weights and depth of eqs. (2) and (3), z_k the
depths of its face's corners.

    t_k = (T - 1) w_k z / z_k                  place in the face's cube of T^3 texels          (4)
    colour = sum over 8 taps of texel prod_k a_k      a_k: t_k - low_k or 1 - (t_k - low_k)    (5)
    light = A + D max(0, n . l)                n: unit normal, l: towards the light            (6)

All of it has exact gradients as long as each pixel sees the same face. Outlines have none, so
`render_backward` takes an approximate one, such as that of sweep_gradient.py.

Sources: Kato, Ushiku, Harada 2018, and a reading of their rasterizer, neural_renderer. Where it
does something else, the functions say so.
"""
from typing import NamedTuple

import numpy as np

from course.given import inputs
from course.given.arrays import EDGES, scatter

from . import mipmapping, msaa, neural_renderer, pipeline, texturing


class Lights(NamedTuple):
    """The light everywhere and the light from one side: ambient, directional (C,), towards (3,)."""

    ambient: np.ndarray
    directional: np.ndarray
    towards: np.ndarray


class LitMesh(NamedTuple):
    """vertices (V, 3), faces (F, 3), textures (F, T, T, T, C) and Lights.

    A LitMesh of gradients has None for its faces.
    """

    vertices: np.ndarray
    faces: np.ndarray
    textures: np.ndarray
    lights: Lights


class CubeBuffers(NamedTuple):
    """What was found on the way to a picture: clip (V, 4), corners (F, 3, 3), light (F, C), the
    Maps, and the colour of each sample (samples H, samples W, C).
    """

    clip: np.ndarray
    corners: np.ndarray
    light: np.ndarray
    maps: neural_renderer.Maps
    colour: np.ndarray


# --- texture cubes ------------------------------------------------------------------------------


def cube_taps(weight, depth, z, size):  # extra 10.4 (3 points)
    """Eqs. (4) and (5): which 8 texels does a pixel read, with which weights prod_k a_k?

    weight (N, 3), depth (N,), z (N, 3), size T -> index, tap (N, 8). Along axis k, tap n takes
    texel low_k + n // 2^k % 2, low_k = min(floor(t_k), T - 2). [i, j, k] has index (i T + j) T + k.

    >>> weight, z = np.array([[0.25, 0.25, 0.5]]), np.array([[1.0, 1.0, 4.0]])
    >>> index, tap = cube_taps(weight, np.array([1.6]), z, 2)  # t = 0.4, 0.4, 0.2
    >>> index
    array([[0, 4, 2, 6, 1, 5, 3, 7]])
    >>> tap.round(9)
    array([[0.288, 0.192, 0.192, 0.128, 0.072, 0.048, 0.048, 0.032]])

    Fine print. Rounding may bring t_k above T - 1: that part is cut off.
    """
    t = np.minimum((size - 1) * weight * depth[:, None] / z, size - 1)
    low = np.minimum(np.floor(t), size - 2).astype(int)
    index = np.zeros((len(t), 8), int)
    tap = np.ones((len(t), 8))
    for n in range(8):
        for k in range(3):
            upper = (n >> k) & 1
            index[:, n] = index[:, n] * size + low[:, k] + upper
            tap[:, n] *= t[:, k] - low[:, k] if upper else 1 - (t[:, k] - low[:, k])
    return index, tap


def cube_taps_backward(grad_tap, weight, depth, z, size):
    """Backward of `cube_taps`: grad_tap (N, 8) -> grad_weight (N, 3), grad_depth (N,) and
    grad_z (N, 3).

    weight, depth and z are variables of their own here. The index has no gradient.

    >>> weight, z = np.array([[0.25, 0.25, 0.5]]), np.array([[1.0, 1.0, 4.0]])
    >>> grad_tap = np.array([[0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0]])  # their sum is t_0
    >>> grads = cube_taps_backward(grad_tap, weight, np.array([1.6]), z, 2)
    >>> tuple(grad.round(9) + 0.0 for grad in grads)
    (array([[1.6, 0. , 0. ]]), array([0.25]), array([[-0.4,  0. ,  0. ]]))
    """
    scale = (size - 1) / z
    t = scale * weight * depth[:, None]
    part = t - np.minimum(np.floor(t), size - 2)
    # Along axis k a tap is part_k or 1 - part_k: the others' product, with + or -.
    grad_t = np.zeros(t.shape)
    for n in range(8):
        factor = [part[:, k] if (n >> k) & 1 else 1 - part[:, k] for k in range(3)]
        for k, (i, j) in enumerate(EDGES):
            sign = 1 if (n >> k) & 1 else -1
            grad_t[:, k] += sign * grad_tap[:, n] * factor[i] * factor[j]
    grad_weight = grad_t * scale * depth[:, None]
    return grad_weight, (grad_t * scale * weight).sum(1), -grad_weight * weight / z


def sample_cubes(textures, face, index, tap):
    """Eq. (5): textures (F, T, T, T, C), face (N,), index, tap (N, 8) of `cube_taps` -> (N, C).

    >>> textures = np.arange(16.0).reshape(2, 2, 2, 2, 1)
    >>> index, tap = np.array([[0, 4, 2, 6, 1, 5, 3, 7]]), np.array([[0.5, 0.5, 0, 0, 0, 0, 0, 0]])
    >>> sample_cubes(textures, np.array([1]), index, tap)
    array([[10.]])
    """
    texels = textures.reshape(-1, textures.shape[-1])
    first = face * textures.shape[1]**3
    return texturing.look_up(texels, first[:, None] + index, tap)


def sample_cubes_backward(grad_colour, textures, face, index, tap):
    """Backward of eq. (5): grad_colour (N, C) -> grad_textures, shaped like textures, and grad_tap
    (N, 8).

    >>> textures = np.arange(16.0).reshape(2, 2, 2, 2, 1)
    >>> index, tap = np.array([[0, 4, 2, 6, 1, 5, 3, 7]]), np.array([[0.5, 0.5, 0, 0, 0, 0, 0, 0]])
    >>> grad_textures, grad_tap = sample_cubes_backward(np.array([[2.0]]), textures, np.array([1]),
    ...                                                 index, tap)
    >>> grad_textures[1].ravel(), grad_tap
    (array([1., 0., 0., 0., 1., 0., 0., 0.]), array([[16., 24., 20., 28., 18., 26., 22., 30.]]))
    """
    texels = textures.reshape(-1, textures.shape[-1])
    first = face * textures.shape[1]**3
    grad_texels, grad_tap = texturing.look_up_backward(grad_colour, texels, first[:, None] + index,
                                                       tap)
    return grad_texels.reshape(textures.shape), grad_tap


def texel_barycentrics(size):
    """Where on a face each texel of its cube lies: barycentrics (T, T, T, 3).

    A face only sees the plane i + j + k = T - 1. A texel beside it stands for the nearest point of
    the plane, so that eight taps of a linear function give back that function. (The original
    divides i, j, k by their sum if this is above T - 1, and leaves them alone if it is below.)
    """
    share = np.stack(np.indices((size, size, size)), -1) / (size - 1)
    return share + (1 - share.sum(-1, keepdims=True)) / 3


def bake(image, uv, faces, size):
    """A photograph as texture cubes: textures (F, T, T, T, C), read bilinearly at uv.

    image (h, w, C), uv (V, 2) of the corners of faces (F, 3). At its border the image goes on with
    its last texels. Two faces agree exactly at their edge if they make a parallelogram in uv.
    """
    at = texel_barycentrics(size).reshape(-1, 3) @ uv[faces]
    texels = mipmapping.texture(image, at, boundary="clamp")
    return texels.reshape(len(faces), size, size, size, -1)


def both_sides(faces, textures):
    """faces (F, 3), textures (F, T, T, T, C) -> the same and, after them, the same from behind."""
    return (np.concatenate([faces, faces[:, ::-1]]),
            np.concatenate([textures, textures.transpose(0, 3, 2, 1, 4)]))


# --- light --------------------------------------------------------------------------------------


def face_light(corners, ambient, directional, towards):
    """Eq. (6): the light (F, C) on faces with corners (F, 3, 3) in space.

    A = ambient (C,), D = directional (C,), l = towards (3,), as it is, without dividing by its
    length. The corners are counter-clockwise from where the unit normal n points.

    >>> corners = np.array([[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
    >>> face_light(corners, np.array([0.5, 0.0]), np.array([0.0, 2.0]), np.array([1.0, 0.0, 0.25]))
    array([[0.5, 0.5]])

    A face without area has no normal. It gets the ambient light alone.
    """
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    cosine = (area / np.where(length > 0, length, 1)) @ towards
    return ambient + np.maximum(cosine, 0)[:, None] * directional


def face_light_backward(grad_light, corners, ambient, directional, towards):
    """Backward of eq. (6): grad_light (F, C) -> grad_corners (F, 3, 3), grad_ambient (C,),
    grad_directional (C,), grad_towards (3,).

    >>> corners = np.array([[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
    >>> lights = np.array([0.5]), np.array([2.0]), np.array([1.0, 0.0, 0.25])
    >>> grad_corners, *grads = face_light_backward(np.array([[3.0]]), corners, *lights)
    >>> grads
    [array([3.]), array([0.75]), array([0., 0., 6.])]
    >>> grad_corners + 0.0
    array([[[ 0.,  0.,  3.],
            [ 0.,  0., -3.],
            [ 0.,  0.,  0.]]])

    The light does not change where n . l <= 0. A face without area has n = 0.
    """
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    length[length == 0] = 1
    normal = area / length
    cosine = (normal @ towards)[:, None]
    grad_cosine = np.where(cosine > 0, (grad_light * directional).sum(1, keepdims=True), 0)
    # n = N / |N|, so d(n . l) = (l - (n . l) n) . dN / |N|. N = (b - a) x (c - a), so G . dN is
    # db . ((c - a) x G) + dc . (G x (b - a)), and da takes away what both get.
    grad_area = grad_cosine * (towards - cosine * normal) / length
    grad_b, grad_c = np.cross(c - a, grad_area), np.cross(grad_area, b - a)
    grad_corners = np.stack([-grad_b - grad_c, grad_b, grad_c], 1)
    grad_directional = (grad_light * np.maximum(cosine, 0)).sum(0)
    grad_towards = (grad_cosine * normal).sum(0)
    return grad_corners, grad_light.sum(0), grad_directional, grad_towards


# --- the picture --------------------------------------------------------------------------------


def seen_samples(maps, corners, size):
    """The N pixels that see a face: face (N,), and for `cube_taps` weight, depth, z and size."""
    seen = maps.face_index >= 0
    face = maps.face_index[seen]
    return face, (maps.screen_weights[seen], maps.depth[seen], corners[face, :, 2], size)


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
    grad_lit = grad_colour[seen]
    lit = sample_cubes(textures, face, index, tap)
    grad_light = scatter(grad_lit * lit, face, len(corners))
    grad_textures, grad_tap = sample_cubes_backward(grad_lit * light[face], textures, face, index,
                                                    tap)
    grad_weight = np.zeros(maps.screen_weights.shape)
    grad_depth = np.zeros(maps.depth.shape)
    grad_weight[seen], grad_depth[seen], grad_z = cube_taps_backward(grad_tap, *samples)
    grad_corners = neural_renderer.rasterize_backward(grad_weight, grad_depth, maps.face_index,
                                                      corners)
    grad_corners[..., 2] += scatter(grad_z, face, len(corners))
    return grad_corners, grad_textures, grad_light


def render(scene, view, samples=2):
    """The original's picture (H, W, C) of a LitMesh in the pipeline's View, and its CubeBuffers.

    Its antialiasing is samples = 2: 2 x 2 of them in a pixel, and their mean. ValueError, in one
    sentence, for what does not fit.
    """
    inputs.require_cubes(scene, view, samples)
    clip = pipeline.to_clip(scene.vertices, view.clip_from_model)
    corners = neural_renderer.corners_of(clip, scene.faces)
    light = face_light(scene.vertices[scene.faces], *scene.lights)
    width, height = int(samples) * int(view.width), int(samples) * int(view.height)
    maps = neural_renderer.Maps(*neural_renderer.rasterize(corners, width, height))
    colour = shade_cubes(maps, corners, scene.textures, light, view.background)
    return msaa.box_resolve(colour, samples), CubeBuffers(clip, corners, light, maps, colour)


def render_backward(grad_picture, buffers, scene, view, outline, samples=2):
    """`render` read upwards: grad_picture (H, W, C) -> a LitMesh of gradients.

    outline(grad_colour, colour, face_index, corners) -> grad_corners (F, 3, 3) is the approximate
    gradient of the edges, such as sweep_gradient.sweep_backward. All else is exact.
    """
    clip, corners, light, maps, colour = buffers
    grad_colour = msaa.box_resolve_backward(grad_picture, colour, samples)
    grad_corners, grad_textures, grad_light = shade_cubes_backward(grad_colour, maps, corners,
                                                                   scene.textures, light)
    grad_corners += outline(grad_colour, colour, maps.face_index, corners)
    grad_clip = neural_renderer.corners_backward(grad_corners, clip, scene.faces)
    through_screen, _ = pipeline.to_clip_backward(grad_clip, scene.vertices, view.clip_from_model)
    grad_world, *grad_lights = face_light_backward(grad_light, scene.vertices[scene.faces],
                                                   *scene.lights)
    through_light = scatter(grad_world, scene.faces, len(clip))
    return LitMesh(through_screen + through_light, None, grad_textures, Lights(*grad_lights))
