"""The labs, made of the reference: a raise in place of every core exercise's answer.

Everything else stays, byte for byte, also extras, which `extras` opens. labs/.generated.json keeps
a hash of every lab as it was made. A lab with another hash was worked on, and is not made anew
without --force.
"""
import json
from pathlib import Path
from typing import NamedTuple

from .. import exercises, lab_text, places
from ..table import COMMAND


class Lab(NamedTuple):
    """A lab's path, the text that the reference makes, and the state of the text that is there."""

    path: Path
    text: str
    state: str  # in step, stale (or not there), worked on


def run(force: bool = False) -> int:
    """Make labs/ from reference/ -> exit status.

    A lab that was worked on stays as it is. With force it is made anew, its text kept beside it.
    """
    standing, made, refused = labs(), manifest(), False
    manifest_path().parent.mkdir(exist_ok=True)
    for path, text, state in standing:
        if state == "worked on" and not force:
            refused = True
            print(f"labs/{path.name} was worked on and stays as it is; to start it anew, run "
                  f"{COMMAND} skeleton --force, which keeps your text beside it")
            continue
        if state == "worked on":
            print(f"labs/{path.name} is made anew; your text is in labs/{keep(path).name}")
        if state != "in step":
            places.write_whole(path, text.encode("utf-8"))
        made[path.name] = exercises.digest(text)
    places.write_whole(manifest_path(), f"{json.dumps(made, indent=2, sort_keys=True)}\n".encode())
    return int(refused)


def labs():
    """The Lab of every topic that has one. ValueError: a reference has a wrong mark."""
    made = manifest()

    def lab(topic):
        exercises.topic_exercises(topic)  # its errors name the file
        path = places.ROOT / "labs" / f"{topic}.py"
        text = lab_text.skeleton(exercises.read(exercises.reference(topic)))
        there = exercises.digest(exercises.read(path)) if path.exists() else None
        if there == exercises.digest(text):
            return Lab(path, text, "in step")
        return Lab(path, text, "stale" if there in (None, made.get(path.name)) else "worked on")

    return [lab(topic) for topic in exercises.lab_topics()]


def keep(path):
    """Copy a file to .bak, or .bak2, ... where that is taken; the copy's path."""
    copies = (path.with_name(f"{path.name}.bak{number}") for number in ("", *range(2, 1000)))
    copy = next(copy for copy in copies if not copy.exists())
    places.write_whole(copy, path.read_bytes())
    return copy


def manifest_path():
    return places.ROOT / "labs" / ".generated.json"


def manifest():
    """{file: its digest when it was made}; empty where it cannot be read: no lab is overwritten."""
    try:
        return json.loads(manifest_path().read_bytes())
    except (OSError, ValueError):
        return {}
