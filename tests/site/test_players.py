"""Players: animations, and pairs of pictures, by mouse and by keys."""
import io
import shutil

import numpy as np
import pytest
from pages import comparisons, lectures, poster
from PIL import Image
from serving import ROOT, served

# As in a file of the course, the film's end stands first.
FRAMES = [np.full((40, 60, 3), shade, np.uint8) for shade in (10, 90, 250)]
HEAD = ('<!doctype html><html lang="en"><title>t</title><link rel="icon" href="data:,">'
        '<link rel="stylesheet" href="static/players/players.css">'
        '<script type="module" src="static/players/begin.js"></script>')
COUNT_DRAWS = """window.draws = 0;
const draw = CanvasRenderingContext2D.prototype.drawImage;
CanvasRenderingContext2D.prototype.drawImage = function (...all) {
  window.draws += 1;
  return draw.apply(this, all);
};"""
SHADE = """() => {
  const canvas = document.querySelector("canvas");
  return [...canvas.getContext("2d").getImageData(5, 5, 1, 1).data].slice(0, 3);
}"""


def film(path, duration=120):
    """Write an animation of three grey frames, each of so many milliseconds."""
    first, *others = map(Image.fromarray, FRAMES)
    first.save(path, save_all=True, append_images=others, duration=duration)


@pytest.fixture
def place(tmp_path):
    """A folder with an animation, its still and the players -> a function that serves a page."""
    film(tmp_path / "film.png")
    (tmp_path / "still.png").write_bytes(poster(Image.open(tmp_path / "film.png")))
    Image.fromarray(FRAMES[0]).save(tmp_path / "first.png")
    Image.fromarray(FRAMES[-1]).save(tmp_path / "last.png")
    shutil.copytree(ROOT / "site" / "static", tmp_path / "static")

    def written(body):
        (tmp_path / "page.html").write_text(HEAD + body, encoding="utf-8")
        return f"{address}/page.html"

    with served(tmp_path) as address:
        yield written


def animation(more=""):
    return (f'<figure class="animation" data-file="film.png" data-frames="3" {more}>'
            '<img src="still.png" alt="grey" width="60" height="40"></figure>')


def test_the_still_is_the_first_frame(place, tmp_path):
    """A film's file begins with what it comes to, so its last frame is the one before the end."""
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
    """At rest the end is shown, and the slider stands at the beginning; or it is one frame off."""
    page.goto(place(animation()))
    slider = page.get_by_role("slider")
    slider.wait_for()
    assert slider.input_value() == "2"
    assert slider.get_attribute("aria-valuetext") == "3 of 3"
    slider.press("ArrowLeft")
    page.wait_for_selector("canvas")
    assert slider.get_attribute("aria-valuetext") == "2 of 3"
    slider.press(key)
    page.wait_for_function("n => document.querySelector('input').value == n", arg=frame)
    assert page.evaluate(SHADE) == FRAMES[(frame + 1) % 3][0, 0].tolist()
    assert slider.get_attribute("aria-valuetext") == f"{frame + 1} of 3"


def test_it_plays_by_a_finger_and_stops(browser, place):
    """It answers to a mouse alone; or it goes on after the pause."""
    context = browser.new_context(has_touch=True, viewport={"width": 375, "height": 700})
    page = context.new_page()
    page.goto(place(animation()))
    page.get_by_role("button", name="Play").tap()
    page.wait_for_function("document.querySelector('input').value == 1")
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
    if plays:
        page.wait_for_selector("canvas")
    else:
        page.wait_for_timeout(300)
        assert page.locator("canvas").count() == 0
    context.close()


def test_a_browser_that_decodes_no_frames_shows_the_file(page, place):
    """In an older browser the button does nothing."""
    page.add_init_script("delete window.ImageDecoder")
    page.goto(place(animation()))
    assert page.get_by_role("slider").count() == 0
    page.get_by_role("button", name="Play").click()
    assert page.locator("img").get_attribute("src") == "film.png"
    page.wait_for_function("document.querySelector('img').complete")
    page.get_by_role("button", name="Pause").click()
    assert page.locator("img").get_attribute("src").endswith("still.png")


