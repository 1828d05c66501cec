"""Where on the site the course's functions, exercises and files are."""
import functools
import re

from course import exercises
from course.given.places import ROOT

CODE = re.compile(r"(?<!`)`(\w+)`(?!`)")


def lab_page(topic):
    """antialiasing -> labs/08_antialiasing, as its lecture is called."""
    return f"labs/{exercises.lecture(topic).stem}"


@functools.cache
def functions():
    """{name: address} of the functions of reference/ that have a name of their own."""
    found = {}
    for topic in exercises.topics():
        text = exercises.read(exercises.reference(topic))
        for function in exercises.top_level_functions(text):
            found.setdefault(function.name, []).append(
                f"reference/{topic}.html#reference.{topic}.{function.name}")
    return {name: places[0] for name, places in found.items() if len(places) == 1}


@functools.cache
def exercise_pages():
    """{number: address} of all exercises and extras."""
    return {exercise.number: f"{lab_page(topic)}.html#exercise-{exercise.number.replace('.', '-')}"
            for topic in exercises.topics() for exercise in exercises.topic_exercises(topic)}


def page_of_file(path):
    """A file of the course, seen from its folder -> the page that shows it, or None."""
    folder, _, name = path.rpartition("/")
    stem, _, ending = name.partition(".")
    if path == "README.md":
        return "index"
    if folder == "notebooks" and ending == "ipynb":
        return f"lectures/{stem}"
    if folder == "labs" and stem in exercises.TOPICS:
        return lab_page(stem)
    if folder in ("reference", "course/given") and (ROOT / path).exists() and ending == "py":
        return f"{folder.rpartition('/')[2]}/{stem}"
    return {"notebooks/errata.md": "errata", "benchmarks/README.md": "benchmarks",
            "course/grading/README.md": "instructors"}.get(path)
