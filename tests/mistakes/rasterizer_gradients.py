"""Mistakes of lab 7; each docstring goes on after "this is what comes out when"."""


def edge_normals(corners):
    """the cross products are in reverse order, q_j x q_i: all signs are flipped"""
    return np.stack([cross(corners[:, j], corners[:, i]) for i, j in EDGES])


def edge_normals(corners):
    """rows and columns are swapped: the corners are the columns of M, corners[:, k], and edge k is
    row k of the result; one of the two is transposed"""
    return np.stack([cross(corners[i], corners[j]) for i, j in EDGES])


def edge_normals(corners):
    """edge k starts at vertex k; it is the one opposite to vertex k"""
    return np.stack([cross(corners[:, i], corners[:, j]) for i, j in EDGES[2:] + EDGES[:2]])


def edge_normals(corners):
    """it is the inverse M^-1 itself: the factor det(M), the determinant, is missing"""
    return np.linalg.inv(corners)


def edge_normals(corners):
    """edge 1 has the other sign, it is q_0 x q_2; in cyclic order it is q_2 x q_0"""
    return np.stack([cross(corners[:, i], corners[:, j]) for i, j in [(1, 2), (0, 2), (0, 1)]])


def edge_functions_at_backward(grad_e, x, y):
    """a corner has the gradient of one of its two edges alone: each e_k gives one to its first
    corner, i, and none to its second, j"""
    grad_x, grad_y = np.zeros(x.shape), np.zeros(y.shape)
    for g, (i, j) in zip(grad_e, EDGES, strict=True):
        grad_x[i] += g * y[j]
        grad_y[i] -= g * x[j]
    return grad_x, grad_y


def edge_functions_at_backward(grad_e, x, y):
    """the second edge's gradient replaces the first one's, by = for +=; they add up, as each corner
    is in two edges"""
    grad_x, grad_y = np.zeros(x.shape), np.zeros(y.shape)
    for g, (i, j) in zip(grad_e, EDGES, strict=True):
        grad_x[i], grad_y[i] = g * y[j], -g * x[j]
        grad_x[j], grad_y[j] = -g * y[i], g * x[i]
    return grad_x, grad_y


def edge_functions_at_backward(grad_e, x, y):
    """all signs are flipped: it is the backward pass of y_i x_j - x_i y_j"""
    grad_x, grad_y = np.zeros(x.shape), np.zeros(y.shape)
    for g, (i, j) in zip(grad_e, EDGES, strict=True):
        grad_x[i] -= g * y[j]
        grad_y[i] += g * x[j]
        grad_x[j] += g * y[i]
        grad_y[j] -= g * x[i]
    return grad_x, grad_y


def edge_functions_at_backward(grad_e, x, y):
    """x and y are exchanged: grad_x holds x, and grad_y holds y; the derivative of x_i y_j with
    respect to x_i is y_j"""
    grad_x, grad_y = np.zeros(x.shape), np.zeros(y.shape)
    for g, (i, j) in zip(grad_e, EDGES, strict=True):
        grad_x[i] += g * x[j]
        grad_y[i] -= g * y[j]
        grad_x[j] -= g * x[i]
        grad_y[j] += g * y[i]
    return grad_x, grad_y


def edge_functions_at_backward(grad_e, x, y):
    """edge k starts at corner k; it is the one opposite to corner k"""
    grad_x, grad_y = np.zeros(x.shape), np.zeros(y.shape)
    for g, (i, j) in zip(grad_e, EDGES[2:] + EDGES[:2], strict=True):
        grad_x[i] += g * y[j]
        grad_y[i] -= g * x[j]
        grad_x[j] -= g * y[i]
        grad_y[j] += g * x[i]
    return grad_x, grad_y


def normalize_derivative_backward(grad_db, dc, b, s):
    """the change of s is left out of grad_c: only the way through b = c / s is there, but s = sum c
    depends on c, too"""
    grad_dc = normalize_backward(grad_db, b, s)
    return grad_dc, -dc.sum(0) * grad_dc / s


def normalize_derivative_backward(grad_db, dc, b, s):
    """the change of b is left out of grad_c: only s is taken as a function of c, and b = c / s as a
    constant"""
    grad_dc = normalize_backward(grad_db, b, s)
    through_s = (grad_db * normalize_derivative(dc, b, s)).sum(0)
    return grad_dc, np.tile(-through_s / s, (3, 1))


def normalize_derivative_backward(grad_db, dc, b, s):
    """grad_c is zero: c counts as a constant, but it is in b and in s"""
    grad_dc = normalize_backward(grad_db, b, s)
    return grad_dc, np.zeros(dc.shape)


def normalize_derivative_backward(grad_db, dc, b, s):
    """the sum of dc is taken for a constant: its share, -grad_db . b, is left out of grad_dc"""
    grad_dc = grad_db / s
    through_b = -dc.sum(0) / s * normalize_backward(grad_db, b, s)
    return grad_dc, through_b - (grad_db * normalize_derivative(dc, b, s)).sum(0) / s


def depth_planes(z, corners):
    """the planes are not divided by the determinant"""
    e = edge_normals(corners)
    return (z[:, None] * e).sum(0)


def depth_planes(z, corners):
    """M is transposed, it is M^-1 z and not M^-T z: the sum goes over the corners, the first axis
    of M^-1"""
    e = edge_normals(corners)
    det = (e[0] * corners[:, 0]).sum(0)
    return (z * e).sum(1) / det


def depth_planes(z, corners):
    """the determinant's sign is lost: that of clockwise faces is negative"""
    e = edge_normals(corners)
    det = (e[0] * corners[:, 0]).sum(0)
    return (z[:, None] * e).sum(0) / np.abs(det)


def depth_planes(z, corners):
    """z is divided by w at the corners; it stays as it is in clip space"""
    return ((z / corners[2])[:, None] * inverses(corners)).sum(0)


def depth_planes_backward(grad_planes, z, corners):
    """the minus sign of grad_corners is missing: a vertex drags the picture along, against its
    slope"""
    e = edge_normals(corners)
    det = (e[0] * corners[:, 0]).sum(0)
    grad_z = (e * grad_planes).sum(1) / det
    return grad_z, depth_planes(z, corners)[:, None] * grad_z


def depth_planes_backward(grad_planes, z, corners):
    """M is transposed, grad_z sums over the wrong axis of M^-1: it is M^-T grad_planes, and not
    M^-1 grad_planes"""
    e = edge_normals(corners)
    det = (e[0] * corners[:, 0]).sum(0)
    grad_z = (e * grad_planes[:, None]).sum(0) / det
    return grad_z, -depth_planes(z, corners)[:, None] * grad_z


def depth_planes_backward(grad_planes, z, corners):
    """the weights grad_z are not divided by the determinant"""
    e = edge_normals(corners)
    grad_z = (e * grad_planes).sum(1)
    return grad_z, -depth_planes(z, corners)[:, None] * grad_z


def depth_planes_backward(grad_planes, z, corners):
    """z takes the place of the planes in grad_corners: a factor M^-T is left out"""
    grad_z = (inverses(corners) * grad_planes).sum(1)
    return grad_z, -z[:, None] * grad_z
