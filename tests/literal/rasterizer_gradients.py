"""Lab 7's whole meshes as printed: what one types who has read the questions and the equations."""


def edge_functions_at_backward(grad_e, x, y):
    grad_x, grad_y = np.zeros(np.shape(x)), np.zeros(np.shape(y))
    for k, (i, j) in enumerate([(1, 2), (2, 0), (0, 1)]):
        grad_x[i] += grad_e[k] * y[j]
        grad_y[j] += grad_e[k] * x[i]
        grad_y[i] -= grad_e[k] * x[j]
        grad_x[j] -= grad_e[k] * y[i]
    return grad_x, grad_y