def test_quick_pauses_do_not_make_it_faster(page, place):
    """Each pause and play adds a timer, and after three the film runs four times as fast."""
    page.add_init_script(COUNT_DRAWS)
    page.clock.install(time=0)
    page.goto(place(animation()))
    page.get_by_role("button", name="Play").click()
    page.wait_for_selector("canvas")
    page.clock.pause_at(3_600_000)
    page.evaluate("for (let k = 0; k < 6; k += 1) document.querySelector('button').click()")
    page.evaluate("window.draws = 0")
    page.clock.run_for(1200)  # ten frames of 120 ms
    assert 8 <= page.evaluate("window.draws") <= 11


def test_play_goes_on_at_once(page, place, tmp_path):
    """The end stays for seconds: the reader has pressed the button, and nothing moves."""
    film(tmp_path / "film.png", duration=60_000)
    page.goto(place(animation()))
    page.get_by_role("button", name="Play").click()
    page.wait_for_selector("canvas")
    assert page.evaluate(SHADE) == FRAMES[1][0, 0].tolist()


def test_it_rests_while_it_is_out_of_sight(page, place):
    """A film that was scrolled away warms the reader's lap for an hour; or it never comes back."""
    page.add_init_script(COUNT_DRAWS)
    page.goto(place(animation("data-autoplay") + '<p style="height: 5000px">Text.</p>'))
    page.wait_for_function("window.draws > 3")
    page.evaluate("""new Promise(done => {
      scrollTo(0, 3000);
      new IntersectionObserver(([{ isIntersecting }]) => isIntersecting || setTimeout(done, 200))
        .observe(document.querySelector("figure"));
    })""")
    drawn = page.evaluate("window.draws")
    page.wait_for_timeout(500)
    assert page.evaluate("window.draws") == drawn
    page.evaluate("scrollTo(0, 0)")
    page.wait_for_function("drawn => window.draws > drawn + 3", arg=drawn)


def test_a_drag_fetches_the_film_once_and_shows_its_place(page, place):
    """Each step of the first drag fetches the film; its middle shows another place."""
    asked = []
    page.on("request", lambda request: asked.append(request.url.rpartition("/")[2]))
    page.goto(place(animation()))
    slider = page.get_by_role("slider")
    slider.wait_for()
    page.evaluate("""for (const share of [0.1, 0.9, 0.5]) {
      const slider = document.querySelector("input");
      slider.value = share * slider.max;
      slider.dispatchEvent(new Event("input"));
    }""")
    assert slider.input_value() == "1"
    page.wait_for_selector("canvas")
    assert page.evaluate(SHADE) == FRAMES[2][0, 0].tolist()
    assert asked.count("film.png") == 1


@pytest.mark.parametrize("browsers", ["", "delete window.ImageDecoder"])
def test_a_film_that_is_not_there_is_told_and_asked_for_again(browser, place, tmp_path, browsers):
    """The button says Pause for ever, and nothing moves; or it stops without a word."""
    page, wrong = browser.new_page(), []
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.add_init_script(browsers)
    page.goto(place(animation()))
    (tmp_path / "film.png").rename(tmp_path / "away.png")
    page.get_by_role("button", name="Play").click()
    page.get_by_text("The film did not load. Press play to try again.").wait_for()
    assert page.locator("img").evaluate("still => still.src.endsWith('still.png')")
    assert page.get_by_role("slider").count() == 0
    (tmp_path / "away.png").rename(tmp_path / "film.png")
    page.get_by_role("button", name="Play").click()
    page.wait_for_selector("img[src='film.png']" if browsers else "canvas")
    assert not page.get_by_text("did not load").count()
    assert wrong == []
    page.close()


