"""Lab 7 once more: solving for inverting, Jacobians element by element, face by face."""
import numpy as np


def inverse_differential(m, dm):
    # The inverse of [M dM; 0 M] has it in its upper right corner.
    blocks = np.block([[m, dm], [np.zeros((3, 3)), m]])
    return np.linalg.inv(blocks)[:3, 3:]


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


def barycentric_backward(grad_b, m, a):
    inverse = np.linalg.inv(m)
    c = inverse @ a
    s = c.sum()

    def pull(dc):
        """The loss's change where c changes by dc: the quotient rule."""
        return sum(grad_b * (dc * s - c * dc.sum())) / s**2

    grad_m = np.array([[pull(-inverse[:, i] * c[j]) for j in range(3)] for i in range(3)])
    return grad_m, np.array([pull(inverse[:, i]) for i in range(3)])
