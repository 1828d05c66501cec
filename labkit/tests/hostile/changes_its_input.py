"""Right, but it works in its input."""


def double(x):
    x *= 2
    return x
