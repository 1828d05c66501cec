"""How long lab 5 takes: python3 benchmarks/interpolation.py

512 x 512 pixels, an icosphere that fills four fifths of the height, three attributes. Milliseconds,
medians over ROUNDS; all are measured in turn, round by round, so that whatever else the machine
does falls on all alike. "add.at" is the obvious backward pass in NumPy, without the matrix.
"""
import platform
import statistics
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from course import mesh
from reference import interpolation, rasterization, transforms

SIZE = 512
FACES = 100, 10_000, 100_000
ROUNDS = 15


def main():
    print(f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}")
    for count in FACES:
        took = measure(count)
        print(f"{count:>8} faces" + "".join(f"   {name} {ms:.1f}" for name, ms in took.items()))


def measure(face_count):
    """{name: milliseconds}, the medians."""
    vertices, faces = mesh.icosphere(face_count)
    clip_from_world = transforms.perspective(np.radians(48), 1.0, 0.1, 10.0)
    clip_from_world = clip_from_world @ transforms.translate(np.array([0.0, 0.0, -3.0]))
    clip = transforms.transform(transforms.to_homogeneous(vertices), clip_from_world)
    face_index, _ = rasterization.rasterize(clip, faces, SIZE, SIZE)
    mixed = vertices, faces, face_index, rasterization.barycentrics(face_index, clip, faces)
    sloped = *mixed[:3], rasterization.barycentrics_derivatives(face_index, clip, faces)
    rng = np.random.default_rng(0)
    grad, grad_sloped = (rng.normal(size=(SIZE, SIZE, 3, *axes)) for axes in ((), (2,)))
    calls = {"forward": lambda: interpolation.interpolate(*mixed),
             "backward": lambda: interpolation.interpolate_backward(grad, *mixed),
             "derivatives": lambda: interpolation.interpolate_derivatives(*sloped),
             "their backward": lambda: interpolation.interpolate_derivatives_backward(
                 grad_sloped, *sloped),
             "add.at": lambda: scattered(grad, *mixed)}
    times = {name: [] for name in calls}
    for _ in range(ROUNDS):
        for name, call in calls.items():
            start = time.perf_counter()
            call()
            times[name].append(1000 * (time.perf_counter() - start))
    return {name: statistics.median(taken) for name, taken in times.items()}


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
