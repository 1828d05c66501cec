"""Wrong answers to variance_shadows, written without a look at the checks."""


def box_blur_backward(grad_output, radius):
    """the gradient is blurred like the picture: it is divided by the number after the sum, that of the receiving pixel, not before

    told by: after & sum | before & sum | divi & after | divi & before | same blur | border | own square | number & square
    """
    return box_blur(grad_output, radius)


def box_blur_backward(grad_output, radius):
    """the sums are not divided by the number of pixels: the backward of a sum, not of a mean

    told by: number of pixels | divi & count | mean | not divided | window_sums | backward of a sum
    """
    height, width, _ = grad_output.shape
    grad_picture = np.zeros(grad_output.shape)
    for y in range(height):
        for x in range(width):
            grad_picture[max(y - radius, 0):y + radius + 1, max(x - radius, 0):x + radius + 1] += grad_output[y, x]
    return grad_picture


def chebyshev(distance, mean, mean_square, least_variance):
    """the variance is not floored at least_variance

    told by: least_variance | floor | minimum & variance | lower bound | least variance
    """
    variance = mean_square - mean * mean
    beyond = np.maximum(distance - mean, 0)
    with np.errstate(all="ignore"):
        return np.where(beyond > 0, variance / (variance + beyond**2), 1.0)


def chebyshev(distance, mean, mean_square, least_variance):
    """the difference is not squared

    told by: square & difference | not squared | squared & missing | square & missing | **2 | power
    """
    lit = np.ones(len(distance))
    for i in range(len(distance)):
        variance = max(mean_square[i] - mean[i]**2, least_variance)
        if distance[i] > mean[i]:
            lit[i] = variance / (variance + (distance[i] - mean[i]))
    return lit


def chebyshev(distance, mean, mean_square, least_variance):
    """the sign of the comparison is turned: points beyond the mean are fully lit, those before it are darkened

    told by: turned | other way | sign | exchanged | swapped | mean - distance | before & beyond | opposite
    """
    variance = np.maximum(mean_square - mean**2, least_variance)
    d = np.maximum(mean - distance, 0)
    return variance / (variance + d**2)


def chebyshev(distance, mean, mean_square, least_variance):
    """least_variance is added to the variance, which should only not fall below it

    told by: add & least | added | plus & least | + least | instead of max | sum & least
    """
    variance = mean_square - mean**2 + least_variance
    beyond = np.maximum(distance - mean, 0)
    return variance / (variance + beyond**2)


def chebyshev(distance, mean, mean_square, least_variance):
    """the mean of the squares is taken for the variance: the square of the mean is not subtracted

    told by: square of the mean | mean**2 | e_0^2 | e_0 & subtract | mean & not subtracted | e_1 & variance
    """
    variance = np.maximum(mean_square, least_variance)
    beyond = np.maximum(distance - mean, 0)
    return variance / (variance + beyond**2)


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """where the variance is floored, the gradient still goes on to the moments

    told by: floor | least_variance | constant | least variance | clamp
    """
    var = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    s = var + beyond**2
    g_d = -2 * grad_lit * var * beyond / s**2
    g_ms = grad_lit * beyond**2 / s**2
    return g_d, -g_d - 2 * mean * g_ms, g_ms


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """points before the mean, which are fully lit, get a gradient too

    told by: before & mean | before e_0 | fully lit | distance < | nearer & mean | share is 1 | lit points | nearer than e_0
    """
    var = np.maximum(mean_square - mean**2, least_variance)
    d = distance - mean
    s = var + d**2
    g_d = -2 * grad_lit * var * d / s**2
    g_ms = grad_lit * d**2 / s**2 * (mean_square - mean**2 > least_variance)
    return g_d, -g_d - 2 * mean * g_ms, g_ms


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the quotient rule is cut short: the variance in the numerator is held, so its own slope 1 / s is missing

    told by: quotient | numerator | denominator | both & variance
    """
    var = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    s = var + beyond**2
    g_d = -2 * grad_lit * var * beyond / s**2
    g_ms = -grad_lit * var / s**2 * (mean_square - mean**2 > least_variance) * (beyond > 0)
    return g_d, -g_d - 2 * mean * g_ms, g_ms


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the incoming grad_lit is not multiplied on: these are the bare derivatives

    told by: grad_lit | incoming | upstream | chain rule | bare derivative
    """
    n = len(distance)
    g_d, g_m, g_ms = np.zeros(n), np.zeros(n), np.zeros(n)
    for i in range(n):
        b = distance[i] - mean[i]
        if b <= 0:
            continue
        raw = mean_square[i] - mean[i]**2
        v = max(raw, least_variance)
        s = v + b * b
        g_d[i] = -2 * v * b / s**2
        g_ms[i] = b * b / s**2 if raw > least_variance else 0.0
        g_m[i] = -g_d[i] - 2 * mean[i] * g_ms[i]
    return g_d, g_m, g_ms


def map_motion(distance_map, clip_from_light):
    """the derivative with respect to q_z is left out, as if w were held

    told by: q_z | w is held | third column | respect to z | toward the light | through w
    """
    h, w_ = distance_map.shape
    w = clip_from_light[3, 3] - clip_from_light[3, 2] * distance_map
    motion = np.zeros((h, w_, 2, 3))
    motion[..., 0, 0] = clip_from_light[0, 0] * w_ / 2 / w
    motion[..., 1, 1] = clip_from_light[1, 1] * h / 2 / w
    return motion


