"""Rosters: what an instructor exports from a platform, and the file that its import takes.

    canvas   the gradebook's export, which its import reads
    moodle   an assignment's offline grading worksheet, to be uploaded there

What an export of each looks like is told in files/rosters.toml.
"""
import re
import tomllib
import unicodedata
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from . import sheets


class Platform(NamedTuple):
    """What an export looks like, as files/rosters.toml has it."""

    export: str
    needs: list
    ids: list
    name: list
    graded: str
    keys: dict


PLATFORMS = {name: Platform(**table) for name, table in tomllib.loads(
    Path(__file__).parents[1].joinpath("files", "rosters.toml").read_text("utf-8")).items()}


class Roster(NamedTuple):
    """An export, and the column that takes the points."""

    path: str
    platform: str
    sheet: sheets.Sheet
    column: int


def read(path, platform, assignment=None) -> Roster:
    """A Roster from a platform's export. ValueError: it is none, or the column is unclear."""
    sheet = sheets.read(path)
    kind = PLATFORMS[platform]
    if missing := [name for name in kind.needs if name not in sheet.header]:
        raise ValueError(f"{path} is not {platform.title()}'s {kind.export}: it has no column "
                         f"{missing[0]!r}, but {', '.join(sheet.header[:6])}")
    columns = {column: match[1] for column, title in enumerate(sheet.header)
               if (match := re.fullmatch(kind.graded, title))}
    return Roster(path, platform, sheet, chosen(columns, sheet.header, assignment, path))


def chosen(columns, header, assignment, path):
    """The only column, or the one that --assignment names."""
    fit = [column for column, name in columns.items() if assignment in (None, name, header[column])]
    if len(fit) == 1:
        return fit[0]
    there = "; ".join(header[column] for column in columns) or "no such column"
    which = f"called {assignment!r}" if assignment else "that take points"
    raise ValueError(f"{path} has {len(fit)} columns {which}: give one with --assignment "
                     f"({there})")


# --- people -----------------------------------------------------------------------------------


def cell(roster, row, title):
    """What is in a column of a row. Empty where there is no such column."""
    header, rows = roster.sheet.header, roster.sheet.rows
    return rows[row][header.index(title)].strip() if title in header else ""


def people(roster):
    """{row: name} of those that are people, not a line such as Points Possible."""
    kind = PLATFORMS[roster.platform]
    return {row: joined(roster, row, kind.name) for row in range(len(roster.sheet.rows))
            if joined(roster, row, kind.ids)}


def joined(roster, row, titles):
    """What is in some columns of a row."""
    return " ".join(filter(None, (cell(roster, row, title) for title in titles)))


def key(text):
    """Participant 1234, #1234 and 1234 are one; so are Ada  Lovelace and ada lovelace."""
    text = unicodedata.normalize("NFC", " ".join(text.split())).casefold()
    return re.sub(r"^(participant |#)(?=\w)", "", text)


def match(roster, handed_in) -> tuple[dict, dict]:
    """-> ({student: row}, {student: why there is none}), by what the platform tells of each."""
    keys = PLATFORMS[roster.platform].keys
    index = {platform: {what: indexed(roster, titles) for what, titles in known.items()}
             for platform, known in keys.items()}
    found = {one.student: row_of(one.identity, index.get(one.identity.platform, {}))
             for one in handed_in}
    counts = Counter(found.values())
    rows = {student: row for student, row in found.items()
            if isinstance(row, int) and counts[row] == 1}
    return rows, {student: why if isinstance(why, str) else
                  "another submission is of the same person"
                  for student, why in found.items() if student not in rows}


def indexed(roster, titles):
    """{what people have in these columns, as a key: their rows}."""
    found = {}
    for row in people(roster):
        found.setdefault(key(joined(roster, row, titles)), []).append(row)
    return found


def row_of(identity, index):
    """The row of a person, or a sentence on why there is none. index {what is told: `indexed`}."""
    if identity.platform == "people":  # the name there may be any of these
        identity = identity._replace(id=identity.name, email=identity.name)
    told = {what: getattr(identity, what) for what in index if key(getattr(identity, what))}
    found = {what: index[what].get(key(text), ()) for what, text in told.items()}
    for rows in found.values():
        if len(rows) == 1:
            return rows[0]
    return (", ".join(f"{len(rows) or 'nobody'} in the roster with the {what} {told[what]}"
                      for what, rows in found.items())
            or "what was handed in tells nothing that the roster has, too")


# --- points -----------------------------------------------------------------------------------


def most(roster):
    """The most points that the platform has for the assignment. None if its export tells none."""
    rows = roster.sheet.rows
    texts = [row[roster.column].strip() for row in rows if row[0].strip() == "Points Possible"]
    texts += [cell(roster, row, "Maximum grade") for row in range(len(rows))]
    return next((most for most in map(sheets.number, texts) if most is not None), None)


def kept_word(roster, row):
    """A word in the place of points, such as Canvas's EX for excused. It is not written over."""
    text = roster.sheet.rows[row][roster.column].strip()
    return "" if text == "-" or sheets.number(text) is not None else text


def replaced(roster, points):
    """Yield (name, points in the roster, points now) of those that are other ones."""
    names = people(roster)
    for row, now in points.items():
        before = roster.sheet.rows[row][roster.column].strip()
        if sheets.number(before) not in (None, float(now)):
            yield names[row], before, now


def filled(roster, points) -> bytes:
    """The file to import, as bytes. points {row: text}. All other cells are as they came."""
    sheet = roster.sheet
    table = [sheet.header, *map(list, sheet.rows)]
    for row, text in points.items():
        if not kept_word(roster, row):
            table[row + 1][roster.column] = text
    return sheets.written(table, sheet.delimiter, sheet.newline, sheet.has_bom)
