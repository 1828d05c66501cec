"""How long a lab takes: its lecture is read, then its core exercises are solved.

    hours = words of the lecture / 100 a minute + 1 minute a figure + 5 minutes a point of the core

Nobody measured these three numbers on a class: change them here when somebody has. README.md and
notebook 00 print what comes out. A test tells when they are behind. This command updates them:

    python3 -m course.upkeep.hours
"""
import json
import re

from .. import exercises
from ..given import places

PRINTED = places.ROOT / "README.md", places.ROOT / "notebooks" / "00_start_here.ipynb"

WORDS_A_MINUTE = 100
MINUTES_A_FIGURE = 1
MINUTES_A_POINT = 5


def lecture_minutes(path):
    """The words of a notebook's text, and its figures."""
    cells = json.loads(exercises.read(path))["cells"]
    words = sum(len("".join(cell["source"]).split()) for cell in cells
                if cell["cell_type"] == "markdown")
    figures = sum("image/png" in output.get("data", {}) for cell in cells
                  for output in cell.get("outputs", ()))
    return words / WORDS_A_MINUTE + MINUTES_A_FIGURE * figures


def core(lab):
    """The core exercises of a lab, whose number is given."""
    return [exercise for topic in exercises.LABS[lab - 1]
            for exercise in exercises.topic_exercises(topic) if not exercise.is_extra]


def hours(lab: int) -> float:
    """What a lab's lecture and core take, to the half of an hour."""
    points = sum(exercise.points for exercise in core(lab))
    minutes = lecture_minutes(exercises.lecture(exercises.LABS[lab - 1][0]))
    return round((minutes + MINUTES_A_POINT * points) / 30) / 2


def updated(text: str) -> str:
    """A page with the numbers as they are now, in its table of labs and in its sentence."""
    labs = range(1, len(exercises.LABS) + 1)
    number, total = sum(len(core(lab)) for lab in labs), sum(map(hours, labs))
    text = re.sub(r"\d+ exercises, about \d+ hours",
                  f"{number} exercises, about {total:.0f} hours", text)
    return re.sub(r"^(\| (\d+) \|.*\| )[\d.]+ \|$",
                  lambda row: f"{row[1]}{hours(int(row[2])):g} |", text, flags=re.M)


if __name__ == "__main__":
    for page in PRINTED:
        places.write_whole(page, updated(exercises.read(page)).encode("utf-8"))
