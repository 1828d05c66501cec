"""What one writes is what draws: a core exercise with a mistake shows in what a demo draws."""
import contextlib
import importlib
import sys
import types
import warnings

import numpy as np
import pytest
import what_late_labs_draw as late
from what_draws import shown

from course.given import compiled, faster
from course.given.whose import Labs
from course.scenes import fit_triangle
from labkit import exercises
from labkit.upkeep import mistakes

# Topics of which every core exercise is in what draws: the renderer with its fits, or a scene.
DRAWING = {shown: ("transforms", "rasterization", "interpolation", "texturing", "mipmapping",
                   "vertex_gradients", "rasterizer_gradients", "antialiasing", "outlines",
                   "outline_walk", "inverse_rendering", "pipeline"),
           late.lab_3: ("sampling",), late.lab_4: ("msaa",),
           late.lab_10: ("neural_renderer", "sweep_gradient"),
           late.lab_11: ("subdivision", "loop_subdivision", "catmull_clark"),
           late.lab_12: ("simplification", "collapse_heap"),
           late.lab_13: ("regularization", "remeshing"),
           late.lab_14: ("shadow_mapping", "soft_shadows", "variance_shadows"),
           late.lab_15: ("implicit_surfaces", "marching_tetrahedra"),
           late.lab_16: ("reconstruction", "multi_view_fit"), late.lab_17: ("kernels",)}
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


@contextlib.contextmanager
def mistaken(module, name, text):
    """For the block, the text of a wrong function is what somebody wrote."""
    function, made = written(module, name), {}
    exec(compile(text, "mistake", "exec"), {**vars(module)}, made)
    code, function.__code__ = function.__code__, getattr(made[name], "written", made[name]).__code__
    faster.agrees.cache_clear()
    try:
        with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
            yield
    finally:
        function.__code__ = code
        faster.agrees.cache_clear()


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
    found = []
    for mistake in mistakes.library(topic):
        if mistake.exercise.name == name:
            with mistaken(getattr(labs, topic), name, mistake.text):
                found.append((mistake.sentence, shows_in(drawn, labs, right[drawn])))
    print(*(f"{where}: {sentence}" for sentence, where in found), sep="\n")
    assert sum(where is not None for _, where in found) >= min(ENOUGH, len(found) - 1) > 0


@pytest.mark.parametrize(("topic", "number", "words"), [
    ("transforms", "1.11", "gradient of w is missing"), ("transforms", "1.11", "are swapped"),
    ("interpolation", "5.11", "adds only once"), ("rasterizer_gradients", "7.8", "a constant"),
    ("inverse_rendering", "9.8", "transposed"), ("inverse_rendering", "9.8", "factor 2")])
def test_a_mistake_of_the_way_back_misses_a_goal_of_a_demo(topic, number, words, labs, capsys):
    """The fit comes to its end with a wrong gradient as well, and all goals are met."""
    wrong = next(mistake for mistake in mistakes.library(topic)
                 if mistake.exercise.number == number and words in mistake.sentence)
    met = [fit_triangle.turned(labs)[-1][1]]
    with mistaken(getattr(labs, topic), wrong.exercise.name, wrong.text):
        met.append(fit_triangle.turned(labs)[-1][1])
    assert met == [True, False]


def test_without_a_mistake_nothing_shows(labs, right):
    """Two things have one name, or what is drawn depends on chance: every mistake seems to show."""
    assert [shows_in(drawn, labs, right[drawn]) for drawn in DRAWING] == [None] * len(DRAWING)
