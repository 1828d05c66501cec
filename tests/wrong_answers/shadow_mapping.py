"""Wrong answers to shadow_mapping, written without a look at the checks."""


def to_light(points, position, rotation):
    """rotation p - position: the position is taken away after the rotation instead of before it

    told by: after the rotation | after rotat | before rotat | before the rotation | position & not rotated | position & not turned | rotation p - position | turned first
    """
    turned = np.array([rotation @ p for p in points]).reshape(-1, 3)
    return turned - position


def map_position(q, clip_from_light, width, height):
    """the divide is by the distance -q_z instead of w, which is 1 in parallel light

    told by: -q_z | by the distance | by z | w is 1 | orthographic | parallel | light from a direction
    """
    away = -q[:, 2]
    x = (clip_from_light[0, 0] * q[:, 0] / away + 1) * width / 2
    y = (clip_from_light[1, 1] * q[:, 1] / away + 1) * height / 2
    return np.stack([x, y], axis=1)


def is_lit(distance_map, place, distance, bias):
    """the bias is on the wrong side: added to the distance instead of the stored distance

    told by: wrong side | other side | bias & sign | bias & added to the distance | bias & subtract | distance + bias | stored - bias
    """
    return distance + bias <= stored_distance(distance_map, place)
