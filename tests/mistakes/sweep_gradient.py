"""Mistakes of lab 10; each docstring goes on after "this is what comes out when"."""


def edge_crossing(a, b, y):
    """share_b comes first: the order of the shares is swapped"""
    share_b = (y - a[..., 1]) / (b[..., 1] - a[..., 1])
    return a[..., 0] + share_b * (b[..., 0] - a[..., 0]), np.stack([share_b, 1 - share_b], -1)


def edge_crossing(a, b, y):
    """the crossing has a and b exchanged: a_x is taken share_b times, and b_x share_a times"""
    share_b = (y - a[..., 1]) / (b[..., 1] - a[..., 1])
    return b[..., 0] + share_b * (a[..., 0] - b[..., 0]), np.stack([1 - share_b, share_b], -1)


def edge_crossing(a, b, y):
    """the ends are exchanged, in the shares and in the crossing: share_a and share_b are swapped"""
    share_a = (y - a[..., 1]) / (b[..., 1] - a[..., 1])
    return share_a * a[..., 0] + (1 - share_a) * b[..., 0], np.stack([share_a, 1 - share_a], -1)


def edge_crossing(a, b, y):
    """x and y are exchanged: it is the crossing with the column x = y"""
    share_b = (y - a[..., 0]) / (b[..., 0] - a[..., 0])
    return a[..., 1] + share_b * (b[..., 1] - a[..., 1]), np.stack([1 - share_b, share_b], -1)


def edge_crossing(a, b, y):
    """a_x is not added: the crossing is measured from a"""
    share_b = (y - a[..., 1]) / (b[..., 1] - a[..., 1])
    return share_b * (b[..., 0] - a[..., 0]), np.stack([1 - share_b, share_b], -1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the minus is left out, so that the sign is wrong: descent goes away from the pixel"""
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))[:, None]
    scaled = way[:, None] + eps[:, None] * share
    return pull * share / np.where(share > 0, scaled, 1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """max(0, ...) is missing: pixels that would raise the loss pull, too"""
    pull = ((colour - beyond) * grad_colour).sum(1)[:, None]
    scaled = way[:, None] + eps[:, None] * share
    return -pull * share / np.where(share > 0, scaled, 1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the way is multiplied by the share, not divided by it; a small share must go farther"""
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))[:, None]
    return -pull / (way[:, None] * share + eps[:, None])


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the difference of the colours has the wrong sign: it is I_beyond - I_j"""
    pull = np.maximum(0, ((beyond - colour) * grad_colour).sum(1))[:, None]
    scaled = way[:, None] + eps[:, None] * share
    return -pull * share / np.where(share > 0, scaled, 1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the absolute value of way and eps is taken: both sides pull in the same direction"""
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))[:, None]
    scaled = np.abs(way)[:, None] + np.abs(eps)[:, None] * share
    return -pull * share / np.where(share > 0, scaled, 1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """eps is signed twice, by the sign of way; it has that sign already"""
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))[:, None]
    scaled = way[:, None] + (eps * np.sign(way))[:, None] * share
    return -pull * share / np.where(share > 0, scaled, 1)
