"""Wrong answers to variance_shadows, written without a look at the checks."""


def box_blur_backward(grad_output, radius):
    """the blur itself is used as its own backward: the sum is divided by its own count, not each gradient before the sum

    told by: before & sum | border | own count | divid & first | transpose | box_blur itself | count & before
    """
    return box_blur(grad_output, radius)


def chebyshev(distance, mean, mean_square, least_variance):
    """points nearer than the mean are darkened too: the case distance <= E_0, where the share is 1, is missing

    told by: nearer than | before the mean | beyond E_0 | beyond the mean | else 1 | one-sided | distance < E_0
    """
    spread = np.maximum(mean_square - mean * mean, least_variance)
    gap = distance - mean
    return spread / (spread + gap * gap)


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
