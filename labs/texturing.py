"""Texturing: the colour of a surface from a picture, filtered for the size of a pixel.

A texture is a picture (h, w, C). A surface point has coordinates (u, v); u runs along the columns
and v along the rows, (0, 0) is the corner of texel [0, 0], texel j has its centre at (j + 1/2) / w.

    nearest:  j = floor(w u)                                 along the columns; rows alike   (1)
    linear:   x = w u - 1/2,  j = floor(x),  a = x - j,  weights 1 - a of j, a of j + 1      (2)
    look-up = sum of (weight along rows) (weight along columns) texel, 1 or 2 x 2 of them    (3)
    truth = mean of the texture over the pixel: (u, v) + J d,  d in [-1/2, 1/2]^2            (4)
    pyramid:  T_0 = the texture,  T_(l+1)[i, j] = mean of 2 x 2 texels of T_l                (5)
    level = log2 of J's greatest singular value, J in texels = 1/2 log2 (S + R),
    S = (A + B)/2,  R = sqrt((A - B)^2/4 + C^2),
    A = s_x^2 + t_x^2,  B = s_y^2 + t_y^2,  C = s_x s_y + t_x t_y,  s = w u,  t = h v        (6)
    trilinear = (1 - f) T_l + f T_(l+1),  l = floor(level),  f = level - l                   (7)

J = d(u, v)/d(x, y) is the change of (u, v) from pixel to pixel; s_x is ds/dx. (J must be in texels:
with u and v as they are, nearly all levels are negative.) Beyond the lecture, as nvdiffrast has it:
a bias is added to the level, and then it is clamped to the pyramid.

A look-up is linear in the texture: out = M T, with a few weights in each row of the sparse matrix
M. So the gradient by the texture is M^T grad_out, and all of a pyramid is one long T.

Sources: lecture "Differentiable graphics 1" (1)-(4), (6); Williams 1983 (5), (7); nvdiffrast.
"""
import numpy as np
from scipy.sparse import csr_array

BOUNDARIES = "wrap", "clamp", "zero"
FILTERS = "nearest", "linear", "linear-mipmap-nearest", "linear-mipmap-linear"
LARGEST = 1e15   # of uv and of its derivatives: more has no digit left for a texel
CHUNK = 1 << 13  # points in flight at once: they stay in the cache


def nearest_texel(x, size):  # exercise 6.1 (1 point)
    """Eq. (1): the number of the texel that holds x, along one axis with size texels.

    x (...); size a whole number, or an array of them that broadcasts -> index (...), integers,
    below 0 or from size on where x is not in [0, 1). On the border of two texels, the upper one.

    >>> nearest_texel(np.array([0.0, 0.49, 0.5, 1.0, -0.1]), 4)
    array([ 0,  1,  2,  4, -1])
    """
    raise NotImplementedError("exercise 6.1: nearest_texel")


def linear_texels(x, size):  # exercise 6.2 (2 points)
    """Eq. (2): the two texels whose centres x lies between, along one axis, and their weights.

    x (...), size as in `nearest_texel` -> index (2, ...), integers j and j + 1, also outside of
    the texture; weight (2, ...), with sum 1. On a centre, j is this texel, its weight is 1.

    >>> linear_texels(np.array([0.375, 0.25, 0.025]), 4)
    (array([[ 1,  0, -1],
           [ 2,  1,  0]]), array([[1. , 0.5, 0.4],
           [0. , 0.5, 0.6]]))
    """
    raise NotImplementedError("exercise 6.2: linear_texels")


def wrap(index, size):
    """The texture repeats: index (...), any integers -> index (...) in it; inside, True for all.

    A boundary is a function of a texel's number along one axis. It tells which texel stands for
    it, from 0 to size - 1, and whether there is one at all: where not inside, the texel is 0.
    size as in `nearest_texel`.

    >>> wrap(np.array([-5, -1, 0, 3, 4]), 4)
    (array([3, 3, 0, 3, 0]), array([ True,  True,  True,  True,  True]))
    """
    return index % size, np.ones(np.shape(index), bool)


