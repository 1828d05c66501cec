"""Texturing: the colour of a surface from a picture that is laid upon it.

A texture is a picture (h, w, C). A surface point has coordinates (u, v): u runs along the columns
and v along the rows. (0, 0) is the corner of texel [0, 0], and texel j has its centre at
(j + 1/2) / w.

    nearest:  j = floor(w u)                                 along the columns; rows alike   (1)
    linear:   p = w u - 1/2,  j = floor(p),  a = p - j,  weights 1 - a of j, a of j + 1      (2)
    colour = sum over k of weight_k texel_k,  weight = (row's weight) (column's weight)      (3)
    truth = mean of the texture over the pixel: (u, v) + J d,  d in [-1/2, 1/2]^2            (4)

The sum (3) is over 1 texel, or over 2 x 2. J = d(u, v)/d(x, y) is the change of (u, v) from pixel
to pixel. mipmapping.py comes near to (4) with few texels, and has the whole `texture` and its
backward pass.

A look-up is linear in the texture: out = M T, with a few weights in each row of the sparse matrix
M. So the gradient with respect to the texture is M^T grad_out.

Source: lecture "Differentiable graphics 1".
"""
from typing import NamedTuple

import numpy as np
from scipy.sparse import csr_array

from course.given.arrays import in_chunks

FILTERS = "nearest", "linear", "linear-mipmap-nearest", "linear-mipmap-linear"
BOUNDARIES = "wrap", "clamp", "zero"
LARGEST = 1e60  # of a jacobian: its fourth power, in texels, is still a number


class Footprint(NamedTuple):
    """What pixels see of a texture. The bias is for mipmapping.py."""

    uv: np.ndarray               # (..., 2)
    jacobian: np.ndarray | None  # (..., 2, 2)
    bias: np.ndarray             # (...) or ()


class Sampler(NamedTuple):
    """How a texture is read."""

    filter_mode: str
    boundary: str
    max_level: int | None


def nearest_texel(x, size):
    """Eq. (1): the number of the texel that holds x, along one axis with size texels.

    x (...), size an integer or an array of them -> index (...), integers. Where x is not in [0, 1),
    they are below 0, or size and more. On the border of two texels it is the upper one.

    >>> nearest_texel(np.array([0.0, 0.49, 0.5, 1.0, -0.1]), 4)
    array([ 0,  1,  2,  4, -1])
    """
    return np.floor(x * size).astype(int)


def linear_texels(x, size):  # step 6.1
    """Eq. (2): the two texels around x, which is u or v, along an axis of size texels.

    x and size (...) -> index (2, ...), j and j + 1, also outside of the texture, and weight
    (2, ...).

    >>> linear_texels(np.array([0.375, 0.25, 0.025]), 4)
    (array([[ 1,  0, -1],
           [ 2,  1,  0]]), array([[1. , 0.5, 0.4],
           [0. , 0.5, 0.6]]))
    """
    raise NotImplementedError("exercise 6.1: linear_texels")


def address(index, size, boundary):
    """Which texel does an index name, along an axis of size texels? index -> index, inside (...).

    "wrap": the texture repeats. "clamp": its first and its last texel go on for ever. "zero":
    nothing lies beyond, and an index outside comes back as 0 with inside = False.

    >>> address(np.array([-5, -1, 0, 3, 4]), 4, "wrap")[0]
    array([3, 3, 0, 3, 0])
    >>> address(np.array([-5, -1, 0, 3, 4]), 4, "zero")
    (array([0, 0, 0, 3, 0]), array([False, False,  True,  True, False]))
    """
    if boundary == "zero":
        inside = (index >= 0) & (index < size)
        return np.where(inside, index, 0), inside
    index = index % size if boundary == "wrap" else np.clip(index, 0, size - 1)
    return index, np.ones(index.shape, bool)


def each_pair(combine, rows, columns):
    """combine(rows[i], columns[j]) for all i, j: (2, N) twice -> (4, N), number 2 i + j."""
    return combine(rows[:, None], columns).reshape(4, -1)


def texels_at(uv, width, height, boundary):  # exercise 6.2 (3 points)
    """Eqs. (2) and (3): the 2 x 2 texels around uv (N, 2) -> index, weight, inside (4, N).

    Texel [i, j] has the number width i + j. First comes the row of the lower number. width, height:
    numbers, or (N,). boundary is for the given `address`. Where not inside, the weight is 0. See
    `demo floor`.

    >>> index, weight, _ = texels_at(np.array([[0.5, 0.1875]]), 4, 4, "wrap")
    >>> index.T, weight.T
    (array([[1, 2, 5, 6]]), array([[0.375, 0.375, 0.125, 0.125]]))
    """
    raise NotImplementedError("exercise 6.2: texels_at")


