"""Wrong answers to inverse_rendering, written without a look at the checks."""


def squared_error_backward(grad_loss, picture, target):
    """the factor 2 of the square's derivative is missing

    told by: factor & 2 | half | twice | factor & two | 0.5 | 1/2 | 2 (I - T)
    """
    return grad_loss * (picture - target) / picture.size


def squared_error_backward(grad_loss, picture, target):
    """the sign is wrong: it has target - picture

    told by: sign | minus | negat | target - picture | opposite
    """
    return 2 * grad_loss / np.size(target) * (target - picture)


def squared_error_backward(grad_loss, picture, target):
    """it divides by the number of pixels only, but the mean is also over the channels

    told by: channel | number of pixels | picture.size | last axis | count & mean
    """
    pixels = np.prod(picture.shape[:-1])
    return grad_loss * 2 * (picture - target) / pixels


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """the correction by 1 - b^n is missing, so the means are too small at first

    told by: correct | bias | 1 - b | m^ | too small & first | first steps | m-hat | 1 - b1^n
    """
    b1, b2, tiny = constants
    m = b1 * mean + (1 - b1) * grad_x
    s = b2 * square + (1 - b2) * grad_x * grad_x
    return x - rate * m / (np.sqrt(s) + tiny), m, s


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """it returns the corrected m^ and s^ in the place of m' and s', so the next step corrects them again

    told by: correct & return | return & m^ | m^ & m' | corrected & instead | corrected mean | before the correction | uncorrected | already corrected | mean & 1 - b
    """
    b1, b2, tiny = constants
    mean = (b1 * mean + (1 - b1) * grad_x) / (1 - b1**step)
    square = (b2 * square + (1 - b2) * grad_x**2) / (1 - b2**step)
    return x - rate * mean / (np.sqrt(square) + tiny), mean, square


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """it divides by s^ instead of by its square root

    told by: square root | root of | sqrt | by s^ itself | s^ & instead
    """
    b1, b2, tiny = constants
    m = mean + (1 - b1) * (grad_x - mean)
    s = square + (1 - b2) * (grad_x**2 - square)
    m_hat, s_hat = m / (1 - b1**step), s / (1 - b2**step)
    return x - rate * m_hat / (s_hat + tiny), m, s


def quaternion_product(p, q):
    """it is the product q p: the factors are in the wrong order

    told by: product q p | order | revers | swap | exchang | commut | cross & sign
    """
    p, q = np.broadcast_arrays(p, q)
    pw, qw, u, v = p[..., :1], q[..., :1], p[..., 1:], q[..., 1:]
    real = pw * qw - (u * v).sum(-1, keepdims=True)
    rest = pw * v + qw * u + np.cross(v, u)
    return np.concatenate([real, rest], -1)


def quaternion_matrix(q):
    """it divides by |q|, not by |q|^2

    told by: |q|^2 | squared length | length & squar | norm & squar | |q| & divi | length | normali
    """
    matrix = np.eye(4)
    K = cross_matrix(q[1:])
    matrix[:3, :3] += 2 * (q[0] * K + K @ K) / np.linalg.norm(q)
    return matrix


def quaternion_matrix(q):
    """it rotates the other way: the matrix is transposed, as for q* v q

    told by: transpos | other way | inverse | q* v q | opposite & rotat | opposite & direction | backward | row vector | wrong direction | wrong way
    """
    w, x, y, z = q / np.sqrt((q**2).sum())
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0],
                     [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0],
                     [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0],
                     [0, 0, 0, 1]])


def quaternion_matrix(q):
    """the real part w is taken to be the last number of q, not the first

    told by: (x, y, z, w) | w & last | w & first | real part | scalar & last | order & q | w comes
    """
    matrix = np.identity(4)
    unit = q / np.linalg.norm(q)
    conjugate = unit * [-1, -1, -1, 1]

    def product(p, r):
        return np.append(p[3] * r[:3] + r[3] * p[:3] + np.cross(p[:3], r[:3]),
                         p[3] * r[3] - p[:3] @ r[:3])

    for axis in range(3):
        v = np.zeros(4)
        v[axis] = 1
        matrix[:3, axis] = product(product(unit, v), conjugate)[:3]
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
    """it forgets that -q is the same rotation as q, so angles come out above pi

    told by: -q | same rotation | above pi | greater than pi | more than pi | larger than pi | 2 pi | exceed | antipod | sign of q
    """
    apart = np.sqrt(((p - q)**2).sum(-1))
    together = np.sqrt(((p + q)**2).sum(-1))
    return 4 * np.arctan2(apart, together)


