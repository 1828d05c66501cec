"""The variance shadows of lab 14 once more: the blur and the look-up are matrices."""
import numpy as np


def filters(x, count, radius):
    """The share (N, count) of each texel in what is read at x (N,), and its slope by x."""
    near = np.abs(np.subtract.outer(np.arange(count), np.arange(count))) <= radius
    first = np.floor(x - 0.5)
    taps = np.zeros((2, len(x), count))
    for texel, share, slope in (first, first + 1.5 - x, -1), (first + 1, x - 0.5 - first, 1):
        at = np.arange(len(x)), np.clip(texel, 0, count - 1).astype(int)
        taps[0][at] += share
        taps[1][at] += slope
    return taps @ (near / near.sum(1, keepdims=True))


def means(moments, uv, radius):
    """E (N, 2), and the filters of the rows and of the columns."""
    rows, columns = (filters(uv[:, axis] * moments.shape[1 - axis], moments.shape[1 - axis], radius)
                     for axis in (1, 0))
    return np.einsum("ni,nj,ijc->cn", rows[0], columns[0], moments), rows, columns


def parts(moments, uv, distance, radius, least_variance):
    """beyond / variance, the share and whether it has a slope, and one by the variance."""
    (mean, square), *_ = means(moments, uv, radius)
    variance = np.maximum(square - mean * mean, least_variance)
    ratio = np.maximum(distance - mean, 0) / variance
    ratio[((uv < 0) | (uv >= 1)).any(1)] = 0
    return mean, ratio, 1 / (1 + ratio**2 * variance), square - mean * mean > least_variance


def lit_by_moments(moments, uv, distance, radius, least_variance):
    return parts(moments, uv, distance, radius, least_variance)[2]


def lit_by_moments_backward(grad_lit, moments, uv, distance, radius, least_variance):
    _, rows, columns = means(moments, uv, radius)
    mean, ratio, share, free = parts(moments, uv, distance, radius, least_variance)
    by_distance = -2 * grad_lit * share**2 * ratio
    by_square = grad_lit * (share * ratio)**2 * free
    grad_mean = np.stack([-by_distance - 2 * mean * by_square, by_square])
    by_x, by_y = (np.einsum("ni,nj,ijc,cn->n", *pair, moments, grad_mean)
                  for pair in ((rows[0], columns[1]), (rows[1], columns[0])))
    height, width, _ = moments.shape
    return (np.einsum("ni,nj,cn->ijc", rows[0], columns[0], grad_mean),
            np.stack([by_x * width, by_y * height], -1), by_distance)
