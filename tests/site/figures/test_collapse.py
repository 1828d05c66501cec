"""The outline that loses points: quadrics in the plane, and the order of the collapses."""
import numpy as np
from playwright.sync_api import expect
from reading import opened, settled

from reference import simplification


def in_space(quadric):
    """The six numbers of a quadric of the plane as the reference's matrix, with z = 0."""
    xx, xy, yy, xd, yd, dd = quadric
    return np.array([[xx, xy, 0, xd], [xy, yy, 0, yd], [0, 0, 0, 0], [xd, yd, 0, dd]])


def test_quadrics_and_best_places_are_those_of_the_reference(call, agrees):
    """The normal points along the line, or b has the other sign."""
    a, b, x = np.random.default_rng(12).normal(size=(3, 60, 2))
    quadrics = np.array(call("collapse", "lineQuadric", list(zip(a, b, strict=True))))
    step, length = b - a, np.linalg.norm(b - a, axis=1)
    n = np.stack([step[:, 1], -step[:, 0]], -1) / length[:, None]
    planes = np.column_stack([n, np.zeros(60), -(n * a).sum(1)])
    wanted = length[:, None, None] * simplification.plane_quadrics(planes)
    np.testing.assert_allclose([in_space(q) for q in quadrics], wanted, atol=1e-9)
    sums = quadrics[:30] + quadrics[30:]
    matrices = np.array([in_space(q) for q in sums])
    flat = np.insert(x[:30], 2, 0, axis=1)
    agrees("collapse", "quadricError", list(zip(sums, x, strict=False)),
           simplification.quadric_error(matrices, flat))
    found = call("collapse", "bestAnywhere", [(q,) for q in sums])
    steep = [n for n, place in enumerate(found) if place]
    assert 20 < len(steep) < 30
    best = simplification.best_anywhere(matrices[steep] + np.diag([0, 0, 1, 0]))
    np.testing.assert_allclose([found[n] for n in steep], best[:, :2], atol=1e-9)
    ends = [np.insert(part[:30], 2, 0, axis=1) for part in (a, b)]
    agrees("collapse", "bestOnSegment", list(zip(sums, a, b, strict=False)),
           simplification.best_on_segment(matrices, *ends)[0][:, :2])


def test_points_on_straight_lines_go_first(call):
    """An edge at a corner is collapsed, although one on a side costs nothing."""
    square = [(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (4, 3), (4, 4), (2, 4), (0, 4), (0, 2)]
    states, = call("collapse", "simplify", [(np.array(square, float),)])
    assert [len(state["points"]) for state in states] == [10, 9, 8]
    corners = {(0, 0), (4, 0), (4, 4), (0, 4)}
    for state in states:
        assert corners <= {tuple(np.round(point, 9)) for point in state["points"]}
        assert abs(state["next"]["cost"]) < 1e-9


def test_the_slider_takes_points_away_and_play_at_the_end_begins_again(page, address):
    """The outline is that of another number of points. The button does nothing where no point can
    be taken away."""
    opened(page, address, "collapse")
    points = page.get_by_role("slider")
    for count in 100, 20, 8:
        points.fill(str(count))
        assert settled(page).locator(".sheet .sample.point").count() == count
    page.get_by_role("button", name="Play").click()
    expect(points).not_to_have_value("8")
    assert int(points.input_value()) > 40


def test_the_distance_of_a_collapse_is_that_of_its_lines(call):
    """The lines' lengths are forgotten, or the square."""
    quadrics = call("collapse", "lineQuadric", [((0, 0), (3, 0)), ((0, 2), (1, 2))])
    q = np.sum(quadrics, 0)
    cost, = call("collapse", "quadricError", [(q, (7, 1.5))])
    found, = call("collapse", "distanceOf", [({"q": q.tolist(), "cost": cost},)])
    assert np.isclose(found**2, (3 * 1.5**2 + 1 * 0.5**2) / 4, atol=1e-9)