def map_motion(distance_map, clip_from_light):
    """w is C_32 distance + C_33, though q_z is -distance: w has the wrong sign

    told by: sign of w | w's sign | w has & sign | -distance | q_z = | w is negative | minus & distance | sign & distance
    """
    h, w_ = distance_map.shape
    w = clip_from_light[3, 2] * distance_map + clip_from_light[3, 3]
    motion = np.zeros((h, w_, 2, 3))
    motion[..., 0, 0] = clip_from_light[0, 0] * w_ / 2 / w
    motion[..., 1, 1] = clip_from_light[1, 1] * h / 2 / w
    motion[..., 0, 2] = -(np.arange(w_) + 0.5 - w_ / 2) * clip_from_light[3, 2] / w
    motion[..., 1, 2] = -(np.arange(h)[:, None] + 0.5 - h / 2) * clip_from_light[3, 2] / w
    return motion


def moved_moments(distance_map, motion, move):
    """the shift at a border is that of the surface behind, the larger distance, not of the one in front

    told by: behind | larger | in front | nearer | smaller | farther
    """
    moments = moments_of(distance_map)
    moved = moments_of(distance_map - move[2])
    for axis, a, b in PAIRS:
        speed = motion[..., axis, :] @ move
        shift = np.where(distance_map[a] > distance_map[b], speed[a], speed[b])
        change = shift[..., None] / 2 * (moments[b] - moments[a])
        moved[a] -= change
        moved[b] -= change
    return moved


def moved_moments(distance_map, motion, move):
    """only the texel on one side of each border changes: b's half is forgotten

    told by: one side | both texels | both sides | only one | only & left | second texel | other texel | moved[b]
    """
    moments = moments_of(distance_map)
    moved = moments_of(distance_map - move[2])
    for axis, a, b in PAIRS:
        speed = motion[..., axis, :] @ move
        shift = np.where(distance_map[a] <= distance_map[b], speed[a], speed[b])
        moved[a] -= shift[..., None] / 2 * (moments[b] - moments[a])
    return moved


def moved_moments_backward(grad_moments, distance_map, motion, move):
    """the gradient through the distances is left out: move_z counts only through the shift

    told by: move_z | move[2] | through the distance | z component | grad_distance | d - move | distances
    """
    moments = moments_of(distance_map)
    grad_move = np.zeros(3)
    for axis, a, b in PAIRS:
        grad_shift = (-(grad_moments[a] + grad_moments[b]) * (moments[b] - moments[a])).sum(-1) / 2
        front = (distance_map[a] <= distance_map[b])[..., None]
        by_move = np.where(front, motion[..., axis, :][a], motion[..., axis, :][b])
        grad_move += np.einsum("ij,ijk->k", grad_shift, by_move)
    return grad_move


def moved_moments_backward(grad_moments, distance_map, motion, move):
    """only the first moment hands a gradient back through the distances: that of the square is missing

    told by: second moment | square | d^2 | 2 (d | first moment | 2 d
    """
    moments = moments_of(distance_map)
    grad_move = np.array([0.0, 0.0, -grad_moments[..., 0].sum()])
    for axis, a, b in PAIRS:
        grad_shift = (-(grad_moments[a] + grad_moments[b]) * (moments[b] - moments[a])).sum(-1) / 2
        front = (distance_map[a] <= distance_map[b])[..., None]
        by_move = np.where(front, motion[..., axis, :][a], motion[..., axis, :][b])
        grad_move += (grad_shift[..., None] * by_move).sum((0, 1))
    return grad_move


def moved_moments_backward(grad_moments, distance_map, motion, move):
    """the square's slope is 2 d and not 2 (d - move_z): it forgets that the moved distance was squared

    told by: moved distance | d - move | before the move | move & square | 2 d | 2 (d
    """
    moments = moments_of(distance_map)
    grad_d = grad_moments[..., 0] + 2 * distance_map * grad_moments[..., 1]
    grad_move = np.array([0.0, 0.0, -grad_d.sum()])
    for axis, a, b in PAIRS:
        grad_shift = (-(grad_moments[a] + grad_moments[b]) * (moments[b] - moments[a])).sum(-1) / 2
        front = (distance_map[a] <= distance_map[b])[..., None]
        by_move = np.where(front, motion[..., axis, :][a], motion[..., axis, :][b])
        grad_move += (grad_shift[..., None] * by_move).sum((0, 1))
    return grad_move


def chebyshev(distance, mean, mean_square, least_variance):
    """it computes in float32, where mean_square - mean^2 cancels

    told by: float32 | single precision | precision | cancel | digits
    """
    d, m, s = (np.asarray(v, np.float32) for v in (distance, mean, mean_square))
    variance = np.maximum(s - m**2, np.float32(least_variance))
    beyond = np.maximum(d - m, 0)
    return variance / (variance + beyond**2)


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the gradients are forward differences with a step of 1e-3, not analytic

    told by: forward difference | central difference | finite difference | numerical | not exact | inexact | analytic
    """
    e = 1e-3

    def p(d, m, s):
        return chebyshev(d, m, s, least_variance)
    here = p(distance, mean, mean_square)
    gd = (p(distance + e, mean, mean_square) - here) / e
    gm = (p(distance, mean + e, mean_square) - here) / e
    gs = (p(distance, mean, mean_square + e) - here) / e
    return grad_lit * gd, grad_lit * gm, grad_lit * gs


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """where the variance is floored all gradients are 0, also that of the distance

    told by: floor | least_variance | grad_distance & 0 | least variance
    """
    raw = mean_square - mean**2
    free = raw > least_variance
    v = np.maximum(raw, least_variance)
    b = np.maximum(distance - mean, 0)
    s = v + b**2
    gd = grad_lit * -2 * v * b / s**2 * free
    gs = grad_lit * b**2 / s**2 * free
    return gd, -gd - 2 * mean * gs, gs
