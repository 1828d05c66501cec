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


def percentage_closer(distance_map, place, distance, slope,
                      bias, offsets, radius):
    """the stored distances are averaged first and compared once, which gives only 0 or 1

    told by: averag & first | mean & stored | blur & map | compare & once | only 0 or 1 | averag & depth | averag & distance | before comparing
    """
    stored = np.zeros(distance.shape)
    plane = np.zeros(distance.shape)
    for step in steps_around(offsets, radius):
        there, d = on_plane(place, distance, slope, step)
        stored += stored_distance(distance_map, there) / len(offsets)
        plane += d / len(offsets)
    return (plane <= stored + bias).astype(float)


def percentage_closer(distance_map, place, distance, slope,
                      bias, offsets, radius):
    """the number of lit places is divided by the number of points and not by that of the offsets

    told by: number of points | len(distance) | n instead of k | number of offsets | divi & offsets | wrong number
    """
    lit = np.zeros(distance.shape)
    for step in steps_around(offsets, radius):
        lit += is_lit(distance_map, *on_plane(place, distance, slope, step), bias)
    return lit / len(place)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """the radius is not clipped at 0: it is negative where nothing blocks

    told by: clip | negative | max( | maximum | below 0 | nothing blocks | no blocker
    """
    out = np.zeros(len(distance))
    for i in range(len(distance)):
        out[i] = light_radius * (1 / blocker[i] - 1 / distance[i]) * clip_from_light[0, 0] * width / 2
    return out


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """width is not halved, so the radius is the diameter

    told by: half | twice | / 2 | 1/2 | diameter | double | 0.5 | factor 2
    """
    spread = light_radius * np.maximum(1 / blocker - 1 / distance, 0)
    return spread * clip_from_light[0, 0] * width
