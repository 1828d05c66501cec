"""What is given in lab 3: spectra of pictures, and the area of a polygon."""
from fractions import Fraction

import numpy as np

from course.checks import assert_close

SQUARE = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])


def exact_area(polygon):
    """The shoelace formula, rounded once at the end."""
    points = [tuple(map(Fraction, map(float, point))) for point in polygon]
    pairs = zip(points, points[1:] + points[:1], strict=True)
    return float(sum(p[0] * q[1] - q[0] * p[1] for p, q in pairs) / 2)


def test_a_spectrum_is_that_of_numpy(impl, rng):
    """One axis is left out, or k_x comes first. The numbers are divided by their count. The matrix
    of the width acts on the columns, or the picture is conjugated on one side.
    """
    for shape in (2, 2), (5, 8), (6, 3), (1, 7):
        picture = rng.normal(size=shape)
        assert_close(impl.spectrum_of(picture), np.fft.fft2(picture), atol=1e-12)


def test_a_picture_comes_back_from_its_spectrum(impl, rng):
    """An inverse of square pictures only, or of the absolute values. The result is complex, waves
    run the other way, or the factor 1 / (H W) is missing.
    """
    for shape in (5, 8), (6, 3), (1, 7):
        picture = rng.normal(size=shape)
        assert_close(impl.picture_of(np.fft.fft2(picture)), picture)


def test_frequencies_are_those_of_numpy(impl):
    """The upper half stays above 1/2, or 1/2 itself counts as positive. The middle of an odd number
    is one too low.
    """
    for n in 1, 2, 3, 4, 5, 8, 9, 100:
        assert_close(impl.frequencies(n), np.fft.fftfreq(n))


def test_many_polygons_at_once(impl, rng):
    """Twice the area, or no sign. The code works for one polygon alone, or for polygons around
    the origin. A polygon without vertices is an error.
    """
    polygons = rng.normal(size=(2, 3, 7, 2)) + 2
    expected = [[exact_area(polygon) for polygon in row] for row in polygons]
    assert_close(impl.polygon_area(polygons), np.array(expected))
    assert_close(impl.polygon_area(SQUARE[::-1].copy()), -16.0)
    assert_close(impl.polygon_area(np.zeros((0, 2))), 0.0)


def test_a_small_polygon_far_out_keeps_its_digits(impl):
    """The shoelace formula about the origin: ten digits of a pixel's area are lost at 100,000."""
    x, y = 100_000.0, 300_000.0
    assert_close(impl.polygon_area(SQUARE / 8 + [x, y]), 0.25)
    odd = SQUARE / 7 + [x, y + 0.1]  # no short binary numbers: their products are rounded
    assert_close(impl.polygon_area(odd), exact_area(odd))
