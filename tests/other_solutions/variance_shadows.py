"""The variance shadows of lab 14 once more: the blur and the look-up are matrices."""
import numpy as np


def filters(u, count, radius):
    """The share (N, count) of each texel in what is read at u (N,), and its slope by u."""
    near = np.abs(np.subtract.outer(np.arange(count), np.arange(count))) <= radius
    first = np.floor(u * count - 0.5)
    taps = np.zeros((2, len(u), count))
    for texel, share, slope in ((first, first + 1.5 - u * count, -count),
                                (first + 1, u * count - 0.5 - first, count)):
        at = np.arange(len(u)), np.clip(texel, 0, count - 1).astype(int)
        taps[0][at] += share
        taps[1][at] += slope
    return taps @ (near / near.sum(1, keepdims=True))


def parts(moments, uv, distance, radius, least_variance):
    """The filters of columns and rows, E_0, beyond / variance, the share, and is v not floored?"""
    (columns, by_u), (rows, by_v) = (
        filters(uv[:, k], moments.shape[1 - k], radius) for k in (0, 1))
    mean, square = np.einsum("ni,nj,ijc->cn", rows, columns, moments)
    variance = np.maximum(square - mean * mean, least_variance)
    ratio = np.maximum(distance - mean, 0) / variance
    ratio[((uv < 0) | (uv >= 1)).any(1)] = 0
    free = square - mean * mean > least_variance
    return (columns, by_u, rows, by_v), mean, ratio, 1 / (1 + ratio**2 * variance), free


def lit_by_moments(moments, uv, distance, radius, least_variance):
    return parts(moments, uv, distance, radius, least_variance)[3]


def lit_by_moments_backward(grad_lit, *given):
    moments = given[0]
    (columns, by_u, rows, by_v), mean, ratio, share, free = parts(*given)
    by_distance = -2 * grad_lit * share**2 * ratio
    by_square = grad_lit * (share * ratio)**2 * free
    grad = np.stack([-by_distance - 2 * mean * by_square, by_square])
    grad_uv = [np.einsum("ni,nj,ijc,cn->n", *pair, moments, grad)
               for pair in ((rows, by_u), (by_v, columns))]
    return np.einsum("ni,nj,cn->ijc", rows, columns, grad), np.transpose(grad_uv), by_distance
