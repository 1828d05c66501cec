"""Lab 14's soft shadows as printed."""


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    answers = []
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        answers.append(is_lit(distance_map, there, plane, bias))
    return np.mean(answers, 0)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    radius = np.zeros(len(distance))
    for n, (d, b) in enumerate(zip(distance, blocker, strict=True)):
        if b < d:
            radius[n] = light_radius * (d - b) / d * clip_from_light[0, 0] / b * width / 2
    return radius
