"""Wrong answers to transforms, written without a look at the checks."""


def transform(points, matrix):
    """the translation, the last column of the matrix, is left out

    told by: translation | last column | fourth column | does not move | offset & missing | not moved
    """
    moved = points[..., :3] @ matrix[:3, :3].T
    return np.concatenate([moved, points[..., 3:]], -1)


def transform(points, matrix):
    """the result is divided by w already, which is the job of the perspective divide

    told by: divid | perspective divide | w = 1 | w is 1 | w becomes 1 | homogeneous & normal
    """
    out = np.einsum("ij,...j->...i", matrix, points)
    return out / out[..., 3:]


def transform(points, matrix):
    """multiplies elementwise by the diagonal of the matrix, so every entry off the diagonal is lost

    told by: diagonal | elementwise | element by element | entry by entry | matrix product
    """
    result = np.zeros(points.shape)
    for i in range(4):
        result[..., i] = points[..., i] * matrix[i, i]
    return result


def transform(points, matrix):
    """the inverse of the matrix is applied, as if the matrix moved the axes and not the points

    told by: inverse | inverted | opposite direction | moves the axes | other way round | backwards
    """
    return points @ np.linalg.inv(matrix).T


def transform_backward(grad_output, points, matrix):
    """grad_points is multiplied by the transpose of the matrix, as in the forward pass

    told by: grad_points & transpos | matrix.T | forward matrix | grad_points & inverse direction | grad_output @ matrix
    """
    grad_points = grad_output @ matrix.T
    grad_matrix = np.einsum("ni,nj->ij", grad_output.reshape(-1, 4), points.reshape(-1, 4))
    return grad_points, grad_matrix


def transform_backward(grad_output, points, matrix):
    """grad_matrix comes out transposed: points times grad_output, not grad_output times points

    told by: grad_matrix & transpos | outer product & order | rows and columns & grad_matrix | factors & order | grad_matrix & swapped
    """
    g = grad_output.reshape(-1, 4)
    p = points.reshape(-1, 4)
    return grad_output @ matrix, p.T @ g


def transform_backward(grad_output, points, matrix):
    """grad_matrix is the mean over the points where it should be the sum

    told by: the mean | mean over | average | number of points | divided by n | not the sum
    """
    g = grad_output.reshape(-1, 4)
    p = points.reshape(-1, 4)
    grad_matrix = (g[:, :, None] * p[:, None, :]).mean(0)
    return grad_output @ matrix, grad_matrix


def transform_backward(grad_output, points, matrix):
    """only the last point's share of grad_matrix is kept, because = stands where += should

    told by: last point | overwrit | only one point | accumulat | one point's | not summed
    """
    g = grad_output.reshape(-1, 4)
    p = points.reshape(-1, 4)
    grad_points = np.zeros(g.shape)
    grad_matrix = np.zeros((4, 4))
    for n in range(len(g)):
        grad_points[n] = matrix.T @ g[n]
        grad_matrix = np.outer(g[n], p[n])
    return grad_points.reshape(grad_output.shape), grad_matrix


def transform_backward(grad_output, points, matrix):
    """the two gradients are returned in the wrong order, grad_matrix first

    told by: order & return | swapped | exchanged | wrong order | grad_matrix first | mixed up
    """
    grad_points = grad_output @ matrix
    grad_matrix = grad_output.reshape(-1, 4).T @ points.reshape(-1, 4)
    return grad_matrix, grad_points


def rotate(axis, angle):
    """turns the wrong way round: the sign of the cross product matrix is flipped

    told by: clockwise | -angle | opposite direction | wrong way | other way | sign
    """
    n = axis / np.linalg.norm(axis)
    x, y, z = n
    K = np.array([[0, z, -y], [-z, 0, x], [y, -x, 0]])
    m = np.eye(4)
    m[:3, :3] = np.cos(angle) * np.eye(3) + (1 - np.cos(angle)) * np.outer(n, n) + np.sin(angle) * K
    return m


