"""A sheet's points are moved and its pixels chosen: by mouse, keys and fingers."""
import numpy as np
import pytest
from hands import drag, spot, swipe
from reading import numbers, opened, point_of, settled

from reference import rasterization


def check_edges(page, p):
    """The figure shows the reference's numbers for the pixel at p and the handles' places."""
    places = [point_of(settled(page).locator(f".handle:text-is('{k}')")) for k in range(3)]
    triangle, p = np.array(places), np.array(p)
    e = [rasterization.edge_function(p, triangle[i], triangle[j]) for i, j in rasterization.EDGES]
    labels = page.locator(".label").all_text_contents()
    found = [numbers(label)[-1] for label in labels]
    np.testing.assert_allclose(found, e, atol=0.051)  # one decimal is shown
    weights = numbers(" ".join(page.locator(".weight").all_text_contents()))
    np.testing.assert_allclose(weights, np.array(e) / sum(e), atol=5.1e-4)
    owns = [bool(rasterization.is_top_left(triangle[i][1] - triangle[j][1],
                                           triangle[j][0] - triangle[i][0]))
            for i, j in rasterization.EDGES]
    edges = page.locator(".outline.first").all()
    assert ["thick" in edge.get_attribute("class") for edge in edges] == owns
    said = page.inner_text(".verdict")
    assert said.startswith(f"Pixel [{int(p[1])}, {int(p[0])}] is ")
    assert ("is covered" in said) == rasterization.cover(p, triangle, np.zeros(3))[0]
    return places


def at(sheet, x, y):
    """The place of (x, y) on a sheet of 12 x 8."""
    return spot(sheet, x / 12, 1 - y / 8)


def test_a_vertex_follows_the_mouse_and_the_numbers_follow(page, address):
    """A vertex jumps to the pointer, or stays in the table where it was. Its keys do nothing
    after the mouse has moved it."""
    opened(page, address, "edge_functions")
    sheet, vertex = page.locator(".sheet"), page.locator(".handle:text-is('0')")
    check_edges(page, [7.5, 3.5])
    drag(page, vertex, *np.subtract(at(sheet, 2.3, 4.2), spot(vertex)), beside=9)
    assert point_of(vertex) == [2.5, 4]
    for key in ("ArrowRight", "ArrowLeft", "ArrowDown"):
        page.keyboard.press(key)
    assert point_of(vertex) == [2.5, 3.5]
    page.mouse.move(*at(sheet, 6.4, 3.7))
    check_edges(page, [6.5, 3.5])
    page.mouse.move(5, 5)                          # back to the chosen pixel
    check_edges(page, [7.5, 3.5])


def test_a_vertex_follows_the_arrow_keys(page, address):
    """The keys of a slider scroll the page, y points down, or a step is a whole pixel."""
    opened(page, address, "edge_functions")
    page.keyboard.press("Tab")
    for key in ("ArrowRight", "ArrowUp", "ArrowUp", "Shift+ArrowLeft", "PageUp"):
        page.keyboard.press(key)
    assert check_edges(page, [7.5, 3.5])[0] == [0, 5.5]
    page.keyboard.press("End")
    assert check_edges(page, [7.5, 3.5])[0] == [12, 8]
    page.keyboard.press("Home")
    assert check_edges(page, [7.5, 3.5])[0] == [0, 0]
    for _ in range(4):
        page.keyboard.press("Tab")                 # three vertices, then the pixel
    page.keyboard.press("ArrowDown")
    check_edges(page, [7.5, 2.5])


@pytest.fixture
def phone(new_page, address):
    """The figure of lecture 02 on a phone."""
    page = new_page(has_touch=True, is_mobile=True, viewport={"width": 375, "height": 500})
    return opened(page, address, "edge_functions")


