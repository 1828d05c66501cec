"""Wrong answers to soft_shadows, written without a look at the checks."""


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """the stored distances are averaged and then compared once, instead of averaging the comparisons

    told by: mean of & distances | averag & distance | averag & compar | mean & compar | averag & stored | yes or no | compared once
    """
    stored, plane = np.zeros(len(distance)), np.zeros(len(distance))
    for step in steps_around(offsets, radius):
        there, at = on_plane(place, distance, slope, step)
        stored += stored_distance(distance_map, there) / len(offsets)
        plane += at / len(offsets)
    return (plane <= stored + bias).astype(float)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """width instead of width / 2, so the radius is twice too large

    told by: twice | double | width / 2 | half the width | factor 2 | factor of 2 | half
    """
    radius = np.zeros(len(distance))
    for n, (d, b) in enumerate(zip(distance, blocker)):
        radius[n] = max(light_radius * (1 / b - 1 / d), 0.0) * clip_from_light[0, 0] * width
    return radius
