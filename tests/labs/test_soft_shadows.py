"""What the exercises of lab 14 must do: means of comparisons, and the width of a soft border."""
import math

import numpy as np

from labkit.checks import assert_close, exercise


@exercise("14.6")
def test_the_plane_is_measured_at_the_texel__s_centre(impl, rng):
    """At the place itself, or at the texel's corner: the 0.5 is missing, or it is rounded. Followed
    from the new place and not from place, or from the centre of the receiver's own texel. The sign.
    The distance is not added. The place becomes a centre, too. Cutting off decimals is not floor:
    -0.3 lies in the texel whose centre is -0.5.
    """
    place, slope, steps = rng.uniform(-3, 3, (3, 20, 2))
    distance = rng.uniform(-3, 3, 20)
    for step in steps, 0 * steps, steps[0]:
        there = place + step
        plane = [d + sum(a * (math.floor(x) + 0.5 - start) for a, x, start in zip(*k, strict=True))
                 for d, *k in zip(distance, slope, there, place, strict=True)]
        assert_close(impl.on_plane(place, distance, slope, step), (there, np.array(plane)))


def places(distance_map, place, distance, slope, bias, offsets, radius):
    """Of each receiver, one by one: what its places store, inf outside; which of them are lit."""
    height, width = distance_map.shape
    for k, (x, y) in enumerate(place):
        stored, lit = [], []
        for dx, dy in offsets:
            j = math.floor(x + radius[k] * dx)
            i = math.floor(y + radius[k] * dy)
            inside = 0 <= i < height and 0 <= j < width
            stored.append(distance_map[i, j] if inside else math.inf)
            plane = distance[k] + slope[k] @ [j + 0.5 - x, i + 0.5 - y]
            lit.append(plane <= stored[-1] + bias[k])
        yield np.array(stored), np.array(lit)


def around(rng, count=40):
    """A map, receivers over it and beside it, with slopes, biases, places and radii."""
    distance_map = rng.uniform(2, 6, (6, 9))
    distance_map[rng.random((6, 9)) < 0.2] = np.inf
    place = rng.uniform(-1, [10, 7], (count, 2))
    slope = 0.3 * rng.normal(size=(count, 2))
    return (distance_map, place, rng.uniform(3, 5, count), slope, rng.uniform(0, 0.5, count),
            rng.uniform(-1, 1, (11, 2)), rng.uniform(0, 3, count))


FLAT = np.zeros((5, 2))
CROSS = np.array([[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 0.0]])  # left, right, below, there
WALLS = np.array([[3.0, 3.0, 9.0, 9.0, 2.0], [5.0, 3.0, 9.0, 1.0, 9.0]])
OVER_WALLS = (np.array([[1.5, 1.5], [2.5, 1.5], [4.5, 0.5], [2.25, 0.5], [0.5, 1.5]]),
              np.array([5.0, 5.0, 5.0, 8.0, 5.0]))  # place, distance


@exercise("14.7")
def test_shares_on_paper(impl):
    """The dark share is returned, or the sum, not divided by the number of offsets, or by that of
    the points. The distances are averaged and then compared. The radius is not used. Only one
    step counts, or each starts from the last place. Places do not move. Outside is dark.
    """
    got = impl.percentage_closer(WALLS, *OVER_WALLS, FLAT, 0.0, CROSS, np.array([1.0, 1, 1, 2, 1]))
    # The map holds 5, 9, 3, 3; 3, 1, 9, 9; 9, none, none, 2; 3, 2, none, 9; none, 3, 3, 5.
    assert_close(got, [0.5, 0.5, 0.75, 0.5, 0.5])


