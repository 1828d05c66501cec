"""The site that was made. What makes it can be imported."""
import functools
import sys
from pathlib import Path

from bs4 import BeautifulSoup

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "site"))
SITE = ROOT / "out" / "site"
PAGES = sorted(path.relative_to(SITE).as_posix() for path in SITE.rglob("*.html"))


@functools.cache
def soup(page):
    """A page of the site, taken apart."""
    return BeautifulSoup((SITE / page).read_text("utf-8"), "html.parser")
