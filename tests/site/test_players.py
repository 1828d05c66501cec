"""The films' player, by mouse and by keys."""
import io
import shutil

import numpy as np
import pytest
from pages import served, webp
from PIL import Image
from serving import PAGES, ROOT, SITE, soup

# As in a file of the course, the film's end stands first.
FRAMES = [np.full((40, 60, 3), shade, np.uint8) for shade in (10, 90, 250)]
HEAD = ('<!doctype html><html lang="en"><title>t</title><link rel="icon" href="data:,">'
        '<link rel="stylesheet" href="static/players/players.css">'
        '<script type="module" src="static/players/animation.js"></script>')
FILM = ('<figure class="animation" data-file="film.webp" data-frames="3"{}>'
        '<img src="film_still.webp" alt="grey" width="60" height="40"></figure>')
COUNT_DRAWS = """window.draws = 0;
const draw = CanvasRenderingContext2D.prototype.drawImage;
CanvasRenderingContext2D.prototype.drawImage = function (...all) {
  window.draws += 1;
  return draw.apply(this, all);
};"""


def film(folder, duration=120):
    """Write a film of three grey frames, each of so many milliseconds, and its still."""
    made, (first, *others) = io.BytesIO(), map(Image.fromarray, FRAMES)
    first.save(made, "PNG", save_all=True, append_images=others, duration=duration)
    webp(folder, "film", Image.open(made))


@pytest.fixture
def place(tmp_path):
    """A folder with a film, its still and the players -> a function that serves a page."""
    film(tmp_path)
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
        assert whole.convert("RGB").tobytes() == still.convert("RGB").tobytes(), figure


def test_a_film_is_fetched_once_when_it_is_asked_for_and_shows_the_sliders_frame(page, place):
    """Ten films are loaded with a lecture that nobody has scrolled; each step of the first drag
    fetches the film; at rest the end is shown, and the slider stands elsewhere.
    """
    asked = []
    page.on("request", lambda request: asked.append(request.url.rpartition("/")[2]))
    page.goto(place(FILM.format("")), wait_until="networkidle")
    assert "film_still.webp" in asked and "film.webp" not in asked
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
    assert asked.count("film.webp") == 1


def test_play_goes_on_at_once_and_quick_pauses_do_not_make_it_faster(page, place, tmp_path):
    """The end stays for as long as its frame lasts; each pause and play adds a timer."""
    film(tmp_path, duration=60_000)
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
    page = new_page(missing="film.webp")
    page.add_init_script(browsers)
    page.goto(place(FILM.format("")))
    (tmp_path / "film.webp").rename(tmp_path / "away.webp")
    page.get_by_role("button", name="Play").click()
    page.get_by_text("The film did not load. Press play to try again.").wait_for()
    assert page.locator("img").evaluate("still => still.src.endsWith('film_still.webp')")
    assert page.get_by_role("slider").count() == 0
    (tmp_path / "away.webp").rename(tmp_path / "film.webp")
    page.get_by_role("button", name="Play").click()
    page.wait_for_selector("img[src='film.webp']" if browsers else "canvas")
    page.get_by_role("button", name="Pause").click()
    assert not page.get_by_text("did not load").count()
