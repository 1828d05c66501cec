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


def barycentric_backward(grad_b, m, a):
    """the share of the sum s is left out: grad_c is only grad_b / s

    told by: the sum & share | sum & depends | grad_b . b | quotient | s & depends | s & constant | normali | second term
    """
    c = np.linalg.solve(m, a)
    slope = np.linalg.solve(m.T, grad_b / c.sum())
    return -np.outer(slope, c), slope


def barycentric_backward(grad_b, m, a):
    """grad_c is not divided by s

    told by: divi & s | 1 / s | / s | divi & sum | factor s | times s
    """
    back = np.linalg.inv(m)
    c = back @ a
    b = c / c.sum()
    slope = back.T @ (grad_b - grad_b @ b)
    return -np.outer(slope, c), slope


def barycentric_backward(grad_b, m, a):
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
    """transposed: one vertex in each row, not in each column

    told by: transpos | each row | rows & columns | one vertex & row | row & column | row vectors
    """
    homogeneous = np.ones((3, 3))
    for k in range(3):
        homogeneous[k, 0] = triangle[k, 0]
        homogeneous[k, 1] = triangle[k, 1]
    return homogeneous


def vertex_matrix(triangle):
    """the row of ones stands on top, as (1, x, y)

    told by: ones & top | ones & first | (1, x, y) | ones  | ones & last | 1 & last |  last | row & order | ones & bottom | ones & above
    """
    return np.vstack([np.ones(3), triangle.T])


def inverse_differential(m, dm):
    """the minus sign is missing

    told by: sign | minus | negative | opposite
    """
    back = np.linalg.inv(m)
    return back @ dm @ back


def inverse_differential(m, dm):
    """the matrices in wrong order, as if they commuted: -dM M^-1 M^-1

    told by: commut | order of | wrong order | M^-1 M^-1 | both sides | left and right | same side | M^-2 | both inverses stand
    """
    back = np.linalg.inv(m)
    return -dm @ back @ back


def residual_slope(values, m, a, i, j):
    """i and j are exchanged: the 1 stands in row j, column i

    told by: i and j | transpos | row and column | row j | rows and columns | e_j e_i | row & column & exchanged
    """
    single = np.outer(np.eye(3)[j], np.eye(3)[i])
    return values @ inverse_differential(m, single) @ a


def residual_backward(grad_f, values, m, a, target):
    """grad_m is transposed: -c (df/da)^T

    told by: transpos | outer & order | c stands first | outer & exchanged | rows and columns | row & column | outer product & swapped
    """
    c = np.linalg.solve(m, a)
    by_a = np.linalg.solve(m.T, values) * grad_f
    by_m = np.zeros((3, 3))
    for i in range(3):
        for j in range(3):
            by_m[i, j] = -c[i] * by_a[j]
    return grad_f * c, by_m, by_a, -grad_f


def residual_backward(grad_f, values, m, a, target):
    """grad_f is forgotten in grad_m

    told by: grad_f & forgot | grad_f & missing | grad_f & left out | grad_f & grad_m | times grad_f | without grad_f | scale & grad_f | chain rule | incoming
    """
    inverse = np.linalg.inv(m)
    c = inverse @ a
    slope = inverse.T @ values
    return grad_f * c, -np.outer(slope, c), grad_f * slope, -grad_f


def residuals_jacobian(values, triangle, points):
    """by_triangle has the other sign: the picture's slope times the weight, without the minus

    told by: sign | minus | negative | opposite
    """
    inverse = np.linalg.inv(vertex_matrix(triangle))
    by_values = np.zeros((len(points), 3))
    by_triangle = np.zeros((len(points), 3, 2))
    slope = (values @ inverse)[:2]
    for p, (x, y) in enumerate(points):
        by_values[p] = inverse @ [x, y, 1]
        for k in range(3):
            by_triangle[p, k] = by_values[p, k] * slope
    return by_values, by_triangle


def residuals_jacobian(values, triangle, points):
    """the weight is left out: every vertex gets the whole slope

    told by: weight & left out | weight & missing | same for & vert | every vertex | each vertex & same | whole slope | times the weight | times c | weight & forgot | without & weight
    """
    inverse = np.linalg.inv(vertex_matrix(triangle))
    ones = np.ones((len(points), 1))
    c = np.hstack([points, ones]) @ inverse.T
    slope = values @ inverse
    return c, np.broadcast_to(-slope[:2], (len(points), 3, 2)).copy()


def gauss_newton_step(residuals, jacobian):
    """the step has the other sign: it solves jacobian step = residuals

    told by: sign | minus | opposite | negative | -residuals | away from | uphill
    """
    return np.linalg.lstsq(jacobian, residuals, rcond=None)[0]


def gauss_newton_step(residuals, jacobian):
    """a step of gradient descent, -J^T f: without (J^T J)^-1

    told by: gradient descent | J^T J | normal equation | steepest | -J^T | transpos & inverse | not solved | without solving
    """
    step = np.zeros(jacobian.shape[1])
    for row, f in zip(jacobian, residuals):
        step -= f * row
    return step


def barycentric_backward(grad_b, m, a):
    """the sum s counts as a constant: grad_c is grad_b / s alone

    told by: constant | through s | through the sum | quotient rule | grad_b / s | s & depends | sum & left out | sum & forgot | sum & missing
    """
    inverse = np.linalg.inv(m)
    c = inverse @ a
    by_c = grad_b / np.sum(c)
    by_a = by_c @ inverse
    return -np.outer(by_a, c), by_a


def barycentric_backward(grad_b, m, a):
    """grad_m has b in place of c: the division by s is made once more

    told by: b instead of c | b for c | b & in place of c | factor s | divided by s | once more | divided twice
    """
    inverse = np.linalg.inv(m)
    c = inverse @ a
    s = c.sum()
    b = c / s
    by_c = (grad_b - grad_b @ b) / s
    by_a = inverse.T @ by_c
    return -by_a[:, None] * b, by_a
