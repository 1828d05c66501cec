"""Mistakes of lab 7; each docstring goes on after "this is what comes out when"."""


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
    """the sum of dc is taken for a constant: its share, -grad_db . b, is left out of grad_dc"""
    grad_dc = grad_db / s
    through_b = -dc.sum(0) / s * normalize_backward(grad_db, b, s)
    return grad_dc, through_b - (grad_db * normalize_derivative(dc, b, s)).sum(0) / s


def depth_planes(z, corners):
    """the determinant's sign is lost: that of clockwise faces is negative"""
    e = edge_normals(corners)
    det = (e[0] * corners[:, 0]).sum(0)
    return (z[:, None] * e).sum(0) / np.abs(det)


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
