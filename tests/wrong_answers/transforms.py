"""Wrong answers to transforms, written without a look at the checks."""


def transform(points, matrix):
    """the points are multiplied as rows, points @ matrix, without the transpose of the matrix

    told by: transpose | .T | row vector | rows & column | from the left | points @ matrix | columns & instead
    """
    moved = points @ matrix
    return moved


def transform(points, matrix):
    """the result is left as columns, matrix @ points.T, and is not turned back into rows

    told by: transpose | shape | back & row | columns & row | (4, | last axis
    """
    return matrix @ points.T


def transform(points, matrix):
    """the result is already divided by w, but this is only the product with the matrix

    told by: divid & w | homogeneous & divid | perspective divide | w is 1 | w = 1 | by w | w & always 1
    """
    out = np.einsum("ij,...j->...i", matrix, points)
    return out / out[..., 3:4]


def transform_backward(grad_output, points, matrix):
    """grad_points is multiplied by the transposed matrix, as in the forward pass

    told by: grad_points & transpose | grad_points & .T | transposed & matrix & points | grad_output @ matrix | forward & matrix.T | without & transpos
    """
    d_points = grad_output @ matrix.T
    d_matrix = np.einsum("ni,nj->ij", grad_output.reshape(-1, 4), points.reshape(-1, 4))
    return d_points, d_matrix


def transform_backward(grad_output, points, matrix):
    """grad_matrix comes out transposed: points times grad_output instead of grad_output times points

    told by: grad_matrix & transpose | grad_matrix & .T | rows and columns | row & column & grad_matrix | grad_matrix & exchanged | grad_matrix & swapped | outer product & order
    """
    d_matrix = np.zeros((4, 4))
    for g, v in zip(grad_output.reshape(-1, 4), points.reshape(-1, 4)):
        d_matrix += np.outer(v, g)
    return grad_output @ matrix, d_matrix


def transform_backward(grad_output, points, matrix):
    """grad_matrix is the mean over the points, but each point adds to it

    told by: mean | average | number of points | sum & points | add & points | divided & count | divid & points
    """
    flat_g, flat_p = grad_output.reshape(-1, 4), points.reshape(-1, 4)
    d_matrix = (flat_g[:, :, None] * flat_p[:, None, :]).mean(0)
    return grad_output @ matrix, d_matrix


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


def rotate(axis, angle):
    """the cross product matrix is transposed, so it turns the other way round

    told by: other way | opposite & direction | clockwise | sign & sin | -angle | transpose | v x n
    """
    unit = axis / np.linalg.norm(axis)
    cross = np.cross(unit, np.eye(3))
    result = np.eye(4)
    result[:3, :3] = (np.cos(angle) * np.eye(3) + (1 - np.cos(angle)) * unit[:, None] * unit
                      + np.sin(angle) * cross)
    return result


def rotate(axis, angle):
    """n n^T is taken element by element (n * n on the diagonal) instead of as the outer product

    told by: outer | n n^T | diagonal & n | element | off-diagonal | off the diagonal | n * n
    """
    n = axis / np.sqrt((axis * axis).sum())
    cos, sin = np.cos(angle), np.sin(angle)
    skew = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    r = np.eye(4)
    for k in range(3):
        r[k, k] = cos + (1 - cos) * n[k] * n[k]
    r[:3, :3] += sin * skew
    return r


def look_at(eye, target, up):
    """the rotation and the translation are applied in the wrong order: the eye moves after the turn

    told by: order | rotat & before & translat | translat & first | translat & after | translat & rotat | last column & rotat | T(-eye) & right
    """
    forward_axis = (eye - target) / np.linalg.norm(eye - target)
    side = np.cross(up, forward_axis)
    side = side / np.linalg.norm(side)
    turn = np.eye(4)
    for row, axis in enumerate((side, np.cross(forward_axis, side), forward_axis)):
        turn[row, :3] = axis
    return translate(-eye) @ turn


