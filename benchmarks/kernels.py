"""What kernels are worth, for lecture 17: python3 benchmarks/kernels.py

Lab 2's rasterizer four ways: the loop in plain Python, NumPy, and compiled kernels on one core and
on two, in milliseconds of wall time, medians, 512 x 512 pixels. And a mean with weights in passes
and in one kernel, in processor time. It needs numba, and two cores with nothing else to do.
"""
import functools
import statistics
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from course.given import compiled
from course.given.compiled import without_kernels
from reference import compiled_pipeline, kernels, rasterization, scanline

SIZE = 512
FACES = 1_000, 10_000, 100_000, 1_000_000
BY_LOOP = 2_000  # faces: it takes 20 s, and as long for more faces of the same ball
NUMBERS = 10_000_000


def main():
    measure.hold_memory()
    facts = measure.machine()
    streams = streamed()
    measure.show(streams)
    rows = [row(count) for count in FACES]
    measure.show(rows)
    measure.save("kernels", facts, {"wall time, medians in ms": rows,
                                    "processor time, medians in ms": streams})


def streamed():
    """Eq. (4) of lecture 17: the same means in NumPy's passes and in one kernel, taking turns."""
    e, a = np.random.default_rng(0).uniform(1, 2, (2, 3, NUMBERS))
    ways = {"passes": (kernels.mixed_in_passes, 28), "one kernel": (kernels.mixed_at_once, 7)}
    took = measure.medians({name: functools.partial(way, e, a) for name, (way, _) in ways.items()})
    return [{"way": name, "ms": took[name], "GB/s": 8 * moved * NUMBERS / took[name] / 1e6}
            for name, (_, moved) in ways.items()]


def row(face_count):
    """The times for one sphere; all ways take turns, and find the same bits."""
    _, faces, clip = measure.sphere(face_count)
    scene = clip, faces, SIZE, SIZE
    calls = {"NumPy": lambda: without_kernels(scanline.rasterize)(*scene),
             "one core": lambda: by_kernels(1, scene), "two cores": lambda: by_kernels(2, scene)}
    expected = calls["NumPy"]()
    assert all(np.array_equal(found, wanted) for call in calls.values()
               for found, wanted in zip(call(), expected, strict=True))
    took = {name: [] for name in calls}
    for _ in range(11 if face_count < BY_LOOP else 7):
        for name, call in calls.items():
            took[name].append(milliseconds(call))
    loop = {"loop": milliseconds(lambda: rasterization.rasterize.written(*scene))}
    return {"faces": len(faces), **(loop if face_count < BY_LOOP else {}),
            **{name: statistics.median(times) for name, times in took.items()}}


def by_kernels(threads, scene):
    compiled.cores = lambda: threads
    return compiled_pipeline.rasterize(*scene)


def milliseconds(call):
    begin = time.perf_counter()
    call()
    return 1000 * (time.perf_counter() - begin)


if __name__ == "__main__":
    main()
