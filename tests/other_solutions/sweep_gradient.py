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


def sweep_line(grad_colour, colour, sees, crossing, side, share, eps=1e-4):
    width, grad = len(colour), np.zeros(2)
    reached = [j for j in range(width) if side * (j + 0.5 - crossing) <= 0]
    beyond = [j for j in range(width) if j not in reached]
    if not reached or not beyond:
        return grad
    inner, outer = (max(reached), min(beyond)) if side > 0 else (min(reached), max(beyond))
    ways = [(side, beyond if sees[inner] else [], colour[inner]),
            (-side, [j for j in reached if sees[j]], colour[outer])]
    for sign, pixels, other in ways:
        for j in pixels:
            gain = max(0.0, float((colour[j] - other) @ grad_colour[j]))
            for end in range(2):
                if share[end]:
                    distance = 2 / width * (j + 0.5 - crossing) / share[end]
                    grad[end] -= gain / (distance + sign * eps) if gain else 0.0
    return grad
