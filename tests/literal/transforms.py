"""Lab 1 as printed: what one types who has read the questions and the equations."""


def transform(points, matrix):
    return points @ matrix.T


def transform_backward(grad_output, points, matrix):
    return grad_output @ matrix, grad_output.reshape(-1, 4).T @ points.reshape(-1, 4)


def rotate(axis, angle):
    n = axis / np.linalg.norm(axis)
    cross = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    matrix = np.eye(4)
    matrix[:3, :3] = (np.cos(angle) * np.eye(3) + (1 - np.cos(angle)) * np.outer(n, n)
                      + np.sin(angle) * cross)
    return matrix


def look_at(eye, target, up):
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross(up, back) / np.linalg.norm(np.cross(up, back))
    above = np.cross(back, right)
    matrix = np.eye(4)
    matrix[:3, :3] = right, above, back
    return matrix @ translate(-eye)


def frustum(l, r, b, t, near, far):
    alpha = (far + near) / (near - far)
    beta = 2 * far * near / (near - far)
    return np.array([[2 * near / (r - l), 0, (r + l) / (r - l), 0],
                     [0, 2 * near / (t - b), (t + b) / (t - b), 0],
                     [0, 0, alpha, beta],
                     [0, 0, -1, 0]])


def perspective_divide(clip):
    return clip[..., :3] / clip[..., 3:]


def perspective_divide_backward(grad_ndc, clip):
    x, y, z, w = np.moveaxis(clip, -1, 0)
    g_x, g_y, g_z = np.moveaxis(grad_ndc, -1, 0)
    return np.stack([g_x / w, g_y / w, g_z / w, -(g_x * x + g_y * y + g_z * z) / w**2], -1)
