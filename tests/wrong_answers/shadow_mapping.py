"""Wrong answers to shadow_mapping, written without a look at the checks."""


def to_light(points, position, rotation):
    """the rotation is not transposed: its columns are taken for the light's axes, which turns the wrong way

    told by: transpos | rotation.t | columns & axes | rows & axes | inverse & rotation | turn & other way | turned back
    """
    return (points - position) @ rotation


def to_light(points, position, rotation):
    """the points are turned first and the position is subtracted after, without having been turned

    told by: turned first | rotat & first | before & rotat | subtract & after | position & not & rotat | position & not & turned | wrong order | other order
    """
    turned = np.einsum("ij,nj->ni", rotation, points)
    return turned - position


def to_light(points, position, rotation):
    """the position is added, not subtracted

    told by: add & position | + position | subtract & position | sign & position | plus & position
    """
    q = np.empty(points.shape)
    for i, p in enumerate(points):
        q[i] = rotation @ (p + position)
    return q


def to_light(points, position, rotation):
    """position - p instead of p - position, so that all of q has the other sign

    told by: position - p | p - position | sign | negat | opposite | minus
    """
    d = position[None, :] - points
    return d @ rotation.T


def to_light(points, position, rotation):
    """the position is not subtracted at all: only the rotation is applied

    told by: forg & position | without & position | position & not subtract | position & missing | ignor & position | only & rotat
    """
    return points @ rotation.T


def to_light_backward(grad_q, points, position, rotation):
    """the gradient goes through the same rotation.T as the points, not through its transpose, rotation

    told by: transpos | rotation.t | turn & back | inverse & rotation | same & rotation
    """
    grad_points = grad_q @ rotation.T
    return grad_points, -grad_points.sum(axis=0)


def to_light_backward(grad_q, points, position, rotation):
    """the minus of grad_position is missing

    told by: sign & grad_position | minus & grad_position | sign & position | minus & position | negat & position
    """
    grad_points = np.array([rotation.T @ g for g in grad_q])
    grad_position = grad_points.sum(axis=0)
    return grad_points, grad_position


def map_position(q, clip_from_light, width, height):
    """y is counted downwards from the top, as in OpenCV or a window system

    told by: upside down | downward | flip | from the top | sign of y | bottom
    """
    w = w_of(q, clip_from_light)
    ndc_x = clip_from_light[0, 0] * q[:, 0] / w
    ndc_y = clip_from_light[1, 1] * q[:, 1] / w
    return np.column_stack([(ndc_x + 1) * 0.5 * width, (1 - ndc_y) * 0.5 * height])


def map_position(q, clip_from_light, width, height):
    """width and height are exchanged

    told by: width & height | exchanged | swapped | mixed up
    """
    w = w_of(q, clip_from_light)
    x = (clip_from_light[0, 0] * q[:, 0] / w + 1) * height / 2
    y = (clip_from_light[1, 1] * q[:, 1] / w + 1) * width / 2
    return np.stack([x, y], -1)


def map_position(q, clip_from_light, width, height):
    """the places are in whole texels: rounded down to integers

    told by: integer | round | floor | whole | truncat
    """
    w = w_of(q, clip_from_light)
    x = (clip_from_light[0, 0] * q[:, 0] / w + 1) * width / 2
    y = (clip_from_light[1, 1] * q[:, 1] / w + 1) * height / 2
    return np.floor(np.stack([x, y], -1))


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """w is held: the gradient through w with respect to q_z is left out

    told by: through w | gradient & q_z | q_z is 0 | q_z gets | w is held | w is constant | w as a constant | depends on w
    """
    w = w_of(q, clip_from_light)
    grad_q = np.zeros_like(q)
    grad_q[:, 0] = grad_place[:, 0] * clip_from_light[0, 0] * width / 2 / w
    grad_q[:, 1] = grad_place[:, 1] * clip_from_light[1, 1] * height / 2 / w
    return grad_q


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """the gradient with respect to w has no C_32: dw / dq_z is taken for 1, so q_z's gradient has the wrong sign

    told by: c_32 | dw/dq_z | dw / dq_z | sign & q_z | sign of z | clip_from_light[3, 2]
    """
    w = w_of(q, clip_from_light)
    gx = grad_place[:, 0] * clip_from_light[0, 0] * width / (2 * w)
    gy = grad_place[:, 1] * clip_from_light[1, 1] * height / (2 * w)
    gz = -(gx * q[:, 0] + gy * q[:, 1]) / w
    return np.stack([gx, gy, gz], axis=1)


def map_position_backward(grad_place, q, clip_from_light, width, height):
    """only x's share reaches q_z, that of y is forgotten

    told by: share of y | y's share | that of y | only x | y's part | both x and y | both & q_z
    """
    w = w_of(q, clip_from_light)
    gx = grad_place[:, 0] * clip_from_light[0, 0] * width / (2 * w)
    gy = grad_place[:, 1] * clip_from_light[1, 1] * height / (2 * w)
    gz = -clip_from_light[3, 2] * gx * q[:, 0] / w
    return np.stack([gx, gy, gz], axis=1)


