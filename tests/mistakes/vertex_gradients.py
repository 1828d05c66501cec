"""Mistakes of lab 7; each docstring goes on after "this is what comes out when"."""


def vertex_matrix(triangle):
    """the vertices stand in rows; they are the columns"""
    return np.stack([*triangle.T, np.ones(3)], -1)


def vertex_matrix(triangle):
    """the ones stand above x and y; they are the last row"""
    return np.stack([np.ones(3), *triangle.T])


def vertex_matrix(triangle):
    """the rows of x and of y are swapped"""
    return np.stack([*triangle.T[::-1], np.ones(3)])


def residual(values, m, a, target):
    """M is transposed: its columns are the corners"""
    return values @ np.linalg.solve(m.T, a) - target


def residual(values, m, a, target):
    """the target is added; it is taken away"""
    return values @ np.linalg.solve(m, a) + target


def residual(values, m, a, target):
    """the sign is flipped: a pixel that is too bright has a positive residual"""
    return target - values @ np.linalg.solve(m, a)


def inverse_differential(m, dm):
    """the sign is missing: an inverse shrinks where the matrix grows"""
    inverse = np.linalg.inv(m)
    return inverse @ dm @ inverse


def inverse_differential(m, dm):
    """both inverses are on the same side; matrices do not commute"""
    inverse = np.linalg.inv(m)
    return -dm @ inverse @ inverse


def inverse_differential(m, dm):
    """the inverse is there once; it is on both sides of dM"""
    inverse = np.linalg.inv(m)
    return -inverse @ dm


def residual_slope(values, m, a, i, j):
    """rows and columns are swapped: i is the row"""
    dm = np.zeros((3, 3))
    dm[j, i] = 1
    return values @ inverse_differential(m, dm) @ a


def residual_slope(values, m, a, i, j):
    """the sign is wrong: a vertex drags the picture along, against its slope"""
    dm = np.zeros((3, 3))
    dm[i, j] = 1
    return -values @ inverse_differential(m, dm) @ a


def residual_slope(values, m, a, i, j):
    """dM is taken for the change of the inverse"""
    dm = np.zeros((3, 3))
    dm[i, j] = 1
    return values @ dm @ a


def residual_backward(grad_f, values, m, a, target):
    """the inverse is not transposed for the gradient by a"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_a = grad_f * (inverse @ values)
    return grad_f * c, -np.outer(grad_a, c), grad_a, -grad_f


def residual_backward(grad_f, values, m, a, target):
    """the sign is wrong: a vertex drags the picture along, against its slope"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_a = grad_f * (inverse.T @ values)
    return grad_f * c, np.outer(grad_a, c), grad_a, -grad_f


def residual_backward(grad_f, values, m, a, target):
    """grad_m is transposed: its row i is of row i of M, its column j of vertex j"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_a = grad_f * (inverse.T @ values)
    return grad_f * c, -np.outer(c, grad_a), grad_a, -grad_f


def residuals_jacobian(values, triangle, points):
    """the sign is wrong: a vertex drags the picture along, against its slope"""
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:, :2].T + inverse[:, 2]
    slope = values @ inverse[:, :2]
    return c, c[:, :, None] * slope


def residuals_jacobian(values, triangle, points):
    """the derivatives by x and by y are swapped"""
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:, :2].T + inverse[:, 2]
    slope = values @ inverse[:, :2]
    return c, -c[:, :, None] * slope[::-1]


def residuals_jacobian(values, triangle, points):
    """the 1 of a = (x, y, 1) is left out"""
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:, :2].T
    slope = values @ inverse[:, :2]
    return c, -c[:, :, None] * slope


def gauss_newton_step(residuals, jacobian):
    """the sign is wrong: the step goes uphill"""
    return np.linalg.lstsq(jacobian, residuals)[0]


def gauss_newton_step(residuals, jacobian):
    """it is a step along the gradient"""
    return -jacobian.T @ residuals


def gauss_newton_step(residuals, jacobian):
    """something is added to the diagonal of J^T J: that damps the step"""
    return np.linalg.solve(
        jacobian.T @ jacobian + 0.001 * np.eye(jacobian.shape[1]), -jacobian.T @ residuals
    )


def weights(m, a):
    """c is not divided by its sum"""
    c = np.linalg.solve(m, a)
    return c


def weights(m, a):
    """the sum is that of |c|"""
    c = np.linalg.solve(m, a)
    return c / np.abs(c).sum()


def weights(m, a):
    """M is transposed: its columns are the corners"""
    c = np.linalg.solve(m.T, a)
    return c / c.sum()


def weights_backward(grad_b, m, a):
    """the sum s is taken for a constant"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_c = grad_b / c.sum()
    grad_a = inverse.T @ grad_c
    return -np.outer(grad_a, c), grad_a


