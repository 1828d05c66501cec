"""What antialiasing costs: python3 benchmarks/msaa.py

512 x 512 pixels, an icosphere of at least 10,000 faces with one colour for each. Milliseconds as
benchmarks/measure.py has them, of the whole picture each time, and ratios: to lab 2's `rasterize`
alone, without any colour, and to the picture with one sample.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from reference import msaa, scanline

SIZE = 512
COUNTS = 4, 8, 16


def main():
    facts = measure.begin()
    _, faces, clip = measure.sphere(10_000)
    took = measure.medians(calls(clip, faces))
    rows = [{"": name, "ms": ms, "/ rasterize": ms / took["rasterize"],
             "/ 1 sample": ms / took["1 sample"]} for name, ms in took.items()]
    measure.show(rows)
    measure.save("msaa", facts, {"faces": len(faces), "medians": rows})


def calls(clip, faces):
    """{name: call}"""
    scene = clip, faces, SIZE, SIZE
    colours, background = np.random.default_rng(0).random((len(faces), 3)), np.ones(3)

    def shade(px, py, face):
        return colours[face]

    def supersampled(count):
        return lambda: msaa.supersample(*scene, count, shade, background)

    def multisampled(count):
        return lambda: msaa.msaa(*scene, msaa.standard_pattern(count), shade, background)

    return {"rasterize": lambda: scanline.rasterize(*scene), "1 sample": supersampled(1),
            **{f"{count}x MSAA": multisampled(count) for count in COUNTS},
            **{f"{count} x {count} supersampling": supersampled(count) for count in (2, 4)}}


if __name__ == "__main__":
    main()
