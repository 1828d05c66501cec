"""How a test reads a figure: its page, its numbers, the places of its handles."""
import re

from serving import ROOT

SOURCE = ROOT / "site" / "static" / "figures"
MINUS = "\N{MINUS SIGN}"
NAMES = sorted(path.stem for path in SOURCE.glob("*.js")
               if "export function show(" in path.read_text(encoding="utf-8"))


def opened(page, address, name):
    page.goto(f"{address}/{name}.html")
    page.wait_for_selector(".pane")
    return page


def settled(page):
    """What was done is drawn: it is, in the next animation frame."""
    page.evaluate("new Promise(requestAnimationFrame)")
    return page


def number(text):
    text = text.replace(MINUS, "-")
    return float(text) if re.fullmatch(r"-?\d+(\.\d+)?", text) else text


def point_of(handle):
    """Where a handle says that it is."""
    return [number(t) for t in re.findall(rf"{MINUS}?[\d.]+",
                                          handle.get_attribute("aria-valuetext"))]


def middle(locator):
    box = locator.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
