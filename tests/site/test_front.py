"""The front page, and what search engines, chats and lost readers see of the site."""
import os
import re
import subprocess
import sys
import zipfile

import numpy as np
import pytest
from PIL import Image
from serving import PAGES, ROOT, SITE, soup

from reference import tiny

ADDRESS = "https://somebody.github.io/course"


def meta(page, name):
    """What a page's <meta> of this name or property says, or None."""
    found = page.find("meta", {"name": name}) or page.find("meta", {"property": name})
    return found and found["content"]


@pytest.fixture(scope="module")
def index():
    return soup("index.html")


@pytest.fixture(scope="module")
def published(tmp_path_factory):
    """A site of two pages, made for its publisher's address -> its folder."""
    source, target = tmp_path_factory.mktemp("pages"), tmp_path_factory.mktemp("site")
    tree = "```{toctree}\n:caption: Labs\n\nlabs/first\n```\n"
    (source / "index.md").write_text(f"# A course\n\n{'A page of words. ' * 30}\n\n{tree}", "utf-8")
    (source / "labs").mkdir()
    (source / "labs" / "first.md").write_text(
        '# A lab\n\n[A](/index.md) · [list](/index.md) · [of links](/index.md) '
        '· [and more](/index.md)\n\nIt has a "question" that is <b class="x">marked</b>, and 1 < 2 '
        "is true.\n", "utf-8")
    subprocess.run([sys.executable, "-m", "sphinx", "-q", "--fail-on-warning",
                    "-c", ROOT / "site", source, target], check=True,
                   env={**os.environ, "SITE_ADDRESS": ADDRESS})
    return target


def test_the_zip_is_a_course_that_starts(tmp_path, run_module, index):
    """Readers download a folder without its hidden files, its data or its command."""
    link = index.find("a", download=True)
    assert (SITE / link["href"]).stat().st_size < 15e6
    with zipfile.ZipFile(SITE / link["href"]) as file:
        file.extractall(tmp_path)
    course, = tmp_path.iterdir()
    assert "check [TARGET]" in run_module(course, "course").stdout
    checked = run_module(course, "course", "check", "1.1")
    assert "Next: 1.1" in checked.stdout, checked.stdout + checked.stderr


def test_the_page_says_the_commands_and_the_numbers_of_the_readme(index):
    """The README is made anew, and the front page names another count of exercises."""
    readme, said = (ROOT / "README.md").read_text("utf-8"), index.article.get_text(" ", strip=True)
    numbers = re.findall(r"(\d+ exercises, about \d+ hours)", readme)
    commands = re.findall(r"^    (python3 -m course \w+)", readme, re.M)[:2]
    assert len(numbers) == len(commands) == 2
    assert [one for one in (*numbers, *commands) if one not in said] == []


def test_the_star_is_what_the_page_of_code_draws(tmp_path, monkeypatch):
    """The code was changed, and the picture that it is said to draw was not."""
    monkeypatch.chdir(tmp_path)
    tiny.main()
    drawn, shown = Image.open("tiny.ppm"), Image.open(SITE / "_static" / "tiny.png")
    large = shown.resize(drawn.size, Image.Resampling.NEAREST)
    off = np.abs(np.int16(large) - np.int16(drawn))
    # The descent amplifies rounding: another processor gives 0.4 to 0.65, half of the blend's
    # gradient 1.6.
    assert off.mean() < 1


def test_every_page_has_a_description_in_words():
    """A search engine shows code, a row of links, or nothing."""
    said = {page: re.findall('<meta name="description" content="(.*?)"',
                             (SITE / page).read_text("utf-8"))
            for page in PAGES if page not in ("404.html", "genindex.html", "search.html")
            and not page.startswith("_modules/")}
    assert {name: words for name, words in said.items()
            if len(words) != 1 or not re.fullmatch(r"[^\\·]{30,300}", words[0])} == {}


def test_a_chat_shows_the_picture_and_the_first_words(published):
    """A link that was posted shows grey, or a row of links."""
    page = soup(published / "labs" / "first.html")
    assert meta(page, "og:image") == f"{ADDRESS}/still_life.jpg"
    assert (SITE / "still_life.jpg").stat().st_size < 300_000
    assert meta(page, "og:url") == f"{ADDRESS}/labs/first.html"
    words = "It has a “question” that is marked, and 1 < 2 is true."
    assert meta(page, "og:description") == meta(page, "description") == words


def test_a_lost_reader_finds_back_from_any_folder(published):
    """The page for what is not found is served below labs/, and has no style and no way on."""
    page = soup(published / "404.html")
    links = [link.get("href") or link.get("src") for link in page.find_all(["a", "link", "script"])]
    inside = [link for link in links if link and not link.startswith(("http", "#"))]
    assert "/course/index.html" in inside
    assert [link for link in inside if not link.startswith("/course/")] == []
    assert page.h1.text == "Page not found"
    assert [link["href"] for link in page.article.select("p a")] == [
        "/course/search.html", "/course/labs/index.html", "/course/index.html"]
