"""Lab 7 once more: solving for inverting, complex steps, derivatives element by element."""
import numpy as np


def inverse_differential(m, dm):
    # The inverse of [M dM; 0 M] has it in its upper right corner.
    blocks = np.block([[m, dm], [np.zeros((3, 3)), m]])
    return np.linalg.inv(blocks)[:3, 3:]


def residual_slope(values, m, a, i, j):
    # The weights c and the slope M^-T r, one number of each.
    return -np.linalg.solve(np.transpose(m), values)[i] * np.linalg.solve(m, a)[j]


def residual_backward(grad_f, values, m, a, target):
    share, slope = np.linalg.solve(m, a), np.linalg.solve(m.T, values)
    return [grad_f * share, -grad_f * slope[:, None] * share[None, :], grad_f * slope, -grad_f]


def fit_step(triangle, colours, points, target, colours_too=False):
    # The derivatives are complex steps, and the pseudoinverse finds the shortest change.
    def residuals(unknowns):
        m = np.vstack([unknowns[:6].reshape(3, 2).T, [1, 1, 1]])
        c = np.linalg.solve(m, np.vstack([np.transpose(points), np.ones(len(points))]))
        return (c.T @ unknowns[6:].reshape(3, -1) - target).ravel()

    there = np.concatenate([np.ravel(triangle), np.ravel(colours)])
    steps = np.eye(there.size)[:there.size if colours_too else 6]
    columns = np.stack([residuals(there + 1e-20j * step).imag / 1e-20 for step in steps], -1)
    change = steps.T @ np.linalg.pinv(columns, 1e-12) @ -residuals(there)
    return change[:6].reshape(3, 2), change[6:].reshape(np.shape(colours))


def barycentric_backward(grad_b, m, a):
    inverse = np.linalg.inv(m)
    c = inverse @ a
    s = c.sum()

    def pull(dc):
        """The loss's change where c changes by dc: the quotient rule."""
        return sum(grad_b * (dc * s - c * dc.sum())) / s**2

    grad_m = np.array([[pull(-inverse[:, i] * c[j]) for j in range(3)] for i in range(3)])
    return grad_m, np.array([pull(inverse[:, i]) for i in range(3)])
