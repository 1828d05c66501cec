"""Mistakes of lab 14; each docstring goes on after "this is what comes out when"."""


def on_plane(place, distance, slope, step):
    """the plane is taken at the place itself; it is at the centre of the texel there"""
    there = place + step
    centre = there
    return there, distance + (slope * (centre - place)).sum(1)


def on_plane(place, distance, slope, step):
    """the texel's corner is taken for its centre"""
    there = place + step
    centre = np.floor(there)
    return there, distance + (slope * (centre - place)).sum(1)


def on_plane(place, distance, slope, step):
    """the slope by x has the wrong sign"""
    there = place + step
    centre = np.floor(there) + 0.5
    return there, distance + (slope * (centre - place) * [-1, 1]).sum(1)


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """the lit places are counted, but not divided by their number"""
    lit = np.zeros(distance.shape)
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        lit += is_lit(distance_map, there, plane, bias)
    return lit


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """every place is compared with the distance of the receiver, not of its plane there"""
    lit = np.zeros(distance.shape)
    for step in steps_around(offsets, radius):
        there, _ = on_plane(place, distance, slope, step)
        lit += is_lit(distance_map, there, distance, bias)
    return lit / len(offsets)


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """distances are averaged and then compared"""
    lit = np.zeros(distance.shape)
    for step in steps_around(offsets, radius):
        there, _ = on_plane(place, distance, slope, step)
        lit += stored_distance(distance_map, there)
    return (distance <= lit / len(offsets) + bias) + 0.0


def blocker_distance(distance_map, place, distance, slope, bias, offsets, radius):
    """lit places are taken for blockers"""
    total, count = np.zeros((2, *distance.shape))
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        blocks = is_lit(distance_map, there, plane, bias)
        total[blocks] += stored_distance(distance_map, there[blocks])
        count += blocks
    return np.where(count > 0, total / np.maximum(count, 1), np.inf)


def blocker_distance(distance_map, place, distance, slope, bias, offsets, radius):
    """the sum is divided by the number of all places; only blockers count"""
    total, count = np.zeros((2, *distance.shape))
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        blocks = ~is_lit(distance_map, there, plane, bias)
        total[blocks] += stored_distance(distance_map, there[blocks])
        count += blocks
    return np.where(count > 0, total / len(offsets), np.inf)


def blocker_distance(distance_map, place, distance, slope, bias, offsets, radius):
    """the blockers' distances are added, not averaged"""
    total, count = np.zeros((2, *distance.shape))
    for step in steps_around(offsets, radius):
        there, plane = on_plane(place, distance, slope, step)
        blocks = ~is_lit(distance_map, there, plane, bias)
        total[blocks] += stored_distance(distance_map, there[blocks])
        count += blocks
    return total


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """blocker and distance are swapped"""
    spread = light_radius * (1 / distance - 1 / blocker)
    return np.maximum(spread, 0) * (clip_from_light[0, 0] * width / 2)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """a blocker behind the point gives a negative radius"""
    spread = light_radius * (1 / blocker - 1 / distance)
    return spread * (clip_from_light[0, 0] * width / 2)


def penumbra_radius(distance, blocker, light_radius, clip_from_light, width):
    """it is the diameter, or ndc is taken to be 1 wide"""
    spread = light_radius * (1 / blocker - 1 / distance)
    return np.maximum(spread, 0) * (clip_from_light[0, 0] * width)
