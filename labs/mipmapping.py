"""Mipmapping: textures that are filtered for the size of a pixel, beforehand.

The equations go on from those of texturing.py; (u, v) and J are as there.

    pyramid:  T_0 = the texture,  T_(l+1)[i, j] = mean of 2 x 2 texels of T_l                (5)
    level = log2 of J's greatest singular value, J in texels = 1/2 log2 (S + R),
    S = (A + B)/2,  R = sqrt((A - B)^2/4 + C^2),
    A = s_x^2 + t_x^2,  B = s_y^2 + t_y^2,  C = s_x s_y + t_x t_y,  s = w u,  t = h v        (6)
    trilinear = (1 - f) T_l + f T_(l+1),  l = floor(level),  f = level - l                   (7)

s_x is ds/dx. Beyond the lecture, as nvdiffrast has it: a bias is added to the level, and then it is
clamped to the pyramid. All levels together are one long T, so a look-up is still one row of M. With
numba, course/fast/texel_kernels.py runs in place of what is marked `has_kernels`.

Sources: Williams 1983 (5), (7); lecture "Differentiable graphics 1" (6); nvdiffrast.
"""
from typing import NamedTuple

import numpy as np

from course.given.compiled import has_kernels

from .texturing import (
    Footprint,
    Sampler,
    bilinear_backward,
    in_parts,
    look_up,
    look_up_backward,
    near_texture,
    nearest_at,
    require_gradient,
    require_texture,
    texels_at,
)


class Mipmap(NamedTuple):
    """A pyramid of L levels in one array."""

    texels: np.ndarray           # (T, C), the levels one after the other
    width: np.ndarray            # (L,) of each level
    height: np.ndarray           # (L,)
    start: np.ndarray            # (L,) the number of its first texel


def halve(image):  # step 6.5
    """Eq. (5): the next level of a pyramid, floats (h, w, C) of even sides -> (h / 2, w / 2, C).

    >>> halve(np.array([[1.0, 3.0, 0.0, 8.0], [5.0, 7.0, 2.0, 2.0]])[..., None])[..., 0]
    array([[4., 3.]])

    A side of 1 stays 1, and a mean is then of two texels.
    """
    raise NotImplementedError("exercise 6.5: halve")


def pyramid(image, max_level=None):  # exercise 6.6 (2 points)
    """Eq. (5): all levels (T_0, T_1, ...), from image (h, w, C) itself down to 1 x 1 texel.

    It ends at level max_level, if that is a number, and where a side is odd and not 1. See
    `demo floor`.

    >>> [level.shape for level in pyramid(np.zeros((12, 4, 3)))]
    [(12, 4, 3), (6, 2, 3), (3, 1, 3)]
    """
    raise NotImplementedError("exercise 6.6: pyramid")


def pyramid_backward(grad_levels):  # extra 6.10 (3 points)
    """Backward of `pyramid`: a gradient for each level -> grad_image (h, w, C), that of level 0.

    grad_levels: a tuple of arrays with the levels' shapes. Each level hands its gradient down.

    >>> top, middle = np.array([[[16.0]]]), np.array([[[4.0], [0.0]], [[0.0], [0.0]]])
    >>> pyramid_backward((np.zeros((4, 4, 1)), middle, top))[..., 0]
    array([[2., 2., 1., 1.],
           [2., 2., 1., 1.],
           [1., 1., 1., 1.],
           [1., 1., 1., 1.]])
    """
    # A mean of n texels gives each of them a share of 1/n.
    grad = grad_levels[-1]
    for grad_level in grad_levels[-2::-1]:
        rows, columns = np.minimum(grad_level.shape[:2], 2)
        grad = grad_level + (grad / (rows * columns)).repeat(columns, 1).repeat(rows, 0)
    return grad


def in_texels(jacobian, width, height):
    """J (N, 2, 2) of u and v -> the rows s_x, s_y and t_x, t_y of s = w u and t = h v (2, 2, N)."""
    scale = np.reshape([width, height], (2, 1, 1))
    return np.multiply(np.moveaxis(jacobian, 0, -1), scale, order="C")  # long rows are faster


