"""Wrong answers to vertex_gradients, written without a look at the checks."""


def vertex_matrix(triangle):
    """the vertices stand in the rows of m, not in its columns: m is transposed

    told by: transpos | rows & column | vertices & rows | vertex & row | ones & last column
    """
    return np.column_stack([triangle, np.ones(len(triangle))])


def vertex_matrix(triangle):
    """the row of ones is on top instead of at the bottom

    told by: ones & top | ones & first | ones & bottom | ones & last | 1s & top | 1s & first | order & (1, x, y)
    """
    m = np.ones((3, 3))
    for k in range(3):
        m[1, k] = triangle[k, 0]
        m[2, k] = triangle[k, 1]
    return m


def vertex_matrix(triangle):
    """the last row is 0, as for directions, instead of 1

    told by: row & zero | row & 0 | row & ones | row & 1 | homogeneous | direction & point
    """
    m = np.zeros((3, 3))
    m[:2] = triangle.T
    return m


def inverse_differential(m, dm):
    """the minus sign is missing

    told by: sign | minus | negat | opposite | times -1
    """
    w = np.linalg.inv(m)
    return w @ dm @ w


def inverse_differential(m, dm):
    """dm stands to the right of both inverses instead of between them, as if matrices commuted

    told by: commut | between | order & matri | order & product | order & factor | order & dm | both inverses stand
    """
    w = np.linalg.inv(m)
    return -(w @ w) @ dm


def inverse_differential(m, dm):
    """it returns the whole change inv(m + dm) - inv(m), not the linear part of it

    told by: finite | linear | inv(m + dm) | m + dm | first order | difference & inverses | higher order
    """
    return np.linalg.inv(m + dm) - np.linalg.inv(m)


def residual_slope(values, m, a, i, j):
    """row and column of the single 1 in dm are exchanged

    told by: transpos | row & column | i and j | [j, i] | dm_ji
    """
    single = np.zeros((3, 3))
    single[j, i] = 1.0
    return values @ inverse_differential(m, single) @ a


def residual_backward(grad_f, values, m, a, target):
    """grad_a is computed with the inverse instead of its transpose

    told by: transpos | M^-1 & M^-T | inverse.T | M^-1 r | inverse @ values
    """
    w = np.linalg.inv(m)
    c = w @ a
    slope = grad_f * (w @ values)
    return grad_f * c, -np.outer(slope, c), slope, -grad_f


def residual_backward(grad_f, values, m, a, target):
    """the last row of grad_m is set to 0, because its ones are taken as constants

    told by: last row | bottom row | third row | row & ones | row & 1s | 1s & constant | ones & constant | row 2
    """
    weights_of_pixel = np.linalg.solve(m, a)
    slope = np.linalg.solve(m.T, values) * grad_f
    grad_m = np.zeros((3, 3))
    for i in range(2):
        for j in range(3):
            grad_m[i, j] = -slope[i] * weights_of_pixel[j]
    return grad_f * weights_of_pixel, grad_m, slope, -grad_f


def residual_backward(grad_f, values, m, a, target):
    """grad_target has the wrong sign: the target is subtracted

    told by: grad_target & sign | grad_target & minus | grad_target & negat | target & subtract | target & -1 | grad_target & opposite
    """
    back = np.linalg.inv(m)
    c = back @ a
    slope = values @ back * grad_f
    return grad_f * c, -np.outer(slope, c), slope, grad_f


def residuals_jacobian(values, triangle, points):
    """the minus of by_triangle is missing

    told by: by_triangle & sign | by_triangle & minus | by_triangle & negat | vert & sign | vert & minus | by_triangle & opposite
    """
    back = np.linalg.inv(vertex_matrix(triangle))
    homogeneous = np.column_stack([points, np.ones(len(points))])
    c = homogeneous @ back.T
    slope = (values @ back)[:2]
    return c, np.einsum("pk,c->pkc", c, slope)


def residuals_jacobian(values, triangle, points):
    """by_triangle is filled with the coordinate before the vertex and then reshaped, so its last two axes are mixed up

    told by: reshape | axes | axis | vert & order | transpos | (2, 3) & (3, 2) | layout
    """
    back = np.linalg.inv(vertex_matrix(triangle))
    by_values, by_triangle = [], []
    for x, y in points:
        c = back @ [x, y, 1.0]
        slope = back.T @ values
        by_values.append(c)
        by_triangle.append(-np.outer(slope[:2], c).reshape(3, 2))
    return np.array(by_values), np.array(by_triangle)


