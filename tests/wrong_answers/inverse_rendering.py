"""Wrong answers to inverse_rendering, written without a look at the checks."""


def squared_error_backward(grad_loss, picture, target):
    """the factor 2 of the square's derivative is missing

    told by: factor 2 | half | factor of 2 | factor of two | twice | times 2
    """
    return grad_loss * (picture - target) / picture.size


def squared_error_backward(grad_loss, picture, target):
    """divided by the number of pixels only, not by the number of all values with the channels

    told by: channels | number of pixels | per pixel | H W
    """
    pixels = np.prod(picture.shape[:-1])
    return grad_loss * 2 * (picture - target) / pixels


def squared_error_backward(grad_loss, picture, target):
    """not divided by the number of values: the derivative of the sum, not of the mean

    told by: mean | number of values | sum instead | not divided | divide by | derivative of the sum
    """
    return grad_loss * 2 * (picture - target)


def squared_error_backward(grad_loss, picture, target):
    """the squared difference is used where the difference belongs

    told by: squared diff | square of the diff | power | difference & squared | quadratic
    """
    grad = np.zeros(picture.shape)
    for index in np.ndindex(*picture.shape):
        grad[index] = 2 * grad_loss * (picture[index] - target[index])**2 / picture.size
    return grad


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """the corrected m^ and s^ are returned in place of m' and s', so that the next step corrects them again

    told by: return & corrected | corrected & instead | corrected & in place of | corrected twice | keeps the corrected | corrects them again
    """
    b1, b2, eps = constants
    m = (b1 * mean + (1 - b1) * grad_x) / (1 - b1**step)
    s = (b2 * square + (1 - b2) * grad_x**2) / (1 - b2**step)
    return x - rate * m / (np.sqrt(s) + eps), m, s


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """epsilon is added inside of the square root

    told by: epsilon & root | epsilon & inside | epsilon & sqrt | sqrt(s^ + epsilon) | epsilon & under
    """
    b1, b2, eps = constants
    mean = b1 * mean + (1 - b1) * grad_x
    square = b2 * square + (1 - b2) * grad_x * grad_x
    m_hat, s_hat = mean / (1 - b1**step), square / (1 - b2**step)
    return x - rate * m_hat / np.sqrt(s_hat + eps), mean, square


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """b1 and 1 - b1 are exchanged, as are b2 and 1 - b2

    told by: 1 - b1 & exchanged | weights & exchanged | swapped | old and new | b1 g | mixed up
    """
    b1, b2, eps = constants
    mean = (1 - b1) * mean + b1 * grad_x
    square = (1 - b2) * square + b2 * grad_x**2
    m_hat = mean / (1 - b1**step)
    s_hat = square / (1 - b2**step)
    return x - rate * m_hat / (np.sqrt(s_hat) + eps), mean, square


def quaternion_product(p, q):
    """the factors are exchanged: q p instead of p q, so that the cross product has the other sign

    told by: q p | factors & exchanged | swapped | revers | order of the factors | cross product & sign
    """
    w = p[..., 0] * q[..., 0] - (p[..., 1:] * q[..., 1:]).sum(-1)
    u = p[..., :1] * q[..., 1:] + q[..., :1] * p[..., 1:] - np.cross(p[..., 1:], q[..., 1:])
    return np.concatenate([w[..., None], u], -1)


def quaternion_product(p, q):
    """the squares of i, j, k count as +1 in w

    told by: squares of i | squares & -1 | sign & dot | counts as +1 | count as +1 | i^2
    """
    pw, px, py, pz = np.moveaxis(p, -1, 0)
    qw, qx, qy, qz = np.moveaxis(q, -1, 0)
    return np.stack([pw * qw + px * qx + py * qy + pz * qz,
                     pw * qx + px * qw + py * qz - pz * qy,
                     pw * qy + py * qw + pz * qx - px * qz,
                     pw * qz + pz * qw + px * qy - py * qx], -1)


def quaternion_matrix(q):
    """the transpose: it rotates the other way, as for points that are row vectors

    told by: transpos | other way | inverse rotation | row vector | opposite direction | backwards
    """
    w, x, y, z = q / np.linalg.norm(q)
    m = np.eye(4)
    m[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
                 [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
                 [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]]
    return m


def quaternion_matrix(q):
    """q is not normalised: only length 1 is right

    told by: normali | length | unit quaternion | scale
    """
    w, x, y, z = q
    return np.array([
        [1 - 2 * (y**2 + z**2), 2 * (x * y - w * z), 2 * (x * z + w * y), 0],
        [2 * (x * y + w * z), 1 - 2 * (x**2 + z**2), 2 * (y * z - w * x), 0],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x**2 + y**2), 0],
        [0, 0, 0, 1]])


