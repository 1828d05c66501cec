"""How long lab 2 takes, and how it grows: python3 benchmarks/rasterization.py

Medians of several runs on one core, in milliseconds; written to out/benchmarks/rasterization.json
as well. "boxes" is the textbook's way on the same meshes, in NumPy: for every face all samples of
its bounding box. The ratio to it says more than a time does on another machine.
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
    places.write_whole(path, json.dumps(rows, indent=1).encode())
    print(f"written to {path}")


def measure(face_count, size):
    """One row of the table: an icosphere that fills four fifths of the height."""
    vertices, faces = mesh.icosphere(face_count)
    clip_from_world = transforms.perspective(np.radians(48), 1.0, 0.1, 10.0)
    clip_from_world = clip_from_world @ transforms.translate(np.array([0.0, 0.0, -3.0]))
    clip = transforms.transform(transforms.to_homogeneous(vertices), clip_from_world)
    face_index, _ = rasterization.rasterize(clip, faces, size, size)
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
    """Face index and depth by testing every sample of every bounding box, all at once."""
    x, y, w = rasterization.screen_points(clip, width, height)
    x, y, z = x[faces.T], y[faces.T], (clip[:, 2] / w)[faces.T]
    left, right = (np.clip(f(x, axis=0), 0, width).astype(int) for f in (np.min, np.max))
    low, high = (np.clip(f(y, axis=0), 0, height).astype(int) for f in (np.min, np.max))
    face, row = rasterization.expand(low, high - low + 1)
    face_, column = rasterization.expand(left[face], (right - left + 1)[face])
    face, row = face[face_], row[face_]
    px, py = column + 0.5, row + 0.5
    e = [(y[i] - y[j])[face] * (px - x[i][face]) + (x[j] - x[i])[face] * (py - y[i][face])
         for i, j in rasterization.EDGES]
    inside = ((e[0] > 0) & (e[1] > 0) & (e[2] > 0)) | ((e[0] < 0) & (e[1] < 0) & (e[2] < 0))
    inside &= (row < height) & (column < width)
    area = e[0] + e[1] + e[2]
    depth = sum(e[k] * z[k][face] for k in range(3))[inside] / area[inside]
    pixel, face = (row * width + column)[inside], face[inside]
    order = np.argsort(-depth, kind="stable")
    face_index, depths = np.full(height * width, -1), np.full(height * width, np.inf)
    face_index[pixel[order]], depths[pixel[order]] = face[order], depth[order]
    return face_index.reshape(height, width), depths.reshape(height, width)


if __name__ == "__main__":
    main()
