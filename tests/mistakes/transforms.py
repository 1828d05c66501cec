"""Mistakes of lab 1; each docstring goes on after "this is what comes out when"."""


def transform(points, matrix):
    """the transposed matrix is applied: points are rows here, but the matrix acts on columns"""
    return points @ matrix


def transform(points, matrix):
    """the inverse of the matrix is applied"""
    return points @ np.linalg.inv(matrix).T


def transform(points, matrix):
    """the result is divided by w already; the divide is a later step"""
    return (points @ matrix.T) / (points @ matrix.T)[..., 3:]


def transform_backward(grad_output, points, matrix):
    """the gradient goes through the matrix as points do, instead of through its transpose"""
    grad_points = grad_output @ matrix.T
    grad_matrix = grad_output.reshape(-1, 4).T @ points.reshape(-1, 4)
    return grad_points, grad_matrix


def transform_backward(grad_output, points, matrix):
    """the matrix's gradient is transposed: row i belongs to output i"""
    grad_points = grad_output @ matrix
    grad_matrix = points.reshape(-1, 4).T @ grad_output.reshape(-1, 4)
    return grad_points, grad_matrix


def transform_backward(grad_output, points, matrix):
    """the matrix's gradient is the mean over the points instead of the sum"""
    grad_points = grad_output @ matrix
    grad_matrix = grad_output.reshape(-1, 4).T @ points.reshape(-1, 4) / max(1, points.size // 4)
    return grad_points, grad_matrix


def rotate(axis, angle):
    """the turn is clockwise: the sign of the sine is wrong"""
    x, y, z = n = axis / np.linalg.norm(axis)
    cross = np.array([[ 0, -z,  y],
                      [ z,  0, -x],
                      [-y,  x,  0]])
    matrix = np.eye(4)
    matrix[:3, :3] = (np.cos(angle) * np.eye(3) + (1 - np.cos(angle)) * np.outer(n, n)
                      - np.sin(angle) * cross)
    return matrix


def rotate(axis, angle):
    """the angle is taken for degrees; it is in radians"""
    x, y, z = n = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(4)
    matrix[:3, :3] = (
        np.cos(np.radians(angle)) * np.eye(3)
        + (1 - np.cos(np.radians(angle))) * np.outer(n, n)
        + np.sin(np.radians(angle)) * cross
    )
    return matrix


def rotate(axis, angle):
    """the axis is not brought to length 1"""
    x, y, z = n = axis
    cross = np.array([[ 0, -z,  y],
                      [ z,  0, -x],
                      [-y,  x,  0]])
    matrix = np.eye(4)
    matrix[:3, :3] = (np.cos(angle) * np.eye(3) + (1 - np.cos(angle)) * np.outer(n, n)
                      + np.sin(angle) * cross)
    return matrix


def look_at(eye, target, up):
    """the camera looks down +z: the third axis is from the target to the eye"""
    back = target - eye
    right = np.cross(up, back)
    axes = np.stack([right, np.cross(back, right), back])
    rotation = np.eye(4)
    rotation[:3, :3] = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    return rotation @ translate(-eye)


def look_at(eye, target, up):
    """left and right are mirrored: a cross product has its arguments in the wrong order"""
    back = eye - target
    right = np.cross(back, up)
    axes = np.stack([right, np.cross(back, right), back])
    rotation = np.eye(4)
    rotation[:3, :3] = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    return rotation @ translate(-eye)


def look_at(eye, target, up):
    """the world is moved by +eye instead of by -eye"""
    back = eye - target
    right = np.cross(up, back)
    axes = np.stack([right, np.cross(back, right), back])
    rotation = np.eye(4)
    rotation[:3, :3] = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    return rotation @ translate(eye)


def normal_matrix(matrix):
    """normals are moved as points are; under an uneven scaling they tilt"""
    return matrix[:3, :3]


def normal_matrix(matrix):
    """the inverse is not transposed"""
    return np.linalg.inv(matrix[:3, :3])


def normal_matrix(matrix):
    """the whole matrix is inverted, its last row too, instead of its upper left 3 x 3"""
    return np.linalg.inv(matrix)[:3, :3].T


def pinhole(f):
    """w is 1: nothing is divided by z"""
    return np.array([[f, 0, 0, 0],
                     [0, f, 0, 0],
                     [0, 0, f, 0],
                     [0, 0, 0, 1.0]])


def pinhole(f):
    """w is -z; this camera looks down +z"""
    return np.array([[f, 0, 0, 0],
                     [0, f, 0, 0],
                     [0, 0, f, 0],
                     [0, 0, -1, 0.0]])


def pinhole(f):
    """z is not multiplied by f"""
    return np.array([[f, 0, 0, 0],
                     [0, f, 0, 0],
                     [0, 0, 1, 0],
                     [0, 0, 1, 0.0]])


def frustum_sides(fov_y, aspect, near):
    """the whole angle is taken for half of it"""
    t = near * np.tan(fov_y)
    r = aspect * t
    return -r, r, -t, t


def frustum_sides(fov_y, aspect, near):
    """the angle is taken for degrees"""
    t = near * np.tan(np.radians(fov_y) / 2)
    r = aspect * t
    return -r, r, -t, t


def frustum_sides(fov_y, aspect, near):
    """the width is divided by the aspect; it is width / height"""
    t = near * np.tan(fov_y / 2)
    r = t / aspect
    return -r, r, -t, t


def frustum(l, r, b, t, near, far):
    """alpha has the wrong sign"""
    alpha = -(far + near) / (near - far)
    beta = 2 * far * near / (near - far)
    return np.array([[2 * near / (r - l), 0,                  (r + l) / (r - l), 0],
                     [0,                  2 * near / (t - b), (t + b) / (t - b), 0],
                     [0,                  0,                  alpha,             beta],
                     [0,                  0,                  -1,                0]])


def frustum(l, r, b, t, near, far):
    """the factor 2 in 2 near / (r - l) is missing"""
    alpha = (far + near) / (near - far)
    beta = 2 * far * near / (near - far)
    return np.array([[near / (r - l), 0,                  (r + l) / (r - l), 0],
                     [0,                  2 * near / (t - b), (t + b) / (t - b), 0],
                     [0,                  0,                  alpha,             beta],
                     [0,                  0,                  -1,                0]])


def frustum(l, r, b, t, near, far):
    """w is z; the camera looks down -z"""
    alpha = (far + near) / (near - far)
    beta = 2 * far * near / (near - far)
    return np.array([[2 * near / (r - l), 0,                  (r + l) / (r - l), 0],
                     [0,                  2 * near / (t - b), (t + b) / (t - b), 0],
                     [0,                  0,                  alpha,             beta],
                     [0,                  0,                  1,                 0]])


def orthographic(l, r, b, t, near, far):
    """the box is moved sideways the wrong way"""
    return np.array([[2 / (r - l), 0,           0,                (r + l) / (r - l)],
                     [0,           2 / (t - b), 0,                -(t + b) / (t - b)],
                     [0,           0,           2 / (near - far), (far + near) / (near - far)],
                     [0,           0,           0,                1]])


def orthographic(l, r, b, t, near, far):
    """z runs the wrong way: near must become -1"""
    return np.array([[2 / (r - l), 0,           0,                -(r + l) / (r - l)],
                     [0,           2 / (t - b), 0,                -(t + b) / (t - b)],
                     [0,           0,           2 / (far - near), (far + near) / (near - far)],
                     [0,           0,           0,                1]])


def orthographic(l, r, b, t, near, far):
    """y is scaled by 1 / (t - b): ndc is 2 high"""
    return np.array([[2 / (r - l), 0,           0,                -(r + l) / (r - l)],
                     [0,           1 / (t - b), 0,                -(t + b) / (t - b)],
                     [0,           0,           2 / (near - far), (far + near) / (near - far)],
                     [0,           0,           0,                1]])


def perspective_divide(clip):
    """the division is by z; it is by w"""
    return clip[..., :3] / clip[..., 2:3]


def perspective_divide(clip):
    """the sign of w is lost"""
    return clip[..., :3] / np.abs(clip[..., 3:])


def perspective_divide(clip):
    """z is not divided"""
    return np.concatenate([clip[..., :2] / clip[..., 3:], clip[..., 2:3]], -1)


def perspective_divide_backward(grad_ndc, clip):
    """the gradient by w has the wrong sign"""
    w = clip[..., 3:]
    grad_xyz = grad_ndc / w
    grad_w = (grad_xyz * clip[..., :3] / w).sum(-1, keepdims=True)
    return np.concatenate([grad_xyz, grad_w], -1)


def perspective_divide_backward(grad_ndc, clip):
    """the gradient by w is divided by w once; the derivative of 1/w is -1/w^2"""
    w = clip[..., 3:]
    grad_xyz = grad_ndc / w
    grad_w = -(grad_xyz * clip[..., :3]).sum(-1, keepdims=True)
    return np.concatenate([grad_xyz, grad_w], -1)


def perspective_divide_backward(grad_ndc, clip):
    """w gets no gradient: but the divide depends on it"""
    w = clip[..., 3:]
    grad_xyz = grad_ndc / w
    grad_w = np.zeros(w.shape)
    return np.concatenate([grad_xyz, grad_w], -1)


def viewport(width, height):
    """y points down; here row 0 is at the bottom"""
    return np.array([[width / 2, 0,          0, width / 2],
                     [0, -height / 2, 0, height / 2],
                     [0,         0,          1, 0],
                     [0,         0,          0, 1]])


def viewport(width, height):
    """everything is half a pixel off: the left border of the picture is x = 0, not -1/2"""
    return np.array([[width / 2, 0,          0, width / 2 - 0.5],
                     [0,         height / 2, 0, height / 2],
                     [0,         0,          1, 0],
                     [0,         0,          0, 1]])


def viewport(width, height):
    """ndc is taken as from 0 to 1; it is from -1 to 1"""
    return np.array([[width, 0, 0, width],
                     [0,         height / 2, 0, height / 2],
                     [0,         0,          1, 0],
                     [0,         0,          0, 1]])


def to_screen_backward(grad_screen, width, height):
    """the gradient is divided by the scale; it must be multiplied"""
    return grad_screen / np.diag(viewport(width, height))[:3]


def to_screen_backward(grad_screen, width, height):
    """width and height are swapped"""
    return grad_screen @ viewport(height, width)[:3, :3]


def to_screen_backward(grad_screen, width, height):
    """the scale is the whole width; ndc is 2 wide, so it is half of that"""
    return grad_screen @ (2 * viewport(width, height)[:3, :3])
