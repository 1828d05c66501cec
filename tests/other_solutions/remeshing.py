"""Lab 13's flips and slides once more: angle by angle, vertex by vertex."""
import math

import numpy as np


def angle(corner, p, q):
    """Between the sides to p and to q: Kahan's formula, from the two sides of equal length."""
    u, v = p - corner, q - corner
    if not u.any() or not v.any():
        return 0.0
    u, v = u / math.hypot(*u), v / math.hypot(*v)
    return 2 * math.atan2(math.hypot(*(u - v)), math.hypot(*(u + v)))


def delaunay_gain(corners):
    return np.array([angle(c, a, b) + angle(d, a, b) - math.pi for a, b, c, d in corners])
