"""Mistakes of lab 7; each docstring goes on after "this is what comes out when"."""


def edge_functions_at_backward(grad_e, x, y):
    """the second edge's gradient replaces the first one's, by = for +=; they add up, as each corner
    is in two edges"""
    grad_x, grad_y = np.zeros(x.shape), np.zeros(y.shape)
    for g, (i, j) in zip(grad_e, EDGES, strict=True):
        grad_x[i], grad_y[i] = g * y[j], -g * x[j]
        grad_x[j], grad_y[j] = -g * y[i], g * x[i]
    return grad_x, grad_y