def mip_level(jacobian, width, height):  # exercise 6.7 (2 points)
    """Eq. (6): the level whose texels are as large as the footprint is long -> (N,).

    jacobian (N, 2, 2), rows u_x, u_y and v_x, v_y, for a texture of width x height texels. The
    given `in_texels` gives those of s and t.

    >>> jacobian = np.array([[[0.5, 0.0], [0.0, 0.25]], [[0.0, 0.03125], [0.0625, 0.0]]])
    >>> mip_level(jacobian, 16, 16)
    array([3., 0.])

    Fine print. J = 0 has the level -inf. Leave it so: `blend_levels` takes it for 0.
    """
    raise NotImplementedError("exercise 6.7: mip_level")


def mip_level_backward(grad_level, jacobian, width, height):
    """Backward of `mip_level`: grad_level (N,) -> grad_jacobian (N, 2, 2).

    >>> jacobian = np.array([[[0.5, 0.0], [0.0, 0.25]]])
    >>> mip_level_backward(np.array([np.log(2.0)]), jacobian, 16, 16)
    array([[[2., 0.],
            [0., 0.]]])

    Where R = 0, the footprint is a square, and R has a corner as |x| has at 0. There, and only
    there, the derivatives of R count as 0. Where J = 0, the whole gradient is 0.
    """
    s, t = in_texels(jacobian, width, height)
    A, B = s**2 + t**2
    C = s[0] * s[1] + t[0] * t[1]
    S = (A + B) / 2
    R = np.sqrt((A - B)**2 / 4 + C**2)
    # level = ln(S + R) / (2 ln 2), with dS = (dA + dB)/2 and dR = (A - B)/(4 R) (dA - dB) + C/R dC.
    grad_sum = grad_level / (2 * np.log(2) * np.where(S > 0, S + R, np.inf))
    by_root = grad_sum / np.where(R > 0, R, np.inf)
    grad_A = grad_sum / 2 + by_root * (A - B) / 4
    grad_B = grad_sum / 2 - by_root * (A - B) / 4
    grad_C = by_root * C
    grad_lengths = 2 * np.stack([grad_A, grad_B])
    grad_s = width * (grad_lengths * s + grad_C * s[::-1])
    grad_t = height * (grad_lengths * t + grad_C * t[::-1])
    return np.moveaxis(np.stack([grad_s, grad_t]), -1, 0)


def blend_levels(level, top):  # step 6.8
    """Eq. (7): the two levels that a pixel mixes: integers lower, upper and the fraction f (N,).

    level (N,) is first clamped to [0, top], where top is the last level. upper is lower + 1, but at
    most top.

    >>> blend_levels(np.array([-np.inf, 0.25, 1.5, 2.0, 7.0]), 2)
    (array([0, 0, 1, 2, 2]), array([1, 1, 2, 2, 2]), array([0.  , 0.25, 0.5 , 0.  , 0.  ]))
    """
    raise NotImplementedError("exercise 6.8: blend_levels")


def blend_levels_backward(grad_fraction, level, top):
    """Backward of `blend_levels`: grad_fraction (N,) -> grad_level (N,).

    0 unless 0 < level < top: a clamped level does not change. On a whole level the next counts.

    >>> blend_levels_backward(np.array([5.0, 5.0, 5.0, 5.0]), np.array([-1.0, 0.0, 1.0, 2.0]), 2)
    array([0., 0., 5., 0.])
    """
    return np.where((level > 0) & (level < top), grad_fraction, 0)


def pack(levels):
    """The levels of a pyramid -> Mipmap."""
    height, width, channels = np.transpose([level.shape for level in levels])
    start = np.cumsum(width * height) - width * height
    rows = [level.reshape(-1, channels[0]) for level in levels]
    texels = np.concatenate(rows) if len(rows) > 1 else rows[0]  # one level needs no copy
    return Mipmap(texels, width, height, start)


