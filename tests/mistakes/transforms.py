"""Mistakes of lab 1; each docstring goes on after "this is what comes out when"."""


def transform(points, matrix):
    """the transposed matrix is applied: points are rows here, but the matrix acts on columns"""
    return points @ matrix


def transform(points, matrix):
    """the inverse of the matrix is applied, so that points move the other way round"""
    return points @ np.linalg.inv(matrix).T


def transform(points, matrix):
    """the result is divided by w already; the perspective divide is a later step"""
    return (points @ matrix.T) / (points @ matrix.T)[..., 3:]


def transform(points, matrix):
    """the translation, the last column of the matrix, is left out: only its upper left 3 x 3 is
    applied, and w is kept"""
    return np.concatenate([points[..., :3] @ matrix[:3, :3].T, points[..., 3:]], -1)


def transform(points, matrix):
    """w of the points is ignored, as if it were 1: the whole translation is added to each point"""
    return np.concatenate([points[..., :3], np.ones(points[..., 3:].shape)], -1) @ matrix.T


def transform(points, matrix):
    """the last row of the matrix is ignored: w comes out as it went in"""
    return np.concatenate([points @ matrix[:3].T, points[..., 3:]], -1)


def transform_backward(grad_output, points, matrix):
    """grad_points goes through the matrix as points do in the forward pass (matrix.T), instead of
    through its transpose: it is grad_output @ matrix"""
    grad_points = grad_output @ matrix.T
    grad_matrix = grad_output.reshape(-1, 4).T @ points.reshape(-1, 4)
    return grad_points, grad_matrix


def transform_backward(grad_output, points, matrix):
    """grad_matrix is transposed, the factors of its outer product are swapped: row i belongs to
    output i"""
    grad_points = grad_output @ matrix
    grad_matrix = points.reshape(-1, 4).T @ grad_output.reshape(-1, 4)
    return grad_points, grad_matrix


