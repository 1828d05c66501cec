"""Players: animations, and pairs of pictures, by mouse and by keys."""
import io
import shutil
import sys

import numpy as np
import pytest
from PIL import Image
from serving import ROOT, served

sys.path.insert(0, str(ROOT / "site"))

from pages.posters import poster

FRAMES = [np.full((40, 60, 3), shade, np.uint8) for shade in (10, 90, 250)]
HEAD = ('<!doctype html><html lang="en"><title>t</title><link rel="icon" href="data:,">'
        '<link rel="stylesheet" href="static/players/players.css">'
        '<script type="module" src="static/players/begin.js"></script>')
SHADE = """() => {
  const canvas = document.querySelector("canvas");
  return [...canvas.getContext("2d").getImageData(5, 5, 1, 1).data].slice(0, 3);
}"""


@pytest.fixture
def place(tmp_path):
    """A folder with an animation, its still and the players -> a function that serves a page."""
    frames = [Image.fromarray(frame) for frame in FRAMES]
    frames[0].save(tmp_path / "film.png", save_all=True, append_images=frames[1:], duration=120)
    (tmp_path / "still.png").write_bytes(poster((tmp_path / "film.png").read_bytes()))
    frames[0].save(tmp_path / "first.png")
    frames[-1].save(tmp_path / "last.png")
    shutil.copytree(ROOT / "site" / "static", tmp_path / "static")

    def written(body):
        (tmp_path / "page.html").write_text(HEAD + body, encoding="utf-8")
        return f"{address}/page.html"

    with served(tmp_path) as address:
        yield written


def animation(more=""):
    return (f'<figure class="animation" data-file="film.png" {more}>'
            '<img src="still.png" alt="grey" width="60" height="40"></figure>')


def test_the_still_is_the_first_frame(tmp_path):
    """Films begin with what they come to, so the last frame is the one before it."""
    frames = [Image.fromarray(frame) for frame in FRAMES]
    frames[0].save(tmp_path / "film.png", save_all=True, append_images=frames[1:], duration=120)
    (tmp_path / "still.png").write_bytes(poster((tmp_path / "film.png").read_bytes()))
    assert np.all(np.asarray(Image.open(tmp_path / "still.png").convert("RGB")) == FRAMES[0])


def test_an_animation_is_fetched_when_it_is_played(page, place):
    """Ten films are loaded with a lecture that nobody has scrolled."""
    asked = []
    page.on("request", lambda request: asked.append(request.url.rpartition("/")[2]))
    page.goto(place(animation()), wait_until="networkidle")
    assert "still.png" in asked and "film.png" not in asked
    page.get_by_role("button", name="Play").click()
    page.wait_for_selector("canvas")
    assert "film.png" in asked
    page.get_by_role("button", name="Pause").click()


@pytest.mark.parametrize(("key", "frame"), [("Home", 0), ("End", 2)])
def test_the_slider_shows_a_frame_by_keys(page, place, key, frame):
    """The slider is one frame off, or only answers to a mouse."""
    page.goto(place(animation()))
    slider = page.get_by_role("slider")
    slider.press("ArrowRight")
    page.wait_for_selector("canvas")
    slider.press(key)
    page.wait_for_function("n => document.querySelector('input').value == n", arg=frame)
    assert page.evaluate(SHADE) == FRAMES[frame][0, 0].tolist()
    assert slider.get_attribute("aria-valuetext") == f"{frame + 1} of 3"


def test_it_plays_by_a_finger_and_stops(browser, place):
    """It answers to a mouse alone; or it goes on after the pause."""
    context = browser.new_context(has_touch=True, viewport={"width": 375, "height": 700})
    page = context.new_page()
    page.goto(place(animation()))
    page.get_by_role("button", name="Play").tap()
    page.wait_for_function("document.querySelector('input').value == 2")
    page.get_by_role("button", name="Pause").tap()
    shown = page.locator("input").input_value()
    page.wait_for_timeout(400)
    assert page.locator("input").input_value() == shown
    context.close()


@pytest.mark.parametrize(("motion", "plays"), [("no-preference", True), ("reduce", False)])
def test_the_front_page_moves_unless_the_reader_asked_for_rest(browser, place, motion, plays):
    """Somebody who gets dizzy has said so, and it moves."""
    context = browser.new_context(reduced_motion=motion)
    page = context.new_page()
    page.goto(place(animation("data-autoplay")))
    page.get_by_role("button", name="Pause" if plays else "Play").wait_for()
    page.wait_for_timeout(300)
    assert page.locator("canvas").count() == plays
    context.close()


def test_a_browser_that_decodes_no_frames_shows_the_file(page, place):
    """In an older browser the button does nothing."""
    page.add_init_script("delete window.ImageDecoder")
    page.goto(place(animation()))
    assert page.get_by_role("slider").count() == 0
    page.get_by_role("button", name="Play").click()
    assert page.locator("img").get_attribute("src") == "film.png"
    page.get_by_role("button", name="Pause").click()
    assert page.locator("img").get_attribute("src").endswith("still.png")