def distance_of_depth(depth, clip_from_light):
    """fine print: empty texels, where depth is np.inf, become nan and not np.inf

    told by: nan | np.inf | infinite | empty | sees nothing | background
    """
    (c22, c23), (c32, c33) = clip_from_light[2:, 2:]
    with np.errstate(all="ignore"):
        return (c33 * depth - c23) / (c32 * depth - c22)


def distance_of_depth(depth, clip_from_light):
    """the depth is treated as linear: clip space's z is not divided by w

    told by: linear | divided by w | perspective | times w | c_32 | division by w
    """
    out = np.full(depth.shape, np.inf)
    for row in range(depth.shape[0]):
        for column in range(depth.shape[1]):
            d = depth[row, column]
            if np.isfinite(d):
                out[row, column] = (clip_from_light[2, 3] - d) / clip_from_light[2, 2]
    return out


def is_lit(distance_map, place, distance, bias):
    """< instead of <=: a point at exactly stored + bias counts as in shadow

    told by: < instead | exactly | equal | strict | <=
    """
    limit = stored_distance(distance_map, place) + bias
    return np.array([d < s for d, s in zip(distance, limit)], bool)


def is_lit(distance_map, place, distance, bias):
    """lit means that the point is the surface that the map holds: |distance - stored| <= bias, so a point before it is in shadow

    told by: abs( | absolute | before & stored | nearer & stored | nearer than | in front
    """
    return np.abs(distance - stored_distance(distance_map, place)) <= bias


def is_lit(distance_map, place, distance, bias):
    """the map is read with x as the row and y as the column

    told by: row & column | x and y | [x, y] | transposed | exchanged | swapped | x for y
    """
    stored = stored_distance(distance_map, place[:, ::-1])
    return distance <= stored + bias


def distance_slopes(normal, q, clip_from_light, width, height):
    """fine print: an edge-on plane's n . ray is set to +GRAZING also where it is negative, so the slope's sign is lost

    told by: sign & grazing | sign & n . ray | negative & n . ray | keep & sign | grazing & negative
    """
    w = w_of(q, clip_from_light)
    ray = np.stack([-clip_from_light[3, 2] * q[:, 0] / w, -clip_from_light[3, 2] * q[:, 1] / w, -np.ones(len(q))], 1)
    n_ray = (normal * ray).sum(1)
    n_ray = np.where(np.abs(n_ray) < GRAZING, GRAZING, n_ray)
    return np.stack([-w * normal[:, 0] / n_ray * 2 / (clip_from_light[0, 0] * width),
                     -w * normal[:, 1] / n_ray * 2 / (clip_from_light[1, 1] * height)], 1)


def distance_slopes(normal, q, clip_from_light, width, height):
    """the ray is taken for (0, 0, -1), as in parallel light: a cone's rays are not parallel

    told by: parallel | (0, 0, -1) | n_z | cone | perspective | ray & q_x | ray & straight
    """
    w = w_of(q, clip_from_light)
    along = -normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    sx = -w * normal[:, 0] / along * 2 / (clip_from_light[0, 0] * width)
    sy = -w * normal[:, 1] / along * 2 / (clip_from_light[1, 1] * height)
    return np.stack([sx, sy], -1)


def distance_slopes(normal, q, clip_from_light, width, height):
    """a texel's size is taken for 1 / width instead of 2 / width: clip space is 2 wide

    told by: factor 2 | 2 / | half | twice | texel & size | 2 wide | too small by
    """
    w = w_of(q, clip_from_light)
    along = -(normal[:, 0] * q[:, 0] + normal[:, 1] * q[:, 1]) * clip_from_light[3, 2] / w - normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    return np.stack([-w * normal[:, 0] / along / (clip_from_light[0, 0] * width),
                     -w * normal[:, 1] / along / (clip_from_light[1, 1] * height)], -1)


def slope_scaled_bias(slope, constant, factor, most):
    """the slopes are added without their absolute values, so opposite ones cancel

    told by: absolute | abs( | sign | cancel | negative
    """
    return np.minimum(constant + factor * slope.sum(1) / 2, most)


def slope_scaled_bias(slope, constant, factor, most):
    """the half is left out: a point is at most half a texel from the centre, not a whole one

    told by: half | 1/2 | / 2 | twice | 0.5 | double
    """
    return np.clip(constant + factor * (abs(slope[:, 0]) + abs(slope[:, 1])), None, most)


def slope_scaled_bias(slope, constant, factor, most):
    """the Euclidean length of the slope is taken, not the sum of its absolute values

    told by: norm | euclid | length of the slope | root | pythagor | sum of the absolute
    """
    return np.minimum(constant + factor * np.linalg.norm(slope, axis=1) / 2, most)


def to_light(points, position, rotation):
    """the input is changed in place: the position is subtracted from the caller's points

    told by: in place | input & change | caller | overwrit | argument & change | copy
    """
    points -= position
    return points @ rotation.T
