"""Lab 7 once more: solving for inverting, complex steps, derivatives element by element."""
import numpy as np


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
