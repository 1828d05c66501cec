"""Lab 9 as printed: what one types who has read the questions and the equations."""


def squared_error_backward(grad_loss, picture, target):
    return grad_loss * 2 * (picture - target) / picture.size


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    b1, b2, epsilon = constants
    m = b1 * mean + (1 - b1) * grad_x
    s = b2 * square + (1 - b2) * grad_x**2
    m_hat = m / (1 - b1**step)
    s_hat = s / (1 - b2**step)
    return x - rate * m_hat / (np.sqrt(s_hat) + epsilon), m, s


def quaternion_matrix(q):
    matrix = np.eye(4)
    for k in range(3):
        v = np.zeros(4)
        v[k + 1] = 1
        conjugate = q * [1, -1, -1, -1]
        rotated = quaternion_product(quaternion_product(q, v), conjugate) / (q**2).sum()
        matrix[:3, k] = rotated[1:]
    return matrix


def silhouette_loss(coverage, target):
    return 1 - (coverage * target).sum() / (coverage + target - coverage * target).sum()


def silhouette_loss_backward(grad_loss, coverage, target):
    a = (coverage * target).sum()
    u = (coverage + target - coverage * target).sum()
    return grad_loss * ((1 - target) * a / u**2 - target / u)
