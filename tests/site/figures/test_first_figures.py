"""The figures of lectures 02 to 08: their numbers, their points to move."""
import re

import numpy as np
import pytest
from reading import middle, opened, point_of, shown

from reference import antialiasing, interpolation, mipmapping, rasterization, sampling

# Numbers

def test_edge_functions_are_those_of_the_reference(call):
    """The edge is walked the other way round, a sample on an edge belongs to both triangles or to
    none, or the weights belong to other vertices."""
    rng = np.random.default_rng(2)
    whole = rng.integers(0, 7, (400, 4, 2)).astype(float)
    points = np.concatenate([whole, rng.normal(size=(100, 4, 2))])
    cases = [(p, triangle) for p, *triangle in points]
    wanted = [rasterization.edge_function(p, t[0], t[1]) for p, t in cases]
    assert sum(e == 0 for e in wanted) > 30, "these inputs have hardly any ties"
    found = call("edge_functions", "edgeFunction", [(p, t[0], t[1]) for p, t in cases])
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-9)
    areas = [rasterization.signed_area(np.array(t)) for _, t in cases]
    np.testing.assert_allclose(call("edge_functions", "signedArea", [(t,) for _, t in cases]),
                               areas, rtol=0, atol=1e-9)
    found = call("edge_functions", "isCovered", cases)
    assert found == [bool(rasterization.is_covered(p, np.array(t))) for p, t in cases]
    solid = [case for case, area in zip(cases, areas, strict=True) if area != 0]
    np.testing.assert_allclose(
        call("edge_functions", "screenWeights", solid),
        [rasterization.screen_weights(p, np.array(t)) for p, t in solid], atol=1e-9)


def test_left_and_lower_edges_are_top_left(call):
    """A horizontal edge belongs to the wrong side."""
    normals = [(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)]
    wanted = [bool(rasterization.is_top_left(*normal)) for normal in normals]
    assert call("edge_functions", "isTopLeft", normals) == wanted
    assert call("edge_functions", "isTopLeft", [(0, 1), (0, -1), (1, -5)]) == [True, False, True]


def test_the_blend_and_its_gradient_are_those_of_the_reference(call):
    """A sign of the gradient is turned, or at the kink the wrong pixel changes."""
    rng = np.random.default_rng(8)
    ends = rng.uniform(-1, 2, (200, 4))
    ends[:, 1], ends[:, 3] = rng.uniform(0.1, 1, 200), rng.uniform(-1, -0.1, 200)
    c = np.array([antialiasing.crossing(*end) for end in ends])
    np.testing.assert_allclose(call("antialias", "crossing", ends), c, atol=1e-9)
    np.testing.assert_allclose(
        call("antialias", "crossingBackward", [(1.7, *end) for end in ends]),
        [antialiasing.crossing_backward(np.array(1.7), *end) for end in ends], atol=1e-9)
    c = np.concatenate([c, [0, 0.5, 1, -0.05, 1.05]])
    alpha = antialiasing.blend_weight(c)
    np.testing.assert_allclose(call("antialias", "blendWeight", c[:, None]), alpha, atol=1e-9)
    np.testing.assert_allclose(call("antialias", "blendWeightBackward", [(3.0, x) for x in c]),
                               antialiasing.blend_weight_backward(np.full(len(c), 3.0), c))
    true = np.full(200, True)
    assert call("antialias", "isBlended", np.column_stack([c[:200], ends])) == list(
        antialiasing.is_blended(c[:200], true, *ends.T))
    pair, grad = np.array([[[0.3], [0.8]]]), np.array([[[5.0], [7.0]]])
    numbers = np.array([0]), np.array([1])
    np.testing.assert_allclose(
        call("antialias", "blend", [(0.3, 0.8, a) for a in alpha]),
        [antialiasing.blend(pair, *numbers, np.array([a])).ravel() for a in alpha], atol=1e-9)
    wanted = [antialiasing.blend_backward(grad, pair, *numbers, np.array([a])) for a in alpha]
    np.testing.assert_allclose(
        call("antialias", "blendBackward", [([5, 7], 0.3, 0.8, a) for a in alpha]),
        [[*colour.ravel(), *by_alpha] for colour, by_alpha in wanted], atol=1e-9)


