"""The spine: the exercises from a vertex to a picture and back to a fit, in about ten hours."""
import sys
from pathlib import Path

import numpy as np
import pytest

from course.given.whose import Labs
from course.scenes import by_loops, drawing, fit_bunny, viewing
from labkit import board, exercises
from labkit.grading.handing import handout
from labkit.upkeep import hours


def spine():
    return [(topic, exercise) for topic in exercises.asking_topics()
            for exercise in exercises.topic_exercises(topic) if exercise.is_spine]


def called(*works):
    """(topic, name) of the reference's functions that run in what is done here."""
    names = set()

    def note(frame, event, _):
        if event == "call" and Path(frame.f_code.co_filename).parent.name == "reference":
            names.add((Path(frame.f_code.co_filename).stem, frame.f_code.co_name))

    sys.setprofile(note)
    try:
        for work in works:
            work()
    finally:
        sys.setprofile(None)
    return names


def test_it_fits_a_week():
    """It grows, exercise by exercise, into a second course."""
    assert 20 <= len(spine()) <= 30 and hours.spine_hours() <= 12


def test_each_of_its_exercises_is_on_the_way_to_a_fit():
    """An exercise is marked that neither a picture nor a fit of the demo needs."""
    labs = Labs("reference")

    camera = viewing.clip_from_world(labs, by_loops.EYE)

    def by_hand():
        by_loops.loss_and_gradient(labs, camera, by_loops.moved(np.random.default_rng(0)), 0.0)

    def whole_meshes():
        shape = labs.pipeline.make_mesh(by_loops.POSITIONS, by_loops.FACES)
        picture, *given = drawing.on_black(labs, shape, by_loops.COLOURS, camera, 32)
        labs.pipeline.render_backward(picture, *given)

    names = called(by_hand, whole_meshes, lambda: fit_bunny.fit(labs, 0.02, steps=1, size=32))
    assert [one.number for topic, one in spine() if (topic, one.name) not in names] == []


def test_a_lecture_names_the_sections_that_its_exercises_need():
    """Who reads what the lecture names meets an exercise of another section, or nobody told."""
    for topics in exercises.LABS:
        path = exercises.lecture(topics[0])
        reached = board.sections(path)
        needed = {int(reached[one.number][1].partition(".")[0]) for topic in topics
                  for one in exercises.topic_exercises(topic) if one.is_spine}
        assert needed <= set(hours.spine_sections(path))
        assert bool(needed) != ("**The spine** does not need this lecture." in exercises.read(path))


def test_it_is_handed_out_alone(tmp_path):
    """The rest of the core is open as well, or points are given for what came complete."""
    handout.run(tmp_path / "week", spine=True)
    for path in (tmp_path / "week" / "labs").glob("*.py"):
        text = exercises.read(path)
        for one in exercises.text_exercises(text):
            is_todo = f'raise NotImplementedError("exercise {one.number}: ' in text
            assert one.is_spine == is_todo == (not one.is_extra)
    with pytest.raises(ValueError, match="name in --labs only 1,2,5,7,8,9"):
        handout.run(tmp_path / "other", labs="2-3", spine=True)
