"""Mistakes of lab 7; each docstring goes on after "this is what comes out when"."""


def vertex_matrix(triangle):
    """the vertices stand in rows; they are the columns"""
    return np.stack([*triangle.T, np.ones(3)], -1)


def vertex_matrix(triangle):
    """the ones stand above x and y; they are the last row"""
    return np.stack([np.ones(3), *triangle.T])


def vertex_matrix(triangle):
    """the rows of x and of y are swapped"""
    return np.stack([*triangle.T[::-1], np.ones(3)])


def inverse_differential(m, dm):
    """the sign is missing: an inverse shrinks where the matrix grows"""
    inverse = np.linalg.inv(m)
    return inverse @ dm @ inverse


def inverse_differential(m, dm):
    """both inverses are on the same side; matrices do not commute"""
    inverse = np.linalg.inv(m)
    return -dm @ inverse @ inverse


def inverse_differential(m, dm):
    """the inverse is there once; it is on both sides of dM"""
    inverse = np.linalg.inv(m)
    return -inverse @ dm


def residual_slope(values, m, a, i, j):
    """rows and columns are swapped: i is the row"""
    dm = np.zeros((3, 3))
    dm[j, i] = 1
    return values @ inverse_differential(m, dm) @ a


def residual_slope(values, m, a, i, j):
    """the sign is wrong: a vertex drags the picture along, against its slope"""
    dm = np.zeros((3, 3))
    dm[i, j] = 1
    return -values @ inverse_differential(m, dm) @ a


def residual_slope(values, m, a, i, j):
    """dM is taken for the change of the inverse"""
    dm = np.zeros((3, 3))
    dm[i, j] = 1
    return values @ dm @ a


def residual_backward(grad_f, values, m, a, target):
    """the inverse is not transposed for the gradient by a"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_a = grad_f * (inverse @ values)
    return grad_f * c, -np.outer(grad_a, c), grad_a, -grad_f


def residual_backward(grad_f, values, m, a, target):
    """the sign is wrong: a vertex drags the picture along, against its slope"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_a = grad_f * (inverse.T @ values)
    return grad_f * c, np.outer(grad_a, c), grad_a, -grad_f


def residual_backward(grad_f, values, m, a, target):
    """grad_m is transposed: its row i is of row i of M, its column j of vertex j"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_a = grad_f * (inverse.T @ values)
    return grad_f * c, -np.outer(c, grad_a), grad_a, -grad_f


def residuals_jacobian(values, triangle, points):
    """the sign is wrong: a vertex drags the picture along, against its slope"""
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:, :2].T + inverse[:, 2]
    slope = values @ inverse[:, :2]
    return c, c[:, :, None] * slope


def residuals_jacobian(values, triangle, points):
    """the derivatives by x and by y are swapped"""
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:, :2].T + inverse[:, 2]
    slope = values @ inverse[:, :2]
    return c, -c[:, :, None] * slope[::-1]


def residuals_jacobian(values, triangle, points):
    """the 1 of a = (x, y, 1) is left out"""
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:, :2].T
    slope = values @ inverse[:, :2]
    return c, -c[:, :, None] * slope


def gauss_newton_step(residuals, jacobian):
    """the sign is wrong: the step goes uphill"""
    return np.linalg.lstsq(jacobian, residuals)[0]


def gauss_newton_step(residuals, jacobian):
    """it is a step along the gradient"""
    return -jacobian.T @ residuals


def gauss_newton_step(residuals, jacobian):
    """something is added to the diagonal of J^T J: that damps the step"""
    return np.linalg.solve(
        jacobian.T @ jacobian + 0.001 * np.eye(jacobian.shape[1]), -jacobian.T @ residuals
    )


def weights_backward(grad_b, m, a):
    """the sum s is taken for a constant"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_c = grad_b / c.sum()
    grad_a = inverse.T @ grad_c
    return -np.outer(grad_a, c), grad_a


def weights_backward(grad_b, m, a):
    """the share of the sum s has the wrong sign"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_c = (grad_b + grad_b @ c / c.sum()) / c.sum()
    grad_a = inverse.T @ grad_c
    return -np.outer(grad_a, c), grad_a


def weights_backward(grad_b, m, a):
    """the inverse is not transposed for the gradient by a"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_c = (grad_b - grad_b @ c / c.sum()) / c.sum()
    grad_a = inverse @ grad_c
    return -np.outer(grad_a, c), grad_a
