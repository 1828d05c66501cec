"""Wrong answers to rasterizer_gradients, written without a look at the checks."""


def edge_normals(corners):
    """the cross products are of the rows of m, although its columns are the corners

    told by: rows & column | row & column | transpos | corners[i] & corners[:, i] | rows of m | axis
    """
    edges = np.empty(np.shape(corners))
    for k, (i, j) in enumerate(EDGES):
        edges[k] = cross(corners[i], corners[j])
    return edges


def edge_functions_at_backward(grad_e, x, y):
    """the second edge of a corner overwrites the gradient of the first one instead of adding to it

    told by: overwrit | two edges | both edges | one of & edges | add & edges | sum & edges | accumul | one edge | last edge
    """
    grad_x, grad_y = np.zeros_like(x), np.zeros_like(y)
    for k, (i, j) in enumerate(EDGES):
        grad_x[i] = grad_e[k] * y[j]
        grad_x[j] = -grad_e[k] * y[i]
        grad_y[i] = -grad_e[k] * x[j]
        grad_y[j] = grad_e[k] * x[i]
    return grad_x, grad_y


def edge_functions_at_backward(grad_e, x, y):
    """the minus of - y_i x_j is lost: both of its derivatives are added

    told by: sign | minus | - y_i | subtract
    """
    grad_x, grad_y = np.zeros_like(x), np.zeros_like(y)
    for k, (i, j) in enumerate(EDGES):
        grad_x[i] += grad_e[k] * y[j]
        grad_y[j] += grad_e[k] * x[i]
        grad_y[i] += grad_e[k] * x[j]
        grad_x[j] += grad_e[k] * y[i]
    return grad_x, grad_y


def edge_functions_at_backward(grad_e, x, y):
    """e_k is taken for the edge from corner k to k + 1, so each gradient is that of other corners

    told by: opposite | across | starts at | k + 1 | edge k | other corners | next corner
    """
    grad_x, grad_y = np.zeros_like(x), np.zeros_like(y)
    for k in range(3):
        n = (k + 1) % 3
        grad_x[k] += grad_e[k] * y[n]
        grad_y[n] += grad_e[k] * x[k]
        grad_y[k] -= grad_e[k] * x[n]
        grad_x[n] -= grad_e[k] * y[k]
    return grad_x, grad_y


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


def edge_normals(corners):
    """the edges are slipped by one: edges[0] is q_0 x q_1, that of vertices k and k + 1

    told by: slipped | q_0 x q_1 | cyclic | k and k + 1 | opposite | shifted | next vertex | rotated | edge & order
    """
    rows = []
    for k in range(3):
        rows.append(cross(corners[:, k], corners[:, (k + 1) % 3]))
    return np.stack(rows)


def edge_functions_at_backward(grad_e, x, y):
    """x and y are mixed up: the derivative by x_i is written with x_j, where y_j belongs

    told by: x and y & exchang | x and y & swap | x and y & mixed | respect to x | grad_x & y_j
    """
    grad_x, grad_y = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    for (i, j), g in zip(EDGES, grad_e):
        grad_x[i] = grad_x[i] + g * x[j]
        grad_x[j] = grad_x[j] - g * x[i]
        grad_y[i] = grad_y[i] - g * y[j]
        grad_y[j] = grad_y[j] + g * y[i]
    return np.array(grad_x), np.array(grad_y)


def edge_functions_at_backward(grad_e, x, y):
    """each corner has the share of the edge that starts there, and not of the one that ends there

    told by: one of its two | both edges | two edges | one edge | second edge | other edge | ends there
    """
    following, after = [1, 2, 0], [2, 0, 1]
    return grad_e[after] * y[following], -grad_e[after] * x[following]


def depth_planes(z, corners):
    """z is divided by w first: depth in ndc at the corners, where eq. (10) has z in clip space

    told by: divided by w | z / w | divid & w | ndc | clip space | z & w
    """
    at_corners = z / corners[2]
    return np.einsum("kf,kif->if", at_corners, inverses(corners))
