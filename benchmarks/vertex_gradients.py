"""What the rasterizer's backward pass costs: python3 benchmarks/vertex_gradients.py

512 x 512 pixels. Milliseconds as benchmarks/measure.py has them; beside each backward pass the
forward pass of lab 2, and in brackets the growth.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from reference import rasterization, rasterizer_gradients, scanline

SIZE = 512


def main():
    facts = measure.begin()
    rows = [row(count) for count in measure.FACES]
    measure.show_growth("faces", rows)
    measure.save("vertex_gradients", facts, {"medians in ms": rows})


def row(face_count):
    """One column of the table."""
    _, faces, clip = measure.sphere(face_count)
    face_index, _ = scanline.rasterize(clip, faces, SIZE, SIZE)
    rng, picture = np.random.default_rng(0), (face_index, clip, faces)
    by_b, by_db, by_z = (rng.normal(size=(SIZE, SIZE, *shape)) for shape in ((3,), (3, 2), ()))
    lab7 = rasterizer_gradients
    return {"faces": len(faces), **measure.medians({
        "rasterize": lambda: scanline.rasterize(clip, faces, SIZE, SIZE),
        "d depth": lambda: lab7.depth_backward(by_z, *picture),
        "barycentrics": lambda: rasterization.barycentrics(*picture),
        "d barycentrics": lambda: lab7.barycentrics_backward(by_b, *picture),
        "derivatives": lambda: rasterization.barycentrics_derivatives(*picture),
        "d derivatives": lambda: lab7.barycentrics_derivatives_backward(by_db, *picture)})}


if __name__ == "__main__":
    main()
