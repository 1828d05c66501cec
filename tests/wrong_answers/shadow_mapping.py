"""Wrong answers to shadow_mapping, written without a look at the checks."""


def map_position(q, clip_from_light, width, height):
    """the divide is by the distance -q_z instead of w, which is 1 in parallel light

    told by: -q_z | by the distance | by z | w is 1 | orthographic | parallel | light from a direction
    """
    away = -q[:, 2]
    x = (clip_from_light[0, 0] * q[:, 0] / away + 1) * width / 2
    y = (clip_from_light[1, 1] * q[:, 1] / away + 1) * height / 2
    return np.stack([x, y], axis=1)
