"""What the differentiable pipeline costs, stage by stage: python3 benchmarks/pipeline.py

Rasterize, barycentrics, interpolate 3 attributes, antialias; then their backward passes, from the
picture to clip positions and attributes. Medians of several runs, in milliseconds of processor
time, so that what else the machine does is not counted; everything runs on one core. In brackets
the growth: times the column before. Written to out/benchmarks/pipeline.json as well.

The scene is an icosphere that fills four fifths of the height. Where DEODR, PyTorch3D or Mitsuba is
installed, its time for this scene, forward and backward, stands below ours; benchmarks/peers.py
says how its work differs.
"""
import argparse
import json
import os
import platform
import statistics
import sys
import time
from pathlib import Path

import numpy as np
import scipy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import peers
from course import mesh, places
from reference import antialiasing, interpolation, rasterization, transforms, vertex_gradients

FACES = 1_000, 10_000, 100_000
SIZES = 256, 512, 1024, 2048
CLIP_FROM_WORLD = transforms.perspective(np.radians(48), 1.0, 0.1, 10.0) @ transforms.translate(
    np.array([0.0, 0.0, -3.0]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=9, help="of each stage, after one to warm up")
    runs = parser.parse_args().runs
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    machine = {"machine": platform.machine(), "system": platform.platform(),
               "processor": processor(), "python": platform.python_version(),
               "numpy": np.__version__, "scipy": scipy.__version__, "runs": runs}
    print(", ".join(f"{name} {fact}" for name, fact in machine.items()))
    rows = {"faces": [row(count, 512, runs) for count in FACES],
            "pixels": [row(10_000, size, runs) for size in SIZES]}
    for name, table in rows.items():
        show(name, table)
    path = places.out("benchmarks", "pipeline.json")
    document = {**machine, "medians in ms": rows}
    places.write_whole(path, json.dumps(document, indent=1).encode())
    print(f"\nwritten to {path}")


def processor():
    """Its name where the system tells, as 'Xeon', or what Python knows of it."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    names = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return (names or [platform.processor() or "unknown"])[0]


def row(face_count, size, runs):
    """{what: number}: one row of the table."""
    vertices, faces = mesh.icosphere(face_count)
    clip = transforms.transform(transforms.to_homogeneous(vertices), CLIP_FROM_WORLD)
    attributes = np.random.default_rng(0).random((len(vertices), 3))
    took = medians(stages(clip, faces, attributes, size), runs)
    others = {name: statistics.median(times(call, 3)) for name, call
              in peers.calls(vertices, faces, clip, attributes, size).items()}
    forward = sum(value for name, value in took.items() if not name.startswith("d "))
    return {"faces": len(faces), "pixels": size * size, **took, "forward": forward,
            "backward": sum(took.values()) - forward, "all": sum(took.values()), **others}


def stages(clip, faces, attributes, size):
    """{stage: call}, in order; "d " are the backward passes. Each gets what came before it."""
    opposite = antialiasing.opposite_vertices(faces)  # once for a mesh
    face_index, depth = rasterization.rasterize(clip, faces, size, size)
    barycentric = rasterization.barycentrics(face_index, clip, faces)
    colour = interpolation.interpolate(attributes, faces, face_index, barycentric)
    grad = np.random.default_rng(1).normal(size=colour.shape)
    edges = face_index, depth, clip, faces, opposite
    grad_barycentric = interpolation.interpolate_backward(grad, attributes, faces, face_index,
                                                          barycentric)[1]
    return {
        "rasterize": lambda: rasterization.rasterize(clip, faces, size, size),
        "barycentrics": lambda: rasterization.barycentrics(face_index, clip, faces),
        "interpolate": lambda: interpolation.interpolate(attributes, faces, face_index,
                                                         barycentric),
        "antialias": lambda: antialiasing.antialias(colour, *edges),
        "d antialias": lambda: antialiasing.antialias_backward(grad, colour, *edges),
        "d interpolate": lambda: interpolation.interpolate_backward(grad, attributes, faces,
                                                                    face_index, barycentric),
        "d barycentrics": lambda: vertex_gradients.barycentrics_backward(grad_barycentric,
                                                                         face_index, clip, faces),
    }


def medians(calls, runs):
    """{name: milliseconds}, after one round to warm up; all in turn, round by round."""
    took = {name: [] for name in calls}
    for _ in range(runs + 1):
        for name, call in calls.items():
            took[name] += times(call, 1)
    return {name: statistics.median(values[1:]) for name, values in took.items()}


def times(call, runs):
    """Milliseconds of each run, of this process alone, on all its threads."""
    took = []
    for _ in range(runs):
        start = time.process_time()
        call()
        took.append(1000 * (time.process_time() - start))
    return took


def show(grows, rows):
    """Measurements side by side, and after each by how much it grew from the one before."""
    print()
    for name in (grows, *(name for name in rows[0] if name not in ("faces", "pixels"))):
        line, before = f"{name:>16}", rows[0][name]
        for value in (row.get(name, np.nan) for row in rows):
            shown = f"{value:,}" if name == grows else f"{value:.1f}"
            line, before = line + f"{shown:>13} ({value / before:4.1f})", value
        print(line)


if __name__ == "__main__":
    main()
