"""How long a lab takes: its lecture is read, then its core exercises are solved.

    hours = words of the lecture / 75 a minute + 1 minute a figure + 6 minutes a point of the core

Sections and pages that no core exercise needs are marked as further reading, and do not count, nor
do "On paper" and the sources. Of the spine count its exercises, and the sections that a lecture
names for it. The three numbers are a rule, not a measurement of readers: change them here when a
class was measured. README.md and notebook 00 print what comes out. A test
tells when they are behind. This command updates them:

    python3 -m labkit.upkeep.hours
"""
import json
import re

from .. import exercises, places

PRINTED = places.ROOT / "README.md", places.ROOT / "notebooks" / "00_start_here.ipynb"

WORDS_A_MINUTE = 75
MINUTES_A_FIGURE = 1
MINUTES_A_POINT = 6
LEFT = "*Further reading", "## On paper", "## Sources"
SPINE = re.compile(r"\*\*The spine\*\* needs sections (.*?)\.")


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
            took = len(part.split()) / WORDS_A_MINUTE + MINUTES_A_FIGURE * figures
            minutes[title] = minutes.get(title, 0) + (0 if left else took)
    return minutes


def spine_sections(path):
    """The numbers of the sections that a lecture names for the spine: "2 to 4 and 8" -> 2, 3, 4, 8.
    """
    named = SPINE.search(exercises.cells(path)[0])
    return [number for first, last in re.findall(r"(\d+)(?: to (\d+))?", named[1] if named else "")
            for number in range(int(first), int(last or first) + 1)]


def core(lab):
    """The core exercises of a lab, whose number is given."""
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


def spine_hours() -> int:
    """What the spine takes, its sections of the lectures and its exercises, in whole hours."""
    labs = range(1, len(exercises.LABS) + 1)
    points = sum(exercise.points for lab in labs for exercise in core(lab) if exercise.is_spine)
    read = sum(minutes for path in dict.fromkeys(map(exercises.lecture, exercises.TOPICS))
               for title, minutes in sections(path).items()
               if title.partition(".")[0] in map(str, spine_sections(path)))
    return round((read + MINUTES_A_POINT * points) / 60)


def updated(text: str) -> str:
    """A page with the numbers as they are now, in its table of labs and in its sentences."""
    labs = range(1, len(exercises.LABS) + 1)
    whole = [exercise for lab in labs for exercise in core(lab)]
    for part, hours_of_it in (whole, sum(map(hours, labs))), (
            [exercise for exercise in whole if exercise.is_spine], spine_hours()):
        name = r"The core|\*\*A term\*\*" if part is whole else r"The spine|\*\*A week\*\*"
        text = re.sub(rf"((?:{name}) is [^.:]*?)\d+ exercises, about \d+ hours",
                      rf"\g<1>{len(part)} exercises, about {hours_of_it:.0f} hours", text)
    return re.sub(r"(\| (\d+) \| \[.*\| )[\d.]+ \|",
                  lambda row: f"{row[1]}{hours(int(row[2])):g} |", text)


if __name__ == "__main__":
    for page in PRINTED:
        places.write_whole(page, updated(exercises.read(page)).encode("utf-8"))
