"""Where on the site the course's functions, exercises and files are, and what they are called."""
import functools

from labkit import exercises
from labkit.places import ROOT

from . import sources_course

TEXTS = {  # a text of the repository: its page
    "teaching/README.md": "instructors", "teaching/first_week.md": "first_week",
    "labkit/grading/README.md": "grading", "notebooks/errata.md": "errata",
    "apps/reconstruct/README.md": "own_pictures",
    "apps/bridge/README.md": "real_projects", "benchmarks/README.md": "benchmarks"}

PAGES = {"reference": "reference", "course/complete": "reference", "course/fast": "reference",
         "course/given": "given"}  # a folder of modules: that of its pages


def lab_page(topic):
    """antialiasing -> labs/08_antialiasing, as its lecture is called."""
    return f"labs/{exercises.lecture(topic).stem}"


def function_page(name, lab):
    """The address of the function of the course that a text of a lab calls so, or None.

    lab: a number, as the first lecture's is 0.
    """
    course = sources_course.read()
    full = course.find(name, lab)
    is_ours = full and full.startswith(("reference.", "course.given.")) and course.function(full)
    return course.address(full).removeprefix("../") if is_ours else None


def lab_title(lab):
    name = exercises.LABS[lab - 1][0].replace("_", " ")
    return f"Lab {lab}: {name}"


def kind(exercise):
    return "extra" if exercise.is_extra else "core" if exercise.points else "step"


def mark(exercise):
    if not exercise.points:
        return f"step {exercise.number}"
    name = "extra" if exercise.is_extra else "exercise"
    return f"{name} {exercise.number} ({points(exercise.points)})"


def points(count):
    return f"{count} point{'s' * (count != 1)}"


def anchor(number):
    """8.7 -> exercise-8-7."""
    return f"exercise-{number.replace('.', '-')}"


@functools.cache
def exercise_pages():
    """{number: address} of all exercises and extras."""
    return {exercise.number: f"{lab_page(name.split('.')[1])}.html#{anchor(exercise.number)}"
            for name, exercise in sources_course.read().exercises.items()}


def page_of_file(path):
    """A file of the course, seen from its folder -> the page that shows it, or None."""
    folder, _, name = path.rpartition("/")
    stem, _, ending = name.partition(".")
    if path == "README.md":  # a text that leads there means its table of labs
        return "labs/index"
    if folder == "notebooks" and ending == "ipynb":
        return f"lectures/{stem}"
    if folder == "labs" and stem in exercises.TOPICS:
        return lab_page(stem)
    if (page := PAGES.get(folder)) and (ROOT / path).exists() and ending == "py":
        return f"{page}/{stem}"
    return TEXTS.get(path)
