"""What every figure of the lectures' pages has: room, names, and files that can be read."""
import pytest
from checks import barriers, moved
from reading import NAMES, SOURCE, opened, settled


@pytest.mark.parametrize("width", [375, 768, 1280])
@pytest.mark.parametrize("name", NAMES)
def test_nothing_on_the_page_moves_when_a_figure_starts(page, address, name, width):
    """The room that is kept for the figure is too small. (It must not be far too large, either.)"""
    page.set_viewport_size({"width": width, "height": 3000})
    page.route("**/begin.js", lambda route: (page.wait_for_timeout(150), route.continue_()))
    opened(page, address, name)
    assert moved(page) == []
    room, used, across = page.evaluate("""() => {
        const place = document.querySelector(".answers");
        const bottoms = [...place.firstElementChild.children].map(
            (child) => child.getBoundingClientRect().bottom);
        return [place.getBoundingClientRect().height,
                Math.max(...bottoms) - place.getBoundingClientRect().top,
                document.documentElement.scrollWidth];
    }""")
    assert used <= room < used + 70
    assert room < 812  # the height of a phone 375 wide: what is moved and what changes are seen
    assert across == width


@pytest.mark.parametrize("name", NAMES)
def test_a_figure_is_for_all_readers(page, address, name):
    """A text is too pale, or a handle has no name."""
    opened(page, address, name)
    for theme in "light", "dark":
        page.evaluate("theme => { document.body.dataset.theme = theme }", theme)
        assert barriers(page) == [], theme


def seen(page):
    """What a figure shows above its pictures: its words, its settings, its drawing."""
    return settled(page).locator(".pane").evaluate("""(pane) => [pane.textContent,
        ...[...pane.querySelectorAll("input")].map((one) => [one.value, one.checked]),
        ...[...pane.querySelectorAll(".sheet svg")].map((one) => one.innerHTML)]""")


@pytest.mark.parametrize("name", NAMES)
def test_what_is_moved_is_drawn_and_reset_brings_all_back(page, address, name):
    """A handle or a slider does nothing; or after Reset the text is of another picture."""
    opened(page, address, name)
    page.wait_for_load_state("networkidle")
    first = seen(page)
    for one in page.locator(".handle, input:visible").all():
        before = seen(page)
        one.click() if one.get_attribute("type") == "checkbox" else one.press("ArrowRight")
        assert seen(page) != before
    reset = page.get_by_role("button", name="Reset")
    if reset.count():
        reset.click()
        assert seen(page) == first


def with_part(*parts):
    """The figures that call one of these functions."""
    return [name for name in NAMES
            if any(part in (SOURCE / f"{name}.js").read_text() for part in parts)]


@pytest.mark.parametrize("name", with_part("sway("))
def test_it_sways_until_it_is_touched(new_page, address, name):
    """It stands still; or it moves on under the reader's hand."""
    page = opened(new_page(), address, name)
    first = seen(page)
    page.wait_for_timeout(900)
    assert seen(page) != first
    page.locator(".handle").first.focus()
    rests = seen(page)
    page.wait_for_timeout(300)
    assert seen(page) == rests


@pytest.mark.parametrize("name", with_part("player(", "playAndReset("))
def test_play_moves_and_pause_rests(page, address, name):
    """The button does nothing, or what it has begun never ends."""
    opened(page, address, name)
    page.wait_for_load_state("networkidle")
    pictures = "[...document.querySelectorAll('canvas')].map((one) => one.toDataURL())"
    before = seen(page), page.evaluate(pictures)
    page.locator("button:text-matches('^(Play|Walk)$')").evaluate("""async (button) => {
      button.click();
      for (let k = 0; k < 6; k += 1) await new Promise(requestAnimationFrame);
      button.click();
    }""")  # at once: on a busy machine it is at its end before a mouse is there
    rests = seen(page)
    assert (rests, page.evaluate(pictures)) != before
    for _ in range(6):
        settled(page)
    assert seen(page) == rests


@pytest.mark.parametrize("path", sorted(SOURCE.iterdir()), ids=lambda path: path.name)
def test_a_file_is_short(path):
    """A figure has grown until nobody reads it."""
    lines = path.read_text().splitlines()
    assert len(lines) < (200 if path.suffix == ".js" else 350) and max(map(len, lines)) <= 100
