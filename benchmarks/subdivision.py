"""What a step of subdivision costs: python3 benchmarks/subdivision.py

The topology with its checks, the sparse matrix S, the new points and the new faces, all from
scratch. Milliseconds; the bar is 600 for 100,000 triangles, 800 for 50,000 quads. Medians, and of
a step the time on the processor as well: on a machine with other work, the rest is waiting. Where
libigl and trimesh are installed, their step of Loop stands below; they check nothing, and trimesh
has Loop's own weights.
"""
import importlib.util
import platform
import statistics
import sys
import time
from pathlib import Path

import numpy as np
import scipy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from course import mesh
from reference import subdivision

ROUNDS = 7


def quads(n):
    """A closed ring of n x n quads -> vertices, corners, counts."""
    y, x = np.divmod(np.arange(n * n), n)
    right, above = (x + 1) % n, (y + 1) % n
    corners = np.stack([y * n + x, y * n + right, above * n + right, above * n + x], axis=1)
    a, b = 2 * np.pi * x / n, 2 * np.pi * y / n
    vertices = np.stack([(2 + np.cos(b)) * np.cos(a), (2 + np.cos(b)) * np.sin(a), np.sin(b)], 1)
    return vertices, corners.ravel(), np.full(n * n, 4)


def main():
    print(f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}, "
          f"SciPy {scipy.__version__}")
    columns = "faces", "step", "its CPU", "S alone", "S @ x", "S.T @ g"
    print(f"{'ms':16}" + "".join(f"{column:>9}" for column in columns))
    for count in 1_000, 10_000, 100_000:
        vertices, faces = mesh.torus(count)
        row("Loop", len(faces), vertices, subdivision.loop, subdivision.loop_matrix, faces)
        for name, step in (("igl", libigl), ("trimesh", trimesh)):
            if importlib.util.find_spec(name):
                times(name, len(faces), step, vertices, faces)
    for side in 22, 71, 224:
        vertices, *polygons = quads(side)
        row("Catmull-Clark", side**2, vertices,
            subdivision.catmull_clark, subdivision.catmull_clark_matrix, *polygons)


def libigl(vertices, faces):
    import igl
    return igl.loop(vertices, faces, 1)


def trimesh(vertices, faces):
    import trimesh
    return trimesh.remesh.subdivide_loop(vertices, faces, 1)


def row(name, count, vertices, step, matrix, *faces):
    S = matrix(*faces, len(vertices))
    new = S @ vertices
    times(name, count, step, vertices, *faces, more=[
        lambda: matrix(*faces, len(vertices)), lambda: S @ vertices, lambda: S.T @ new])


def times(name, count, step, vertices, *faces, more=()):
    milliseconds = [median(lambda: step(vertices, *faces)),
                    median(lambda: step(vertices, *faces), time.process_time), *map(median, more)]
    print(f"{name:16}{count:9,}" + "".join(f"{took:9.1f}" for took in milliseconds))


def median(call, clock=time.perf_counter):
    """Milliseconds, after one call to warm up."""
    took = []
    for _ in range(ROUNDS + 1):
        start = clock()
        call()
        took.append(1000 * (clock() - start))
    return statistics.median(took[1:])


if __name__ == "__main__":
    main()
