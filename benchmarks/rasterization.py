"""How long lab 2 takes, and how it grows: python3 benchmarks/rasterization.py

Milliseconds as benchmarks/measure.py has them; written to out/benchmarks/rasterization.json as
well. "boxes" is the textbook's way on the same meshes, in NumPy: for every face all samples of its
bounding box, in chunks as large as `rasterize` has them.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from course.given import arrays
from reference import rasterization, scanline


def main():
    facts = measure.begin()
    rows = [row(count, 512) for count in measure.FACES]
    rows += [row(10_000, size) for size in measure.SIZES]
    measure.show(rows)
    measure.save("rasterization", facts, {"medians in ms": rows})


def row(face_count, size):
    """One row of the table."""
    _, faces, clip = measure.sphere(face_count)
    scene = clip, faces, size, size
    face_index, _ = scanline.rasterize(*scene)
    assert (face_index == boxes(*scene)[0]).all()
    picture = face_index, clip, faces
    took = measure.medians({
        "rasterize": lambda: scanline.rasterize(*scene),
        "barycentrics": lambda: rasterization.barycentrics(*picture),
        "derivatives": lambda: rasterization.barycentrics_derivatives(*picture),
        "boxes": lambda: boxes(*scene),
    })
    return {"faces": len(faces), "pixels": size**2, **took,
            "boxes / rasterize": took["boxes"] / took["rasterize"],
            "with barycentrics": 1 + took["barycentrics"] / took["rasterize"]}


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
    for part in arrays.chunks(columns * rows):
        face, number = arrays.expand(np.zeros(len(rows[part]), int), (columns * rows)[part])
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
