"""Lab 14 as printed: what one types who has read the questions and the equations."""


def to_light(points, position, rotation):
    return np.array([rotation @ (p - position) for p in points])


def map_position(q, clip_from_light, width, height):
    C = clip_from_light
    w = C[3, 2] * q[:, 2] + C[3, 3]
    x = (C[0, 0] * q[:, 0] / w + 1) * width / 2
    y = (C[1, 1] * q[:, 1] / w + 1) * height / 2
    return np.stack([x, y], -1)


def is_lit(distance_map, place, distance, bias):
    return distance <= stored_distance(distance_map, place) + bias
