"""Texel kernels: mipmapping.py's `texture` and its gradients, many pixels of one level at a time.

    find_runs    neighbours that look into the same level of the pyramid, at most RUN of them
    along_axis   eq. (2) for a run: few steps without a branch, several pixels at a time
    mix          eq. (3): the run's colours; and the way back to the texels, on one thread, in the
                 order of the pixels
    add_slopes   the way back to (u, v) and to the level

Pyramids are those of pyramid_kernels.py. All arrays are flat: pixel n has its colour at C n.
"""
from collections import namedtuple

import numpy as np

from course.given.compiled import each_band, kernel

from . import pyramid_kernels
from .mipmapping import blend_levels_backward
from .texturing import BOUNDARIES, Footprint, Sampler, require_gradient, require_texture

RUN = 1 << 8
WRAP, CLAMP = BOUNDARIES.index("wrap"), BOUNDARIES.index("clamp")


# Where pixels look: uv (2 N,) and the boundary; level and fraction (N,), eq. (7). And jobs for some
# of them (J,): first <= n < end look into a level, which may be the upper of two.
Looks = namedtuple("Looks", "uv boundary level fraction first end into is_upper")

# What a run of pixels sees along both axes: number, weight, slope (2, 2, RUN) of the texel before
# each pixel's place and of the next, on axis u and on v. slope: the weight's change from texel to
# texel. Where a texel is not inside, weight and slope are 0.
Taps = namedtuple("Taps", "number weight slope")

# One of the jobs of Looks, and the level of the pyramid.
Job = namedtuple("Job", "first end is_upper start width height")


@kernel
def find_runs(level, top, blends, always, part, fraction):
    """`mixture` of pixels first <= n < end of a part: their fraction -> the jobs of Looks.

    blends: eq. (7) is asked for. always: also where one level has the share 0.
    """
    first, end = part
    key = np.empty(end - first, np.int32)
    for n in range(np.uintp(first), np.uintp(end)):
        clamped = min(max(level[n], 0.0), float(top))
        lower = np.floor(clamped)
        mixes = blends & (always | ((clamped > 0) & (clamped < top)))
        fraction[n] = clamped - lower if blends else 0.0
        key[n - np.uintp(first)] = 2 * np.int32(lower) + mixes
    return jobs_of(key, first, top)