def residuals_jacobian(values, triangle, points):
    """each vertex gets the whole slope of the picture: its weight c_k at the pixel is left out

    told by: weight & vert | weight & slope | weight & miss | weight & without | times c | factor c | same & vert | all three
    """
    back = np.linalg.inv(vertex_matrix(triangle))
    c = np.column_stack([points, np.ones(len(points))]) @ back.T
    slope = back.T @ values
    by_triangle = np.zeros((len(points), 3, 2))
    for k in range(3):
        by_triangle[:, k, 0] = -slope[0]
        by_triangle[:, k, 1] = -slope[1]
    return c, by_triangle


def gauss_newton_step(residuals, jacobian):
    """the minus before the residuals is missing, so the step goes the wrong way

    told by: sign | minus | negat | opposite | uphill | wrong way | wrong direction
    """
    step, *_ = np.linalg.lstsq(jacobian, residuals)
    return step


def gauss_newton_step(residuals, jacobian):
    """it is the step of gradient descent, -J^T r, without the inverse of J^T J

    told by: gradient descent | J^T J | steepest | -J^T r | normal & equation | jacobian.T @ residuals | hessian | gradient & not & least squares
    """
    step = np.zeros(jacobian.shape[1])
    for r, row in zip(residuals, jacobian):
        step -= r * row
    return step


def gauss_newton_step(residuals, jacobian):
    """fine print: J^T J has no inverse if unknowns have no influence or there are fewer residuals than unknowns

    told by: singular | shortest | inverse & J^T J | no influence | many steps | rank | R < U | fewer & unknowns
    """
    normal = jacobian.T @ jacobian
    return np.linalg.solve(normal, -(jacobian.T @ residuals))


def weights_backward(grad_b, m, a):
    """the share of the sum s is left out: grad_c is only grad_b / s

    told by: the sum & share | sum & depends | grad_b . b | quotient | s & depends | s & constant | normali | second term
    """
    c = np.linalg.solve(m, a)
    slope = np.linalg.solve(m.T, grad_b / c.sum())
    return -np.outer(slope, c), slope


def weights_backward(grad_b, m, a):
    """grad_c is not divided by s

    told by: divi & s | 1 / s | / s | divi & sum | factor s | times s
    """
    back = np.linalg.inv(m)
    c = back @ a
    b = c / c.sum()
    slope = back.T @ (grad_b - grad_b @ b)
    return -np.outer(slope, c), slope


def weights_backward(grad_b, m, a):
    """grad_m is made with the weights b instead of c

    told by: b instead of c | b, not c | b for c | normalized weights | b^T | grad_m & factor s | grad_m & / s | b in place of c
    """
    c = np.linalg.solve(m, a)
    s = c.sum()
    b = c / s
    grad_c = (grad_b - np.dot(grad_b, b)) / s
    grad_a = np.linalg.inv(m).T @ grad_c
    grad_m = np.empty((3, 3))
    for k in range(3):
        grad_m[:, k] = -grad_a * b[k]
    return grad_m, grad_a


def vertex_matrix(triangle):
    """the ones stand in the first row, not below x and y

    told by: ones & first row | 1s & first row | ones & top | ones & last row | 1s & last row | order of the rows
    """
    xs, ys = triangle[:, 0], triangle[:, 1]
    return np.array([[1.0, 1.0, 1.0], xs, ys])


def vertex_matrix(triangle):
    """the triangle is reshaped to two rows rather than transposed, so that x and y of the vertices are mixed

    told by: reshape | x and y & mix | not & transpos | row by row
    """
    return np.vstack([triangle.reshape(2, 3), np.ones((1, 3))])


def inverse_differential(m, dm):
    """the scalar rule -dm / m^2: both inverses stand on the left of dM, though matrices do not commute

    told by: commut | same side | on the left | both sides | order & factors | each side
    """
    minv = np.linalg.inv(m)
    return -(minv @ minv) @ dm


def residual_backward(grad_f, values, m, a, target):
    """grad_m is transposed: the outer product is c df/da^T

    told by: transpos | outer & order | rows & columns | row & column | outer & swapped | outer & exchanged
    """
    minv = np.linalg.inv(m)
    c = minv @ a
    da = minv.T @ values
    return grad_f * c, -grad_f * np.outer(c, da), grad_f * da, -grad_f


