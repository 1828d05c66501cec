"""Mistakes of lab 7; each docstring goes on after "this is what comes out when"."""


def vertex_matrix(triangle):
    """the matrix is transposed: the vertices stand in its rows; they are its columns"""
    return np.stack([*triangle.T, np.ones(3)], -1)


def vertex_matrix(triangle):
    """the row of ones stands above x and y; it is the last row"""
    return np.stack([np.ones(3), *triangle.T])


def vertex_matrix(triangle):
    """x and y are swapped: the first row of M holds the x, the second row the y"""
    return np.stack([*triangle.T[::-1], np.ones(3)])


def vertex_matrix(triangle):
    """the last row has zeros in place of ones"""
    return np.stack([*triangle.T, np.zeros(3)])


def vertex_matrix(triangle):
    """the last row is 0, 0, 1, as in the matrix of a transform; it is a row of ones"""
    return np.stack([*triangle.T, np.array([0.0, 0.0, 1.0])])


def vertex_matrix(triangle):
    """triangle is reshaped to (2, 3), not transposed: x and y of the vertices are mixed up"""
    return np.vstack([triangle.reshape(2, 3), np.ones(3)])


def inverse_differential(m, dm):
    """both inverses stand on the right of dM; one belongs on each side, M^-1 dM M^-1"""
    inverse = np.linalg.inv(m)
    return -dm @ inverse @ inverse


def inverse_differential(m, dm):
    """both inverses stand on the left of dM; one belongs on each side, M^-1 dM M^-1"""
    inverse = np.linalg.inv(m)
    return -inverse @ inverse @ dm


def inverse_differential(m, dm):
    """a factor is missing: M^-1 on the right of dM is left out, it is -M^-1 dM instead of
    -M^-1 dM M^-1"""
    inverse = np.linalg.inv(m)
    return -inverse @ dm


def inverse_differential(m, dm):
    """a factor is missing: M^-1 on the left of dM is left out, it is -dM M^-1 instead of
    -M^-1 dM M^-1"""
    inverse = np.linalg.inv(m)
    return -dm @ inverse


def inverse_differential(m, dm):
    """the products are elementwise, by *; matrix products are written with @"""
    inverse = np.linalg.inv(m)
    return -inverse * dm * inverse


def inverse_differential(m, dm):
    """the second factor is transposed: it is -M^-1 dM M^-T instead of -M^-1 dM M^-1"""
    inverse = np.linalg.inv(m)
    return -inverse @ dm @ inverse.T


def residual_slope(values, m, a, i, j):
    """row and column, i and j, are swapped: the 1 of dM stands at [j, i], as if dM were
    transposed"""
    dm = np.zeros((3, 3))
    dm[j, i] = 1
    return values @ inverse_differential(m, dm) @ a


def residual_slope(values, m, a, i, j):
    """the minus sign is missing: a vertex drags the picture along, against its slope"""
    dm = np.zeros((3, 3))
    dm[i, j] = 1
    return -values @ inverse_differential(m, dm) @ a


def residual_slope(values, m, a, i, j):
    """dM itself is taken for the change of the inverse, which is -M^-1 dM M^-1: eq. (3) is left
    out"""
    dm = np.zeros((3, 3))
    dm[i, j] = 1
    return values @ dm @ a


def residual_slope(values, m, a, i, j):
    """values and a change places: the values stand on the left of the matrix, and a on its right"""
    dm = np.zeros((3, 3))
    dm[i, j] = 1
    return a @ inverse_differential(m, dm) @ values


def residual_backward(grad_f, values, m, a, target):
    """the inverse is not transposed for grad_a: it is M^-1 r where M^-T r belongs, and grad_m is
    made of it"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_a = grad_f * (inverse @ values)
    return grad_f * c, -np.outer(grad_a, c), grad_a, -grad_f


def residual_backward(grad_f, values, m, a, target):
    """the minus sign of grad_m is missing: a vertex drags the picture along, against its slope"""
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


def residual_backward(grad_f, values, m, a, target):
    """grad_f is left out of grad_m: by the chain rule, grad_m is multiplied by grad_f too"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    by_a = inverse.T @ values
    return grad_f * c, -np.outer(by_a, c), grad_f * by_a, -grad_f


def residual_backward(grad_f, values, m, a, target):
    """the last row of grad_m is set to 0, as if the 1s of M were constants; they are variables,
    too"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_a = grad_f * (inverse.T @ values)
    grad_m = -np.outer(grad_a, c)
    grad_m[2] = 0
    return grad_f * c, grad_m, grad_a, -grad_f


def residual_backward(grad_f, values, m, a, target):
    """grad_target has the wrong sign: the minus is missing, f falls where the target grows"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_a = grad_f * (inverse.T @ values)
    return grad_f * c, -np.outer(grad_a, c), grad_a, grad_f


