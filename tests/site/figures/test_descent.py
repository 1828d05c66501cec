"""The triangle that descends, and the landscape of its loss: the steps down."""
import numpy as np
from playwright.sync_api import expect
from reading import numbers, opened, point_of, settled

from reference import inverse_rendering


def test_the_loss_and_a_step_are_those_of_the_reference(agrees):
    """The mean is over rows, or Adam's first steps are too short."""
    picture, target, x, grad, mean = np.random.default_rng(1).normal(size=(5, 6))
    agrees("blended", "squaredError", [(picture, target)],
           inverse_rendering.squared_error(picture, target))
    agrees("blended", "squaredErrorBackward", [(picture, target)],
           inverse_rendering.squared_error_backward(1.0, picture, target))
    step = x, grad, mean, mean**2, 3, 0.25
    agrees("blended", "adamStep", [step], inverse_rendering.adam_step(*step))


def loss_of(page):
    """The step and its loss."""
    return numbers(settled(page).inner_text(".told"))[:2]


def test_play_finds_the_triangle(page, address):
    """It circles round the target, or ends beside it."""
    opened(page, address, "descent")
    assert loss_of(page)[0] == 0 and loss_of(page)[1] > 0.05
    page.get_by_role("button", name="Play").click()
    page.get_by_text("Found").wait_for(timeout=60_000)
    expect(page.locator(".sheet polygon.descent")).to_have_count(0)
    assert loss_of(page)[1] < 1e-4
    places = [point_of(page.locator(f".handle:text-is('{k}')")) for k in range(3)]
    step = 0.05  # of a handle
    np.testing.assert_allclose(places, [[5.3, 3.1], [20.4, 5.8], [9.6, 14.2]], atol=1.02 * step)
    page.get_by_role("button", name="Play").click()  # from the start again
    page.get_by_text("Found").wait_for(state="hidden")


def test_play_stops_where_no_pixel_shows_the_triangle(page, address):
    """The steps are counted on, and nothing moves."""
    opened(page, address, "descent")
    page.get_by_role("button", name="Play").click()
    for k in range(3):
        page.locator(f".handle:text-is('{k}')").press("Home")
    page.get_by_role("button", name="Play").wait_for()
    assert loss_of(page)[0] == 0


def test_a_vertex_that_is_moved_begins_a_new_descent(page, address):
    """The curve goes on from the old place, or the picture is the one before."""
    opened(page, address, "descent")
    before = loss_of(page)[1]
    page.locator(".handle:text-is('0')").press("Shift+ArrowDown")
    assert loss_of(page)[0] == 0 and loss_of(page)[1] < before


def test_the_landscape_has_the_blends_slopes_or_none(call):
    """The arrow is of another vertex, or the map is of another loss."""
    places = np.random.default_rng(4).uniform([1, 2], [11, 8], (60, 2))
    h = 1e-6 * np.eye(2)
    found = call("landscape", "lossAt", [(place, True) for place in places])
    around = call("landscape", "lossAt", [(place + step, True) for place in places
                                          for step in (h[0], h[1], -h[0], -h[1])])
    losses = np.reshape([one["loss"] for one in around], (-1, 2, 2))
    differences = (losses[:, 0] - losses[:, 1]) / 2e-6
    gradients = np.array([one["gradient"] for one in found])
    steady = np.abs(differences).max(1) < 1  # no pair of pixels begins or ends in between
    assert steady.sum() > 50 and np.abs(gradients).max() > 0.01
    np.testing.assert_allclose(gradients[steady], differences[steady], atol=1e-6)
    steps = call("landscape", "lossAt", [(place, False) for place in places])
    assert all(one["gradient"] == [0, 0] for one in steps)
    counts = np.array([one["loss"] for one in steps]) * 12 * 8
    np.testing.assert_allclose(counts, counts.round(), atol=1e-9)


def test_without_the_blend_there_is_no_way_down(page, address):
    """The arrow of the blended picture stays."""
    opened(page, address, "landscape")
    assert "Flat" not in page.inner_text(".told")
    arrows = page.locator(".sheet polygon.descent")
    assert arrows.count() == 1
    page.get_by_label("blend the edges").uncheck()
    page.get_by_text("Flat as far").wait_for()
    assert settled(page).locator(".sheet polygon.descent").count() == 0
    assert arrows.count() == 0
    page.locator(".sheet .curve.second").nth(20).wait_for(state="attached")


def test_a_plateau_ends_where_the_loss_changes(call):
    """It leaks over a corner, or from one side of the map to the other."""
    values = np.array([[5, 1, 1, 2, 1],
                       [1, 1, 2, 2, 1],
                       [2, 2, 1, 1, 2]])
    border, = call("landscape", "plateauBorder", [(values.ravel(), 5, 1)])
    assert len(border) == 10
    assert sorted(set(np.reshape(border, (-1, 2))[:, 0])) == [0, 1, 2, 3]
