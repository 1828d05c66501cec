"""Pictures of faces (N, F, 3, 3), whose corners are x, y in ndc and z; and Kato's gradient.

The numbers are those of the original's kernels, to rounding. So the gradient of faces knows nothing
of how textures move over the pixels, which lab 10 does.
"""
import numpy as np
import torch
from torch.nn.functional import avg_pool2d

from apps.bridge import tensors
from apps.bridge.tensors import array, joined, require


def rasterize_rgbad(faces, textures=None, image_size=256, anti_aliasing=True, near=0.1, far=100,
                    eps=1e-4, background_color=(0, 0, 0), return_rgb=True, return_alpha=True,
                    return_depth=True):
    """{"rgb": (N, 3, H, W), "alpha": (N, H, W), "depth": (N, H, W)}, None where not wanted.

    faces (N, F, 3, 3), textures (N, F, T, T, T, 3). anti_aliasing: 2 x 2 samples in a pixel. What
    is nearer than near or farther than far is not seen, and where nothing is seen the depth is far.
    eps keeps the gradient's distances from 0. background_color: (3,) or (N, 3).
    """
    samples = 2 if anti_aliasing else 1
    rgb, *others = Rasterize(samples * image_size, near, far, eps, background_color, return_rgb,
                             return_alpha, return_depth)(faces, textures)
    pictures = rgb if rgb is None else rgb.movedim(-1, 1), *others
    return {kind: None if picture is None else avg_pool2d(picture.flip(-2), samples)
            for kind, picture in zip(("rgb", "alpha", "depth"), pictures, strict=True)}


def rasterize(faces, textures, *settings, **named):
    """The colours (N, 3, H, W) alone. Arguments as of `rasterize_rgbad`, up to background_color."""
    return rasterize_rgbad(faces, textures, *settings, **named)["rgb"]


def rasterize_silhouettes(faces, *settings, **named):
    """The alpha (N, H, W) alone. Arguments as of `rasterize_rgbad` without textures, up to eps."""
    return rasterize_rgbad(faces, None, *settings, return_rgb=False, **named)["alpha"]


def rasterize_depth(faces, *settings, **named):
    """The depth (N, H, W) alone. Arguments as of `rasterize_rgbad` without textures, up to eps."""
    return rasterize_rgbad(faces, None, *settings, return_rgb=False, **named)["depth"]


class Rasterize(torch.nn.Module):
    """faces, textures -> rgb (N, H, W, 3), alpha, depth (N, H, W), None where not wanted.

    Row 0 is at the bottom.
    """

    def __init__(self, image_size, near, far, eps, background_color, return_rgb=False,
                 return_alpha=False, return_depth=False):
        super().__init__()
        self.settings, self.background = (image_size, near, far, eps), background_color
        self.wanted = return_rgb, return_alpha, return_depth

    def forward(self, faces, textures=None):
        count = len(faces)
        require(count > 0, "faces must be of at least one picture: leave empty batches out")
        cubes = backgrounds = [None] * count
        if self.wanted[0]:
            require(textures is not None and len(textures) == count, f"rgb needs textures for each "
                    f"of {count} pictures: give them, or ask for silhouettes or depth")
            cubes = with_pairs(textures)
            backgrounds = np.broadcast_to(np.reshape(self.background, (-1, 3)), (count, 3))
        scenes = zip(faces.contiguous(), cubes, backgrounds, strict=True)
        pictures = [Picture.apply(*scene, *self.settings) for scene in scenes]
        colour, depth = (torch.stack(each) for each in zip(*pictures, strict=True))
        pictures = colour[..., :3], colour[..., -1], depth
        return tuple(picture if is_wanted else None
                     for picture, is_wanted in zip(pictures, self.wanted, strict=True))


def with_pairs(textures):
    """Textures (..., T, T, T, 3), each texel twice on each axis if T = 1: eight taps need two."""
    if textures.shape[-4:-1] == (1, 1, 1):
        textures = textures.expand(*textures.shape[:-4], 2, 2, 2, 3)
    return textures.contiguous()


class Picture(torch.autograd.Function):
    """Lab 10: colour (H, W, 3 + 1), the last of it alpha, or alpha alone, and depth (H, W).

    Outlines have Kato's gradient, of all channels at once. Textures and depth have exact ones.
    """

    @staticmethod
    def forward(ctx, faces, textures, background, size, near, far, eps):
        corners = array("faces[n]", faces, f"{len(faces)} 3 3")  # there may be none
        lab10 = tensors.labs.neural_renderer
        maps = lab10.Maps(*lab10.rasterize(corners, size, size, near, far))
        is_seen = maps.face_index >= 0
        colour = is_seen[..., None]
        if textures is not None:
            texels = textures.shape[1]
            cubes = array("textures[n]", textures, f"{len(corners)} {texels} {texels} {texels} 3")
            colour = np.dstack([tensors.labs.texture_cubes.shade_cubes(
                maps, corners, cubes, np.ones((len(corners), 3)), background), colour])
        colour = joined([colour], faces, colour.shape)
        ctx.save_for_backward(faces, textures, colour)
        ctx.maps, ctx.eps = maps, eps
        ctx.set_materialize_grads(False)
        return colour, joined([np.where(is_seen, maps.depth, far)], faces, is_seen.shape)

    @staticmethod
    @tensors.first_order
    def backward(ctx, grad_colour, grad_depth):
        faces, textures, colour = ctx.saved_tensors
        labs, maps, corners = tensors.labs, ctx.maps, faces.detach().numpy()
        grad_corners, grad_textures = np.zeros(corners.shape), None
        if grad_depth is not None:
            grad_corners += labs.neural_renderer.rasterize_backward(
                np.zeros(maps.screen_weights.shape), grad_depth.numpy(), maps.face_index, corners)
        if grad_colour is not None and ctx.needs_input_grad[1]:
            cubes, grad = textures.detach().numpy(), grad_colour.numpy()[maps.face_index >= 0, :3]
            face, samples = labs.texture_cubes.seen_samples(maps, corners, cubes.shape[1])
            grad_cubes, _ = labs.texture_cubes.sample_cubes_backward(
                grad, cubes, face, *labs.texture_cubes.cube_taps(*samples))
            grad_textures = joined([grad_cubes], textures)
        if grad_colour is not None and ctx.needs_input_grad[0]:
            grad_corners += labs.sweep_gradient.sweep_backward(
                grad_colour.numpy(), colour.numpy(), maps.face_index, corners, ctx.eps)
        return joined([grad_corners], faces), grad_textures, *5 * [None]
