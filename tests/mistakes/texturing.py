"""Mistakes of lab 6; each docstring goes on after "this is what comes out when"."""


def nearest_texel(x, size):
    """it is cut towards 0: below 0 it is one too high"""
    return (x * size).astype(int)


def nearest_texel(x, size):
    """it is rounded: a texel lies between two borders, not around one"""
    return np.round(x * size).astype(int)


def nearest_texel(x, size):
    """half a texel is taken away; that is for the linear filter"""
    return np.floor(x * size - 0.5).astype(int)


def linear_texels(x, size):
    """texel j is taken to lie at j / size, which is its border, not its centre"""
    position = x * size
    first = np.floor(position)
    weight, first = position - first, first.astype(int)
    return np.stack([first, first + 1]), np.stack([1 - weight, weight])


def linear_texels(x, size):
    """the two weights are swapped"""
    position = x * size - 0.5
    first = np.floor(position)
    weight, first = position - first, first.astype(int)
    return np.stack([first, first + 1]), np.stack([weight, 1 - weight])


def linear_texels(x, size):
    """it is cut towards 0: below 0 it is one too high"""
    position = x * size - 0.5
    first = np.trunc(position)
    weight, first = position - first, first.astype(int)
    return np.stack([first, first + 1]), np.stack([1 - weight, weight])


def clamp(index, size):
    """the last texel is number size; it is size - 1"""
    return np.clip(index, 0, size), np.ones(np.shape(index), bool)


def clamp(index, size):
    """the texture repeats; its border goes on for ever"""
    return index % size, np.ones(np.shape(index), bool)


def clamp(index, size):
    """below 0 the texture is mirrored; there is its border"""
    return np.minimum(np.abs(index), size - 1), np.ones(np.shape(index), bool)


def zero(index, size):
    """number size counts as inside; the last one is size - 1"""
    inside = (index >= 0) & (index <= size)
    return np.where(inside, index, 0), inside


def zero(index, size):
    """texel 0 counts as outside"""
    inside = (index > 0) & (index < size)
    return np.where(inside, index, 0), inside


def zero(index, size):
    """a number outside comes back; it becomes 0"""
    inside = (index >= 0) & (index < size)
    return index, inside


def look_up(texels, index, weight):
    """the weights are left out"""
    return texels[index].sum(1)


def look_up(texels, index, weight):
    """it is divided by the sum of the weights; they are taken as they are"""
    return np.einsum("nk,nkc->nkc", weight, texels[index]).sum(1) / weight.sum(1, keepdims=True)


def look_up(texels, index, weight):
    """it is the mean of the weighed texels instead of their sum"""
    return np.einsum("nk,nkc->nkc", weight, texels[index]).mean(1)


def look_up_backward(grad_colour, texels, index, weight):
    """a texel that a row names twice gets one of its gradients; they add up"""
    grad_weight = in_parts(lambda grad, texel: np.einsum("nc,nkc->nk", grad, texels.take(texel, 0)),
                           grad_colour, index)
    grad_texels = np.zeros(texels.shape)
    for at, w, g in zip(index, weight, grad_colour, strict=True):
        grad_texels[at] += w[:, None] * g
    return grad_texels, grad_weight


def look_up_backward(grad_colour, texels, index, weight):
    """each texel gets the whole gradient, not its weight's"""
    start = np.arange(0, index.size + 1, index.shape[1])
    matrix = csr_array((weight.ravel(), index.ravel(), start), (len(index), len(texels)))
    grad_weight = in_parts(lambda grad, texel: np.einsum("nc,nkc->nk", grad, texels.take(texel, 0)),
                           grad_colour, index)
    return (matrix != 0).T @ grad_colour, grad_weight


def look_up_backward(grad_colour, texels, index, weight):
    """the weights' gradient is the mean over the channels instead of the sum"""
    start = np.arange(0, index.size + 1, index.shape[1])
    matrix = csr_array((weight.ravel(), index.ravel(), start), (len(index), len(texels)))
    grad_weight = in_parts(
        lambda grad, texel: np.einsum("nc,nkc->nk", grad, texels.take(texel, 0) / texels.shape[1]),
        grad_colour,
        index,
    )
    return matrix.T @ grad_colour, grad_weight


def bilinear_backward(grad_weight, uv, width, height):
    """sizes are left out: u runs from 0 to 1, x from 0 to the width"""
    _, row_weight = linear_texels(uv[:, 1], height)
    _, column_weight = linear_texels(uv[:, 0], width)
    grad_weight = grad_weight.T.reshape(2, 2, -1)
    grad_row = (grad_weight * column_weight).sum(1)
    grad_column = (grad_weight * row_weight[:, None]).sum(0)
    return np.stack([(grad_column[1] - grad_column[0]),
                     (grad_row[1] - grad_row[0])], -1)


