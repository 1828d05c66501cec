"""How long lab 15 takes, and how it grows: python3 benchmarks/implicit_surfaces.py

Milliseconds as benchmarks/measure.py has them; written to out/benchmarks/implicit_surfaces.json as
well. "gather" is what it takes to look up the sign at the four corners of all tetrahedra once,
which marching cannot do without. The goal is 500 ms for 64^3 cells.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from course.given.whose import Labs
from course.scenes import representations
from reference import implicit_surfaces, marching_tetrahedra

CELLS = 16, 32, 64, 96
SAMPLES = 16, 64, 256
TORUS = ("torus", 0.6, 0.25)
LABS = Labs("reference")


def main():
    facts = measure.begin()
    tables = {"a torus by marching tetrahedra": [march(n) for n in CELLS],
              "10,000 rays through a volume": [rays(count) for count in SAMPLES],
              "the hand wheel by sphere tracing": [trace(size) for size in (64, 128, 256)]}
    for title, rows in tables.items():
        print(f"\n{title}", end="")
        measure.show(rows)
    measure.save("implicit_surfaces", facts, tables)


def march(n):
    """One row: n^3 cells, 6 n^3 tetrahedra."""
    points, tetrahedra = marching_tetrahedra.tetrahedral_grid(n)
    distance = implicit_surfaces.signed_distance(points, TORUS)
    vertices, faces, ends = marching_tetrahedra.marching_tetrahedra(points, distance, tetrahedra)
    inside = distance < 0
    took = measure.medians({
        "grid": lambda: marching_tetrahedra.tetrahedral_grid(n),
        "forward": lambda: marching_tetrahedra.marching_tetrahedra(points, distance, tetrahedra),
        "backward": lambda: marching_tetrahedra.marching_tetrahedra_backward(
            vertices, ends, points, distance),
        "gather": lambda: inside[tetrahedra]})
    return {"cells": f"{n}^3", "faces": len(faces), **took,
            "forward / gather": took["forward"] / took["gather"]}


def rays(count):
    """One row: count samples on each of 10,000 rays."""
    rng = np.random.default_rng(0)
    density, colour = rng.random((10_000, count)), rng.random((10_000, count, 3))
    given = density, colour, np.full(density.shape, 1 / count), np.ones(3)
    grad_output = rng.normal(size=(10_000, 3))
    return {"samples": count, **measure.medians({
        "forward": lambda: implicit_surfaces.volume_render(*given),
        "backward": lambda: implicit_surfaces.volume_render_backward(grad_output, *given)})}


def trace(size):
    """One row: size x size rays."""
    camera = representations.wheel_camera(LABS)
    origins, directions = implicit_surfaces.camera_rays(camera, size, size)
    given = origins, directions, representations.WHEEL, 9.0
    _, evaluations = implicit_surfaces.sphere_trace(*given)
    return {"pixels": f"{size}x{size}", "steps a ray": float(evaluations.mean()),
            **measure.medians({"forward": lambda: implicit_surfaces.sphere_trace(*given)})}


if __name__ == "__main__":
    main()
