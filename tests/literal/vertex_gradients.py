"""Lab 7 as printed: what one types who has read the questions and the equations."""


def vertex_matrix(triangle):
    (x0, y0), (x1, y1), (x2, y2) = triangle
    return np.array([[x0, x1, x2], [y0, y1, y2], [1, 1, 1]])


def inverse_differential(m, dm):
    return -np.linalg.inv(m) @ dm @ np.linalg.inv(m)


def residual_backward(grad_f, values, m, a, target):
    inverse = np.linalg.inv(m)
    c = inverse @ a
    by_a = inverse.T @ values
    return grad_f * c, grad_f * -np.outer(by_a, c), grad_f * by_a, -grad_f


def residuals_jacobian(values, triangle, points):
    m = vertex_matrix(triangle)
    by_values, by_triangle = [], []
    for x, y in points:
        by_r, by_m, _, _ = residual_backward(1.0, values, m, np.array([x, y, 1.0]), 0.0)
        by_values.append(by_r)
        by_triangle.append(by_m[:2].T)
    return np.array(by_values), np.array(by_triangle)


def gauss_newton_step(residuals, jacobian):
    return np.linalg.solve(jacobian.T @ jacobian, -jacobian.T @ residuals)


def barycentric_backward(grad_b, m, a):
    inverse = np.linalg.inv(m)
    c = inverse @ a
    s = c.sum()
    b = c / s
    grad_c = (grad_b - (grad_b @ b) * np.ones(3)) / s
    grad_a = inverse.T @ grad_c
    return -np.outer(grad_a, c), grad_a
