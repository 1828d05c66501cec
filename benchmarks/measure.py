"""What the benchmarks share: how they measure, their sphere, their tables and files.

Medians of several runs, in milliseconds of processor time, on one core: waiting does not count, but
what else runs makes caches and memory slower. All calls are measured in turn, round by round, so
that this falls on all alike, and their ratios say more than a time does on another machine.
Freed memory stays with the process. Otherwise glibc gives the pages of large arrays back and takes
them again, which is the largest noise: a script starts itself anew with that switched off.
"""
import json
import os
import platform
import statistics
import sys
import time
from pathlib import Path

import numpy as np
import scipy

from course.given import compiled, mesh
from labkit import places
from reference import transforms

RUNS = 9
CLIP_FROM_WORLD = transforms.perspective(np.radians(48), 1.0, 0.1, 10.0) @ transforms.translate(
    np.array([0.0, 0.0, -3.0]))


def medians(calls, runs=RUNS, clock=time.process_time):
    """{name: call} -> {name: milliseconds}, after one round to warm up."""
    return {name: statistics.median(times) for name, times in rounds(calls, runs, clock).items()}


def rounds(calls, runs, clock=time.process_time):
    """{name: call} -> {name: milliseconds of each round}, after one round to warm up.

    Each round begins with another name. clock: of the processor, or `time.perf_counter`.
    """
    names = list(calls)
    took = {name: [] for name in names}
    for start in range(runs + 1):
        turn = start % len(names)
        for name in names[turn:] + names[:turn]:
            took[name].append(milliseconds(calls[name], clock))
    return {name: times[1:] for name, times in took.items()}


def milliseconds(call, clock):
    begin = clock()
    call()
    return 1000 * (clock() - begin)


def on_cores(threads, call):
    """What the call returns, with kernels on so many cores."""
    compiled.cores = lambda: threads
    return call()


def sphere(face_count):
    """An icosphere that fills four fifths of the height: vertices (V, 3), faces, clip (V, 4)."""
    vertices, faces = mesh.icosphere(face_count)
    clip = transforms.transform(transforms.to_homogeneous(vertices), CLIP_FROM_WORLD)
    return vertices, faces, clip


def machine():
    """{what: fact} of what the numbers are measured on, and when."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    names = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return {"machine": platform.machine(), "system": platform.platform(),
            "processor": (names or [platform.processor() or "unknown"])[0],
            "python": platform.python_version(), "numpy": np.__version__,
            "scipy": scipy.__version__, "date": time.strftime("%Y-%m-%d")}


HELD = {"MALLOC_TRIM_THRESHOLD_": "2000000000", "MALLOC_MMAP_THRESHOLD_": "2000000000",
        "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "LP_NUM_THREADS": "0"}


def hold_memory():
    """Start this script anew, with one thread in all libraries, and keep what memory it has."""
    if any(os.environ.get(name) != value for name, value in HELD.items()):
        os.environ.update(HELD)
        os.execv(sys.executable, [sys.executable, *sys.argv])


def begin():
    """Hold memory, stay on one core, print the machine -> its facts, for `save`."""
    hold_memory()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    facts = machine()
    print(", ".join(f"{name} {fact}" for name, fact in facts.items()))
    return facts


def show(rows):
    """Rows [{column: value}, ...] as a table; a row may lack columns that others have."""
    columns = list(dict.fromkeys(column for row in rows for column in row))
    lines = [columns] + [[text(row.get(column, "")) for column in columns] for row in rows]
    widths = [max(map(len, cells)) for cells in zip(*lines, strict=True)]
    print()
    for line in lines:
        print("  ".join(cell.rjust(width) for cell, width in zip(line, widths, strict=True)))


def text(value):
    if isinstance(value, float):
        return f"{value:.3g}" if abs(value) < 10 else f"{value:.1f}"
    return f"{value:,}" if isinstance(value, int) else str(value)


def save(name, content):
    """Write facts and tables to out/benchmarks/NAME.json."""
    path = places.out("benchmarks", f"{name}.json")
    places.write_whole(path, json.dumps(content, indent=1).encode())
    print(f"\nwritten to {path}")