def nearest_at(uv, width, height, boundary):
    """Eq. (1): index, weight, inside (1, N) of the one texel at each place, as `texels_at`."""
    column, column_inside = address(nearest_texel(uv[:, 0], width), width, boundary)
    row, row_inside = address(nearest_texel(uv[:, 1], height), height, boundary)
    inside = row_inside & column_inside
    return (row * width + column)[None], inside[None].astype(float), inside[None]


def look_up(texels, index, weight):  # step 6.3
    """Eq. (3): the colours (N, C) of N look-ups, each of them the weighted sum of K texels.

    texels (T, C), index (N, K) into them, weight (N, K).

    >>> texels = np.array([[0.0, 1.0], [10.0, 2.0], [30.0, 3.0]])
    >>> look_up(texels, np.array([[0, 2], [1, 1]]), np.array([[0.5, 0.5], [0.25, 0.25]]))
    array([[15.,  2.],
           [ 5.,  1.]])
    """
    raise NotImplementedError("exercise 6.3: look_up")


def look_up_backward(grad_colour, texels, index, weight):
    """Backward of `look_up`: grad_colour (N, C) -> grad_texels (T, C), grad_weight (N, K).

    A texel may be named many times, in one row and in several. Its gradients add up.

    >>> texels = np.array([[0.0, 1.0], [10.0, 2.0], [30.0, 3.0]])
    >>> index, weight = np.array([[0, 2], [2, 2]]), np.array([[0.5, 0.5], [0.25, 0.75]])
    >>> look_up_backward(np.array([[1.0, 0.0], [0.0, 10.0]]), texels, index, weight)
    (array([[ 0.5,  0. ],
           [ 0. ,  0. ],
           [ 0.5, 10. ]]), array([[ 0., 30.],
           [30., 30.]]))
    """
    # colour = M texels, so grad_texels = M^T grad_colour: what was gathered is scattered. This is
    # `scatter` of arrays.py, four times as fast. The derivative of colour[n] with respect to
    # weight[n, k] is texels[index[n, k]].
    matrix = look_up_matrix(len(texels), index, weight)

    def by_weight(grad, texel):
        return (texels.take(texel, 0) @ grad[..., None])[..., 0]

    grad_weight = in_parts(by_weight, grad_colour, index)
    return matrix.T @ grad_colour, grad_weight


def look_up_matrix(texel_count, index, weight):
    """M, sparse (N, T), of T = texel_count texels: index, weight (N, K) as `look_up` has them.

    IndexError if an index names no texel. SciPy would read, and write, beside the texture.
    """
    if index.size and not 0 <= index.min() <= index.max() < texel_count:
        raise IndexError(f"look-ups name texels {index.min()} to {index.max()} of {texel_count}, "
                         "counted from 0: leave out pixels that see no face")
    start = np.arange(0, index.size + 1, index.shape[1])  # of each row's entries
    return csr_array((weight.ravel(), index.ravel(), start), (len(index), texel_count))


def in_parts(function, *arrays):
    """function(*arrays) -> an array, or several, (N, ...): for the rows of `in_chunks` in turn."""
    chunks = list(zip(*map(in_chunks, arrays), strict=True)) or [arrays]  # of no rows, for shapes
    parts = [function(*chunk) for chunk in chunks]
    if isinstance(parts[0], tuple):
        return tuple(np.concatenate(part) for part in zip(*parts, strict=True))
    return np.concatenate(parts)


def near_texture(x, boundary):
    """(u, v) or one of them (...), finite, moved to -1 ... 2, where the same texels are found.

    There a texel's number fits into an integer. The texture repeats exactly at whole numbers.
    """
    return x - np.trunc(x) if boundary == "wrap" else np.clip(x, -1, 2)


def bilinear_backward(grad_weight, uv, width, height):  # step 6.11
    """Backward of eqs. (2) and (3): grad_weight (N, 4) of 2 x 2 texels -> grad_uv (N, 2).

    weight[:, 2 i + j] = row[i] column[j]. By `linear_texels`, row comes from v and height, column
    from u and width, which may be arrays (N,).

    >>> bilinear_backward(np.array([[0.0, 0.0, 0.0, 1.0]]), np.array([[0.125, 0.1875]]), 8, 4)
    array([[2., 2.]])

    The weights have a corner on a texel's centre. There, take that for a larger u or v.
    """
    raise NotImplementedError("exercise 6.11: bilinear_backward")