def test_the_weights_of_the_face_are_those_of_the_reference(call):
    """The weights are multiplied by w, or not normalised."""
    rng = np.random.default_rng(5)
    e, w = rng.uniform(0.1, 1, (2, 200, 3))
    b = interpolation.barycentric_from_screen(e, w)
    found = call("perspective", "barycentricFromScreen", list(zip(e, w, strict=True)))
    np.testing.assert_allclose(found, b, atol=1e-9)
    faces, seen, corners = np.array([[0, 1, 2]]), np.array([[0]]), rng.normal(size=(3, 2))
    np.testing.assert_allclose(
        call("perspective", "interpolate", [(weights, corners) for weights in b]),
        [interpolation.interpolate_loop(corners, faces, seen, weights[None, None])[0, 0]
         for weights in b], atol=1e-9)


def test_what_a_pixel_sees_in_perspective_is_projected_back_to_it(call):
    """The w of the corners are those of other corners."""
    camera = {"tilt": 50, "distance": 1.7}
    rng = np.random.default_rng(50)
    pixels = rng.uniform([50, 20], [110, 50], (100, 2)).tolist()
    seen = call("perspective", "seenAt", [(p, camera) for p in pixels])
    there = [(p, s) for p, s in zip(pixels, seen, strict=True) if s]
    assert len(there) > 50
    back = call("perspective", "project", [(s["right"], camera) for _, s in there])
    np.testing.assert_allclose([b["point"] for b in back], [p for p, _ in there], atol=1e-9)
    assert np.abs(np.subtract([s["right"] for _, s in there],
                              [s["affine"] for _, s in there])).max() > 0.1


def test_levels_are_those_of_the_reference(call):
    """J is transposed or not in texels, or the fraction belongs to the lower level."""
    rng = np.random.default_rng(6)
    jacobian = rng.normal(size=(200, 2, 2)) * 2.0 ** rng.integers(-9, 2, (200, 1, 1))
    level = mipmapping.mip_level(jacobian, 64, 16)
    np.testing.assert_allclose(call("mip_level", "mipLevel", [(j, 64, 16) for j in jacobian]),
                               level, atol=1e-9)
    level = np.concatenate([level, np.arange(8)])
    np.testing.assert_allclose(call("mip_level", "blendLevels", [(x, 6) for x in level]),
                               np.transpose(mipmapping.blend_levels(level, 6)), atol=1e-9)
    image = rng.uniform(size=(8, 8))
    levels, = call("mip_level", "pyramid", [(image,)])
    for found, wanted in zip(levels, mipmapping.pyramid(image[..., None]), strict=True):
        np.testing.assert_allclose(found, wanted[..., 0], atol=1e-9)
    uv = rng.uniform(-2, 2, (100, 2))
    np.testing.assert_allclose(call("mip_level", "bilinear", [(image, x) for x in uv]),
                               mipmapping.texture(image[..., None], uv)[:, 0], atol=1e-9)


def test_the_floors_jacobian_is_its_derivative(call):
    """A term of the quotient rule is missing."""
    rng, h = np.random.default_rng(60), 1e-4
    pixels, camera = rng.uniform([0, 0], [168, 70], (50, 2)), {"tilt": 25, "forward": 0.3}

    def uv(at):
        return np.array([s["uv"] for s in call("mip_level", "floorAt", [(p, camera) for p in at])])

    jacobian = [s["jacobian"] for s in call("mip_level", "floorAt",
                                            [(p, camera) for p in pixels])]
    columns = [(uv(pixels + step) - uv(pixels - step)) / (2 * h) for step in h * np.eye(2)]
    np.testing.assert_allclose(jacobian, np.stack(columns, -1), rtol=1e-5, atol=1e-7)


def test_aliases_are_those_of_the_reference(call):
    """A frequency of half the rate has the wrong sign, or the box is too wide."""
    frequency = np.concatenate([np.random.default_rng(3).uniform(-40, 40, 200),
                                np.arange(-24, 25, 6)])
    np.testing.assert_allclose(call("alias", "aliasFrequency", [(f, 12) for f in frequency]),
                               sampling.alias_frequency(frequency, 12.0), atol=1e-9)
    for width, n in ((3, 4), (15, 180), (7, 20)):
        found, = call("alias", "boxSpectrum", [(width, n)])
        np.testing.assert_allclose(found, sampling.box_spectrum(width, n), atol=1e-9)


