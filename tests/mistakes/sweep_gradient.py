"""Mistakes of lab 10; each docstring goes on after "this is what comes out when"."""


def edge_crossing(a, b, y):
    """the shares of a and b are swapped"""
    share_b = (y - a[..., 1]) / (b[..., 1] - a[..., 1])
    return a[..., 0] + share_b * (b[..., 0] - a[..., 0]), np.stack([share_b, 1 - share_b], -1)


def edge_crossing(a, b, y):
    """the crossing has the share of a at b, and that of b at a"""
    share_b = (y - a[..., 1]) / (b[..., 1] - a[..., 1])
    return b[..., 0] + share_b * (a[..., 0] - b[..., 0]), np.stack([1 - share_b, share_b], -1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the sign is wrong: descent goes away from the pixel that pulls"""
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))[:, None]
    scaled = way[:, None] + eps[:, None] * share
    return pull * share / np.where(share > 0, scaled, 1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """max(0, ...) is missing: a change that raises the loss counts, too"""
    pull = ((colour - beyond) * grad_colour).sum(1)[:, None]
    scaled = way[:, None] + eps[:, None] * share
    return -pull * share / np.where(share > 0, scaled, 1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the way is multiplied by the share; an end of a small share must go farther"""
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))[:, None]
    return -pull / (way[:, None] * share + eps[:, None])
