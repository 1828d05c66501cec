"""What one writes is what draws: a core exercise with a mistake shows in what a demo draws."""
import functools
import importlib
import sys
import types
import warnings

import numpy as np
import pytest
from what_draws import shown
from what_late_labs_draw import LATE

from course.given import compiled, faster
from course.given.whose import Labs
from labkit import exercises
from labkit.upkeep import mistakes

# Topics of which every core exercise is in the renderer, or in the fit of its own lab.
DRAWING = ("transforms", "rasterization", "interpolation", "vertex_gradients",
           "rasterizer_gradients", "antialiasing", "outlines", "inverse_rendering", "pipeline")
ENOUGH = 3  # mistakes of each exercise, at least, must show
CORE = [(topic, one.name) for topic in (*DRAWING, *LATE)
        for one in exercises.topic_exercises(topic)
        if not one.is_extra and one.points]


@pytest.fixture(scope="module")
def labs():
    """The reference once more, as a package in which mistakes can be made."""
    package = sys.modules["mistaken"] = types.ModuleType("mistaken")
    package.__path__ = importlib.import_module("reference").__path__
    with pytest.MonkeyPatch.context() as patch:
        # numba would keep machine code of this package beside the reference's files, and read it.
        patch.setattr(compiled, "is_installed", lambda: False)
        yield Labs("mistaken")
    for name in [name for name in sys.modules if name.partition(".")[0] == "mistaken"]:
        del sys.modules[name]


@pytest.fixture(scope="module")
def right(labs):
    """-> {what is drawn: numbers} of scenes, without a mistake."""
    return functools.cache(lambda scenes: dict(scenes(labs)))


def written(module, name):
    """The function that somebody wrote, without what may be faster."""
    function = getattr(module, name)
    return getattr(function, "written", function)


def shows_in(labs, scenes, right):
    """The first that looks otherwise than it should. None: nothing does."""
    what = "it cannot be drawn"
    try:
        for what, numbers in scenes(labs):
            if numbers.shape != right[what].shape or not np.allclose(numbers, right[what], rtol=0,
                                                                     atol=1e-9):
                return what
    except Exception as error:
        return f"{what}: {error}"
    return None


@pytest.mark.parametrize("topic, name", CORE, ids=[name for _, name in CORE])
def test_a_mistake_shows(topic, name, labs, right, capsys):
    """A complete fast version draws in its place, or no picture needs it."""
    scenes = LATE.get(topic, shown)
    expected = right(scenes)
    module = getattr(labs, topic)
    function = written(module, name)
    code, found = function.__code__, []
    for mistake in mistakes.library(topic):
        if mistake.exercise.name == name:
            made = {}
            exec(compile(mistake.text, "mistake", "exec"), {**vars(module)}, made)
            function.__code__ = getattr(made[name], "written", made[name]).__code__
            faster.agrees.cache_clear()
            try:
                with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
                    found.append((mistake.sentence, shows_in(labs, scenes, expected)))
            finally:
                function.__code__ = code
                faster.agrees.cache_clear()
    print(*(f"{where}: {sentence}" for sentence, where in found), sep="\n")
    assert sum(where is not None for _, where in found) >= ENOUGH