# Points to move

def check_edges(page, p):
    """The table shows the reference's numbers for the pixel at p and the handles' places."""
    places = [point_of(page.locator(f".handle:text-is('{k}')")) for k in range(3)]
    triangle, p = np.array(places), np.array(p)
    e = [rasterization.edge_function(p, triangle[i], triangle[j]) for i, j in rasterization.EDGES]
    rows = shown(page, "The pixel's edge functions")
    np.testing.assert_allclose([row[0] for row in rows], [*e, sum(e)], atol=5.1e-5)
    np.testing.assert_allclose([row[2] for row in rows[:3]], np.array(e) / sum(e), atol=5.1e-4)
    owns = [rasterization.is_top_left(triangle[i][1] - triangle[j][1],
                                      triangle[j][0] - triangle[i][0])
            for i, j in rasterization.EDGES]
    assert [row[1] for row in rows[:3]] == ["yes" if own else "no" for own in owns]
    covered = page.locator(".verdict").inner_text().startswith("Covered")
    assert covered == rasterization.is_covered(p, triangle)
    return places


def at(sheet, x, y):
    """The place of (x, y) on a sheet of 12 x 8."""
    box = sheet.bounding_box()
    return box["x"] + x * box["width"] / 12, box["y"] + (8 - y) * box["height"] / 8


def test_a_vertex_follows_the_mouse_and_the_numbers_follow(page, address):
    """A vertex jumps to the pointer, or stays in the table where it was."""
    opened(page, address, "edge_functions")
    sheet, vertex = page.locator(".sheet"), page.locator(".handle:text-is('0')")
    check_edges(page, [7.5, 3.5])
    off = 9                                        # pressed beside its middle
    page.mouse.move(middle(vertex)[0] + off, middle(vertex)[1])
    page.mouse.down()
    target = at(sheet, 2.3, 4.2)
    page.mouse.move(target[0] + off, target[1], steps=4)
    page.mouse.up()
    assert point_of(vertex) == [2.25, 4.25]
    page.mouse.move(*at(sheet, 6.4, 3.7))
    check_edges(page, [6.5, 3.5])
    page.mouse.move(5, 5)                          # back to the chosen pixel
    check_edges(page, [7.5, 3.5])
    page.get_by_role("button", name="Reset").click()
    assert check_edges(page, [7.5, 3.5])[0] == [1.25, 2.25]


def test_a_vertex_follows_the_arrow_keys(page, address):
    """The keys scroll the page, y points down, or a step is a whole pixel."""
    opened(page, address, "edge_functions")
    page.keyboard.press("Tab")
    for key in ("ArrowRight", "ArrowUp", "ArrowUp", "Shift+ArrowLeft"):
        page.keyboard.press(key)
    assert check_edges(page, [7.5, 3.5])[0] == [0.5, 2.75]
    for _ in range(4):
        page.keyboard.press("Tab")                 # three vertices, then the pixel
    page.keyboard.press("ArrowDown")
    check_edges(page, [7.5, 2.5])


def test_a_vertex_follows_a_finger_and_the_page_still_scrolls(browser, address):
    """The finger scrolls the page instead of moving the vertex, or can no longer scroll it."""
    context = browser.new_context(has_touch=True, viewport={"width": 375, "height": 800})
    page = opened(context.new_page(), address, "edge_functions")
    sheet, vertex = page.locator(".sheet"), page.locator(".handle:text-is('0')")
    touch = context.new_cdp_session(page)

    def send(kind, *point):
        points = [{"x": point[0], "y": point[1]}] if point else []
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    send("touchStart", *middle(vertex))
    for y in (3.0, 4.0, 5.5):
        send("touchMove", *at(sheet, 3, y))
    send("touchEnd")
    assert point_of(vertex) == [3, 5.5]
    page.touchscreen.tap(*at(sheet, 4.5, 2.5))
    page.get_by_text("Pixel [2, 4]").wait_for()    # a tap becomes a click a little later
    check_edges(page, [4.5, 2.5])
    actions = [where.evaluate("e => getComputedStyle(e).touchAction") for where in (sheet, vertex)]
    assert actions == ["auto", "none"]
    box = vertex.bounding_box()
    assert min(box["width"], box["height"]) >= 44
    context.close()


