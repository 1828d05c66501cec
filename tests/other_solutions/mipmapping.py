"""The pyramid of lab 6 once more: singular values by SVD, every level straight down."""
import math

import numpy as np


def halve(image):
    if image.shape[0] > 1:
        image = 0.5 * image[::2] + 0.5 * image[1::2]
    if image.shape[1] > 1:
        image = 0.5 * image[:, ::2] + 0.5 * image[:, 1::2]
    return image


def pyramid(image, max_level=None):
    height, width, _ = np.shape(image)
    last = math.inf if max_level is None else max_level
    if last == 0 or height == width == 1 or height > 1 < height % 2 + 1 or width > 1 < width % 2 + 1:
        return (image,)
    return image, *pyramid(halve(image), last - 1)


def texels_a_pixel(jacobian, width, height):
    return np.array(jacobian) * np.array([[width], [height]])


def mip_level(jacobian, width, height):
    lengths = np.linalg.svd(texels_a_pixel(jacobian, width, height), compute_uv=False)[:, 0]
    return [math.log2(length) if length > 0 else -math.inf for length in lengths]


def blend_levels(level, top):
    clamped = [min(max(at, 0.0), float(top)) for at in level]
    lower = np.array([int(at) for at in clamped], int)
    return lower, np.where(lower < top, lower + 1, top), np.array(clamped) - lower


def shares(level, filter_mode, top):
    """Every level (N,) that a pixel may mix, its share, and the share's slope."""
    at = np.clip(level, 0, top)
    if filter_mode == "linear-mipmap-linear":
        lower, upper, part = blend_levels(level, top)
        slope = np.where(at == level, 1.0, 0.0) * (at > 0) * (at < top)
        return [(lower, 1 - part, -slope), (upper, part, slope)]
    only = at.astype(int) if "mipmap" in filter_mode else np.zeros(len(level), int)
    return [(only, np.ones(len(level)), np.zeros(len(level)))]


def tents(uv, width, height, boundary):
    """number, weight, slope along u, slope along v, inside: lists of four (N,), row by row."""
    found = []
    x, y = uv[:, 0] * width - 0.5, uv[:, 1] * height - 0.5
    for up, right in np.ndindex(2, 2):
        j, i = np.floor(x) + right, np.floor(y) + up
        by_x, by_y = 1 - np.abs(x - j), 1 - np.abs(y - i)
        inside = (j >= 0) & (j < width) & (i >= 0) & (i < height) | (boundary != "zero")
        j, i = ((np.mod(k, n) if boundary == "wrap" else np.clip(k, 0, n - 1))
                for k, n in ((j, width), (i, height)))
        found.append(((i * width + j).astype(int), by_x * by_y * inside,
                      (2 * right - 1) * by_y * width * inside,
                      (2 * up - 1) * by_x * height * inside, inside))
    return zip(*found, strict=True)


def taps(uv, level, mipmap, sampler):
    columns = []
    for at, share, _ in shares(level, sampler.filter_mode, len(mipmap.width) - 1):
        width, height = mipmap.width[at], mipmap.height[at]
        if sampler.filter_mode == "nearest":
            uv = (np.floor(uv * np.array([width, height]).T) + 0.5) / np.array([width, height]).T
        number, weight, _, _, inside = tents(uv, width, height, sampler.boundary)
        count = 1 if sampler.filter_mode == "nearest" else 4
        columns += [(mipmap.start[at] + number[k], share * weight[k], inside[k])
                    for k in range(count)]
    return tuple(np.column_stack(part) for part in zip(*columns, strict=True))


def taps_backward(grad_weight, inside, uv, level, mipmap, sampler):
    grads = iter(np.where(inside, grad_weight, 0).T)
    by_u, by_v, by_level = np.zeros((3, len(uv)))
    if sampler.filter_mode != "nearest":
        for at, share, slope in shares(level, sampler.filter_mode, len(mipmap.width) - 1):
            _, *parts = tents(uv, mipmap.width[at], mipmap.height[at], sampler.boundary)
            for weight, along_u, along_v, _ in zip(*parts, strict=True):
                grad = next(grads)
                by_u += grad * share * along_u
                by_v += grad * share * along_v
                by_level += grad * slope * weight
    return np.column_stack([by_u, by_v]), by_level
