"""Texel kernels: mipmapping.py's `texture` and its gradients, many pixels of one level at a time.

    find_runs    neighbours that look into the same level of the pyramid, at most RUN of them
    along_axis   eq. (2) for a run: few steps without a branch, several pixels at a time
    mix          eq. (3): the run's colours
    add_slopes   the way back to (u, v) and to the level
    add_texels   the way back to the texels, on one thread, in the order of the pixels

Pyramids are those of pyramid_kernels.py. All arrays are flat: pixel n has its colour at C n.
"""
from typing import NamedTuple

import numpy as np

from course.given.compiled import each_band, kernel

from . import pyramid_kernels
from .mipmapping import blend_levels_backward
from .texturing import BOUNDARIES, Footprint, Sampler, require_gradient, require_texture

RUN = 1 << 8
WRAP, CLAMP = BOUNDARIES.index("wrap"), BOUNDARIES.index("clamp")


class Looks(NamedTuple):
    """Where pixels look: uv (2 N,) and the boundary; level and fraction (N,), eq. (7); and jobs
    (J, 4) for some of them: first <= n < end, a level, and whether it is the upper one.
    """

    uv: np.ndarray
    boundary: int
    level: np.ndarray
    fraction: np.ndarray
    jobs: np.ndarray | None = None


@kernel
def find_runs(level, top, blends, always, first, end, fraction):
    """`mixture` of pixels first <= n < end: their fraction -> the jobs of Looks.

    blends: eq. (7) is asked for. always: also where one level has the share 0.
    """
    key = np.empty(end - first, np.int32)
    for n in range(np.uintp(first), np.uintp(end)):
        clamped = min(max(level[n], 0.0), float(top))
        lower = np.floor(clamped)
        mixes = blends & (always | ((clamped > 0) & (clamped < top)))
        fraction[n] = clamped - lower if blends else 0.0
        key[n - np.uintp(first)] = 2 * np.int32(lower) + mixes
    jobs = np.empty((2 * len(key), 4), np.intp)
    count, begin = 0, 0
    for i in range(1, len(key) + 1):
        if i == len(key) or key[i] != key[begin] or i == begin + RUN:
            lower = key[begin] // 2
            for upper in range(1 + key[begin] % 2):
                jobs[count, 0], jobs[count, 1] = first + begin, first + i
                jobs[count, 2], jobs[count, 3] = min(lower + upper, top), upper
                count += 1
            begin = i
    return jobs[:count].copy()


@kernel
def near(x, boundary):
    """`near_texture`"""
    return x - np.trunc(x) if boundary == WRAP else min(max(x, -1.0), 2.0)


@kernel
def standing(j, size, boundary):
    """The texel that stands for number j, all as floats, and whether there is one."""
    if boundary == WRAP:  # -1 - size <= j <= size
        j = j + size if j < 0 else j
        j = j + size if j < 0 else j
        return (j if j < size else 0.0), True
    if boundary == CLAMP:
        return min(max(j, 0.0), size - 1), True
    inside = (j >= 0) & (j < size)
    return (j if inside else 0.0), inside


@kernel
def along_axis(uv, axis, first, end, size, boundary, number, weight, slope):
    """Eq. (2) of a run, pixels first <= n < end: what `linear_texels` finds, in rows 2 axis and
    2 axis + 1 of number, weight, and slope, the weight's change from texel to texel. Where a texel
    is not inside, these two are 0.
    """
    size, a, b = float(size), 2 * axis, 2 * axis + 1
    for n in range(np.uintp(first), np.uintp(end)):
        i = n - np.uintp(first)
        position = near(uv[np.uintp(2) * n + np.uintp(axis)], boundary) * size - 0.5
        below = np.floor(position)
        j, j_inside = standing(below, size, boundary)
        k, k_inside = standing(below + 1, size, boundary)
        number[a, i], number[b, i] = np.int32(j), np.int32(k)
        weight[a, i] = 1 - (position - below) if j_inside else 0.0
        weight[b, i] = position - below if k_inside else 0.0
        slope[a, i] = -1.0 if j_inside else 0.0
        slope[b, i] = 1.0 if k_inside else 0.0


@kernel
def room_for_run():
    """number, weight and slope of a run: left, right, below and above of each pixel."""
    return np.empty((4, RUN), np.int32), np.empty((4, RUN)), np.empty((4, RUN))


@kernel
def four_texels(number, i, width, start, size):
    """Where the texels of the run's i-th pixel begin: the lower row from left to right, the upper.
    """
    below, above = start + number[2, i] * width * size, start + number[3, i] * width * size
    left, right = number[0, i] * size, number[1, i] * size
    return (np.uintp(below + left), np.uintp(below + right),
            np.uintp(above + left), np.uintp(above + right))


@kernel
def four_weights(weight, i, share):
    """Eqs. (3) and (7)."""
    left, right, below, above = weight[0, i], weight[1, i], weight[2, i], weight[3, i]
    return (share * (below * left), share * (below * right),
            share * (above * left), share * (above * right))


