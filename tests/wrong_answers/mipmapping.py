"""Wrong answers to mipmapping, written without a look at the checks."""


def halve(image):
    """the sum of the four texels is divided by 2 instead of 4

    told by: divided by 2 | twice | factor 2 | divided by 4 | 1/4 | factor of 2 | double
    """
    height, width, channels = image.shape
    a, b = min(height, 2), min(width, 2)
    cut = image.reshape(height // a, a, width // b, b, channels)
    return cut.sum((1, 3)) / max(1, a * b // 2)


def halve_backward(grad_half, image):
    """the quarter is missing: each texel gets the whole gradient of the mean

    told by: quarter | four times | factor 4 | factor of 4 | / 4 | 1/4 | divide & 4 | whole gradient | sum & mean
    """
    rows, columns = (1 if side == 1 else 2 for side in image.shape[:2])
    return np.kron(grad_half, np.ones((rows, columns, 1)))


def pyramid_backward(grad_levels):
    """only level 1 is handed down, the gradients of level 2 and above are lost

    told by: level 2 | above level 1 | higher level | only level 1 | all the way | coarse | one step
    """
    grad = grad_levels[0].copy()
    if len(grad_levels) > 1:
        grad += halve_backward(grad_levels[1], grad)
    return grad


def mip_level(jacobian, width, height):
    """J is scaled by columns: width goes to the x derivatives and height to the y derivatives, instead of u and v

    told by: columns | width & height & exchanged | width & height & swapped | x derivatives | not square | u & width & v & height
    """
    in_texels = jacobian * np.array([width, height])
    sx, sy, tx, ty = (in_texels[:, i, j] for i in (0, 1) for j in (0, 1))
    A, B, C = sx**2 + tx**2, sy**2 + ty**2, sx * sy + tx * ty
    with np.errstate(divide="ignore"):
        return 0.5 * np.log2((A + B) / 2 + np.sqrt((A - B)**2 / 4 + C**2))


def mip_level_backward(grad_level, jacobian, width, height):
    """the last factor is missing: the gradient is for J in texels, without width and height

    told by: in texels | width & height & missing | width & height & left out | factor & width | times width | multipl & width | w and h | rows & scaled
    """
    s_x, s_y, t_x, t_y = (jacobian * [[width], [height]]).reshape(-1, 4).T
    A, B = s_x**2 + t_x**2, s_y**2 + t_y**2
    C = s_x * s_y + t_x * t_y
    R = np.sqrt((A - B)**2 / 4 + C**2)
    R_safe = np.where(R > 0, R, np.inf)
    S = (A + B) / 2
    g = grad_level / (2 * np.log(2) * np.where(S > 0, S + R, np.inf))
    by_A = g * (0.5 + (A - B) / (4 * R_safe))
    by_B = g * (0.5 - (A - B) / (4 * R_safe))
    by_C = g * C / R_safe
    first = np.stack([2 * by_A * s_x + by_C * s_y, 2 * by_B * s_y + by_C * s_x], -1)
    second = np.stack([2 * by_A * t_x + by_C * t_y, 2 * by_B * t_y + by_C * t_x], -1)
    return np.stack([first, second], 1)


def blend_levels(level, top):
    """the level is rounded to the nearest integer, not floored: f can be negative

    told by: floor | nearest | np.round | rounded | rint | f & negative | fraction & negative
    """
    inside = np.clip(level, 0, top)
    low = np.rint(inside).astype(int)
    high = np.minimum(low + 1, top)
    return low, high, inside - low
