"""A camera in the plane: what its pixels show, and what they pull, as the reference in space."""
import numpy as np
from hands import spot
from reading import opened, point_of, settled, verdict

from reference import multi_view_fit, pipeline, reconstruction

PIXELS, WIDTH, EYE, TO_STRIP = 20, 0.086, -1.3, 1.1
AROUND = np.array([[0, 1], [1, 2], [2, 0]])


def two_triangles(rng):
    """Counter-clockwise, apart or one in front of the other: vertices (6, 2), segments (6, 2)."""
    turns = np.array([0, 2, 4]) + rng.uniform(0, 1.5, (2, 3))
    corners = rng.uniform(0.25, 0.5, (2, 3, 1)) * np.stack([np.cos(turns), np.sin(turns)], -1)
    middles = rng.uniform([[-0.6, 0.2], [0.1, 0.5]], [[-0.1, 0.5], [0.6, 0.9]])
    return (middles[:, None] + corners).reshape(6, 2), np.concatenate([AROUND, AROUND + 3])


def prism(vertices, segments):
    """Both outlines, as walls along z -> pipeline.Mesh with the vertices at z = -1, then at 1."""
    count = len(vertices)
    i, j = segments.T
    walls = np.concatenate([np.stack([i, j, j + count], 1), np.stack([i, j + count, i + count], 1)])
    return pipeline.make_mesh(np.concatenate([np.insert(vertices, 2, z, axis=1)
                                              for z in (-1, 1)]), walls)


def target_of(outside):
    """The row of pixels, as a picture of the reference, and its camera, which looks along y."""
    wide = TO_STRIP / (PIXELS * WIDTH / 2)
    camera = np.array([[wide, 0, 0, 0], [0, 0, 1, 0], [0, 1, 0, -EYE - 0.1], [0, 1, 0, -EYE]])
    return multi_view_fit.Target(np.zeros((1, PIXELS, 4)),
                                 pipeline.View(camera, PIXELS, 1, np.zeros(4)), 1, outside)


def owners_have_outlines(segments, found):
    """Does each outline end the triangle that its owner sees? The reference looks no farther, and
    a wall's triangles meet in its middle.
    """
    for each in found["outlines"]:
        pixel, right = each["pixel"], each["side"] == 1
        hit = found["hits"][pixel] or found["hits"][pixel - each["side"]]
        if each["vertex"] != segments[hit["segment"], int(right)] or (hit["u"] > 0.5) != right:
            return False
    return True


def test_the_row_of_pixels_and_its_gradients_are_those_of_the_reference(call):
    """An outline moves to the wrong side, a hidden face is seen, or carving has other weights."""
    rng = np.random.default_rng(16)
    scenes = [two_triangles(rng) for _ in range(30)]
    as_given = [([{"p": p} for p in vertices.tolist()], segments) for vertices, segments in scenes]
    rows = call("carving", "render", as_given)
    cases = [case for case in zip(as_given, scenes, rows, strict=True)
             if owners_have_outlines(case[1][1], case[2])]
    assert len(cases) > 10
    for given, (vertices, segments), found in cases:
        outside = rng.random((1, PIXELS)) < 0.5
        target = target_of(outside)
        shape = prism(vertices, segments)
        colours = np.zeros((len(shape.positions), 3))
        pictures, buffers = multi_view_fit.render_views(shape, colours, [target])
        np.testing.assert_allclose(found["coverage"], pictures[0, 0, :, 3], atol=1e-9)
        grad = rng.normal(size=pictures.shape)
        grad_positions, _, grad_level = multi_view_fit.render_views_backward(
            grad, buffers, shape, colours, [target])
        moved, = call("carving", "coverageBackward",
                      [(grad[0, 0, :, 3], found["outlines"], given[0])])
        np.testing.assert_allclose(moved, grad_positions.reshape(2, 6, 3).sum(0)[:, :2], atol=1e-9)
        carved, = call("carving", "carvingBackward",
                       [(1, np.flatnonzero(outside), found["hits"], segments, 6)])
        np.testing.assert_allclose(carved, grad_level.reshape(2, 6).sum(0), atol=1e-9)


