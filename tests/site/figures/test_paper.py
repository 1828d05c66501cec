"""A sheet's points are moved and its pixels chosen: by mouse, keys and fingers."""
import numpy as np
import pytest
from reading import middle, number, opened, point_of, settled

from reference import rasterization


def check_edges(page, p):
    """The figure shows the reference's numbers for the pixel at p and the handles' places."""
    places = [point_of(settled(page).locator(f".handle:text-is('{k}')")) for k in range(3)]
    triangle, p = np.array(places), np.array(p)
    e = [rasterization.edge_function(p, triangle[i], triangle[j]) for i, j in rasterization.EDGES]
    labels = page.locator(".label").all_text_contents()
    found = [number(label.split(" = ")[1]) for label in labels]
    np.testing.assert_allclose(found, e, atol=0.051)  # one decimal is shown
    weights = [number(text) for text in page.locator(".weight").all_text_contents()]
    np.testing.assert_allclose(weights, np.array(e) / sum(e), atol=5.1e-4)
    owns = [bool(rasterization.is_top_left(triangle[i][1] - triangle[j][1],
                                           triangle[j][0] - triangle[i][0]))
            for i, j in rasterization.EDGES]
    edges = page.locator(".outline.first").all()
    assert ["thick" in edge.get_attribute("class") for edge in edges] == owns
    said = page.inner_text(".verdict")
    assert said.startswith(f"Pixel [{int(p[1])}, {int(p[0])}] is ")
    assert ("is covered" in said) == rasterization.is_covered(p, triangle)
    return places


def at(sheet, x, y):
    """The place of (x, y) on a sheet of 12 x 8."""
    box = sheet.bounding_box()
    return box["x"] + x * box["width"] / 12, box["y"] + (8 - y) * box["height"] / 8


def test_a_vertex_follows_the_mouse_and_the_numbers_follow(page, address):
    """A vertex jumps to the pointer, or stays in the table where it was. Its keys do nothing
    after the mouse has moved it."""
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
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("ArrowDown")
    assert point_of(vertex) == [2.25, 4]
    page.mouse.move(*at(sheet, 6.4, 3.7))
    check_edges(page, [6.5, 3.5])
    page.mouse.move(5, 5)                          # back to the chosen pixel
    check_edges(page, [7.5, 3.5])
    page.get_by_role("button", name="Reset").click()
    assert check_edges(page, [7.5, 3.5])[0] == [1.25, 2.25]


def test_a_vertex_follows_the_arrow_keys(page, address):
    """The keys of a slider scroll the page, y points down, or a step is a whole pixel."""
    opened(page, address, "edge_functions")
    page.keyboard.press("Tab")
    for key in ("ArrowRight", "ArrowUp", "ArrowUp", "Shift+ArrowLeft", "PageUp"):
        page.keyboard.press(key)
    assert check_edges(page, [7.5, 3.5])[0] == [0.5, 3.75]
    page.keyboard.press("End")
    assert check_edges(page, [7.5, 3.5])[0] == [12, 8]
    page.keyboard.press("Home")
    assert check_edges(page, [7.5, 3.5])[0] == [0, 0]
    for _ in range(4):
        page.keyboard.press("Tab")                 # three vertices, then the pixel
    page.keyboard.press("ArrowDown")
    check_edges(page, [7.5, 2.5])


class Finger:
    """One finger on a phone. It goes through all that Chromium does to touches."""

    def __init__(self, page):
        self.touch = page.context.new_cdp_session(page)

    def _send(self, kind, *point):
        points = [{"x": point[0], "y": point[1]}] if point else []
        self.touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    def swipe(self, start, end, steps=6):
        self._send("touchStart", *start)
        for t in np.linspace(0, 1, steps + 1)[1:]:
            self._send("touchMove", *(np.array(start) * (1 - t) + np.array(end) * t))
        self._send("touchEnd")


@pytest.fixture
def phone(browser, address):
    """The figure of lecture 02 on a phone."""
    context = browser.new_context(has_touch=True, is_mobile=True,
                                  viewport={"width": 375, "height": 500})
    yield opened(context.new_page(), address, "edge_functions")
    context.close()


def test_a_tap_on_the_middle_of_a_pixel_chooses_this_pixel(phone):
    """A browser, or the sheet itself, gives the taps beside a vertex to the vertex."""
    sheet, probe = phone.locator(".sheet"), phone.locator(".probe")
    handles = phone.locator(".handle:not(.probe)").all()
    for key in 3 * ("ArrowRight", "ArrowUp"):
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


@pytest.mark.parametrize("beside", [0, 18])
def test_a_finger_near_a_vertex_moves_it(phone, beside):
    """The page scrolls away under the finger, or a vertex is too small for a finger."""
    sheet, vertex = phone.locator(".sheet"), phone.locator(".handle:text-is('0')")
    x, y = middle(vertex)
    to = at(sheet, 3, 5.5)
    Finger(phone).swipe((x + beside, y), (to[0] + beside, to[1]))
    assert point_of(vertex) == [3, 5.5]
    assert phone.evaluate("scrollY") == 0


def test_a_swipe_elsewhere_scrolls_the_page(phone):
    """A figure as wide as the phone holds the reader."""
    sheet, probe = phone.locator(".sheet"), phone.locator(".probe")
    chosen = point_of(probe)
    x, y = at(sheet, 9.5, 1.5)
    Finger(phone).swipe((x, y), (x, y - 150), steps=20)
    phone.wait_for_function("scrollY > 50")
    assert point_of(probe) == chosen


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


def test_many_moves_are_drawn_once(page, address):
    """A fast mouse has the figure drawn many times for one picture on the screen."""
    opened(page, address, "edge_functions")
    drawn = page.evaluate("""async () => {
        let drawn = 0;
        new MutationObserver(() => { drawn += 1; }).observe(
            document.querySelector(".sheet svg"), { childList: true });
        const handle = document.querySelector(".handle");
        for (let n = 0; n < 20; n++) {
            handle.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
            await null;                            // each would be seen by the observer
        }
        await new Promise(requestAnimationFrame);
        await null;
        return drawn;
    }""")
    assert drawn == 1
