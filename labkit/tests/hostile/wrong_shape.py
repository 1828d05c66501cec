"""Right numbers in a wrong shape, and 3 as a broadcast of 1."""


def double(x):
    return np.asarray(2 * x)[None]
