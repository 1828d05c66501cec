"""What the rasterizer's backward pass costs: python3 benchmarks/vertex_gradients.py

512 x 512 pixels, icospheres of 1,000 to 100,000 faces that cover about three quarters of them. All
are measured in turn, round by round, so that whatever else the machine does falls on all alike.
Medians in milliseconds; beside them the forward passes of lab 2.
"""
import platform
import statistics
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from course import mesh
from reference import rasterization, transforms, vertex_gradients

SIZE = 512
FACES = 1_000, 10_000, 100_000
ROUNDS = 11


def main():
    print(f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}")
    columns = [medians(calls(count)) for count in FACES]
    print(f"{'faces':32}" + "".join(f"{count:10,}" for count in FACES))
    for name in columns[0]:
        print(f"{name:32}" + "".join(f"{took[name]:10.1f}" for took in columns))


def calls(face_count):
    """{name: a call to measure}."""
    vertices, faces = mesh.icosphere(face_count)
    clip_from_world = transforms.perspective(np.radians(50), 1.0, 0.1, 10.0)
    clip_from_world = clip_from_world @ transforms.translate(np.array([0.0, 0.0, -2.4]))
    clip = transforms.transform(transforms.to_homogeneous(vertices), clip_from_world)
    face_index, _ = rasterization.rasterize(clip, faces, SIZE, SIZE)
    rng, picture = np.random.default_rng(0), (face_index, clip, faces)
    by_b, by_db, by_z = (rng.normal(size=(SIZE, SIZE, *shape)) for shape in ((3,), (3, 2), ()))
    backward = vertex_gradients
    return {"rasterize": lambda: rasterization.rasterize(clip, faces, SIZE, SIZE),
            "barycentrics": lambda: rasterization.barycentrics(*picture),
            "  backward": lambda: backward.barycentrics_backward(by_b, *picture),
            "barycentrics_derivatives": lambda: rasterization.barycentrics_derivatives(*picture),
            "   backward": lambda: backward.barycentrics_derivatives_backward(by_db, *picture),
            "depth: backward": lambda: backward.depth_backward(by_z, *picture)}


def medians(calls):
    """{name: milliseconds}, after one round to warm up."""
    took = {name: [] for name in calls}
    for _ in range(ROUNDS + 1):
        for name, call in calls.items():
            start = time.perf_counter()
            call()
            took[name].append(1000 * (time.perf_counter() - start))
    return {name: statistics.median(times[1:]) for name, times in took.items()}


if __name__ == "__main__":
    main()
