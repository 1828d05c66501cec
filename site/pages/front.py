"""The front page: its words are in front.md, its numbers in README.md, its pictures in lectures."""
import io
import os
import re
import subprocess
import zipfile
from pathlib import Path

import nbformat
from PIL import Image, ImageOps

from course.given.mesh import DATA
from labkit import exercises
from labkit.places import ROOT

from . import put, webp
from .names import exercise_pages
from .sidebar import trees
from .sources_course import read

STILL_LIFE = "course/given/data/still_life.png"
SIZE = 920, 690  # of a picture of the gallery, which is shown half as wide
GALLERY = {  # lecture: the file, and the part of it that is shown
    "01_transforms": ("notebooks/openings/01_transforms.png", (245, 56, 1661, 1078)),
    "06b_cube_maps": ("notebooks/openings/06b_cube_maps.png", (1020, 160, 1880, 805)),
    "14_shadow_mapping": (STILL_LIFE, (175, 0, 1375, 900)),
    "08_antialiasing": ("notebooks/openings/08_antialiasing.png", (60, 60, 890, 890)),
    "11_subdivision": ("notebooks/openings/11_subdivision.png", (1440, 100, 1920, 460)),
    "13_regularization": ("notebooks/openings/13_regularization.png", (1290, 96, 1920, 620)),
}
FILM = DATA / "reconstruction.png"
ZIP = "differentiable-rasterization"


def write(folder, extra):
    """Write folder/index.md, and its files to extra."""
    webp(extra, "reconstruction", Image.open(FILM))
    put(extra / "still_life.jpg", smaller(Image.open(ROOT / STILL_LIFE), (1200, 675), "JPEG"))
    archive = lighter(git("archive", "--format=zip", f"--prefix={ZIP}/", "HEAD"))
    if archive:
        put(extra / f"{ZIP}.zip", archive)
    for lecture, (file, part) in GALLERY.items():
        shown = smaller(Image.open(ROOT / file).crop(part), SIZE, "WEBP")
        put(extra / "gallery" / f"{lecture}.webp", shown)
    put(folder / "index.md", page(ways(len(archive))) + "".join(trees()))


def lighter(archive):
    """A zip of the course without what its lectures have drawn, two thirds of it, which whoever
    runs them sees: bytes. None of none.
    """
    made = io.BytesIO()
    if archive:
        with zipfile.ZipFile(io.BytesIO(archive)) as old, zipfile.ZipFile(made, "w") as new:
            for file in old.infolist():
                content = old.read(file)
                if file.filename.endswith(".ipynb"):
                    content = undrawn(nbformat.reads(content, as_version=4)).encode("utf-8")
                new.writestr(file, content)
    return made.getvalue()


def undrawn(notebook):
    """A notebook's text without the pictures of its outputs."""
    for cell in notebook.cells:
        if "outputs" in cell:
            cell.outputs = [one for one in cell.outputs if "image/png" not in one.get("data", {})]
    return nbformat.writes(notebook) + "\n"


def page(get):
    """The front page's text. ValueError or AttributeError: README.md lacks a number."""
    readme = exercises.read(ROOT / "README.md")
    numbers = {name: re.search(rf"{span}\W+ is (\d+) exercises, about (\d+) hours", readme).groups()
               for name, span in (("week", "A week"), ("core", "A term"))}
    return exercises.read(Path(__file__).with_name("front.md")).format(
        labs=len(exercises.LABS), get=get, first=first_exercise(), film=Image.open(FILM),
        commands=re.search(r"^## Start\n\n((?: {4}.*\n)+)", readme, re.M)[1], **numbers)


def first_exercise():
    """The address of the first exercise, where Python comes at once."""
    page, _, place = exercise_pages()[next(iter(read().exercises.values())).number].partition("#")
    return f"{page}?begin#{place}"


def smaller(opened, size, kind):
    """A picture -> the bytes of one of this size. What is too narrow stands between white."""
    content = io.BytesIO()
    ImageOps.pad(opened.convert("RGB"), size, color="white").save(content, kind, quality=85)
    return content.getvalue()


def ways(size):
    """How to get the course, in Markdown: a zip of so many bytes, if any, and the clone line."""
    server, name = map(os.environ.get, ("GITHUB_SERVER_URL", "GITHUB_REPOSITORY"))
    parts = []
    if size:
        parts.append(f'<a class="first" href="{ZIP}.zip" download>Download the course</a> '
                     f"as a zip of {size / 1e6:.0f} MB, and unpack it. Its lectures draw "
                     "their pictures when you run them.")
    if server and name:
        parts.append(f"With git:\n\n    git clone {server}/{name}")
    return "\n\n".join(parts)


def git(*command):
    """What git prints of the course's repository: bytes, none where there is no such thing."""
    try:
        return subprocess.run(["git", *command], cwd=ROOT, capture_output=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return b""
