"""Returns a gigabyte."""


def double(x):
    return np.zeros(1 << 27)
