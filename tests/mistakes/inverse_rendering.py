"""Mistakes of lab 9; each docstring goes on after "this is what comes out when"."""


def squared_error_backward(grad_loss, picture, target):
    """the 2 of the square's derivative is missing"""
    return grad_loss * (picture - target) / picture.size


def squared_error_backward(grad_loss, picture, target):
    """it is not divided by the number of all pixels and channels"""
    return grad_loss * 2 * (picture - target)


def squared_error_backward(grad_loss, picture, target):
    """the sign is wrong: it is positive where the picture is too bright"""
    return grad_loss * 2 * (target - picture) / picture.size


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """the step goes uphill"""
    beta_1, beta_2, epsilon = constants
    mean = beta_1 * mean + (1 - beta_1) * grad_x
    square = beta_2 * square + (1 - beta_2) * grad_x**2
    corrected_mean, corrected_square = mean / (1 - beta_1**step), square / (1 - beta_2**step)
    return x + rate * corrected_mean / (np.sqrt(corrected_square) + epsilon), mean, square


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """mean and square are not corrected for their start at 0"""
    beta_1, beta_2, epsilon = constants
    mean = beta_1 * mean + (1 - beta_1) * grad_x
    square = beta_2 * square + (1 - beta_2) * grad_x**2
    corrected_mean, corrected_square = mean, square
    return x - rate * corrected_mean / (np.sqrt(corrected_square) + epsilon), mean, square


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """epsilon is under the root; it is added to the root"""
    beta_1, beta_2, epsilon = constants
    mean = beta_1 * mean + (1 - beta_1) * grad_x
    square = beta_2 * square + (1 - beta_2) * grad_x**2
    corrected_mean, corrected_square = mean / (1 - beta_1**step), square / (1 - beta_2**step)
    return x - rate * corrected_mean / (np.sqrt(corrected_square + epsilon)), mean, square


def quaternion_product(p, q):
    """p and q are swapped: the order of a product matters"""
    pw, px, py, pz = np.moveaxis(q, -1, 0)
    qw, qx, qy, qz = np.moveaxis(p, -1, 0)
    return np.stack([pw * qw - px * qx - py * qy - pz * qz,
                     pw * qx + px * qw + py * qz - pz * qy,
                     pw * qy + py * qw + pz * qx - px * qz,
                     pw * qz + pz * qw + px * qy - py * qx], -1)


def quaternion_product(p, q):
    """the scalar is taken for the last element; w is the first"""
    px, py, pz, pw = np.moveaxis(p, -1, 0)
    qx, qy, qz, qw = np.moveaxis(q, -1, 0)
    return np.stack([pw * qw - px * qx - py * qy - pz * qz,
                     pw * qx + px * qw + py * qz - pz * qy,
                     pw * qy + py * qw + pz * qx - px * qz,
                     pw * qz + pz * qw + px * qy - py * qx], -1)


def quaternion_product(p, q):
    """i i = -1 and its like are left out of the scalar"""
    pw, px, py, pz = np.moveaxis(p, -1, 0)
    qw, qx, qy, qz = np.moveaxis(q, -1, 0)
    return np.stack([pw * qw,
                     pw * qx + px * qw + py * qz - pz * qy,
                     pw * qy + py * qw + pz * qx - px * qz,
                     pw * qz + pz * qw + px * qy - py * qx], -1)


def quaternion_matrix(q):
    """it rotates the other way"""
    matrix, K = np.eye(4), cross_matrix(q[1:])
    matrix[:3, :3] += 2 / (q @ q) * (-q[0] * K + K @ K)
    return matrix


def quaternion_matrix(q):
    """q is taken to have length 1"""
    matrix, K = np.eye(4), cross_matrix(q[1:])
    matrix[:3, :3] += 2 * (q[0] * K + K @ K)
    return matrix


def quaternion_matrix(q):
    """a factor 2 is missing in what is added to the identity"""
    matrix, K = np.eye(4), cross_matrix(q[1:])
    matrix[:3, :3] += 1 / (q @ q) * (q[0] * K + K @ K)
    return matrix


def quaternion_matrix_backward(grad_matrix, q):
    """the length's share is left out: |q|^2 is taken for a constant"""
    G, K = grad_matrix[:3, :3], cross_matrix(q[1:])
    s, w = 2 / (q @ q), q[0]
    grad_K = s * (w * G + G @ K.T + K.T @ G)
    grad_xyz = [grad_K[2, 1] - grad_K[1, 2], grad_K[0, 2] - grad_K[2, 0],
                grad_K[1, 0] - grad_K[0, 1]]
    return np.append(s * (G * K).sum(), grad_xyz)


