"""Wrong answers to vertex_gradients, written without a look at the checks."""


def vertex_matrix(triangle):
    """the vertices stand in the rows of M, not in its columns: the matrix is transposed

    told by: transpos | rows & column | in the rows | row & vertex
    """
    return np.hstack([triangle, np.ones((3, 1))])


def vertex_matrix(triangle):
    """x and y are exchanged: the first row has the ys

    told by: x and y | x and y & exchanged | x and y & swapped | y comes first | exchanged
    """
    m = np.ones((3, 3))
    for k in range(3):
        y, x = triangle[k]
        m[0, k] = x
        m[1, k] = y
    return m


def vertex_matrix(triangle):
    """the third row has zeros where it should have ones, as if the vertices were directions

    told by: zeros & row | third row & 0 | last row & 0 | ones are missing | row of ones | row of 1s
    """
    m = np.zeros((3, 3))
    m[:2, :] = triangle.T
    return m


def inverse_differential(m, dm):
    """the minus sign is missing

    told by: sign | minus | negative | negated | -1 times | times -1
    """
    minv = np.linalg.inv(m)
    return minv @ dm @ minv


def inverse_differential(m, dm):
    """the products are elementwise instead of matrix products

    told by: elementwise | element-wise | element by element | matrix product | * & @
    """
    minv = np.linalg.inv(m)
    return -minv * dm * minv


def inverse_differential(m, dm):
    """the second factor is transposed: M^-1 dM M^-T

    told by: transpos | M^-T | inverse.T
    """
    minv = np.linalg.inv(m)
    return -minv @ dm @ minv.T


def inverse_differential(m, dm):
    """a finite step, inv(m + dm) - inv(m), instead of the derivative

    told by: finite | difference | not linear | linear in dm | inv(m + dm) | whole step
    """
    return np.linalg.inv(m + dm) - np.linalg.inv(m)


def residual_slope(values, m, a, i, j):
    """the row and the column are exchanged: the 1 of dM stands at [j, i]

    told by: row & column | i and j | [j, i] | transpos | m_ji
    """
    e = np.zeros((3, 3))
    e[j, i] = 1.0
    inv = np.linalg.inv(m)
    return -values @ inv @ e @ inv @ a


def residual_slope(values, m, a, i, j):
    """the minus sign of eq. (3) is left out

    told by: sign | minus | negative | negated
    """
    inv = np.linalg.inv(m)
    left = 0.0
    right = 0.0
    for k in range(3):
        left += values[k] * inv[k, i]
        right += inv[j, k] * a[k]
    return left * right


def residual_backward(grad_f, values, m, a, target):
    """grad_a uses M^-1 where M^-T belongs, also in grad_m

    told by: M^-T | transpos | M^-1 r | inverse.T
    """
    minv = np.linalg.inv(m)
    c = minv @ a
    grad_a = grad_f * minv @ values
    return grad_f * c, -np.outer(grad_a, c), grad_a, -grad_f


def residual_backward(grad_f, values, m, a, target):
    """grad_f is forgotten in grad_m: the chain rule's outer factor is missing there

    told by: grad_f & grad_m | chain rule | grad_f & missing | grad_f & forgotten | without grad_f | multiplied by grad_f
    """
    x = np.linalg.solve(m, a)
    y = np.linalg.solve(m.T, values)
    return grad_f * x, -np.outer(y, x), grad_f * y, -grad_f


def residuals_jacobian(values, triangle, points):
    """the minus sign of eq. (4) is missing in by_triangle

    told by: sign | minus | negative | negated
    """
    minv = np.linalg.inv(vertex_matrix(triangle))
    a = np.column_stack([points, np.ones(len(points))])
    c = a @ minv.T
    slope = values @ minv
    return c, np.einsum("pk,x->pkx", c, slope[:2])


def residuals_jacobian(values, triangle, points):
    """the slope is taken with M^-1 r instead of M^-T r, rows and columns exchanged

    told by: transpos | M^-T | row & column | M^-1 r | inverse.T
    """
    inverse = np.linalg.inv(vertex_matrix(triangle))
    a = np.concatenate([points, np.ones((len(points), 1))], axis=1)
    c = (inverse @ a.T).T
    slope = (inverse @ values)[:2]
    return c, -c[:, :, None] * slope[None, None, :]


def gauss_newton_step(residuals, jacobian):
    """a gradient step -J^T r, without the inverse of J^T J

    told by: gradient step | gradient descent | J^T J | J^T r | normal equation | steepest
    """
    return -jacobian.T @ residuals


def weights_backward(grad_b, m, a):
    """the share of the sum s is left out: grad_c is grad_b / s

    told by: sum s | through s | quotient rule | grad_b . b | s depends | s is constant
    """
    minv = np.linalg.inv(m)
    c = minv @ a
    grad_c = grad_b / c.sum()
    grad_a = minv.T @ grad_c
    return -np.outer(grad_a, c), grad_a


def weights_backward(grad_b, m, a):
    """the division by s is missing in grad_c

    told by: division by s | divided by s | divide by s | 1/s | 1 / s | by the sum
    """
    inverse = np.linalg.inv(m)
    c = inverse @ a
    b = c / np.sum(c)
    dot = 0.0
    for k in range(3):
        dot += grad_b[k] * b[k]
    grad_c = grad_b - dot
    grad_a = inverse.T @ grad_c
    return -np.outer(grad_a, c), grad_a


def weights_backward(grad_b, m, a):
    """grad_b . b is multiplied by b again, the rule for a vector normalised by its length

    told by: length | times b | euclid | multiplied by b | unit vector | b again
    """
    inverse = np.linalg.inv(m)
    c = inverse @ a
    s = c.sum()
    b = c / s
    grad_c = (grad_b - np.dot(grad_b, b) * b) / s
    grad_a = np.linalg.solve(m.T, grad_c)
    return -np.outer(grad_a, c), grad_a
