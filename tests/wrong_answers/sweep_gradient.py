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
    """the two shares are exchanged: share_b comes first

    told by: share_b & first | shares & exchanged | shares & swapped | share & swapped | share & exchanged | share & order | share_a & share_b | share & other end | mixed up
    """
    t = (y - a[..., 1]) / (b[..., 1] - a[..., 1])
    crossing = (1 - t) * a[..., 0] + t * b[..., 0]
    return crossing, np.stack([t, 1 - t], axis=-1)


def edge_crossing(a, b, y):
    """half a pixel is added to y, which is the place of the row already

    told by: half a pixel | 1/2 | 0.5 | half & row | centre | half & y | shift
    """
    t = (y + 0.5 - a[..., 1]) / (b[..., 1] - a[..., 1])
    crossing = (1 - t) * a[..., 0] + t * b[..., 0]
    return crossing, np.stack([1 - t, t], axis=-1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """the way is multiplied by the share, where d_j = way / share divides by it

    told by: way / share | divid & share | multipl & share | way & share | d_j | share & denominator | share & times | share & inverse
    """
    result = np.zeros(share.shape)
    for j in range(len(way)):
        gain = max(0.0, float(((colour[j] - beyond[j]) * grad_colour[j]).sum()))
        for end in range(2):
            if share[j, end] > 0:
                result[j, end] = -gain / (way[j] * share[j, end] + eps[j])
    return result


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """each channel is clamped at 0 before the sum, but it is the sum over channels that is clamped

    told by: channel | before the sum | after the sum | dot product | clamp & sum | max & sum | sum & first
    """
    drop = np.maximum((colour - beyond) * grad_colour, 0).sum(axis=1)
    bottom = way[:, None] + eps[:, None] * share
    return -drop[:, None] * share / np.where(share > 0, bottom, 1)
