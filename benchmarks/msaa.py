"""What antialiasing costs: python3 benchmarks/msaa.py

512 x 512 pixels, an icosphere of at least 10,000 faces with one colour for each. All are measured
in turn, round by round, so that whatever else the machine does falls on all alike. Ratios of the
medians, of the whole picture each time: to lab 2's `rasterize` alone, without any colour, and to
the picture with one sample.
"""
import platform
import statistics
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from course import mesh
from reference import msaa, rasterization, transforms

SIZE = 512
COUNTS = 1, 4, 8, 16
ROUNDS = 11


def main():
    vertices, faces = mesh.icosphere(10_000)
    clip_from_world = transforms.perspective(np.radians(48), 1.0, 0.1, 10.0)
    clip_from_world = clip_from_world @ transforms.translate(np.array([0.0, 0.0, -3.0]))
    clip = transforms.transform(transforms.to_homogeneous(vertices), clip_from_world)
    colours, background = np.random.default_rng(0).random((len(faces), 3)), np.ones(3)
    mesh_and_size = clip, faces, SIZE, SIZE

    def shade(px, py, face):
        return colours[face]

    calls = {"rasterize": lambda: rasterization.rasterize(*mesh_and_size),
             "1 sample": lambda: msaa.supersample(*mesh_and_size, 1, shade, background)}
    for count in COUNTS[1:]:
        pattern = msaa.standard_pattern(count)
        calls[f"{count}x MSAA"] = lambda pattern=pattern: msaa.msaa(
            *mesh_and_size, pattern, shade, background)
    calls["2 x 2 supersampling"] = lambda: msaa.supersample(*mesh_and_size, 2, shade, background)
    calls["4 x 4 supersampling"] = lambda: msaa.supersample(*mesh_and_size, 4, shade, background)
    report(len(faces), medians(calls))


def medians(calls):
    """{name: milliseconds}, after one round to warm up."""
    took = {name: [] for name in calls}
    for _ in range(ROUNDS + 1):
        for name, call in calls.items():
            start = time.perf_counter()
            call()
            took[name].append(1000 * (time.perf_counter() - start))
    return {name: statistics.median(times[1:]) for name, times in took.items()}


def report(face_count, took):
    print(f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}; "
          f"{face_count:,} faces, {SIZE} x {SIZE} pixels")
    print(f"{'':22}{'ms':>8}{'/ rasterize':>14}{'/ 1 sample':>14}")
    for name, time_ in took.items():
        print(f"{name:22}{time_:8.1f}{time_ / took['rasterize']:14.2f}"
              f"{time_ / took['1 sample']:14.2f}")


if __name__ == "__main__":
    main()
