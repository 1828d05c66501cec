"""The stills of the lectures' figures, for who reads a notebook, or a page on paper.

    python3 -m course site --stills    makes the site, and of its figures notebooks/stills/

Chromium opens the site that was made, and takes each figure as it is before anybody touches it, so
that no guess is answered. What says little then is played first. Of a film of a mesh that turns
four frames stand side by side.
"""
import contextlib
import io
import re
import shutil
import sys

import numpy as np
from pages import put, served
from pages.turntables import TURNED
from PIL import Image, ImageOps, ImageSequence
from playwright.sync_api import sync_playwright

from labkit.places import ROOT

BROWSERS = "chromium", "chromium-browser", "google-chrome", "chrome"
FOLDER = ROOT / "notebooks" / "stills"
PLACE = re.compile(r'id="figure-([a-z]\w*)"')
PLAYED = {"descent": 60, "sign_grid": 60}  # how many frames of it
PLAY = """async (button, frames) => { button.click();
  while (frames--) await new Promise(requestAnimationFrame); button.click(); }"""


def write(site):
    """Write the stills of a site's figures."""
    with chromium() as browser, served(site) as address:
        page = browser.new_page(device_scale_factor=2, reduced_motion="reduce")
        for path in site.glob("lectures/*.html"):
            for name in PLACE.findall(path.read_text("utf-8")):
                page.goto(f"{address}/lectures/{path.name}")
                still = turning(site, name) if name in TURNED else taken(page, name)
                put(FOLDER / f"{name}.webp", packed(still))


@contextlib.contextmanager
def chromium():
    """-> headless Chromium. SystemExit: there is none."""
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if not found:
        sys.exit(f"course: no browser: install one of {', '.join(BROWSERS)}")
    with sync_playwright() as playwright:
        yield playwright.chromium.launch(executable_path=found, args=["--no-sandbox"])


def taken(page, name):
    """The picture of a figure on the open page, without the white below it."""
    pane = page.locator(f"#figure-{name} .pane")
    pane.scroll_into_view_if_needed()
    if name in PLAYED:
        pane.get_by_role("button", name="Play").evaluate(PLAY, PLAYED[name])
    page.evaluate("new Promise(requestAnimationFrame)")
    picture = Image.open(io.BytesIO(pane.screenshot())).convert("RGB")
    return picture.crop((0, 0, picture.width, ImageOps.invert(picture).getbbox()[3]))


def turning(site, name):
    """Four frames of a film side by side, its first and its last, with which its file begins."""
    with Image.open(site / "turns" / f"{name}.webp") as film:
        frames = [frame.convert("RGB") for frame in ImageSequence.Iterator(film)]
    return Image.fromarray(np.hstack(frames[1::len(frames) // 3] + frames[:1]))


def packed(picture):
    """The bytes of a WebP: of a drawing in 64 colours without loss, of shades with little loss,
    whichever are fewer.
    """
    drawing, shades = io.BytesIO(), io.BytesIO()
    picture.quantize(64).convert("RGB").save(drawing, "WEBP", lossless=True)
    picture.save(shades, "WEBP", quality=60)
    return min(drawing.getvalue(), shades.getvalue(), key=len)
