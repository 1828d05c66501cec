"""Mistakes of lab 14; each docstring goes on after "this is what comes out when"."""


def to_light(points, position, rotation):
    """rotation is not transposed: points are rows, so it is rotation.T that turns them to the
    light's axes, its rows"""
    return (points - position) @ rotation


def to_light(points, position, rotation):
    """the position is added instead of subtracted"""
    return (points + position) @ rotation.T


def to_light(points, position, rotation):
    """points are turned first, and the position is subtracted after that, without being turned"""
    return points @ rotation.T - position


def to_light(points, position, rotation):
    """the position is not subtracted: points are only turned by the rotation"""
    return points @ rotation.T


def to_light(points, position, rotation):
    """it is position - p instead of p - position: all signs are wrong"""
    return (position - points) @ rotation.T


def to_light(points, position, rotation):
    """rotation multiplies from the left, as it does a single point; points are rows, so it is
    transposed and multiplied from the right"""
    return rotation @ (points - position)


def to_light_backward(grad_q, points, position, rotation):
    """the gradient is turned by rotation.T, as the points are, instead of by its transpose,
    rotation"""
    grad_points = grad_q @ rotation.T
    return grad_points, -grad_points.sum(0)


def to_light_backward(grad_q, points, position, rotation):
    """grad_position has the wrong sign: its minus is missing"""
    grad_points = grad_q @ rotation
    return grad_points, grad_points.sum(0)


def to_light_backward(grad_q, points, position, rotation):
    """grad_position is the mean over the points instead of the sum"""
    grad_points = grad_q @ rotation
    return grad_points, -grad_points.mean(0)


def to_light_backward(grad_q, points, position, rotation):
    """grad_position is not turned by the rotation: it is the sum of -grad_q"""
    return grad_q @ rotation, -grad_q.sum(0)


def map_position(q, clip_from_light, width, height):
    """x and y are not divided by w"""
    x = (clip_from_light[0, 0] * q[:, 0] + 1) * (width / 2)
    y = (clip_from_light[1, 1] * q[:, 1] + 1) * (height / 2)
    return np.stack([x, y], -1)


def map_position(q, clip_from_light, width, height):
    """y is counted downwards from the top; row 0 is at the bottom"""
    w = w_of(q, clip_from_light)
    x = (clip_from_light[0, 0] * q[:, 0] / w + 1) * (width / 2)
    y = (1 - clip_from_light[1, 1] * q[:, 1] / w) * (height / 2)
    return np.stack([x, y], -1)


def map_position(q, clip_from_light, width, height):
    """the half is missing: ndc is 2 wide, so it is (ndc + 1) width / 2"""
    w = w_of(q, clip_from_light)
    x = (clip_from_light[0, 0] * q[:, 0] / w + 1) * width
    y = (clip_from_light[1, 1] * q[:, 1] / w + 1) * height
    return np.stack([x, y], -1)


def map_position(q, clip_from_light, width, height):
    """the + 1 is missing: the middle of the map is at (width / 2, height / 2), not at 0"""
    w = w_of(q, clip_from_light)
    x = clip_from_light[0, 0] * q[:, 0] / w * (width / 2)
    y = clip_from_light[1, 1] * q[:, 1] / w * (height / 2)
    return np.stack([x, y], -1)


def map_position(q, clip_from_light, width, height):
    """y has C_00, as x does, instead of C_11"""
    w = w_of(q, clip_from_light)
    x = (clip_from_light[0, 0] * q[:, 0] / w + 1) * (width / 2)
    y = (clip_from_light[0, 0] * q[:, 1] / w + 1) * (height / 2)
    return np.stack([x, y], -1)