def look_at(eye, target, up):
    """up itself is used as the camera's second axis instead of above = back x right

    told by: above | up & instead | up & perpendicular | up & right angle | up & itself | orthogonal | back x right
    """
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    camera = np.eye(4)
    camera[0, :3], camera[1, :3], camera[2, :3] = right, up / np.linalg.norm(up), back
    return camera @ translate(-eye)


def look_at(eye, target, up):
    """back points from the eye to the target, target - eye, so the camera looks the other way

    told by: target - eye | eye - target | back & opposite | back & sign | looks & away | behind | other way
    """
    z_axis = target - eye
    z_axis = z_axis / np.linalg.norm(z_axis)
    x_axis = np.cross(up, z_axis)
    x_axis = x_axis / np.linalg.norm(x_axis)
    y_axis = np.cross(z_axis, x_axis)
    view = np.eye(4)
    view[:3, :3] = [x_axis, y_axis, z_axis]
    return view @ translate(-eye)


def normal_matrix(matrix):
    """the inverse is not transposed

    told by: transpose | .T | inverse & transpos | N^T | row & column
    """
    return np.linalg.inv(matrix[:3, :3])


def pinhole(f):
    """w is -z as in OpenGL, but this camera looks down +z

    told by: -z | sign & w | +z | negative & w | last row | opengl | mirror
    """
    m = np.diag([f, f, f, 0.0])
    m[3, 2] = -1.0
    return m


def frustum_sides(fov_y, aspect, near):
    """r is t divided by the aspect, not multiplied by it

    told by: aspect & divi | aspect & multipl | t / aspect | aspect t | height / width | 1 / aspect | inverse & aspect
    """
    top = np.tan(fov_y / 2) * near
    right = top / aspect
    return -right, right, -top, top


def frustum(l, r, b, t, near, far):
    """depth is mapped to 0..1 as in Direct3D, not to -1..1

    told by: direct3d | 0 to 1 | 0..1 | [0, 1] | near & -1 | -1 to 1 | alpha and beta
    """
    m = np.zeros((4, 4))
    m[0, 0] = 2 * near / (r - l)
    m[1, 1] = 2 * near / (t - b)
    m[0, 2], m[1, 2] = (r + l) / (r - l), (t + b) / (t - b)
    m[2, 2] = far / (near - far)
    m[2, 3] = near * far / (near - far)
    m[3, 2] = -1
    return m


def frustum(l, r, b, t, near, far):
    """(r+l)/(r-l) and (t+b)/(t-b) stand in the fourth column, not in the third

    told by: third column | fourth column | last column | column 2 | column 3 | r + l & column | asymmetric & column
    """
    wide, high, deep = r - l, t - b, near - far
    return np.array([[2 * near / wide, 0, 0, (r + l) / wide],
                     [0, 2 * near / high, 0, (t + b) / high],
                     [0, 0, (far + near) / deep, 2 * far * near / deep],
                     [0, 0, -1.0, 0]])


def frustum(l, r, b, t, near, far):
    """the last row has +1 instead of -1, so w is z and not -z

    told by: last row | fourth row | sign & w | -z | +1 & -1 | w is z | negative & w
    """
    p = np.zeros((4, 4))
    p[0] = 2 * near / (r - l), 0, (r + l) / (r - l), 0
    p[1] = 0, 2 * near / (t - b), (t + b) / (t - b), 0
    p[2, 2:] = (far + near) / (near - far), 2 * far * near / (near - far)
    p[3, 2] = 1
    return p


def orthographic(l, r, b, t, near, far):
    """z is scaled by 2 / (far - near), as if the box lay at z = near..far in front along +z

    told by: sign & z | -near | far - near | near - far | +z | flip & z | z & negative
    """
    shift = -np.array([(r + l) / (r - l), (t + b) / (t - b), (far + near) / (far - near)])
    box = np.diag([2 / (r - l), 2 / (t - b), 2 / (far - near), 1.0])
    box[:3, 3] = shift
    return box