def test_an_edge_that_moves_shows_the_references_gradient(page, address):
    """The gradient is shown of the edge before it moved, or of the other pixel."""
    opened(page, address, "antialias")
    sides = set()
    for _ in range(12):
        page.locator(".handle:text-is('0')").press("ArrowRight")
        rows = shown(page, "The gradient at both ends")
        ends = np.array([row[:2] for row in rows]).ravel()
        c = antialiasing.crossing(*ends)
        sides.add(bool(c < 0.5))
        grad_c = antialiasing.blend_weight_backward(np.array([0.9 - 0.2]), np.array([c]))[0]
        wanted = np.reshape(antialiasing.crossing_backward(grad_c, *ends), (2, 2))
        np.testing.assert_allclose([row[2:] for row in rows], wanted, atol=5.1e-4)
    assert sides == {True, False}, "the kink is not passed"


def test_the_pixel_in_perspective_shows_the_references_weights(page, address):
    """The weights are those of another pixel than the one pointed at."""
    opened(page, address, "perspective")
    page.get_by_label("tilt").press("ArrowRight")
    rows = np.array(shown(page, "The pixel's weights"))
    b = interpolation.barycentric_from_screen(rows[:, 1], rows[:, 0])
    np.testing.assert_allclose(rows[:, 2], b, atol=2e-3)
    page.locator(".probe").last.press("ArrowRight")
    assert not np.allclose(shown(page, "The pixel's weights"), rows, atol=1e-3)


def test_the_floors_pixel_shows_the_references_level(page, address):
    """J is shown of one pixel, and the level of another."""
    opened(page, address, "mip_level")
    for _ in range(3):
        page.get_by_label("tilt").press("ArrowRight")
        page.locator(".probe").first.press("ArrowDown")
        jacobian = np.array(shown(page, "J in texels")) / 64
        level = float(re.search(r"level = ([\d.]+)", page.inner_text(".pane"))[1])
        wanted, = mipmapping.mip_level(jacobian[None], 64, 64)
        assert abs(level - wanted) < 2e-3


@pytest.mark.parametrize("name", ["perspective", "mip_level"])
def test_a_pixel_chosen_in_one_picture_is_chosen_in_the_other(page, address, name):
    """The mouse crosses the other picture on its way, and the chosen pixel is forgotten."""
    opened(page, address, name)
    left, right = page.get_by_role("slider", name="Pixel").all()
    first = left.get_attribute("aria-valuetext")
    left.focus()
    for _ in range(5):
        page.keyboard.press("ArrowLeft")
    chosen = left.get_attribute("aria-valuetext")
    assert chosen != first and right.get_attribute("aria-valuetext") == chosen
    tables = page.locator(".answers table").all_inner_texts()
    x, y = middle(right)
    page.mouse.move(x + 20, y + 20)
    assert page.locator(".answers table").all_inner_texts() != tables
    page.mouse.move(1, 1)
    assert page.locator(".answers table").all_inner_texts() == tables


def test_only_the_main_button_drags(page, address):
    """The menu of the right button opens, and the vertex hangs on the mouse."""
    opened(page, address, "edge_functions")
    vertex = page.locator(".handle:not(.probe)").first
    before = point_of(vertex)
    x, y = middle(vertex)
    page.mouse.move(x, y)
    page.mouse.down(button="right")
    page.mouse.move(x + 60, y - 40, steps=4)
    page.mouse.up(button="right")
    assert point_of(vertex) == before


def test_the_slider_shows_the_alias(page, address):
    """The alias is that of the wave before."""
    opened(page, address, "alias")
    page.get_by_role("slider", name="periods").fill("16.5")
    assert "the samples show 4.5" in page.inner_text(".verdict")
    assert "= 4.5." in page.inner_text(".pane")
    page.get_by_role("slider", name="periods").fill("5.5")
    assert page.inner_text(".verdict") == "5.5 periods, seen correctly."
