"""Lab 7's whole meshes as printed: what one types who has read the questions and the equations."""


def edge_functions_backward(grad_edges, corners):
    grad_corners = np.zeros(np.shape(corners))
    for k, (i, j) in enumerate([(1, 2), (2, 0), (0, 1)]):
        grad_corners[:, i] += cross(corners[:, j], grad_edges[k])
        grad_corners[:, j] += cross(grad_edges[k], corners[:, i])
    return grad_corners
