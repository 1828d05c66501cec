"""Mistakes of lab 9; each docstring goes on after "this is what comes out when"."""


def squared_error_backward(grad_loss, picture, target):
    """the factor 2 of the square's derivative is missing"""
    return grad_loss * (picture - target) / picture.size


def squared_error_backward(grad_loss, picture, target):
    """it is not divided by the number of values: the loss is their mean, not their sum"""
    return grad_loss * 2 * (picture - target)


def squared_error_backward(grad_loss, picture, target):
    """it is divided by the number of pixels only; the mean is over the channels as well"""
    return grad_loss * 2 * (picture - target) / np.prod(picture.shape[:2])


def squared_error_backward(grad_loss, picture, target):
    """it is divided by len(picture), the number of rows only, not by that of all values"""
    return grad_loss * 2 * (picture - target) / len(picture)


def squared_error_backward(grad_loss, picture, target):
    """the factor 2 and the division by the number of values are both missing"""
    return grad_loss * (picture - target)


def squared_error_backward(grad_loss, picture, target):
    """the difference is still squared: the derivative of a square has power 1"""
    return grad_loss * 2 * (picture - target)**2 / picture.size


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """the step goes uphill: the sign before the rate is wrong"""
    beta_1, beta_2, epsilon = constants
    mean = beta_1 * mean + (1 - beta_1) * grad_x
    square = beta_2 * square + (1 - beta_2) * grad_x**2
    corrected_mean, corrected_square = mean / (1 - beta_1**step), square / (1 - beta_2**step)
    return x + rate * corrected_mean / (np.sqrt(corrected_square) + epsilon), mean, square


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """the bias correction is missing: m and s, not m^ and s^, make the step"""
    beta_1, beta_2, epsilon = constants
    mean = beta_1 * mean + (1 - beta_1) * grad_x
    square = beta_2 * square + (1 - beta_2) * grad_x**2
    corrected_mean, corrected_square = mean, square
    return x - rate * corrected_mean / (np.sqrt(corrected_square) + epsilon), mean, square


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """epsilon is inside of the square root; it is added to the root"""
    beta_1, beta_2, epsilon = constants
    mean = beta_1 * mean + (1 - beta_1) * grad_x
    square = beta_2 * square + (1 - beta_2) * grad_x**2
    corrected_mean, corrected_square = mean / (1 - beta_1**step), square / (1 - beta_2**step)
    return x - rate * corrected_mean / (np.sqrt(corrected_square + epsilon)), mean, square


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """m^ and s^ are returned in place of m' and s': the next step corrects them again"""
    beta_1, beta_2, epsilon = constants
    mean = (beta_1 * mean + (1 - beta_1) * grad_x) / (1 - beta_1**step)
    square = (beta_2 * square + (1 - beta_2) * grad_x**2) / (1 - beta_2**step)
    return x - rate * mean / (np.sqrt(square) + epsilon), mean, square


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """b and 1 - b are exchanged: the weights of the old value and of the new one are swapped"""
    beta_1, beta_2, epsilon = constants
    mean = (1 - beta_1) * mean + beta_1 * grad_x
    square = (1 - beta_2) * square + beta_2 * grad_x**2
    corrected_mean, corrected_square = mean / (1 - beta_1**step), square / (1 - beta_2**step)
    return x - rate * corrected_mean / (np.sqrt(corrected_square) + epsilon), mean, square


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """the square root is missing: m^ is divided by s^ itself"""
    beta_1, beta_2, epsilon = constants
    mean = beta_1 * mean + (1 - beta_1) * grad_x
    square = beta_2 * square + (1 - beta_2) * grad_x**2
    corrected_mean, corrected_square = mean / (1 - beta_1**step), square / (1 - beta_2**step)
    return x - rate * corrected_mean / (corrected_square + epsilon), mean, square