def residual_backward(grad_f, values, m, a, target):
    """grad_target has the sign +, though the target is subtracted

    told by: grad_target & sign | target & subtract | grad_target & minus | grad_target & negative | target & sign | grad_target & +
    """
    minv = np.linalg.inv(m)
    c = minv @ a
    grad_a = grad_f * (values @ minv)
    return grad_f * c, -np.outer(grad_a, c), grad_a, grad_f


def residual_backward(grad_f, values, m, a, target):
    """the third row of grad_m is set to 0, as if the 1s of eq. (1) were constants

    told by: third row | last row | constant | 1s & variable | ones & variable | row 2
    """
    minv = np.linalg.inv(m)
    c = minv @ a
    grad_a = grad_f * (minv.T @ values)
    grad_m = np.zeros((3, 3))
    for i in range(2):
        for j in range(3):
            grad_m[i, j] = -grad_a[i] * c[j]
    return grad_f * c, grad_m, grad_a, -grad_f


def residuals_jacobian(values, triangle, points):
    """by_values has the vertices' values multiplied in: c r instead of c

    told by: by_values & values | multiplied by the values | values & multiplied | times the values | times values
    """
    inverse = np.linalg.inv(vertex_matrix(triangle))
    by_values = np.zeros((len(points), 3))
    by_triangle = np.zeros((len(points), 3, 2))
    for p, point in enumerate(points):
        c = inverse @ np.append(point, 1)
        by_values[p] = c * values
        by_triangle[p] = -np.outer(c, (inverse.T @ values)[:2])
    return by_values, by_triangle


def residuals_jacobian(values, triangle, points):
    """the points' third component is 0, not 1

    told by: third & 0 | homogeneous | append & 1 | third column | missing 1 | last column | the 1 of a & left out
    """
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:, :2].T
    slope = values @ inverse[:, :2]
    return c, -c[:, :, None] * slope


def residuals_jacobian(values, triangle, points):
    """x and y of each vertex are exchanged in by_triangle: the last axis is reversed

    told by: x and y | x and y & exchanged | x and y & swapped | last axis | y before x | order of x
    """
    inverse = np.linalg.inv(vertex_matrix(triangle))
    c = points @ inverse[:, :2].T + inverse[:, 2]
    gx, gy = (values @ inverse)[:2]
    by_triangle = np.stack([-c * gy, -c * gx], axis=2)
    return c, by_triangle


def gauss_newton_step(residuals, jacobian):
    """the sign: the step solves jacobian step = residuals and goes uphill

    told by: sign | minus | negative | uphill | wrong direction | opposite direction
    """
    return np.linalg.lstsq(jacobian, residuals, rcond=None)[0]


def gauss_newton_step(residuals, jacobian):
    """the normal equations are solved directly, which fails where unknowns have no influence or R < U (fine print)

    told by: normal equation | singular | J^T J | no influence | R < U | shortest
    """
    return np.linalg.solve(jacobian.T @ jacobian, -jacobian.T @ residuals)


def gauss_newton_step(residuals, jacobian):
    """the normal equations are damped with a whole identity matrix, Levenberg-Marquardt, so that the step is too short

    told by: damp | too short | levenberg | regulari | identity | ridge | added to the diagonal
    """
    n = jacobian.shape[1]
    damped = jacobian.T @ jacobian + np.eye(n)
    return -np.linalg.solve(damped, jacobian.T @ residuals)


def gauss_newton_step(residuals, jacobian):
    """the right-hand side is J^T r divided by the number of residuals: a mean instead of the sum

    told by: mean | number of residuals | divided by & residuals | too short | 1/R | averag
    """
    rows = len(residuals)
    return -np.linalg.pinv(jacobian) @ residuals / rows


def weights_backward(grad_b, m, a):
    """grad_M uses the normalised b where eq. (6) has c

    told by: b instead of c | b, not c | normalised b | normalized b | b for c | c is divided | grad_m & b in place of c
    """
    inverse = np.linalg.inv(m)
    c = inverse @ a
    s = c.sum()
    b = c / s
    grad_c = (grad_b - grad_b @ b) / s
    grad_a = inverse.T @ grad_c
    return -np.outer(grad_a, b), grad_a


def weights_backward(grad_b, m, a):
    """the two results are returned in the other order: grad_a before grad_m

    told by: grad_a & first | grad_a before | exchanged | swapped | order of the results | other order | outputs & wrong order
    """
    inverse = np.linalg.inv(m)
    c = inverse @ a
    grad_c = normalize_backward(grad_b, c / c.sum(), c.sum())
    grad_a = inverse.T @ grad_c
    return grad_a, -np.outer(grad_a, c)
