"""The scenes of `python3 -m course demo`: what the labs can do, on meshes that nobody here made.

A scene is a function of the labs' modules that yields (what was made, path or None) as it goes.
Where there is a goal, it yields a third thing: (the goal, whether it is met). Each scene has a file
of its own, with its numbers and its pictures. All of the rendering is the labs' own code. A scene
in TAKES can be given two things more: a folder in out/demo, and what it shows, read from a file.
"""
import functools
import importlib
import time
from pathlib import Path

from labkit import places

from ..given.whose import Labs, Lacking, exercises_named
from . import own

SCENES = ("bunny", "ties", "cut", "aliasing", "msaa", "floor", "fit_vertices", "borders",
          "fit_triangle", "taped", "fit_bunny", "cubes", "rounded", "house", "cage", "simplified",
          "smoothed", "relaxation", "large_steps", "shadow", "light_from_shadow", "still_life",
          "representations", "hole", "reconstruct", "paint_and_light",
          "tiles")  # in the order of the labs
FILES = {"bunny": "portrait", "ties": "small", "cut": "small", "borders": "small",
         "rounded": "levels", "house": "levels", "cage": "levels", "simplified": "levels",
         "smoothed": "relaxation", "light_from_shadow": "shadow"}  # others have their name
SLOW = ("taped", "fit_bunny", "large_steps", "still_life", "reconstruct", "paint_and_light")
TAKES = {"bunny": functools.partial(own.shape, most=200_000), "aliasing": own.photo,
         "rounded": functools.partial(own.surface, most=10_000),
         "simplified": functools.partial(own.shape, most=50_000),
         "relaxation": functools.partial(own.shape, most=50_000)}  # what reads one's own FILE


def scene(name):
    """The function that is a scene, from its file, which is imported when it is asked for."""
    return getattr(importlib.import_module(f"{__package__}.{FILES.get(name, name)}"), name)


def title(name):
    """What a scene shows, in a line."""
    return scene(name).__doc__.splitlines()[0]


def run(names: list[str], implementation: str | None = None) -> int:
    """Render the named scenes, or all quick ones -> exit status: 1 if a goal was missed, else 0.

    A file after a name, as in ["rounded", "cow.obj"], takes the place of what the scene shows.
    Without names, scenes that lack something are left out, and what they lack is said; 1 if all do.
    ValueError: a name that is no scene's. Lacking.
    """
    labs = Labs(implementation)
    wanted = [(name, file, TAKES[name](file) if file else None) for name, file in
              with_files(names) or [(name, None) for name in SCENES if name not in SLOW]]
    missed, lacks = rendered(labs, wanted, may_lack=not names)
    for lack, without in lacks.items():
        print(f"{', '.join(without)} left out: {lack}")
    if sum(map(len, lacks.values())) == len(wanted):
        return 1
    print(f"The pictures are in {places.out('demo')}")
    if not names:
        print("Ten seconds to four minutes each, asked for by name: "
              f"python3 -m course demo {' '.join(SLOW)}")
    return 1 if missed else 0


def with_files(names):
    """["rounded", "cow.obj", "msaa"] -> [("rounded", "cow.obj"), ("msaa", None)]."""
    found = []
    for name in names:
        if name in SCENES:
            found.append((name, None))
        elif not Path(name).suffix and not Path(name).exists():
            raise ValueError(f"there is no scene {name}: choose from {', '.join(SCENES)}")
        elif found and found[-1][0] in TAKES and found[-1][1] is None:
            found[-1] = found[-1][0], name
        else:
            raise ValueError(f"{name} does not follow a scene that takes a file: write it after "
                             f"{', '.join(TAKES)}, as in: rounded cow.obj")
    return found


def rendered(labs, wanted, may_lack):
    """Render [(scene, file or None, what was read)], and tell each step -> how many goals were
    missed, {lack: scenes}.
    """
    missed, lacks = 0, {}
    for name, file, read in wanted:
        given = (own.folder(name, file), read) if file else ()
        print(f"{name} {file}" if file else f"{name}: {title(name)}", flush=True)
        try:
            with exercises_named():
                for line, misses in timed(scene(name)(labs, *given)):
                    print(line, flush=True)
                    missed += misses
        except Lacking as error:
            if not may_lack:
                raise
            lacks.setdefault(str(error), []).append(name)
    return missed, lacks


def timed(steps):
    """What a scene yields, as lines of text (milliseconds, step, goal, picture), and how many goals
    were missed.
    """
    start = time.perf_counter()
    for step, path, *goals in steps:
        milliseconds = 1000 * (time.perf_counter() - start)
        told = [f"{milliseconds:10.1f} ms  {step}"]
        told += [f"(goal: {goal})" if met else f"(goal: {goal} MISSED)" for goal, met in goals]
        line = "  ".join([*told, str(path.relative_to(places.ROOT))] if path else told)
        yield line, sum(not met for _, met in goals)
        start = time.perf_counter()
