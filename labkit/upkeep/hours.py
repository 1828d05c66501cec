"""How long a lab takes: its lecture is worked through, then its core exercises are solved.

    minutes to read = words / 180 + figures / 3 + displayed equations / 2 + lines of code / 15
    hours of a lab  = 1.5 times the minutes to read + 6 minutes a point of the core

Code that is folded away, answers and pseudocode do not count, nor, in the hours, what no core
exercise needs: sections and pages that are marked as further reading. The numbers are a rule, not a
measurement of readers: change them here when a class was measured. README.md, notebook 00 and
teaching print them. A test tells when they are behind. This command updates them:

    python3 -m labkit.upkeep.hours
"""
import json
import re

from .. import exercises, places

PRINTED = [places.ROOT / page
           for page in ("README.md", "notebooks/00_start_here.ipynb", "teaching/README.md")]

READINGS, MINUTES_A_POINT = 1.5, 6
UNREAD = re.compile(r"<details>.*?</details>|<[^>]*>|```.*?```", re.DOTALL)
EQUATION = re.compile(r"\$\$.*?\$\$", re.DOTALL)
FOLDED = "# figure:", "# opening:"   # how cells begin that only draw
LEFT = "*Further reading", "## On paper", "## Sources"


def minutes(path, is_needed=False):
    """What a lecture takes to read: all of it, or what a core exercise needs."""
    took, left = 0, False
    page_left = LEFT[0] in exercises.cells(path)[0]
    for cell in json.loads(exercises.read(path))["cells"]:
        is_text, text = cell["cell_type"] == "markdown", "".join(cell["source"])
        for part in re.split(r"^(?=## )", text, flags=re.M) if is_text else [text]:
            if part.startswith("## "):
                left = page_left
            left = left or any(mark in part for mark in LEFT)
            if not (is_needed and left):
                took += of_text(part) if is_text else of_code(part, cell["outputs"])
    return took


def of_text(text):
    text = UNREAD.sub("", text)
    return len(EQUATION.sub("", text).split()) / 180 + len(EQUATION.findall(text)) / 2


def of_code(code, outputs):
    lines = sum(line.strip() != "" for line in code.splitlines())
    figures = sum("image/png" in output.get("data", {}) for output in outputs)
    return figures / 3 + (0 if code.startswith(("# live", *FOLDED)) else lines / 15)


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
    read = sum(minutes(path, is_needed=True) for path in pages(lab))
    return round((READINGS * read + MINUTES_A_POINT * points) / 30) / 2


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
