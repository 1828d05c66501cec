"""Wrong answers to shadow_mapping, written without a look at the checks."""


def to_light(points, position, rotation):
    """multiplied by rotation instead of its transpose, as if the light's axes were its columns

    told by: transpos | columns | rotation.T | inverse & rotation | turn & other way | rotat & other way | back into the world
    """
    offset = points - position
    return np.einsum("nj,jk->nk", offset, rotation)


def to_light(points, position, rotation):
    """rotation p - position: the position is taken away after the rotation instead of before it

    told by: after the rotation | after rotat | before rotat | before the rotation | position & not rotated | position & not turned | rotation p - position | turned first
    """
    turned = np.array([rotation @ p for p in points]).reshape(-1, 3)
    return turned - position


def to_light(points, position, rotation):
    """z is turned so that it grows away from the light, but the light looks down its -z axis

    told by: sign & z | -q_z | z & negat | z & flipped | z & mirrored | third & sign | left-handed | sign & [..., 2]
    """
    q = (points - position) @ rotation.T
    q[:, 2] *= -1
    return q


def to_light_backward(grad_q, points, position, rotation):
    """grad_position is not rotated into the world's axes

    told by: grad_position & rotat | grad_position & turned | grad_position & axes | grad_position & frame | light's frame | light's axes | world's axes
    """
    grad_offset = np.array([rotation.T @ g for g in grad_q]).reshape(-1, 3)
    return grad_offset, -np.sum(grad_q, axis=0)


def map_position(q, clip_from_light, width, height):
    """y counts down from the top: height minus the right y

    told by: upside down | flipped | y & down | y & top | y & sign | y & mirror | height - y
    """
    w = w_of(q, clip_from_light)
    x_ndc = clip_from_light[0, 0] * q[:, 0] / w
    y_ndc = clip_from_light[1, 1] * q[:, 1] / w
    return np.column_stack([(x_ndc + 1) * width / 2, (1 - y_ndc) * height / 2])


def map_position(q, clip_from_light, width, height):
    """width - 1 and height - 1 in place of width and height

    told by: width - 1 | size - 1 | W - 1 | height - 1 | minus 1 | minus one | one texel less
    """
    w = w_of(q, clip_from_light)
    out = np.empty((len(q), 2))
    for axis, size in enumerate((width, height)):
        out[:, axis] = (clip_from_light[axis, axis] * q[:, axis] / w + 1) / 2 * (size - 1)
    return out


def map_position(q, clip_from_light, width, height):
    """the divide is by the distance -q_z instead of w, which is 1 in parallel light

    told by: -q_z | by the distance | by z | w is 1 | orthographic | parallel | light from a direction
    """
    away = -q[:, 2]
    x = (clip_from_light[0, 0] * q[:, 0] / away + 1) * width / 2
    y = (clip_from_light[1, 1] * q[:, 1] / away + 1) * height / 2
    return np.stack([x, y], axis=1)


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """C_32 is missing in grad_q_z: the gradient of w is passed on to q_z as it is

    told by: C_32 | sign & q_z | sign & z | q_z & opposite | dw / dq_z | dw/dq_z | grad_w
    """
    w = w_of(q, clip_from_light)
    grad_q = np.zeros_like(q)
    grad_w = np.zeros(len(q))
    for axis, size in enumerate((width, height)):
        scale = clip_from_light[axis, axis] * size / 2
        grad_q[:, axis] = grad_place[:, axis] * scale / w
        grad_w -= grad_place[:, axis] * scale * q[:, axis] / w**2
    grad_q[:, 2] = grad_w
    return grad_q


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


def is_lit(distance_map, place, distance, bias):
    """x and y of the place are exchanged: the map is read at [floor x, floor y]

    told by: x and y | transpos | swapped | exchanged | row and column | rows and columns | [floor x
    """
    rows, columns = distance_map.shape
    lit = np.ones(len(place), bool)
    limit = np.broadcast_to(bias, lit.shape)
    for n, (x, y) in enumerate(np.floor(place).astype(int)):
        if 0 <= x < rows and 0 <= y < columns:
            lit[n] = distance[n] <= distance_map[x, y] + limit[n]
    return lit


def is_lit(distance_map, place, distance, bias):
    """|distance - stored| <= bias, so a point well before the stored surface is dark

    told by: absolute | distance - stored | nearer & lit | nearer & shadow | in front of the stored | before the stored | within the bias
    """
    gap = distance - stored_distance(distance_map, place)
    return np.isinf(gap) | (np.abs(gap) <= bias)


