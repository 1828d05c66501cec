"""Mistakes of lab 7; each docstring goes on after "this is what comes out when"."""


def edge_functions(corners):
    """the two corners are swapped: every edge runs the other way"""
    return np.stack([cross(corners[:, j], corners[:, i]) for i, j in EDGES])


def edge_functions(corners):
    """the result is transposed: corners are columns of M, edges are rows"""
    return np.stack([cross(corners[i], corners[j]) for i, j in EDGES])


def edge_functions(corners):
    """row k is the edge that starts at vertex k; it is the one opposite to it"""
    return np.stack([cross(corners[:, i], corners[:, j]) for i, j in EDGES[1:] + EDGES[:1]])


def edge_functions_backward(grad_edges, corners):
    """a corner has the gradient of one of its two edges alone"""
    grad_corners = np.zeros(np.shape(corners))
    for g, (i, j) in zip(grad_edges, EDGES, strict=True):
        grad_corners[:, i] += cross(corners[:, j], g)
    return grad_corners


def edge_functions_backward(grad_edges, corners):
    """the second edge's gradient replaces the first one's; they add up"""
    grad_corners = np.zeros(np.shape(corners))
    for g, (i, j) in zip(grad_edges, EDGES, strict=True):
        grad_corners[:, i] = cross(corners[:, j], g)
        grad_corners[:, j] = cross(g, corners[:, i])
    return grad_corners


def edge_functions_backward(grad_edges, corners):
    """all signs are flipped: p x q = -q x p"""
    grad_corners = np.zeros(np.shape(corners))
    for g, (i, j) in zip(grad_edges, EDGES, strict=True):
        grad_corners[:, i] += cross(g, corners[:, j])
        grad_corners[:, j] += cross(corners[:, i], g)
    return grad_corners


def normalize_derivative_backward(grad_db, dc, b, s):
    """the way through s is left out"""
    grad_dc = normalize_backward(grad_db, b, s)
    return grad_dc, -dc.sum(0) * grad_dc / s


def normalize_derivative_backward(grad_db, dc, b, s):
    """c counts as a constant, but it is in b and in s"""
    grad_dc = normalize_backward(grad_db, b, s)
    return grad_dc, np.zeros(dc.shape)


def normalize_derivative_backward(grad_db, dc, b, s):
    """the gradient of c has the wrong sign"""
    grad_dc = normalize_backward(grad_db, b, s)
    through_s = (grad_db * normalize_derivative(dc, b, s)).sum(0)
    return grad_dc, (dc.sum(0) * grad_dc + through_s) / s


def depth_planes(z, corners):
    """the planes are not divided by the determinant"""
    e = edge_functions(corners)
    return (z[:, None] * e).sum(0)


def depth_planes(z, corners):
    """M is transposed: its columns are the corners"""
    e = edge_functions(corners)
    det = (e[0] * corners[:, 0]).sum(0)
    return (z * e).sum(1) / det


def depth_planes(z, corners):
    """the determinant's sign is lost: that of clockwise faces is negative"""
    e = edge_functions(corners)
    det = (e[0] * corners[:, 0]).sum(0)
    return (z[:, None] * e).sum(0) / np.abs(det)


def depth_planes_backward(grad_planes, z, corners):
    """the sign is wrong: a vertex drags the picture along, against its slope"""
    e = edge_functions(corners)
    det = (e[0] * corners[:, 0]).sum(0)
    grad_z = (e * grad_planes).sum(1) / det
    return grad_z, depth_planes(z, corners)[:, None] * grad_z


def depth_planes_backward(grad_planes, z, corners):
    """M is transposed: its columns are the corners"""
    e = edge_functions(corners)
    det = (e[0] * corners[:, 0]).sum(0)
    grad_z = (e * grad_planes[:, None]).sum(0) / det
    return grad_z, -depth_planes(z, corners)[:, None] * grad_z


def depth_planes_backward(grad_planes, z, corners):
    """the weights are not divided by the determinant"""
    e = edge_functions(corners)
    grad_z = (e * grad_planes).sum(1)
    return grad_z, -depth_planes(z, corners)[:, None] * grad_z
