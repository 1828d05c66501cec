"""How long a lab takes: its lecture is read, then its core exercises are solved.

    hours = words of the lecture / 75 a minute + 1 minute a figure + 6 minutes a point of the core

Sections and pages that no core exercise needs are marked as further reading, and do not count, nor
do "On paper" and the sources. The three numbers are a rule, not a measurement of readers: change
them here when a class was measured. README.md, notebook 00 and teaching print them. A test tells
when they are behind. This command updates them:

    python3 -m labkit.upkeep.hours
"""
import json
import re

from .. import exercises, places

PRINTED = [places.ROOT / page
           for page in ("README.md", "notebooks/00_start_here.ipynb", "teaching/README.md")]

WORDS_A_MINUTE = 75
MINUTES_A_FIGURE = 1
MINUTES_A_POINT = 6
TAG = re.compile("<[^>]*>")  # the words for who does not see a picture are in one
LEFT = "*Further reading", "## On paper", "## Sources"


def sections(path):
    """{title: minutes} of a lecture's sections, in their order; "" is what stands above them."""
    title, minutes, left = "", {}, False
    page_left = LEFT[0] in exercises.cells(path)[0]
    for cell in json.loads(exercises.read(path))["cells"]:
        parts = re.split(r"^(?=## )", "".join(cell["source"]), flags=re.M)
        figures = sum("image/png" in output.get("data", {}) for output in cell.get("outputs", ()))
        for part in parts if cell["cell_type"] == "markdown" else [""]:
            if part.startswith("## "):
                title, left = part.partition("\n")[0][3:], page_left
            left = left or any(mark in part for mark in LEFT)
            took = len(TAG.sub("", part).split()) / WORDS_A_MINUTE + MINUTES_A_FIGURE * figures
            minutes[title] = minutes.get(title, 0) + (0 if left else took)
    return minutes


def core(lab):
    """The core exercises of a lab, whose number is given, and its steps."""
    return [exercise for topic in exercises.LABS[lab - 1]
            for exercise in exercises.topic_exercises(topic) if not exercise.is_extra]


def pages(lab: int) -> list:
    """A lab's lecture, and the page that goes on, such as 06b."""
    return exercises.pages(exercises.LABS[lab - 1][0])


def hours(lab: int) -> float:
    """What a lab's lecture and core take, to the half of an hour."""
    points = sum(exercise.points for exercise in core(lab))
    read = sum(minutes for path in pages(lab) for minutes in sections(path).values())
    return round((read + MINUTES_A_POINT * points) / 30) / 2


def told(labs) -> str:
    """How many exercises the core of these labs has, and how long they take."""
    count = sum(bool(exercise.points) for lab in labs for exercise in core(lab))
    return f"{count} exercises, about {sum(map(hours, labs)):.0f} hours"


def updated(text: str) -> str:
    """A page with the numbers as they are now, in its table of labs and in its sentences."""
    whole = range(1, len(exercises.LABS) + 1)
    text = re.sub(r"((?:The core|A term\*\*) is )\d+ exercises, about \d+ hours",
                  lambda found: found[1] + told(whole), text)
    text = re.sub(r"(weeks?\S* \w+ )\d+ exercises, about \d+ hours([^.]*: labs ([\d, and]+))",
                  lambda found: found[1] + told([*map(int, re.findall(r"\d+", found[3]))])
                  + found[2], text)
    return re.sub(r"(\| (\d+) \| \[.*\| )[\d.]+ \|",
                  lambda row: f"{row[1]}{hours(int(row[2])):g} |", text)


if __name__ == "__main__":
    for page in PRINTED:
        places.write_whole(page, updated(exercises.read(page)).encode("utf-8"))
