"""What is asked of `grade`, and what its output folder remembers of that: DIR/asked.json.

An option that is not given this time is as it was the last time. With an empty text, as in
--due "", it is forgotten. So nobody loses marks by a command that is typed anew. The file holds the
run's seed, which is secret: whoever knows it can make a table of the right answers.
"""
import json
import os
import secrets
from pathlib import Path
from typing import NamedTuple

from .. import exercises, places

FILES = {"roster", "overrides", "people"}
OF_THIS_RUN = {"submissions", "out", "jobs", "resume", "isolation"}  # the rest is remembered


class Request(NamedTuple):
    """The options of `grade`, as they were given. None: not given."""

    submissions: str | None   # None: what the folder out keeps, again
    out: str
    labs: str | None = None
    jobs: int | None = None      # at a time; None: one for each core
    resume: bool = False
    seed: int | None = None
    isolation: str | None = None
    seconds: float | None = None  # the most that a call may take; None: that of sandbox.Limits
    extra: bool | None = None    # extras count as well: fair where they were handed out open
    csv: str | None = None       # the platform
    roster: str | None = None
    assignment: str | None = None
    due: str | None = None
    late: str | None = None
    grace: str | None = None
    overrides: str | None = None
    people: str | None = None
    all_or_nothing: bool | None = None  # not by the share of claims that hold
    count: str | None = None  # of several hand-ins: newest, last-on-time or best
    task: str | None = None   # an open task, in the place of labs


def recalled(request) -> tuple[Request, str]:
    """The whole request, out of this one and those before; a sentence on what comes from there.

    ValueError: the folder is of other labs, or a file of the last time is not there any more.
    """
    before = remembered(request.out)
    given = {name: value for name, value in options(request).items() if value is not None}
    labs = before.get("labs", given.get("labs"))
    if given.get("labs", labs) != labs:
        raise ValueError(f"{request.out} holds grades of labs {labs}, and not of "
                         f"{given['labs']}: name another folder with --out")
    again = {name: value for name, value in before.items() if name not in given}
    for name in FILES & again.keys():
        if not os.path.exists(again[name]):
            raise ValueError(f"{again[name]}, the last run's --{name}, is not there any more: "
                             f'give --{name} FILE, or forget it with --{name} ""')
    whole = {"labs": numbers(None), "seed": secrets.randbits(128)} | again | {
        name: None if value == "" or value is False else value for name, value in given.items()}
    said = " ".join(f"--{name.replace('_', '-')}" + f" {value}" * (value is not True)
                    for name, value in again.items() if name != "seed")
    return request._replace(**whole), said and f"as in the last run: {said}"


def remember(request) -> None:
    """Write asked.json, for the eyes of its owner alone."""
    path = Path(request.out, "asked.json")
    asked = {name: value for name, value in options(request).items() if value is not None}
    places.write_whole(path, json.dumps(asked, indent=1).encode(), 0o600)


def remembered(out) -> dict:
    """{option: value} of the last run into this folder."""
    path = Path(out, "asked.json")
    try:
        return json.loads(path.read_bytes()) if path.exists() else {}
    except ValueError:
        raise ValueError(f"{path} cannot be read: restore it, because it holds the seed, or remove "
                         "it and grade everything again") from None


def options(request):
    """{name: value} of what is remembered, in a form in which two of them can be compared."""
    found = {name: value for name, value in request._asdict().items() if name not in OF_THIS_RUN}
    found["labs"] = found["labs"] and numbers(found["labs"])
    return found | {name: os.path.abspath(found[name]) for name in FILES if found[name]}


def numbers(labs):
    """'1-3' -> '1,2,3'. None: all labs."""
    topics = exercises.topics_of(labs)
    return ",".join(dict.fromkeys(str(exercises.lab_number(topic)) for topic in topics))