def transform_backward(grad_output, points, matrix):
    """grad_matrix is the mean (average) over the points instead of the sum: it is divided by their
    number"""
    grad_points = grad_output @ matrix
    grad_matrix = grad_output.reshape(-1, 4).T @ points.reshape(-1, 4) / max(1, points.size // 4)
    return grad_points, grad_matrix


def transform_backward(grad_output, points, matrix):
    """only the last point counts in grad_matrix, because it is overwritten (= for +=): all points
    must be summed"""
    grad_points = grad_output @ matrix
    grad_matrix = np.outer(grad_output.reshape(-1, 4)[-1], points.reshape(-1, 4)[-1])
    return grad_points, grad_matrix


def transform_backward(grad_output, points, matrix):
    """the two gradients are returned in the wrong order, exchanged: grad_points is first"""
    grad_points = grad_output @ matrix
    grad_matrix = grad_output.reshape(-1, 4).T @ points.reshape(-1, 4)
    return grad_matrix, grad_points


def transform_backward(grad_output, points, matrix):
    """grad_points goes through the inverse of the matrix; it must go through the transpose, as
    grad_output @ matrix"""
    grad_points = grad_output @ np.linalg.inv(matrix).T
    grad_matrix = grad_output.reshape(-1, 4).T @ points.reshape(-1, 4)
    return grad_points, grad_matrix


def rotate(axis, angle):
    """the turn is clockwise, the wrong way round: the sine or the matrix [n]x has the wrong sign,
    or the rotation is transposed"""
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
    """the axis is not normalised: it must be divided by its length, to have length 1"""
    x, y, z = n = axis
    cross = np.array([[ 0, -z,  y],
                      [ z,  0, -x],
                      [-y,  x,  0]])
    matrix = np.eye(4)
    matrix[:3, :3] = (np.cos(angle) * np.eye(3) + (1 - np.cos(angle)) * np.outer(n, n)
                      + np.sin(angle) * cross)
    return matrix


def rotate(axis, angle):
    """n n^T is taken for the dot product n . n, a number; it is the outer product, a matrix"""
    x, y, z = n = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(4)
    matrix[:3, :3] = (np.cos(angle) * np.eye(3) + (1 - np.cos(angle)) * (n @ n)
                      + np.sin(angle) * cross)
    return matrix


def rotate(axis, angle):
    """the term (1 - cos) n n^T is missing"""
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(4)
    matrix[:3, :3] = np.cos(angle) * np.eye(3) + np.sin(angle) * cross
    return matrix


def rotate(axis, angle):
    """n n^T has the factor cos instead of 1 - cos"""
    x, y, z = n = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(4)
    matrix[:3, :3] = (np.cos(angle) * np.eye(3) + np.cos(angle) * np.outer(n, n)
                      + np.sin(angle) * cross)
    return matrix


def look_at(eye, target, up):
    """the third axis points forward, from the eye to the target (target - eye): the camera looks
    down +z. It must point back, from the target to the eye"""
    back = target - eye
    right = np.cross(up, back)
    axes = np.stack([right, np.cross(back, right), back])
    rotation = np.eye(4)
    rotation[:3, :3] = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    return rotation @ translate(-eye)


def look_at(eye, target, up):
    """right is back x up, in the wrong order, and points left (above then points down): the cross
    product is up x back"""
    back = eye - target
    right = np.cross(back, up)
    axes = np.stack([right, np.cross(back, right), back])
    rotation = np.eye(4)
    rotation[:3, :3] = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    return rotation @ translate(-eye)


def look_at(eye, target, up):
    """the world is moved by +eye instead of by -eye: the translation has the wrong sign"""
    back = eye - target
    right = np.cross(up, back)
    axes = np.stack([right, np.cross(back, right), back])
    rotation = np.eye(4)
    rotation[:3, :3] = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    return rotation @ translate(eye)


def look_at(eye, target, up):
    """the camera's axes are the columns of the rotation instead of its rows: it is transposed, the
    inverse rotation, from the camera to the world"""
    back = eye - target
    right = np.cross(up, back)
    axes = np.stack([right, np.cross(back, right), back])
    rotation = np.eye(4)
    rotation[:3, :3] = (axes / np.linalg.norm(axes, axis=1, keepdims=True)).T
    return rotation @ translate(-eye)


def look_at(eye, target, up):
    """right is not normalised: up x back is not of length 1 where up is not of length 1 and at a
    right angle to back. above, made of it, has the same length"""
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross(up, back)
    rotation = np.eye(4)
    rotation[:3, :3] = np.stack([right, np.cross(back, right), back])
    return rotation @ translate(-eye)


def look_at(eye, target, up):
    """up itself is taken for the second axis: it is not perpendicular to back. above is
    back x right"""
    back = eye - target
    axes = np.stack([np.cross(up, back), up, back])
    rotation = np.eye(4)
    rotation[:3, :3] = axes / np.linalg.norm(axes, axis=1, keepdims=True)
    return rotation @ translate(-eye)


def normal_matrix(matrix):
    """normals are moved as points are, by the same matrix; it takes the inverse, transposed"""
    return matrix[:3, :3]


def normal_matrix(matrix):
    """the inverse is not transposed"""
    return np.linalg.inv(matrix[:3, :3])


def normal_matrix(matrix):
    """the whole matrix is inverted, its last row too, instead of its upper left 3 x 3"""
    return np.linalg.inv(matrix)[:3, :3].T


def normal_matrix(matrix):
    """the cofactors are not divided by the determinant: the inverse is off by this factor"""
    return np.linalg.inv(matrix[:3, :3]).T * np.linalg.det(matrix[:3, :3])


def normal_matrix(matrix):
    """the matrix is transposed but not inverted: it takes the inverse of the transpose"""
    return matrix[:3, :3].T


def pinhole(f):
    """w is 1, and nothing is divided by z: the last row must be (0, 0, 1, 0)"""
    return np.array([[f, 0, 0, 0],
                     [0, f, 0, 0],
                     [0, 0, f, 0],
                     [0, 0, 0, 1.0]])


def pinhole(f):
    """w is -z, as for a camera that looks down -z; this camera looks down +z, so the last row is
    (0, 0, 1, 0), without a minus sign"""
    return np.array([[f, 0, 0, 0],
                     [0, f, 0, 0],
                     [0, 0, f, 0],
                     [0, 0, -1, 0.0]])


def pinhole(f):
    """the third row has 1 where f must stand: z is not multiplied by f, and comes out as 1 after
    the divide"""
    return np.array([[f, 0, 0, 0],
                     [0, f, 0, 0],
                     [0, 0, 1, 0],
                     [0, 0, 1, 0.0]])


def pinhole(f):
    """the matrix is transposed: its last row must be (0, 0, 1, 0), not its last column"""
    return np.array([[f, 0, 0, 0],
                     [0, f, 0, 0],
                     [0, 0, f, 1],
                     [0, 0, 0, 0.0]])


def frustum_sides(fov_y, aspect, near):
    """the tangent is of the whole angle; it must be of half of it, fov_y / 2"""
    t = near * np.tan(fov_y)
    r = aspect * t
    return -r, r, -t, t


def frustum_sides(fov_y, aspect, near):
    """the angle is taken for degrees; it is in radians"""
    t = near * np.tan(np.radians(fov_y) / 2)
    r = aspect * t
    return -r, r, -t, t


def frustum_sides(fov_y, aspect, near):
    """the width is divided by the aspect instead of multiplied: aspect is width / height, so
    r = aspect t"""
    t = near * np.tan(fov_y / 2)
    r = t / aspect
    return -r, r, -t, t


def frustum_sides(fov_y, aspect, near):
    """fov_y is taken for the horizontal angle, and t = r / aspect: it is the angle from bottom to
    top, so t comes from it, and r = aspect t"""
    r = near * np.tan(fov_y / 2)
    t = r / aspect
    return -r, r, -t, t


def frustum_sides(fov_y, aspect, near):
    """near is left out: the tangent must be multiplied by it"""
    t = np.tan(fov_y / 2)
    r = aspect * t
    return -r, r, -t, t


def frustum(l, r, b, t, near, far):
    """alpha has the wrong sign, as if it were divided by far - near instead of near - far"""
    alpha = -(far + near) / (near - far)
    beta = 2 * far * near / (near - far)
    return np.array([[2 * near / (r - l), 0,                  (r + l) / (r - l), 0],
                     [0,                  2 * near / (t - b), (t + b) / (t - b), 0],
                     [0,                  0,                  alpha,             beta],
                     [0,                  0,                  -1,                0]])


def frustum(l, r, b, t, near, far):
    """alpha and beta both have the wrong sign: they are divided by far - near instead of
    near - far, so near and far are swapped in depth"""
    alpha = (far + near) / (far - near)
    beta = 2 * far * near / (far - near)
    return np.array([[2 * near / (r - l), 0,                  (r + l) / (r - l), 0],
                     [0,                  2 * near / (t - b), (t + b) / (t - b), 0],
                     [0,                  0,                  alpha,             beta],
                     [0,                  0,                  -1,                0]])


def frustum(l, r, b, t, near, far):
    """w is z, as for a camera that looks down +z; this one looks down -z, so the last row is
    (0, 0, -1, 0)"""
    alpha = (far + near) / (near - far)
    beta = 2 * far * near / (near - far)
    return np.array([[2 * near / (r - l), 0,                  (r + l) / (r - l), 0],
                     [0,                  2 * near / (t - b), (t + b) / (t - b), 0],
                     [0,                  0,                  alpha,             beta],
                     [0,                  0,                  1,                 0]])


def frustum(l, r, b, t, near, far):
    """depth runs from 0 to 1, as in Direct3D or Vulkan: near must come out at -1, not at 0"""
    return np.array([[2 * near / (r - l), 0,                  (r + l) / (r - l),  0],
                     [0,                  2 * near / (t - b), (t + b) / (t - b),  0],
                     [0,                  0,                  far / (near - far), 0],
                     [0,                  0,                  -1,                 0]]) + (
        np.outer([0, 0, far * near / (near - far), 0], [0, 0, 0, 1]))


def frustum(l, r, b, t, near, far):
    """the matrix is transposed, rows and columns are swapped, as in OpenGL's column-major order"""
    alpha = (far + near) / (near - far)
    beta = 2 * far * near / (near - far)
    return np.array([[2 * near / (r - l), 0,                  0,     0],
                     [0,                  2 * near / (t - b), 0,     0],
                     [(r + l) / (r - l),  (t + b) / (t - b),  alpha, -1],
                     [0,                  0,                  beta,  0]])


def frustum(l, r, b, t, near, far):
    """the off-centre terms (r + l) / (r - l) and (t + b) / (t - b) stand in the last column, as in
    an orthographic matrix; they belong in the third column, where z multiplies them"""
    alpha = (far + near) / (near - far)
    beta = 2 * far * near / (near - far)
    return np.array([[2 * near / (r - l), 0,                  0,     (r + l) / (r - l)],
                     [0,                  2 * near / (t - b), 0,     (t + b) / (t - b)],
                     [0,                  0,                  alpha, beta],
                     [0,                  0,                  -1,    0]])


def orthographic(l, r, b, t, near, far):
    """the box is moved sideways the wrong way: the translations of x and y have the wrong sign"""
    return np.array([[2 / (r - l), 0,           0,                (r + l) / (r - l)],
                     [0,           2 / (t - b), 0,                (t + b) / (t - b)],
                     [0,           0,           2 / (near - far), (far + near) / (near - far)],
                     [0,           0,           0,                1]])


def orthographic(l, r, b, t, near, far):
    """z is not flipped, the box is taken for z = near..far: the camera looks down -z, so it is
    z = -near..-far, and the scale of z is negative"""
    return np.array([[2 / (r - l), 0,           0,                -(r + l) / (r - l)],
                     [0,           2 / (t - b), 0,                -(t + b) / (t - b)],
                     [0,           0,           2 / (far - near), (far + near) / (near - far)],
                     [0,           0,           0,                1]])


def orthographic(l, r, b, t, near, far):
    """the centre is not shifted to 0: the translations of x and y are missing, as if the box were
    symmetric, l = -r and b = -t"""
    return np.array([[2 / (r - l), 0,           0,                0],
                     [0,           2 / (t - b), 0,                0],
                     [0,           0,           2 / (near - far), (far + near) / (near - far)],
                     [0,           0,           0,                1]])


def orthographic(l, r, b, t, near, far):
    """depth runs from 0 to 1, as in Direct3D or Vulkan: near must come out at -1, not at 0"""
    return np.array([[2 / (r - l), 0,           0,                -(r + l) / (r - l)],
                     [0,           2 / (t - b), 0,                -(t + b) / (t - b)],
                     [0,           0,           1 / (near - far), near / (near - far)],
                     [0,           0,           0,                1]])


def perspective_divide(clip):
    """the division is by z instead of by w"""
    return clip[..., :3] / clip[..., 2:3]


def perspective_divide(clip):
    """the sign of w is lost: the division is by its absolute value, so that points behind the
    camera are not mirrored"""
    return clip[..., :3] / np.abs(clip[..., 3:])


def perspective_divide(clip):
    """z is not divided by w, only x and y are"""
    return np.concatenate([clip[..., :2] / clip[..., 3:], clip[..., 2:3]], -1)


def perspective_divide(clip):
    """w of the first point divides all points: each one is divided by its own w"""
    return clip[..., :3] / clip.reshape(-1, 4)[0, 3]


def perspective_divide(clip):
    """it is multiplied by w instead of divided"""
    return clip[..., :3] * clip[..., 3:]


def perspective_divide(clip):
    """w is kept: ndc has three numbers, x, y and z, and no fourth one"""
    return clip / clip[..., 3:]


def perspective_divide_backward(grad_ndc, clip):
    """the gradient of w has the wrong sign: the derivative of x/w is -x/w^2, with a minus"""
    w = clip[..., 3:]
    grad_xyz = grad_ndc / w
    grad_w = (grad_xyz * clip[..., :3] / w).sum(-1, keepdims=True)
    return np.concatenate([grad_xyz, grad_w], -1)


def perspective_divide_backward(grad_ndc, clip):
    """the gradient of w is divided by w only once; it is divided by w squared, as the derivative of
    1/w is -1/w^2"""
    w = clip[..., 3:]
    grad_xyz = grad_ndc / w
    grad_w = -(grad_xyz * clip[..., :3]).sum(-1, keepdims=True)
    return np.concatenate([grad_xyz, grad_w], -1)


def perspective_divide_backward(grad_ndc, clip):
    """the gradient of w is missing or 0, as if w were a constant: but the divide depends on it"""
    w = clip[..., 3:]
    grad_xyz = grad_ndc / w
    grad_w = np.zeros(w.shape)
    return np.concatenate([grad_xyz, grad_w], -1)


def perspective_divide_backward(grad_ndc, clip):
    """z is left out of the gradient of w, which sums only x and y: all three add to it"""
    w = clip[..., 3:]
    grad_xyz = grad_ndc / w
    grad_w = -(grad_xyz * clip[..., :3] / w)[..., :2].sum(-1, keepdims=True)
    return np.concatenate([grad_xyz, grad_w], -1)


def perspective_divide_backward(grad_ndc, clip):
    """grad_ndc is multiplied by w instead of divided: the derivative of x/w by x is 1/w"""
    w = clip[..., 3:]
    grad_w = -(grad_ndc * clip[..., :3] / w ** 2).sum(-1, keepdims=True)
    return np.concatenate([grad_ndc * w, grad_w], -1)


def perspective_divide_backward(grad_ndc, clip):
    """the gradients of x, y and z are not divided by w: the derivative of x/w by x is 1/w"""
    w = clip[..., 3:]
    grad_w = -(grad_ndc * clip[..., :3] / w ** 2).sum(-1, keepdims=True)
    return np.concatenate([grad_ndc, grad_w], -1)


def viewport(width, height):
    """y points down, so that the picture is upside down: row 0 is at the bottom here, and the scale
    of y is positive"""
    return np.array([[width / 2, 0,          0, width / 2],
                     [0, -height / 2, 0, height / 2],
                     [0,         0,          1, 0],
                     [0,         0,          0, 1]])


def viewport(width, height):
    """everything is half a pixel off: the left border of the picture is x = 0, not -1/2"""
    return np.array([[width / 2, 0,          0, width / 2 - 0.5],
                     [0,         height / 2, 0, height / 2 - 0.5],
                     [0,         0,          1, 0],
                     [0,         0,          0, 1]])


def viewport(width, height):
    """ndc is taken as from 0 to 1; it is from -1 to 1"""
    return np.array([[width, 0,      0, 0],
                     [0,     height, 0, 0],
                     [0,     0,      1, 0],
                     [0,     0,      0, 1]])


def viewport(width, height):
    """ndc 1 comes out at width - 1 and height - 1, the last pixel, instead of at width and height,
    the border: one pixel less"""
    return np.array([[(width - 1) / 2, 0,                0, (width - 1) / 2],
                     [0,               (height - 1) / 2, 0, (height - 1) / 2],
                     [0,               0,                1, 0],
                     [0,               0,                0, 1]])


def to_screen_backward(grad_screen, width, height):
    """the gradient is divided by the scale; it must be multiplied by width / 2 and height / 2"""
    return grad_screen / np.diag(viewport(width, height))[:3]


def to_screen_backward(grad_screen, width, height):
    """width and height are swapped"""
    return grad_screen @ viewport(height, width)[:3, :3]


def to_screen_backward(grad_screen, width, height):
    """the scale is the whole width and height; ndc is 2 wide and high, so it is half of that"""
    return grad_screen * np.array([width, height, 1])


def to_screen_backward(grad_screen, width, height):
    """the gradient by y has the wrong sign, as if y pointed down: row 0 is at the bottom here"""
    return grad_screen * np.array([width / 2, -height / 2, 1])


def to_screen_backward(grad_screen, width, height):
    """to_screen itself is applied, with its constant offset: a constant has no gradient, and only
    the scale is left"""
    return to_screen(grad_screen, width, height)
