"""Lab 7 once more: solving for inverting, Jacobians element by element, face by face."""
import numpy as np

from reference.vertex_gradients import EDGES


def vertex_matrix(triangle):
    return np.vstack([np.transpose(triangle), [1, 1, 1]])


def residual(values, m, a, target):
    return float(np.linalg.solve(m.T, values) @ a - target)


def inverse_differential(m, dm):
    # The inverse of [M dM; 0 M] has it in its upper right corner.
    blocks = np.block([[m, dm], [np.zeros((3, 3)), m]])
    return np.linalg.inv(blocks)[:3, 3:]


def residual_slope(values, m, a, i, j):
    # Cramer's rule: f + target = sum_k r_k det(M with a in column k) / det M.
    unit = np.zeros((3, 3))
    unit[i, j] = 1

    def slope_of_det(matrix, change):
        return sum(np.linalg.det(np.column_stack([(change if k == c else matrix)[:, c]
                                                  for c in range(3)])) for k in range(3))

    det, slope = np.linalg.det(m), 0.0
    for k in range(3):
        with_a, change = m.copy(), unit.copy()
        with_a[:, k], change[:, k] = a, 0
        slope += values[k] * (slope_of_det(with_a, change) / det
                              - np.linalg.det(with_a) * slope_of_det(m, unit) / det**2)
    return slope


def residual_backward(grad_f, values, m, a, target):
    share, slope = np.linalg.solve(m, a), np.linalg.solve(m.T, values)
    return [grad_f * share, -grad_f * slope[:, None] * share[None, :], grad_f * slope, -grad_f]


def residuals_jacobian(values, triangle, points):
    by_values, by_triangle = np.empty((len(points), 3)), np.empty((len(points), 3, 2))
    (edge, other), origin = triangle[1:] - triangle[0], triangle[0]
    # The picture is a plane: its slope g has g . edge = the difference of values.
    slope = np.linalg.solve([edge, other], values[1:] - values[0])
    for p, point in enumerate(points):
        second, third = np.linalg.solve(np.transpose([edge, other]), point - origin)
        by_values[p] = 1 - second - third, second, third
        by_triangle[p] = [-slope * share for share in by_values[p]]
    return by_values, by_triangle


def gauss_newton_step(residuals, jacobian):
    u, size, v = np.linalg.svd(jacobian, full_matrices=False)
    used = size > 1e-12 * size.max(initial=0)
    return -v[used].T @ ((u.T @ residuals)[used] / size[used])


def weights(m, a):
    q = m.T
    areas = np.array([np.cross(q[i], q[j]) @ a for i, j in EDGES])
    return areas / areas.sum()


def weights_backward(grad_b, m, a):
    inverse = np.linalg.inv(m)
    c = inverse @ a
    s = c.sum()

    def pull(dc):
        """The loss's change where c changes by dc: the quotient rule."""
        return sum(grad_b * (dc * s - c * dc.sum())) / s**2

    grad_m = np.array([[pull(-inverse[:, i] * c[j]) for j in range(3)] for i in range(3)])
    return grad_m, np.array([pull(inverse[:, i]) for i in range(3)])


def edge_functions(corners):
    rows = [np.cross(corners[:, i], corners[:, j], axis=0) for i, j in EDGES]
    return np.asfortranarray(rows)


def edge_functions_backward(grad_edges, corners):
    # e_k = sum epsilon_abc q_i[b] q_j[c]: linear in each of the two.
    epsilon = np.zeros((3, 3, 3))
    for k in range(3):
        epsilon[k, k - 2, k - 1], epsilon[k, k - 1, k - 2] = 1, -1
    grad = np.zeros(np.shape(corners))
    for k, (i, j) in enumerate(EDGES):
        grad[:, i] += np.einsum("abc,a...,c...->b...", epsilon, grad_edges[k], corners[:, j])
        grad[:, j] += np.einsum("abc,a...,b...->c...", epsilon, grad_edges[k], corners[:, i])
    return grad


def longer_sum(e, epsilon):
    return [s - epsilon if s < 0 else s + epsilon for s in e[0] + e[1] + e[2]]


def normalize(e, epsilon):
    return np.transpose([column / s for column, s in zip(e.T, longer_sum(e, epsilon),
                                                         strict=True)]).reshape(e.shape)


def normalize_backward(grad_b, e, epsilon):
    grad_e = np.empty(e.shape)
    for n, s in enumerate(longer_sum(e, epsilon)):
        jacobian = np.eye(3) / s - np.outer(e[:, n], np.ones(3)) / s**2
        grad_e[:, n] = jacobian.T @ grad_b[:, n]
    return grad_e


def normalize_derivative(e, e_x, epsilon):
    s, s_x = np.array(longer_sum(e, epsilon)), e_x.sum(0)
    return (e_x * s - e * s_x) / s**2


def normalize_derivative_backward(grad_b_x, e, e_x, epsilon):
    # b_x = e_x / s - e s_x / s^2, every number of it by every number.
    grad_e, grad_e_x = np.zeros(e.shape), np.zeros(e.shape)
    for n, s in enumerate(longer_sum(e, epsilon)):
        s_x = e_x[:, n].sum()
        for k in range(3):
            for j in range(3):
                same, g = float(j == k), grad_b_x[k, n]
                grad_e_x[j, n] += g * (same / s - e[k, n] / s**2)
                grad_e[j, n] += g * (-e_x[k, n] / s**2 - same * s_x / s**2
                                     + 2 * e[k, n] * s_x / s**3)
    return grad_e, grad_e_x


def sum_per_face(u, x, y, face, count):
    sums = np.zeros((len(u), 3, count))
    for n, f in enumerate(face):
        sums[:, :, f] += np.outer(u[:, n], [x[n], y[n], 1])
    return sums


def depth_planes(z, corners):
    return np.reshape([np.linalg.solve(corners[..., f].T, z[:, f]) for f in range(z.shape[1])],
                      (-1, 3)).T


def depth_planes_backward(grad_planes, z, corners):
    planes = depth_planes(z, corners)
    grad_z, grad_corners = np.empty(z.shape), np.empty(corners.shape)
    for f in range(z.shape[1]):
        grad_z[:, f] = np.linalg.solve(corners[..., f], grad_planes[:, f])
        grad_corners[..., f] = -np.outer(planes[:, f], grad_z[:, f])
    return grad_z, grad_corners