def clamp(index, size):  # exercise 6.3 (1 point)
    """The first and the last texel go on for ever: index (...) -> index, inside (...), as `wrap`.

    >>> clamp(np.array([-5, -1, 0, 3, 4]), 4)
    (array([0, 0, 0, 3, 3]), array([ True,  True,  True,  True,  True]))
    """
    raise NotImplementedError("exercise 6.3: clamp")


def zero(index, size):  # exercise 6.4 (1 point)
    """Beyond the texture is nothing: index (...) -> index, inside (...), as `wrap`.

    A number outside comes back as 0, which is a texel that there is, and with inside = False.

    >>> zero(np.array([-5, -1, 0, 3, 4]), 4)
    (array([0, 0, 0, 3, 0]), array([False, False,  True,  True, False]))
    """
    raise NotImplementedError("exercise 6.4: zero")


def look_up(texels, index, weight):  # exercise 6.5 (2 points)
    """Eq. (3): colour (N, C), colour[n] = sum over k of weight[n, k] texels[index[n, k]].

    texels (T, C); index (N, K), integers from 0 to T - 1, of which some may be equal;
    weight (N, K), any numbers.

    >>> texels = np.array([[0.0, 1.0], [10.0, 2.0], [30.0, 3.0]])
    >>> look_up(texels, np.array([[0, 2], [1, 1]]), np.array([[0.5, 0.5], [0.25, 0.25]]))
    array([[15.,  2.],
           [ 5.,  1.]])
    """
    raise NotImplementedError("exercise 6.5: look_up")


def look_up_backward(grad_colour, texels, index, weight):  # exercise 6.6 (3 points)
    """Backward of `look_up`: grad_colour (N, C) -> grad_texels (T, C), grad_weight (N, K).

    A texel may be named many times, in one row and in several: its gradients add up.

    >>> texels = np.array([[0.0, 1.0], [10.0, 2.0], [30.0, 3.0]])
    >>> index, weight = np.array([[0, 2], [2, 2]]), np.array([[0.5, 0.5], [0.25, 0.75]])
    >>> look_up_backward(np.array([[1.0, 0.0], [0.0, 10.0]]), texels, index, weight)
    (array([[ 0.5,  0. ],
           [ 0. ,  0. ],
           [ 0.5, 10. ]]), array([[ 0., 30.],
           [30., 30.]]))
    """
    raise NotImplementedError("exercise 6.6: look_up_backward")


def in_parts(function, *arrays):
    """function(*arrays), arrays (N, ...), for CHUNK of the N at a time -> (N, ...), or a tuple."""
    cuts = range(0, max(len(arrays[0]), 1), CHUNK)
    parts = [function(*(array[n:n + CHUNK] for array in arrays)) for n in cuts]
    if isinstance(parts[0], tuple):
        return tuple(np.concatenate(part) for part in zip(*parts, strict=True))
    return np.concatenate(parts)


def both_axes(row_start, column, row_weight, column_weight):
    """Eq. (3): what is found along rows and along columns, K of each, as K^2 texels of a picture.

    row_start (K, N): the numbers of the rows' first texels, counted row by row; column and both
    weights (K, N) -> index, weight (N, K^2); number K i + j is of row i and column j.
    """
    index, weight = row_start[:, None] + column, row_weight[:, None] * column_weight
    count = len(column)**2
    return index.reshape(count, -1).T, weight.reshape(count, -1).T


def bilinear_backward(grad_weight, uv, width, height):  # exercise 6.7 (3 points)
    """Backward of eqs. (2) and (3): from the weights of 2 x 2 texels, (N, 4), to grad_uv (N, 2).

    weight[n, 2 i + j] = row_weight[i, n] column_weight[j, n], which are the weights of
    `linear_texels(v, height)` and of `linear_texels(u, width)`; uv (N, 2); width and height are
    numbers or (N,). j counts as a constant, so da/dx = 1 everywhere; on a texel's centre this is
    the derivative from above.

    >>> bilinear_backward(np.array([[0.0, 0.0, 0.0, 1.0]]), np.array([[0.125, 0.1875]]), 8, 4)
    array([[2., 2.]])
    """
    raise NotImplementedError("exercise 6.7: bilinear_backward")


