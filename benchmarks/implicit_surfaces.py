"""How long lab 15 takes, and how it grows: python3 benchmarks/implicit_surfaces.py

Medians of several runs on one core, in milliseconds; written to
out/benchmarks/implicit_surfaces.json as well. "gather" is what it takes to look up the sign at the
four corners of all tetrahedra once, which marching cannot do without: the ratio to it says more
than a time does on another machine. The goal is 500 ms for 64^3 cells.
"""
import json
import platform
import statistics
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from course import demo, places
from reference import implicit_surfaces, transforms

CELLS = 16, 32, 64, 96
SAMPLES = 16, 64, 256
RUNS = 7
TORUS = ("torus", 0.6, 0.25)


class Labs:
    """What demo.wheel_camera asks of."""

    transforms = transforms


def main():
    print(f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}")
    tables = {"a torus by marching tetrahedra": [march(n) for n in CELLS],
              "10,000 rays through a volume": [rays(count) for count in SAMPLES],
              "the hand wheel by sphere tracing": [trace(size) for size in (64, 128, 256)]}
    for title, rows in tables.items():
        print(f"\n{title}")
        print("".join(f"{name:>16}" for name in rows[0]))
        for row in rows:
            print("".join(f"{value:>16}" for value in row.values()))
    path = places.out("benchmarks", "implicit_surfaces.json")
    places.write_whole(path, json.dumps(tables, indent=1).encode())
    print(f"\nwritten to {path}")


def march(n):
    """One row: n^3 cells, 6 n^3 tetrahedra."""
    points, tetrahedra = implicit_surfaces.tetrahedral_grid(n)
    distance = implicit_surfaces.signed_distance(points, TORUS)
    vertices, faces, ends = implicit_surfaces.marching_tetrahedra(points, distance, tetrahedra)
    took = {"grid": median(implicit_surfaces.tetrahedral_grid, n),
            "forward": median(implicit_surfaces.marching_tetrahedra, points, distance, tetrahedra),
            "backward": median(implicit_surfaces.marching_tetrahedra_backward, vertices, ends,
                               points, distance),
            "gather": median((distance < 0).__getitem__, tetrahedra)}
    return {"cells": f"{n}^3", "faces": len(faces), **rounded(took),
            "forward/gather": round(took["forward"] / took["gather"], 1)}


def rays(count):
    """One row: count samples on each of 10,000 rays."""
    rng = np.random.default_rng(0)
    density, colour = rng.random((10_000, count)), rng.random((10_000, count, 3))
    given = density, colour, np.full(density.shape, 1 / count), np.ones(3)
    grad_output = rng.normal(size=(10_000, 3))
    return {"samples": count,
            **rounded({"forward": median(implicit_surfaces.volume_render, *given),
                       "backward": median(implicit_surfaces.volume_render_backward, grad_output,
                                          *given)})}


def trace(size):
    """One row: size x size rays."""
    origins, directions = implicit_surfaces.camera_rays(demo.wheel_camera(Labs), size, size)
    given = origins, directions, demo.WHEEL, 9.0
    _, evaluations = implicit_surfaces.sphere_trace(*given)
    return {"pixels": f"{size}x{size}", "steps a ray": round(evaluations.mean(), 1),
            **rounded({"forward": median(implicit_surfaces.sphere_trace, *given)})}


def rounded(took):
    return {name: round(value, 1) for name, value in took.items()}


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
