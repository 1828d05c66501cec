"""Lab 10's sweep once more: edge by edge, pixel by pixel."""
import numpy as np


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    terms = np.zeros(np.shape(share))
    for j, end in np.ndindex(terms.shape):
        gain = float(grad_colour[j] @ colour[j] - grad_colour[j] @ beyond[j])
        if gain > 0 and share[j, end]:
            terms[j, end] = -gain / (way[j] / share[j, end] + eps[j])
    return terms


def sweep_line(grad_colour, colour, sees, crossing, side, share, eps=1e-4):
    width, total = len(colour), np.zeros(2)
    centres = np.arange(width) + 0.5
    outside = (centres - crossing) * side > 0
    if outside.all() or not outside.any():  # inner or outer is not in the picture
        return total
    inner = np.flatnonzero(~outside)[-1 if side > 0 else 0]
    for j in range(width):
        there, motion = (inner, side) if outside[j] else (inner + side, -side)
        gain = (colour[j] - colour[there]) @ grad_colour[j]
        if gain > 0 and sees[inner if outside[j] else j]:
            for end in np.flatnonzero(share):
                way = 2 * (centres[j] - crossing) / width / share[end]
                total[end] -= gain / (way + motion * eps)
    return total
