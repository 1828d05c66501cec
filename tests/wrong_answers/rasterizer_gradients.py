"""Wrong answers to rasterizer_gradients, written without a look at the checks."""


def edge_functions(corners):
    """the cross products are in reverse order, q_j x q_i, so that all signs are flipped

    told by: sign | q_j x q_i | order & cross | negated | reverse & cross | minus
    """
    edges = np.zeros(np.shape(corners))
    for k, (i, j) in enumerate([(1, 2), (2, 0), (0, 1)]):
        edges[k] = cross(corners[:, j], corners[:, i])
    return edges


def edge_functions(corners):
    """the rows of M are taken for the corners: corners[k] instead of corners[:, k]

    told by: rows & column | row & column | transpos | corners[k] | row & corner | first axis
    """
    q0, q1, q2 = corners
    return np.stack([cross(q1, q2), cross(q2, q0), cross(q0, q1)])


def edge_functions_backward(grad_edges, corners):
    """the cross products are in reverse order, g x q for p and p x g for q, so that the sign is flipped

    told by: sign | reverse & cross | order & cross | negated | minus | g x q
    """
    grad_corners = np.zeros(np.shape(corners))
    for k in range(3):
        i, j = EDGES[k]
        g = grad_edges[k]
        grad_corners[:, i] += cross(g, corners[:, j])
        grad_corners[:, j] += cross(corners[:, i], g)
    return grad_corners


def edge_functions_backward(grad_edges, corners):
    """the result is transposed: the corners' gradients are written in rows

    told by: transpos | row & column | rows & columns | grad_corners[k] | grad_corners[i]
    """
    grad_corners = np.zeros(np.shape(corners))
    for g, (i, j) in zip(grad_edges, EDGES, strict=True):
        grad_corners[i] += cross(corners[:, j], g)
        grad_corners[j] += cross(g, corners[:, i])
    return grad_corners


def edge_functions_backward(grad_edges, corners):
    """the columns of grad_edges are taken for the edges' gradients: grad_edges[:, k] instead of grad_edges[k]

    told by: transpos | grad_edges[:, k] | columns & grad_edges | row & column | rows & columns
    """
    result = np.zeros(np.shape(corners))
    for k, (i, j) in enumerate(EDGES):
        g = grad_edges[:, k]
        result[:, i] += cross(corners[:, j], g)
        result[:, j] += cross(g, corners[:, i])
    return result


def edge_functions_backward(grad_edges, corners):
    """both corners of an edge get the other's gradient: p gets g x p and q gets q x g

    told by: exchanged | swapped | other's | p gets | mixed up | its own
    """
    result = np.zeros(np.shape(corners))
    for k, (i, j) in enumerate(EDGES):
        p, q, g = corners[:, i], corners[:, j], grad_edges[k]
        result[:, i] = result[:, i] + cross(g, p)
        result[:, j] = result[:, j] + cross(q, g)
    return result


def normalize_derivative_backward(grad_db, dc, b, s):
    """in grad_c the change of s is left out: only b = c / s is taken through

    told by: through s | change of s | s depends | s as a constant | s is constant | s = sum
    """
    grad_dc = normalize_backward(grad_db, b, s)
    grad_c = -dc.sum(0) / s * grad_dc
    return grad_dc, grad_c


def normalize_derivative_backward(grad_db, dc, b, s):
    """in grad_c the change of b is left out: only s is taken as a function of c

    told by: through b | change of b | b depends | b as a constant | b is constant | only s is
    """
    grad_dc = normalize_backward(grad_db, b, s)
    db = (dc - b * dc.sum(0)) / s
    grad_c = np.zeros(dc.shape)
    for k in range(3):
        grad_c[k] = -(grad_db * db).sum(0) / s
    return grad_dc, grad_c


def depth_planes(z, corners):
    """z is divided by w at the corners: it is taken in ndc, though eq. (4) has it in clip space

    told by: ndc | z / w | divided by w | clip space | divide
    """
    return ((z / corners[2])[:, None] * inverses(corners)).sum(0)


def depth_planes_backward(grad_planes, z, corners):
    """the minus sign of the inverse's derivative is missing in grad_corners

    told by: sign | minus | negative | negated
    """
    inv = inverses(corners)
    grad_z = np.einsum("kxf,xf->kf", inv, grad_planes)
    planes = np.einsum("kf,kxf->xf", z, inv)
    return grad_z, np.einsum("xf,kf->xkf", planes, grad_z)


def depth_planes_backward(grad_planes, z, corners):
    """grad_z sums over the wrong axis of M^-1: M^-T grad instead of M^-1 grad

    told by: transpos | axis | M^-T | rows & columns | row & column
    """
    grad_z = (inverses(corners) * grad_planes[:, None]).sum(0)
    return grad_z, -depth_planes(z, corners)[:, None] * grad_z
