"""How long lab 8 takes, and how it grows: python3 benchmarks/antialiasing.py

Milliseconds as benchmarks/measure.py has them; written to out/benchmarks/antialiasing.json as well.
"copy" is what it takes to copy the picture, which each of both directions does once.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from reference import antialiasing, outlines, scanline


def main():
    facts = measure.begin()
    rows = [row(count, 512) for count in measure.FACES]
    rows += [row(10_000, size) for size in measure.SIZES]
    rows += [row(100_000, 2048)]  # the same faces in 16 times the pixels
    measure.show(rows)
    measure.save("antialiasing", facts, {"medians in ms": rows})


def row(face_count, size):
    """One row of the table."""
    _, faces, clip = measure.sphere(face_count)
    face_index, depth = scanline.rasterize(clip, faces, size, size)
    scene = face_index, depth, clip, faces, antialiasing.opposite_vertices(faces)
    colour, grad_output = np.random.default_rng(0).normal(size=(2, size, size, 3))
    took = measure.medians({
        "topology": lambda: antialiasing.opposite_vertices(faces),
        "pairs": lambda: outlines.blended_pairs(*scene),
        "forward": lambda: outlines.antialias(colour, *scene),
        "backward": lambda: outlines.antialias_backward(grad_output, colour, *scene),
        "copy": colour.copy,
    })
    return {"faces": len(faces), "pixels": size**2,
            "blended": len(outlines.blended_pairs(*scene)[0]), **took}


if __name__ == "__main__":
    main()