def quaternion_matrix(q):
    """w is taken to be the last of the four numbers, (x, y, z, w)

    told by: (x, y, z, w) | w comes last | scalar last | order of the numbers | w is first | scalar & last
    """
    x, y, z, w = q / np.sqrt((q * q).sum())
    m = np.eye(4)
    m[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                 [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                 [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return m


def quaternion_matrix(q):
    """only q v without the q* behind it: the rotation is one-sided

    told by: q* | conjugate | only q v | one-sided | half the angle | second product
    """
    q = q / np.linalg.norm(q)
    matrix = np.eye(4)
    for k in range(3):
        v = np.zeros(4)
        v[k + 1] = 1.0
        matrix[:3, k] = quaternion_product(q, v)[1:]
    return matrix


def quaternion_matrix(q):
    """divided by the length |q|, not by its square

    told by: square & length | divided by & length | length squared | norm
    """
    matrix = np.eye(4)
    conjugate = q * np.array([1, -1, -1, -1])
    for k in range(3):
        v = np.zeros(4)
        v[k + 1] = 1.0
        matrix[:3, k] = quaternion_product(quaternion_product(q, v), conjugate)[1:]
    matrix[:3, :3] /= np.linalg.norm(q)
    return matrix


def quaternion_matrix(q):
    """a matrix (3, 3) without the homogeneous row and column

    told by: shape | (3, 3) | homogeneous | 3 x 3 | 4 x 4 | (4, 4)
    """
    K = cross_matrix(q[1:])
    return np.eye(3) + 2 / (q @ q) * (q[0] * K + K @ K)


def quaternion_matrix_backward(grad_matrix, q):
    """the length's share is left out: grad_q is not at right angles to q

    told by: length | right angles | normali | perpendicular | orthogonal | along q
    """
    G = grad_matrix[:3, :3]
    K = cross_matrix(q[1:])
    s = 2 / (q @ q)
    grad_K = s * (q[0] * G + G @ K.T + K.T @ G)
    return np.array([s * (G * K).sum(), grad_K[2, 1] - grad_K[1, 2],
                     grad_K[0, 2] - grad_K[2, 0], grad_K[1, 0] - grad_K[0, 1]])


def quaternion_matrix_backward(grad_matrix, q):
    """the gradient of the transposed matrix: x, y and z have the wrong sign in the terms with w

    told by: transpos | inverse rotation | other way | terms with w | rows & columns
    """
    G = grad_matrix[:3, :3].T
    K = cross_matrix(q[1:])
    s = 2 / (q @ q)
    w = q[0]
    grad_K = s * (w * G + G @ K.T + K.T @ G)
    grad_xyz = [grad_K[2, 1] - grad_K[1, 2], grad_K[0, 2] - grad_K[2, 0],
                grad_K[1, 0] - grad_K[0, 1]]
    return np.append(s * (G * K).sum(), grad_xyz) - s**2 * (G * (w * K + K @ K)).sum() * q


def quaternion_matrix_backward(grad_matrix, q):
    """the product rule's second term is left out: K K is derived like K times a constant

    told by: product rule | K K | second term | both factors | quadratic
    """
    G = grad_matrix[:3, :3]
    K = cross_matrix(q[1:])
    s = 2 / (q @ q)
    grad_K = s * (q[0] * G + G @ K.T)
    grad_xyz = [grad_K[2, 1] - grad_K[1, 2], grad_K[0, 2] - grad_K[2, 0],
                grad_K[1, 0] - grad_K[0, 1]]
    direct = np.append(s * (G * K).sum(), grad_xyz)
    return direct - s**2 * (G * (q[0] * K + K @ K)).sum() * q


def rotation_angle(p, q):
    """q and -q count as different rotations: the absolute value is missing, and angles go up to 2 pi

    told by: and -q | absolute | same rotation | 2 pi | greater than pi | above pi
    """
    return 2 * np.arccos(np.clip(np.einsum("...i,...i", p, q), -1, 1))


def silhouette_loss(coverage, target):
    """the union is the sum c + t: the intersection is counted twice

    told by: counted twice | union | c t | c + t | denominator | overlap
    """
    overlap = np.sum(coverage * target)
    return 1 - overlap / (np.sum(coverage) + np.sum(target))


def silhouette_loss(coverage, target):
    """the mean of the pixels' own ratios instead of the ratio of the sums

    told by: ratio of | ratios | mean of the pixels | pixel by pixel | quotient of the sums | of the sums
    """
    total, n = 0.0, 0
    for c, t in zip(np.ravel(coverage), np.ravel(target)):
        union = c + t - c * t
        total += c * t / union if union > 0 else 1.0
        n += 1
    return 1 - total / n


def silhouette_loss(coverage, target):
    """intersection and union are those of fuzzy sets, minimum and maximum, not product and c + t - c t

    told by: minimum | maximum | max and min | fuzzy | product c t | min(
    """
    return 1 - np.minimum(coverage, target).sum() / np.maximum(coverage, target).sum()


def silhouette_loss_backward(grad_loss, coverage, target):
    """the sign is flipped: the gradient of the IoU, not of 1 - IoU

    told by: sign | minus | 1 - IoU | negat | uphill | opposite
    """
    both = (coverage * target).sum()
    either = (coverage + target - coverage * target).sum()
    return grad_loss * (target / either - both / either**2 * (1 - target))


def silhouette_loss_backward(grad_loss, coverage, target):
    """the derivative by target is returned: coverage and target are exchanged

    told by: exchanged | swapped | with respect to target | by target | with respect to the target | by the target
    """
    A = (coverage * target).sum()
    U = (coverage + target - coverage * target).sum()
    return grad_loss * (A * (1 - coverage) - U * coverage) / U**2


def silhouette_loss_backward(grad_loss, coverage, target):
    """the quotient rule's denominator is U, not U^2

    told by: U^2 | union squared | square of & union | denominator | divided by & union
    """
    A = (coverage * target).sum()
    U = (coverage + target - coverage * target).sum()
    return -grad_loss * (target * U - A * (1 - target)) / U


def silhouette_loss_backward(grad_loss, coverage, target):
    """grad_loss is forgotten

    told by: grad_loss | chain rule | upstream | incoming
    """
    A = (coverage * target).sum()
    U = (coverage + target - coverage * target).sum()
    return -(target * U - A * (1 - target)) / U**2


def uniform_laplacian(positions, edges):
    """the sum over the neighbours instead of their mean: not divided by the valence

    told by: mean | valence | sum | divided | number of neighbours | degree
    """
    d = np.zeros(positions.shape)
    for a, b in edges:
        d[a] += positions[a] - positions[b]
        d[b] += positions[b] - positions[a]
    return d


def uniform_laplacian(positions, edges):
    """the sign is flipped: mean of the neighbours minus x_v

    told by: sign | negat | minus | other way round | mean - x
    """
    n = len(positions)
    A = np.zeros((n, n))
    A[edges[:, 0], edges[:, 1]] = 1
    A[edges[:, 1], edges[:, 0]] = 1
    valence = A.sum(1, keepdims=True)
    return np.where(valence > 0, A @ positions / np.maximum(valence, 1) - positions, 0)


def uniform_laplacian(positions, edges):
    """a vertex without edges keeps its position as d, not 0

    told by: without edges | no edges | no neighbour | isolated | valence 0 | without neighbour
    """
    d = positions.astype(float)
    for v in range(len(positions)):
        near = [b if a == v else a for a, b in edges.tolist() if v in (a, b)]
        if near:
            d[v] = positions[v] - positions[near].mean(0)
    return d


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    """the matrix instead of its transpose: the forward Laplacian of the gradient, divided by the valence of the receiving vertex

    told by: transpos | symmetric | valence | forward | uniform_laplacian itself | receiv
    """
    return uniform_laplacian(grad_laplacian, edges)


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    """a vertex without edges keeps its gradient, where it should get 0

    told by: without edges | no edges | no neighbour | isolated | valence 0 | without neighbour
    """
    grad = grad_laplacian.astype(float)
    valence = np.bincount(edges.ravel(), minlength=len(positions))
    for a, b in edges:
        grad[b] -= grad_laplacian[a] / valence[a]
        grad[a] -= grad_laplacian[b] / valence[b]
    return grad
