"""Mistakes of lab 11; each docstring goes on after "this is what comes out when"."""


def loop_weight(n):
    """it is not divided by n: u must be the weight of one neighbour, not of all of them"""
    return 5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4) ** 2


def loop_weight(n):
    """it is Warren's formula, 3 / (8 n), instead of Loop's"""
    return np.where(n == 3, 3 / 16, 3 / (8 * n))
