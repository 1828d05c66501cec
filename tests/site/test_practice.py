"""Exercises, done on their pages by a student in Chromium, with a real Pyodide.

PYODIDE=FOLDER takes one that is there, with NumPy and SciPy. Without it, and where its CDN cannot
be reached, these tests are skipped.
"""
import ast
import contextlib
import csv
import json
import os
import urllib.request
import zipfile
from pathlib import Path

import pytest
from checks import barriers
from pages.practice import CDN
from playwright.sync_api import expect

from labkit import exercises

FOLDER = os.environ.get("PYODIDE")
LAB_1, LAB_2 = "labs/01_transforms.html", "labs/02_rasterization.html"
SOON = 120_000  # ms, on a busy machine
MOST_OFF = """(draws) => {
  const canvas = draws.querySelector("canvas"), pen = canvas.getContext("2d");
  pen.globalCompositeOperation = "difference";  // alpha stays 255
  pen.drawImage(draws.querySelector("img"), 0, 0);
  const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
  return data.reduce((most, byte, k) => k % 4 < 3 ? Math.max(most, byte) : most, 0);
}"""


def answer(name):
    """The reference's function of this name in lab 1 or 2."""
    texts = map(exercises.read, map(exercises.reference, ("transforms", "rasterization")))
    return next(ast.get_source_segment(text, node) for text in texts
                for node in exercises.top_level_functions(text) if node.name == name)


@pytest.fixture(scope="module")
def desks(browser):
    """desks(**options): a context, as of a new reader, in which Python comes from the folder."""
    if not FOLDER:
        try:
            urllib.request.urlopen(f"{CDN}pyodide.mjs", timeout=10).close()
        except OSError:
            pytest.skip("no Pyodide: set PYODIDE to a folder that has version 0.27.7")
    with contextlib.ExitStack() as opened:
        def new(**options):
            desk = opened.enter_context(contextlib.closing(browser.new_context(**options)))
            if FOLDER:
                desk.route(f"{CDN}**", from_folder)
            return desk

        yield new


def from_folder(route):
    """Answer a request to Pyodide's CDN."""
    file = Path(FOLDER) / route.request.url.rpartition("/")[2]
    kind = {".wasm": "application/wasm"}.get(file.suffix, "text/javascript")
    route.fulfill(path=file, content_type=kind, headers={"Access-Control-Allow-Origin": "*"})


@pytest.fixture(scope="module")
def desk(desks):
    """The desk of a student who goes on from test to test."""
    return desks(accept_downloads=True)


def place(page, name, address=None):
    """The exercise of this name on an open page, or on the page at an address."""
    if address:
        page.goto(address)
    found = page.locator(f'.practice[data-name="{name}"]')
    found.scroll_into_view_if_needed()
    found.locator(".cm-content").wait_for()
    return found


def write(found, text):
    found.locator(".cm-content").click()
    found.page.keyboard.press("Control+a")
    found.page.keyboard.insert_text(text)


def checked(found, verdict):
    """Check an exercise by keys, and expect its verdict -> the report."""
    found.locator(".cm-content").press("Control+Enter")
    expect(found.locator("output")).to_have_text(verdict, timeout=SOON)
    expect(found.locator(".stop")).to_be_hidden(timeout=SOON)
    return found.locator(".report").inner_text()


def test_from_the_front_page_to_an_exercise_that_is_right(desk, address):
    """The door leads to a page that only speaks of exercises; or a reload forgets that the
    exercise is right, or says so of another text.
    """
    page = desk.new_page()
    page.goto(address)
    page.get_by_role("link", name="Do an exercise").click()
    first = place(page, "transform")
    assert "not started" in checked(first, "not started")
    write(first, answer("transform"))
    assert checked(first, "done") == ""
    assert "drawn" in first.locator(".draws").get_attribute("class")
    page.reload()
    first = place(page, "transform")
    expect(first.locator("output")).to_have_text("done when last checked")
    row = page.locator(".overview tr", has_text="transform").first
    expect(row).to_have_attribute("data-verdict", "done")
    write(first, f"{answer('transform')}  # changed")
    expect(first.locator("output")).to_have_text("done before it was changed", timeout=SOON)
    expect(row).to_have_attribute("data-verdict", "")
    write(first, answer("transform"))


