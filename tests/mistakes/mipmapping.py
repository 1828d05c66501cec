"""Mistakes of lab 6; each docstring goes on after "this is what comes out when"."""


def halve(image):
    """the four texels are summed instead of averaged: the division by 4 is missing"""
    rows, columns = np.minimum(image.shape[:2], 2)
    means = image[::rows] + image[rows - 1::rows]
    return means[:, ::columns] + means[:, columns - 1::columns]


def halve(image):
    """one texel of each 2 x 2, every second one, is taken instead of their mean"""
    rows, columns = np.minimum(image.shape[:2], 2)
    return image[::rows, ::columns]


def halve(image):
    """with a side of 1 it is still divided by 4, or filled up with zeros; a mean is of two texels
    there"""
    rows, columns = np.minimum(image.shape[:2], 2)
    means = (image[::rows] + image[rows - 1::rows]) / 2
    return (means[:, ::columns] + means[:, columns - 1::columns]) / 2 * (rows * columns / 4)


def halve(image):
    """the sum of the 2 x 2 texels is halved, so it is twice as bright; it must be divided by 4"""
    return (image[::2, ::2] + image[1::2, ::2] + image[::2, 1::2] + image[1::2, 1::2]) / 2


def halve(image):
    """far texels are averaged, which are no neighbours: each side is split by the reshape into
    (2, h / 2), with half the picture between the two, instead of (h / 2, 2)"""
    height, width, channels = image.shape
    rows, columns = min(height, 2), min(width, 2)
    return image.reshape(rows, height // rows, columns, width // columns, channels).mean((0, 2))


def halve(image):
    """the largest of the four texels is taken (as in max pooling) instead of their mean"""
    rows, columns = np.minimum(image.shape[:2], 2)
    largest = np.maximum(image[::rows], image[rows - 1::rows])
    return np.maximum(largest[:, ::columns], largest[:, columns - 1::columns])


def halve_backward(grad_half, image):
    """each texel gets the whole gradient instead of a quarter: it is not divided by 4"""
    rows, columns = np.minimum(image.shape[:2], 2)
    return grad_half.repeat(rows, 0).repeat(columns, 1)


def halve_backward(grad_half, image):
    """it is always divided by 4, also with a side of 1, where a mean is of two texels"""
    rows, columns = np.minimum(image.shape[:2], 2)
    return grad_half.repeat(rows, 0).repeat(columns, 1) / 4


def halve_backward(grad_half, image):
    """the whole picture is repeated (tile) instead of each of its texels (repeat)"""
    rows, columns = np.minimum(image.shape[:2], 2)
    return np.tile(grad_half, (rows, columns, 1)) / (rows * columns)


def halve_backward(grad_half, image):
    """only one texel of each 2 x 2 gets a gradient; all four are in the mean"""
    grad = np.zeros(image.shape)
    rows, columns = np.minimum(image.shape[:2], 2)
    grad[::rows, ::columns] = grad_half
    return grad


def pyramid_backward(grad_levels):
    """only the last level's gradient comes down: each other level's own gradient is left out"""
    grad = grad_levels[-1]
    for grad_level in grad_levels[-2::-1]:
        grad = halve_backward(grad, grad_level)
    return grad


def pyramid_backward(grad_levels):
    """only the gradient of level 0 itself counts: the higher levels hand nothing down"""
    return grad_levels[0]


def pyramid_backward(grad_levels):
    """what comes down a level is not divided by 4: it is only repeated, and each of the four
    texels gets the whole gradient"""
    grad = grad_levels[-1]
    for grad_level in grad_levels[-2::-1]:
        grad = grad_level + 4 * halve_backward(grad, grad_level)
    return grad


def pyramid_backward(grad_levels):
    """only levels 0 and 1 reach the image: level 2 and the higher levels hand nothing down"""
    if len(grad_levels) == 1:
        return grad_levels[0]
    return grad_levels[0] + halve_backward(grad_levels[1], grad_levels[0])


def pyramid_backward(grad_levels):
    """the gradient of level 0 itself, the image's own gradient, is left out"""
    grad = grad_levels[-1]
    for number in range(len(grad_levels) - 2, -1, -1):
        grad = halve_backward(grad, grad_levels[number])
        grad = grad + (grad_levels[number] if number else 0)
    return grad


def mip_level(jacobian, width, height):
    """J is not in texels: u must be multiplied by width, and v by height"""
    s_x, s_y, t_x, t_y = (jacobian).reshape(-1, 4).T
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    with np.errstate(divide="ignore"):
        return np.log2((A + B) / 2 + np.sqrt((A - B)**2 / 4 + C**2)) / 2


def mip_level(jacobian, width, height):
    """width and height are exchanged: u runs along the width, v along the height"""
    s_x, s_y, t_x, t_y = (jacobian * [[height], [width]]).reshape(-1, 4).T
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    with np.errstate(divide="ignore"):
        return np.log2((A + B) / 2 + np.sqrt((A - B)**2 / 4 + C**2)) / 2


def mip_level(jacobian, width, height):
    """the factor 1/2 (a square root) is left out: S + R is the square of the singular value"""
    s_x, s_y, t_x, t_y = (jacobian * [[width], [height]]).reshape(-1, 4).T
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    with np.errstate(divide="ignore"):
        return np.log2((A + B) / 2 + np.sqrt((A - B)**2 / 4 + C**2))


def mip_level(jacobian, width, height):
    """the natural logarithm (np.log, to base e) is taken; the level is the one to base 2, log2"""
    s_x, s_y, t_x, t_y = (jacobian * [[width], [height]]).reshape(-1, 4).T
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    with np.errstate(divide="ignore"):
        return np.log((A + B) / 2 + np.sqrt((A - B)**2 / 4 + C**2)) / 2


def mip_level(jacobian, width, height):
    """the smallest singular value is taken, S - R instead of S + R: the footprint's shorter
    axis"""
    texels = jacobian * [[width], [height]]
    with np.errstate(divide="ignore"):
        return np.log2(np.linalg.svd(texels, compute_uv=False)[:, -1])


def mip_level(jacobian, width, height):
    """C is left out: the longer of d/dx and d/dy is taken, the larger of A and B (OpenGL's rule),
    instead of the greatest singular value"""
    texels = jacobian * [[width], [height]]
    with np.errstate(divide="ignore"):
        return np.log2(np.linalg.norm(texels, axis=1).max(-1))


def mip_level_backward(grad_level, jacobian, width, height):
    """the chain rule's last factor is left out: the gradient is that of J in texels, not
    multiplied by width and height"""
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
    """ln 2 is left out: log2, to base 2, is differentiated like the natural logarithm"""
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
    """the factor 1/2 before the logarithm is left out, so all is twice as large"""
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


def mip_level_backward(grad_level, jacobian, width, height):
    """C's part is left out: C = s_x s_y + t_x t_y depends on J, too"""
    s_x, s_y, t_x, t_y = (jacobian * [[width], [height]]).reshape(-1, 4).T
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    S, R = (A + B) / 2, np.sqrt((A - B)**2 / 4 + C**2)
    grad_sum = grad_level / (2 * np.log(2) * np.where(S > 0, S + R, np.inf))
    corner = np.where(R > 0, R, np.inf)
    grad_A = grad_sum * (1 / 2 + (A - B) / (4 * corner))
    grad_B = grad_sum * (1 / 2 - (A - B) / (4 * corner))
    grad = np.stack([2 * grad_A * s_x, 2 * grad_B * s_y, 2 * grad_A * t_x, 2 * grad_B * t_y], -1)
    return grad.reshape(-1, 2, 2) * [[width], [height]]


def blend_levels(level, top):
    """the level is rounded to the nearest instead of down; the lower one is its floor, and f is
    never negative"""
    level = np.clip(level, 0, top)
    lower = np.round(level).astype(int)
    return lower, np.minimum(lower + 1, top), level - lower


def blend_levels(level, top):
    """upper may be top + 1, beyond the pyramid's last level: it is at most top"""
    level = np.clip(level, 0, top)
    lower = np.floor(level).astype(int)
    return lower, lower + 1, level - lower


def blend_levels(level, top):
    """the fraction is that of the lower level, 1 - f; f is the upper one's"""
    level = np.clip(level, 0, top)
    lower = np.floor(level).astype(int)
    return lower, np.minimum(lower + 1, top), lower + 1 - level


def blend_levels(level, top):
    """at the top lower is top - 1 with the fraction 1 (the last two levels), instead of top with
    the fraction 0"""
    level = np.clip(level, 0, top)
    lower = np.minimum(np.floor(level).astype(int), max(top - 1, 0))
    return lower, np.minimum(lower + 1, top), level - lower


def blend_levels(level, top):
    """upper is the ceiling: on a whole level it is that level itself. It is lower + 1, if there is
    one"""
    level = np.clip(level, 0, top)
    lower = np.floor(level).astype(int)
    return lower, np.ceil(level).astype(int), level - lower


def blend_levels(level, top):
    """the fraction is taken before the level is clamped"""
    lower = np.floor(np.clip(level, 0, top)).astype(int)
    return lower, np.minimum(lower + 1, top), np.where(np.isfinite(level), level, lower) - lower