def test_quick_pauses_do_not_make_it_faster(page, place):
    """Each pause and play adds a timer, and after three the film runs four times as fast."""
    page.add_init_script("""window.draws = 0;
      const draw = CanvasRenderingContext2D.prototype.drawImage;
      CanvasRenderingContext2D.prototype.drawImage = function (...all) {
        window.draws += 1;
        return draw.apply(this, all);
      };""")
    page.goto(place(animation()))
    page.get_by_role("button", name="Play").click()
    page.wait_for_selector("canvas")
    page.evaluate("for (let k = 0; k < 6; k += 1) document.querySelector('button').click()")
    page.wait_for_timeout(50)
    page.evaluate("window.draws = 0")
    page.wait_for_timeout(1200)  # ten frames of 120 ms
    assert 3 <= page.evaluate("window.draws") <= 12


def test_a_drag_fetches_the_film_once_and_shows_its_place(page, place):
    """Each step of the first drag fetches the film; its middle shows the end."""
    asked = []
    page.on("request", lambda request: asked.append(request.url.rpartition("/")[2]))
    page.goto(place(animation()))
    page.get_by_role("slider").wait_for()
    page.evaluate("""for (const value of [10, 30, 50]) {
      const slider = document.querySelector("input");
      slider.value = value;
      slider.dispatchEvent(new Event("input"));
    }""")
    page.wait_for_function("document.querySelector('input').value == 1")
    assert page.evaluate(SHADE) == FRAMES[1][0, 0].tolist()
    assert asked.count("film.png") == 1


def test_a_film_that_is_not_there_can_be_asked_for_again(browser, place, tmp_path):
    """The button says Pause for ever, and nothing moves."""
    page = browser.new_page()
    wrong = []
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.goto(place(animation()))
    (tmp_path / "film.png").rename(tmp_path / "away.png")
    page.get_by_role("button", name="Play").click()
    page.wait_for_timeout(300)
    page.get_by_role("button", name="Play").wait_for()
    (tmp_path / "away.png").rename(tmp_path / "film.png")
    page.get_by_role("button", name="Play").click()
    page.wait_for_selector("canvas")
    assert wrong == []
    page.close()


def pair():
    return ('<figure class="before-after">'
            '<img src="first.png" alt="dark" data-label="dark" width="60" height="40">'
            '<img src="last.png" alt="light" data-label="light" width="60" height="40"></figure>')


def test_the_line_between_two_pictures_moves_by_keys(page, place):
    """The line is where the slider is not; or only a mouse moves it."""
    page.goto(place(pair()))
    slider = page.get_by_role("slider", name="From dark to light")
    slider.wait_for()
    line = "getComputedStyle(document.querySelector('.pair')).getPropertyValue('--line')"
    assert page.evaluate(line) == "50%"
    slider.press("End")
    assert page.evaluate(line) == "100%"
    assert slider.get_attribute("aria-valuetext") == "100 % dark"
    assert middle(page) == 10
    slider.press("Home")
    assert middle(page) == 250


def middle(page):
    """The shade in the middle of the pair, as it is seen."""
    shot = Image.open(io.BytesIO(page.locator(".pair").screenshot())).convert("L")
    return shot.getpixel((shot.width // 2, shot.height // 2))


@pytest.mark.parametrize("body", [animation(), pair()])
@pytest.mark.parametrize("width", [375, 1280])
def test_nothing_moves_when_a_player_starts(browser, place, body, width):
    """The text below jumps when the buttons come."""
    context = browser.new_context(viewport={"width": width, "height": 800})
    page = context.new_page()
    page.add_init_script("""window.shift = 0; new PerformanceObserver(list =>
      list.getEntries().forEach(entry => { window.shift += entry.value; })
    ).observe({type: "layout-shift", buffered: true})""")
    page.goto(place(f"{body}<p>Text below.</p>"), wait_until="networkidle")
    page.wait_for_selector("input")
    page.wait_for_timeout(200)
    assert page.evaluate("window.shift") == 0
    context.close()


@pytest.mark.parametrize(("body", "pictures"), [(animation(), 1), (pair(), 2)])
def test_without_scripts_the_pictures_stand_there(browser, place, body, pictures):
    """A reader without scripts sees an empty box, or half of a pair."""
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(place(body))
    assert page.locator("img:visible").count() == pictures
    assert page.locator("input").count() == 0
    context.close()


def test_from_disk_both_pictures_of_a_pair_stand_there(browser, place, tmp_path):
    """Browsers start no modules from files: the second picture waits for a script for ever."""
    place(pair() + '<script src="static/scrolling.js"></script>')
    page = browser.new_page()
    page.goto((tmp_path / "page.html").as_uri())
    assert page.locator("img:visible").count() == 2
    page.close()