@kernel
def mix(looks, pyramid, colour, channels):
    """Adds what the jobs see to the colour (N C,)."""
    size = np.uintp(len(channels))
    uv, boundary, _, fraction, jobs = looks
    image, smaller, width, height, start = pyramid
    number, weight, slope = room_for_run()
    for job in range(len(jobs)):
        first, end, level, is_upper = jobs[job, 0], jobs[job, 1], jobs[job, 2], jobs[job, 3]
        texels = image if level == 0 else smaller
        along_axis(uv, 0, first, end, width[level], boundary, number, weight, slope)
        along_axis(uv, 1, first, end, height[level], boundary, number, weight, slope)
        for n in range(np.uintp(first), np.uintp(end)):
            i, at = n - np.uintp(first), n * size
            share = fraction[n] if is_upper else 1 - fraction[n]
            a, b, c, d = four_texels(number, i, width[level], start[level], len(channels))
            A, B, C, D = four_weights(weight, i, share)
            for k in range(size):
                colour[at + k] = (colour[at + k] + A * texels[a + k] + B * texels[b + k]
                                  + C * texels[c + k] + D * texels[d + k])


@kernel
def add_texels(looks, pyramid, grad_colour, channels):
    """Backward of `mix`: adds to a pyramid of gradients."""
    size = np.uintp(len(channels))
    uv, boundary, _, fraction, jobs = looks
    image, smaller, width, height, start = pyramid
    number, weight, slope = room_for_run()
    for job in range(len(jobs)):
        first, end, level, is_upper = jobs[job, 0], jobs[job, 1], jobs[job, 2], jobs[job, 3]
        texels = image if level == 0 else smaller
        along_axis(uv, 0, first, end, width[level], boundary, number, weight, slope)
        along_axis(uv, 1, first, end, height[level], boundary, number, weight, slope)
        for n in range(np.uintp(first), np.uintp(end)):
            i = n - np.uintp(first)
            share = fraction[n] if is_upper else 1 - fraction[n]
            a, b, c, d = four_texels(number, i, width[level], start[level], len(channels))
            A, B, C, D = four_weights(weight, i, share)
            for k in range(size):
                grad = grad_colour[n * size + k]
                texels[a + k] += A * grad
                texels[b + k] += B * grad
                texels[c + k] += C * grad
                texels[d + k] += D * grad


@kernel
def add_slopes(looks, pyramid, grad_colour, grad_uv, grad_fraction, channels):
    """Backward of `mix`: adds to grad_uv (2 N,) and grad_fraction (N,)."""
    size = np.uintp(len(channels))
    uv, boundary, _, fraction, jobs = looks
    image, smaller, width, height, start = pyramid
    number, weight, slope = room_for_run()
    for job in range(len(jobs)):
        first, end, level, is_upper = jobs[job, 0], jobs[job, 1], jobs[job, 2], jobs[job, 3]
        texels = image if level == 0 else smaller
        along_axis(uv, 0, first, end, width[level], boundary, number, weight, slope)
        along_axis(uv, 1, first, end, height[level], boundary, number, weight, slope)
        for n in range(np.uintp(first), np.uintp(end)):
            i, u = n - np.uintp(first), np.uintp(2) * n
            share = fraction[n] if is_upper else 1 - fraction[n]
            a, b, c, d = four_texels(number, i, width[level], start[level], len(channels))
            A, B, C, D = 0.0, 0.0, 0.0, 0.0  # the gradients of the four weights
            for k in range(size):
                grad = grad_colour[n * size + k]
                A += texels[a + k] * grad
                B += texels[b + k] * grad
                C += texels[c + k] * grad
                D += texels[d + k] * grad
            left, right, below, above = weight[0, i], weight[1, i], weight[2, i], weight[3, i]
            along_u = (below * (slope[0, i] * A + slope[1, i] * B)
                       + above * (slope[0, i] * C + slope[1, i] * D))
            along_v = (left * (slope[2, i] * A + slope[3, i] * C)
                       + right * (slope[2, i] * B + slope[3, i] * D))
            seen = (A * (below * left) + B * (below * right)
                    + C * (above * left) + D * (above * right))
            grad_uv[u] += share * along_u * width[level]
            grad_uv[u + np.uintp(1)] += share * along_v * height[level]
            grad_fraction[n] += seen if is_upper else -seen


@kernel
def nearest(uv, n, width, height, boundary):
    """Eq. (1): the texel that pixel n sees, and its weight, 1 or 0."""
    u, v = near(uv[2 * n], boundary), near(uv[2 * n + 1], boundary)
    j, j_inside = standing(np.floor(u * width), float(width), boundary)
    i, i_inside = standing(np.floor(v * height), float(height), boundary)
    return int(i) * width + int(j), 1.0 if i_inside & j_inside else 0.0


@kernel
def pick(looks, pyramid, colour, channels):
    """The nearest texels, which filter "nearest" sees."""
    size, jobs = len(channels), looks.jobs
    for n in range(jobs[0, 0], jobs[-1, 1]):
        at, weight = nearest(looks.uv, n, pyramid.width[0], pyramid.height[0], looks.boundary)
        for k in range(size):
            colour[n * size + k] = 0.0 + weight * pyramid.image[at * size + k]