def footprint_points(uv, jacobian, n):  # extra 6.4 (2 points)
    """Eq. (4): n x n points uv + J d of each pixel's footprint -> (n^2, N, 2).

    uv (N, 2), jacobian (N, 2, 2). Cut the pixel into n x n equal squares. d goes from the pixel's
    centre to theirs, the lowest row first, each row from left to right.

    >>> footprint_points(np.array([[0.5, 0.5]]), np.array([[[0.4, 0.0], [0.0, 0.8]]]), 2)[:, 0]
    array([[0.4, 0.3],
           [0.6, 0.3],
           [0.4, 0.7],
           [0.6, 0.7]])
    """
    offset = (np.arange(n) + 0.5) / n - 0.5
    d = np.stack(np.meshgrid(offset, offset), -1).reshape(-1, 1, 2)
    return uv + (jacobian * d[..., None, :]).sum(-1)


def footprint_mean(image, uv, jacobian, n, boundary="wrap"):
    """Eq. (4) by brute force: the mean of the nearest texels at n x n points of each footprint.

    image (h, w, C), uv (N, 2), jacobian (N, 2, 2) -> (N, C). The truth that filters are for.
    """
    uv, jacobian, _ = require_footprint(Footprint(uv, jacobian, 0.0))
    height, width, channels = image.shape
    texels = image.reshape(-1, channels)
    total = np.zeros((len(uv), channels))
    for points in footprint_points(uv, jacobian, n):
        points = near_texture(points, boundary)
        index, weight, _ = nearest_at(points, width, height, boundary)
        total += look_up(texels, index.T, weight.T)
    return total / n**2


def require(fits, expected, came):
    """ValueError, in one sentence, unless what came fits."""
    if not fits:
        raise ValueError(f"texture expects {expected}, got {came}")


def require_footprint(footprint, axes=2):
    """The footprint as float64. ValueError if its parts do not fit. axes: 3 for cube_maps.py."""
    uv, jacobian, bias = (None if part is None else np.asarray(part, float) for part in footprint)
    name, nowhere = {2: ("uv", (0, 0)), 3: ("directions", (0, 0, 0))}[axes]
    require(uv.shape[-1:] == (axes,) and np.isfinite(uv).all(),
            f"{name} (..., {axes}) of finite numbers; give {nowhere} where no face is seen",
            f"{uv.shape}, or NaN or infinity in it")
    pixels = uv.shape[:-1]
    require(bias.shape in ((), pixels) and np.isfinite(bias).all(),
            f"a finite bias {pixels}, one for each pixel of {name}, or one number",
            f"{bias.shape}, or NaN or infinity in it")
    if jacobian is not None:
        require(jacobian.shape == (*pixels, axes, 2) and (np.abs(jacobian) < LARGEST).all(),
                f"a jacobian {(*pixels, axes, 2)} of numbers below {LARGEST:g}, or None",
                f"{jacobian.shape}, or a larger number or NaN in it")
    return Footprint(uv, jacobian, bias)


def require_gradient(grad_colour, image, footprint):
    """The rows (N, C) of grad_colour, as float64. ValueError unless it has the colours' shape."""
    grad_colour = np.asarray(grad_colour, float)
    shape = *footprint.uv.shape[:-1], image.shape[2]
    require(grad_colour.shape == shape, f"a grad_colour with the colours' shape {shape}",
            grad_colour.shape)
    return grad_colour.reshape(-1, image.shape[2])


def require_texture(image, footprint, sampler, axes=2):
    """The arguments of `texture` -> image, footprint as float64. ValueError if they do not fit."""
    filter_mode, boundary, max_level = sampler
    require(filter_mode in FILTERS, f"a filter out of {', '.join(FILTERS)}", repr(filter_mode))
    require(boundary in BOUNDARIES, f"a boundary out of {', '.join(BOUNDARIES)}", repr(boundary))
    require(max_level is None or max_level >= 0, "a max_level of 0 or more, or None for all levels",
            max_level)
    image = np.asarray(image, float)
    require(image.ndim == 3 and image.size, "an image (h, w, C) with at least one texel; "
            "give a grey one as image[..., None]", image.shape)
    return image, require_footprint(footprint, axes)
