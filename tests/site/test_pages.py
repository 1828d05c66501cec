"""Every page of the web site: its text, and what Chromium makes of it."""
import collections
import functools
import urllib.parse

import pytest
from checks import barriers, moved
from serving import PAGES, SITE, soup

SIX = ("index", "lectures/02_rasterization", "lectures/08_antialiasing", "labs/08_antialiasing",
       "reference/antialiasing", "benchmarks")
ALIKE = "reference/", "given/", "labs/", "_modules/"
LIKE = ("reference/antialiasing.html", "given/mesh.html", "labs/08_antialiasing.html",  # as these
        "_modules/reference/antialiasing.html")
PROSE = {"exclude": [["math"]]}
WEIGHT_LIMIT = 1_500_000  # bytes of a page with all that it loads, before anything is played

# A table or a formula may be painted before its end has come, and moves then: mostly by up to 0.004
# on a busy machine; real_projects' table once by 0.047, which its columns' widths should prevent.
# What waits for a script or has no size moves by more. A page counts as poor at 0.1.
MOST_MOVED = 0.01
ON_FORMULAS = """[...document.querySelectorAll(".eqno")].filter(number => {
  const end = number.previousElementSibling.lastElementChild.getBoundingClientRect().right;
  return number.getBoundingClientRect().left < end - 1;
}).map(number => number.textContent)"""


@functools.cache
def anchors(page):
    return {element["id"] for element in soup(page).find_all(id=True)}


def test_the_site_is_there():
    """The tests below have no page to fail on; or pictures lie there twice."""
    assert len(PAGES) > 80, "make the site first: python3 -m course site"
    assert sum(path.stat().st_size for path in SITE.rglob("*.*")) < 75e6


@pytest.mark.parametrize("page", PAGES)
def test_every_link_leads_somewhere(page):
    """A page or a heading was renamed, and a reader ends at nothing."""
    dead = []
    for link in soup(page).find_all(["a", "link"], href=True):
        address = urllib.parse.urlsplit(link["href"])
        if address.scheme:
            continue
        path = urllib.parse.unquote(address.path)
        folder = SITE if path.startswith("/") else (SITE / page).parent  # the page of error 404
        target = folder / path.lstrip("/") if path else SITE / page
        if not target.resolve().is_file():
            dead.append(link["href"])
        elif address.fragment and target.suffix == ".html":
            name = target.resolve().relative_to(SITE).as_posix()
            if urllib.parse.unquote(address.fragment) not in anchors(name):
                dead.append(link["href"])
    assert dead == []


@pytest.mark.parametrize("page", PAGES)
def test_a_page_is_sound(page):
    """A picture that is not described, or a name given twice."""
    dumb = [picture["src"] for picture in soup(page).find_all("img") if not picture.get("alt")]
    sizes = [picture["src"] for picture in soup(page).find_all("img")
             if not (picture.get("width") and picture.get("height"))]
    names = collections.Counter(element["id"] for element in soup(page).find_all(id=True))
    assert dumb == []
    assert sizes == []
    assert [name for name, count in names.items() if count > 1] == []
    assert len(soup(page).find_all("h1")) == 1


@pytest.mark.parametrize("name", PAGES)
def test_a_page_opens_without_a_fault(name, new_page, address):
    """An error of a script, a missing file, another host, a barrier for somebody. Or one wide
    formula, and on a phone every line of the page is cut, or its number stands on it.
    """
    page, weight = new_page(viewport={"width": 1280, "height": 900}), {}
    page.on("response", lambda loaded: weight.update({loaded.url: len(loaded.body())}))
    page.goto(f"{address}/{name}", wait_until="networkidle")
    shifts = moved(page)
    assert sum(by for by, _ in shifts) < MOST_MOVED, shifts
    assert sum(weight.values()) < WEIGHT_LIMIT, weight
    if name in LIKE or not name.startswith(ALIKE):
        rules = {"color-contrast": {"enabled": False}}
        assert barriers(page, PROSE, rules=rules) == []
    for width in 1366, 1100, 375:
        page.set_viewport_size({"width": width, "height": 900})
        assert page.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0, width
        assert page.evaluate(ON_FORMULAS) == [], width


@pytest.mark.parametrize("name", SIX)
def test_everything_can_be_read(name, page, address):
    """Grey on black, or a comment's grey on the grey of code."""
    page.goto(f"{address}/{name}.html", wait_until="networkidle")
    for theme in "light", "dark":
        page.emulate_media(color_scheme=theme)
        page.evaluate("Promise.allSettled(document.getAnimations().map(one => one.finished))")
        assert barriers(page, PROSE, runOnly=["color-contrast"]) == [], theme
