"""Returns as much as can be sent, and all of it is wrong."""


def double(x):
    return np.zeros(1_900_000)