def perspective_divide(clip):
    """the divide is by z instead of w

    told by: by z | z, not w | z instead of w | divi & w & z | third & fourth | not by w
    """
    return clip[..., :3] / clip[..., 2:3]


def perspective_divide(clip):
    """w has lost its last axis (clip[..., 3] instead of clip[..., 3:]), so it does not broadcast against many points

    told by: broadcast | 3: | 3:4 | axis & w | keepdims | shape & w | single point
    """
    xyz, w = clip[..., :3], clip[..., 3]
    return xyz / w


def perspective_divide_backward(grad_ndc, clip):
    """the gradient of w has the wrong sign, it lacks the minus of d(1/w) = -dw/w^2

    told by: sign & w | minus | negative & w | -x/w | opposite & w | -dw
    """
    inverse = 1 / clip[..., 3:]
    d_w = (grad_ndc * clip[..., :3]).sum(-1) * inverse[..., 0] ** 2
    return np.concatenate([grad_ndc * inverse, d_w[..., None]], -1)


def perspective_divide_backward(grad_ndc, clip):
    """z adds nothing to the gradient of w, only x and y do

    told by: only x and y | z & gradient of w | z & grad_w | z & adds to & w | all three | z & missing | z & forgot
    """
    out = np.zeros(clip.shape)
    w = clip[..., 3]
    for k in range(3):
        out[..., k] = grad_ndc[..., k] / w
    for k in range(2):
        out[..., 3] -= grad_ndc[..., k] * clip[..., k] / w**2
    return out


def perspective_divide_backward(grad_ndc, clip):
    """the gradient of w is divided by w once instead of by w squared

    told by: w squared | w^2 | w**2 | divi & w & once | divi & w & twice | w w | factor & w
    """
    x_y_z, w = clip[..., :3], clip[..., 3:]
    d_w = -np.sum(grad_ndc * x_y_z, axis=-1, keepdims=True) / w
    return np.concatenate([grad_ndc / w, d_w], axis=-1)


def viewport(width, height):
    """y goes down: ndc y = 1 lands at 0 and -1 at height

    told by: upside down | y & down | y & flip | y & up | bottom | top | sign & y
    """
    return np.array([[width / 2, 0, 0, width / 2],
                     [0, -height / 2, 0, height / 2],
                     [0, 0, 1.0, 0],
                     [0, 0, 0, 1.0]])


def to_screen_backward(grad_screen, width, height):
    """the gradient is multiplied by width and height instead of by their halves

    told by: half | halves | halved | / 2 | twice | factor & 2 | two times
    """
    return grad_screen * np.array([width, height, 1.0])


def transform(points, matrix):
    """only the upper left 3 x 3 is applied, so the translation in the last column is lost

    told by: translation | last column | 3 x 3 | 3x3 | fourth column | offset & lost | not moved by
    """
    moved = points.copy()
    moved[..., :3] = points[..., :3] @ matrix[:3, :3].T
    return moved


def transform(points, matrix):
    """the result is divided by its w already, which is the job of the perspective divide

    told by: divided by w | divides by w | divide by w | divide & w | division by w | homogeneous & divi | w & is 1
    """
    out = points @ matrix.T
    return out / out[..., 3:]


def transform_backward(grad_output, points, matrix):
    """grad_matrix is transposed: row and column of each entry are exchanged

    told by: grad_matrix & transpos | rows and columns | row & column & exchanged | row & column & swapped | outer product & order | grad_matrix.T
    """
    gm = np.zeros((4, 4))
    for g, p in zip(grad_output.reshape(-1, 4), points.reshape(-1, 4)):
        gm += np.outer(p, g)
    return grad_output @ matrix, gm


def transform_backward(grad_output, points, matrix):
    """grad_matrix is the mean over the points instead of their sum

    told by: the mean | a mean | averag | number of points | divided by n | not summed | instead of & sum
    """
    per_point = grad_output.reshape(-1, 4)[:, :, None] * points.reshape(-1, 4)[:, None, :]
    return grad_output @ matrix, per_point.mean(0)