def unpack(texels, mipmap):
    """Texels (T, C) in the order of a Mipmap -> arrays with the shapes of its levels."""
    levels = np.split(texels, mipmap.start[1:])
    return tuple(level.reshape(height, width, -1) for level, width, height in
                 zip(levels, mipmap.width, mipmap.height, strict=True))


def mixture(level, filter_mode, top):
    """Eq. (7): the levels that a look-up mixes, and their shares: [(level (N,), share (N,))]."""
    whole = np.ones(len(level))
    if "mipmap" not in filter_mode:
        return [(np.zeros(len(level), int), whole)]
    lower, upper, fraction = blend_levels(level, top)
    if filter_mode == "linear-mipmap-nearest":
        return [(lower, whole)]
    return [(lower, 1 - fraction), (upper, fraction)]


def taps(uv, level, mipmap, sampler):  # exercise 6.9 (3 points)
    """Eqs. (3) and (7): all texels that make a pixel's colour -> index, weight, inside (N, K).

    uv (N, 2), level (N,). The given `mixture` says which levels, one or two, and their shares. Each
    gives the 4 of `texels_at`, or for the filter "nearest" the one of the given `nearest_at`. Level
    l begins at number mipmap.start[l]. See `demo floor`.

    >>> mipmap = pack((np.zeros((4, 4, 1)), np.zeros((2, 2, 1))))
    >>> how = Sampler("linear-mipmap-linear", "wrap", None)
    >>> taps(np.array([[0.5, 0.1875]]), np.array([0.75]), mipmap, how)[0]
    array([[ 1,  2,  5,  6, 18, 19, 16, 17]])
    """
    raise NotImplementedError("exercise 6.9: taps")


def taps_backward(grad_weight, inside, uv, level, mipmap, sampler):  # exercise 6.12 (4 points)
    """Backward of `taps`, which gave inside: grad_weight (N, K) -> grad_uv (N, 2), grad_level (N,).

    Inside, a weight is share * row's weight * column's weight. Trilinear shares are 1 - f and f,
    and the given `blend_levels_backward` goes from f to the level. Other filters have a grad_level
    of 0, and "nearest" a grad_uv of 0. See `demo floor`.

    >>> mipmap = pack((np.zeros((4, 4, 1)), np.zeros((2, 2, 1))))
    >>> look = np.array([[0.5, 0.1875]]), np.array([0.75]), mipmap
    >>> grad_weight = np.array([[0.0, 0.0, 0.0, 0.0, 0.0, 8.0, 0.0, 0.0]])  # of number 19
    >>> taps_backward(grad_weight, grad_weight > 0, *look,
    ...               Sampler("linear-mipmap-linear", "wrap", None))
    (array([[ 1.5, -6. ]]), array([0.5]))
    """
    raise NotImplementedError("exercise 6.12: taps_backward")


def footprint_level(footprint, mipmap, filter_mode):
    """Eq. (6) plus bias, not clamped: (N,) for N pixels. Only a pyramid's filters need J."""
    uv, jacobian, bias = footprint
    bias = np.broadcast_to(bias, uv.shape[:-1]).reshape(-1)
    if jacobian is None or "mipmap" not in filter_mode:
        return bias
    return mip_level(jacobian.reshape(-1, 2, 2), mipmap.width[0], mipmap.height[0]) + bias


def footprint_level_backward(grad_level, footprint, mipmap):
    """grad_level (N,) -> grad_jacobian, None if there is none, and grad_bias, of their shapes."""
    _, jacobian, bias = footprint
    grad_bias = grad_level.reshape(bias.shape) if bias.ndim else grad_level.sum()
    if jacobian is None:
        return None, grad_bias
    if not grad_level.any():
        return np.zeros(jacobian.shape), grad_bias
    grad_jacobian = mip_level_backward(grad_level, jacobian.reshape(-1, 2, 2),
                                       mipmap.width[0], mipmap.height[0])
    return grad_jacobian.reshape(jacobian.shape), grad_bias


