"""The course's own checks, as a lab's page asks for them. Pyodide runs this in a worker.

Each answer is a text of JSON, or bytes. `files` are the labs that the reader has written in:
{topic: text}. All others are as they came.
"""
import base64
import importlib
import json
import re
import shutil
import sys
from pathlib import Path

import numpy as np

from labkit import board, exercises, imports, verdicts
from labkit.contract import UNFINISHED
from labkit.grading.handing import archives
from labkit.places import ROOT

PACKAGES = {"scipy": "scipy", "matplotlib": "matplotlib", "PIL": "pillow"}
FILED = re.compile(r"^(inputs|picture) .*(\n {10}.*)*\n", re.MULTILINE)  # rows that name a file


class Missing:
    """What is imported and not loaded yet: names of `wanted`, for the worker to load."""

    def __init__(self):
        self.wanted = set()

    def find_spec(self, name, *_):
        if name in PACKAGES:
            self.wanted.add(PACKAGES[name])


missing = Missing()
sys.meta_path.append(missing)


def put(files):
    """The labs as they came, but for these, and none of them imported."""
    shutil.copytree(ROOT / "labkit" / "handed_out", ROOT / "labs", dirs_exist_ok=True)
    for topic, text in files.items():
        (ROOT / "labs" / f"{topic}.py").write_text(text, "utf-8")
    stale = ("labs.", "tests.") if missing.wanted else "labs."  # checks that were not imported
    for name in [name for name in sys.modules if name.startswith(stale)]:
        del sys.modules[name]
    importlib.invalidate_caches()
    missing.wanted.clear()


def answer(kind, files, *rest):
    """-> a dict as JSON, with what must be loaded before the same is asked again."""
    put(json.loads(files))
    try:
        found = globals()[kind](*rest)
    except ModuleNotFoundError:
        if not missing.wanted:
            raise
        found = {}
    return json.dumps({"needs": sorted(missing.wanted), **found})


def ready():
    """Python is there, and the course imported."""
    return {}


def check(number):
    """The verdicts on an exercise and on those that it calls, and what to do next."""
    found = verdicts.run(number, "labs", 0, extra=True)
    told = [*found.problems, *found.broken.values(), *found.warnings]
    if any(entry.told != "done" for entry in found.asked) and not found.broken:
        told.append(board.next_to_do(found.needed, "labs", 0))
    return {"report": FILED.sub("", "\n".join([*told, *found.losses])),
            "verdicts": {entry.number: entry.told for entry in found.needed}}


def ways_on(entry, *_):
    """The last rows of a report, for who has a page and no terminal."""
    blocked = entry.blocked_by
    yield "again", f"write {blocked} first" if blocked else "Check, or Ctrl+Enter"
    yield "read", f"the question of {entry.number}; its lecture is linked below it"
    if entry.verdict != "done":
        yield "stuck", "the answer is linked there, too"


board.ways_on = ways_on


def picture(name):
    """What the reader's labs draw for an exercise of this name, or why they do not."""
    import pictures
    try:
        drawn = pictures.drawn(name, "labs")
        drawn = drawn.reshape(*drawn.shape[:2], 3)  # a wrong answer may have other axes
    except NotImplementedError as error:
        waits = UNFINISHED.fullmatch(str(error))
        return {"waits": f"waits for {waits[1]} {waits[2]}" if waits else str(error)}
    except (Exception, SystemExit) as error:
        return {"waits": f"{type(error).__name__}: {error}"}
    rows = np.uint8(255 * np.clip(drawn, 0, 1) + 0.5)[::-1]
    height, width = rows.shape[:2]
    opaque = np.dstack([rows, np.full((height, width), 255, np.uint8)])
    return {"width": width, "colours": base64.b64encode(opaque.tobytes()).decode()}


def pack(names):
    """The zip to hand in, as `python3 -m course pack` makes it. names: of the files written in."""
    names = dict.fromkeys([*exercises.lab_topics(), *json.loads(names)])
    zipped = archives.zipped((f"labs/{name}.py", (ROOT / "labs" / f"{name}.py").read_bytes())
                             for name in names)
    return {"zip": base64.b64encode(zipped).decode()}


def unpack(name, content):
    """{topic: text} of the labs in a zip, or in a lab's file, that are not as they came, and what
    is to be said of it.
    """
    path = Path("/tmp") / Path(name).name
    path.write_bytes(base64.b64decode(content))
    texts, _, notes = archives.read(path, exercises.lab_topics())
    return {"notes": notes, "texts": {topic: text for topic, text in texts.items()
                                      if imports.text_in(ROOT / "labs", topic) != text}}
