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
    """the light looks along +z: the z coordinate is turned round so that it is the distance

    told by: sign & q_z | sign of z | sign of the z | +z | z is flipped | z is positive | -z | sign & [..., 2] | third coordinate
    """
    local = (points - position) @ rotation.T
    local[:, 2] = -local[:, 2]
    return local


def to_light_backward(grad_q, points, position, rotation):
    """grad_position is the mean over the points, not the sum

    told by: mean | average | sum & position | divided by n | number of points
    """
    grad_points = grad_q @ rotation
    return grad_points, -grad_points.mean(0)


def map_position(q, clip_from_light, width, height):
    """the division by w is left out

    told by: divided by w | divide by w | division by w | / w | perspective | without w
    """
    x = (clip_from_light[0, 0] * q[:, 0] + 1) * width / 2
    y = (clip_from_light[1, 1] * q[:, 1] + 1) * height / 2
    return np.stack([x, y], axis=1)


def map_position(q, clip_from_light, width, height):
    """pixel centres are taken to be at integers: half a texel is subtracted

    told by: half a texel | half a pixel | 0.5 | 1/2 | centre & integer
    """
    w = w_of(q, clip_from_light)
    out = np.zeros((len(q), 2))
    for i in range(len(q)):
        out[i, 0] = (clip_from_light[0, 0] * q[i, 0] / w[i] + 1) * width / 2 - 0.5
        out[i, 1] = (clip_from_light[1, 1] * q[i, 1] / w[i] + 1) * height / 2 - 0.5
    return out


def distance_of_depth(depth, clip_from_light):
    """the result is q_z, without the minus that makes it a distance

    told by: sign | minus | negative | -q_z
    """
    result = np.full(depth.shape, np.inf)
    ok = depth < np.inf
    c22, c23 = clip_from_light[2, 2], clip_from_light[2, 3]
    c32, c33 = clip_from_light[3, 2], clip_from_light[3, 3]
    result[ok] = (c23 - c33 * depth[ok]) / (c32 * depth[ok] - c22)
    return result


def distance_of_depth(depth, clip_from_light):
    """the depth is taken for OpenGL's window depth from 0 to 1 and mapped to -1 to 1 first

    told by: 0 to 1 | 0 and 1 | [0, 1] | 2 * depth | -1 to 1 | opengl | window
    """
    (c22, c23), (c32, c33) = clip_from_light[2:, 2:]
    out = np.full(depth.shape, np.inf)
    ok = np.isfinite(depth)
    ndc = 2 * depth[ok] - 1
    out[ok] = (c33 * ndc - c23) / (c32 * ndc - c22)
    return out


def is_lit(distance_map, place, distance, bias):
    """the bias is on the wrong side: it makes the point more distant and so darker

    told by: bias & side | bias & sign | bias & subtract | bias & added to | bias & minus | bias & negative
    """
    return distance + bias <= stored_distance(distance_map, place)


def is_lit(distance_map, place, distance, bias):
    """the comparison is the other way round: it says which points are in shadow

    told by: in shadow | other way round | comparison & turned | reversed | inverted | opposite | negated | >=
    """
    return distance > stored_distance(distance_map, place) + bias


def is_lit(distance_map, place, distance, bias):
    """the bias is forgotten

    told by: forg & bias | without & bias | bias & missing | bias & ignor | bias & left out | no bias | acne
    """
    return distance <= stored_distance(distance_map, place)


def distance_slopes(normal, q, clip_from_light, width, height):
    """the factor w is left out, which is 1 only in parallel light

    told by: factor w | times w | w is left out | w is missing | without w | multiplied by w
    """
    w = w_of(q, clip_from_light)
    slopes = np.zeros((len(q), 2))
    for i in range(len(q)):
        ray = np.array([-clip_from_light[3, 2] * q[i, 0] / w[i], -clip_from_light[3, 2] * q[i, 1] / w[i], -1.0])
        d = normal[i] @ ray
        if abs(d) < GRAZING:
            d = -GRAZING if d < 0 else GRAZING
        slopes[i, 0] = -normal[i, 0] / d * 2 / (clip_from_light[0, 0] * width)
        slopes[i, 1] = -normal[i, 1] / d * 2 / (clip_from_light[1, 1] * height)
    return slopes


def slope_scaled_bias(slope, constant, factor, most):
    """only the slope's part is bounded by most, and the constant is added after

    told by: constant & after | clip & before | most & constant | bound & slope | limit & slope | minimum & sum
    """
    bias = np.zeros(len(slope))
    for i, (sx, sy) in enumerate(slope):
        bias[i] = constant + min(factor * (abs(sx) + abs(sy)) / 2, most)
    return bias


def map_position(q, clip_from_light, width, height):
    """the result has the shape (2, N) and not (N, 2)

    told by: (2, | shape | transpos | rows and columns are swapped | (n, 2)
    """
    w = w_of(q, clip_from_light)
    x = (clip_from_light[0, 0] * q[:, 0] / w + 1) * width / 2
    y = (clip_from_light[1, 1] * q[:, 1] / w + 1) * height / 2
    return np.stack([x, y])


def is_lit(distance_map, place, distance, bias):
    """one answer for all points, np.all, and not one for each

    told by: one answer | all( | .all | for each point | each point | shape | single
    """
    return np.all(distance <= stored_distance(distance_map, place) + bias)
