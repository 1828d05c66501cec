"""What is given in lab 3: the area of a polygon."""
from fractions import Fraction

import numpy as np

from labkit.checks import assert_close
from tests.labs.test_sampling import exact_area

SQUARE = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])


def test_many_polygons_at_once(impl, rng):
    """Twice the area, or no sign. The code works for one polygon alone, or for polygons around
    the origin. A polygon without vertices is an error.
    """
    polygons = rng.normal(size=(2, 3, 7, 2)) + 2
    expected = [[exact_area(polygon.tolist()) for polygon in row] for row in polygons]
    assert_close(impl.polygon_area(polygons), np.array(expected))
    assert_close(impl.polygon_area(SQUARE[::-1].copy()), -16.0)
    assert_close(impl.polygon_area(np.zeros((0, 2))), 0.0)


def test_a_small_polygon_far_out_keeps_its_digits(impl):
    """The shoelace formula about the origin: ten digits of a pixel's area are lost at 100,000."""
    x, y = 100_000.0, 300_000.0
    assert_close(impl.polygon_area(SQUARE / 8 + [x, y]), 0.25)
    odd = SQUARE / 7 + [x, y + 0.1]  # no short binary numbers: their products are rounded
    assert_close(impl.polygon_area(odd), exact_area([[*map(Fraction, p)] for p in odd.tolist()]))