def map_position(q, clip_from_light, width, height):
    """it is divided by q_z instead of w, so a cone's map is turned about its middle: w = -q_z
    there"""
    x = (clip_from_light[0, 0] * q[:, 0] / q[:, 2] + 1) * (width / 2)
    y = (clip_from_light[1, 1] * q[:, 1] / q[:, 2] + 1) * (height / 2)
    return np.stack([x, y], -1)


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """w is held as a constant: the gradient through w, that with respect to q_z, is missing"""
    w = w_of(q, clip_from_light)
    grad_q_x = grad_place[:, 0] * clip_from_light[0, 0] * (width / 2) / w
    grad_q_y = grad_place[:, 1] * clip_from_light[1, 1] * (height / 2) / w
    return np.stack([grad_q_x, grad_q_y, np.zeros(len(q))], -1)


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """the gradient through w, that with respect to q_z, has the wrong sign"""
    w = w_of(q, clip_from_light)
    grad_q_x = grad_place[:, 0] * clip_from_light[0, 0] * (width / 2) / w
    grad_q_y = grad_place[:, 1] * clip_from_light[1, 1] * (height / 2) / w
    grad_w = (grad_q_x * q[:, 0] + grad_q_y * q[:, 1]) / w
    return np.stack([grad_q_x, grad_q_y, clip_from_light[3, 2] * grad_w], -1)


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """the gradient through w is divided by w once only; the derivative of 1 / w is -1 / w^2"""
    w = w_of(q, clip_from_light)
    grad_q_x = grad_place[:, 0] * clip_from_light[0, 0] * (width / 2) / w
    grad_q_y = grad_place[:, 1] * clip_from_light[1, 1] * (height / 2) / w
    grad_w = -(grad_q_x * q[:, 0] + grad_q_y * q[:, 1])
    return np.stack([grad_q_x, grad_q_y, clip_from_light[3, 2] * grad_w], -1)


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """only x's share reaches q_z: that of y is forgotten"""
    w = w_of(q, clip_from_light)
    grad_q_x = grad_place[:, 0] * clip_from_light[0, 0] * (width / 2) / w
    grad_q_y = grad_place[:, 1] * clip_from_light[1, 1] * (height / 2) / w
    return np.stack([grad_q_x, grad_q_y, -clip_from_light[3, 2] * grad_q_x * q[:, 0] / w], -1)


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """C_32 is left out: dw / dq_z is taken for 1, so the gradient with respect to q_z has the wrong
    sign in a cone"""
    w = w_of(q, clip_from_light)
    grad_q_x = grad_place[:, 0] * clip_from_light[0, 0] * (width / 2) / w
    grad_q_y = grad_place[:, 1] * clip_from_light[1, 1] * (height / 2) / w
    return np.stack([grad_q_x, grad_q_y, -(grad_q_x * q[:, 0] + grad_q_y * q[:, 1]) / w], -1)


def distance_of_depth(depth, clip_from_light):
    """the sign is wrong: q_z is returned, and the distance is -q_z"""
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


def distance_of_depth(depth, clip_from_light):
    """the depth is taken for linear: it is z / w, and the division by w is not undone"""
    distance = np.full(depth.shape, np.inf)
    seen = np.isfinite(depth)
    distance[seen] = (clip_from_light[2, 3] - depth[seen]) / clip_from_light[2, 2]
    return distance


def is_lit(distance_map, place, distance, bias):
    """the comparison is turned round: what lies behind the stored surface is lit, and what lies
    before it is dark"""
    return distance >= stored_distance(distance_map, place) + bias


def is_lit(distance_map, place, distance, bias):
    """the bias is subtracted instead of added: it makes more shadow"""
    return distance <= stored_distance(distance_map, place) - bias


def is_lit(distance_map, place, distance, bias):
    """the bias is left out"""
    return distance <= stored_distance(distance_map, place)


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
    """the ray is (0, 0, -1), as in parallel light: a cone's rays are not parallel"""
    w = w_of(q, clip_from_light)
    along = -normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    slope_x = -w * normal[:, 0] / along * (2 / (clip_from_light[0, 0] * width))
    slope_y = -w * normal[:, 1] / along * (2 / (clip_from_light[1, 1] * height))
    return np.stack([slope_x, slope_y], -1)


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


def distance_slopes(normal, q, clip_from_light, width, height):
    """the sign of n . ray is lost: GRAZING stands also where n . ray is negative, instead of
    -GRAZING"""
    w = w_of(q, clip_from_light)
    along = (normal[:, :2] * q[:, :2]).sum(1) * -clip_from_light[3, 2] / w - normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, GRAZING, along)
    slope_x = -w * normal[:, 0] / along * (2 / (clip_from_light[0, 0] * width))
    slope_y = -w * normal[:, 1] / along * (2 / (clip_from_light[1, 1] * height))
    return np.stack([slope_x, slope_y], -1)


def distance_slopes(normal, q, clip_from_light, width, height):
    """the ray has length 1; in eq. (4) its third number is -1, and it is longer"""
    w = w_of(q, clip_from_light)
    ray = np.column_stack([-clip_from_light[3, 2] * q[:, :2] / w[:, None], -np.ones(len(q))])
    along = (normal * ray).sum(1) / np.linalg.norm(ray, axis=1)
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    slope_x = -w * normal[:, 0] / along * (2 / (clip_from_light[0, 0] * width))
    slope_y = -w * normal[:, 1] / along * (2 / (clip_from_light[1, 1] * height))
    return np.stack([slope_x, slope_y], -1)


def slope_scaled_bias(slope, constant, factor, most):
    """slopes of opposite signs cancel: the absolute values are to be added"""
    return np.minimum(constant + factor * slope.sum(1) / 2, most)


def slope_scaled_bias(slope, constant, factor, most):
    """the half is missing: a point is at most half a texel from the centre"""
    return np.minimum(constant + factor * np.abs(slope).sum(1), most)


def slope_scaled_bias(slope, constant, factor, most):
    """the limit, most, is put on the slopes' part alone, and the constant is added after that; it
    is for the whole bias"""
    return constant + np.minimum(factor * np.abs(slope).sum(1) / 2, most)


def slope_scaled_bias(slope, constant, factor, most):
    """the Euclidean length of the slope is taken, the root of its squares, instead of the sum of
    the absolute values"""
    return np.minimum(constant + factor * np.linalg.norm(slope, axis=1) / 2, most)
