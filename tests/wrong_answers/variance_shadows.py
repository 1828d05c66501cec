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


def chebyshev(distance, mean, mean_square, least_variance):
    """least_variance is added to the variance instead of being its least value

    told by: added | maximum | max( | floor | at least | least value | plus & least_variance
    """
    v = mean_square - mean**2 + least_variance
    excess = np.clip(distance - mean, 0, None)
    return v / (v + excess**2)


def chebyshev(distance, mean, mean_square, least_variance):
    """the case of distance before E_0 is left out, where the share is 1

    told by: before e_0 | nearer than | else 1 | in front of | fully lit | smaller than & mean | should be 1 | before the mean
    """
    shares = np.zeros(len(distance))
    for n in range(len(distance)):
        v = max(mean_square[n] - mean[n]**2, least_variance)
        shares[n] = v / (v + (distance[n] - mean[n])**2)
    return shares


def chebyshev(distance, mean, mean_square, least_variance):
    """the distance beyond E_0 is not squared

    told by: squar | ^2 | power | **2
    """
    v = np.maximum(mean_square - mean * mean, least_variance)
    return np.where(distance > mean, v / (v + distance - mean), 1.0)


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the variance is treated as a function of mean_square alone, grad_mean lacks its part through -E_0^2

    told by: -2 mean | 2 e_0 | e_0^2 | mean^2 | through the variance & mean | mean & variance & depends | grad_mean & variance
    """
    raw = mean_square - mean**2
    v = np.maximum(raw, least_variance)
    b = np.maximum(distance - mean, 0)
    below = (v + b * b)**2
    by_b = -2 * grad_lit * v * b / below
    by_v = np.where(raw > least_variance, grad_lit * b * b / below, 0)
    return by_b, -by_b, by_v


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the gradient also goes through the variance where it is floored

    told by: floor | least_variance | constant | clamp | np.maximum | at least
    """
    out = np.zeros((3, len(distance)))
    for n, g in enumerate(grad_lit):
        b = distance[n] - mean[n]
        if b <= 0:
            continue
        v = max(mean_square[n] - mean[n]**2, least_variance)
        by_b, by_v = -2 * g * v * b / (v + b**2)**2, g * b**2 / (v + b**2)**2
        out[:, n] = by_b, -by_b - 2 * mean[n] * by_v, by_v
    return tuple(out)


def box_blur_backward(grad_output, radius):
    """the blur itself is used as its own backward: the sum is divided by its own count, not each gradient before the sum

    told by: before & sum | border | own count | divid & first | transpose | box_blur itself | count & before
    """
    return box_blur(grad_output, radius)


def map_motion(distance_map, clip_from_light):
    """the texels' corners are taken instead of their centres: half a texel is left out

    told by: half a texel | centre | half a pixel | center | corner
    """
    rows, columns = distance_map.shape
    c = clip_from_light
    motion = np.zeros((rows, columns, 2, 3))
    for y in range(rows):
        for x in range(columns):
            w = c[3, 3] - c[3, 2] * distance_map[y, x]
            motion[y, x, 0] = c[0, 0] * columns / 2 / w, 0, -(x - columns / 2) * c[3, 2] / w
            motion[y, x, 1] = 0, c[1, 1] * rows / 2 / w, -(y - rows / 2) * c[3, 2] / w
    return motion


def moved_moments(distance_map, motion, move):
    """the shift of a border is that of the surface behind, with the larger distance, not that in front

    told by: behind | in front | larger distance | smaller | nearer | farther
    """
    E = moments_of(distance_map)
    result = moments_of(distance_map - move[2])
    for axis, a, b in PAIRS:
        speed = (motion @ move)[..., axis]
        shift = np.where(distance_map[a] > distance_map[b], speed[a], speed[b])[..., None]
        result[a] -= shift / 2 * (E[b] - E[a])
        result[b] -= shift / 2 * (E[b] - E[a])
    return result


def moved_moments_backward(grad_moments, distance_map, motion, move):
    """grad_move's z lacks the part through the distances themselves, d - move_z

    told by: d - move_z | themselves | z component & distance | third | own distance | grad_distance | through the distance
    """
    E = moments_of(distance_map)
    grad_move = np.zeros(3)
    for axis, a, b in PAIRS:
        by_shift = -((grad_moments[a] + grad_moments[b]) * (E[b] - E[a])).sum(-1) / 2
        front = (distance_map[a] <= distance_map[b])[..., None]
        rows = np.where(front, motion[a][..., axis, :], motion[b][..., axis, :])
        grad_move += np.einsum("yx,yxk->k", by_shift, rows)
    return grad_move
