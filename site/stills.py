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
from urllib.parse import urlsplit

import numpy as np
from pages import put
from pages.turntables import TURNED
from PIL import Image, ImageOps
from playwright.sync_api import sync_playwright

from labkit.places import ROOT

BROWSERS = "chromium", "chromium-browser", "google-chrome", "chrome"
FOLDER = ROOT / "notebooks" / "stills"
PLACE = re.compile(r'id="figure-([a-z]\w*)"')
VIEW = {"viewport": {"width": 1280, "height": 1400}, "device_scale_factor": 2,
        "color_scheme": "light", "reduced_motion": "reduce"}
PLAYED = {"descent": 60, "sign_grid": 60}  # how many frames of it
PLAY = """async (button, frames) => {
  button.click();
  for (let k = 0; k <= frames; k += 1) await new Promise(requestAnimationFrame);
  button.click();
}"""


def write(site):
    """Write the stills of a site's figures. FileNotFoundError: there is no browser."""
    with chromium() as browser:
        page = browser.new_page(**VIEW)
        page.route("**/*", lambda route: route.fulfill(
            path=site / urlsplit(route.request.url).path.lstrip("/")))
        for name, lecture in places(site).items():
            page.goto(f"http://site/{lecture}")
            still = turning(site, name) if name in TURNED else taken(page, name)
            put(FOLDER / f"{name}.webp", packed(still))


def places(site):
    """{name: the lecture's page} of each figure of a site."""
    return {name: f"lectures/{path.name}" for path in site.glob("lectures/*.html")
            for name in PLACE.findall(path.read_text("utf-8"))}


@contextlib.contextmanager
def chromium():
    """-> headless Chromium. FileNotFoundError: there is none."""
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if not found:
        raise FileNotFoundError(f"no browser: install one of {', '.join(BROWSERS)}")
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
    film = Image.open(site / "turns" / f"{name}.webp")
    frames = []
    for k in *range(1, film.n_frames, film.n_frames // 3), 0:
        film.seek(k)
        frames.append(film.convert("RGB"))
    return Image.fromarray(np.hstack(frames))


def packed(picture):
    """The bytes of a WebP: of a drawing in 64 colours without loss, of shades with little loss,
    whichever are fewer.
    """
    both = io.BytesIO(), io.BytesIO()
    picture.quantize(64, dither=Image.Dither.NONE).convert("RGB").save(both[0], "WEBP",
                                                                      lossless=True)
    picture.save(both[1], "WEBP", quality=60)
    return min((one.getvalue() for one in both), key=len)