@exercise("14.7")
def test_a_slanted_plane_does_not_darken_itself(impl, rng):
    """Every neighbour is compared with the distance at the middle, that of the receiver itself: the
    plane's slope is not followed, and acne comes back.
    """
    slope = np.array([0.7, -0.4])
    column, row = np.meshgrid(np.arange(9) + 0.5, np.arange(6) + 0.5)
    distance_map = 5 + slope[0] * column + slope[1] * row
    place = rng.uniform(2, [7, 4], (20, 2))
    above = np.where(np.arange(20) % 2, -0.125, 0.125)  # every other receiver lies before the map
    got = impl.percentage_closer(distance_map, place, 5 + place @ slope + above,
                                 np.tile(slope, (20, 1)), 0.05, CROSS, 1.5)
    assert_close(got, np.arange(20) % 2)


@exercise("14.7")
def test_each_receiver_has_its_radius_and_bias(impl, rng):
    """One radius for all. The bias is left out, or added to the distance. A place is off by a half,
    a slope is left out, or it is dark outside.
    """
    given = around(rng)
    assert_close(impl.percentage_closer(*given), [lit.mean() for _, lit in places(*given)])


@exercise("14.8")
def test_where_nothing_blocks_all_light_comes(impl, rng):
    """NaN or dark, where no place is: the mean of no blockers. The nearest distance of all blocks
    everywhere.
    """
    distance_map = np.full((6, 9), 5.0)
    distance_map[5, 8] = 2.0
    place, distance = rng.uniform(0, 3, (20, 2)), np.minimum(rng.uniform(4, 6, 20), 5.0)
    got = impl.percentage_closer_soft(distance_map, place, distance, np.zeros((20, 2)), 0.0,
                                      CROSS, 2.0)
    assert_close(got, np.ones(20))


@exercise("14.8")
def test_an_edge_has_the_border_of_its_disc(impl, rng):
    """(7) is turned round, not divided by distance or by blocker, or measured in the world; it is
    the diameter. The filter keeps the search's radius, or that of the lamp.
    """
    b, lamp = 2.5, 12.0
    distance_map = np.full((1, 40), 9.0)
    distance_map[0, :20], distance_map[0, -1] = b, 1.0      # an edge at 20; the nearest is far away
    place = np.column_stack([rng.uniform(19, 21, 30), np.full(30, 0.5)])
    distance = rng.uniform(3, 8, 30)
    offsets = np.column_stack([np.linspace(-1, 1, 41), np.zeros(41)])
    radius = lamp * (distance - b) / distance / b           # at b, the disc is lamp / b texels
    got = impl.percentage_closer_soft(distance_map, place, distance, np.zeros((30, 2)), 0.1,
                                      offsets, lamp)
    assert_close(got, [(x + r * offsets[:, 0] >= 20).mean()
                       for x, r in zip(place[:, 0], radius, strict=True)])


def soft(distance_map, place, distance, slope, bias, offsets, lamp):
    """PCSS, receiver by receiver."""
    given = distance_map, place, distance, slope, bias, offsets

    def radius(b):
        return np.maximum(lamp * (distance - b) / distance / b, 0)

    search = radius(np.full(len(distance), distance_map.min()))
    b = np.array([stored[~lit].mean() if not lit.all() else 1e9
                  for stored, lit in places(*given, search)])
    return [lit.mean() for _, lit in places(*given, radius(b))]


@exercise("14.8")
def test_b_is_the_mean_of_the_blockers_around(impl, rng):
    """The nearest or the farthest blocker, or the mean of lit places, too, or of the whole map. The
    sum is divided by all places. Blockers are sought at one place, or within the lamp's radius.
    """
    distance_map, place, *_, offsets, _ = around(rng)
    distance = rng.integers(8, 14, 40) / 2                # as far as what is stored, now and then
    given = np.round(2 * distance_map) / 2, place, distance, 0 * place, 0 * distance, offsets
    assert_close(impl.percentage_closer_soft(*given, 6.0), soft(*given, 6.0))


@exercise("14.8")
def test_each_receiver_has_its_bias_and_its_plane(impl, rng):
    """The search takes the distance of the receiver itself at each place, or knows no bias."""
    *given, _ = around(rng)
    given[2] -= 1.5 * (np.arange(40) % 2)                 # some lie before all that is stored
    assert_close(impl.percentage_closer_soft(*given, 5.0), soft(*given, 5.0))