def test_what_is_outside_and_the_level_are_those_of_the_reference(call):
    """The row's ends count as covered, or t is counted from the other end."""
    rng = np.random.default_rng(6)
    rows = np.where(rng.random((40, PIXELS)) < 0.7, 0, rng.random((40, PIXELS)))
    wanted = [multi_view_fit.is_outside(row[None, :, None] * np.ones(4))[0] for row in rows]
    np.testing.assert_array_equal(call("carving", "isOutside", rows[:, None]), wanted)
    distance = np.concatenate([-rng.random(10), rng.random(9), [0.0]])
    ends = np.stack([rng.integers(0, 10, 30), rng.integers(10, 20, 30)], 1)
    grad = rng.normal(size=30)
    np.testing.assert_allclose(call("carving", "levelBackward", [(grad, ends, distance)])[0],
                               reconstruction.level_backward(grad, ends, distance), atol=1e-9)


def disc():
    x, y = np.meshgrid((np.arange(25) - 12) / 8, (np.arange(17) - 8) / 8)
    return np.stack([x, y], -1).reshape(-1, 2), np.hypot(x - 0.03, y - 0.41).ravel() - 0.47


def seen(call, distances):
    surfaces = call("sign_grid", "marchingTriangles", [(distance,) for distance in distances])
    return call("carving", "render", [(each["vertices"], each["segments"]) for each in surfaces])


def test_carving_pulls_the_grid_by_the_weights_of_the_point_seen(call):
    """The weights are those of another point than the one that the pixel sees."""
    points, distance = disc()
    picture, = seen(call, [distance])
    for k in 7, 10, 12:
        gradient = np.array(call("carving", "pull", [([k], [0] * PIXELS, distance)])[0])
        assert 3 <= (gradient < 0).sum() <= 4 and not (gradient > 0).any()
        assert np.isclose(gradient.sum(), -4 / PIXELS)
        np.testing.assert_allclose(gradient @ points / gradient.sum(), picture["hits"][k]["at"],
                                   atol=1e-9)


def test_coverage_pulls_the_grid_down_the_loss(call):
    """The outline's crossing goes away from where the coverage is the target's."""
    _, distance = disc()
    target, h = np.full(PIXELS, 0.5), 1e-5
    gradient = np.array(call("carving", "pull", [(list(range(PIXELS)), target, distance)])[0])
    pulled = np.flatnonzero(gradient)
    assert len(pulled) == 4
    pictures = seen(call, [distance + sign * h * (np.arange(len(distance)) == n)
                           for n in pulled for sign in (1, -1)])
    losses = np.array([((np.array(picture["coverage"]) - target)**2).mean()
                       for picture in pictures])
    np.testing.assert_allclose(gradient[pulled], (losses[::2] - losses[1::2]) / (2 * h), atol=1e-7)


def covered(pixel):
    """What a pixel says of the target and of what is found, in percent."""
    return point_of(pixel)[-2:]


def test_each_pixel_says_by_what_it_pulls_and_play_opens_the_hole(page, address):
    """A pixel gives the reason of another one, or the skin stays."""
    opened(page, address, "ask_a_pixel")
    pixel = page.get_by_role("slider", name="Pixel")
    assert verdict(page).startswith("Carving") and covered(pixel) == [0, 100]
    for key, reason in (("Home", "Coverage"), ("End", "Nothing"), ("ArrowLeft", "Coverage")):
        pixel.press(key)
        assert verdict(page).startswith(reason)
    page.mouse.move(*spot(page.locator(".sheet"), 0.2, 0.3))
    assert verdict(page).startswith("Only colour")
    page.get_by_role("button", name="Play").click()
    page.get_by_text("The coverage is right").wait_for(timeout=120_000)
    pixel.press("Home")
    for _ in range(PIXELS):
        settled(page)
        target, found = covered(pixel)
        assert abs(target - found) <= 2
        pixel.press("ArrowRight")
