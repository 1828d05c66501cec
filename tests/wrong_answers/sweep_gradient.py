"""Wrong answers to sweep_gradient, written without a look at the checks."""


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    """each channel is clamped at 0 before the sum, but it is the sum over channels that is clamped

    told by: channel | before the sum | after the sum | dot product | clamp & sum | max & sum | sum & first
    """
    drop = np.maximum((colour - beyond) * grad_colour, 0).sum(axis=1)
    bottom = way[:, None] + eps[:, None] * share
    return -drop[:, None] * share / np.where(share > 0, bottom, 1)
