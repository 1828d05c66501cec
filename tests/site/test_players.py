"""Players: films, and pairs of pictures, by mouse, by keys and by fingers."""
import shutil

import numpy as np
import pytest
from checks import moved
from hands import spot, swipe
from pages import poster
from PIL import Image
from playwright.sync_api import expect
from serving import PAGES, ROOT, SITE, served, soup

# As in a file of the course, the film's end stands first.
FRAMES = [np.full((40, 60, 3), shade, np.uint8) for shade in (10, 90, 250)]
HEAD = ('<!doctype html><html lang="en"><title>t</title><link rel="icon" href="data:,">'
        '<link rel="stylesheet" href="static/players/players.css">'
        '<script type="module" src="static/players/begin.js"></script>')
FILM = ('<figure class="animation" data-file="film.png" data-frames="3"{}>'
        '<img src="still.png" alt="grey" width="60" height="40"></figure>')
PAIR = ('<figure class="before-after">'
        '<img src="first.png" alt="dark" data-label="dark" width="60" height="40">'
        '<img src="last.png" alt="light" data-label="light" width="60" height="40"></figure>')
COUNT_DRAWS = """window.draws = 0;
const draw = CanvasRenderingContext2D.prototype.drawImage;
CanvasRenderingContext2D.prototype.drawImage = function (...all) {
  window.draws += 1;
  return draw.apply(this, all);
};"""


def film(path, duration=120):
    """Write a film of three grey frames, each of so many milliseconds."""
    first, *others = map(Image.fromarray, FRAMES)
    first.save(path, save_all=True, append_images=others, duration=duration)


@pytest.fixture
def place(tmp_path):
    """A folder with a film, its still, a pair and the players -> a function that serves a page."""
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


def shade(page):
    """The shade that the film's canvas shows, once there is one."""
    page.wait_for_selector("canvas")
    return page.evaluate("""document.querySelector("canvas").getContext("2d")
        .getImageData(5, 5, 1, 1).data[0]""")


def test_a_films_still_is_its_end_and_its_slider_has_all_its_frames():
    """The picture changes when the film begins, or the slider's end is not the film's."""
    films = [(page, figure) for page in PAGES for figure in soup(page).select(".animation")]
    assert len(films) > 30
    for page, figure in films:
        folder = (SITE / page).parent
        whole, still = Image.open(folder / figure["data-file"]), Image.open(
            folder / figure.img["src"])
        assert int(figure["data-frames"]) == whole.n_frames
        off = np.abs(np.int16(whole.convert("RGB")) - np.int16(still.convert("RGB")))
        assert off.mean() < 4, (page, figure["data-file"])  # a still has 256 colours


def test_a_film_is_fetched_once_when_it_is_asked_for_and_shows_the_sliders_frame(page, place):
    """Ten films are loaded with a lecture that nobody has scrolled; each step of the first drag
    fetches the film; at rest the end is shown, and the slider stands elsewhere.
    """
    asked = []
    page.on("request", lambda request: asked.append(request.url.rpartition("/")[2]))
    page.goto(place(FILM.format("")), wait_until="networkidle")
    assert "still.png" in asked and "film.png" not in asked
    slider = page.get_by_role("slider")
    assert slider.get_attribute("aria-valuetext") == "3 of 3"
    page.evaluate("""for (const share of [0.1, 0.9, 0.5]) {
      const slider = document.querySelector("input");
      slider.value = share * slider.max;
      slider.dispatchEvent(new Event("input"));
    }""")
    assert shade(page) == 250 and slider.get_attribute("aria-valuetext") == "2 of 3"
    for key, words, shown in ("Home", "1 of 3", 90), ("End", "3 of 3", 10):
        slider.press(key)
        page.wait_for_function("n => document.querySelector('input').ariaValueText === n",
                               arg=words)
        assert shade(page) == shown
    assert asked.count("film.png") == 1


def test_play_goes_on_at_once_and_quick_pauses_do_not_make_it_faster(page, place, tmp_path):
    """The end stays for as long as its frame lasts; each pause and play adds a timer."""
    film(tmp_path / "film.png", duration=60_000)
    page.add_init_script(COUNT_DRAWS)
    page.clock.install(time=0)
    page.goto(place(FILM.format("")))
    page.get_by_role("button", name="Play").click()
    assert shade(page) == 90
    page.clock.pause_at(3_600_000)
    page.evaluate("for (let k = 0; k < 6; k += 1) document.querySelector('button').click()")
    page.evaluate("window.draws = 0")
    page.clock.run_for(600_000)  # ten frames
    assert 8 <= page.evaluate("window.draws") <= 11


