"""What a worker is sent of the course's labs besides the one that was handed in."""
import functools

from ... import exercises, lab_text, places
from ...imports import imports
from ...table import FAST, GIVEN, TASKS


@functools.cache
def before_it(topic):
    """The topics before this one, all before an open task: those that it may import."""
    topics = exercises.topics()
    return topics if topic in TASKS else topics[:topics.index(topic)]


@functools.cache
def given_text(topic):
    """A lab's text without answers."""
    return lab_text.skeleton(exercises.read(exercises.reference(topic)), extra=True)


@functools.cache
def exercise_numbers(topic):
    """{name: number} of a topic's exercises."""
    return {exercise.name: exercise.number for exercise in exercises.topic_exercises(topic)}


@functools.cache
def preloaded(topic):
    """The modules of SciPy and the course that a topic, or one before it, imports."""
    return tuple(dict.fromkeys(
        need.what for each in (*before_it(topic), topic) if each not in TASKS
        for need in imports(exercises.read(exercises.reference(each)))
        if need.at_the_top and (need.what in GIVEN or need.what.startswith("scipy"))))


@functools.cache
def faster():
    """{module: its text} of what an open task has besides: what is faster, in NumPy."""
    return {path.stem: exercises.read(path) for path in places.ROOT.glob(f"{FAST}/*.py")}