def distance_slopes(normal, q, clip_from_light, width, height):
    """the ray is (0, 0, -1) everywhere, as in parallel light

    told by: parallel | (0, 0, -1) | orthographic | ray & axis | n_z alone | only n_z | ray & same
    """
    w = w_of(q, clip_from_light)
    facing = -normal[:, 2]
    facing = np.where(np.abs(facing) < GRAZING, np.where(facing < 0, -GRAZING, GRAZING), facing)
    slope = np.zeros((len(q), 2))
    for axis, size in enumerate((width, height)):
        slope[:, axis] = -w * normal[:, axis] / facing * 2 / (clip_from_light[axis, axis] * size)
    return slope


def slope_scaled_bias(slope, constant, factor, most):
    """the length of the slope (square root of the squares) instead of |slope_x| + |slope_y|

    told by: euclid | square root | hypot | length of the slope | slope's length | norm | slope_x & slope_y & sum
    """
    steep = np.linalg.norm(slope, axis=1)
    return np.minimum(constant + factor * steep / 2, most)


def to_light(points, position, rotation):
    """rotation is not transposed: the points are turned the other way

    told by: transpose | other way | inverse & rotation | columns | rotation.t | rows & axes | backwards
    """
    return (points - position) @ rotation


def to_light(points, position, rotation):
    """the points are turned first, and then the position is subtracted, which lies in the world's frame

    told by: first & rotat | turned & first | before & rotat | before & turn | position & not rotated | position & not turned | position & world
    """
    turned = np.array([rotation @ p for p in points])
    return turned - position


def map_position(q, clip_from_light, width, height):
    """half a texel is subtracted, so the places are half a texel off

    told by: half a texel | half a pixel | half texel | 1/2 texel | 0.5 & off | texel centre | 0.5 less
    """
    w = w_of(q, clip_from_light)
    ndc = np.stack([clip_from_light[0, 0] * q[:, 0], clip_from_light[1, 1] * q[:, 1]], 1) / w[:, None]
    return (ndc + 1) * [width / 2, height / 2] - 0.5


def map_position(q, clip_from_light, width, height):
    """y is flipped, as if it went down from the top of the map

    told by: flip | upside down | y & down | y & sign | mirror | from the top
    """
    places = np.zeros((len(q), 2))
    for n, w in enumerate(w_of(q, clip_from_light)):
        places[n, 0] = (q[n, 0] * clip_from_light[0, 0] / w + 1) * width / 2
        places[n, 1] = (1 - q[n, 1] * clip_from_light[1, 1] / w) * height / 2
    return places


def map_position(q, clip_from_light, width, height):
    """the division by w is left out

    told by: divi & w | by w | perspective | / w | w is left out | without w
    """
    scale = clip_from_light[[0, 1], [0, 1]]
    return (scale * q[:, :2] + 1) * np.array([width, height]) / 2


def is_lit(distance_map, place, distance, bias):
    """the bias is added to the point's distance, which makes shadows larger, and not to the stored one

    told by: sign & bias | bias & wrong side | bias & subtract | bias & opposite | bias & other side | bias & added & distance | bias & to the distance
    """
    return distance + bias <= stored_distance(distance_map, place)


def is_lit(distance_map, place, distance, bias):
    """np.isclose asks whether both distances are equal: a point before the stored one, or off the map, is lit too

    told by: isclose | equal | nearer & lit | before the stored | outside the map | in front of | np.inf
    """
    stored = stored_distance(distance_map, place)
    return np.isclose(distance, stored, rtol=0, atol=bias)


def to_light_backward(grad_q, points, position, rotation):
    """grad_position has the sign of the points' gradient, but the position is subtracted

    told by: sign | minus | negat | subtracted | opposite
    """
    by_points = np.array([rotation.T @ g for g in grad_q])
    return by_points, by_points.sum(0)


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """w is held, so q_z gets no gradient

    told by: q_z | grad_w | through w | w & held | w & constant | third component | depend & w
    """
    grad = np.zeros(q.shape)
    w = w_of(q, clip_from_light)
    grad[:, 0] = grad_place[:, 0] * clip_from_light[0, 0] * width / 2 / w
    grad[:, 1] = grad_place[:, 1] * clip_from_light[1, 1] * height / 2 / w
    return grad


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
