"""Wrong answers to rasterizer_gradients, written without a look at the checks."""


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


def normalize_derivative_backward(grad_db, dc, b, s):
    """grad_c lacks the way through the divisor s: db itself is divided by s, too

    told by: through s | through_s | divisor | denominator | db & s | s & constant | sum c | second term | second path
    """
    grad_dc = (grad_db - (grad_db * b).sum(0)) / s
    total = dc.sum(0)
    return grad_dc, -total * grad_dc / s


def depth_planes(z, corners):
    """z is divided by w first: depth in ndc at the corners, where eq. (10) has z in clip space

    told by: divided by w | z / w | divid & w | ndc | clip space | z & w
    """
    at_corners = z / corners[2]
    return np.einsum("kf,kif->if", at_corners, inverses(corners))


def depth_planes_backward(grad_planes, z, corners):
    """grad_corners is transposed: the outer product is of grad_z and the planes, not of the planes and grad_z

    told by: transpos | outer & order | row & column | axes & grad_corners | outer & swap | outer & exchang | axes 0 and 1 are swapped
    """
    grad_z = np.einsum("kcf,cf->kf", inverses(corners), grad_planes)
    planes = depth_planes(z, corners)
    return grad_z, -np.einsum("kf,cf->kcf", grad_z, planes)
