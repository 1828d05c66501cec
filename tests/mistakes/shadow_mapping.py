"""Mistakes of lab 14; each docstring goes on after "this is what comes out when"."""


def to_light(points, position, rotation):
    """the transposed matrix is applied: the rows of rotation are the light's axes"""
    return (points - position) @ rotation


def to_light(points, position, rotation):
    """the position is added instead of taken away"""
    return (points + position) @ rotation.T


def to_light(points, position, rotation):
    """points are turned first and moved then; the position is a place in the world"""
    return points @ rotation.T - position


def to_light_backward(grad_q, points, position, rotation):
    """the gradient is turned as points are, instead of by the transpose"""
    grad_points = grad_q @ rotation.T
    return grad_points, -grad_points.sum(0)


def to_light_backward(grad_q, points, position, rotation):
    """the position's gradient has the wrong sign"""
    grad_points = grad_q @ rotation
    return grad_points, grad_points.sum(0)


def to_light_backward(grad_q, points, position, rotation):
    """the position's gradient is the mean over the points instead of the sum"""
    grad_points = grad_q @ rotation
    return grad_points, -grad_points.mean(0)


def map_position(q, clip_from_light, width, height):
    """x is not divided by w"""
    w = w_of(q, clip_from_light)
    x = (clip_from_light[0, 0] * q[:, 0] + 1) * (width / 2)
    y = (clip_from_light[1, 1] * q[:, 1] / w + 1) * (height / 2)
    return x, y


def map_position(q, clip_from_light, width, height):
    """y goes with C_00 or the width, as x does; it has C_11 and the height"""
    w = w_of(q, clip_from_light)
    x = (clip_from_light[0, 0] * q[:, 0] / w + 1) * (width / 2)
    y = (clip_from_light[1, 1] * q[:, 1] / w + 1) * (width / 2)
    return x, y


def map_position(q, clip_from_light, width, height):
    """ndc is taken to be 1 wide; it is 2 wide"""
    w = w_of(q, clip_from_light)
    x = (clip_from_light[0, 0] * q[:, 0] / w + 1) * width
    y = (clip_from_light[1, 1] * q[:, 1] / w + 1) * (height / 2)
    return x, y


def map_position_backward(grad_x, grad_y, q, clip_from_light, width, height):
    """q_z has no gradient; but w depends on it"""
    w = w_of(q, clip_from_light)
    grad_q_x = grad_x * clip_from_light[0, 0] * (width / 2) / w
    grad_q_y = grad_y * clip_from_light[1, 1] * (height / 2) / w
    return np.stack([grad_q_x, grad_q_y, np.zeros(len(q))], -1)


def map_position_backward(grad_x, grad_y, q, clip_from_light, width, height):
    """the gradient by w has the wrong sign"""
    w = w_of(q, clip_from_light)
    grad_q_x = grad_x * clip_from_light[0, 0] * (width / 2) / w
    grad_q_y = grad_y * clip_from_light[1, 1] * (height / 2) / w
    grad_w = (grad_q_x * q[:, 0] + grad_q_y * q[:, 1]) / w
    return np.stack([grad_q_x, grad_q_y, clip_from_light[3, 2] * grad_w], -1)


def map_position_backward(grad_x, grad_y, q, clip_from_light, width, height):
    """the gradient by w is divided by w once; the derivative of 1 / w is -1 / w^2"""
    w = w_of(q, clip_from_light)
    grad_q_x = grad_x * clip_from_light[0, 0] * (width / 2) / w
    grad_q_y = grad_y * clip_from_light[1, 1] * (height / 2) / w
    grad_w = -(grad_q_x * q[:, 0] + grad_q_y * q[:, 1])
    return np.stack([grad_q_x, grad_q_y, clip_from_light[3, 2] * grad_w], -1)


def distance_of_depth(depth, clip_from_light):
    """q_z is returned; the distance is -q_z"""
    distance = np.full(depth.shape, np.inf)
    seen = np.isfinite(depth)
    (c_22, c_23), (c_32, c_33) = clip_from_light[2:, 2:]
    distance[seen] = -(c_33 * depth[seen] - c_23) / (c_32 * depth[seen] - c_22)
    return distance


def distance_of_depth(depth, clip_from_light):
    """C_33 is left out of w: right for a cone alone"""
    distance = np.full(depth.shape, np.inf)
    seen = np.isfinite(depth)
    (c_22, c_23), (c_32, _) = clip_from_light[2:, 2:]
    distance[seen] = -c_23 / (c_32 * depth[seen] - c_22)
    return distance


