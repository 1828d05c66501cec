"""Mistakes of lab 14; each docstring goes on after "this is what comes out when"."""


def box_blur_backward(grad_output, radius):
    """the gradient is blurred like the picture: it is divided after the sum, by the number of
    pixels in its own square, and not before, by the number in each square that holds it"""
    return box_blur(grad_output, radius)


def box_blur_backward(grad_output, radius):
    """it is not divided by the number of pixels: the backward of a sum, and not of a mean"""
    return window_sums(grad_output, radius)


def box_blur_backward(grad_output, radius):
    """it is divided by (2 radius + 1)^2 everywhere: at the border, squares have fewer pixels"""
    return window_sums(grad_output, radius) / (2 * radius + 1)**2


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the quotient rule is cut short: the variance in the numerator is held as a constant"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    total = variance + beyond**2
    grad_beyond = grad_lit * -2 * variance * beyond / total**2
    free = (mean_square - mean**2 > least_variance) & (beyond > 0)
    grad_mean_square = -grad_lit * variance / total**2 * free
    return grad_beyond, -grad_beyond - 2 * mean * grad_mean_square, grad_mean_square


def map_motion(distance_map, clip_from_light):
    """w is held: the derivative with respect to q_z, the third column, is left out"""
    height, width = distance_map.shape
    w = clip_from_light[3, 3] - clip_from_light[3, 2] * distance_map
    motion = np.zeros((height, width, 2, 3))
    motion[..., 0, 0] = clip_from_light[0, 0] * (width / 2) / w
    motion[..., 1, 1] = clip_from_light[1, 1] * (height / 2) / w
    return motion