@pytest.mark.parametrize(("name", "shapes"), [("Play", 1), ("Pause", 2)])
def test_a_sign_is_drawn_and_not_written(page, place, name, shapes):
    """A font has no sign for a pause, and an empty box stands there."""
    page.goto(place(animation()))
    button = page.get_by_role("button")
    if name == "Pause":
        button.click()
    assert button.inner_text() == ""
    shot = Image.open(io.BytesIO(page.get_by_role("button", name=name).screenshot())).convert("L")
    row = np.asarray(shot)[shot.height // 2, 4:-4] < 128
    assert np.sum(np.diff(row.astype(int)) == 1) == shapes


def test_a_lectures_film_says_how_many_frames_it_has(place, tmp_path):
    """The slider's end is not the film's."""
    content = (tmp_path / "film.png").read_bytes()
    shown = lectures.Pictures("02_rasterization", tmp_path).shown(content, "grey", 60)
    assert 'data-file="pictures/02_00.png" data-frames="3"' in shown


def pair():
    return ('<figure class="before-after">'
            '<img src="first.png" alt="dark" data-label="dark" width="60" height="40">'
            '<img src="last.png" alt="light" data-label="light" width="60" height="40"></figure>')


def test_the_line_between_two_pictures_moves_by_keys(page, place):
    """The line is where the slider is not; or only a mouse moves it."""
    page.goto(place(pair()))
    slider = page.get_by_role("slider", name="From dark to light")
    slider.wait_for()
    assert line(page) == 50
    slider.press("End")
    assert line(page) == 100
    assert slider.get_attribute("aria-valuetext") == "100 % dark"
    assert middle(page) == 10
    slider.press("Home")
    assert middle(page) == 250


def test_the_line_is_dragged_anywhere_on_the_picture(page, place):
    """Only a slider at the picture's foot moves it; or a click ends somewhere else."""
    page.goto(place(pair()))
    page.get_by_role("slider").wait_for()
    box = page.locator(".pair").bounding_box()
    y = box["y"] + box["height"] / 4
    page.mouse.move(box["x"] + box["width"] / 2, y)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.7 * box["width"], y, steps=3)
    assert line(page) == pytest.approx(70, abs=0.5)
    page.mouse.move(box["x"] + 0.2 * box["width"], y, steps=3)
    page.mouse.up()
    page.mouse.move(box["x"] + 0.9 * box["width"], y)
    assert line(page) == pytest.approx(20, abs=0.5)
    page.mouse.click(box["x"] + 0.8 * box["width"], y)
    assert line(page) == pytest.approx(80, abs=0.5)
    page.keyboard.press("Home")
    assert line(page) == 0


def test_a_finger_moves_the_line_sideways_and_the_page_up(browser, place):
    """The picture holds a reader who scrolls past; or the line answers to a mouse alone."""
    context = browser.new_context(has_touch=True, viewport={"width": 375, "height": 600})
    page = context.new_page()
    page.goto(place(pair() + '<p style="height: 2000px">Text.</p>'))
    page.get_by_role("slider").wait_for()
    client, box = context.new_cdp_session(page), page.locator(".pair").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 4

    def swipe(right, down):
        for kind, share in ("touchStart", 0), ("touchMove", 0.3), ("touchMove", 1):
            point = {"x": x + share * right, "y": y + share * down}
            client.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [point]})
        client.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})

    swipe(-0.25 * box["width"], 5)
    page.wait_for_function("document.querySelector('input').value < 50")
    assert line(page) == pytest.approx(25, abs=1)
    assert page.evaluate("scrollY") == 0
    swipe(4, -60)
    page.wait_for_function("scrollY > 0 && document.querySelector('input').value < 27")
    context.close()


def line(page):
    """Where the line is, in percent of the pair's width."""
    value = "getComputedStyle(document.querySelector('.pair')).getPropertyValue('--line')"
    return float(page.evaluate(value).removesuffix("%"))


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


def test_the_samples_of_a_pixel_can_be_seen(tmp_path):
    """Two bunnies with outlines a pixel wide: the line moves, and nothing seems to change."""
    comparisons.write(tmp_path / "extra")
    one, many = (np.asarray(Image.open(tmp_path / "extra" / "pairs" / f"samples_{name}.png"))
                 for name in ("1x", "16x"))
    assert one.shape == many.shape == (512, 512, 3)
    assert np.mean(np.abs(one.astype(int) - many).max(2) > 30) > 0.01
    assert np.array_equal(one, one[4::8, 4::8].repeat(8, 0).repeat(8, 1))