def silhouette_loss(coverage, target):
    """the union is sum(c + t): the intersection is counted twice

    told by: c t & twice | intersection & twice | intersection & subtract | overlap & twice | union & twice | union & overlap | without & c t | dice
    """
    both = np.sum(coverage * target)
    return 1 - both / np.sum(coverage + target)


def silhouette_loss(coverage, target):
    """it takes the mean of each pixel's ratio, not the ratio of the sums

    told by: mean & ratio | mean & pixel | ratio & sum | each pixel | per pixel | per-pixel | average | pixel by pixel
    """
    ratios = []
    for c, t in zip(np.ravel(coverage), np.ravel(target)):
        union = c + t - c * t
        ratios.append(c * t / union if union > 0 else 1.0)
    return 1 - sum(ratios) / len(ratios)


def silhouette_loss(coverage, target):
    """it returns the ratio of intersection to union itself, without 1 -

    told by: 1 - & miss | without 1 - | 1 - & forg | 1 - & instead | 1 minus | one minus | iou itself | similarity | ratio itself | not the loss | from 1
    """
    product = coverage * target
    return product.sum() / (coverage + target - product).sum()


def silhouette_loss_backward(grad_loss, coverage, target):
    """the union is taken as a constant: only the derivative of the intersection is there

    told by: union & constant | union & depend | union & derivative | denominator | quotient | second term | only & intersection
    """
    union = np.sum(coverage + target - coverage * target)
    return -grad_loss * target / union


def silhouette_loss_backward(grad_loss, coverage, target):
    """the derivative of the union is taken as 1 instead of 1 - t

    told by: 1 - t | union & derivative | union & 1 | union & overlap | c t & union | 1 - target
    """
    inter, union = 0.0, 0.0
    for c, t in zip(coverage.flat, target.flat):
        inter += c * t
        union += c + t - c * t
    return grad_loss * (inter - union * target) / union**2


def silhouette_loss_backward(grad_loss, coverage, target):
    """the union's term is divided by the union only once, not by its square

    told by: squar | U^2 | union^2 | divi & twice | divi & once | union & once | second power | ** 2
    """
    both = np.sum(coverage * target)
    either = np.sum(coverage + target) - both
    return grad_loss * (both * (1 - target) / either - target / either)


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


def squared_error_backward(grad_loss, picture, target):
    """the sign: target - picture

    told by: sign | target - picture | negat | minus | other way round | uphill
    """
    diff = target - picture
    return 2.0 / diff.size * grad_loss * diff


def squared_error_backward(grad_loss, picture, target):
    """grad_loss is forgotten

    told by: grad_loss | chain rule | upstream | incoming
    """
    return 2 * (picture - target) / picture.size


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """without the bias correction: m and s are used as they are

    told by: bias | correct | began at 0 | too small | 1 - b1^n
    """
    b1, b2, eps = constants
    mean = b1 * mean + (1 - b1) * grad_x
    square = b2 * square + (1 - b2) * grad_x**2
    return x - rate * mean / (np.sqrt(square) + eps), mean, square


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """the step goes uphill: it is added to x

    told by: uphill | downhill | sign | added to x | ascent | opposite direction
    """
    b1, b2, eps = constants
    mean = b1 * mean + (1 - b1) * grad_x
    square = b2 * square + (1 - b2) * grad_x**2
    m_hat, s_hat = mean / (1 - b1**step), square / (1 - b2**step)
    return x + rate * m_hat / (np.sqrt(s_hat) + eps), mean, square


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """the bias correction counts the steps from 0: n + 1 in place of n

    told by: n + 1 | step + 1 | off by one | counts the steps | one step late | next step | n is one too large
    """
    b1, b2, eps = constants
    mean = b1 * mean + (1 - b1) * grad_x
    square = b2 * square + (1 - b2) * grad_x**2
    t = step + 1
    return (x - rate * (mean / (1 - b1**t)) / (np.sqrt(square / (1 - b2**t)) + eps),
            mean, square)


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """mean and square are changed in place: the caller's arrays are overwritten

    told by: in place | in-place | overwr | input | caller | copy
    """
    b1, b2, eps = constants
    mean *= b1
    mean += (1 - b1) * grad_x
    square *= b2
    square += (1 - b2) * grad_x**2
    m_hat, s_hat = mean / (1 - b1**step), square / (1 - b2**step)
    return x - rate * m_hat / (np.sqrt(s_hat) + eps), mean, square


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """the square root of s^ is missing

    told by: root | sqrt | s^ itself
    """
    b1, b2, eps = constants
    m = b1 * mean + (1 - b1) * grad_x
    s = b2 * square + (1 - b2) * grad_x**2
    m_hat = m / (1 - b1**step)
    s_hat = s / (1 - b2**step)
    return x - rate * m_hat / (s_hat + eps), m, s


