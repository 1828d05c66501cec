"""Lab 7 once more: solving for inverting, Jacobians element by element, face by face."""
import numpy as np


def vertex_matrix(triangle):
    return np.vstack([np.transpose(triangle), [1, 1, 1]])


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
    # Residual by residual: a plane through the corners, and the pseudoinverse.
    (edge, other), origin = triangle[1:] - triangle[0], triangle[0]
    rows, short = [], []
    for point, wanted in zip(points, target, strict=True):
        second, third = np.linalg.solve(np.transpose([edge, other]), point - origin)
        shares = np.array([1 - second - third, second, third])
        for channel, values in enumerate(np.transpose(colours)):
            slope = np.linalg.solve([edge, other], values[1:] - values[0])
            own = np.zeros(np.shape(colours))
            own[:, channel] = colours_too * shares
            rows.append([*(-np.outer(shares, slope)).ravel(), *own.ravel()])
            short.append(wanted[channel] - shares @ values)
    found = np.linalg.pinv(rows, 1e-12) @ short
    return found[:6].reshape(3, 2), found[6:].reshape(np.shape(colours))


def barycentric_backward(grad_b, m, a):
    inverse = np.linalg.inv(m)
    c = inverse @ a
    s = c.sum()

    def pull(dc):
        """The loss's change where c changes by dc: the quotient rule."""
        return sum(grad_b * (dc * s - c * dc.sum())) / s**2

    grad_m = np.array([[pull(-inverse[:, i] * c[j]) for j in range(3)] for i in range(3)])
    return grad_m, np.array([pull(inverse[:, i]) for i in range(3)])
