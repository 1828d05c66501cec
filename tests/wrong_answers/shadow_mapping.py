"""Wrong answers to shadow_mapping, written without a look at the checks."""


def to_light(points, position, rotation):
    """rotation p - position: the position is taken away after the rotation instead of before it

    told by: after the rotation | after rotat | before rotat | before the rotation | position & not rotated | position & not turned | rotation p - position | turned first
    """
    turned = np.array([rotation @ p for p in points]).reshape(-1, 3)
    return turned - position


def to_light_backward(grad_q, points, position, rotation):
    """grad_position is not rotated into the world's axes

    told by: grad_position & rotat | grad_position & turned | grad_position & axes | grad_position & frame | light's frame | light's axes | world's axes
    """
    grad_offset = np.array([rotation.T @ g for g in grad_q]).reshape(-1, 3)
    return grad_offset, -np.sum(grad_q, axis=0)


def map_position(q, clip_from_light, width, height):
    """the divide is by the distance -q_z instead of w, which is 1 in parallel light

    told by: -q_z | by the distance | by z | w is 1 | orthographic | parallel | light from a direction
    """
    away = -q[:, 2]
    x = (clip_from_light[0, 0] * q[:, 0] / away + 1) * width / 2
    y = (clip_from_light[1, 1] * q[:, 1] / away + 1) * height / 2
    return np.stack([x, y], axis=1)


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """w is held, so q_z gets no gradient

    told by: q_z | grad_w | through w | w & held | w & constant | third component | depend & w
    """
    grad = np.zeros(q.shape)
    w = w_of(q, clip_from_light)
    grad[:, 0] = grad_place[:, 0] * clip_from_light[0, 0] * width / 2 / w
    grad[:, 1] = grad_place[:, 1] * clip_from_light[1, 1] * height / 2 / w
    return grad


def distance_of_depth(depth, clip_from_light):
    """depth is taken to be linear in the distance between the near and the far plane

    told by: linear | near and far | near & far & evenly | proportion | straight line | perspective | 1 / distance
    """
    (a, b), (c, d) = clip_from_light[2:, 2:]
    near = (-d - b) / (-c - a)
    far = (d - b) / (c - a)
    return near + (depth + 1) / 2 * (far - near)


def is_lit(distance_map, place, distance, bias):
    """the bias is on the wrong side: added to the distance instead of the stored distance

    told by: wrong side | other side | bias & sign | bias & added to the distance | bias & subtract | distance + bias | stored - bias
    """
    return distance + bias <= stored_distance(distance_map, place)


def distance_slopes(normal, q, clip_from_light, width, height):
    """1 / (C_00 width) stands where 2 / (C_00 width) should be: clip space is 2 wide, not 1

    told by: half | factor & 2 | factor of two | twice | 1/2 | 2 wide | -1 to 1
    """
    w = w_of(q, clip_from_light)
    c = clip_from_light
    ray = np.stack([-c[3, 2] * q[:, 0] / w, -c[3, 2] * q[:, 1] / w, -np.ones(len(q))], 1)
    facing = (normal * ray).sum(1)
    small = np.abs(facing) < GRAZING
    facing[small] = np.where(facing[small] < 0, -GRAZING, GRAZING)
    slopes = -normal[:, :2] * (w / facing)[:, None]
    return slopes / [c[0, 0] * width, c[1, 1] * height]


def slope_scaled_bias(slope, constant, factor, most):
    """the larger of the two slopes is taken instead of their sum

    told by: larger of | maximum & slope | max & slope | sum & slope | both slopes | only one & slope | sum of both
    """
    bias = constant + factor * np.abs(slope).max(1) / 2
    return np.clip(bias, None, most)
