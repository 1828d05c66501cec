"""Mistakes of lab 14; each docstring goes on after "this is what comes out when"."""


def percentage_closer(distance_map, place, distance, slope, bias, offsets, radius):
    """the steps add up: each one starts from the last place, and not from (x, y)"""
    lit = np.zeros(distance.shape)
    for step in steps_around(offsets, radius):
        place, distance = on_plane(place, distance, slope, step)
        lit += is_lit(distance_map, place, distance, bias)
    return lit / len(offsets)
