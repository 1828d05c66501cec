"""How a test reads a figure: its page, its numbers, the places of its handles."""
import re

from serving import ROOT

SOURCE = ROOT / "site" / "static" / "figures"
NAMES = sorted(path.stem for path in SOURCE.glob("*.js")
               if "export function show(" in path.read_text(encoding="utf-8"))


def each(function, *columns):
    """The function's results, a call for each row."""
    return [function(*row) for row in zip(*columns, strict=True)]


def opened(page, address, name):
    page.goto(f"{address}/{name}.html")
    page.wait_for_selector(".pane")
    return page


def settled(page):
    """What was done is drawn: it is, in the next animation frame."""
    page.evaluate("new Promise(requestAnimationFrame)")
    return page


def numbers(text):
    """The numbers in a text of the page."""
    minus = "\N{MINUS SIGN}"
    return [float(found) for found in re.findall(r"-?\d+(?:\.\d+)?", text.replace(minus, "-"))]


def point_of(handle):
    """Where a handle says that it is."""
    return numbers(handle.get_attribute("aria-valuetext"))