def rotate(axis, angle):
    """n * n is multiplied entry by entry and broadcast over the rows, instead of the outer product

    told by: outer | n * n | n n^t | elementwise | entry by entry | broadcast
    """
    u = axis / np.linalg.norm(axis)
    c, s = np.cos(angle), np.sin(angle)
    k = np.array([[0, -u[2], u[1]], [u[2], 0, -u[0]], [-u[1], u[0], 0]])
    out = np.eye(4)
    out[:3, :3] = c * np.eye(3) + (1 - c) * (u * u) + s * k
    return out


def rotate(axis, angle):
    """1 in 1 - cos is forgotten: the outer product is scaled by cos instead of 1 - cos

    told by: 1 - cos | one minus | outer & factor | outer & cos | n n^t & cos
    """
    u = axis / np.linalg.norm(axis)
    c, s = np.cos(angle), np.sin(angle)
    out = np.eye(4)
    for i in range(3):
        e = np.eye(3)[i]
        out[:3, i] = c * e + c * u * u[i] + s * np.cross(u, e)
    return out


def look_at(eye, target, up):
    """-eye is written in the last column without turning it by the rotation first

    told by: last column | -eye | rotat & eye | translation & rotat | translat & order | translat & first
    """
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross(up, back)
    right = right / np.linalg.norm(right)
    view = np.eye(4)
    view[:3, :3] = [right, np.cross(back, right), back]
    view[:3, 3] = -eye
    return view


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


def frustum(l, r, b, t, near, far):
    """the depth goes from 0 to 1, as in Direct3D and Vulkan, instead of from -1 to 1

    told by: direct3d | vulkan | 0 to 1 | 0 ... 1 | [0, 1] | near & ndc 0 | near & to 0
    """
    return np.array([[2 * near / (r - l), 0, (r + l) / (r - l), 0],
                     [0, 2 * near / (t - b), (t + b) / (t - b), 0],
                     [0, 0, far / (near - far), far * near / (near - far)],
                     [0, 0, -1.0, 0]])


def perspective_divide(clip):
    """the division is done in place and changes the caller's clip

    told by: in place | in-place | changes & input | changes & clip | modif | overwr | copy
    """
    ndc = clip[..., :3]
    ndc /= clip[..., 3:]
    return ndc


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


def perspective_divide_backward(grad_ndc, clip):
    """the gradient of w has no part from z, only those from x and y

    told by: from z | z & missing | z & left out | z & add | only x and y | x and y only | z & contribut | z & share | all three
    """
    w = clip[..., 3:]
    grad_w = -(grad_ndc[..., :2] * clip[..., :2]).sum(-1, keepdims=True) / w**2
    return np.concatenate([grad_ndc / w, grad_w], -1)


def frustum_sides(fov_y, aspect, near):
    """fov_y is taken as the horizontal angle from left to right: r comes from it, and t is r / aspect

    told by: horizontal | left to right | fov_x | r / aspect | divided by & aspect | aspect & t | top & aspect | bottom to top
    """
    half = near * np.tan(fov_y / 2)
    return -half, half, -half / aspect, half / aspect


def orthographic(l, r, b, t, near, far):
    """z has the wrong sign: the camera looks down +z, as if the box were z = near..far

    told by: +z | sign & z | z & sign | z & mirrored | z & flipped | sign of & depth | far - near | -near
    """
    m = np.diag([2 / (r - l), 2 / (t - b), 2 / (far - near), 1.0])
    m[:3, 3] = -(r + l) / (r - l), -(t + b) / (t - b), -(far + near) / (far - near)
    return m


def to_screen_backward(grad_screen, width, height):
    """the gradient is divided by width / 2 and height / 2 instead of multiplied: the inverse, not the transpose

    told by: divided | divides | divid | inverse | multipl | 2 / width | reciprocal
    """
    return grad_screen / np.array([width / 2, height / 2, 1.0])