def distance_of_depth(depth, clip_from_light):
    """the matrix is applied to the depth; it is to be solved for q_z"""
    distance = np.full(depth.shape, np.inf)
    seen = np.isfinite(depth)
    (c_22, c_23), (c_32, c_33) = clip_from_light[2:, 2:]
    distance[seen] = -(c_22 * depth[seen] + c_23) / (c_32 * depth[seen] + c_33)
    return distance


def stored_distance(distance_map, x, y):
    """rows and columns are swapped: a map is indexed [y, x]"""
    height, width = distance_map.shape
    stored = np.full(x.shape, np.inf)
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    stored[inside] = distance_map[x[inside].astype(int) % height, y[inside].astype(int) % width]
    return stored


def stored_distance(distance_map, x, y):
    """the nearest whole number is taken; the texel that holds a place is its floor"""
    height, width = distance_map.shape
    stored = np.full(x.shape, np.inf)
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    stored[inside] = distance_map[
        np.minimum(np.rint(y[inside]).astype(int), height - 1),
        np.minimum(np.rint(x[inside]).astype(int), width - 1),
    ]
    return stored


def stored_distance(distance_map, x, y):
    """decimals are cut off: places up to one texel left of the map or below it count as inside"""
    height, width = distance_map.shape
    stored = np.full(x.shape, np.inf)
    inside = (x > -1) & (x < width) & (y > -1) & (y < height)
    stored[inside] = distance_map[y[inside].astype(int), x[inside].astype(int)]
    return stored


def is_lit(distance_map, x, y, distance, bias):
    """what lies behind is lit, and what lies before is dark"""
    return distance >= stored_distance(distance_map, x, y) + bias


def is_lit(distance_map, x, y, distance, bias):
    """the bias makes more shadow; it lets light through"""
    return distance <= stored_distance(distance_map, x, y) - bias


def is_lit(distance_map, x, y, distance, bias):
    """there is no bias"""
    return distance <= stored_distance(distance_map, x, y)


def distance_slopes(normal, q, clip_from_light, width, height):
    """the slope by x has the wrong sign"""
    w = w_of(q, clip_from_light)
    along = (normal[:, :2] * q[:, :2]).sum(1) * -clip_from_light[3, 2] / w - normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    slope_x = w * normal[:, 0] / along * (2 / (clip_from_light[0, 0] * width))
    slope_y = -w * normal[:, 1] / along * (2 / (clip_from_light[1, 1] * height))
    return slope_x, slope_y


def distance_slopes(normal, q, clip_from_light, width, height):
    """the ray is the light's axis in a cone, too; it is q / distance"""
    w = w_of(q, clip_from_light)
    along = -normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    slope_x = -w * normal[:, 0] / along * (2 / (clip_from_light[0, 0] * width))
    slope_y = -w * normal[:, 1] / along * (2 / (clip_from_light[1, 1] * height))
    return slope_x, slope_y


def distance_slopes(normal, q, clip_from_light, width, height):
    """the slope by y is to a unit of the world; it is to a texel"""
    w = w_of(q, clip_from_light)
    along = (normal[:, :2] * q[:, :2]).sum(1) * -clip_from_light[3, 2] / w - normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    slope_x = -w * normal[:, 0] / along * (2 / (clip_from_light[0, 0] * width))
    slope_y = -w * normal[:, 1] / along
    return slope_x, slope_y


def slope_scaled_bias(slope_x, slope_y, constant, factor, most):
    """slopes of opposite signs cancel: |slope| is added"""
    return np.minimum(constant + factor * (slope_x + slope_y) / 2, most)


def slope_scaled_bias(slope_x, slope_y, constant, factor, most):
    """the half is missing: a point is at most half a texel off"""
    return np.minimum(constant + factor * (np.abs(slope_x) + np.abs(slope_y)), most)


def slope_scaled_bias(slope_x, slope_y, constant, factor, most):
    """the limit is for the slopes' part alone; it is for the whole bias"""
    return constant + np.minimum(factor * (np.abs(slope_x) + np.abs(slope_y)) / 2, most)


