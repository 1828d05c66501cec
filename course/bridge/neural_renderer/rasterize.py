"""Pictures of faces (N, F, 3, 3), whose corners are x, y in ndc and z; and Kato's gradient.

Unlike the original's, the gradient of faces knows how textures move over the pixels.
"""
from typing import NamedTuple

import numpy as np
import torch
from torch.nn.functional import avg_pool2d

from .. import tensors
from ..tensors import array, require, tensor


class Settings(NamedTuple):
    """The arguments of `rasterize_rgbad` after the textures, in their order.

    image_size: rows and columns. anti_aliasing: 2 x 2 samples in a pixel. Only what is between near
    and far is seen. eps keeps the gradient's distances from 0. background_color: (3,) or (N, 3).
    """

    image_size: int = 256
    anti_aliasing: bool = True
    near: float = 0.1
    far: float = 100
    eps: float = 1e-4
    background_color: object = (0, 0, 0)
    return_rgb: bool = True
    return_alpha: bool = True
    return_depth: bool = True


def rasterize_rgbad(faces, textures=None, *settings, **named):
    """{"rgb": (N, 3, H, W), "alpha": (N, H, W), "depth": (N, H, W)}, None where not wanted.

    faces (N, F, 3, 3), textures (N, F, T, T, T, 3), then the Settings. Where no face is seen, the
    depth is far.
    """
    image_size, anti_aliasing, *others = Settings(*settings, **named)
    samples = 2 if anti_aliasing else 1
    rgb, alpha, depth = Rasterize(samples * image_size, *others)(faces, textures)
    pictures = {"rgb": None if rgb is None else rgb.movedim(-1, 1), "alpha": alpha, "depth": depth}
    return {kind: None if picture is None else avg_pool2d(picture.flip(-2), samples)
            for kind, picture in pictures.items()}


def rasterize(faces, textures, *settings, **named):
    """The colours (N, 3, H, W) alone of `rasterize_rgbad`."""
    return only("rgb", faces, textures, settings, named)


def rasterize_silhouettes(faces, *settings, **named):
    """The alpha (N, H, W) alone of `rasterize_rgbad`."""
    return only("alpha", faces, None, settings, named)


def rasterize_depth(faces, *settings, **named):
    """The depth (N, H, W) alone of `rasterize_rgbad`."""
    return only("depth", faces, None, settings, named)


def only(kind, faces, textures, settings, named):
    """One of the pictures of `rasterize_rgbad`."""
    wanted = {f"return_{each}": each == kind for each in ("rgb", "alpha", "depth")}
    asked = Settings(*settings, **named)._replace(**wanted)
    return rasterize_rgbad(faces, textures, *asked)[kind]


class Rasterize(torch.nn.Module):
    """faces, textures -> rgb (N, H, W, 3), alpha, depth (N, H, W), None where not wanted.

    Row 0 is at the bottom.
    """

    def __init__(self, image_size, near, far, eps, background_color, return_rgb=False,
                 return_alpha=False, return_depth=False):
        super().__init__()
        self.settings = Settings(image_size, False, near, far, eps, background_color, return_rgb,
                                 return_alpha, return_depth)

    def forward(self, faces, textures=None):
        wanted = self.settings[-3:]
        require(textures is not None or not wanted[0], "rgb needs textures: give them, or ask for "
                "silhouettes or depth")
        textures = with_pairs(textures) if wanted[0] else None
        colour, depth = Pictures.apply(faces.contiguous(), textures, self.settings)
        pictures = colour[..., :3], colour[..., -1], depth
        return tuple(picture if is_wanted else None
                     for picture, is_wanted in zip(pictures, wanted, strict=True))


def with_pairs(textures):
    """Textures (..., T, T, T, 3), each texel twice on each axis if T = 1: eight taps need two."""
    if textures.shape[-4:-1] == (1, 1, 1):
        textures = textures.expand(*textures.shape[:-4], 2, 2, 2, 3)
    return textures.contiguous()


