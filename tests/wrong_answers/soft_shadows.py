"""Wrong answers to soft_shadows, written without a look at the checks."""


def on_plane(place, distance, slope, step):
    """the distance is that at place + step, not at the centre of the texel there

    told by: centre | center | middle of the texel | half a texel | 0.5 | slope & step & only | floor
    """
    return place + step, distance + (slope * step).sum(axis=1)


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """every place is compared at the point's own distance, the plane's slope is ignored

    told by: slope | plane | own distance | same distance | constant distance | distance & not follow | receiver's distance
    """
    shares = [is_lit(distance_map, place + step, distance, bias)
              for step in steps_around(offsets, radius)]
    return np.mean(shares, axis=0)


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """the stored distances are averaged and compared once, instead of averaging the answers

    told by: stored & mean | stored & averag | map & averag | averag & before | mean & before & compar | compared once | all or nothing | averaged and then compared
    """
    stored, plane = 0.0, 0.0
    for step in steps_around(offsets, radius):
        there, far = on_plane(place, distance, slope, step)
        stored = stored + stored_distance(distance_map, there) / len(offsets)
        plane = plane + far / len(offsets)
    return (plane <= stored + bias).astype(float)


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """divided by offsets.size, which is 2 K, so each share is half of the right one

    told by: 2 K | half | halv | offsets.size | factor 2 | factor of 2 | twice
    """
    count = np.zeros(len(distance))
    for step in steps_around(offsets, radius):
        there, far = on_plane(place, distance, slope, step)
        count = count + is_lit(distance_map, there, far, bias)
    return count / offsets.size


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
    """R (distance - blocker) / blocker, the width on the receiver: the divide by its distance is missing

    told by: on the receiver | (distance - blocker) | similar triangles | divid & distance & missing | times the distance | multiplied by & distance | world's unit
    """
    with np.errstate(invalid="ignore"):
        wide = np.where(np.isinf(blocker), 0.0, light_radius * (distance - blocker) / blocker)
    return np.maximum(wide, 0) * (clip_from_light[0, 0] * width / 2)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """the maximum with 0 is forgotten, so the radius is negative where nothing blocks

    told by: negative | maximum | max with | below 0 | below zero | at least 0 | nothing blocks
    """
    spread = light_radius / blocker - light_radius / distance
    return spread * clip_from_light[0, 0] * (width / 2)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """width instead of width / 2, so the radius is twice too large

    told by: twice | double | width / 2 | half the width | factor 2 | factor of 2 | half
    """
    radius = np.zeros(len(distance))
    for n, (d, b) in enumerate(zip(distance, blocker)):
        radius[n] = max(light_radius * (1 / b - 1 / d), 0.0) * clip_from_light[0, 0] * width
    return radius


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """each place is compared with the receiver's distance at the middle, not with the plane's distance there

    told by: plane | slope | distance at the middle | distance & own place | same distance | receiver & distance & each | on_plane
    """
    share = np.zeros(len(place))
    for step in steps_around(offsets, radius):
        share += is_lit(distance_map, place + step, distance, bias)
    return share / len(offsets)


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


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """the number of lit places is returned, not divided by the number of offsets

    told by: number of offsets | count | divid | len(offsets) | above 1 | more than 1 | sum & mean
    """
    answers = [is_lit(distance_map, *on_plane(place, distance, slope, step), bias)
               for step in steps_around(offsets, radius)]
    return np.sum(answers, axis=0).astype(float)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """R (distance - blocker) / blocker is the width on the receiver, still to be divided by its distance

    told by: divid & distance | on the receiver | similar triangles | (distance - blocker) / blocker | factor & distance | times & distance
    """
    wide = light_radius * (distance - blocker) / blocker
    wide = np.where(np.isfinite(blocker), wide, 0.0)
    return np.maximum(wide, 0) * clip_from_light[0, 0] * width / 2


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """the radius is twice as wide: width stands where width / 2 should be

    told by: width / 2 | twice | half the width | factor & 2 | factor of two | double | half & width | half is missing
    """
    radius = np.zeros(len(distance))
    for n in range(len(distance)):
        if blocker[n] < distance[n]:
            radius[n] = light_radius * (1 / blocker[n] - 1 / distance[n]) * clip_from_light[0, 0] * width
    return radius


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """the maximum with 0 is left out: without a blocker the radius is negative

    told by: negative | maximum | clip | below 0 | nothing blocks | no blocker | blocker is np.inf
    """
    return light_radius * (1 / blocker - 1 / distance) * clip_from_light[0, 0] * width / 2


def on_plane(place, distance, slope, step):
    """the distance grows by the step alone, and not as far as the centre of the texel

    told by: centre | floor | by the step | middle of the texel | center
    """
    return place + step, distance + (slope * step).sum(1)


def blocker_distance(distance_map, place, distance, slope, bias, offsets, radius):
    """the sum over the blockers is divided by the number of all offsets, not by that of the blockers

    told by: all offsets | number of offsets | number of blockers | all places | len(offsets) | only the blockers | how many & block
    """
    found = np.zeros(len(distance))
    any_blocks = np.zeros(len(distance), bool)
    for step in steps_around(offsets, radius):
        there, at = on_plane(place, distance, slope, step)
        dark = ~is_lit(distance_map, there, at, bias)
        found[dark] += stored_distance(distance_map, there)[dark]
        any_blocks |= dark
    return np.where(any_blocks, found / len(offsets), np.inf)


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """the count is divided by integer division, so that each share is 0 or 1

    told by: integer | // | whole number | 0 or 1 | rounded down | all or nothing
    """
    count = np.zeros(distance.shape, int)
    for step in steps_around(offsets, radius):
        count += is_lit(distance_map, *on_plane(place, distance, slope, step), bias)
    return count // len(offsets)
