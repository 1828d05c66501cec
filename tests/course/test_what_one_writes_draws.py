"""What one writes is what draws: a core exercise with a mistake shows in what a demo draws."""
import importlib
import sys
import types
import warnings

import numpy as np
import pytest
from what_draws import shown, surfaces
from what_late_labs_draw import (
    lab_3,
    lab_4,
    lab_10,
    lab_11,
    lab_12,
    lab_15,
    lab_16,
    lab_17,
    shadows,
)

from course.given import compiled, faster
from course.given.whose import Labs
from labkit import exercises
from labkit.upkeep import mistakes

# Topics of which every core exercise is in what draws: the renderer with its fits, or a scene.
DRAWING = {shown: ("transforms", "rasterization", "interpolation", "texturing", "mipmapping",
                   "vertex_gradients", "rasterizer_gradients", "antialiasing", "outlines",
                   "outline_walk", "inverse_rendering", "pipeline"),
           lab_3: ("sampling",), lab_4: ("msaa",),
           lab_10: ("neural_renderer", "sweep_gradient"),
           surfaces: ("regularization", "remeshing"),
           lab_11: ("subdivision", "loop_subdivision", "catmull_clark"),
           lab_12: ("simplification", "collapse_heap"),
           shadows: ("shadow_mapping", "soft_shadows", "variance_shadows"),
           lab_15: ("implicit_surfaces", "marching_tetrahedra"),
           lab_16: ("reconstruction", "multi_view_fit"), lab_17: ("kernels",)}
ENOUGH = 3  # mistakes of each exercise, at least, must show, or all but one of them
CORE = [(drawn, topic, one.name) for drawn, topics in DRAWING.items() for topic in topics
        for one in exercises.topic_exercises(topic) if not one.is_extra and one.points]


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
    return {drawn: dict(drawn(labs)) for drawn in DRAWING}


def written(module, name):
    """The function that somebody wrote, without what may be faster."""
    function = getattr(module, name)
    return getattr(function, "written", function)


def shows_in(drawn, labs, right):
    """The first thing drawn that looks otherwise than it should. None: nothing does."""
    what = "it cannot be drawn"
    try:
        for what, numbers in drawn(labs):
            if numbers.shape != right[what].shape or not np.allclose(numbers, right[what], rtol=0,
                                                                     atol=1e-9):
                return what
    except Exception as error:
        return f"{what}: {error}"
    return None


@pytest.mark.parametrize("drawn, topic, name", CORE, ids=[name for *_, name in CORE])
def test_a_mistake_shows(drawn, topic, name, labs, right, capsys):
    """A complete fast version draws in its place, or no picture needs it."""
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
                    found.append((mistake.sentence, shows_in(drawn, labs, right[drawn])))
            finally:
                function.__code__ = code
                faster.agrees.cache_clear()
    print(*(f"{where}: {sentence}" for sentence, where in found), sep="\n")
    assert sum(where is not None for _, where in found) >= min(ENOUGH, len(found) - 1) > 0


def test_without_a_mistake_nothing_shows(labs, right):
    """Two things have one name, or what is drawn depends on chance: every mistake seems to show."""
    assert [shows_in(drawn, labs, right[drawn]) for drawn in DRAWING] == [None] * len(DRAWING)
