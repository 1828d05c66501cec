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


def quaternion_product(p, q):
    """the order is exchanged: this is q p, not p q

    told by: q p | order | exchanged | swapped | reversed | commut | first by p | cross product & sign
    """
    first, second = np.broadcast_arrays(q, p)
    w, u = first[..., :1], first[..., 1:]
    s, v = second[..., :1], second[..., 1:]
    scalar = w * s - (u * v).sum(-1, keepdims=True)
    return np.concatenate([scalar, w * v + s * u + np.cross(u, v)], -1)


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


def quaternion_matrix_backward(grad_matrix, q):
    """the derivative of 2 / |q|^2 is left out, so grad_q is not at right angles to q

    told by: right angle | length | |q|^2 | normali | perpendicular | orthogonal | along q
    """
    R = grad_matrix[:3, :3]
    w, K, s = q[0], cross_matrix(q[1:]), 2 / np.sum(q**2)
    by_K = w * R + R @ K.T + K.T @ R
    grad = [np.sum(R * K), by_K[2, 1] - by_K[1, 2], by_K[0, 2] - by_K[2, 0],
            by_K[1, 0] - by_K[0, 1]]
    return s * np.array(grad)


def rotation_angle(p, q):
    """it is forgotten that q and -q are the same rotation: angles beyond pi come out

    told by: -q | above pi | greater than pi | more than pi | beyond pi | same rotation | 2 pi | shorter | sign of q | exceed
    """
    apart = np.sqrt(((p - q)**2).sum(-1))
    together = np.sqrt(((p + q)**2).sum(-1))
    return 4 * np.arctan2(apart, together)


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


def uniform_laplacian(positions, edges):
    """each edge counts only for its first vertex: the way back, from the second to the first, is missing

    told by: direction | both ends | both vertices | one way | first vertex | second vertex | either order | one end | symmetr | revers & edge | one of their ends alone
    """
    result = np.zeros(np.shape(positions))
    for v in range(len(positions)):
        near = edges[edges[:, 0] == v, 1]
        if len(near):
            result[v] = positions[v] - positions[near].mean(0)
    return result


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    """it applies the forward pass again: each vertex divides by its own valence instead of its neighbour's

    told by: transpos | symmetr | forward | own valence | neighbour's valence | neighbours' valence | valence & neighbour | number of neighbours
    """
    return uniform_laplacian(grad_laplacian, edges)
