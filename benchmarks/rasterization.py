"""How long lab 2 takes, and how it grows: python3 benchmarks/rasterization.py

Medians of several runs on one core, in milliseconds; written to out/benchmarks/rasterization.json
as well. "boxes" is the textbook's way on the same meshes, in NumPy: for every face all samples of
its bounding box, in chunks as large as `rasterize` has them. The ratio to it says more than a time
does on another machine.
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
from reference import rasterization, transforms

FACES = 1_000, 10_000, 100_000
SIZES = 256, 512, 1024, 2048
RUNS = 9


def main():
    rows = [measure(count, 512) for count in FACES] + [measure(10_000, size) for size in SIZES]
    columns = ("faces", "pixels", "rasterize", "barycentrics", "derivatives", "boxes",
               "boxes/rasterize")
    print(f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}")
    print("".join(f"{name:>16}" for name in columns))
    for row in rows:
        print("".join(f"{row[name]:>16}" for name in columns))
    path = places.out("benchmarks", "rasterization.json")
    machine = {"machine": platform.machine(), "system": platform.platform(),
               "python": platform.python_version(), "numpy": np.__version__}
    places.write_whole(path, json.dumps({**machine, "medians in ms": rows}, indent=1).encode())
    print(f"written to {path}")


def measure(face_count, size):
    """One row of the table: an icosphere that fills four fifths of the height."""
    vertices, faces = mesh.icosphere(face_count)
    clip_from_world = transforms.perspective(np.radians(48), 1.0, 0.1, 10.0)
    clip_from_world = clip_from_world @ transforms.translate(np.array([0.0, 0.0, -3.0]))
    clip = transforms.transform(transforms.to_homogeneous(vertices), clip_from_world)
    face_index, _ = rasterization.rasterize(clip, faces, size, size)
    assert (face_index == boxes(clip, faces, size, size)[0]).all()
    took = {
        "rasterize": median(rasterization.rasterize, clip, faces, size, size),
        "barycentrics": median(rasterization.barycentrics, face_index, clip, faces),
        "derivatives": median(rasterization.barycentrics_derivatives, face_index, clip, faces),
        "boxes": median(boxes, clip, faces, size, size),
    }
    ratio = took["boxes"] / took["rasterize"]
    return {"faces": len(faces), "pixels": f"{size}x{size}",
            **{name: round(value, 1) for name, value in took.items()},
            "boxes/rasterize": round(ratio, 2)}


def median(function, *arguments):
    """Milliseconds of a call, the median of RUNS after one to warm up."""
    function(*arguments)
    times = []
    for _ in range(RUNS):
        start = time.perf_counter()
        function(*arguments)
        times.append(1000 * (time.perf_counter() - start))
    return statistics.median(times)


def boxes(clip, faces, width, height):
    """Face index and depth by testing every sample of every face's bounding box; all w > 0."""
    x, y, w = rasterization.screen_points(clip, width, height)
    corners = faces.T
    x, y, z = x[corners], y[corners], (clip[:, 2] / w)[corners]
    left, low = (np.clip(np.ceil(v.min(0) - 0.5), 0, None).astype(int) for v in (x, y))
    right, high = (np.clip(np.floor(v.max(0) + 0.5), 0, size).astype(int)
                   for v, size in ((x, width), (y, height)))
    columns, rows = np.maximum(right - left, 0), np.maximum(high - low, 0)
    face_index, depth = np.full(height * width, -1), np.full(height * width, np.inf)
    for part in rasterization.chunks(columns * rows):
        face, number = rasterization.expand(np.zeros(len(rows[part]), int), (columns * rows)[part])
        row, column = np.divmod(number, columns[part][face])
        row, column, face = row + low[part][face], column + left[part][face], face + part.start
        px, py = column + 0.5, row + 0.5
        e = [(y[i] - y[j])[face] * (px - x[i][face]) + (x[j] - x[i])[face] * (py - y[i][face])
             for i, j in rasterization.EDGES]
        inside = ((e[0] > 0) & (e[1] > 0) & (e[2] > 0)) | ((e[0] < 0) & (e[1] < 0) & (e[2] < 0))
        face, pixel = face[inside], (row * width + column)[inside]
        e = [value[inside] for value in e]
        d = sum(e[k] * z[k][face] for k in range(3)) / (e[0] + e[1] + e[2])
        np.minimum.at(depth, pixel, d)
        seen = d == depth[pixel]
        face_index[pixel[seen]] = face[seen]
    return face_index.reshape(height, width), depth.reshape(height, width)


if __name__ == "__main__":
    main()
