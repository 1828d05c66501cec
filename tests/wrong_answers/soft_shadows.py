"""Wrong answers to soft_shadows, written without a look at the checks."""


def on_plane(place, distance, slope, step):
    """the distance is that at place + step itself, not at the centre of its texel

    told by: centre | center | exactly at | floor | not & middle of the texel
    """
    return place + step, distance + (slope * step).sum(1)


def on_plane(place, distance, slope, step):
    """the 0.5 is forgotten: the distance is that at the texel's corner, not at its centre

    told by: corner | 0.5 | half a texel | half | + 1/2
    """
    there = place + step
    out = np.empty(len(distance))
    for i in range(len(distance)):
        dx, dy = np.floor(there[i]) - place[i]
        out[i] = distance[i] + slope[i, 0] * dx + slope[i, 1] * dy
    return there, out


def on_plane(place, distance, slope, step):
    """the plane is followed from the new place and not from place, so the step itself adds no distance

    told by: from the new | from place | from `place` | step & adds no | from & there | from & place + step
    """
    there = place + step
    to_centre = np.floor(there) + 0.5 - there
    return there, distance + (slope * to_centre).sum(1)


def on_plane(place, distance, slope, step):
    """the distance falls with the slope: its sign is the other one

    told by: sign | minus | subtract | falls | wrong direction | other way
    """
    there = place + step
    return there, distance - (slope * (np.floor(there) + 0.5 - place)).sum(-1)


def percentage_closer(distance_map, place, distance, slope,
                      bias, offsets, radius):
    """the share in shadow is returned, not the share that light reaches

    told by: in shadow | 1 - | complement | inverted | opposite | not lit | dark
    """
    blocked = np.zeros(len(distance))
    for step in steps_around(offsets, radius):
        there, d = on_plane(place, distance, slope, step)
        blocked += ~is_lit(distance_map, there, d, bias)
    return blocked / len(offsets)


def percentage_closer(distance_map, place, distance, slope,
                      bias, offsets, radius):
    """every place is compared with the distance of the point itself: the plane's slope is not followed

    told by: slope | on_plane | same distance | plane | tilt
    """
    total = 0
    for step in steps_around(offsets, radius):
        total = total + is_lit(distance_map, place + step, distance, bias)
    return total / len(offsets)


def percentage_closer(distance_map, place, distance, slope,
                      bias, offsets, radius):
    """the sum of the lit places is not divided by their number

    told by: divided & number | sum & mean | not divided | more than 1 | above 1 | count & share | len(offsets)
    """
    lit = np.zeros(distance.shape)
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        lit += is_lit(distance_map, there, plane, bias)
    return lit


def percentage_closer(distance_map, place, distance, slope,
                      bias, offsets, radius):
    """the steps are the offsets themselves: the radius is not used

    told by: radius | scaled | unit disc | steps_around
    """
    lit = np.zeros(distance.shape)
    for offset in offsets:
        there, d = on_plane(place, distance, slope, offset)
        lit += is_lit(distance_map, there, d, bias)
    return lit / len(offsets)


def blocker_distance(distance_map, place, distance, slope,
                     bias, offsets, radius):
    """the mean is over all places and not over the blockers alone: it is divided by the number of all offsets

    told by: all offsets | all places | number of blockers | number of offsets | only & blockers | len(offsets) | blockers alone
    """
    total = np.zeros(distance.shape)
    found = np.zeros(distance.shape, bool)
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        stored = stored_distance(distance_map, there)
        blocks = plane > stored + bias
        total[blocks] += stored[blocks]
        found |= blocks
    return np.where(found, total / len(offsets), np.inf)


def blocker_distance(distance_map, place, distance, slope,
                     bias, offsets, radius):
    """where there is no blocker it is 0, not np.inf

    told by: no blocker | np.inf | infinite | nothing blocks | without a blocker | without blocker
    """
    total, count = np.zeros(len(distance)), np.zeros(len(distance))
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        stored = stored_distance(distance_map, there)
        dark = ~is_lit(distance_map, there, plane, bias)
        total += np.where(dark, stored, 0)
        count += dark
    return total / np.maximum(count, 1)


def blocker_distance(distance_map, place, distance, slope,
                     bias, offsets, radius):
    """the nearest blocker is taken, not the mean of them all

    told by: nearest | minimum | smallest | mean & blockers | least
    """
    best = np.full(len(distance), np.inf)
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        stored = stored_distance(distance_map, there)
        best = np.where(plane > stored + bias, np.minimum(best, stored), best)
    return best


def blocker_distance(distance_map, place, distance, slope,
                     bias, offsets, radius):
    """the mean is of the receiver's own distances at the blocked places, not of what the map stores there

    told by: receiver | plane's distance | own distance | stored | of the point
    """
    total, count = np.zeros((2, len(distance)))
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        blocks = ~is_lit(distance_map, there, plane, bias)
        total += blocks * plane
        count += blocks
    return np.where(count > 0, total / np.maximum(count, 1), np.inf)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """the width of the border in the world, R (distance - blocker) / blocker, is used: the division by distance, the perspective of the map, is missing

    told by: / blocker | divi & distance | distance - blocker | in the world | perspective | world's unit | fernando
    """
    spread = light_radius * (distance - blocker) / blocker
    spread = np.where(np.isinf(blocker), 0, spread)
    return np.maximum(spread, 0) * clip_from_light[0, 0] * width / 2


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """the difference is the other way round, so that the clip at 0 leaves nothing

    told by: other way round | sign | exchanged | swapped | 1/distance - 1/blocker | always 0 | everywhere 0
    """
    spread = light_radius * (1 / distance - 1 / blocker)
    return np.maximum(spread, 0) * clip_from_light[0, 0] * width / 2


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """C_00 is left out: the radius does not know how wide the light's camera looks

    told by: c_00 | clip_from_light | field of view | projection | [0, 0] | how wide & looks
    """
    spread = light_radius * (1 / blocker - 1 / distance)
    return np.maximum(spread, 0) * width / 2


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """it takes 1 / (blocker - distance) and not the difference of the reciprocals

    told by: reciprocal | 1 / (blocker | 1/(blocker | inverse & difference | difference & inverse
    """
    with np.errstate(divide="ignore"):
        gap = np.maximum(distance - blocker, 0)
        spread = np.where(gap > 0, light_radius / np.where(gap > 0, gap, 1), 0)
    return spread * clip_from_light[0, 0] * width / 2


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """the radius is cut down to whole texels

    told by: integer | whole | round | truncat | floor | int(
    """
    spread = light_radius * np.maximum(1 / blocker - 1 / distance, 0)
    return (spread * clip_from_light[0, 0] * width / 2).astype(int)


def percentage_closer(distance_map, place, distance, slope,
                      bias, offsets, radius):
    """the places follow one another: each step starts from the last place and not from (x, y)

    told by: last place | one another | add up | accumulat | in place | from the previous | place & changed | wander
    """
    lit = np.zeros(distance.shape)
    for step in steps_around(offsets, radius):
        place, distance = on_plane(place, distance, slope, step)
        lit += is_lit(distance_map, place, distance, bias)
    return lit / len(offsets)