def footprint_points(uv, jacobian, n):  # exercise 6.8 (2 points)
    """Eq. (4): where to ask for a pixel's mean: n x n points of its footprint, (n^2, N, 2).

    uv (N, 2) at the pixels' centres, jacobian (N, 2, 2) = d(u, v)/d(x, y), rows u and v. The pixel
    is cut into n x n equal squares; the points are uv + J d, d their centres, measured from the
    pixel's: first the lowest row, each row from left to right.

    >>> footprint_points(np.array([[0.5, 0.5]]), np.array([[[0.4, 0.0], [0.0, 0.8]]]), 2)[:, 0]
    array([[0.4, 0.3],
           [0.6, 0.3],
           [0.4, 0.7],
           [0.6, 0.7]])
    """
    raise NotImplementedError("exercise 6.8: footprint_points")


def halve(image):  # exercise 6.9 (2 points)
    """Eq. (5): the next level of a pyramid: image (h, w, C) -> means of 2 x 2 texels.

    A side of 1 stays 1, and then the means are of the two texels along the other side. Sides of
    more than 1 are even; not both are 1.

    >>> halve(np.array([[1.0, 3.0, 0.0, 8.0], [5.0, 7.0, 2.0, 2.0]])[..., None])[..., 0]
    array([[4., 3.]])
    >>> halve(np.array([[1.0], [4.0]])[..., None])[..., 0]
    array([[2.5]])
    """
    raise NotImplementedError("exercise 6.9: halve")


def halve_backward(grad_half, image):  # exercise 6.10 (2 points)
    """Backward of `halve`: its gradient -> grad_image (h, w, C), as large as image.

    >>> halve_backward(np.array([[4.0, 8.0]])[..., None], np.zeros((2, 4, 1)))[..., 0]
    array([[1., 1., 2., 2.],
           [1., 1., 2., 2.]])
    """
    raise NotImplementedError("exercise 6.10: halve_backward")


def pyramid(image, max_level=None):
    """Eq. (5): (T_0, T_1, ...), from image (h, w, C) down to 1 x 1, or to level max_level.

    It ends earlier where a side is odd, and not 1. (nvdiffrast refuses such a texture, unless
    max_level ends the pyramid there.)
    """
    levels = [image]
    while max_level is None or len(levels) <= max_level:
        sides = levels[-1].shape[:2]
        if max(sides) == 1 or any(side > 1 and side % 2 for side in sides):
            break
        levels.append(halve(levels[-1]))
    return tuple(levels)


def pyramid_backward(grad_levels):  # exercise 6.11 (2 points)
    """Backward of `pyramid`: a gradient for each level -> grad_image (h, w, C) by level 0.

    grad_levels: a tuple of arrays, the gradient by each level as if it stood alone; their shapes
    are those of the levels. What a level was made of gets what comes down from it, and so on.

    >>> top, middle = np.array([[[16.0]]]), np.array([[[4.0]], [[0.0]]])
    >>> pyramid_backward((np.zeros((4, 2, 1)), middle, top))[..., 0]
    array([[3., 3.],
           [3., 3.],
           [2., 2.],
           [2., 2.]])
    """
    raise NotImplementedError("exercise 6.11: pyramid_backward")


def mip_level(jacobian, width, height):  # exercise 6.12 (3 points)
    """Eq. (6): the level whose texels are as large as the footprint is long, not clamped: (N,).

    jacobian (N, 2, 2), rows u_x, u_y and v_x, v_y, of u and v from 0 to 1; width and height of
    the texture in texels. J = 0 has level -inf, without a warning.

    >>> jacobian = np.array([[[0.5, 0.0], [0.0, 0.25]], [[0.0, 0.03125], [0.0625, 0.0]]])
    >>> mip_level(jacobian, 16, 16)
    array([3., 0.])
    """
    raise NotImplementedError("exercise 6.12: mip_level")