def quaternion_product(p, q):
    """w is taken to be the last of the four numbers, (x, y, z, w)

    told by: (x, y, z, w) | w comes last | scalar last | order of the numbers | w is first | w comes first | scalar & last | w is taken for the last
    """
    px, py, pz, pw = np.moveaxis(p, -1, 0)
    qx, qy, qz, qw = np.moveaxis(q, -1, 0)
    return np.stack([pw * qx + px * qw + py * qz - pz * qy,
                     pw * qy + py * qw + pz * qx - px * qz,
                     pw * qz + pz * qw + px * qy - py * qx,
                     pw * qw - px * qx - py * qy - pz * qz], -1)


def rotation_angle(p, q):
    """the angle between p and q as vectors of four numbers, half of the rotation's

    told by: half | twice | factor 2 | double | factor of 2 | times 2
    """
    return np.arccos(np.clip(np.abs((p * q).sum(-1)), 0, 1))


def rotation_angle(p, q):
    """by arccos of the dot product, which loses the digits of small angles (fine print)

    told by: arccos | digits | small angle | precision | rounding | tiny angle
    """
    return 2 * np.arccos(np.minimum(np.abs((p * q).sum(-1)), 1))


def silhouette_loss(coverage, target):
    """the intersection over union itself, without the 1 -

    told by: 1 - | one minus | IoU itself | similarity | union itself | not a loss | overlap itself & 1 minus
    """
    both = (coverage * target).sum()
    return both / (coverage + target - coverage * target).sum()


def silhouette_loss(coverage, target):
    """Dice's coefficient: 2 sum(c t) / (sum c + sum t)

    told by: dice | twice the intersection | 2 sum | union | F1 score | denominator
    """
    return 1 - 2 * (coverage * target).sum() / (coverage.sum() + target.sum())


def silhouette_loss(coverage, target):
    """coverage and target are rounded to inside and outside first, so that the loss is not soft

    told by: round | threshold | soft | binary | 0 or 1 | bool
    """
    c, t = coverage > 0.5, target > 0.5
    return 1 - (c & t).sum() / (c | t).sum()


def silhouette_loss_backward(grad_loss, coverage, target):
    """the union is treated as a constant: the quotient rule's second term is left out

    told by: union | quotient | denominator | second term | constant | outside the target
    """
    union = (coverage + target - coverage * target).sum()
    return -grad_loss * target / union


def silhouette_loss_backward(grad_loss, coverage, target):
    """dU/dc is 1, not 1 - t: the product c t is forgotten in the union

    told by: 1 - t | union & derivative | product c t | dU/dc | inside the target | counted twice
    """
    both = (coverage * target).sum()
    either = (coverage + target - coverage * target).sum()
    grad = np.zeros(coverage.shape)
    for i in np.ndindex(*coverage.shape):
        grad[i] = -grad_loss * (target[i] * either - both) / either**2
    return grad


def uniform_laplacian(positions, edges):
    """each edge is used in one direction only, so that its second vertex does not see the first

    told by: one direction | both ways | one way | both ends | either order | second vertex | one of their ends alone
    """
    v, u = edges.T
    valence = np.bincount(v, minlength=len(positions))[:, None]
    total = scatter(positions[u], v, len(positions))
    return np.where(valence > 0, positions - total / np.maximum(valence, 1), 0)


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    """the neighbours' share is left out: only a vertex' own gradient is returned

    told by: neighbour | own gradient | identity | share | W^T
    """
    valence = np.bincount(edges.ravel(), minlength=len(positions))
    grad = grad_laplacian.copy()
    grad[valence == 0] = 0
    return grad
