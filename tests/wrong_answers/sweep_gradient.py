"""Wrong answers to sweep_gradient, written without a look at the checks."""


def edge_crossing(a, b, y):
    """share_a and share_b are returned in exchanged order

    told by: share & swap | share & exchang | share & order | share & mixed up | share & other end | share & interchang | share & reversed
    """
    s = (y - a[..., 1]) / (b[..., 1] - a[..., 1])
    return (1 - s) * a[..., 0] + s * b[..., 0], np.stack([s, 1 - s], -1)


def edge_crossing(a, b, y):
    """the two shares are stacked along the first axis, not the last

    told by: last axis | first axis | axis 0 | axis & share | share & shape | shape & (2, | share & transpos
    """
    s = (y - a[..., 1]) / (b[..., 1] - a[..., 1])
    return a[..., 0] + s * (b[..., 0] - a[..., 0]), np.stack([1 - s, s])


def edge_crossing(a, b, y):
    """x and y of the ends are exchanged: it finds where the edge crosses a column

    told by: x and y | column | vertical | x instead of y | a_x & a_y | swap & coordinates | y instead of x
    """
    s = (y - a[..., 0]) / (b[..., 0] - a[..., 0])
    return a[..., 1] + s * (b[..., 1] - a[..., 1]), np.stack([1 - s, s], -1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the minus of eq. (7) is left out

    told by: minus | sign is | sign & wrong | opposite sign | negated | times -1 | wrong sign
    """
    gain = np.maximum(((colour - beyond) * grad_colour).sum(1), 0)
    out = np.zeros(share.shape)
    for p in range(len(share)):
        for end in range(2):
            s = share[p, end]
            if s > 0:
                out[p, end] = gain[p] / (way[p] / s + eps[p])
    return out


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """max(0, .) is taken for each channel before the sum over the channels

    told by: channel | each colour | before & sum & max | per component | max & each | order & max
    """
    gain = np.maximum(0, (colour - beyond) * grad_colour).sum(1)[:, None]
    moves = share > 0
    d = way[:, None] / np.where(moves, share, 1) + eps[:, None]
    return np.where(moves, -gain / np.where(moves, d, 1), 0)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """d_j is way times share instead of way divided by share

    told by: way * share | way times | times & share | way / share | divid & share | multipl & share | 1 / share
    """
    gain = np.maximum(0, np.einsum("pc,pc->p", colour - beyond, grad_colour))
    out = np.zeros_like(share)
    for end in (0, 1):
        s = share[:, end]
        d = way * s + eps
        out[:, end] = np.where(s > 0, -gain / np.where(s > 0, d, 1), 0)
    return out


def edge_crossing(a, b, y):
    """the row's centre is added again: y is already where the row is, not its index

    told by: half a pixel | 0.5 | 1/2 | centre | center | row's index
    """
    share_b = (y + 0.5 - a[..., 1]) / (b[..., 1] - a[..., 1])
    return a[..., 0] + share_b * (b[..., 0] - a[..., 0]), np.stack([1 - share_b, share_b], -1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """max(0, .) is taken for each channel before the sum, not of the dot product

    told by: each channel | per channel | channel & sum | dot product | before the sum | every channel
    """
    out = np.zeros((len(way), 2))
    for p in range(len(way)):
        pull = np.maximum(0, (colour[p] - beyond[p]) * grad_colour[p]).sum()
        for i in range(2):
            if share[p, i] > 0:
                out[p, i] = -pull * share[p, i] / (way[p] + eps[p] * share[p, i])
    return out
