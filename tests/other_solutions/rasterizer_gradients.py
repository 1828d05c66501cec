"""Lab 7's whole meshes once more: element by element, face by face."""
import numpy as np

from reference.rasterization import EDGES


def edge_normals(corners):
    rows = [np.cross(corners[:, i], corners[:, j], axis=0) for i, j in EDGES]
    return np.asfortranarray(rows)


def edge_functions_at_backward(grad_e, x, y):
    # Of one pixel e is the cross product of its three x and its three y.
    grad_x, grad_y = np.empty(np.shape(x)), np.empty(np.shape(y))
    for n in range(np.shape(x)[1]):
        grad_x[:, n] = np.cross(y[:, n], grad_e[:, n])
        grad_y[:, n] = np.cross(grad_e[:, n], x[:, n])
    return grad_x, grad_y


def normalize_derivative_backward(grad_db, dc, b, s):
    # db = dc / s - c sum dc / s^2, every number of it by every number.
    grad_c, grad_dc = np.zeros(dc.shape), np.zeros(dc.shape)
    for n, k, j in np.ndindex(dc.shape[1], 3, 3):
        same, ds, c = float(j == k), dc[:, n].sum(), b[k, n] * s[n]
        grad_dc[j, n] += grad_db[k, n] * (same / s[n] - c / s[n]**2)
        grad_c[j, n] += grad_db[k, n] * (-dc[k, n] / s[n]**2 - same * ds / s[n]**2
                                         + 2 * c * ds / s[n]**3)
    return grad_dc, grad_c


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
