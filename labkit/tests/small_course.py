"""Two small labs and their checks, which are in texts/, and how tests have them graded."""
import csv
from pathlib import Path

from submitted import put

from labkit.exercises import read

TEXTS = Path(__file__).with_name("texts")
LAB, SECOND = read(TEXTS / "transforms.py"), read(TEXTS / "rasterization.py")
CHECKS = read(TEXTS / "checks_of_transforms.py")
SECOND_LAB = {"reference/rasterization.py": SECOND, "labs/rasterization.py": SECOND,
              "tests/labs/test_rasterization.py": read(TEXTS / "checks_of_rasterization.py")}


def first_lab(lab=LAB, checks=CHECKS):
    """The first lab as a course has it."""
    return {"reference/transforms.py": lab, "labs/transforms.py": LAB,
            "tests/labs/test_transforms.py": checks}


def hand_in(folder, **texts):
    """Put submissions into folder/in: ada=LAB is her first lab."""
    put(folder / "in", {f"{student}_transforms.py": text for student, text in texts.items()})


def grade_command(folder, *options, isolation="process"):
    """What run_module runs to grade folder/in."""
    return ("course", "grade", folder / "in", "--out", folder / "out",
            "--isolation", isolation, *options)


def grades(out):
    """{student: row} of grades.csv."""
    with open(out / "grades.csv", encoding="utf-8-sig") as file:
        return {row["student"]: row for row in csv.DictReader(file)}
