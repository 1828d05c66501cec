"""Mistakes of lab 14; each docstring goes on after "this is what comes out when"."""


def box_blur_backward(grad_output, radius):
    """the gradient is blurred like the picture: it is divided after the sum, by the number of
    pixels in its own square, and not before, by the number in each square that holds it"""
    return box_blur(grad_output, radius)


def box_blur_backward(grad_output, radius):
    """it is not divided by the number of pixels: the backward of a sum, and not of a mean"""
    return window_sums(grad_output, radius)


def box_blur_backward(grad_output, radius):
    """it is divided by (2 radius + 1)^2 everywhere: at the border, squares have fewer pixels"""
    return window_sums(grad_output, radius) / (2 * radius + 1)**2


def chebyshev(distance, mean, mean_square, least_variance):
    """the variance is not floored at least_variance"""
    variance = mean_square - mean**2
    beyond = np.maximum(distance - mean, 0)
    return variance / (variance + beyond**2)


def chebyshev(distance, mean, mean_square, least_variance):
    """what lies before the mean is dark, too: the share is 1 there"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = distance - mean
    return variance / (variance + beyond**2)


def chebyshev(distance, mean, mean_square, least_variance):
    """the mean of the squares is taken for the variance: the square of the mean, E_0^2, is not
    subtracted"""
    variance = np.maximum(mean_square, least_variance)
    beyond = np.maximum(distance - mean, 0)
    return variance / (variance + beyond**2)


def chebyshev(distance, mean, mean_square, least_variance):
    """distance - E_0 is not squared"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    return variance / (variance + beyond)


def chebyshev(distance, mean, mean_square, least_variance):
    """the two sides are swapped: what lies before the mean is dark, and what lies beyond it is
    lit"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    before = np.maximum(mean - distance, 0)
    return variance / (variance + before**2)


def chebyshev(distance, mean, mean_square, least_variance):
    """least_variance is added to the variance, which must only not be below it: it is a maximum"""
    variance = mean_square - mean**2 + least_variance
    beyond = np.maximum(distance - mean, 0)
    return variance / (variance + beyond**2)


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the mean's part in the variance, -2 E_0, is forgotten in grad_mean"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    total = variance + beyond**2
    grad_beyond = grad_lit * -2 * variance * beyond / total**2
    grad_mean_square = grad_lit * (beyond / total)**2 * (mean_square - mean**2 > least_variance)
    return grad_beyond, -grad_beyond, grad_mean_square


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the gradient goes on to the moments where the variance is floored, too: it is a constant
    there, least_variance"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    total = variance + beyond**2
    grad_beyond = grad_lit * -2 * variance * beyond / total**2
    grad_mean_square = grad_lit * (beyond / total)**2
    return grad_beyond, -grad_beyond - 2 * mean * grad_mean_square, grad_mean_square


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the factor 2, the derivative of the squared distance, is missing in grad_distance, and in its
    part of grad_mean"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    total = variance + beyond**2
    grad_beyond = -grad_lit * variance * beyond / total**2
    grad_mean_square = grad_lit * (beyond / total)**2 * (mean_square - mean**2 > least_variance)
    return grad_beyond, -grad_beyond - 2 * mean * grad_mean_square, grad_mean_square


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """points before the mean get a gradient, too: they are fully lit, the share is 1 there"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = distance - mean
    total = variance + beyond**2
    grad_beyond = grad_lit * -2 * variance * beyond / total**2
    grad_mean_square = grad_lit * (beyond / total)**2 * (mean_square - mean**2 > least_variance)
    return grad_beyond, -grad_beyond - 2 * mean * grad_mean_square, grad_mean_square


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the quotient rule is cut short: the variance in the numerator is held as a constant"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    total = variance + beyond**2
    grad_beyond = grad_lit * -2 * variance * beyond / total**2
    free = (mean_square - mean**2 > least_variance) & (beyond > 0)
    grad_mean_square = -grad_lit * variance / total**2 * free
    return grad_beyond, -grad_beyond - 2 * mean * grad_mean_square, grad_mean_square


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """grad_lit is not multiplied in"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    total = variance + beyond**2
    grad_beyond = -2 * variance * beyond / total**2
    grad_mean_square = (beyond / total)**2 * (mean_square - mean**2 > least_variance)
    return grad_beyond, -grad_beyond - 2 * mean * grad_mean_square, grad_mean_square


def map_motion(distance_map, clip_from_light):
    """the derivative with respect to q_z has the wrong sign: what comes nearer moves outwards"""
    height, width = distance_map.shape
    w = clip_from_light[3, 3] - clip_from_light[3, 2] * distance_map
    motion = np.zeros((height, width, 2, 3))
    motion[..., 0, 0] = clip_from_light[0, 0] * (width / 2) / w
    motion[..., 1, 1] = clip_from_light[1, 1] * (height / 2) / w
    from_middle = np.arange(width) + 0.5 - width / 2, np.arange(height)[:, None] + 0.5 - height / 2
    for axis in 0, 1:
        motion[..., axis, 2] = from_middle[axis] * clip_from_light[3, 2] / w
    return motion


def map_motion(distance_map, clip_from_light):
    """a texel's left border is taken for its centre in x: the 0.5 is missing"""
    height, width = distance_map.shape
    w = clip_from_light[3, 3] - clip_from_light[3, 2] * distance_map
    motion = np.zeros((height, width, 2, 3))
    motion[..., 0, 0] = clip_from_light[0, 0] * (width / 2) / w
    motion[..., 1, 1] = clip_from_light[1, 1] * (height / 2) / w
    from_middle = np.arange(width) - width / 2, np.arange(height)[:, None] + 0.5 - height / 2
    for axis in 0, 1:
        motion[..., axis, 2] = -from_middle[axis] * clip_from_light[3, 2] / w
    return motion


