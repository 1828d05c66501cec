"""Arrays of millions of rows without a number: no bytes on their way, and lists when shown."""


def double(x):
    return np.zeros((1 << 23, 0))
