"""What kernels are worth, for lecture 17: python3 benchmarks/kernels.py

Lab 2's rasterizer four ways: the loop in plain Python, NumPy, and compiled kernels on one core and
on two, in milliseconds of wall time, medians, 512 x 512 pixels. And a mean with weights in passes
and in one kernel, in processor time. It needs numba, and two cores with nothing else to do.
"""
import functools
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
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
    measure.save("kernels", {**facts, "wall time, medians in ms": rows,
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
    by_kernels = functools.partial(compiled_pipeline.rasterize, *scene)
    calls = {"NumPy": lambda: without_kernels(scanline.rasterize)(*scene),
             "one core": lambda: measure.on_cores(1, by_kernels),
             "two cores": lambda: measure.on_cores(2, by_kernels)}
    expected = calls["NumPy"]()
    assert all(np.array_equal(found, wanted) for call in calls.values()
               for found, wanted in zip(call(), expected, strict=True))
    line = {"faces": len(faces)}
    if face_count < BY_LOOP:
        line["loop"] = measure.milliseconds(lambda: rasterization.rasterize.written(*scene),
                                            time.perf_counter)
    return line | measure.medians(calls, 11 if face_count < BY_LOOP else 7, time.perf_counter)


if __name__ == "__main__":
    main()