def residuals_jacobian(values, triangle, points):
    """the minus sign of by_triangle is missing: a vertex drags the picture along, against its
    slope"""
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:, :2].T + inverse[:, 2]
    slope = values @ inverse[:, :2]
    return c, c[:, :, None] * slope


def residuals_jacobian(values, triangle, points):
    """x and y are swapped in by_triangle"""
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:, :2].T + inverse[:, 2]
    slope = values @ inverse[:, :2]
    return c, -c[:, :, None] * slope[::-1]


def residuals_jacobian(values, triangle, points):
    """the 1 of a = (x, y, 1) is left out, and M^-1 has three columns"""
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:, :2].T
    slope = values @ inverse[:, :2]
    return c, -c[:, :, None] * slope


def residuals_jacobian(values, triangle, points):
    """the slope is M^-1 r; the inverse must be transposed there, M^-T r"""
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:, :2].T + inverse[:, 2]
    slope = (inverse @ values)[:2]
    return c, -c[:, :, None] * slope


def residuals_jacobian(values, triangle, points):
    """the weights c are a^T M^-1; the inverse must not be transposed there, c = M^-1 a"""
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:2] + inverse[2]
    slope = values @ inverse[:, :2]
    return c, -c[:, :, None] * slope


def residuals_jacobian(values, triangle, points):
    """the weights c are left out of by_triangle: all three vertices get the whole slope"""
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:, :2].T + inverse[:, 2]
    slope = values @ inverse[:, :2]
    return c, -np.ones((len(points), 3, 1)) * slope


def gauss_newton_step(residuals, jacobian):
    """the sign is wrong, the minus is missing: the step goes uphill"""
    return np.linalg.lstsq(jacobian, residuals)[0]


def gauss_newton_step(residuals, jacobian):
    """it is a gradient step, -J^T r: the inverse of J^T J is left out"""
    return -jacobian.T @ residuals


def gauss_newton_step(residuals, jacobian):
    """something is added to the diagonal of J^T J: that damps the step, which then is too short"""
    return np.linalg.solve(
        jacobian.T @ jacobian + 0.001 * np.eye(jacobian.shape[1]), -jacobian.T @ residuals
    )


def gauss_newton_step(residuals, jacobian):
    """J^T is left out in front of the residuals: J^T J step = -J^T r"""
    return np.linalg.solve(jacobian.T @ jacobian, -residuals)


def gauss_newton_step(residuals, jacobian):
    """only the diagonal of J^T J is used, as if each unknown were alone"""
    return -(jacobian.T @ residuals) / (jacobian**2).sum(0)


def gauss_newton_step(residuals, jacobian):
    """the step is divided by the number of residuals: a mean stands for the sum, J^T r"""
    return -np.linalg.lstsq(jacobian, residuals)[0] / len(residuals)


def barycentric_backward(grad_b, m, a):
    """the sum s is taken for a constant, but s depends on c: grad_b . b is left out of grad_c"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_c = grad_b / c.sum()
    grad_a = inverse.T @ grad_c
    return -np.outer(grad_a, c), grad_a


def barycentric_backward(grad_b, m, a):
    """the division by s, the sum, is missing in grad_c: it is (grad_b - grad_b . b) / s"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_c = grad_b - grad_b @ c / c.sum()
    grad_a = inverse.T @ grad_c
    return -np.outer(grad_a, c), grad_a


def barycentric_backward(grad_b, m, a):
    """grad_b . b is multiplied by b again, the rule for unit vectors (a vector normalised by its
    length); here the numbers are divided by their sum, and grad_b . b goes to all three alike"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    b = c / c.sum()
    grad_c = (grad_b - grad_b @ b * b) / c.sum()
    grad_a = inverse.T @ grad_c
    return -np.outer(grad_a, c), grad_a


def barycentric_backward(grad_b, m, a):
    """grad_m is made with b in place of c: it is -grad_a c^T, c not divided by s"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_c = (grad_b - grad_b @ c / c.sum()) / c.sum()
    grad_a = inverse.T @ grad_c
    return -np.outer(grad_a, c / c.sum()), grad_a


def barycentric_backward(grad_b, m, a):
    """the inverse is not transposed for grad_a: it is M^-1 grad_c where M^-T grad_c belongs"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_c = (grad_b - grad_b @ c / c.sum()) / c.sum()
    grad_a = inverse @ grad_c
    return -np.outer(grad_a, c), grad_a


def barycentric_backward(grad_b, m, a):
    """the minus sign of grad_m is missing: a vertex drags the picture along, against its slope"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_c = (grad_b - grad_b @ c / c.sum()) / c.sum()
    grad_a = inverse.T @ grad_c
    return np.outer(grad_a, c), grad_a
