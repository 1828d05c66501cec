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
    return np.stack([x, y], -1)


def map_position(q, clip_from_light, width, height):
    """y goes with C_00 or the width, as x does; it has C_11 and the height"""
    w = w_of(q, clip_from_light)
    x = (clip_from_light[0, 0] * q[:, 0] / w + 1) * (width / 2)
    y = (clip_from_light[1, 1] * q[:, 1] / w + 1) * (width / 2)
    return np.stack([x, y], -1)


def map_position(q, clip_from_light, width, height):
    """ndc is taken to be 1 wide; it is 2 wide"""
    w = w_of(q, clip_from_light)
    x = (clip_from_light[0, 0] * q[:, 0] / w + 1) * width
    y = (clip_from_light[1, 1] * q[:, 1] / w + 1) * (height / 2)
    return np.stack([x, y], -1)


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """q_z has no gradient; but w depends on it"""
    w = w_of(q, clip_from_light)
    grad_q_x = grad_place[:, 0] * clip_from_light[0, 0] * (width / 2) / w
    grad_q_y = grad_place[:, 1] * clip_from_light[1, 1] * (height / 2) / w
    return np.stack([grad_q_x, grad_q_y, np.zeros(len(q))], -1)


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """the gradient by w has the wrong sign"""
    w = w_of(q, clip_from_light)
    grad_q_x = grad_place[:, 0] * clip_from_light[0, 0] * (width / 2) / w
    grad_q_y = grad_place[:, 1] * clip_from_light[1, 1] * (height / 2) / w
    grad_w = (grad_q_x * q[:, 0] + grad_q_y * q[:, 1]) / w
    return np.stack([grad_q_x, grad_q_y, clip_from_light[3, 2] * grad_w], -1)


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """the gradient by w is divided by w once; the derivative of 1 / w is -1 / w^2"""
    w = w_of(q, clip_from_light)
    grad_q_x = grad_place[:, 0] * clip_from_light[0, 0] * (width / 2) / w
    grad_q_y = grad_place[:, 1] * clip_from_light[1, 1] * (height / 2) / w
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


def is_lit(distance_map, place, distance, bias):
    """what lies behind is lit, and what lies before is dark"""
    return distance >= stored_distance(distance_map, place) + bias


def is_lit(distance_map, place, distance, bias):
    """the bias makes more shadow; it lets light through"""
    return distance <= stored_distance(distance_map, place) - bias


def is_lit(distance_map, place, distance, bias):
    """there is no bias"""
    return distance <= stored_distance(distance_map, place)


def distance_slopes(normal, q, clip_from_light, width, height):
    """the slope by x has the wrong sign"""
    w = w_of(q, clip_from_light)
    along = (normal[:, :2] * q[:, :2]).sum(1) * -clip_from_light[3, 2] / w - normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    slope_x = w * normal[:, 0] / along * (2 / (clip_from_light[0, 0] * width))
    slope_y = -w * normal[:, 1] / along * (2 / (clip_from_light[1, 1] * height))
    return np.stack([slope_x, slope_y], -1)


def distance_slopes(normal, q, clip_from_light, width, height):
    """the ray is the light's axis in a cone, too; it is q / distance"""
    w = w_of(q, clip_from_light)
    along = -normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    slope_x = -w * normal[:, 0] / along * (2 / (clip_from_light[0, 0] * width))
    slope_y = -w * normal[:, 1] / along * (2 / (clip_from_light[1, 1] * height))
    return np.stack([slope_x, slope_y], -1)


def distance_slopes(normal, q, clip_from_light, width, height):
    """the slope by y is to a unit of the world; it is to a texel"""
    w = w_of(q, clip_from_light)
    along = (normal[:, :2] * q[:, :2]).sum(1) * -clip_from_light[3, 2] / w - normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    slope_x = -w * normal[:, 0] / along * (2 / (clip_from_light[0, 0] * width))
    slope_y = -w * normal[:, 1] / along
    return np.stack([slope_x, slope_y], -1)


def slope_scaled_bias(slope, constant, factor, most):
    """slopes of opposite signs cancel: |slope| is added"""
    return np.minimum(constant + factor * slope.sum(1) / 2, most)


def slope_scaled_bias(slope, constant, factor, most):
    """the half is missing: a point is at most half a texel off"""
    return np.minimum(constant + factor * np.abs(slope).sum(1), most)


def slope_scaled_bias(slope, constant, factor, most):
    """the limit is for the slopes' part alone; it is for the whole bias"""
    return constant + np.minimum(factor * np.abs(slope).sum(1) / 2, most)
