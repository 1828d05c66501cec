"""Wrong answers to variance_shadows, written without a look at the checks."""


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the variance below the line is held: dp/dv is 1 / s instead of b^2 / s^2

    told by: denominator | below the line | quotient | 1 / s | b^2 / s^2 | variance & twice | variance & held
    """
    variance = np.maximum(mean_square - mean**2, least_variance)
    gap = np.maximum(distance - mean, 0)
    s = variance + gap**2
    grad_gap = -2 * grad_lit * variance * gap / s**2
    above = (mean_square - mean**2 > least_variance) & (gap > 0)
    grad_square = np.where(above, grad_lit / s, 0.0)
    return grad_gap, -grad_gap - 2 * mean * grad_square, grad_square