def quaternion_product(p, q):
    """p and q are swapped: it is q p, and the cross product has the other sign"""
    pw, px, py, pz = np.moveaxis(q, -1, 0)
    qw, qx, qy, qz = np.moveaxis(p, -1, 0)
    return np.stack([pw * qw - px * qx - py * qy - pz * qz,
                     pw * qx + px * qw + py * qz - pz * qy,
                     pw * qy + py * qw + pz * qx - px * qz,
                     pw * qz + pz * qw + px * qy - py * qx], -1)


def quaternion_product(p, q):
    """w is taken for the last of the four numbers; it is the first"""
    px, py, pz, pw = np.moveaxis(p, -1, 0)
    qx, qy, qz, qw = np.moveaxis(q, -1, 0)
    return np.stack([pw * qw - px * qx - py * qy - pz * qz,
                     pw * qx + px * qw + py * qz - pz * qy,
                     pw * qy + py * qw + pz * qx - px * qz,
                     pw * qz + pz * qw + px * qy - py * qx], -1)


def quaternion_product(p, q):
    """w is taken for the last of the four numbers, (x, y, z, w), in the result, too; it is the
    first"""
    px, py, pz, pw = np.moveaxis(p, -1, 0)
    qx, qy, qz, qw = np.moveaxis(q, -1, 0)
    return np.stack([pw * qx + px * qw + py * qz - pz * qy,
                     pw * qy + py * qw + pz * qx - px * qz,
                     pw * qz + pz * qw + px * qy - py * qx,
                     pw * qw - px * qx - py * qy - pz * qz], -1)


def quaternion_product(p, q):
    """the squares of i, j and k count as +1 in w; they are -1"""
    pw, px, py, pz = np.moveaxis(p, -1, 0)
    qw, qx, qy, qz = np.moveaxis(q, -1, 0)
    return np.stack([pw * qw + px * qx + py * qy + pz * qz,
                     pw * qx + px * qw + py * qz - pz * qy,
                     pw * qy + py * qw + pz * qx - px * qz,
                     pw * qz + pz * qw + px * qy - py * qx], -1)


def quaternion_product(p, q):
    """the cross product of the two vectors is missing"""
    w = p[..., :1] * q[..., :1] - (p[..., 1:] * q[..., 1:]).sum(-1, keepdims=True)
    return np.concatenate([w, p[..., :1] * q[..., 1:] + q[..., :1] * p[..., 1:]], -1)


def quaternion_matrix(q):
    """it rotates the other way: the matrix is transposed"""
    matrix, K = np.eye(4), cross_matrix(q[1:])
    matrix[:3, :3] += 2 / (q @ q) * (-q[0] * K + K @ K)
    return matrix


def quaternion_matrix(q):
    """q is not normalised: it is right for length 1 alone"""
    matrix, K = np.eye(4), cross_matrix(q[1:])
    matrix[:3, :3] += 2 * (q[0] * K + K @ K)
    return matrix


def quaternion_matrix(q):
    """a factor 2 is missing in what is added to the identity"""
    matrix, K = np.eye(4), cross_matrix(q[1:])
    matrix[:3, :3] += 1 / (q @ q) * (q[0] * K + K @ K)
    return matrix


def quaternion_matrix(q):
    """w is taken for the last of the four numbers, the scalar; it is the first"""
    matrix, K = np.eye(4), cross_matrix(q[:3])
    matrix[:3, :3] += 2 / (q @ q) * (q[3] * K + K @ K)
    return matrix


def quaternion_matrix(q):
    """it is q v alone: q* behind it is missing"""
    matrix = np.eye(4)
    matrix[:3, :3] = (q[0] * np.eye(3) + cross_matrix(q[1:])) / np.linalg.norm(q)
    return matrix


