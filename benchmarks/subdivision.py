"""What a step of subdivision costs: python3 benchmarks/subdivision.py

The topology with its checks, the sparse matrix S, the new points and the new faces, all from
scratch. Milliseconds as benchmarks/measure.py has them; the bar is 600 for 100,000 triangles, 800
for 50,000 quads. Where libigl and trimesh are installed, their step of Loop stands beside; they
check nothing, and trimesh has Loop's own weights.
"""
import importlib.util
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from course.given import mesh
from reference import catmull_clark, loop_subdivision


def main():
    facts, rows = measure.begin(), []
    for count in measure.FACES:
        vertices, faces = mesh.torus(count)
        peers = {name: lambda step=step, given=(vertices, faces): step(*given)
                 for name, step in (("igl", libigl), ("trimesh", trimesh))
                 if importlib.util.find_spec(name)}
        rows.append(row("Loop", vertices, loop_subdivision.loop,
                        loop_subdivision.loop_matrix, faces, peers=peers))
    for side in 22, 71, 224:
        vertices, *polygons = quads(side)
        rows.append(row("Catmull-Clark", vertices, catmull_clark.catmull_clark,
                        catmull_clark.catmull_clark_matrix, *polygons))
    measure.show(rows)
    measure.save("subdivision", facts, {"medians in ms": rows})


def row(name, vertices, step, matrix, *faces, peers=None):
    """One row of the table."""
    S = matrix(*faces, len(vertices))
    new = S @ vertices
    return {"scheme": name, "faces": len(faces[-1]), **measure.medians({
        "step": lambda: step(vertices, *faces),
        "S alone": lambda: matrix(*faces, len(vertices)),
        "S @ x": lambda: S @ vertices,
        "S.T @ g": lambda: S.T @ new, **(peers or {})})}


def quads(n):
    """A closed ring of n x n quads -> vertices, corners, counts."""
    y, x = np.divmod(np.arange(n * n), n)
    right, above = (x + 1) % n, (y + 1) % n
    corners = np.stack([y * n + x, y * n + right, above * n + right, above * n + x], axis=1)
    a, b = 2 * np.pi * x / n, 2 * np.pi * y / n
    vertices = np.stack([(2 + np.cos(b)) * np.cos(a), (2 + np.cos(b)) * np.sin(a), np.sin(b)], 1)
    return vertices, corners.ravel(), np.full(n * n, 4)


def libigl(vertices, faces):
    import igl
    return igl.loop(vertices, faces, 1)


def trimesh(vertices, faces):
    import trimesh
    return trimesh.remesh.subdivide_loop(vertices, faces, 1)


if __name__ == "__main__":
    main()