@kernel
def jobs_of(key, first, top):
    """The jobs of pixels from first on. key: twice the lower level, and 1 if the upper counts."""
    firsts, ends, levels, uppers = np.empty((4, 2 * len(key)), np.intp)
    count, begin = 0, 0
    for i in range(1, len(key) + 1):
        if i == len(key) or key[i] != key[begin] or i == begin + RUN:
            for upper in range(1 + key[begin] % 2):
                firsts[count], ends[count] = first + begin, first + i
                levels[count], uppers[count] = min(key[begin] // 2 + upper, top), upper
                count += 1
            begin = i
    return (firsts[:count].copy(), ends[:count].copy(), levels[:count].copy(),
            uppers[:count].copy())


@kernel
def near(x, boundary):
    """`near_texture`"""
    return x - np.trunc(x) if boundary == WRAP else min(max(x, -1.0), 2.0)


@kernel
def address(j, size, boundary):
    """`texturing.address`, all as floats."""
    if boundary == WRAP:  # -1 - size <= j <= size
        j = j + size if j < 0 else j
        j = j + size if j < 0 else j
        return (j if j < size else 0.0), True
    if boundary == CLAMP:
        return min(max(j, 0.0), size - 1), True
    inside = (j >= 0) & (j < size)
    return (j if inside else 0.0), inside


@kernel
def along_axis(uv, boundary, axis, job, size, taps):
    """Eq. (2) of a run along one axis: what `linear_texels` finds."""
    number, weight, slope = taps
    for n in range(np.uintp(job.first), np.uintp(job.end)):
        i = n - np.uintp(job.first)
        position = near(uv[np.uintp(2) * n + np.uintp(axis)], boundary) * size - 0.5
        below = np.floor(position)
        j, j_inside = address(below, size, boundary)
        k, k_inside = address(below + 1, size, boundary)
        number[axis, 0, i], number[axis, 1, i] = np.int32(j), np.int32(k)
        weight[axis, 0, i] = 1 - (position - below) if j_inside else 0.0
        weight[axis, 1, i] = position - below if k_inside else 0.0
        slope[axis, 0, i] = -1.0 if j_inside else 0.0
        slope[axis, 1, i] = 1.0 if k_inside else 0.0


@kernel
def room_for_run():
    """Taps of which nothing is written yet."""
    return Taps(np.empty((2, 2, RUN), np.int32), np.empty((2, 2, RUN)), np.empty((2, 2, RUN)))


@kernel
def begun(looks, pyramid, number, taps):
    """One of the jobs: its Job, its Taps, and the texels that its level is in."""
    level = looks.into[number]
    job = Job(looks.first[number], looks.end[number], looks.is_upper[number] == 1,
              pyramid.start[level], pyramid.width[level], pyramid.height[level])
    along_axis(looks.uv, looks.boundary, 0, job, float(job.width), taps)
    along_axis(looks.uv, looks.boundary, 1, job, float(job.height), taps)
    return job, pyramid.image if level == 0 else pyramid.smaller


@kernel
def four_texels(number, job, n, size):
    """Where the texels of pixel n begin: the lower row from left to right, the upper."""
    i = n - np.uintp(job.first)
    below = job.start + number[1, 0, i] * job.width * size
    above = job.start + number[1, 1, i] * job.width * size
    left, right = number[0, 0, i] * size, number[0, 1, i] * size
    return (np.uintp(below + left), np.uintp(below + right),
            np.uintp(above + left), np.uintp(above + right))


@kernel
def share_of(job, n, fraction):
    """Eq. (7): how much of a level pixel n sees."""
    return fraction[n] if job.is_upper else 1 - fraction[n]


@kernel
def four_weights(weight, job, n, fraction):
    """Eqs. (3) and (7)."""
    i = n - np.uintp(job.first)
    share = share_of(job, n, fraction)
    left, right, below, above = weight[0, 0, i], weight[0, 1, i], weight[1, 0, i], weight[1, 1, i]
    return (share * (below * left), share * (below * right),
            share * (above * left), share * (above * right))


@kernel
def mix(looks, pyramid, colour, grad_colour, channels):
    """Adds what the jobs see to the colour (N C,), or adds grad_colour (N C,) to a pyramid of
    gradients, which is the backward pass. One of the two is None, and not compiled.
    """
    size = np.uintp(len(channels))
    taps = room_for_run()
    number, weight, _ = taps
    fraction = looks.fraction
    for each in range(len(looks.first)):
        job, texels = begun(looks, pyramid, each, taps)
        for n in range(np.uintp(job.first), np.uintp(job.end)):
            a, b, c, d = four_texels(number, job, n, len(channels))
            A, B, C, D = four_weights(weight, job, n, fraction)
            for k in range(size):
                at = n * size + k
                if colour is not None:
                    colour[at] = (colour[at] + A * texels[a + k] + B * texels[b + k]
                                  + C * texels[c + k] + D * texels[d + k])
                if grad_colour is not None:
                    grad = grad_colour[at]
                    texels[a + k] += A * grad
                    texels[b + k] += B * grad
                    texels[c + k] += C * grad
                    texels[d + k] += D * grad


@kernel
def add_slopes(looks, pyramid, grad_colour, grad_uv, grad_fraction, channels):
    """Backward of `mix`: adds to grad_uv (2 N,) and grad_fraction (N,)."""
    size = np.uintp(len(channels))
    taps = room_for_run()
    number, weight, slope = taps
    fraction = looks.fraction
    for each in range(len(looks.first)):
        job, texels = begun(looks, pyramid, each, taps)
        for n in range(np.uintp(job.first), np.uintp(job.end)):
            a, b, c, d = four_texels(number, job, n, len(channels))
            A, B, C, D = 0.0, 0.0, 0.0, 0.0  # the gradients of the four weights
            for k in range(size):
                grad = grad_colour[n * size + k]
                A += texels[a + k] * grad
                B += texels[b + k] * grad
                C += texels[c + k] * grad
                D += texels[d + k] * grad
            along_u, along_v, seen = place_gradient((A, B, C, D), weight, slope, job, n)
            share = share_of(job, n, fraction)
            grad_uv[np.uintp(2) * n] += share * along_u * job.width
            grad_uv[np.uintp(2) * n + np.uintp(1)] += share * along_v * job.height
            grad_fraction[n] += seen if job.is_upper else -seen


@kernel
def place_gradient(grad_weights, weight, slope, job, n):
    """The gradients of a pixel's place in texels, before its share counts, and of this share."""
    A, B, C, D = grad_weights
    i = n - np.uintp(job.first)
    left, right, below, above = weight[0, 0, i], weight[0, 1, i], weight[1, 0, i], weight[1, 1, i]
    along_u = (below * (slope[0, 0, i] * A + slope[0, 1, i] * B)
               + above * (slope[0, 0, i] * C + slope[0, 1, i] * D))
    along_v = (left * (slope[1, 0, i] * A + slope[1, 1, i] * C)
               + right * (slope[1, 0, i] * B + slope[1, 1, i] * D))
    seen = (A * (below * left) + B * (below * right) + C * (above * left) + D * (above * right))
    return along_u, along_v, seen


@kernel
def nearest(looks, pyramid, n):
    """Eq. (1): the texel that pixel n sees, and its weight, 1 or 0."""
    width, height = pyramid.width[0], pyramid.height[0]
    u, v = near(looks.uv[2 * n], looks.boundary), near(looks.uv[2 * n + 1], looks.boundary)
    j, j_inside = address(np.floor(u * width), float(width), looks.boundary)
    i, i_inside = address(np.floor(v * height), float(height), looks.boundary)
    return int(i) * width + int(j), 1.0 if i_inside & j_inside else 0.0


@kernel
def pick(looks, pyramid, colour, grad_colour, channels):
    """As `mix`, but of the nearest texels, which filter "nearest" sees."""
    size = len(channels)
    for n in range(looks.first[0], looks.end[-1]):
        number, weight = nearest(looks, pyramid, n)
        for k in range(size):
            at, texel = n * size + k, number * size + k
            if colour is not None:
                colour[at] = 0.0 + weight * pyramid.image[texel]
            if grad_colour is not None:
                pyramid.image[texel] += weight * grad_colour[at]


def constant(count):
    """The channels of a kernel. Compiled code knows how many, unless it would become long."""
    return (0.0,) * count if count <= 4 else np.zeros(count)


def make_looks(flat, pyramid, sampler):
    """Looks for each band of pixels, which share all but the jobs. flat: their footprint."""
    level, fraction = np.zeros(len(flat.uv) // 2), np.empty(len(flat.uv) // 2)
    shared = flat.uv, BOUNDARIES.index(sampler.boundary), level, fraction
    top = len(pyramid.start) - 1
    last = (pyramid.smaller if top else pyramid.image)[pyramid.start[-1]:]
    blends = sampler.filter_mode == "linear-mipmap-linear"
    # Where a texel is not finite, neither is the last level, and 0 times it is NaN.
    always = not np.isfinite(last).all()

    def band(first, end):
        if "mipmap" in sampler.filter_mode:
            pyramid_kernels.levels_of(flat, pyramid, first, end, level)
        return Looks(*shared, *find_runs(level, top, blends, always, (first, end), fraction))

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


def texture(image, uv, jacobian=None, bias=0.0, filter_mode="linear", boundary="wrap",
            max_level=None):
    """As `mipmapping.texture`."""
    bands, pyramid, footprint, _, channels = prepared(image, Footprint(uv, jacobian, bias),
                                                      Sampler(filter_mode, boundary, max_level))
    colour = np.zeros((*footprint.uv.shape[:-1], len(channels)))
    look_up = pick if filter_mode == "nearest" else mix

    def band(looks):
        look_up(looks, pyramid, colour.reshape(-1), None, channels)

    list(each_band(band, [(looks,) for looks in bands]))
    return colour


def texture_backward(grad_colour, image, uv, jacobian=None, bias=0.0, filter_mode="linear",
                     boundary="wrap", max_level=None):
    """As `mipmapping.texture_backward`."""
    bands, pyramid, footprint, flat, channels = prepared(image, Footprint(uv, jacobian, bias),
                                                         Sampler(filter_mode, boundary, max_level))
    grad_colour = require_gradient(grad_colour, image, footprint).ravel()
    grads = pyramid._replace(image=np.zeros(pyramid.image.size),
                             smaller=np.zeros(pyramid.smaller.size))
    grad_flat = Footprint(*(part if part is None else np.zeros(part.shape) for part in flat))
    add = pick if filter_mode == "nearest" else mix

    def texels():
        for looks in bands:
            add(looks, grads, None, grad_colour, channels)

    def pixels(looks):
        add_slopes(looks, pyramid, grad_colour, grad_flat.uv, grad_flat.bias, channels)
        levels_backward(looks, pyramid, flat.jacobian, grad_flat, filter_mode)

    tasks = [(texels,)] + [(pixels, looks) for looks in bands if filter_mode != "nearest"]
    list(each_band(lambda task, *looks: task(*looks), tasks))
    pyramid_kernels.add_to_image(grads, channels)
    grad_uv, grad_jacobian, grad_bias = grad_flat
    return (grads.image.reshape(np.shape(image)), grad_uv.reshape(np.shape(uv)),
            None if jacobian is None else grad_jacobian.reshape(np.shape(jacobian)),
            grad_bias.reshape(np.shape(bias)) if np.shape(bias) else grad_bias.sum())


def levels_backward(looks, pyramid, jacobian, grad_flat, filter_mode):
    """The way back from the share of the upper level, in grad_flat.bias, to bias and jacobian."""
    first, end = looks.first[0], looks.end[-1]
    grad_level = grad_flat.bias
    part = slice(first, end)
    top = len(pyramid.start) - 1 if filter_mode == "linear-mipmap-linear" else 0
    grad_level[part] = blend_levels_backward(grad_level[part], looks.level[part], top)
    if jacobian is not None:
        pyramid_kernels.squared_sizes_backward(grad_level, jacobian, pyramid.width[0],
                                               pyramid.height[0], first, end, grad_flat.jacobian)
