"""The variance shadows of lab 14 once more: texel by texel, and windows as matrices."""
import numpy as np


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    grads = np.zeros((3, len(grad_lit)))
    for n, g in enumerate(grad_lit):
        beyond, variance = distance[n] - mean[n], mean_square[n] - mean[n]**2
        if beyond <= 0:
            continue
        free = variance > least_variance
        variance = max(variance, least_variance)
        lit = 1 / (1 + beyond**2 / variance)
        by_distance = -2 * lit**2 * beyond / variance
        by_variance = lit**2 * (beyond / variance)**2 if free else 0.0
        grads[:, n] = (g * by_distance, g * (-by_distance - 2 * mean[n] * by_variance),
                       g * by_variance)
    return tuple(grads)