def test_a_tap_on_the_middle_of_a_pixel_chooses_this_pixel(phone):
    """A browser, or the sheet itself, gives the taps beside a vertex to the vertex."""
    sheet, probe = phone.locator(".sheet"), phone.locator(".probe")
    handles = phone.locator(".handle:not(.probe)").all()
    for key in ("ArrowRight", "ArrowUp"):
        handles[0].press(key)                      # to the corner of four pixels
    vertices = [point_of(handle) for handle in handles]
    radius = 12 / (sheet.bounding_box()["width"] / 12)
    wrong, hidden = [], 0
    for p in [(x + 0.5, y + 0.5) for y in range(8) for x in range(12)]:
        if min(np.hypot(*np.subtract(p, vertex)) for vertex in vertices) <= radius:
            hidden += 1
            continue
        phone.touchscreen.tap(*at(sheet, *p))
        wrong += [] if point_of(probe) == list(p) else [p]
    assert not wrong and hidden <= 3 and vertices[0] == [2, 3]
    assert [point_of(handle) for handle in handles] == vertices


def test_a_finger_moves_a_vertex_that_is_near_or_the_pixel_aside(phone):
    """The page scrolls away under the finger, or a vertex is too small for a finger."""
    sheet, vertex = phone.locator(".sheet"), phone.locator(".handle:text-is('0')")
    for place, beside in ([3, 5.5], 0), ([2, 6], 18):
        (x, y), (right, down) = spot(vertex), at(sheet, *place)
        swipe(phone, ((x + beside, y), (right + beside, down)))
        assert point_of(vertex) == place
        assert phone.evaluate("scrollY") == 0
    x, y = spot(phone.locator(".probe"))
    swipe(phone, ((x, y), (x + 60, y + 9)))
    assert phone.evaluate("scrollY") == 0
    assert point_of(phone.locator(".probe")) == [9.5, 3.5]


@pytest.mark.parametrize("place", [(9.5, 1.5), (7.5, 3.5)])
def test_a_swipe_up_scrolls_the_page_from_the_chosen_pixel_too(phone, place):
    """A figure as wide as the phone holds the reader."""
    x, y = at(phone.locator(".sheet"), *place)
    swipe(phone, ((x, y), (x, y - 150)))
    phone.wait_for_function("scrollY > 50")
    assert point_of(phone.locator(".probe")) == [7.5, 3.5]


def test_a_vertex_at_the_border_is_gripped_on_its_outer_half(page, address):
    """The mouse selects words there, and a finger scrolls the page."""
    opened(page, address, "edge_functions")
    vertex = page.locator(".handle:text-is('0')")
    vertex.press("End")
    drag(page, vertex, -100, 100, beside=9)
    assert point_of(vertex) < [11, 7]


def test_only_the_main_button_drags(page, address):
    """The menu of the right button opens, and the vertex hangs on the mouse."""
    opened(page, address, "edge_functions")
    vertex = page.locator(".handle:not(.probe)").first
    before = point_of(vertex)
    drag(page, vertex, 60, -40, button="right")
    assert point_of(vertex) == before


def test_a_mouse_that_passes_is_not_said_to_the_blind(page, address):
    """A screen reader reads out the verdict of each pixel on the way."""
    opened(page, address, "edge_functions")
    sheet, verdict = page.locator(".sheet"), page.locator(".verdict")
    page.evaluate("""() => {
        const answer = document.querySelector(".verdict");
        window.said = [];
        new MutationObserver(() => window.said.push(answer.ariaLive))
            .observe(answer, { childList: true });
    }""")
    for x in (1.5, 4.5, 11.5):
        page.mouse.move(*at(sheet, x, 3.5))
        settled(page)
    said = page.evaluate("window.said.splice(0)")
    assert set(said) == {"off"}
    page.mouse.down()
    page.mouse.up()
    page.keyboard.press("ArrowDown")
    settled(page)
    assert set(page.evaluate("window.said")) == {"polite"}
    assert verdict.get_attribute("role") == "status"
