"""How long lab 5 takes: python3 benchmarks/interpolation.py

512 x 512 pixels, three attributes. Milliseconds as benchmarks/measure.py has them. "add.at" is the
obvious backward pass in NumPy, without the matrix.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from reference import interpolation, rasterization, scanline

SIZE = 512


def main():
    facts = measure.begin()
    rows = [row(count) for count in (100, *measure.FACES)]
    measure.show(rows)
    measure.save("interpolation", facts, {"medians in ms": rows})


def row(face_count):
    """One row of the table."""
    vertices, faces, clip = measure.sphere(face_count)
    face_index, _ = scanline.rasterize(clip, faces, SIZE, SIZE)
    mixed = vertices, faces, face_index, rasterization.barycentrics(face_index, clip, faces)
    sloped = *mixed[:3], rasterization.barycentrics_derivatives(face_index, clip, faces)
    rng = np.random.default_rng(0)
    grad, grad_sloped = (rng.normal(size=(SIZE, SIZE, 3, *axes)) for axes in ((), (2,)))
    return {"faces": len(faces), **measure.medians({
        "forward": lambda: interpolation.interpolate(*mixed),
        "backward": lambda: interpolation.interpolate_backward(grad, *mixed),
        "derivatives": lambda: interpolation.interpolate_derivatives(*sloped),
        "their backward": lambda: interpolation.interpolate_derivatives_backward(
            grad_sloped, *sloped),
        "add.at": lambda: scattered(grad, *mixed)})}


def scattered(grad_output, attributes, faces, face_index, barycentric):
    """`interpolate_backward` by np.add.at."""
    seen = face_index >= 0
    corners, weights, grad_seen = faces[face_index[seen]], barycentric[seen], grad_output[seen]
    grad_attributes, grad_barycentric = np.zeros(attributes.shape), np.zeros(barycentric.shape)
    np.add.at(grad_attributes, corners, weights[:, :, None] * grad_seen[:, None])
    grad_barycentric[seen] = (grad_seen[:, None] * attributes[corners]).sum(-1)
    return grad_attributes, grad_barycentric


if __name__ == "__main__":
    main()
