"""Mistakes of lab 6; each docstring goes on after "this is what comes out when"."""


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
