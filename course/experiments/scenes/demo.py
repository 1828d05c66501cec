"""The scenes of `python3 -m course demo`: what the labs can do, on meshes that nobody here made.

A scene is a function of the labs' modules that yields (what was made, path or None) as it goes.
Where there is a goal, it yields a third thing: (the goal, whether it is met). Each scene has a file
of its own, with its numbers and its pictures. All of the rendering is the labs' own code.
"""
import contextlib
import importlib
import re
import time

from IPython import get_ipython
from rich import box
from rich.console import Console
from rich.table import Table

from ...given import pale, places
from ..folder import command

FILES = {"bunny": "portrait", "teapot": "portrait", "rounded": "levels", "simplified": "levels"}
NAMES = ("bunny", "teapot", "flight", "aliasing", "msaa", "mirror", "fit_triangle", "fit_cube",
         "fit_pose", "fit_texture", "fit_mirror", "fit_bunny", "fit_outlines", "rounded",
         "simplified", "relaxation", "large_steps", "shadow", "representations", "fit_volume",
         "reconstruct", "ablations", "paint_and_light")  # in the order of the labs
SCENES = {name: getattr(importlib.import_module(f"{__package__}.{FILES.get(name, name)}"), name)
          for name in NAMES}  # a scene's file has its name, unless FILES says another
SLOW = ("fit_cube", "fit_pose", "fit_texture", "fit_mirror", "fit_bunny", "fit_outlines",
        "large_steps", "fit_volume", "reconstruct", "ablations", "paint_and_light")


class Lacking(ValueError):
    """A module of the labs is not there, or an exercise is not written: which, in one sentence."""


class Labs:
    """The labs' modules of one package, loaded when first used. Lacking: one is not there.

    package: labs or reference; without, reference if it has all that labs/ has.
    """

    def __init__(self, package=None):
        self.package = package or preferred()

    def __getattr__(self, topic):
        if topic.startswith("_"):
            raise AttributeError(topic)
        try:
            module = vars(self)[topic] = importlib.import_module(f"{self.package}.{topic}")
            return module
        except ModuleNotFoundError as error:
            package, _, module = error.name.partition(".")
            if package != self.package:
                raise
        raise Lacking(f"{package}/{module or topic}.py is not in this copy of the course")


def preferred():
    """reference, if it has all that labs/ has; else labs."""
    labs, reference = ({path.name for path in places.ROOT.glob(f"{package}/*.py")}
                       for package in ("labs", "reference"))
    return "reference" if reference and labs <= reference else "labs"


@contextlib.contextmanager
def exercises_named():
    """What an exercise that is not written raises becomes Lacking."""
    try:
        yield
    except NotImplementedError as error:
        match = re.match(r"\w+ ([\d.]+): (\w+)", str(error))
        if not match:
            raise
        raise Lacking(f"exercise {match[1]}, {match[2]}, is not written yet; "
                      f"python3 -m course check {match[1]} shows where its question is") from None


@contextlib.contextmanager
def when_written():
    """In a notebook: a block that needs what is not there or not written says so.

    The cell shows the picture that it came with, pale.
    """
    try:
        with exercises_named():
            yield
    except Lacking as error:
        print(f"Nothing of yours to see yet: {error}")
        if shell := get_ipython():
            pale.show(shell.history_manager.input_hist_raw[-1], after="that")


def run(names: list[str], implementation: str | None = None, **wishes) -> int:
    """Render the named scenes, or all quick ones -> exit status: 1 if a goal was missed, else 0.

    Without names, scenes that lack something are left out, and what they lack is said; 1 if all do.
    ["reconstruct", FOLDER] is what `folder.command` does, and wishes, as `command.Wishes` has them,
    are for it alone. ValueError: a name that is no scene's, or wishes for another scene. Lacking.
    """
    labs = Labs(implementation)
    if len(names) == 2 and names[0] == "reconstruct" and names[1] not in SCENES:
        with exercises_named():
            return command.run(labs, names[1], command.Wishes(**wishes))
    if wishes:
        raise ValueError("--steps, --size and --resume are only for: reconstruct FOLDER")
    unknown = [name for name in names if name not in SCENES]
    if unknown:
        raise ValueError(f"there is no scene {unknown[0]}: choose from {', '.join(SCENES)}")
    wanted, console = names or [name for name in SCENES if name not in SLOW], Console()
    missed, lacks = rendered(labs, wanted, console, may_lack=not names)
    for lack, without in lacks.items():
        console.print(f"{', '.join(without)} left out: {lack}", soft_wrap=True, highlight=False)
    if sum(map(len, lacks.values())) == len(wanted):
        return 1
    console.print(f"The pictures are in {places.out('demo')}", soft_wrap=True)
    if not names:
        console.print("Half a minute to five minutes each, asked for by name: "
                      f"python3 -m course demo {' '.join(SLOW)}", soft_wrap=True)
    return 1 if missed else 0


def rendered(labs, names, console, may_lack):
    """Render scenes and print their tables -> how many goals were missed, {lack: scenes}."""
    missed, lacks = 0, {}
    for name in names:
        try:
            with exercises_named():
                rows = list(timed(SCENES[name](labs)))
        except Lacking as error:
            if not may_lack:
                raise
            lacks.setdefault(str(error), []).append(name)
        else:
            missed += sum("MISSED" in row[1] for row in rows)
            console.print(table(name, rows))
    return missed, lacks


def table(name, rows):
    """A scene's rows, as they are printed."""
    made = Table(title=f"{name}: {scenes()[name]}", box=box.SIMPLE_HEAD, title_justify="left",
                 title_style="bold", pad_edge=False, min_width=72)
    for column in "step", "goal" if any(row[1] for row in rows) else "", "ms", "picture":
        made.add_column(column, justify="right" if column == "ms" else "left")
    for row in rows:
        made.add_row(*row)
    return made


def timed(steps):
    """What a scene yields, as rows of text: step, goal, milliseconds, picture."""
    start = time.perf_counter()
    for step, path, *goals in steps:
        milliseconds = 1000 * (time.perf_counter() - start)
        picture = str(path.relative_to(places.ROOT)) if path else ""
        goal = " ".join(goal if met else f"{goal} MISSED" for goal, met in goals)
        yield step, goal, f"{milliseconds:.1f}", picture
        start = time.perf_counter()


def scenes() -> dict[str, str]:
    """{name: what it shows}, in the order of the labs."""
    return {name: scene.__doc__.splitlines()[0] for name, scene in SCENES.items()}