def test_a_later_labs_picture_is_drawn_by_the_readers_labs(desks, address):
    """Exercises after lab 5 have no picture, or it is the reference's whatever the reader wrote; or
    the numbers of a check do not come when it reads them.
    """
    page = desks().new_page()
    for topic in "transforms", "rasterization", "interpolation", "vertex_gradients":
        text = json.dumps(exercises.read(exercises.reference(topic)))
        page.add_init_script(f"localStorage['course: labs/{topic}.py'] ??= {text}")
    checked(place(page, "interpolate", f"{address}/labs/05_interpolation.html"), "done")
    found = place(page, "fit_step", f"{address}/labs/07_vertex_gradients.html")
    checked(found, "done")
    expect(found.locator(".yours figcaption")).to_have_text("yours")
    assert found.locator(".draws").evaluate(MOST_OFF) <= 1
    for line, fault in ("1 / 0", "ZeroDivisionError: division by zero"), (
            "raise SystemExit(3)", "SystemExit: 3"):
        write(found, f"def fit_step(*given):\n    {line}")
        checked(found, "failing")
        expect(found.locator(".yours figcaption")).to_have_text(fault)


def test_a_wrong_answer_is_told_what_is_wrong(desk, address):
    """The check is not the course's own, or its report speaks of a terminal; or it names an
    exercise that is to be done first, and does not lead there.
    """
    found = place(desk.new_page(), "edge_function", f"{address}/{LAB_2}")
    write(found, "def edge_function(p, a, b):\n return ((b-a)[..., ::-1]*[-1, 1]*(p-a)).sum(-1)")
    report = checked(found, "done, fine print open")
    assert "(2000, 2)" in report and "npz" not in report
    wrong = answer("edge_function").replace("return ", "return -")
    write(found, wrong)
    report = checked(found, "failing")
    assert "sign" in report and "expected" in report
    assert "again     Check, or Ctrl+Enter" in report and "python3" not in report
    write(found, answer("edge_function"))
    checked(found, "done")
    waiting = place(found.page, "cover")
    write(waiting, answer("cover"))
    checked(waiting, "blocked by 2.3")
    link = waiting.locator(".report a", has_text="2.3").first
    expect(link).to_have_attribute("href", "02_rasterization.html#exercise-2-3")


def test_a_loop_without_an_end_is_stopped_and_nothing_is_lost(desk, address):
    """The page hangs, or a stop or a reload takes what was written; or a check that takes long is
    taken for Python that does not come.
    """
    page = desk.new_page()
    page.clock.install()
    found = place(page, "is_top_left", f"{address}/{LAB_2}")
    checked(found, "not started")  # Python is there
    write(found, "def is_top_left(n_x, n_y):\n    while True:\n        pass")
    found.locator(".check").click()
    expect(found.locator("output")).to_have_text("checking", timeout=SOON)
    page.clock.fast_forward(600_000)
    page.wait_for_timeout(3000)
    expect(found.locator("output")).to_have_text("checking")
    found.locator(".stop").click()
    expect(found.locator("output")).to_have_text("stopped")
    page.reload()
    assert "while True" in place(page, "is_top_left").inner_text()
    write(found, answer("is_top_left"))
    checked(found, "done")
    write(place(page, "cover"), answer("cover"))
    checked(found, "done")  # the reader's own edge_function and is_top_left are called