@has_kernels("texel_kernels")
def texture(image, uv, jacobian=None, bias=0.0, filter_mode="linear", boundary="wrap",
            max_level=None):
    """The colour at (u, v), for each pixel of a picture.

    image (h, w, C), uv (..., 2) -> colour (..., C). filter_mode: "nearest" and "linear" look at the
    texture alone. "linear-mipmap-nearest" and "linear-mipmap-linear" look at its pyramid: at the
    floor of each pixel's level, or at two levels, eq. (7). The level is that of jacobian
    (..., 2, 2), d(u, v)/d(x, y), plus bias, (...) or a number; without a jacobian it is the bias.
    boundary: "wrap", "clamp" or "zero". max_level: the pyramid's last level, None for all.

    All arrays are read as float64. ValueError for what does not fit, and for NaN or infinity in uv.
    """
    sampler = Sampler(filter_mode, boundary, max_level)
    image, footprint = require_texture(image, Footprint(uv, jacobian, bias), sampler)
    return filtered(pyramid(image, max_level if "mipmap" in filter_mode else 0), footprint, sampler)


@has_kernels("texel_kernels")
def texture_backward(grad_colour, image, uv, jacobian=None, bias=0.0, filter_mode="linear",
                     boundary="wrap", max_level=None):
    """Backward of `texture`: grad_colour (..., C) -> grad_image, grad_uv, grad_jacobian, grad_bias.

    Each has its argument's shape (None for a jacobian that is None), and is 0 where the argument
    does not matter: uv for "nearest", jacobian and bias for all but "linear-mipmap-linear".
    """
    sampler = Sampler(filter_mode, boundary, max_level)
    image, footprint = require_texture(image, Footprint(uv, jacobian, bias), sampler)
    grad_colour = require_gradient(grad_colour, image, footprint)
    levels = pyramid(image, max_level if "mipmap" in filter_mode else 0)
    grad_levels, *grads = filtered_backward(grad_colour, levels, footprint, sampler)
    return pyramid_backward(grad_levels), *grads


def filtered(levels, footprint, sampler):
    """The colours (..., C) that a Footprint sees of these levels, whoever made them: `places` says
    where pixels look, `taps` which texels they mix, `look_up` mixes them, some pixels at a time.
    """
    mipmap = pack(levels)

    def colours(*place):
        index, weight, _ = taps(*place, mipmap, sampler)
        return look_up(mipmap.texels, index, weight)

    colour = in_parts(colours, *places(mipmap, footprint, sampler))
    return colour.reshape(*footprint.uv.shape[:-1], levels[0].shape[-1])


def filtered_backward(grad_colour, levels, footprint, sampler):
    """Backward of `filtered`: grad_colour (N, C) -> a gradient for each level, grad_uv,
    grad_jacobian, grad_bias.
    """
    mipmap = pack(levels)
    # `filtered` read upwards: the look-up, its taps, the level.
    index, weight, inside = all_taps(mipmap, footprint, sampler)
    grad_texels, grad_weight = look_up_backward(grad_colour, mipmap.texels, index, weight)
    grad_uv, grad_level = in_parts(lambda *place: taps_backward(*place, mipmap, sampler),
                                   grad_weight, inside, *places(mipmap, footprint, sampler))
    grad_jacobian, grad_bias = footprint_level_backward(grad_level, footprint, mipmap)
    return (unpack(grad_texels, mipmap), grad_uv.reshape(footprint.uv.shape), grad_jacobian,
            grad_bias)


def all_taps(mipmap, footprint, sampler):
    """The `taps` of all N pixels of a Footprint: index, weight, inside (N, K)."""
    return in_parts(lambda *place: taps(*place, mipmap, sampler),
                    *places(mipmap, footprint, sampler))


def places(mipmap, footprint, sampler):
    """Where the N pixels of a Footprint look: uv (N, 2) and level (N,)."""
    return (near_texture(footprint.uv, sampler.boundary).reshape(-1, 2),
            footprint_level(footprint, mipmap, sampler.filter_mode))