def quaternion_matrix_backward(grad_matrix, q):
    """grad_matrix is transposed"""
    G, K = grad_matrix[:3, :3].T, cross_matrix(q[1:])
    s, w = 2 / (q @ q), q[0]
    grad_K = s * (w * G + G @ K.T + K.T @ G)
    grad_xyz = [grad_K[2, 1] - grad_K[1, 2], grad_K[0, 2] - grad_K[2, 0],
                grad_K[1, 0] - grad_K[0, 1]]
    return np.append(s * (G * K).sum(), grad_xyz) - s**2 * (G * (w * K + K @ K)).sum() * q


def quaternion_matrix_backward(grad_matrix, q):
    """the gradient by x, y, z has the wrong sign"""
    G, K = grad_matrix[:3, :3], cross_matrix(q[1:])
    s, w = 2 / (q @ q), q[0]
    grad_K = s * (w * G + G @ K.T + K.T @ G)
    grad_xyz = [
        grad_K[2, 1] - grad_K[1, 2],
        grad_K[0, 2] - grad_K[2, 0],
        grad_K[1, 0] - grad_K[0, 1],
    ]
    return (
        np.append(s * (G * K).sum(), np.negative(grad_xyz)) - s**2 * (G * (w * K + K @ K)).sum() * q
    )


def rotation_angle(p, q):
    """an arccos loses the digits of small angles"""
    return 2 * np.arccos(np.minimum(np.abs((p * q).sum(-1)), 1))


def rotation_angle(p, q):
    """it is half of the angle"""
    diagonals = np.sort([np.linalg.norm(p - q, axis=-1), np.linalg.norm(p + q, axis=-1)], 0)
    return 2 * np.arctan2(diagonals[0], diagonals[1])


def rotation_angle(p, q):
    """q and -q are taken for two rotations: angles go beyond pi"""
    diagonals = np.stack([np.linalg.norm(p - q, axis=-1), np.linalg.norm(p + q, axis=-1)], 0)
    return 4 * np.arctan2(diagonals[0], diagonals[1])


def silhouette_loss(coverage, target):
    """it is the overlap itself; the loss is 1 less that"""
    return (coverage * target).sum() / (coverage + target - coverage * target).sum()


def silhouette_loss(coverage, target):
    """the union counts the overlap twice"""
    return 1 - (coverage * target).sum() / (coverage + target).sum()


def silhouette_loss(coverage, target):
    """it is the Dice loss: twice the overlap by the sum of both"""
    return 1 - 2 * (coverage * target).sum() / (coverage + target).sum()


def silhouette_loss_backward(grad_loss, coverage, target):
    """the union is taken for a constant"""
    return grad_loss * -target / (coverage + target - coverage * target).sum()


def silhouette_loss_backward(grad_loss, coverage, target):
    """the sign is wrong: to cover the target makes the loss less"""
    both, either = (coverage * target).sum(), (coverage + target - coverage * target).sum()
    return grad_loss * -(both / either * (1 - target) - target) / either


def silhouette_loss_backward(grad_loss, coverage, target):
    """A dU is divided by U once; it is by U^2"""
    both, either = (coverage * target).sum(), (coverage + target - coverage * target).sum()
    return grad_loss * (both * (1 - target) - target) / either


def uniform_laplacian(positions, edges):
    """the sign is wrong: d points from the neighbours' mean to the vertex"""
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    total = scatter(positions[neighbour], vertex, len(positions))
    return np.where(valence > 0, total / np.maximum(valence, 1) - positions, 0)


def uniform_laplacian(positions, edges):
    """the neighbours are summed; it is their mean"""
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    total = scatter(positions[neighbour], vertex, len(positions))
    return np.where(valence > 0, positions - total, 0)


def uniform_laplacian(positions, edges):
    """of a vertex's neighbours only the last one counts: += with an index adds once"""
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    total = np.zeros(positions.shape)
    total[vertex] = positions[neighbour]
    return np.where(valence > 0, positions - total / np.maximum(valence, 1), 0)


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    """it is the forward once more; the matrix must be transposed"""
    return uniform_laplacian(grad_laplacian, edges)


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    """a neighbour gets the whole gradient, not its share of it"""
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    share = grad_laplacian
    total = scatter(share[vertex], neighbour, len(positions))
    return np.where(valence > 0, grad_laplacian, 0) - total


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    """of a vertex's neighbours only the last one counts: += with an index adds once"""
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    share = grad_laplacian / np.maximum(valence, 1)
    total = np.zeros(positions.shape)
    total[neighbour] = share[vertex]
    return np.where(valence > 0, grad_laplacian, 0) - total