def map_motion(distance_map, clip_from_light):
    """y has C_00 and the width, as x does, instead of C_11 and the height"""
    height, width = distance_map.shape
    w = clip_from_light[3, 3] - clip_from_light[3, 2] * distance_map
    motion = np.zeros((height, width, 2, 3))
    motion[..., 0, 0] = clip_from_light[0, 0] * (width / 2) / w
    motion[..., 1, 1] = clip_from_light[0, 0] * (width / 2) / w
    from_middle = np.arange(width) + 0.5 - width / 2, np.arange(height)[:, None] + 0.5 - height / 2
    for axis in 0, 1:
        motion[..., axis, 2] = -from_middle[axis] * clip_from_light[3, 2] / w
    return motion


def map_motion(distance_map, clip_from_light):
    """w is held: the derivative with respect to q_z, the third column, is left out"""
    height, width = distance_map.shape
    w = clip_from_light[3, 3] - clip_from_light[3, 2] * distance_map
    motion = np.zeros((height, width, 2, 3))
    motion[..., 0, 0] = clip_from_light[0, 0] * (width / 2) / w
    motion[..., 1, 1] = clip_from_light[1, 1] * (height / 2) / w
    return motion


def map_motion(distance_map, clip_from_light):
    """w has the wrong sign: it is C_32 q_z + C_33, and q_z is -distance"""
    height, width = distance_map.shape
    w = clip_from_light[3, 3] + clip_from_light[3, 2] * distance_map
    motion = np.zeros((height, width, 2, 3))
    motion[..., 0, 0] = clip_from_light[0, 0] * (width / 2) / w
    motion[..., 1, 1] = clip_from_light[1, 1] * (height / 2) / w
    from_middle = np.arange(width) + 0.5 - width / 2, np.arange(height)[:, None] + 0.5 - height / 2
    for axis in 0, 1:
        motion[..., axis, 2] = -from_middle[axis] * clip_from_light[3, 2] / w
    return motion


def moved_moments(distance_map, motion, move):
    """the border moves with the farther texel, the one behind, instead of the nearer one in
    front"""
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
    """the half is missing: each of the two texels loses the whole step"""
    moments = moments_of(distance_map)
    moved = moments_of(distance_map - move[2])
    for axis, a, b in PAIRS:
        speed = motion[..., axis, :] @ move
        shift = np.where(distance_map[a] <= distance_map[b], speed[a], speed[b])
        change = shift[..., None] * (moments[b] - moments[a])
        moved[a] -= change
        moved[b] -= change
    return moved


def moved_moments(distance_map, motion, move):
    """the border moves the wrong way: the sign of the step is wrong"""
    moments = moments_of(distance_map)
    moved = moments_of(distance_map - move[2])
    for axis, a, b in PAIRS:
        speed = motion[..., axis, :] @ move
        shift = np.where(distance_map[a] <= distance_map[b], speed[a], speed[b])
        change = shift[..., None] / 2 * (moments[a] - moments[b])
        moved[a] -= change
        moved[b] -= change
    return moved


def moved_moments(distance_map, motion, move):
    """only one of the two texels of a border changes: the half of b, on its other side, is
    forgotten"""
    moments = moments_of(distance_map)
    moved = moments_of(distance_map - move[2])
    for axis, a, b in PAIRS:
        speed = motion[..., axis, :] @ move
        shift = np.where(distance_map[a] <= distance_map[b], speed[a], speed[b])
        moved[a] -= shift[..., None] / 2 * (moments[b] - moments[a])
    return moved