def rotate(axis, angle):
    """the axis is not normalised to length 1

    told by: normali | unit length | unit vector | length of the axis | length 1 | axis & divided by its length
    """
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(4)
    matrix[:3, :3] = (np.cos(angle) * np.eye(3) + (1 - np.cos(angle)) * np.outer(axis, axis)
                      + np.sin(angle) * cross)
    return matrix


def rotate(axis, angle):
    """takes the angle in degrees

    told by: degree | radian | pi / 180 | 180 | deg2rad
    """
    theta = angle * np.pi / 180
    n = axis / np.sqrt((axis ** 2).sum())
    cross = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    matrix = np.eye(4)
    matrix[:3, :3] = (np.cos(theta) * np.eye(3) + (1 - np.cos(theta)) * np.outer(n, n)
                      + np.sin(theta) * cross)
    return matrix


def rotate(axis, angle):
    """n n^T is taken as the number n . n instead of the outer product

    told by: outer | n n^T | dot product | inner product | n . n | scalar product
    """
    n = axis / np.linalg.norm(axis)
    x, y, z = n
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    c, s = np.cos(angle), np.sin(angle)
    matrix = np.eye(4)
    matrix[:3, :3] = c * np.eye(3) + (1 - c) * (n @ n.T) + s * cross
    return matrix


def look_at(eye, target, up):
    """the third axis points forward, from the eye to the target, instead of back

    told by: forward | looks down +z | looks along +z | back & sign | back & opposite | target - eye
    """
    ahead = target - eye
    ahead = ahead / np.linalg.norm(ahead)
    side = np.cross(up, ahead)
    side = side / np.linalg.norm(side)
    above = np.cross(ahead, side)
    rotation = np.eye(4)
    rotation[:3, :3] = np.stack([side, above, ahead])
    return rotation @ translate(-eye)


def look_at(eye, target, up):
    """the axes stand in the columns of the rotation, not in its rows: it is world from camera

    told by: transpos | column | rows | world_from_view | inverse rotation | camera to world
    """
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross(up, back)
    right = right / np.linalg.norm(right)
    above = np.cross(back, right)
    rotation = np.eye(4)
    for k, ax in enumerate((right, above, back)):
        rotation[:3, k] = ax
    return rotation @ translate(-eye)


def look_at(eye, target, up):
    """right is not divided by its length, so the picture is squeezed where up is not at right angles to the view

    told by: normali | unit length | unit vector | right & length | length 1 | not of length
    """
    back = eye - target
    back = back / np.sqrt(back @ back)
    right = np.cross(up, back)
    above = np.cross(back, right)
    rotation = np.eye(4)
    rotation[:3, :3] = [right, above, back]
    return rotation @ translate(-eye)


def look_at(eye, target, up):
    """up itself is taken as the camera's second axis, without making it perpendicular to back

    told by: perpendicular | orthogonal | right angle | up itself | above & up | above = back
    """
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross(up, back)
    right = right / np.linalg.norm(right)
    rotation = np.eye(4)
    rotation[:3, :3] = np.stack([right, up / np.linalg.norm(up), back])
    return rotation @ translate(-eye)


def normal_matrix(matrix):
    """normals are moved by the same matrix as the points, without the inverse transpose

    told by: same matrix | inverse | like the points | as the points | A itself | like points
    """
    return matrix[:3, :3].copy()


def pinhole(f):
    """the third row has 1 where f should stand, so z comes out as 1 after the divide and not as f

    told by: third row | third component | z after the divide | z comes out | matrix[2, 2] | third coordinate
    """
    m = np.diag([f, f, 1.0, 0.0])
    m[3, 2] = 1
    return m


def pinhole(f):
    """w is -z, as for a camera that looks down -z

    told by: -z | minus z | sign & w | looks down | -1 & last row | opengl
    """
    return np.array([[f, 0, 0, 0],
                     [0, f, 0, 0],
                     [0, 0, f, 0],
                     [0, 0, -1.0, 0]])


def frustum_sides(fov_y, aspect, near):
    """the tangent is of the whole angle of view, not of half of it

    told by: half | fov_y / 2 | whole angle | full angle | twice the angle | / 2
    """
    top = near * np.tan(fov_y)
    right = top * aspect
    return -right, right, -top, top


