"""Lab 14's variance shadows as printed."""


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    v = np.maximum(mean_square - mean**2, least_variance)
    b = distance - mean
    s = v + b**2
    grad_lit = grad_lit * (distance > mean)
    grad_v = grad_lit * b**2 / s**2 * (mean_square - mean**2 >= least_variance)
    grad_b = -grad_lit * 2 * v * b / s**2
    return grad_b, -grad_b - 2 * mean * grad_v, grad_v