def bilinear_backward(grad_weight, uv, width, height):
    """width and height are swapped"""
    _, row_weight = linear_texels(uv[:, 1], height)
    _, column_weight = linear_texels(uv[:, 0], width)
    grad_weight = grad_weight.T.reshape(2, 2, -1)
    grad_row = (grad_weight * column_weight).sum(1)
    grad_column = (grad_weight * row_weight[:, None]).sum(0)
    return np.stack(
        [(grad_column[1] - grad_column[0]) * height, (grad_row[1] - grad_row[0]) * width], -1
    )


def bilinear_backward(grad_weight, uv, width, height):
    """the gradients by u and by v are swapped"""
    _, row_weight = linear_texels(uv[:, 1], height)
    _, column_weight = linear_texels(uv[:, 0], width)
    grad_weight = grad_weight.T.reshape(2, 2, -1)
    grad_row = (grad_weight * column_weight).sum(1)
    grad_column = (grad_weight * row_weight[:, None]).sum(0)
    return np.stack(
        [(grad_row[1] - grad_row[0]) * height, (grad_column[1] - grad_column[0]) * width], -1
    )


def footprint_points(uv, jacobian, n):
    """d is measured from the pixel's lower left corner instead of its centre"""
    offset = (np.arange(n) + 0.5) / n
    d = np.stack(np.meshgrid(offset, offset), -1).reshape(-1, 1, 2)
    return uv + (jacobian * d[..., None, :]).sum(-1)


def footprint_points(uv, jacobian, n):
    """the Jacobian is transposed"""
    offset = (np.arange(n) + 0.5) / n - 0.5
    d = np.stack(np.meshgrid(offset, offset), -1).reshape(-1, 1, 2)
    return uv + (jacobian * d[..., None]).sum(-2)


def footprint_points(uv, jacobian, n):
    """points go column by column; they go row by row"""
    offset = (np.arange(n) + 0.5) / n - 0.5
    d = np.stack(np.meshgrid(offset, offset, indexing="ij"), -1).reshape(-1, 1, 2)
    return uv + (jacobian * d[..., None, :]).sum(-1)


def halve(image):
    """texels are summed instead of averaged"""
    rows, columns = np.minimum(image.shape[:2], 2)
    means = image[::rows] + image[rows - 1::rows]
    return means[:, ::columns] + means[:, columns - 1::columns]


def halve(image):
    """only one texel of each 2 x 2 is looked at"""
    rows, columns = np.minimum(image.shape[:2], 2)
    return image[::rows, ::columns]


def halve(image):
    """with a side of 1 it is divided by 4; a mean is of two texels there"""
    rows, columns = np.minimum(image.shape[:2], 2)
    means = (image[::rows] + image[rows - 1::rows]) / 2
    return (means[:, ::columns] + means[:, columns - 1::columns]) / 2 * (rows * columns / 4)


def halve_backward(grad_half, image):
    """each texel gets the whole gradient, not its share"""
    rows, columns = np.minimum(image.shape[:2], 2)
    return grad_half.repeat(rows, 0).repeat(columns, 1)


def halve_backward(grad_half, image):
    """with a side of 1 it is divided by 4; a mean is of two texels"""
    rows, columns = np.minimum(image.shape[:2], 2)
    return grad_half.repeat(rows, 0).repeat(columns, 1) / 4


def halve_backward(grad_half, image):
    """the whole picture is repeated; each of its texels must be"""
    rows, columns = np.minimum(image.shape[:2], 2)
    return np.tile(grad_half, (rows, columns, 1)) / (rows * columns)


def pyramid_backward(grad_levels):
    """what a level itself has for a gradient is forgotten"""
    grad = grad_levels[-1]
    for grad_level in grad_levels[-2::-1]:
        grad = halve_backward(grad, grad_level)
    return grad


def pyramid_backward(grad_levels):
    """only the gradient of level 0 itself counts"""
    grad = grad_levels[-1]
    grad = grad_levels[0]
    return grad


def pyramid_backward(grad_levels):
    """what comes down a level is not shared out among the four texels"""
    grad = grad_levels[-1]
    for grad_level in grad_levels[-2::-1]:
        grad = grad_level + 4 * halve_backward(grad, grad_level)
    return grad


def mip_level(jacobian, width, height):
    """J is not in texels"""
    s_x, s_y, t_x, t_y = (jacobian).reshape(-1, 4).T
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    with np.errstate(divide="ignore"):
        return np.log2((A + B) / 2 + np.sqrt((A - B)**2 / 4 + C**2)) / 2


