"""Wrong answers to sweep_gradient, written without a look at the checks."""


def edge_crossing(a, b, y):
    """x and y of the ends are exchanged: it finds where the edge crosses a column

    told by: x and y | column | vertical | x instead of y | a_x & a_y | swap & coordinates | y instead of x
    """
    s = (y - a[..., 0]) / (b[..., 0] - a[..., 0])
    return a[..., 1] + s * (b[..., 1] - a[..., 1]), np.stack([1 - s, s], -1)


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """each channel is clamped at 0 before the sum, but it is the sum over channels that is clamped

    told by: channel | before the sum | after the sum | dot product | clamp & sum | max & sum | sum & first
    """
    drop = np.maximum((colour - beyond) * grad_colour, 0).sum(axis=1)
    bottom = way[:, None] + eps[:, None] * share
    return -drop[:, None] * share / np.where(share > 0, bottom, 1)
