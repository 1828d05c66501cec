"""Mistakes of lab 1; each docstring goes on after "this is what comes out when"."""


def normal_matrix(matrix):
    """the cofactors are not divided by the determinant: the inverse is off by this factor"""
    return np.linalg.inv(matrix[:3, :3]).T * np.linalg.det(matrix[:3, :3])


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
    """the centre is not shifted to 0: the translations of x and y are missing, as if the box were
    symmetric, l = -r and b = -t"""
    return np.array([[2 / (r - l), 0,           0,                0],
                     [0,           2 / (t - b), 0,                0],
                     [0,           0,           2 / (near - far), (far + near) / (near - far)],
                     [0,           0,           0,                1]])


def perspective_divide(clip):
    """z is not divided by w, only x and y are"""
    return np.concatenate([clip[..., :2] / clip[..., 3:], clip[..., 2:3]], -1)


def viewport(width, height):
    """everything is half a pixel off: the left border of the picture is x = 0, not -1/2"""
    return np.array([[width / 2, 0,          0, width / 2 - 0.5],
                     [0,         height / 2, 0, height / 2 - 0.5],
                     [0,         0,          1, 0],
                     [0,         0,          0, 1]])


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
    """the gradient by y has the wrong sign, as if y pointed down: row 0 is at the bottom here"""
    return grad_screen * np.array([width / 2, -height / 2, 1])