def mip_level(jacobian, width, height):
    """width and height are swapped"""
    s_x, s_y, t_x, t_y = (jacobian * [[height], [width]]).reshape(-1, 4).T
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    with np.errstate(divide="ignore"):
        return np.log2((A + B) / 2 + np.sqrt((A - B)**2 / 4 + C**2)) / 2


def mip_level(jacobian, width, height):
    """the 1/2 is left out: S + R is the square of a length"""
    s_x, s_y, t_x, t_y = (jacobian * [[width], [height]]).reshape(-1, 4).T
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    with np.errstate(divide="ignore"):
        return np.log2((A + B) / 2 + np.sqrt((A - B)**2 / 4 + C**2))


def mip_level_backward(grad_level, jacobian, width, height):
    """the sizes are left out on the way back"""
    s_x, s_y, t_x, t_y = (jacobian * [[width], [height]]).reshape(-1, 4).T
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    S, R = (A + B) / 2, np.sqrt((A - B)**2 / 4 + C**2)
    grad_sum = grad_level / (2 * np.log(2) * np.where(S > 0, S + R, np.inf))
    corner = np.where(R > 0, R, np.inf)
    grad_A = grad_sum * (1 / 2 + (A - B) / (4 * corner))
    grad_B = grad_sum * (1 / 2 - (A - B) / (4 * corner))
    grad_C = grad_sum * C / corner
    grad = np.stack([2 * grad_A * s_x + grad_C * s_y, 2 * grad_B * s_y + grad_C * s_x,
                     2 * grad_A * t_x + grad_C * t_y, 2 * grad_B * t_y + grad_C * t_x], -1)
    return grad.reshape(-1, 2, 2)


def mip_level_backward(grad_level, jacobian, width, height):
    """the logarithm of base 2 is derived like the natural one"""
    s_x, s_y, t_x, t_y = (jacobian * [[width], [height]]).reshape(-1, 4).T
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    S, R = (A + B) / 2, np.sqrt((A - B)**2 / 4 + C**2)
    grad_sum = grad_level / (2 * np.where(S > 0, S + R, np.inf))
    corner = np.where(R > 0, R, np.inf)
    grad_A = grad_sum * (1 / 2 + (A - B) / (4 * corner))
    grad_B = grad_sum * (1 / 2 - (A - B) / (4 * corner))
    grad_C = grad_sum * C / corner
    grad = np.stack([2 * grad_A * s_x + grad_C * s_y, 2 * grad_B * s_y + grad_C * s_x,
                     2 * grad_A * t_x + grad_C * t_y, 2 * grad_B * t_y + grad_C * t_x], -1)
    return grad.reshape(-1, 2, 2) * [[width], [height]]


def mip_level_backward(grad_level, jacobian, width, height):
    """the 1/2 before the logarithm is left out"""
    s_x, s_y, t_x, t_y = (jacobian * [[width], [height]]).reshape(-1, 4).T
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    S, R = (A + B) / 2, np.sqrt((A - B)**2 / 4 + C**2)
    grad_sum = grad_level / (np.log(2) * np.where(S > 0, S + R, np.inf))
    corner = np.where(R > 0, R, np.inf)
    grad_A = grad_sum * (1 / 2 + (A - B) / (4 * corner))
    grad_B = grad_sum * (1 / 2 - (A - B) / (4 * corner))
    grad_C = grad_sum * C / corner
    grad = np.stack([2 * grad_A * s_x + grad_C * s_y, 2 * grad_B * s_y + grad_C * s_x,
                     2 * grad_A * t_x + grad_C * t_y, 2 * grad_B * t_y + grad_C * t_x], -1)
    return grad.reshape(-1, 2, 2) * [[width], [height]]


def blend_levels(level, top):
    """the level is rounded; the lower one is its floor"""
    level = np.clip(level, 0, top)
    lower = np.round(level).astype(int)
    return lower, np.minimum(lower + 1, top), level - lower


def blend_levels(level, top):
    """upper is beyond the pyramid's last level"""
    level = np.clip(level, 0, top)
    lower = np.floor(level).astype(int)
    return lower, lower + 1, level - lower


def blend_levels(level, top):
    """the fraction is that of the lower level; f is the upper one's"""
    level = np.clip(level, 0, top)
    lower = np.floor(level).astype(int)
    return lower, np.minimum(lower + 1, top), lower + 1 - level


def blend_levels_backward(grad_fraction, level, top):
    """levels 0 and top have a gradient; they count as clamped"""
    return np.where((level >= 0) & (level <= top), grad_fraction, 0)


def blend_levels_backward(grad_fraction, level, top):
    """levels that are clamped have a gradient"""
    return grad_fraction


def blend_levels_backward(grad_fraction, level, top):
    """only the upper end is looked at"""
    return np.where(level < top, grad_fraction, 0)
