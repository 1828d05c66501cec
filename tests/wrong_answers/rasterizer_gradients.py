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
    """the edges are slipped by one: edges[0] is q_0 x q_1, that of vertices k and k + 1

    told by: slipped | q_0 x q_1 | cyclic | k and k + 1 | opposite | shifted | next vertex | rotated | edge & order
    """
    rows = []
    for k in range(3):
        rows.append(cross(corners[:, k], corners[:, (k + 1) % 3]))
    return np.stack(rows)


def edge_functions_backward(grad_edges, corners):
    """the cross products are turned round: g x q for p and p x g for q, so the sign is wrong

    told by: sign | order of the cross | turned round | minus | g x q | p x g | cross & exchanged | cross & swapped | negative | factors & order
    """
    out = np.zeros(corners.shape)
    for k, (i, j) in enumerate(EDGES):
        out[:, i] += cross(grad_edges[k], corners[:, j])
        out[:, j] += cross(corners[:, i], grad_edges[k])
    return out


def edge_functions_backward(grad_edges, corners):
    """assigned instead of added: each corner keeps only the last of its two edges

    told by: two edges & sum | both edges | overwrit | += | added up | only one & edge | only the last | add up
    """
    out = np.zeros(corners.shape)
    for g, (i, j) in zip(grad_edges, EDGES):
        out[:, i] = cross(corners[:, j], g)
        out[:, j] = cross(g, corners[:, i])
    return out


def depth_planes(z, corners):
    """z is divided by w first: depth in ndc at the corners, where eq. (4) has z in clip space

    told by: divided by w | z / w | divid & w | ndc | clip space | z & w
    """
    at_corners = z / corners[2]
    return np.einsum("kf,kif->if", at_corners, inverses(corners))
