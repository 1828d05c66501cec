"""Wrong answers to rasterizer_gradients, written without a look at the checks."""


def edge_functions(corners):
    """the cross products are of the rows of m, although its columns are the corners

    told by: rows & column | row & column | transpos | corners[i] & corners[:, i] | rows of m | axis
    """
    edges = np.empty(np.shape(corners))
    for k, (i, j) in enumerate(EDGES):
        edges[k] = cross(corners[i], corners[j])
    return edges


def edge_functions_backward(grad_edges, corners):
    """the second edge of a corner overwrites the gradient of the first one instead of adding to it

    told by: overwrit | two edges | both edges | one of & edges | add & edges | sum & edges | accumul | one edge | last edge
    """
    result = np.zeros(np.shape(corners))
    for k, (i, j) in enumerate(EDGES):
        result[:, i] = cross(corners[:, j], grad_edges[k])
        result[:, j] = cross(grad_edges[k], corners[:, i])
    return result


def edge_functions_backward(grad_edges, corners):
    """the second corner gets p x g instead of g x p, so its share has the wrong sign

    told by: p x g | g x p | sign & second | sign & q_j | sign & one | order & cross | second & factor | anticommut | cross & sign
    """
    result = np.zeros(np.shape(corners))
    for k in range(3):
        i, j = EDGES[k]
        p, q, g = corners[:, i], corners[:, j], grad_edges[k]
        result[:, i] += cross(q, g)
        result[:, j] += cross(p, g)
    return result


def edge_functions_backward(grad_edges, corners):
    """it takes column k of grad_edges for edge k, but edge k is row k

    told by: transpos | column & row | grad_edges[:, k] | grad_edges[k] | columns of grad_edges | rows of grad_edges | axis
    """
    result = np.zeros(np.shape(corners))
    for k, (i, j) in enumerate(EDGES):
        g = grad_edges[:, k]
        result[:, i] += cross(corners[:, j], g)
        result[:, j] += cross(g, corners[:, i])
    return result


def normalize_derivative_backward(grad_db, dc, b, s):
    """grad_c lacks the way through the divisor s: db itself is divided by s, too

    told by: through s | through_s | divisor | denominator | db & s | s & constant | sum c | second term | second path
    """
    grad_dc = (grad_db - (grad_db * b).sum(0)) / s
    total = dc.sum(0)
    return grad_dc, -total * grad_dc / s


def depth_planes(z, corners):
    """it computes M^-1 z instead of z^T M^-1: the sum is over the wrong axis

    told by: transpos | axis | M^-1 z | z^T M^-1 | row & column | rows & inverse
    """
    back = inverses(corners)
    planes = np.zeros(z.shape)
    for k in range(3):
        planes += back[:, k] * z[k]
    return planes


def depth_planes_backward(grad_planes, z, corners):
    """grad_corners is transposed: the outer product is of grad_z and the planes, not of the planes and grad_z

    told by: transpos | outer & order | row & column | axes & grad_corners | outer & swap | outer & exchang | axes 0 and 1 are swapped
    """
    grad_z = np.einsum("kcf,cf->kf", inverses(corners), grad_planes)
    planes = depth_planes(z, corners)
    return grad_z, -np.einsum("kf,cf->kcf", grad_z, planes)


def edge_functions(corners):
    """edge 1 is q_0 x q_2 instead of q_2 x q_0, so that only its sign is flipped

    told by: edge 1 | edges[1] | q_0 x q_2 | (0, 2) | cyclic | sign of one
    """
    q = np.moveaxis(corners, 1, 0)
    return np.stack([cross(q[1], q[2]), cross(q[0], q[2]), cross(q[0], q[1])])


def edge_functions_backward(grad_edges, corners):
    """= instead of +=: each corner keeps only the last of its two edges

    told by: two edges | += | overwr | both edges | last & edge | only one & edge
    """
    grad = np.zeros(np.shape(corners))
    for g, (i, j) in zip(grad_edges, EDGES):
        grad[:, i] = cross(corners[:, j], g)
        grad[:, j] = cross(g, corners[:, i])
    return grad


def edge_functions_backward(grad_edges, corners):
    """only the first corner of each edge gets a gradient: the second factor of the cross product is left out

    told by: second factor | only the first | second corner | product rule | both corners | both factors | q gets nothing
    """
    q0, q1, q2 = corners[:, 0], corners[:, 1], corners[:, 2]
    g0, g1, g2 = grad_edges
    return np.stack([cross(q1, g2), cross(q2, g0), cross(q0, g1)], 1)


def normalize_derivative_backward(grad_db, dc, b, s):
    """grad_dc is grad_db / s, without the share that goes through sum dc

    told by: sum dc | grad_dc & share | grad_dc & second term | grad_dc & quotient | grad_db / s
    """
    grad_dc = grad_db / s
    full = normalize_backward(grad_db, b, s)
    through_s = (grad_db * normalize_derivative(dc, b, s)).sum(0)
    return grad_dc, -(dc.sum(0) * full + through_s) / s


def depth_planes(z, corners):
    """z is multiplied with the columns of M^-1, M^-1 z instead of M^-T z

    told by: transpos | M^-T | column | M^-1 z | wrong axis
    """
    inv = inverses(corners)
    return (inv * z[None]).sum(1)


def depth_planes(z, corners):
    """the edge functions are not divided by the determinant

    told by: determinant | det( | inverse & edge | area of | not divided | adjugate
    """
    e = edge_functions(corners)
    planes = np.zeros(z.shape)
    for k in range(3):
        planes += z[k] * e[k]
    return planes


def depth_planes_backward(grad_planes, z, corners):
    """grad_corners is the transpose of what it should be: the outer product's factors are exchanged

    told by: transpos | outer & exchanged | outer & order | rows & columns | row & column | swapped
    """
    grad_z = (inverses(corners) * grad_planes).sum(1)
    planes = depth_planes(z, corners)
    return grad_z, -grad_z[:, None] * planes
