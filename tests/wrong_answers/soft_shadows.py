"""Wrong answers to soft_shadows, written without a look at the checks."""


def on_plane(place, distance, slope, step):
    """the distance grows by the step alone, and not as far as the centre of the texel

    told by: centre | floor | by the step | middle of the texel | center
    """
    return place + step, distance + (slope * step).sum(1)


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


def blocker_distance(distance_map, place, distance, slope, bias, offsets, radius):
    """the sum is divided by the number of all places instead of the blockers'

    told by: all places | number of places | number of offsets | divided by K | len(offsets) | number of blockers | number of the blockers
    """
    total, any_blocker = np.zeros(len(distance)), np.zeros(len(distance), bool)
    for step in steps_around(offsets, radius):
        there, far = on_plane(place, distance, slope, step)
        dark = ~is_lit(distance_map, there, far, bias)
        total[dark] += stored_distance(distance_map, there)[dark]
        any_blocker |= dark
    return np.where(any_blocker, total / len(offsets), np.inf)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """width instead of width / 2, so the radius is twice too large

    told by: twice | double | width / 2 | half the width | factor 2 | factor of 2 | half
    """
    radius = np.zeros(len(distance))
    for n, (d, b) in enumerate(zip(distance, blocker)):
        radius[n] = max(light_radius * (1 / b - 1 / d), 0.0) * clip_from_light[0, 0] * width
    return radius
