"""Lab 10's sweep as printed: what one types who has read the questions and the equations."""


def edge_pulls(grad_colour, colour, beyond, way, share, eps):
    d = way[:, None] / share
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))
    return -pull[:, None] / (d + eps[:, None])
