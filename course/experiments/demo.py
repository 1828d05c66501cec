"""The scenes of `python3 -m course demo`: what the labs can do, on meshes that nobody here made.

A scene is a function of the labs' modules that yields (what was made, path or None) as it goes.
Where there is a goal, it yields a third thing: (the goal, whether it is met). Each scene has a file
of its own, with its numbers and its pictures. All of the rendering is the labs' own code.
"""
import importlib
import time

from rich import box
from rich.console import Console
from rich.table import Table

from ..given import places
from . import (
    ablations,
    aliasing,
    fit_bunny,
    fit_cube,
    fit_outlines,
    fit_pose,
    fit_texture,
    fit_triangle,
    fit_volume,
    flight,
    large_steps,
    levels,
    msaa,
    portrait,
    reconstruct,
    relaxation,
    representations,
    shadow,
)

SCENES = {scene.__name__: scene for scene in (
    portrait.bunny, portrait.teapot, flight.flight, aliasing.aliasing, msaa.msaa,
    fit_triangle.fit_triangle, fit_cube.fit_cube, fit_pose.fit_pose, fit_texture.fit_texture,
    fit_bunny.fit_bunny, fit_outlines.fit_outlines, levels.rounded, levels.simplified,
    relaxation.relaxation, large_steps.large_steps,
    shadow.shadow, representations.representations, fit_volume.fit_volume, reconstruct.reconstruct,
    ablations.ablations)}
SLOW = ("fit_cube", "fit_pose", "fit_texture", "fit_bunny", "fit_outlines", "large_steps",
        "fit_volume", "reconstruct", "ablations")


class Labs:
    """The labs' modules of one package, loaded when first used."""

    def __init__(self, package):
        self.package = package

    def __getattr__(self, topic):
        return importlib.import_module(f"{self.package}.{topic}")


def run(names, implementation="reference"):
    """Render the named scenes, or all quick ones -> exit status: 1 if a goal was missed, else 0.

    ValueError: a name that is no scene's.
    """
    unknown = [name for name in names if name not in SCENES]
    if unknown:
        raise ValueError(f"there is no scene {unknown[0]}: choose from {', '.join(SCENES)}")
    console, missed = Console(), 0
    for name in names or [name for name in SCENES if name not in SLOW]:
        rows = list(timed(SCENES[name](Labs(implementation))))
        table = Table(title=f"{name}: {scenes()[name]}", box=box.SIMPLE_HEAD, title_justify="left",
                      title_style="bold", pad_edge=False, min_width=72)
        for column in "step", "goal" if any(row[1] for row in rows) else "", "ms", "picture":
            table.add_column(column, justify="right" if column == "ms" else "left")
        for row in rows:
            table.add_row(*row)
        missed += sum("MISSED" in row[1] for row in rows)
        console.print(table)
    console.print(f"The pictures are in {places.out('demo')}", soft_wrap=True)
    if not names:
        console.print("Half a minute to five minutes each, asked for by name: "
                      f"python3 -m course demo {' '.join(SLOW)}", soft_wrap=True)
    return 1 if missed else 0


def timed(steps):
    """What a scene yields, as rows of text: step, goal, milliseconds, picture."""
    start = time.perf_counter()
    for step, path, *goals in steps:
        milliseconds = 1000 * (time.perf_counter() - start)
        picture = str(path.relative_to(places.ROOT)) if path else ""
        goal = " ".join(goal if met else f"{goal} MISSED" for goal, met in goals)
        yield step, goal, f"{milliseconds:.1f}", picture
        start = time.perf_counter()


def scenes():
    """{name: what it shows}, in the order of the labs."""
    return {name: scene.__doc__.splitlines()[0] for name, scene in SCENES.items()}