def weights_backward(grad_b, m, a):
    """the share of the sum s has the wrong sign"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_c = (grad_b + grad_b @ c / c.sum()) / c.sum()
    grad_a = inverse.T @ grad_c
    return -np.outer(grad_a, c), grad_a


def weights_backward(grad_b, m, a):
    """the inverse is not transposed for the gradient by a"""
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_c = (grad_b - grad_b @ c / c.sum()) / c.sum()
    grad_a = inverse @ grad_c
    return -np.outer(grad_a, c), grad_a


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


def normalize(e, epsilon):
    """epsilon has the same sign everywhere: it must have that of s"""
    s = e.sum(0)
    return e / (s + epsilon)


def normalize(e, epsilon):
    """epsilon is left out"""
    s = e.sum(0)
    return e / s


def normalize(e, epsilon):
    """the sign of s is lost"""
    s = e.sum(0)
    return e / (np.abs(s) + epsilon)


def normalize_backward(grad_b, e, epsilon):
    """the sum s is taken for a constant"""
    s = e.sum(0)
    s = s + np.copysign(epsilon, s)
    return grad_b / s


def normalize_backward(grad_b, e, epsilon):
    """the share of the sum s has the wrong sign"""
    s = e.sum(0)
    s = s + np.copysign(epsilon, s)
    return (grad_b + (grad_b * e).sum(0) / s) / s


def normalize_backward(grad_b, e, epsilon):
    """epsilon has the same sign everywhere: it must have that of s"""
    s = e.sum(0)
    s = s + epsilon
    return (grad_b - (grad_b * e).sum(0) / s) / s


def normalize_derivative(e, e_x, epsilon):
    """the sum s is taken for a constant"""
    s = e.sum(0)
    s = s + np.copysign(epsilon, s)
    return e_x / s


def normalize_derivative(e, e_x, epsilon):
    """the share of the sum s has the wrong sign"""
    s = e.sum(0)
    s = s + np.copysign(epsilon, s)
    return (e_x + e / s * e_x.sum(0)) / s


def normalize_derivative(e, e_x, epsilon):
    """epsilon has the same sign everywhere: it must have that of s"""
    s = e.sum(0)
    s = s + epsilon
    return (e_x - e / s * e_x.sum(0)) / s


def normalize_derivative_backward(grad_b_x, e, e_x, epsilon):
    """the way through s alone is left out"""
    s = e.sum(0)
    grad_e_x = normalize_backward(grad_b_x, e, epsilon)
    return -(e_x.sum(0) * grad_e_x) / (s + np.copysign(epsilon, s)), grad_e_x


def normalize_derivative_backward(grad_b_x, e, e_x, epsilon):
    """the way through b is left out"""
    s = e.sum(0)
    grad_e_x = normalize_backward(grad_b_x, e, epsilon)
    through_s = (grad_b_x * normalize_derivative(e, e_x, epsilon)).sum(0)
    return -(through_s) / (s + np.copysign(epsilon, s)), grad_e_x


def normalize_derivative_backward(grad_b_x, e, e_x, epsilon):
    """grad_e has the wrong sign"""
    s = e.sum(0)
    grad_e_x = normalize_backward(grad_b_x, e, epsilon)
    through_s = (grad_b_x * normalize_derivative(e, e_x, epsilon)).sum(0)
    return (e_x.sum(0) * grad_e_x + through_s) / (s + np.copysign(epsilon, s)), grad_e_x


def sum_per_face(u, x, y, face, count):
    """of the pixels of a face only the last one counts; they add up"""
    sums = np.zeros((len(u), 3, count))
    sums[:, :, face] += u[:, None] * np.stack([x, y, np.ones(len(x))])
    return sums


def sum_per_face(u, x, y, face, count):
    """the order is 1, x, y; a is (x, y, 1)"""
    return np.array(
        [
            [
                np.bincount(face, u_k, count),
                np.bincount(face, u_k * x, count),
                np.bincount(face, u_k * y, count),
            ]
            for u_k in u
        ]
    )


def sum_per_face(u, x, y, face, count):
    """it is the mean over the pixels of a face instead of the sum"""
    return np.array(
        [
            [
                np.bincount(face, u_k * x, count),
                np.bincount(face, u_k * y, count),
                np.bincount(face, u_k, count),
            ]
            for u_k in u
        ]
    ) / np.maximum(np.bincount(face, None, count), 1)


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
