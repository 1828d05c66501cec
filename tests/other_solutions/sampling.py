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


def sampled_spectrum(spectrum, step):
    height, width = spectrum.shape[0] // step, spectrum.shape[1] // step
    copies = [spectrum[a * height:(a + 1) * height, b * width:(b + 1) * width]
              for a in range(step) for b in range(step)]
    return sum(copies) / step**2


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