@kernel
def pick_backward(looks, pyramid, grad_colour, channels):
    """Adds to a pyramid of gradients."""
    size, jobs = len(channels), looks.jobs
    for n in range(jobs[0, 0], jobs[-1, 1]):
        at, weight = nearest(looks.uv, n, pyramid.width[0], pyramid.height[0], looks.boundary)
        for k in range(size):
            pyramid.image[at * size + k] += weight * grad_colour[n * size + k]


def constant(count):
    """The channels of a kernel. Compiled code knows how many, unless it would become long."""
    return (0.0,) * count if count <= 4 else np.zeros(count)


def make_looks(flat, pyramid, sampler):
    """Looks for each band of pixels, which share all but the jobs. flat: their footprint."""
    level, fraction = np.zeros(len(flat.uv) // 2), np.empty(len(flat.uv) // 2)
    looks = Looks(flat.uv, BOUNDARIES.index(sampler.boundary), level, fraction)
    top = len(pyramid.start) - 1
    last = (pyramid.smaller if top else pyramid.image)[pyramid.start[-1]:]
    # Where a texel is not finite, neither is the last level, and 0 times it is NaN.
    blends, always = sampler.filter == "linear-mipmap-linear", not np.isfinite(last).all()

    def band(first, end):
        if "mipmap" in sampler.filter:
            pyramid_kernels.levels_of(flat, (pyramid.width[0], pyramid.height[0]), first, end,
                                      level)
        return looks._replace(jobs=find_runs(level, top, blends, always, first, end, fraction))

    return pyramid_kernels.in_steps(band, len(level), pyramid_kernels.STEP)


def prepared(image, footprint, sampler):
    """Looks for each band of pixels, the pyramid, the footprint, also flat, and the channels."""
    image, footprint = require_texture(image, footprint, sampler)
    bias = np.broadcast_to(footprint.bias, footprint.uv.shape[:-1])
    flat = Footprint(*(part if part is None else part.ravel() for part in
                       footprint._replace(bias=bias)))
    channels = constant(image.shape[2])
    pyramid = pyramid_kernels.make_pyramid(image, sampler, channels)
    return make_looks(flat, pyramid, sampler), pyramid, footprint, flat, channels


def texture(image, uv, jacobian=None, bias=0.0, filter="linear", boundary="wrap", max_level=None):
    """As `mipmapping.texture`."""
    bands, pyramid, footprint, _, channels = prepared(image, Footprint(uv, jacobian, bias),
                                                      Sampler(filter, boundary, max_level))
    colour = np.zeros((*footprint.uv.shape[:-1], len(channels)))
    look_up = pick if filter == "nearest" else mix

    def band(looks):
        look_up(looks, pyramid, colour.reshape(-1), channels)

    list(each_band(band, [(looks,) for looks in bands]))
    return colour


def texture_backward(grad_colour, image, uv, jacobian=None, bias=0.0, filter="linear",
                     boundary="wrap", max_level=None):
    """As `mipmapping.texture_backward`."""
    bands, pyramid, footprint, flat, channels = prepared(image, Footprint(uv, jacobian, bias),
                                                         Sampler(filter, boundary, max_level))
    grad_colour = require_gradient(grad_colour, image, footprint).ravel()
    grads = pyramid._replace(image=np.zeros(pyramid.image.size),
                             smaller=np.zeros(pyramid.smaller.size))
    grad_flat = Footprint(*(part if part is None else np.zeros(part.shape) for part in flat))
    add = pick_backward if filter == "nearest" else add_texels

    def texels():
        for looks in bands:
            add(looks, grads, grad_colour, channels)

    def pixels(looks):
        add_slopes(looks, pyramid, grad_colour, grad_flat.uv, grad_flat.bias, channels)
        levels_backward(looks, pyramid, flat.jacobian, grad_flat, filter)

    tasks = [(texels,)] + [(pixels, looks) for looks in bands if filter != "nearest"]
    list(each_band(lambda task, *looks: task(*looks), tasks))
    pyramid_kernels.add_to_image(grads, channels)
    grad_uv, grad_jacobian, grad_bias = grad_flat
    return (grads.image.reshape(np.shape(image)), grad_uv.reshape(np.shape(uv)),
            None if jacobian is None else grad_jacobian.reshape(np.shape(jacobian)),
            grad_bias.reshape(np.shape(bias)) if np.shape(bias) else grad_bias.sum())


def levels_backward(looks, pyramid, jacobian, grad_flat, filter):
    """The way back from the share of the upper level, in grad_flat.bias, to bias and jacobian."""
    first, end = looks.jobs[0, 0], looks.jobs[-1, 1]
    grad_level, part = grad_flat.bias, slice(first, end)
    top = len(pyramid.start) - 1 if filter == "linear-mipmap-linear" else 0
    grad_level[part] = blend_levels_backward(grad_level[part], looks.level[part], top)
    if jacobian is not None:
        pyramid_kernels.squared_sizes_backward(grad_level, jacobian, pyramid.width[0],
                                               pyramid.height[0], first, end, grad_flat.jacobian)
