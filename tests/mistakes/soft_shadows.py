"""Mistakes of lab 14; each docstring goes on after "this is what comes out when"."""


def on_plane(place, distance, slope, step):
    """the sign is wrong: the distance falls with the slope, which is subtracted instead of added"""
    there = place + step
    return there, distance - (slope * (np.floor(there) + 0.5 - place)).sum(1)


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """the lit places are counted: the sum is not divided by the number of places, len(offsets)"""
    lit = np.zeros(distance.shape)
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        lit += is_lit(distance_map, there, plane, bias)
    return lit


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """every place is compared with the distance of the receiver itself: the slope of its plane is
    not followed"""
    lit = np.zeros(distance.shape)
    for step in steps_around(offsets, radius):
        there, _ = on_plane(place, distance, slope, step)
        lit += is_lit(distance_map, there, distance, bias)
    return lit / len(offsets)


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """the stored distances are averaged and then compared; the answers are to be averaged"""
    lit = np.zeros(distance.shape)
    for step in steps_around(offsets, radius):
        there, _ = on_plane(place, distance, slope, step)
        lit += stored_distance(distance_map, there)
    return (distance <= lit / len(offsets) + bias) + 0.0


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """the steps add up: each one starts from the last place, and not from (x, y)"""
    lit = np.zeros(distance.shape)
    for step in steps_around(offsets, radius):
        place, distance = on_plane(place, distance, slope, step)
        lit += is_lit(distance_map, place, distance, bias)
    return lit / len(offsets)


def blocker_distance(distance_map, place, distance, slope, bias, offsets, radius):
    """the blockers' distances are added and not averaged: the sum is not divided by their number"""
    total, count = np.zeros((2, *distance.shape))
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        blocks = ~is_lit(distance_map, there, plane, bias)
        total[blocks] += stored_distance(distance_map, there[blocks])
        count += blocks
    return total


def blocker_distance(distance_map, place, distance, slope, bias, offsets, radius):
    """the nearest blocker is taken, and not the mean of all blockers"""
    best = np.full(distance.shape, np.inf)
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        stored = stored_distance(distance_map, there)
        best = np.where(plane > stored + bias, np.minimum(best, stored), best)
    return best


def blocker_distance(distance_map, place, distance, slope, bias, offsets, radius):
    """it is 0 where there is no blocker, instead of np.inf"""
    total, count = np.zeros((2, *distance.shape))
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        blocks = ~is_lit(distance_map, there, plane, bias)
        total[blocks] += stored_distance(distance_map, there[blocks])
        count += blocks
    return total / np.maximum(count, 1)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """C_00 is left out: clip_from_light[0, 0] says how wide the light's camera looks"""
    return np.maximum(light_radius * (1 / blocker - 1 / distance), 0) * (width / 2)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """it is 1 / (distance - blocker), the reciprocal of the difference, and not the difference of
    the reciprocals"""
    gap = distance - blocker
    spread = np.where(gap > 0, light_radius / np.where(gap > 0, gap, 1), 0)
    return spread * (clip_from_light[0, 0] * width / 2)
