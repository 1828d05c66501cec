"""Lab 10's sweep once more: row by row, pixel by pixel."""
import numpy as np


def edge_lines(a, b, height):
    rows, crossings, shares = [], [], []
    for row in range(height):
        below, above = sorted((a[1], b[1]))
        if below <= row + 0.5 <= above and below < above:
            share = np.array([b[1] - (row + 0.5), (row + 0.5) - a[1]]) / (b[1] - a[1])
            rows.append(row)
            crossings.append(share[0] * a[0] + share[1] * b[0])
            shares.append(share)
    return np.array(rows, int), np.array(crossings, float), np.reshape(shares, (-1, 2))


def pull_on_edge(grad_colour, colour, beyond, way, share, eps):
    grad = [0.0, 0.0]
    for before, after, slope, length, more in zip(colour, beyond, grad_colour, way, eps,
                                                  strict=True):
        gain = max(0.0, float(slope @ before - slope @ after))
        for end in range(2):
            # A way of length / share, without a division by 0.
            grad[end] -= gain * share[end] / (length + more * share[end]) if share[end] else 0.0
    return np.array(grad)
