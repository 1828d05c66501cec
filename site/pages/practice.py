"""Exercises on the labs' pages: what their editors hold, their pictures, and the course, packed.

Python is Pyodide's. It comes from its CDN, or from a folder that the site has a copy of.
"""
import ast
import importlib.metadata
import io
import json
import re
import shutil
import sys
import tarfile
from pathlib import Path
from unittest import mock

from course.given import image
from labkit import exercises, lab_text, places
from labkit.grading.handing import handout

from . import picture, put
from .sources_course import defined

STATIC = places.ROOT / "site" / "static" / "practice"
CDN = "https://cdn.jsdelivr.net/pyodide/v0.27.7/full/"
OWN = "../python/"  # of a lab's page
MEGABYTES = 16.5    # of Python, NumPy and the course, unpacked, as the worker sees them come
HIGH = 192          # of a picture, in pixels of the page
PACKAGES = "pytest", "pluggy", "iniconfig", "packaging", "pygments"
UNUSED = re.compile(r"(notebooks|apps|tasks|labkit/upkeep|tests/golden)/|labs/[^_]|"
                    r".*\.(png|md|txt)$|course/fast/(\w+_kernels|compiled_)|"
                    r"packaging/(?!__init__|_struct|version)|pygments/(cmdline|sphinxext|"
                    r"(lexers|styles|formatters)/"
                    r"(?!(__init__|_mapping|diff|python|terminal|default)\.))")

sys.path.append(str(STATIC))
pictures = importlib.import_module("pictures")


def write(extra, python):
    """Write extra/practice: the course, and what its exercises draw -> as `drawings`. python: a
    folder with Pyodide, which is copied to extra/python, or None.
    """
    put(extra / "practice" / "course.tar.bz2", packed(files()))
    for name in later():
        put(extra / "practice" / name, (places.ROOT / name).read_bytes())
    if python:
        shutil.copytree(python, extra / "python")
    with mock.patch.object(places, "OUT", str(extra.parent)):  # the reader's own out/demo stays
        return drawings(extra)


def drawings(extra):
    """Write what the exercises draw -> {(topic, name): HTML}, the first picture that calls this
    exercise, and none of a later lab.
    """
    lab_of = {(topic, exercise.name): number
              for number, topics in enumerate(exercises.LABS, 1) for topic in topics
              for exercise in exercises.text_exercises(exercises.read(exercises.reference(topic)))}
    found = {}
    for name in pictures.PICTURES:
        codes = set()
        sys.setprofile(lambda frame, *_, seen=codes: seen.add(frame.f_code))
        drawn = pictures.drawn(name, "reference")
        sys.setprofile(None)
        called = {(Path(code.co_filename).stem, code.co_name) for code in codes} & lab_of.keys()
        last = max(lab_of[one] for one in called)
        file = f"practice/{name.replace('/', '_')}.png"
        image.write(extra / file, drawn)
        shown = pair(name, file, *drawn.shape[:2])
        found = {one: shown for one in called if lab_of[one] == last} | found
    return found


def later():
    """The names of the files that come when a check reads them: most labs need none."""
    checks = "".join(path.read_text("utf-8") for path in places.ROOT.glob("tests/labs/*.py"))
    return [f"tests/golden/{path.name}" for path in sorted(places.ROOT.glob("tests/golden/*.npz"))
            if f'"{path.name}"' in checks]


def files():
    """Yield (name, bytes) of what checks need: a hand-out's files, the page's own, packages."""
    yield from dict(handout.files(exercises.topics_of(None), [], extra=False)).items()
    for path in STATIC.glob("*.py"):
        yield path.name, path.read_bytes()
    for name in PACKAGES:
        for file in importlib.metadata.files(name):
            if file.suffix == ".py" or "LICENSE" in file.name:
                yield file.as_posix(), file.read_binary()


def packed(content):
    made = io.BytesIO()
    with tarfile.open(fileobj=made, mode="w:bz2") as archive:  # a third less than a zip
        for name, part in content:
            if not UNUSED.match(name):
                about = tarfile.TarInfo(name)
                about.size = len(part)
                archive.addfile(about, io.BytesIO(part))
    return made.getvalue()


def place(exercise, topic, pair):
    """The HTML in which an exercise is done. Without scripts it says how else. pair: its picture's.
    """
    number, name = exercise.number, exercise.name
    return (f'<div class="practice" data-number="{number}" data-topic="{topic}" '
            f'data-name="{name}"><p>Write it in <code>labs/{topic}.py</code>, then '
            f"<code>python3 -m course check {number}</code>.</p></div>{pair}")


def pair(name, file, height, width):
    """The picture that an exercise draws, beside the place for what the reader's does."""
    wide = HIGH * width // height
    style = f' style="width: {wide}px; image-rendering: {"pixelated" if wide > width else "auto"}"'
    return (f'<div class="draws" data-picture="{name}"><figure class="yours"><canvas width="{wide}"'
            f' height="{HIGH}"{style}></canvas><figcaption>yours comes here</figcaption></figure>'
            f"<figure>{picture(f'../{file}', pictures.in_words(name), wide, HIGH, style)}"
            "<figcaption>how it should be</figcaption></figure></div>")


def work(topics, python):
    """The HTML with which work is taken along and put in again, and what a page's scripts know."""
    known = {"python": OWN if python else CDN, "megabytes": MEGABYTES, "later": later(),
             "pages": [exercises.lecture(own).stem for own, *_ in exercises.LABS],
             "labs": {topic: lab(topic) for topic in topics if topic in exercises.lab_topics()}}
    data = json.dumps(known).replace("<", "\\u003c")
    return ('<p class="my-work" hidden><button class="zip">My work as a zip</button> '
            '<label>Put in a zip, or a file of <code>labs/</code>: <input type="file" '
            'accept=".zip,.py"></label> <output></output></p>'
            f'<script type="application/json" id="practice">{data}</script>')


def lab(topic):
    """A lab as it comes: its text, the names in it, {name: text} of its extras when opened."""
    whole = exercises.read(exercises.reference(topic))
    text, opened = (lab_text.skeleton(whole, extras) for extras in (False, True))
    extras = {exercise.name for exercise in exercises.text_exercises(opened) if exercise.is_extra}
    names = [name for node in ast.parse(text).body for name in defined(node)]
    return {"text": text, "names": names,
            "extras": {node.name: ast.get_source_segment(opened, node)
                       for node in exercises.top_level_functions(opened) if node.name in extras}}