def quaternion_matrix(q):
    """q v q* is divided by the length |q|; it is divided by the square of the length"""
    matrix, K = np.eye(4), cross_matrix(q[1:])
    matrix[:3, :3] += 2 / (q @ q) * (q[0] * K + K @ K)
    matrix[:3, :3] *= np.sqrt(q @ q)
    return matrix


def quaternion_matrix_backward(grad_matrix, q):
    """|q|^2 is taken for a constant: the length's share, along q, is left out"""
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
    """the gradient with respect to x, y and z has the wrong sign in the terms of K"""
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


def quaternion_matrix_backward(grad_matrix, q):
    """K K is derived like K times a constant: the product rule's second term is left out"""
    G, K = grad_matrix[:3, :3], cross_matrix(q[1:])
    s, w = 2 / (q @ q), q[0]
    grad_K = s * (w * G + G @ K.T)
    grad_xyz = [grad_K[2, 1] - grad_K[1, 2], grad_K[0, 2] - grad_K[2, 0],
                grad_K[1, 0] - grad_K[0, 1]]
    return np.append(s * (G * K).sum(), grad_xyz) - s**2 * (G * (w * K + K @ K)).sum() * q


def quaternion_matrix_backward(grad_matrix, q):
    """a factor 2 is missing: all is half of the gradient"""
    G, K = grad_matrix[:3, :3], cross_matrix(q[1:])
    s, w = 1 / (q @ q), q[0]
    grad_K = s * (w * G + G @ K.T + K.T @ G)
    grad_xyz = [grad_K[2, 1] - grad_K[1, 2], grad_K[0, 2] - grad_K[2, 0],
                grad_K[1, 0] - grad_K[0, 1]]
    return np.append(s * (G * K).sum(), grad_xyz) - 2 * s**2 * (G * (w * K + K @ K)).sum() * q


def rotation_angle(p, q):
    """an arccos loses the digits of small angles"""
    return 2 * np.arccos(np.minimum(np.abs((p * q).sum(-1)), 1))


def rotation_angle(p, q):
    """it is half of the angle: q rotates by twice the angle in it"""
    diagonals = np.sort([np.linalg.norm(p - q, axis=-1), np.linalg.norm(p + q, axis=-1)], 0)
    return 2 * np.arctan2(diagonals[0], diagonals[1])


def rotation_angle(p, q):
    """q and -q are taken for two different rotations: the absolute value is missing"""
    diagonals = np.stack([np.linalg.norm(p - q, axis=-1), np.linalg.norm(p + q, axis=-1)], 0)
    return 4 * np.arctan2(diagonals[0], diagonals[1])


def rotation_angle(p, q):
    """it is in degrees; angles are in radians"""
    return 2 * np.degrees(np.arccos(np.minimum(np.abs((p * q).sum(-1)), 1)))


def silhouette_loss(coverage, target):
    """it is the overlap itself, intersection over union; the loss is 1 minus that"""
    return (coverage * target).sum() / (coverage + target - coverage * target).sum()


def silhouette_loss(coverage, target):
    """the union is c + t and counts the overlap twice: - c t is missing"""
    return 1 - (coverage * target).sum() / (coverage + target).sum()


def silhouette_loss(coverage, target):
    """it is the Dice loss: twice the overlap by the sum of both"""
    return 1 - 2 * (coverage * target).sum() / (coverage + target).sum()


def silhouette_loss(coverage, target):
    """it is the mean of the pixels' own ratios, not the ratio of the sums"""
    union = coverage + target - coverage * target
    return 1 - np.where(union > 0, coverage * target / np.where(union > 0, union, 1), 1).mean()


def silhouette_loss(coverage, target):
    """the minimum and the maximum of c and t are summed, not c t and c + t - c t"""
    return 1 - np.minimum(coverage, target).sum() / np.maximum(coverage, target).sum()


def silhouette_loss(coverage, target):
    """coverage and target are rounded to 0 or 1, covered or not; the soft loss takes them as they
    are"""
    c, t = coverage > 0.5, target > 0.5
    return 1 - (c & t).sum() / (c | t).sum()