def on_plane(x, y, distance, slope_x, slope_y, dx, dy):
    """the plane is taken at the place itself; it is at the centre of the texel there"""
    there_x, there_y = x + dx, y + dy
    centre_x, centre_y = there_x, there_y
    return there_x, there_y, distance + slope_x * (centre_x - x) + slope_y * (centre_y - y)


def on_plane(x, y, distance, slope_x, slope_y, dx, dy):
    """the texel's corner is taken for its centre"""
    there_x, there_y = x + dx, y + dy
    centre_x, centre_y = np.floor(there_x), np.floor(there_y)
    return there_x, there_y, distance + slope_x * (centre_x - x) + slope_y * (centre_y - y)


def on_plane(x, y, distance, slope_x, slope_y, dx, dy):
    """the slope by x has the wrong sign"""
    there_x, there_y = x + dx, y + dy
    centre_x, centre_y = np.floor(there_x) + 0.5, np.floor(there_y) + 0.5
    return there_x, there_y, distance + slope_x * (x - centre_x) + slope_y * (centre_y - y)


def percentage_closer(distance_map, x, y, distance, slope_x, slope_y, bias, offsets, radius):
    """the lit places are counted, but not divided by their number"""
    lit = np.zeros(x.shape)
    for dx, dy in offsets:
        there = on_plane(x, y, distance, slope_x, slope_y, radius * dx, radius * dy)
        lit += is_lit(distance_map, *there, bias)
    return lit


def percentage_closer(distance_map, x, y, distance, slope_x, slope_y, bias, offsets, radius):
    """every place is compared with the distance of the receiver, not of its plane there"""
    lit = np.zeros(x.shape)
    for dx, dy in offsets:
        there = on_plane(x, y, distance, slope_x, slope_y, radius * dx, radius * dy)
        lit += is_lit(distance_map, *there[:2], distance, bias)
    return lit / len(offsets)


def percentage_closer(distance_map, x, y, distance, slope_x, slope_y, bias, offsets, radius):
    """distances are averaged and then compared"""
    lit = np.zeros(x.shape)
    for dx, dy in offsets:
        there = on_plane(x, y, distance, slope_x, slope_y, radius * dx, radius * dy)
        lit += stored_distance(distance_map, *there[:2])
    return (distance <= lit / len(offsets) + bias) + 0.0


def blocker_distance(distance_map, x, y, distance, slope_x, slope_y, bias, offsets, radius):
    """lit places are taken for blockers"""
    total, count = np.zeros((2, *x.shape))
    for dx, dy in offsets:
        there_x, there_y, plane = on_plane(x, y, distance, slope_x, slope_y,
                                           radius * dx, radius * dy)
        blocks = is_lit(distance_map, there_x, there_y, plane, bias)
        total[blocks] += stored_distance(distance_map, there_x[blocks], there_y[blocks])
        count += blocks
    return np.where(count > 0, total / np.maximum(count, 1), np.inf)


def blocker_distance(distance_map, x, y, distance, slope_x, slope_y, bias, offsets, radius):
    """the sum is divided by the number of all places; only blockers count"""
    total, count = np.zeros((2, *x.shape))
    for dx, dy in offsets:
        there_x, there_y, plane = on_plane(x, y, distance, slope_x, slope_y,
                                           radius * dx, radius * dy)
        blocks = ~is_lit(distance_map, there_x, there_y, plane, bias)
        total[blocks] += stored_distance(distance_map, there_x[blocks], there_y[blocks])
        count += blocks
    return np.where(count > 0, total / len(offsets), np.inf)


def blocker_distance(distance_map, x, y, distance, slope_x, slope_y, bias, offsets, radius):
    """the blockers' distances are added, not averaged"""
    total, count = np.zeros((2, *x.shape))
    for dx, dy in offsets:
        there_x, there_y, plane = on_plane(x, y, distance, slope_x, slope_y,
                                           radius * dx, radius * dy)
        blocks = ~is_lit(distance_map, there_x, there_y, plane, bias)
        total[blocks] += stored_distance(distance_map, there_x[blocks], there_y[blocks])
        count += blocks
    return total


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """blocker and distance are swapped"""
    spread = light_radius * (1 / distance - 1 / blocker)
    return np.maximum(spread, 0) * (clip_from_light[0, 0] * width / 2)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """a blocker behind the point gives a negative radius"""
    spread = light_radius * (1 / blocker - 1 / distance)
    return spread * (clip_from_light[0, 0] * width / 2)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """it is the diameter, or ndc is taken to be 1 wide"""
    spread = light_radius * (1 / blocker - 1 / distance)
    return np.maximum(spread, 0) * (clip_from_light[0, 0] * width)


