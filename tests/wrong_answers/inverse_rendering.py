"""Wrong answers to inverse_rendering, written without a look at the checks."""


def squared_error_backward(grad_loss, picture, target):
    """the factor 2 of the square's derivative is missing

    told by: factor & 2 | half | twice | factor & two | 0.5 | 1/2 | 2 (I - T)
    """
    return grad_loss * (picture - target) / picture.size


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """mean and square are changed in place, so the caller's arrays are overwritten

    told by: in place | overwr | modif & input | changes & argument | caller | input & changed | *= | copy
    """
    b1, b2, tiny = constants
    mean *= b1
    mean += (1 - b1) * grad_x
    square *= b2
    square += (1 - b2) * grad_x**2
    m_hat = mean / (1 - b1**step)
    s_hat = square / (1 - b2**step)
    return x - rate * m_hat / (np.sqrt(s_hat) + tiny), mean, square


def quaternion_matrix(q):
    """the matrix is transposed: the rotated axes are its rows, not its columns, so it turns backwards

    told by: transpos | inverse rotation | rows & columns | backward & rot | other way & rot | opposite & rot | row vector | conjugate
    """
    matrix = np.eye(4)
    conj = q * np.array([1, -1, -1, -1])
    for axis in range(3):
        unit = np.zeros(4)
        unit[axis + 1] = 1
        turned = quaternion_product(quaternion_product(q, unit), conj) / (q * q).sum()
        matrix[axis, :3] = turned[1:]
    return matrix


def silhouette_loss(coverage, target):
    """the union is c + t: the overlap c t is not subtracted, so it is counted twice

    told by: overlap | counted twice | c + t - c t | - c t | union & twice | subtract & intersection | union & c + t | dice
    """
    inter = np.sum(coverage * target)
    return 1 - inter / (np.sum(coverage) + np.sum(target))


def silhouette_loss_backward(grad_loss, coverage, target):
    """the union's derivative is taken to be 1, but it is 1 - t

    told by: 1 - t | (1 - t) | derivative & union | union & factor | - c t & deriv | overlap & union | gradient & union
    """
    A = (coverage * target).sum()
    U = (coverage + target - coverage * target).sum()
    dA, dU = target, np.ones_like(coverage)
    return -grad_loss * (dA * U - A * dU) / U**2
