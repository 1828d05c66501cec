"""Mistakes of lab 2; each docstring goes on after "this is what comes out when"."""


def edge_function(p, a, b):
    """n is normalised: e is divided by the length of the edge, and is the distance of p in pixels
    instead of the determinant"""
    n = np.stack([a[..., 1] - b[..., 1], b[..., 0] - a[..., 0]], -1)
    return (n * (p - a)).sum(-1) / np.linalg.norm(n, axis=-1)


def edge_function(p, a, b):
    """e is halved, to the area of the triangle: it is the whole determinant, twice the area"""
    n = np.stack([a[..., 1] - b[..., 1], b[..., 0] - a[..., 0]], -1)
    return (n * (p - a)).sum(-1) / 2


def edge_function(p, a, b):
    """e has lost its sign: it is the absolute value"""
    n = np.stack([a[..., 1] - b[..., 1], b[..., 0] - a[..., 0]], -1)
    return np.abs((n * (p - a)).sum(-1))


def barycentric_on_face(px, py, x, y, w):
    """nothing is divided by w: these are the weights in the picture, eq. (3), without
    perspective"""
    x, y = x - px, y - py
    c = np.stack([(x[i] * y[j] - x[j] * y[i]) for k, (i, j) in enumerate(EDGES)])
    return c / c.sum(0)


def barycentric_on_face(px, py, x, y, w):
    """it is multiplied by w instead of divided: c_k is e_k / w_k"""
    x, y = x - px, y - py
    c = np.stack([(x[i] * y[j] - x[j] * y[i]) * w[k] for k, (i, j) in enumerate(EDGES)])
    return c / c.sum(0)
