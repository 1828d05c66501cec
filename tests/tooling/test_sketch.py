"""Drawings: every point where its numbers say, every name beside it, and the page filled."""
import numpy as np
import pytest

from course.given import plot, sketch

pytestmark = pytest.mark.usefixtures("style")


def test_drawings_have_one_scale_and_fill_the_page():
    """Two drawings whose units differ in length; a drawing that leaves half of the page empty."""
    left, right = sketch.sheet((0, 2, 0, 1), (-1, 2, 0, 1), titles=["left", "right"])
    scales = [axes.bbox.size / np.ptp([axes.get_xlim(), axes.get_ylim()], axis=1)
              for axes in (left, right)]
    assert np.allclose(scales, scales[0][0])
    assert left.bbox.x0 < 20 and right.bbox.x1 > plot.PAGE_WIDTH - 20


def test_a_high_drawing_keeps_to_the_height_and_stands_in_the_middle():
    """A drawing that is a page long; one that sticks to the left."""
    axes, = sketch.sheet((0, 1, 0, 4), height=400)
    assert axes.bbox.height == pytest.approx(400)
    assert axes.bbox.x0 == pytest.approx(plot.PAGE_WIDTH - axes.bbox.x1)


def test_points_lie_where_they_are_and_names_beside_them():
    """x and y exchanged; a name on the wrong side."""
    axes, = sketch.sheet((0, 4, 0, 2))
    sketch.dot(axes, (1, 2), "A", offset=(-6, 6))
    sketch.line(axes, (0, 0), (4, 0), (4, 2), closed=True)
    sketch.measure(axes, (0, 0), (4, 1), "d")
    point, triangle = axes.lines
    assert np.array_equal(point.get_xydata(), [[1, 2]])
    assert np.array_equal(triangle.get_xydata(), [[0, 0], [4, 0], [4, 2], [0, 0]])
    name, _, length = axes.texts
    assert (name.get_ha(), name.get_va(), name.get_text()) == ("right", "bottom", "A")
    assert tuple(length.xy) == (2, 0.5) and length.get_text() == "d"


def test_a_pixel_is_the_square_around_its_centre():
    """A pixel drawn around its corner."""
    axes, = sketch.sheet((0, 4, 0, 2))
    sketch.pixel(axes, 2, 1, 0.5)
    square, = axes.patches
    assert np.array_equal(square.get_bbox().extents, [2, 1, 3, 2])
    assert square.get_facecolor() == (0.5, 0.5, 0.5, 1.0)
    assert np.array_equal(axes.lines[0].get_xydata(), [[2.5, 1.5]])


def test_an_angle_runs_counter_clockwise_between_its_directions():
    """The other arc of the circle; a name at the wrong end."""
    axes, = sketch.sheet((-2, 2, -2, 2))
    sketch.angle(axes, (0, 0), 0, 90, "a", radius=1)
    arc, = axes.patches
    assert (arc.theta1, arc.theta2) == (0, 90)
    assert np.allclose(axes.texts[0].xy, 1.45 * np.sqrt(0.5))
