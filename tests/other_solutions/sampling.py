"""Lab 3 once more: sums as they are defined, exact remainders, and clipping for clamping."""
import cmath
import math

import numpy as np
from scipy import ndimage

from reference.sampling import frequencies, picture_of, polygon_area, spectrum_of


def alias_frequency(frequency, rate):
    def one(f, r):
        alias = math.remainder(f, r)
        return -alias if alias >= r / 2 else alias

    return np.vectorize(one, otypes=[float])(frequency, rate)[()]


def dft_matrix(n):
    return np.array([[cmath.exp(-2j * cmath.pi * (k * m % n) / n) for m in range(n)]
                     for k in range(n)])


def signed(n):
    return [k if 2 * k < n else k - n for k in range(n)]


def band_pass(picture, low, high):
    spectrum = np.fft.fft2(picture)
    for k, f_y in enumerate(frequencies(picture.shape[0])):
        for m, f_x in enumerate(frequencies(picture.shape[1])):
            if not low <= math.hypot(f_y, f_x) < high:
                spectrum[k, m] = 0
    return np.fft.ifft2(spectrum).real


def convolve(picture, kernel):
    return ndimage.convolve(picture, kernel, mode="wrap")


def convolve_by_spectrum(picture, kernel):
    height, width = kernel.shape
    there = np.zeros(picture.shape)
    for i in range(height):
        for j in range(width):
            there[i - height // 2, j - width // 2] = kernel[i, j]
    return picture_of(spectrum_of(there) * spectrum_of(picture))


def box_spectrum(width, n):
    reach = range(-(width // 2), width // 2 + 1)
    return [sum(math.cos(2 * math.pi * k * m / n) for m in reach) / width for k in range(n)]


def sampled_spectrum(spectrum, step):
    height, width = spectrum.shape[0] // step, spectrum.shape[1] // step
    copies = [spectrum[a * height:(a + 1) * height, b * width:(b + 1) * width]
              for a in range(step) for b in range(step)]
    return sum(copies) / step**2


def folded_energy(spectrum, step):
    height, width = spectrum.shape
    lost = [spectrum[k, m] for k, y in enumerate(signed(height))
            for m, x in enumerate(signed(width))
            if 2 * step * abs(y) >= height or 2 * step * abs(x) >= width]
    return sum(abs(F)**2 for F in lost) / (height * width)**2


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


def polygon_area_backward(grad_area, polygon):
    grad_polygon, count = np.zeros(np.shape(polygon)), np.shape(polygon)[-2]
    for n in range(count):
        chord = polygon[..., (n + 1) % count, :] - polygon[..., n - 1, :]
        grad_polygon[..., n, 0] = grad_area * chord[..., 1] / 2
        grad_polygon[..., n, 1] = -grad_area * chord[..., 0] / 2
    return grad_polygon


def in_square(polygon, x, y):
    for a, b, c in ((1, 0, -x), (-1, 0, x + 1), (0, 1, -y), (0, -1, y + 1)):
        polygon = clip_polygon(polygon, a, b, c)
    return polygon_area(polygon)


def pixel_coverage_loop(triangle, width, height):
    return [[abs(in_square(triangle, j, i)) for j in range(width)] for i in range(height)]


def cuts(polygon, x, y):
    t = np.zeros((len(x), len(polygon), 6))
    for s in range(len(x)):
        for n, p in enumerate(polygon):
            q = polygon[(n + 1) % len(polygon)]
            found = [0.0, 1.0]
            for axis, low in ((0, x[s]), (1, y[s])):
                for line in (low, low + 1):
                    crosses = min(p[axis], q[axis]) < line < max(p[axis], q[axis])
                    found.append((line - p[axis]) / (q[axis] - p[axis]) if crosses else 1.0)
            t[s, n] = sorted(found)
    return t


def clamped_area(polygon, x, y):
    return np.array([in_square(polygon, *corner) for corner in zip(x, y, strict=True)], float)


def clamped_area_backward(grad_area, polygon, x, y):
    grad_polygon = np.zeros(np.shape(polygon))
    pieces = cuts(polygon, x, y)
    for s in range(len(x)):
        for n, p in enumerate(polygon):
            after = (n + 1) % len(polygon)
            d_x, d_y = polygon[after] - p
            normal = grad_area[s] * np.array([d_y, -d_x])
            for start, end in zip(pieces[s, n][:-1], pieces[s, n][1:], strict=True):
                middle = (start + end) / 2
                at_x, at_y = p + middle * (polygon[after] - p)
                if x[s] <= at_x < x[s] + 1 and y[s] <= at_y < y[s] + 1:
                    grad_polygon[n] += (end - start) * (1 - middle) * normal
                    grad_polygon[after] += (end - start) * middle * normal
    return grad_polygon
