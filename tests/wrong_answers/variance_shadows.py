"""Wrong answers to variance_shadows, written without a look at the checks."""


def box_blur_backward(grad_output, radius):
    """the gradient is blurred like the picture: divided by the pixel's own count after the sum, not before it

    told by: after the sum | before the sum | divided after | before summing | own count | box_blur itself | same blur
    """
    return box_blur(grad_output, radius)


def chebyshev(distance, mean, mean_square, least_variance):
    """points nearer than the mean are darkened too: the case distance <= E_0, where the share is 1, is missing

    told by: nearer than | before the mean | beyond E_0 | beyond the mean | else 1 | one-sided | distance < E_0
    """
    spread = np.maximum(mean_square - mean * mean, least_variance)
    gap = distance - mean
    return spread / (spread + gap * gap)


def chebyshev(distance, mean, mean_square, least_variance):
    """least_variance is added to the variance instead of being its least value

    told by: added | adds | least_variance & plus | + least_variance | instead of the maximum | sum & least | maximum & least
    """
    out = np.ones(len(distance))
    for n in range(len(distance)):
        v = mean_square[n] - mean[n]**2 + least_variance
        if distance[n] > mean[n]:
            out[n] = v / (v + (distance[n] - mean[n])**2)
    return out


def chebyshev(distance, mean, mean_square, least_variance):
    """distance - E_0 is not squared below the line

    told by: not squared | unsquared | squar & distance | squar & difference | squar & missing | square of | ^2
    """
    variance = np.maximum(mean_square - mean**2, least_variance)
    return np.where(distance > mean, variance / (variance + np.abs(distance - mean)), 1.0)


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the gradient also passes where the variance is floored

    told by: floor | least_variance | least variance | is a constant | clamp | clipped | maximum
    """
    v = np.maximum(mean_square - mean**2, least_variance)
    b = np.maximum(distance - mean, 0)
    by_v = grad_lit * b**2 / (v + b**2)**2
    by_b = -grad_lit * 2 * v * b / (v + b**2)**2
    return by_b, -by_b - 2 * mean * by_v, by_v


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """grad_mean lacks the way through the variance, -2 E_0 grad_mean_square

    told by: through the variance | 2 E_0 | 2 mean | E_0^2 | mean**2 | grad_mean & variance | grad_mean & -grad_distance
    """
    raw = mean_square - mean**2
    grad_distance, grad_mean_square = np.zeros(len(mean)), np.zeros(len(mean))
    for n in range(len(mean)):
        v = max(raw[n], least_variance)
        b = max(distance[n] - mean[n], 0.0)
        grad_distance[n] = -2 * grad_lit[n] * v * b / (v + b * b)**2
        if raw[n] > least_variance:
            grad_mean_square[n] = grad_lit[n] * b * b / (v + b * b)**2
    return grad_distance, -grad_distance, grad_mean_square


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the variance below the line is held: dp/dv is 1 / s instead of b^2 / s^2

    told by: denominator | below the line | quotient | 1 / s | b^2 / s^2 | variance & twice | variance & held
    """
    variance = np.maximum(mean_square - mean**2, least_variance)
    gap = np.maximum(distance - mean, 0)
    s = variance + gap**2
    grad_gap = -2 * grad_lit * variance * gap / s**2
    above = (mean_square - mean**2 > least_variance) & (gap > 0)
    grad_square = np.where(above, grad_lit / s, 0.0)
    return grad_gap, -grad_gap - 2 * mean * grad_square, grad_square


def map_motion(distance_map, clip_from_light):
    """a texel's index is taken for its place: the half texel to its centre is missing

    told by: half a texel | half texel | 0.5 | centre | center | middle of the texel | corner of the texel
    """
    height, width = distance_map.shape
    motion = np.zeros((height, width, 2, 3))
    for row in range(height):
        for col in range(width):
            w = clip_from_light[3, 3] - clip_from_light[3, 2] * distance_map[row, col]
            motion[row, col, 0, 0] = clip_from_light[0, 0] * width / 2 / w
            motion[row, col, 1, 1] = clip_from_light[1, 1] * height / 2 / w
            motion[row, col, 0, 2] = -(col - width / 2) * clip_from_light[3, 2] / w
            motion[row, col, 1, 2] = -(row - height / 2) * clip_from_light[3, 2] / w
    return motion


def moved_moments(distance_map, motion, move):
    """the border goes with the farther surface instead of the one in front

    told by: farther | further | behind | in front | nearer | other texel | wrong texel
    """
    before = moments_of(distance_map)
    after = moments_of(distance_map - move[2])
    travel = motion @ move
    for axis, a, b in PAIRS:
        shift = np.where(distance_map[a] >= distance_map[b], travel[a][..., axis], travel[b][..., axis])
        flow = (before[b] - before[a]) * shift[..., None] / 2
        after[a] -= flow
        after[b] -= flow
    return after