def mip_level_backward(grad_level, jacobian, width, height):  # exercise 6.13 (3 points)
    """Backward of `mip_level`: grad_level (N,) -> grad_jacobian (N, 2, 2).

    Where R of eq. (6) is 0, the pixel's footprint is a square, and R has a corner there, as |x|
    has: the derivatives of R count as 0. Where J = 0, all of the gradient is 0.

    >>> jacobian = np.array([[[0.5, 0.0], [0.0, 0.25]]])
    >>> mip_level_backward(np.array([np.log(2.0)]), jacobian, 16, 16)
    array([[[2., 0.],
            [0., 0.]]])
    """
    raise NotImplementedError("exercise 6.13: mip_level_backward")


def blend_levels(level, top):  # exercise 6.14 (2 points)
    """Eq. (7): which two levels a pixel mixes: lower (N,), upper (N,), integers; fraction f (N,).

    level (N,), any numbers, -inf and inf too, is first clamped to [0, top]; top is the pyramid's
    last level. lower is its floor, upper the next level or top, the lesser of both.

    >>> blend_levels(np.array([-np.inf, 0.25, 1.5, 2.0, 7.0]), 2)
    (array([0, 0, 1, 2, 2]), array([1, 1, 2, 2, 2]), array([0.  , 0.25, 0.5 , 0.  , 0.  ]))
    """
    raise NotImplementedError("exercise 6.14: blend_levels")


def blend_levels_backward(grad_fraction, level, top):  # exercise 6.15 (1 point)
    """Backward of `blend_levels`: grad_fraction (N,) -> grad_level (N,).

    0 unless 0 < level < top: a level that is clamped does not change, and at the ends it counts
    as clamped. On a whole level between them, the one above it counts.

    >>> blend_levels_backward(np.array([5.0, 5.0, 5.0, 5.0]), np.array([-1.0, 0.0, 1.0, 2.0]), 2)
    array([0., 0., 5., 0.])
    """
    raise NotImplementedError("exercise 6.15: blend_levels_backward")


def footprint_mean(image, uv, jacobian, n, boundary="wrap"):
    """Eq. (4) by brute force: the mean of `nearest_texel` at n x n points of each footprint.

    image (h, w, C), uv (N, 2), jacobian (N, 2, 2) -> (N, C). The truth that filters are for.
    """
    total = np.zeros((len(uv), image.shape[2]))
    for points in footprint_points(uv, jacobian, n):
        total += texture(image, points, filter="nearest", boundary=boundary)
    return total / n**2


def in_a_row(levels):
    """The levels of a pyramid -> texels (T, C), one after the other; sizes (3, L): the width and
    height of each level, and the number of its first texel.
    """
    channels = levels[0].shape[2]
    height, width, _ = np.transpose([level.shape for level in levels])
    start = np.cumsum(width * height) - width * height
    texels = [level.reshape(-1, channels) for level in levels]
    texels = np.concatenate(texels) if len(levels) > 1 else texels[0]  # of one level, no copy
    return texels, np.stack([width, height, start])


def out_of_a_row(texels, levels):
    """The other way round: texels (T, C) -> a tuple of arrays with the shapes of the levels."""
    ends = np.cumsum([level.shape[0] * level.shape[1] for level in levels])
    return tuple(part.reshape(level.shape) for part, level in
                 zip(np.split(texels, ends[:-1]), levels, strict=True))


