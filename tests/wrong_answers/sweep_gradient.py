"""Wrong answers to sweep_gradient, written without a look at the checks."""


def edge_crossing(a, b, y):
    """the two shares are returned in the wrong order: share_b first

    told by: order & share | share & exchang | share & swap | share_b & first | share & mixed up
    """
    t = (y - a[..., 1]) / (b[..., 1] - a[..., 1])
    return (1 - t) * a[..., 0] + t * b[..., 0], np.stack([t, 1 - t], -1)


def edge_crossing(a, b, y):
    """share_a is computed as (y - a_y) / (b_y - a_y), so the ends are exchanged in x_edge as well

    told by: ends & exchang | ends & swap | share_a & share_b | wrong end | other end | a and b
    """
    share_a = (y - a[..., 1]) / (b[..., 1] - a[..., 1])
    share = np.stack([share_a, 1 - share_a], axis=-1)
    x_edge = share[..., 0] * a[..., 0] + share[..., 1] * b[..., 0]
    return x_edge, share


def edge_crossing(a, b, y):
    """x and y are exchanged: the crossing with the column x = y is computed

    told by: x and y | column | vertical | axes | y_edge | coordinates & exchang
    """
    share_b = (y - a[..., 0]) / (b[..., 0] - a[..., 0])
    return a[..., 1] + share_b * (b[..., 1] - a[..., 1]), np.stack([1 - share_b, share_b], -1)


def edge_crossing(a, b, y):
    """the shares are stacked along the first axis instead of the last

    told by: axis | shape | last dimension | stack | transpos | (2, ...)
    """
    share_b = (y - a[..., 1]) / (b[..., 1] - a[..., 1])
    share_a = 1 - share_b
    return share_a * a[..., 0] + share_b * b[..., 0], np.array([share_a, share_b])


def edge_crossing(a, b, y):
    """the x of the edge is measured from a: a_x is not added

    told by: a_x | measured from | relative to | offset | add & x of a | start & added
    """
    dx, dy = b[..., 0] - a[..., 0], b[..., 1] - a[..., 1]
    share_b = (y - a[..., 1]) / dy
    share_a = (b[..., 1] - y) / dy
    return share_b * dx, np.stack([share_a, share_b], -1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the minus of eq. (7) is left out

    told by: minus | wrong sign | opposite sign | sign & flip | negated | opposite direction
    """
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))[:, None]
    scaled = way[:, None] + eps[:, None] * share
    return pull * share / np.where(share > 0, scaled, 1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the difference of the colours has the wrong sign: I_beyond - I_j, so the pixels that would raise the loss pull

    told by: beyond - | difference & sign | colours & exchang | I_j & exchang | raise | colour & sign
    """
    gain = ((beyond - colour) * grad_colour).sum(1)
    pull = np.maximum(0, gain)[:, None]
    scaled = way[:, None] + eps[:, None] * share
    return -pull * share / np.where(share > 0, scaled, 1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """d_j is way times share instead of way divided by share

    told by: divi & share | times share | multipl & share | share & upside down | way / share
    """
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))
    d = way[:, None] * share
    bottom = d + eps[:, None]
    return np.where(share > 0, -pull[:, None] / np.where(share > 0, bottom, 1), 0)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the maximum with 0 is left out: pixels that would raise the loss push the edge away

    told by: max(0 & missing | max(0 & forgot | max(0 & left out | cut off | raise & loss | maximum & missing
    """
    pull = np.einsum("pc,pc->p", colour - beyond, grad_colour)[:, None]
    scaled = way[:, None] + eps[:, None] * share
    return -pull * share / np.where(share > 0, scaled, 1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """fine print: an end of share 0 divides by 0, and its term is nan

    told by: share 0 | share of 0 | nan | divi & 0 | divi & zero
    """
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(axis=1, keepdims=True))
    d = way[:, None] / share  # eq. (8)
    return -pull / (d + eps[:, None])


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the distance's absolute value is taken, so pixels on either side pull in the same direction

    told by: absolute | abs( | either side | both sides | same direction | sign of & way
    """
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))[:, None]
    scaled = np.abs(way)[:, None] + np.abs(eps)[:, None] * share
    return -pull * share / np.where(share > 0, scaled, 1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the terms are already summed over the pixels

    told by: sum & pixels | summed | shape | (P, 2) | one row & pixel
    """
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))[:, None]
    scaled = way[:, None] + eps[:, None] * share
    return (-pull * share / np.where(share > 0, scaled, 1)).sum(0)
