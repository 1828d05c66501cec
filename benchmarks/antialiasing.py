"""How long lab 8 takes, and how it grows: python3 benchmarks/antialiasing.py

Medians of several runs on one core, in milliseconds; written to out/benchmarks/antialiasing.json
as well. "copy" is what it takes to copy the picture, which each of both directions does once.
"""
import json
import platform
import statistics
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from course import mesh, places
from reference import antialiasing, rasterization, transforms

FACES = 1_000, 10_000, 100_000
SIZES = 256, 512, 1024, 2048
RUNS = 9


def main():
    rows = [measure(count, 512) for count in FACES] + [measure(10_000, size) for size in SIZES]
    print(f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}")
    print("".join(f"{name:>12}" for name in rows[0]))
    for row in rows:
        print("".join(f"{value:>12}" for value in row.values()))
    path = places.out("benchmarks", "antialiasing.json")
    places.write_whole(path, json.dumps(rows, indent=1).encode())
    print(f"written to {path}")


def measure(face_count, size):
    """One row of the table: an icosphere that fills four fifths of the height."""
    vertices, faces = mesh.icosphere(face_count)
    clip_from_world = transforms.perspective(np.radians(48), 1.0, 0.1, 10.0)
    clip_from_world = clip_from_world @ transforms.translate(np.array([0.0, 0.0, -3.0]))
    clip = transforms.transform(transforms.to_homogeneous(vertices), clip_from_world)
    face_index, depth = rasterization.rasterize(clip, faces, size, size)
    opposite = antialiasing.opposite_vertices(faces)
    scene = face_index, depth, clip, faces, opposite
    colour, grad_output = np.random.default_rng(0).normal(size=(2, size, size, 3))
    took = {
        "topology": median(antialiasing.opposite_vertices, faces),
        "pairs": median(antialiasing.blended_pairs, *scene),
        "forward": median(antialiasing.antialias, colour, *scene),
        "backward": median(antialiasing.antialias_backward, grad_output, colour, *scene),
        "copy": median(colour.copy),
    }
    return {"faces": len(faces), "pixels": f"{size}x{size}",
            "blended": len(antialiasing.blended_pairs(*scene)[0]),
            **{name: round(value, 1) for name, value in took.items()}}


def median(function, *arguments):
    """Milliseconds of a call, the median of RUNS after one to warm up."""
    function(*arguments)
    times = []
    for _ in range(RUNS):
        start = time.perf_counter()
        function(*arguments)
        times.append(1000 * (time.perf_counter() - start))
    return statistics.median(times)


if __name__ == "__main__":
    main()