def frustum_sides(fov_y, aspect, near):
    """fov_y is used as the horizontal angle: r comes from the angle, and t is r / aspect

    told by: horizontal | aspect & divi | fov_x | inverse of the aspect | aspect & wrong side
    """
    r = near * np.tan(fov_y / 2)
    t = r / aspect
    return -r, r, -t, t


def frustum(l, r, b, t, near, far):
    """depth runs from 0 to 1, as in Direct3D, instead of from -1 to 1

    told by: 0 to 1 | [0, 1] | direct3d | vulkan | near & comes out at 0 | near plane & maps to 0
    """
    return np.array([[2 * near / (r - l), 0, (r + l) / (r - l), 0],
                     [0, 2 * near / (t - b), (t + b) / (t - b), 0],
                     [0, 0, far / (near - far), far * near / (near - far)],
                     [0, 0, -1, 0]])


def frustum(l, r, b, t, near, far):
    """the matrix is transposed, in OpenGL's column-major memory order

    told by: transpos | column-major | row-major | rows and columns | row vectors | columns and rows
    """
    P = np.zeros((4, 4))
    P[0, 0] = 2 * near / (r - l)
    P[1, 1] = 2 * near / (t - b)
    P[2, 0] = (r + l) / (r - l)
    P[2, 1] = (t + b) / (t - b)
    P[2, 2] = (far + near) / (near - far)
    P[2, 3] = -1
    P[3, 2] = 2 * far * near / (near - far)
    return P


def frustum(l, r, b, t, near, far):
    """the factor 2 of beta is forgotten

    told by: beta & half | beta & factor | beta & twice | beta & 2 | [2, 3] & half | [2, 3] & twice
    """
    alpha = (far + near) / (near - far)
    beta = far * near / (near - far)
    return np.array([[2 * near / (r - l), 0, (r + l) / (r - l), 0],
                     [0, 2 * near / (t - b), (t + b) / (t - b), 0],
                     [0, 0, alpha, beta],
                     [0, 0, -1, 0]])


def frustum(l, r, b, t, near, far):
    """alpha and beta are divided by far - near, so depth has the wrong sign

    told by: far - near | near - far | alpha & sign | depth & sign | near and far & exchanged | near and far & swapped
    """
    depth = far - near
    P = np.zeros((4, 4))
    P[0] = [2 * near / (r - l), 0, (r + l) / (r - l), 0]
    P[1] = [0, 2 * near / (t - b), (t + b) / (t - b), 0]
    P[2] = [0, 0, (far + near) / depth, 2 * far * near / depth]
    P[3, 2] = -1
    return P


def frustum(l, r, b, t, near, far):
    """the off-centre terms (r+l)/(r-l) and (t+b)/(t-b) stand in the last column, as in the orthographic matrix

    told by: last column | fourth column | third column | orthographic | off-centre & column | [0, 3]
    """
    return np.array([[2 * near / (r - l), 0, 0, (r + l) / (r - l)],
                     [0, 2 * near / (t - b), 0, (t + b) / (t - b)],
                     [0, 0, (far + near) / (near - far), 2 * far * near / (near - far)],
                     [0, 0, -1, 0]])


def orthographic(l, r, b, t, near, far):
    """z is not flipped: the box is taken as z = near..far and not -near..-far

    told by: sign of z | z is flipped | z-axis | -near | looks down +z | depth & reversed
    """
    return np.array([[2 / (r - l), 0, 0, -(r + l) / (r - l)],
                     [0, 2 / (t - b), 0, -(t + b) / (t - b)],
                     [0, 0, 2 / (far - near), -(far + near) / (far - near)],
                     [0, 0, 0, 1]])


def orthographic(l, r, b, t, near, far):
    """the shift to the centre is left out: the matrix only scales x and y, as if l = -r and b = -t

    told by: l = -r | centre | center | translation | shift | symmetric
    """
    m = np.eye(4)
    m[0, 0] = 2 / (r - l)
    m[1, 1] = 2 / (t - b)
    m[2, 2] = 2 / (near - far)
    m[2, 3] = (near + far) / (near - far)
    return m