def test_a_second_tab_shows_what_the_first_one_writes(desk, address):
    """The tab that was left behind saves over it."""
    first, second = desk.new_page(), desk.new_page()
    for page in first, second:
        place(page, "screen_weights", f"{address}/{LAB_2}")
    write(place(first, "screen_weights"), "def screen_weights(p, triangle):\n    return 1234")
    second.bring_to_front()
    expect(place(second, "screen_weights")).to_contain_text("1234")
    write(place(second, "bounding_box"), "def bounding_box(triangle, width, height):\n    return 5")
    first.reload()
    expect(place(first, "screen_weights")).to_contain_text("1234")
    expect(place(first, "bounding_box")).to_contain_text("return 5")


def test_the_zip_is_graded_and_can_be_put_in_again(desk, desks, address, tmp_path, run_module):
    """It is not what `pack` makes: points are lost, or work cannot be taken to another computer."""
    page = desk.new_page()
    page.goto(f"{address}/{LAB_1}")
    with page.expect_download(timeout=SOON) as coming:
        page.locator(".my-work .zip").click()
    file = tmp_path / "submissions" / "ada.zip"
    coming.value.save_as(file)
    with zipfile.ZipFile(file) as packed:
        assert "labs/transforms.py" in packed.namelist()
    root = Path(__file__).parents[2]
    run_module(root, "course", "grade", str(file.parent), "--out", str(tmp_path / "out"),
               "--labs", "1-2", "--isolation", "process", "--jobs", "1")
    with (tmp_path / "out" / "grades.csv").open(encoding="utf-8") as table:
        row, = csv.DictReader(table)
    marks = {title.split()[-1]: points for title, points in row.items()}
    assert [marks[name] for name in ("transform", "cover", "bounding_box")] == ["1", "6", "0"]

    other = desks().new_page()
    place(other, "cover", f"{address}/{LAB_2}")
    other.locator(".my-work input").set_input_files(file)
    expect(other.locator(".my-work output")).to_contain_text("yours again", timeout=SOON)
    expect(place(other, "bounding_box")).to_contain_text("return 5")


@pytest.mark.parametrize("says", ["this computer is offline", "too old", "no memory", "offline"])
def test_where_python_does_not_come_a_sentence_says_so(says, desks, address):
    """The page waits for ever, as when nearly all has come, or shows a line of JavaScript."""
    page = desks().new_page()
    if says == "too old":
        page.add_init_script("delete window.Worker")
    elif says == "no memory":
        page.route("**/practice/worker.js", lambda route: route.fulfill(
            body="throw new RangeError('out of memory')", content_type="text/javascript"))
    elif says == "offline":
        page.clock.install()
        page.route("**/course.tar.bz2", lambda route: None)  # the last tenth
    else:
        page.context.route(f"{CDN}**", lambda route: route.abort())
    found = place(page, "transform", f"{address}/{LAB_1}")
    found.locator(".check").click()
    if says == "offline":
        expect(found.locator("output")).to_contain_text("comes: 15.", timeout=SOON)
        page.clock.fast_forward(46_000)
    expect(found.locator(".report")).to_contain_text(says, timeout=60_000)
    assert "python3 -m course check 1.1" in found.locator(".report").inner_text()


def test_where_nothing_is_kept_the_page_says_so(desks, address):
    """A private window loses the work of an hour without a word."""
    page = desks().new_page()
    page.add_init_script("Storage.prototype.setItem = () => { throw new Error('refused'); }")
    found = place(page, "transform", f"{address}/{LAB_1}")
    write(found, answer("transform"))
    expect(found.locator("output")).to_contain_text("keeps nothing")


def test_on_a_phone_and_by_keys(desks, address):
    """The report makes the page wide; or Tab never leaves the editor; or a label is missing."""
    page = desks(viewport={"width": 375, "height": 700}).new_page()
    found = place(page, "transform", f"{address}/{LAB_1}")
    write(found, answer("transform").replace("return ", "return 2 * "))
    checked(found, "failing")
    assert page.evaluate("document.documentElement.scrollWidth") <= 375
    found.locator(".cm-content").press("Escape")
    page.keyboard.press("Shift+Tab")
    expect(found.locator(".check")).to_be_focused()
    assert barriers(page, {"include": [[".practice"]]}) == []
