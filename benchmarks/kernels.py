"""Lab 2's rasterizer four ways, for lecture 17: python3 benchmarks/kernels.py

The loop in plain Python, NumPy, and compiled kernels on one core and on two: milliseconds of wall
time, medians, 512 x 512 pixels. It needs numba, and two cores with nothing else to do.
"""
import statistics
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from course.given import compiled
from course.given.compiled import without_kernels
from reference import compiled_pipeline, rasterization, scanline

SIZE = 512
FACES = 1_000, 10_000, 100_000, 1_000_000
BY_LOOP = 2_000  # faces: it takes 20 s, and as long for more faces of the same ball


def main():
    measure.hold_memory()
    facts = measure.machine()
    rows = [row(count) for count in FACES]
    measure.show(rows)
    measure.save("kernels", facts, {"wall time, medians in ms": rows})


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
    loop = {"loop": milliseconds(lambda: rasterization.rasterize_loop(*scene))}
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
