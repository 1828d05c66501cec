"""Right once, but it breaks NumPy for all that comes after: for its own next call."""


def double(x):
    result = 2 * x
    for name in ("asarray", "multiply", "zeros", "ndarray", "frombuffer", "add"):
        setattr(np, name, None)
    np.seterr(all="raise")
    return result