def perspective_divide(clip):
    """the divide is by z instead of w

    told by: by z instead | by z, | z, not w | z instead of w | w and z | z and w
    """
    return clip[..., :3] / clip[..., 2:3]


def perspective_divide(clip):
    """divides by the magnitude of w, so points behind the camera are not mirrored (fine print)

    told by: absolute | np.abs | magnitude | negative w | behind the camera | sign of w
    """
    w = np.abs(clip[..., 3])
    return np.stack([clip[..., k] / w for k in range(3)], -1)


def perspective_divide(clip):
    """w of the first point divides all points

    told by: first point | first row | w of the first | w of point 0 | its own w
    """
    flat = clip.reshape(-1, 4)
    ndc = flat[:, :3] / flat[0, 3]
    return ndc.reshape(*clip.shape[:-1], 3)


def perspective_divide_backward(grad_ndc, clip):
    """the gradient of w is left at 0, as if w were a constant

    told by: w as a constant | w were a constant | w is constant | of w & 0 | of w & missing | quotient rule
    """
    grad = np.zeros(clip.shape)
    grad[..., :3] = grad_ndc / clip[..., 3:]
    return grad


def perspective_divide_backward(grad_ndc, clip):
    """the gradient of w has the wrong sign

    told by: of w & sign | grad_w & sign | of w & minus | of w & negat | w's & sign | w component & sign
    """
    w = clip[..., 3]
    gx, gy, gz = np.moveaxis(grad_ndc, -1, 0)
    x, y, z = np.moveaxis(clip[..., :3], -1, 0)
    return np.stack([gx / w, gy / w, gz / w, (gx * x + gy * y + gz * z) / w ** 2], -1)


def perspective_divide_backward(grad_ndc, clip):
    """the gradient of w is divided by w only once, not by w squared

    told by: w^2 | w**2 | squared | square of w | by w once | by w only once
    """
    w = clip[..., 3:]
    grad_w = -(grad_ndc * clip[..., :3]).sum(-1, keepdims=True) / w
    return np.concatenate([grad_ndc / w, grad_w], -1)


def perspective_divide_backward(grad_ndc, clip):
    """z adds nothing to the gradient of w: only x and y are summed

    told by: only x and y | share of z | z's share | all three | z is missing | z is left out
    """
    w = clip[..., 3]
    grad = np.empty(clip.shape)
    for k in range(3):
        grad[..., k] = grad_ndc[..., k] / w
    grad[..., 3] = -(grad_ndc[..., 0] * clip[..., 0] + grad_ndc[..., 1] * clip[..., 1]) / w**2
    return grad


def perspective_divide_backward(grad_ndc, clip):
    """grad_ndc is multiplied by w for x, y and z instead of divided

    told by: multipli | times w | 1/w | 1 / w | divided by w | instead of divid
    """
    w = clip[..., 3:]
    grad_w = -(grad_ndc * clip[..., :3] / w ** 2).sum(-1, keepdims=True)
    return np.concatenate([grad_ndc * w, grad_w], -1)


def viewport(width, height):
    """y points down: ndc y = 1 comes out at row 0, as in images

    told by: y down | points down | upside down | y is flipped | sign of y | y axis
    """
    return np.array([[width / 2, 0, 0, width / 2],
                     [0, -height / 2, 0, height / 2],
                     [0, 0, 1.0, 0],
                     [0, 0, 0, 1.0]])


def viewport(width, height):
    """maps to 0 .. width - 1 and 0 .. height - 1 instead of to width and height

    told by: width - 1 | one pixel | off by one | - 1 | height - 1 | last pixel
    """
    m = np.eye(4)
    m[0, 0] = m[0, 3] = (width - 1) / 2
    m[1, 1] = m[1, 3] = (height - 1) / 2
    return m


def to_screen_backward(grad_screen, width, height):
    """divides by width / 2 and height / 2 where the gradient is multiplied by them

    told by: divid | multipli | inverse | 2 / width
    """
    return grad_screen / np.array([width / 2, height / 2, 1.0])
