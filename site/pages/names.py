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
def topics_of_functions():
    """{name: topics} of all functions of reference/."""
    found = {}
    for topic in exercises.topics():
        for function in exercises.top_level_functions(exercises.read(exercises.reference(topic))):
            found.setdefault(function.name, []).append(topic)
    return found


def function_page(name, lab):
    """The address of a function as a lab's lecture means it, or None: that lab's, or the only one.

    lab: a number, as the first lecture's is 0. Lab 17's kernels have the names of what they stand
    for, which is meant elsewhere.
    """
    topics = topics_of_functions().get(name, [])
    near = [topic for topic in topics if exercises.lab_number(topic) == lab]
    meant = near or [topic for topic in topics if topic not in exercises.LABS[-1]] or topics
    if len(meant) != 1:
        return None
    return f"reference/{meant[0]}.html#reference.{meant[0]}.{name}"


def anchor(number):
    """8.7 -> exercise-8-7."""
    return f"exercise-{number.replace('.', '-')}"


@functools.cache
def exercise_pages():
    """{number: address} of all exercises and extras."""
    return {exercise.number: f"{lab_page(topic)}.html#{anchor(exercise.number)}"
            for topic in exercises.topics() for exercise in exercises.topic_exercises(topic)}


def document(path):
    """A file of the course -> what Sphinx makes its page of, as a link names it. None: no page."""
    page = page_of_file(path)
    return page and f"/{page}{'.ipynb' if page.startswith('lectures/') else '.md'}"


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
    if folder in ("reference", "course/given") and (ROOT / path).exists() and ending == "py":
        return f"{folder.rpartition('/')[2]}/{stem}"
    return {"notebooks/errata.md": "errata", "benchmarks/README.md": "benchmarks",
            "course/grading/README.md": "instructors", "course/bridge/README.md": "real_projects",
            "course/experiments/folder/README.md": "own_pictures"}.get(path)
