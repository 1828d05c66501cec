"""The pyramid of lab 6 once more: singular values by SVD, all taps of a level at once."""
import math

import numpy as np

from reference.mipmapping import halve, mixture, nearest_at, texels_at


def pyramid(image, max_level=None):
    height, width, _ = np.shape(image)
    last = math.inf if max_level is None else max_level
    odd = any(side > 1 and side % 2 for side in (height, width))
    if last == 0 or odd or height == width == 1:
        return (image,)
    return image, *pyramid(halve(image), last - 1)


def texels_a_pixel(jacobian, width, height):
    return np.array(jacobian) * np.array([[width], [height]])


def mip_level(jacobian, width, height):
    lengths = np.linalg.svd(texels_a_pixel(jacobian, width, height), compute_uv=False)[:, 0]
    return [math.log2(length) if length > 0 else -math.inf for length in lengths]


def taps(uv, level, mipmap, sampler):
    texels = nearest_at if sampler.filter_mode == "nearest" else texels_at
    looks = mixture(level, sampler.filter_mode, len(mipmap.width) - 1)
    found = np.array([texels(uv, mipmap.width[at], mipmap.height[at], sampler.boundary)
                      for at, _ in looks])  # level, what, texel, pixel: all as numbers
    found[:, 0] += np.stack([mipmap.start[at] for at, _ in looks])[:, None]
    found[:, 1] *= np.stack([share for _, share in looks])[:, None]
    index, weight, inside = np.moveaxis(found, 1, 0).reshape(3, -1, len(uv)).swapaxes(1, 2)
    return index.astype(int), weight, inside > 0


def taps_backward(grad_weight, inside, uv, level, mipmap, sampler):
    grads, by_uv, by_level = np.where(inside, grad_weight, 0).T, np.zeros((2, len(uv))), 0 * level
    if sampler.filter_mode == "nearest":
        return by_uv.T, by_level
    free = (sampler.filter_mode == "linear-mipmap-linear") & (level > 0) & (
        level < len(mipmap.width) - 1)
    ends, looks = np.array([-1, 1]), mixture(level, sampler.filter_mode, len(mipmap.width) - 1)
    for k, (at, share) in enumerate(looks):
        size = np.array([mipmap.width[at], mipmap.height[at]])
        part = (uv.T * size - 0.5) % 1
        across, along = np.array([1 - part, part]).swapaxes(0, 1)  # two columns, two rows
        grad = grads[4 * k:4 * k + 4].reshape(2, 2, -1)
        by_uv += share * size * [np.einsum("ijn,in,j->n", grad, along, ends),
                                 np.einsum("ijn,i,jn->n", grad, ends, across)]
        by_level = by_level + ends[k] * free * np.einsum("ijn,in,jn->n", grad, along, across)
    return by_uv.T, by_level