def silhouette_loss_backward(grad_loss, coverage, target):
    """the union is taken for a constant"""
    return grad_loss * -target / (coverage + target - coverage * target).sum()


def silhouette_loss_backward(grad_loss, coverage, target):
    """the sign is wrong: it is the gradient of the overlap, not of 1 minus it"""
    both, either = (coverage * target).sum(), (coverage + target - coverage * target).sum()
    return grad_loss * -(both / either * (1 - target) - target) / either


def silhouette_loss_backward(grad_loss, coverage, target):
    """A dU is divided by U; the quotient rule divides it by U^2, the square of the union"""
    both, either = (coverage * target).sum(), (coverage + target - coverage * target).sum()
    return grad_loss * (both * (1 - target) - target) / either


def silhouette_loss_backward(grad_loss, coverage, target):
    """all is divided by the union U; the quotient rule's denominator is U^2"""
    both, either = (coverage * target).sum(), (coverage + target - coverage * target).sum()
    return grad_loss * (both * (1 - target) - either * target) / either


def silhouette_loss_backward(grad_loss, coverage, target):
    """the union's derivative is taken for 1; it is 1 - t, as the union c + t - c t has the product
    c t in it"""
    both, either = (coverage * target).sum(), (coverage + target - coverage * target).sum()
    return grad_loss * (both / either - target) / either


def silhouette_loss_backward(grad_loss, coverage, target):
    """coverage and target are exchanged: it is the gradient with respect to target"""
    both, either = (coverage * target).sum(), (coverage + target - coverage * target).sum()
    return grad_loss * (both / either * (1 - coverage) - coverage) / either


def uniform_laplacian(positions, edges):
    """the sign is wrong: it is the mean of the neighbours minus x"""
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    total = scatter(positions[neighbour], vertex, len(positions))
    return np.where(valence > 0, total / np.maximum(valence, 1) - positions, 0)


def uniform_laplacian(positions, edges):
    """the neighbours are summed, not averaged: x minus their sum"""
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    total = scatter(positions[neighbour], vertex, len(positions))
    return np.where(valence > 0, positions - total, 0)


def uniform_laplacian(positions, edges):
    """the differences to the neighbours are summed, not divided by their number, the valence"""
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    return scatter(positions[vertex] - positions[neighbour], vertex, len(positions))


def uniform_laplacian(positions, edges):
    """of a vertex's neighbours only the last one counts: += with an index adds once"""
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    total = np.zeros(positions.shape)
    total[vertex] = positions[neighbour]
    return np.where(valence > 0, positions - total / np.maximum(valence, 1), 0)


def uniform_laplacian(positions, edges):
    """each edge counts in one direction only, for its first vertex alone: its second one must see
    the first, too"""
    vertex, neighbour = edges.T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    total = scatter(positions[neighbour], vertex, len(positions))
    return np.where(valence > 0, positions - total / np.maximum(valence, 1), 0)


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    """it is the forward once more, divided by the receiver's valence; its matrix must be
    transposed
    """
    return uniform_laplacian(grad_laplacian, edges)


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    """a neighbour gets the whole gradient, not its share of it"""
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    share = grad_laplacian
    total = scatter(share[vertex], neighbour, len(positions))
    return np.where(valence > 0, grad_laplacian, 0) - total


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    """a vertex without edges keeps its gradient; it gets 0"""
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    share = grad_laplacian / np.maximum(valence, 1)
    return grad_laplacian - scatter(share[vertex], neighbour, len(positions))


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    """of a vertex's neighbours only the last one counts: += with an index adds once"""
    vertex, neighbour = np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=len(positions))[:, None]
    share = grad_laplacian / np.maximum(valence, 1)
    total = np.zeros(positions.shape)
    total[neighbour] = share[vertex]
    return np.where(valence > 0, grad_laplacian, 0) - total