def texels_at(uv, level, sizes, filter, boundary):
    """Eqs. (1) to (3): index, weight, inside (N, K) of the texels of each point in its level.

    uv (N, 2), level (N,), sizes (3, L) of `in_a_row`. Where not inside, the weight is 0.
    """
    width, height, start = sizes.take(level, 1)
    axes = []
    for x, size in (uv[:, 1], height), (uv[:, 0], width):
        if filter == "nearest":
            index = nearest_texel(x, size)[None]
            weight = np.ones(index.shape)
        else:
            index, weight = linear_texels(x, size)
        axes.append((*{"wrap": wrap, "clamp": clamp, "zero": zero}[boundary](index, size), weight))
    (row, row_inside, row_weight), (column, column_inside, column_weight) = axes
    index, weight = both_axes(start + row * width, column, row_weight, column_weight)
    inside = both_axes(row, column, row_inside, column_inside)[1]
    return index, weight * inside, inside


def mixture(level, filter, top):
    """Eq. (7): the levels that a look-up mixes, and their shares: [(level (N,), share (N, 1))]."""
    if "mipmap" not in filter:
        return [(np.zeros(level.shape, int), np.ones((*level.shape, 1)))]
    lower, upper, fraction = blend_levels(level, top)
    if filter == "linear-mipmap-nearest":
        return [(lower, np.ones((*level.shape, 1)))]
    return [(lower, 1 - fraction[:, None]), (upper, fraction[:, None])]


def pixel_levels(image, jacobian, bias, filter, shape):
    """Eq. (6) plus bias, not clamped: (N,) for the N pixels of a shape. Some filters need none."""
    bias = np.broadcast_to(bias, shape).reshape(-1)
    if jacobian is None or "mipmap" not in filter:
        return bias
    height, width, _ = image.shape
    return in_parts(lambda j: mip_level(j, width, height), jacobian.reshape(-1, 2, 2)) + bias


def pixel_levels_backward(grad_level, image, jacobian, bias):
    """grad_level (N,) -> grad_jacobian, grad_bias, of their arguments' shapes; or None."""
    grad_bias = grad_level.reshape(np.shape(bias)) if np.ndim(bias) else grad_level.sum()
    if jacobian is None or not grad_level.any():
        return None if jacobian is None else np.zeros(jacobian.shape), grad_bias
    height, width, _ = image.shape
    grad_jacobian = in_parts(lambda grad, j: mip_level_backward(grad, j, width, height),
                             grad_level, jacobian.reshape(-1, 2, 2))
    return grad_jacobian.reshape(jacobian.shape), grad_bias


def texture(image, uv, jacobian=None, bias=0.0, filter="linear", boundary="wrap", max_level=None):
    """The colour at (u, v), for each pixel of a picture.

    image (h, w, C), uv (..., 2) -> colour (..., C). filter: "nearest" and "linear" look at the
    texture alone. "linear-mipmap-nearest" and "linear-mipmap-linear" look at its pyramid: at the
    floor of each pixel's level, or at two levels, eq. (7). The level is that of jacobian
    (..., 2, 2), d(u, v)/d(x, y), plus bias, (...) or a number; of the bias alone if jacobian is
    None. boundary: "wrap", "clamp" or "zero". max_level: the pyramid's last level, None for all.
    ValueError for what does not fit.
    """
    require_texture(image, uv, jacobian, bias, filter, boundary, max_level)
    levels = pyramid(image, max_level if "mipmap" in filter else 0)
    texels, sizes = in_a_row(levels)

    def colours(uv, pixel_level):
        total = 0
        for level, share in mixture(pixel_level, filter, len(levels) - 1):
            index, weight, _ = texels_at(uv, level, sizes, filter, boundary)
            total = total + look_up(texels, index, weight * share)
        return total

    pixel_level = pixel_levels(image, jacobian, bias, filter, uv.shape[:-1])
    colour = in_parts(colours, uv.reshape(-1, 2), pixel_level)
    return colour.reshape(*uv.shape[:-1], image.shape[2])


