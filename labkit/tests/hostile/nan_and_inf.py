"""Returns numbers that are none."""


def double(x):
    return np.array([np.nan, np.inf, -np.inf])
