"""Wrong answers to transforms, written without a look at the checks."""


def transform(points, matrix):
    """only the upper left 3 x 3 is applied, so the translation in the last column is lost

    told by: translation | last column | 3 x 3 | 3x3 | fourth column | offset & lost | not moved by
    """
    moved = points.copy()
    moved[..., :3] = points[..., :3] @ matrix[:3, :3].T
    return moved


def transform_backward(grad_output, points, matrix):
    """grad_points is multiplied by the transposed matrix, as in the forward pass

    told by: grad_points & transpose | grad_points & .T | transposed & matrix & points | grad_output @ matrix | forward & matrix.T | without & transpos
    """
    d_points = grad_output @ matrix.T
    d_matrix = np.einsum("ni,nj->ij", grad_output.reshape(-1, 4), points.reshape(-1, 4))
    return d_points, d_matrix


def rotate(axis, angle):
    """the axis is not normalised: n should have length 1

    told by: normali | unit | length & axis | length 1 | axis & long | norm of
    """
    c, s = np.cos(angle), np.sin(angle)
    a, b, d = axis
    cross = np.array([[0, -d, b], [d, 0, -a], [-b, a, 0]])
    turn = np.eye(4)
    turn[:3, :3] = c * np.eye(3) + (1 - c) * np.outer(axis, axis) + s * cross
    return turn


def look_at(eye, target, up):
    """right is not normalised, so up must be a unit vector at right angles to back

    told by: right & normali | right & length | right & unit | right & |up x back| | not & normali & axes | not of length 1
    """
    back = eye - target
    back = back / np.linalg.norm(back)
    right = np.cross(up, back)
    above = np.cross(back, right)
    turn = np.eye(4)
    turn[0, :3], turn[1, :3], turn[2, :3] = right, above, back
    return turn @ translate(-eye)


def frustum(l, r, b, t, near, far):
    """(r+l)/(r-l) and (t+b)/(t-b) stand in the last column, as in an orthographic matrix, not in the third

    told by: last column | third column | column 2 | column 3 | fourth column | off-cent & column | orthographic
    """
    m = np.zeros((4, 4))
    m[0, 0], m[0, 3] = 2 * near / (r - l), (r + l) / (r - l)
    m[1, 1], m[1, 3] = 2 * near / (t - b), (t + b) / (t - b)
    m[2, 2], m[2, 3] = (far + near) / (near - far), 2 * far * near / (near - far)
    m[3, 2] = -1
    return m


def perspective_divide(clip):
    """only x and y are divided by w, z is left as it is

    told by: z & not divided | z & undivided | z is left | only x and y | z & as it is | z & too | depth & not divided | depth & undivided
    """
    out = clip[..., :3].copy()
    for axis in (0, 1):
        out[..., axis] = clip[..., axis] / clip[..., 3]
    return out


def perspective_divide_backward(grad_ndc, clip):
    """the gradient of w is divided by w once instead of twice: 1 / w^2 is missing a w

    told by: w^2 | w**2 | w squared | factor & w | twice & w | once & w | 1 / w | 1/w
    """
    w = clip[..., 3]
    grad = np.empty_like(clip)
    grad[..., 3] = 0
    for axis in range(3):
        grad[..., axis] = grad_ndc[..., axis] / w
        grad[..., 3] -= grad_ndc[..., axis] * clip[..., axis] / w
    return grad
