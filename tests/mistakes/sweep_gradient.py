"""Mistakes of lab 10; each docstring goes on after "this is what comes out when"."""


def edge_crossing(a, b, y):
    """x and y are exchanged: it is the crossing with the column x = y"""
    share_b = (y - a[..., 0]) / (b[..., 0] - a[..., 0])
    return a[..., 1] + share_b * (b[..., 1] - a[..., 1]), np.stack([1 - share_b, share_b], -1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the way is multiplied by the share, not divided by it; a small share must go farther"""
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))[:, None]
    return -pull / (way[:, None] * share + eps[:, None])