def look_backward(grad_colour, texels, uv, level, share, sizes, filter, boundary):
    """Backward of one of the look-ups that are mixed: grad_texels, grad_uv, grad_share (N,)."""
    index, weight, inside = in_parts(lambda *point: texels_at(*point, sizes, filter, boundary),
                                     uv, level)
    grad_texels, grad_weight = look_up_backward(grad_colour, texels, index, weight * share)
    grad_share = np.einsum("nk,nk->n", grad_weight, weight)
    if filter == "nearest":
        return grad_texels, np.zeros(uv.shape), grad_share
    grad_uv = in_parts(bilinear_backward, grad_weight * inside * share, uv,
                       *sizes[:2].take(level, 1))
    return grad_texels, grad_uv, grad_share


def texture_backward(grad_colour, image, uv, jacobian=None, bias=0.0, filter="linear",
                     boundary="wrap", max_level=None):
    """Backward of `texture`: grad_colour (..., C) -> grad_image, grad_uv, grad_jacobian, grad_bias.

    Each has its argument's shape (None for a jacobian that is None), and is 0 where the argument
    does not matter: uv for "nearest", jacobian and bias for all but "linear-mipmap-linear".
    """
    require_texture(image, uv, jacobian, bias, filter, boundary, max_level)
    if np.shape(grad_colour) != (*uv.shape[:-1], image.shape[2]):
        raise ValueError("texture_backward expects a grad_colour with the colours' shape "
                         f"{(*uv.shape[:-1], image.shape[2])}, got {np.shape(grad_colour)}")
    levels = pyramid(image, max_level if "mipmap" in filter else 0)
    texels, sizes = in_a_row(levels)
    points, grad_colour = uv.reshape(-1, 2), grad_colour.reshape(-1, image.shape[2])
    pixel_level = pixel_levels(image, jacobian, bias, filter, uv.shape[:-1])
    looks = [look_backward(grad_colour, texels, points, level, share, sizes, filter, boundary)
             for level, share in mixture(pixel_level, filter, len(levels) - 1)]
    by_texels, by_uv, by_share = zip(*looks, strict=True)
    grad_levels = out_of_a_row(sum(by_texels[1:], by_texels[0]), levels)
    grad_level = np.zeros(len(points))
    if filter == "linear-mipmap-linear":
        grad_level = blend_levels_backward(by_share[1] - by_share[0], pixel_level, len(levels) - 1)
    grad_jacobian, grad_bias = pixel_levels_backward(grad_level, image, jacobian, bias)
    return pyramid_backward(grad_levels), sum(by_uv).reshape(uv.shape), grad_jacobian, grad_bias


def require_texture(image, uv, jacobian, bias, filter, boundary, max_level):
    """ValueError, in one sentence, unless the arguments of `texture` fit each other."""
    def require(fits, expected, came):
        if not fits:
            raise ValueError(f"texture expects {expected}, got {came}")

    require(filter in FILTERS, f"a filter out of {', '.join(FILTERS)}", repr(filter))
    require(boundary in BOUNDARIES, f"a boundary out of {', '.join(BOUNDARIES)}", repr(boundary))
    require(np.ndim(image) == 3 and np.size(image), "an image (h, w, C) with at least one texel; "
            "give a grey one as image[..., None]", np.shape(image))
    require(np.shape(uv)[-1:] == (2,) and (np.abs(uv) < LARGEST).all(),
            f"uv (..., 2) of numbers below {LARGEST:g}; give (0, 0) where no face is seen",
            f"{np.shape(uv)}, or a larger number or NaN in it")
    pixels = np.shape(uv)[:-1]
    require(np.shape(bias) in ((), pixels) and np.isfinite(bias).all(),
            f"a finite bias {pixels}, one for each uv, or one number",
            f"{np.shape(bias)}, or NaN or infinity in it")
    if jacobian is not None:
        require(np.shape(jacobian) == (*pixels, 2, 2) and (np.abs(jacobian) < LARGEST).all(),
                f"a jacobian {(*pixels, 2, 2)} of numbers below {LARGEST:g}, or None",
                f"{np.shape(jacobian)}, or a larger number or NaN in it")
    require(max_level is None or max_level >= 0, "a max_level of 0 or more, or None for all levels",
            max_level)