def test_a_film_on_its_own_rests_out_of_sight_and_where_the_reader_asked_for_rest(new_page, place):
    """A film that was scrolled away warms the reader's lap; or somebody gets dizzy."""
    address = place(FILM.format(" data-autoplay") + '<p style="height: 5000px">Text.</p>')
    page = new_page()
    page.add_init_script(COUNT_DRAWS)
    page.goto(address)
    page.wait_for_function("window.draws > 3")
    page.evaluate("scrollTo(0, 3000)")
    page.wait_for_timeout(500)
    drawn = page.evaluate("window.draws")
    page.wait_for_timeout(500)
    assert page.evaluate("window.draws") == drawn
    page.evaluate("scrollTo(0, 0)")
    page.wait_for_function("drawn => window.draws > drawn + 3", arg=drawn)
    still = new_page(reduced_motion="reduce")
    still.goto(address)
    still.get_by_role("button", name="Play").wait_for()
    assert still.locator("canvas").count() == 0


@pytest.mark.parametrize("browsers", ["", "delete window.ImageDecoder"])
def test_a_film_that_is_not_there_is_told_and_asked_for_again(new_page, place, tmp_path, browsers):
    """The button says Pause for ever, and nothing moves; or it stops without a word. A browser
    that decodes no frames shows the file, which plays."""
    page = new_page(missing="film.png")
    page.add_init_script(browsers)
    page.goto(place(FILM.format("")))
    (tmp_path / "film.png").rename(tmp_path / "away.png")
    page.get_by_role("button", name="Play").click()
    page.get_by_text("The film did not load. Press play to try again.").wait_for()
    assert page.locator("img").evaluate("still => still.src.endsWith('still.png')")
    assert page.get_by_role("slider").count() == 0
    (tmp_path / "away.png").rename(tmp_path / "film.png")
    page.get_by_role("button", name="Play").click()
    page.wait_for_selector("img[src='film.png']" if browsers else "canvas")
    page.get_by_role("button", name="Pause").click()
    assert not page.get_by_text("did not load").count()


def line(page):
    """Where the line of a pair is, in percent of its width."""
    value = "getComputedStyle(document.querySelector('.pair')).getPropertyValue('--line')"
    return float(page.evaluate(value).removesuffix("%"))


def test_the_line_between_two_pictures_moves_by_keys_and_by_the_mouse(page, place):
    """The line is where the slider is not; or only a slider at the picture's foot moves it."""
    page.goto(place(PAIR))
    slider, pictures = page.get_by_role("slider", name="From dark to light"), page.locator(".pair")
    slider.press("End")
    assert line(page) == 100 and slider.get_attribute("aria-valuetext") == "100 % dark"
    page.mouse.move(*spot(pictures, 0.5, 0.25))
    page.mouse.down()
    page.mouse.move(*spot(pictures, 0.2, 0.25), steps=3)
    page.mouse.up()
    page.mouse.move(*spot(pictures, 0.9, 0.25))
    assert line(page) == pytest.approx(20, abs=0.5)
    page.mouse.click(*spot(pictures, 0.8, 0.25))
    assert line(page) == pytest.approx(80, abs=0.5)
    page.keyboard.press("Home")
    assert line(page) == 0


def test_a_finger_moves_the_line_sideways_and_the_page_up(new_page, place):
    """The picture holds a reader who scrolls past; or the line answers to a mouse alone."""
    page = new_page(has_touch=True, viewport={"width": 375, "height": 600})
    page.goto(place(PAIR + '<p style="height: 2000px">Text.</p>'))
    page.get_by_role("slider").wait_for()
    x, y = spot(page.locator(".pair"), 0.5, 0.25)
    swipe(page, ((x, y), (spot(page.locator(".pair"), 0.25)[0], y + 5)))
    page.wait_for_function("document.querySelector('input').value < 50")
    assert line(page) == pytest.approx(25, abs=1)
    assert page.evaluate("scrollY") == 0
    swipe(page, ((x, y), (x + 4, y - 60)))
    page.wait_for_function("scrollY > 0 && document.querySelector('input').value < 27")


@pytest.mark.parametrize("width", [375, 1280])
def test_nothing_moves_when_a_player_starts(new_page, place, width):
    """The text below jumps when the buttons come."""
    page = new_page(viewport={"width": width, "height": 800})
    page.goto(place(f"{FILM.format('')}<p>Between.</p>{PAIR}<p>Below.</p>"),
              wait_until="networkidle")
    expect(page.locator("input")).to_have_count(2)
    assert moved(page) == []


def test_from_disk_both_pictures_of_a_pair_stand_there(browser, place, tmp_path):
    """Browsers start no modules from files: the second picture waits for a script for ever."""
    place(PAIR + '<script src="static/scrolling.js"></script>')
    page = browser.new_page()
    page.goto((tmp_path / "page.html").as_uri())
    assert page.locator("img:visible").count() == 2
    page.close()
