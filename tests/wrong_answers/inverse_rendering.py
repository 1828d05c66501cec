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
    """the mean is taken over the pixels only: the channels are missing in the divisor

    told by: channel | number of pixels | height * width | h w c | pixels & values | size & pixels | factor 3
    """
    rows, columns = picture.shape[:2]
    pixels = rows * columns
    return 2 * grad_loss / pixels * (picture - target)


def squared_error_backward(grad_loss, picture, target):
    """the sign is turned round: target - picture in place of picture - target

    told by: sign | minus | target - picture | negative | -1 | opposite direction
    """
    residual = target - picture
    return grad_loss * 2 * residual / residual.size


def adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """the corrected m^ and s^ are returned to be kept, in place of m' and s'

    told by: corrected & return | m^ & return | uncorrected | m' & m^ | correct & twice | before the correction | bias & return | correct & kept
    """
    b1, b2, tiny = constants
    m = b1 * mean + (1 - b1) * grad_x
    s = b2 * square + (1 - b2) * grad_x * grad_x
    m = m / (1 - b1**step)
    s = s / (1 - b2**step)
    return x - rate * m / (np.sqrt(s) + tiny), m, s


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


def quaternion_matrix(q):
    """the division is by the length |q|, where it must be by its square |q|^2

    told by: q^2 | q.q | square & length | squared | its square | length of q | unit quaternion | not of length 1 | scale & length | |q|, not by |q|^2
    """
    w, x, y, z = q
    k = 2 / np.sqrt(w * w + x * x + y * y + z * z)
    matrix = np.eye(4)
    matrix[0, :3] = 1 - k * (y * y + z * z), k * (x * y - w * z), k * (x * z + w * y)
    matrix[1, :3] = k * (x * y + w * z), 1 - k * (x * x + z * z), k * (y * z - w * x)
    matrix[2, :3] = k * (x * z - w * y), k * (y * z + w * x), 1 - k * (x * x + y * y)
    return matrix


def silhouette_loss(coverage, target):
    """the union is c + t: the overlap c t is not subtracted, so it is counted twice

    told by: overlap | counted twice | c + t - c t | - c t | union & twice | subtract & intersection | union & c + t | dice
    """
    inter = np.sum(coverage * target)
    return 1 - inter / (np.sum(coverage) + np.sum(target))


def silhouette_loss(coverage, target):
    """the union is the maximum of c and t, in place of c + t - c t

    told by: maximum | max( | c + t - c t | max & union | hard union | larger of
    """
    inter = (coverage * target).sum()
    outer = np.maximum(coverage, target).sum()
    return 1.0 - inter / outer


def silhouette_loss_backward(grad_loss, coverage, target):
    """the union's derivative is taken to be 1, but it is 1 - t

    told by: 1 - t | (1 - t) | derivative & union | union & factor | - c t & deriv | overlap & union | gradient & union
    """
    A = (coverage * target).sum()
    U = (coverage + target - coverage * target).sum()
    dA, dU = target, np.ones_like(coverage)
    return -grad_loss * (dA * U - A * dU) / U**2


def silhouette_loss_backward(grad_loss, coverage, target):
    """the union is treated as a constant: the denominator's gradient is left out

    told by: denominator | union & constant | union & changes | union & depends | through the union | quotient rule | second term | union & left out | union & missing
    """
    union = (coverage + target - coverage * target).sum()
    result = np.zeros_like(coverage)
    for at in np.ndindex(coverage.shape):
        result[at] = -grad_loss * target[at] / union
    return result


def quaternion_product(p, q):
    """the order is exchanged: this is q p, not p q

    told by: q p | order | exchanged | swapped | reversed | commut | first by p | cross product & sign
    """
    first, second = np.broadcast_arrays(q, p)
    w, u = first[..., :1], first[..., 1:]
    s, v = second[..., :1], second[..., 1:]
    scalar = w * s - (u * v).sum(-1, keepdims=True)
    return np.concatenate([scalar, w * v + s * u + np.cross(u, v)], -1)


def rotation_angle(p, q):
    """it is forgotten that q and -q are the same rotation: angles beyond pi come out

    told by: -q | above pi | greater than pi | more than pi | beyond pi | same rotation | 2 pi | shorter | sign of q | exceed
    """
    apart = np.sqrt(((p - q)**2).sum(-1))
    together = np.sqrt(((p + q)**2).sum(-1))
    return 4 * np.arctan2(apart, together)


def uniform_laplacian_backward(grad_laplacian, positions, edges):
    """the forward rule is applied to the gradient: the matrix is not transposed, each vertex divides by its own valence and not by its neighbour's

    told by: transpos | neighbour & valence | forward | own valence | gather | scatter & neighbour | valence of the
    """
    back = np.zeros_like(grad_laplacian)
    for v in range(len(positions)):
        near = [b if a == v else a for a, b in edges if v in (a, b)]
        if near:
            back[v] = grad_laplacian[v] - grad_laplacian[near].mean(0)
    return back
