"""Wrong answers to vertex_gradients, written without a look at the checks."""


def vertex_matrix(triangle):
    """the row of ones is on top instead of at the bottom

    told by: ones & top | ones & first | ones & bottom | ones & last | 1s & top | 1s & first | order & (1, x, y)
    """
    m = np.ones((3, 3))
    for k in range(3):
        m[1, k] = triangle[k, 0]
        m[2, k] = triangle[k, 1]
    return m


def inverse_differential(m, dm):
    """it returns the whole change inv(m + dm) - inv(m), not the linear part of it

    told by: finite | linear | inv(m + dm) | m + dm | first order | difference & inverses | higher order
    """
    return np.linalg.inv(m + dm) - np.linalg.inv(m)


def residual_backward(grad_f, values, m, a, target):
    """grad_target has the wrong sign: the target is subtracted

    told by: grad_target & sign | grad_target & minus | grad_target & negat | target & subtract | target & -1 | grad_target & opposite
    """
    back = np.linalg.inv(m)
    c = back @ a
    slope = values @ back * grad_f
    return grad_f * c, -np.outer(slope, c), slope, grad_f


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
    """the minus before the residuals is missing, so the step goes the wrong way

    told by: sign | minus | negat | opposite | uphill | wrong way | wrong direction
    """
    step, *_ = np.linalg.lstsq(jacobian, residuals)
    return step


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