def window_sums(picture, radius):
    """the last row and column of each square are missing"""
    for axis in 0, 1:
        n = picture.shape[axis]
        running = np.insert(np.cumsum(picture, axis), 0, 0.0, axis)
        first = np.maximum(np.arange(n) - radius, 0)
        end = np.minimum(np.arange(n) + radius, n)
        picture = running.take(end, axis) - running.take(first, axis)
    return picture


def window_sums(picture, radius):
    """squares begin a pixel too early"""
    for axis in 0, 1:
        n = picture.shape[axis]
        running = np.insert(np.cumsum(picture, axis), 0, 0.0, axis)
        first = np.maximum(np.arange(n) - radius - 1, 0)
        end = np.minimum(np.arange(n) + radius + 1, n)
        picture = running.take(end, axis) - running.take(first, axis)
    return picture


def window_sums(picture, radius):
    """only along rows is anything added up"""
    for axis in (1,):
        n = picture.shape[axis]
        running = np.insert(np.cumsum(picture, axis), 0, 0.0, axis)
        first = np.maximum(np.arange(n) - radius, 0)
        end = np.minimum(np.arange(n) + radius + 1, n)
        picture = running.take(end, axis) - running.take(first, axis)
    return picture


def box_blur(picture, radius):
    """at the border, too, it is divided by the pixels of a whole square: it darkens"""
    return window_sums(picture, radius) / (2 * radius + 1)**2


def box_blur(picture, radius):
    """the sums are not divided by the number of pixels"""
    return window_sums(picture, radius)


def box_blur(picture, radius):
    """it is divided by the pixels of a row instead of those of the square"""
    return window_sums(picture, radius) / (2 * radius + 1)


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
    """the gradient by the distance has the wrong sign"""
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
    moments = np.stack([distance_map, distance_map**2], -1)
    moved = np.stack([distance_map - move[2], (distance_map - move[2])**2], -1)
    for axis, a, b in PAIRS:
        speed = motion[..., axis, :] @ move
        shift = np.where(distance_map[a] > distance_map[b], speed[a], speed[b])
        change = shift[..., None] / 2 * (moments[b] - moments[a])
        moved[a] -= change
        moved[b] -= change
    return moved


def moved_moments(distance_map, motion, move):
    """each of the two texels loses the whole step; it loses half of it"""
    moments = np.stack([distance_map, distance_map**2], -1)
    moved = np.stack([distance_map - move[2], (distance_map - move[2])**2], -1)
    for axis, a, b in PAIRS:
        speed = motion[..., axis, :] @ move
        shift = np.where(distance_map[a] <= distance_map[b], speed[a], speed[b])
        change = shift[..., None] * (moments[b] - moments[a])
        moved[a] -= change
        moved[b] -= change
    return moved


def moved_moments(distance_map, motion, move):
    """the border moves the wrong way: the sign of the step is wrong"""
    moments = np.stack([distance_map, distance_map**2], -1)
    moved = np.stack([distance_map - move[2], (distance_map - move[2])**2], -1)
    for axis, a, b in PAIRS:
        speed = motion[..., axis, :] @ move
        shift = np.where(distance_map[a] <= distance_map[b], speed[a], speed[b])
        change = shift[..., None] / 2 * (moments[a] - moments[b])
        moved[a] -= change
        moved[b] -= change
    return moved


def moved_moments_backward(grad_moments, distance_map, motion, move):
    """the gradient of the shift has the wrong sign"""
    moments = np.stack([distance_map, distance_map**2], -1)
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
    moments = np.stack([distance_map, distance_map**2], -1)
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
    moments = np.stack([distance_map, distance_map**2], -1)
    grad_distance = grad_moments[..., 0] + grad_moments[..., 1]
    grad_move = np.array([0.0, 0.0, -grad_distance.sum()])
    for axis, a, b in PAIRS:
        grad_change = -(grad_moments[a] + grad_moments[b])
        grad_shift = (grad_change * (moments[b] - moments[a])).sum(-1) / 2
        in_front = (distance_map[a] <= distance_map[b])[..., None]
        by_move = np.where(in_front, motion[..., axis, :][a], motion[..., axis, :][b])
        grad_move += (grad_shift[..., None] * by_move).sum((0, 1))
    return grad_move
