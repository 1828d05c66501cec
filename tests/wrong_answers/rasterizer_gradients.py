"""Wrong answers to rasterizer_gradients, written without a look at the checks."""


def edge_functions_at_backward(grad_e, x, y):
    """x and y are mixed up: the derivative by x_i is written with x_j, where y_j belongs

    told by: x and y & exchang | x and y & swap | x and y & mixed | respect to x | grad_x & y_j
    """
    grad_x, grad_y = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    for (i, j), g in zip(EDGES, grad_e):
        grad_x[i] = grad_x[i] + g * x[j]
        grad_x[j] = grad_x[j] - g * x[i]
        grad_y[i] = grad_y[i] - g * y[j]
        grad_y[j] = grad_y[j] + g * y[i]
    return np.array(grad_x), np.array(grad_y)
