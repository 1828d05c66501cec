"""Mistakes of lab 14; each docstring goes on after "this is what comes out when"."""


def box_blur_backward(grad_output, radius):
    """the gradient is blurred: divided by the number of the pixel's own square, not of the squares
    that hold it"""
    return box_blur(grad_output, radius)


def box_blur_backward(grad_output, radius):
    """it is not divided by the number of pixels"""
    return window_sums(grad_output, radius)


def box_blur_backward(grad_output, radius):
    """at the border, too, it is divided by the pixels of a whole square"""
    return window_sums(grad_output, radius) / (2 * radius + 1)**2


def chebyshev(distance, mean, mean_square, least_variance):
    """the mean is not squared in the variance"""
    variance = np.maximum(mean_square - mean, least_variance)
    beyond = np.maximum(distance - mean, 0)
    return variance / (variance + beyond**2)


def chebyshev(distance, mean, mean_square, least_variance):
    """least_variance is not used"""
    variance = mean_square - mean**2
    beyond = np.maximum(distance - mean, 0)
    return variance / (variance + beyond**2)


def chebyshev(distance, mean, mean_square, least_variance):
    """what lies before the mean is dark, too; there it is 1"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = distance - mean
    return variance / (variance + beyond**2)


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the mean's part in the variance is forgotten"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    total = variance + beyond**2
    grad_beyond = grad_lit * -2 * variance * beyond / total**2
    grad_mean_square = grad_lit * (beyond / total)**2 * (mean_square - mean**2 > least_variance)
    return grad_beyond, -grad_beyond, grad_mean_square


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the variance has a gradient at its floor, too"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    total = variance + beyond**2
    grad_beyond = grad_lit * -2 * variance * beyond / total**2
    grad_mean_square = grad_lit * (beyond / total)**2
    return grad_beyond, -grad_beyond - 2 * mean * grad_mean_square, grad_mean_square


def chebyshev_backward(grad_lit, distance, mean, mean_square, least_variance):
    """the gradient with respect to the distance has the wrong sign"""
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    total = variance + beyond**2
    grad_beyond = grad_lit * 2 * variance * beyond / total**2
    grad_mean_square = grad_lit * (beyond / total)**2 * (mean_square - mean**2 > least_variance)
    return grad_beyond, -grad_beyond - 2 * mean * grad_mean_square, grad_mean_square


def map_motion(distance_map, clip_from_light):
    """what comes nearer moves inwards: the derivative by q_z has the wrong sign"""
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
    """a texel's left border is taken for its centre"""
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
    """y goes with C_00 or the width, as x does; it has C_11 and the height"""
    height, width = distance_map.shape
    w = clip_from_light[3, 3] - clip_from_light[3, 2] * distance_map
    motion = np.zeros((height, width, 2, 3))
    motion[..., 0, 0] = clip_from_light[0, 0] * (width / 2) / w
    motion[..., 1, 1] = clip_from_light[0, 0] * (width / 2) / w
    from_middle = np.arange(width) + 0.5 - width / 2, np.arange(height)[:, None] + 0.5 - height / 2
    for axis in 0, 1:
        motion[..., axis, 2] = -from_middle[axis] * clip_from_light[3, 2] / w
    return motion


def moved_moments(distance_map, motion, move):
    """the border moves with the farther texel; it moves with the one in front"""
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
    """each of the two texels loses the whole step; it loses half of it"""
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
    """the half of the change is missing"""
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
    """the square's derivative, 2 d, is missing"""
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