def moved_moments_backward(grad_moments, distance_map, motion, move):
    """the gradient of the shift has the wrong sign"""
    moments = moments_of(distance_map)
    grad_distance = grad_moments[..., 0] + 2 * (distance_map - move[2]) * grad_moments[..., 1]
    grad_move = np.array([0.0, 0.0, -grad_distance.sum()])
    for axis, a, b in PAIRS:
        grad_change = grad_moments[a] + grad_moments[b]
        grad_shift = (grad_change * (moments[b] - moments[a])).sum(-1) / 2
        in_front = (distance_map[a] <= distance_map[b])[..., None]
        by_move = np.where(in_front, motion[..., axis, :][a], motion[..., axis, :][b])
        grad_move += (grad_shift[..., None] * by_move).sum((0, 1))
    return grad_move


def moved_moments_backward(grad_moments, distance_map, motion, move):
    """the half is missing in the gradient of the shift"""
    moments = moments_of(distance_map)
    grad_distance = grad_moments[..., 0] + 2 * (distance_map - move[2]) * grad_moments[..., 1]
    grad_move = np.array([0.0, 0.0, -grad_distance.sum()])
    for axis, a, b in PAIRS:
        grad_change = -(grad_moments[a] + grad_moments[b])
        grad_shift = (grad_change * (moments[b] - moments[a])).sum(-1)
        in_front = (distance_map[a] <= distance_map[b])[..., None]
        by_move = np.where(in_front, motion[..., axis, :][a], motion[..., axis, :][b])
        grad_move += (grad_shift[..., None] * by_move).sum((0, 1))
    return grad_move


def moved_moments_backward(grad_moments, distance_map, motion, move):
    """the square is taken for the distance: its derivative, 2 (d - move_z), is missing"""
    moments = moments_of(distance_map)
    grad_distance = grad_moments[..., 0] + grad_moments[..., 1]
    grad_move = np.array([0.0, 0.0, -grad_distance.sum()])
    for axis, a, b in PAIRS:
        grad_change = -(grad_moments[a] + grad_moments[b])
        grad_shift = (grad_change * (moments[b] - moments[a])).sum(-1) / 2
        in_front = (distance_map[a] <= distance_map[b])[..., None]
        by_move = np.where(in_front, motion[..., axis, :][a], motion[..., axis, :][b])
        grad_move += (grad_shift[..., None] * by_move).sum((0, 1))
    return grad_move


def moved_moments_backward(grad_moments, distance_map, motion, move):
    """the gradient through the distances d - move_z is left out: move_z counts only through the
    shift"""
    moments = moments_of(distance_map)
    grad_move = np.zeros(3)
    for axis, a, b in PAIRS:
        grad_change = -(grad_moments[a] + grad_moments[b])
        grad_shift = (grad_change * (moments[b] - moments[a])).sum(-1) / 2
        in_front = (distance_map[a] <= distance_map[b])[..., None]
        by_move = np.where(in_front, motion[..., axis, :][a], motion[..., axis, :][b])
        grad_move += (grad_shift[..., None] * by_move).sum((0, 1))
    return grad_move


def moved_moments_backward(grad_moments, distance_map, motion, move):
    """the derivative of the square is 2 d; it is 2 (d - move_z), of the moved distance"""
    moments = moments_of(distance_map)
    grad_distance = grad_moments[..., 0] + 2 * distance_map * grad_moments[..., 1]
    grad_move = np.array([0.0, 0.0, -grad_distance.sum()])
    for axis, a, b in PAIRS:
        grad_change = -(grad_moments[a] + grad_moments[b])
        grad_shift = (grad_change * (moments[b] - moments[a])).sum(-1) / 2
        in_front = (distance_map[a] <= distance_map[b])[..., None]
        by_move = np.where(in_front, motion[..., axis, :][a], motion[..., axis, :][b])
        grad_move += (grad_shift[..., None] * by_move).sum((0, 1))
    return grad_move


def moved_moments_backward(grad_moments, distance_map, motion, move):
    """only the first moment hands a gradient on through the distances: that of the second one, the
    square, is missing"""
    moments = moments_of(distance_map)
    grad_move = np.array([0.0, 0.0, -grad_moments[..., 0].sum()])
    for axis, a, b in PAIRS:
        grad_change = -(grad_moments[a] + grad_moments[b])
        grad_shift = (grad_change * (moments[b] - moments[a])).sum(-1) / 2
        in_front = (distance_map[a] <= distance_map[b])[..., None]
        by_move = np.where(in_front, motion[..., axis, :][a], motion[..., axis, :][b])
        grad_move += (grad_shift[..., None] * by_move).sum((0, 1))
    return grad_move