class Pictures(torch.autograd.Function):
    """Lab 10: colour (N, H, W, 3 + 1), the last of it alpha, or alpha alone, and depth (N, H, W).

    Outlines have Kato's gradient, of all channels at once. Textures and depth have exact ones.
    """

    @staticmethod
    def forward(ctx, faces, textures, settings):
        corners, cubes = arrays_of(faces, textures)
        size, near, far = settings.image_size, settings.near, settings.far
        ctx.maps = [tensors.labs.neural_renderer.rasterize(each, size, size, near, far)
                    for each in corners]
        depth = np.stack([maps.depth for maps in ctx.maps])
        is_seen = np.isfinite(depth)
        colour = [is_seen[..., None]]
        if cubes is not None:
            colour.insert(0, shaded(ctx.maps, corners, cubes, settings.background_color))
        colour = np.concatenate(colour, -1)
        colour = tensor(colour, faces, colour.shape)
        ctx.save_for_backward(faces, textures, colour)
        ctx.eps = settings.eps
        ctx.set_materialize_grads(False)
        return colour, tensor(np.where(is_seen, depth, far), faces, depth.shape)

    @staticmethod
    def backward(ctx, grad_colour, grad_depth):
        faces, textures, colour = ctx.saved_tensors
        corners, cubes = arrays_of(faces, textures)
        grad_corners, grad_cubes = np.zeros(corners.shape), None
        if grad_depth is not None:
            grad_corners += depth_backward(grad_depth.numpy(), ctx.maps, corners)
        if grad_colour is not None and cubes is not None:
            grad_shown, grad_cubes = shaded_backward(grad_colour[..., :3].numpy(), ctx.maps,
                                                     corners, cubes)
            grad_corners += grad_shown
        if grad_colour is not None and ctx.needs_input_grad[0]:
            grad_corners += outlines_backward(grad_colour.numpy(), colour.numpy(), ctx.maps,
                                              corners, ctx.eps)
        return (tensor(grad_corners, faces),
                None if grad_cubes is None else tensor(grad_cubes, textures), None)


def arrays_of(faces, textures):
    """Corners (N, F, 3, 3) and texture cubes (N, F, T, T, T, 3), or None."""
    corners = array("faces", faces, "n f 3 3")
    if textures is None:
        return corners, None
    size = textures.shape[2]
    count = " ".join(map(str, (*corners.shape[:2], size, size, size)))
    return corners, array("textures", textures, f"{count} 3")


def shaded(maps, corners, cubes, background):
    """The colours (N, H, W, 3) of what the maps see, before the background (3,) or (N, 3)."""
    backgrounds = np.broadcast_to(np.reshape(background, (-1, 3)), (len(corners), 3))
    return np.stack([tensors.labs.texture_cubes.shade_cubes(*each) for each in zip(
        maps, corners, cubes, np.ones((*corners.shape[:2], 3)), backgrounds, strict=True)])


def shaded_backward(grad_colour, maps, corners, cubes):
    """Backward of `shaded`, and of the maps: grad_corners, grad_cubes."""
    light = np.ones((*corners.shape[:2], 3))
    grads = [tensors.labs.texture_cubes.shade_cubes_backward(*each)[:2] for each in zip(
        grad_colour, maps, corners, cubes, light, strict=True)]
    return [np.stack(each) for each in zip(*grads, strict=True)]


def depth_backward(grad_depth, maps, corners):
    """Backward of the maps' depth: grad_corners."""
    return np.stack([tensors.labs.neural_renderer.rasterize_backward(
        np.zeros((*grad.shape, 3)), grad, seen.face_index, each)
        for grad, seen, each in zip(grad_depth, maps, corners, strict=True)])


def outlines_backward(grad_colour, colour, maps, corners, eps):
    """Kato's gradient of the outlines: grad_corners."""
    return np.stack([tensors.labs.sweep_gradient.sweep_backward(
        grad, picture, seen.face_index, each, eps)
        for grad, picture, seen, each in zip(grad_colour, colour, maps, corners, strict=True)])
