"""Lab 3 once more: sums as they are defined, exact remainders, and clipping for clamping."""
import cmath
import math

import numpy as np
from scipy import ndimage

from reference.sampling import polygon_area


def alias_frequency(frequency, rate):
    def one(f, r):
        alias = math.remainder(f, r)
        return -alias if alias >= r / 2 else alias

    return np.vectorize(one, otypes=[float])(frequency, rate)[()]


def dft_matrix(n):
    return np.array([[cmath.exp(-2j * cmath.pi * (k * m % n) / n) for m in range(n)]
                     for k in range(n)])


def convolve(picture, kernel):
    return ndimage.convolve(picture, kernel, mode="wrap")


def sampled_spectrum(spectrum, step, limit):
    height, width = spectrum.shape
    small = np.zeros((height // step, width // step), complex)
    for k, m in np.ndindex(height, width):
        if max(min(k, height - k) / height, min(m, width - m) / width) < limit:
            small[k % len(small), m % len(small.T)] += spectrum[k, m] / step**2
    return small


def clip_polygon(polygon, a, b, c):
    distance = [a * x + b * y + c for x, y in polygon]
    kept = []
    for n in range(len(polygon)):
        p, q, e, f = polygon[n - 1], polygon[n], distance[n - 1], distance[n]
        if (e >= 0) != (f >= 0):
            kept.append((f * p - e * q) / (f - e))
        if f >= 0:
            kept.append(q)
    return np.array(kept)  # perhaps []


def in_square(polygon, x, y):
    for a, b, c in ((1, 0, -x), (-1, 0, x + 1), (0, 1, -y), (0, -1, y + 1)):
        polygon = clip_polygon(polygon, a, b, c)
    return polygon_area(polygon)


def pixel_coverage_loop(triangle, width, height):
    return [[abs(in_square(triangle, j, i)) for j in range(width)] for i in range(height)]


def clamped_area_backward(grad_area, polygon, x, y):
    grad = np.zeros(polygon.shape)
    for g, corner in zip(grad_area, np.stack([x, y], 1), strict=True):
        for n in range(len(polygon)):
            p, q = polygon[n - 1] - corner, polygon[n] - corner
            t0, t1 = 0.0, 1.0  # what of the edge is inside, side by side
            for a, d in zip(p, q - p, strict=True):
                ends = sorted((-a / d, (1 - a) / d)) if d else (0, 0 <= a < 1)
                t0, t1 = max(t0, ends[0]), min(t1, ends[1])
            if t0 < t1:
                pull = g * np.array([q[1] - p[1], p[0] - q[0]])
                grad[n] += pull * (t1**2 - t0**2) / 2
                grad[n - 1] += pull * ((1 - t0)**2 - (1 - t1)**2) / 2
    return grad
