"""A topic's reference with other manners, which are those of manners.py."""
from pathlib import Path

from labkit import exercises

MANNERS = exercises.read(Path(__file__).with_name("manners.py"))


def in_other_forms(topic):
    """The text of the reference's module, changed so."""
    names = [exercise.name for exercise in exercises.topic_exercises(topic)]
    changes = [f"{name} = in_forms({name})" for name in names]
    return "\n".join([exercises.read(exercises.reference(topic)), MANNERS, *changes, ""])