def moved_moments_backward(grad_moments, distance_map, motion, move):
    """a border passes on the gradient of texel a only, the one of b is missing

    told by: texel b | only a | texel a only | both texels | border & both | border & one of | border & one side
    """
    moments = moments_of(distance_map)
    direct = grad_moments[..., 0] + 2 * (distance_map - move[2]) * grad_moments[..., 1]
    grad_move = np.zeros(3)
    grad_move[2] = -direct.sum()
    for axis, a, b in PAIRS:
        jump = moments[b] - moments[a]
        grad_shift = -(grad_moments[a] * jump).sum(-1) / 2
        front = np.where((distance_map[a] <= distance_map[b])[..., None],
                         motion[a][..., axis, :], motion[b][..., axis, :])
        grad_move += np.einsum("ij,ijk->k", grad_shift, front)
    return grad_move


def box_blur_backward(grad_output, radius):
    """it is divided by (2 radius + 1)^2 everywhere, also at the border where the squares are smaller

    told by: (2 radius + 1) | border | smaller | edge | cut off | number of pixels
    """
    side = 2 * radius + 1
    return window_sums(grad_output / side**2, radius)


def chebyshev(distance, mean, mean_square, least_variance):
    """before the mean, where distance < E_0, the bound is used as well, so lit points are darkened

    told by: else 1 | before & mean | nearer & mean | before e_0 | one-sided | max(0 | fully lit | distance < | nearer than e_0
    """
    variance = np.maximum(mean_square - mean**2, least_variance)
    return variance / (variance + (distance - mean)**2)


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the variance's dependence on the mean is left out: grad_mean lacks -2 mean grad_mean_square

    told by: 2 mean | variance & depends & mean | through the variance | e_0^2 | mean**2 | grad_mean & variance | 2 e_0
    """
    var = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    s = var + beyond**2
    g_d = -2 * grad_lit * var * beyond / s**2
    g_ms = grad_lit * beyond**2 / s**2 * (mean_square - mean**2 > least_variance)
    return g_d, -g_d, g_ms


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the factor 2 of the square's derivative is missing in grad_distance

    told by: factor 2 | twice | half | the 2 | factor of 2 | two times
    """
    var = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    s = var + beyond**2
    g_d = -grad_lit * var * beyond / s**2
    g_ms = grad_lit * (beyond / s)**2 * (mean_square - mean**2 > least_variance)
    return g_d, -g_d - 2 * mean * g_ms, g_ms


def map_motion(distance_map, clip_from_light):
    """the texels' centres are taken to be at integers: the + 0.5 is missing

    told by: 0.5 | half a texel | centre | half a pixel | corner
    """
    h, w_ = distance_map.shape
    w = clip_from_light[3, 3] - clip_from_light[3, 2] * distance_map
    motion = np.zeros((h, w_, 2, 3))
    y, x = np.indices((h, w_))
    motion[..., 0, 0] = clip_from_light[0, 0] * w_ / 2 / w
    motion[..., 1, 1] = clip_from_light[1, 1] * h / 2 / w
    motion[..., 0, 2] = -(x - w_ / 2) * clip_from_light[3, 2] / w
    motion[..., 1, 2] = -(y - h / 2) * clip_from_light[3, 2] / w
    return motion


def map_motion(distance_map, clip_from_light):
    """the derivative with respect to q_z uses x from the map's left side and not from its middle

    told by: middle | from the left | width / 2 | height / 2 | centre of the map | corner of the map
    """
    h, w_ = distance_map.shape
    motion = np.zeros((h, w_, 2, 3))
    for row in range(h):
        for col in range(w_):
            w = clip_from_light[3, 3] - clip_from_light[3, 2] * distance_map[row, col]
            motion[row, col, 0, 0] = clip_from_light[0, 0] * w_ / 2 / w
            motion[row, col, 1, 1] = clip_from_light[1, 1] * h / 2 / w
            motion[row, col, 0, 2] = -(col + 0.5) * clip_from_light[3, 2] / w
            motion[row, col, 1, 2] = -(row + 0.5) * clip_from_light[3, 2] / w
    return motion


def moved_moments(distance_map, motion, move):
    """the distances themselves do not change with move_z

    told by: move_z | move[2] | distances & do not change | distance & itself | along the axis | toward & light | d - move
    """
    moments = moments_of(distance_map)
    moved = moments.copy()
    for axis, a, b in PAIRS:
        speed = motion[..., axis, :] @ move
        shift = np.where(distance_map[a] <= distance_map[b], speed[a], speed[b])
        change = shift[..., None] / 2 * (moments[b] - moments[a])
        moved[a] -= change
        moved[b] -= change
    return moved


def moved_moments(distance_map, motion, move):
    """the shift is not halved: each texel gets the whole of the change

    told by: half | / 2 | twice | 1/2 | double | whole
    """
    moments = moments_of(distance_map)
    moved = moments_of(distance_map - move[2])
    for axis, a, b in PAIRS:
        speed = motion[..., axis, :] @ move
        shift = np.where(distance_map[a] <= distance_map[b], speed[a], speed[b])
        change = shift[..., None] * (moments[b] - moments[a])
        moved[a] -= change
        moved[b] -= change
    return moved


def chebyshev(distance, mean, mean_square, least_variance):
    """the standard deviation is used for the variance: a root too many

    told by: root | standard deviation | sqrt | deviation
    """
    sigma = np.sqrt(np.maximum(mean_square - mean**2, least_variance))
    beyond = np.maximum(distance - mean, 0)
    return sigma / (sigma + beyond**2)
