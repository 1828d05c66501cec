"""Mistakes of lab 14; each docstring goes on after "this is what comes out when"."""


def to_light_backward(grad_q, points, position, rotation):
    """grad_position is not turned by the rotation: it is the sum of -grad_q"""
    return grad_q @ rotation, -grad_q.sum(0)


def map_position(q, clip_from_light, width, height):
    """x and y are not divided by w"""
    x = (clip_from_light[0, 0] * q[:, 0] + 1) * (width / 2)
    y = (clip_from_light[1, 1] * q[:, 1] + 1) * (height / 2)
    return np.stack([x, y], -1)


def map_position(q, clip_from_light, width, height):
    """it is divided by q_z instead of w, so a cone's map is turned about its middle: w = -q_z
    there"""
    x = (clip_from_light[0, 0] * q[:, 0] / q[:, 2] + 1) * (width / 2)
    y = (clip_from_light[1, 1] * q[:, 1] / q[:, 2] + 1) * (height / 2)
    return np.stack([x, y], -1)


def is_lit(distance_map, place, distance, bias):
    """the comparison is turned round: what lies behind the stored surface is lit, and what lies
    before it is dark"""
    return distance >= stored_distance(distance_map, place) + bias


def is_lit(distance_map, place, distance, bias):
    """it is < instead of <=: a point at exactly stored + bias is lit"""
    return distance < stored_distance(distance_map, place) + bias


def is_lit(distance_map, place, distance, bias):
    """the absolute difference is compared with the bias, so a point before the stored surface,
    nearer than it, is dark"""
    return np.abs(distance - stored_distance(distance_map, place)) <= bias


def is_lit(distance_map, place, distance, bias):
    """the answer is the opposite: True where a point is in shadow"""
    return distance > stored_distance(distance_map, place) + bias


def distance_slopes(normal, q, clip_from_light, width, height):
    """a texel is taken for 1 / width: clip space is 2 wide, so it is 2 / width"""
    w = w_of(q, clip_from_light)
    along = (normal[:, :2] * q[:, :2]).sum(1) * -clip_from_light[3, 2] / w - normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    slope_x = -w * normal[:, 0] / along / (clip_from_light[0, 0] * width)
    slope_y = -w * normal[:, 1] / along / (clip_from_light[1, 1] * height)
    return np.stack([slope_x, slope_y], -1)


def distance_slopes(normal, q, clip_from_light, width, height):
    """the slopes are to a unit of the world; they are to a texel, 2 w / (C_00 width) wide"""
    w = w_of(q, clip_from_light)
    along = (normal[:, :2] * q[:, :2]).sum(1) * -clip_from_light[3, 2] / w - normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    return -normal[:, :2] / along[:, None]


def distance_slopes(normal, q, clip_from_light, width, height):
    """w is left out: a cone's texel is wider the farther it is from the light"""
    w = w_of(q, clip_from_light)
    along = (normal[:, :2] * q[:, :2]).sum(1) * -clip_from_light[3, 2] / w - normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    slope_x = -normal[:, 0] / along * (2 / (clip_from_light[0, 0] * width))
    slope_y = -normal[:, 1] / along * (2 / (clip_from_light[1, 1] * height))
    return np.stack([slope_x, slope_y], -1)


def slope_scaled_bias(slope, constant, factor, most):
    """the limit, most, is put on the slopes' part alone, and the constant is added after that; it
    is for the whole bias"""
    return constant + np.minimum(factor * np.abs(slope).sum(1) / 2, most)
