"""What a look-up costs, and its gradients: python3 benchmarks/texturing.py

512 x 512 pixels, all covered, 3 channels, a texture of 1024 x 1024, turned by some degrees; the
pixels are about two texels wide. Milliseconds as benchmarks/measure.py has them.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from reference import mipmapping

PIXELS, TEXELS = 512, 1024


def main():
    facts = measure.begin()
    rows = [row(filter) for filter in mipmapping.FILTERS]
    measure.show(rows)
    measure.save("texturing", facts, {"medians in ms": rows})


def row(filter):
    """One row of the table."""
    rng = np.random.default_rng(0)
    image, grad_colour = rng.random((TEXELS, TEXELS, 3)), rng.normal(size=(PIXELS, PIXELS, 3))
    turn = np.array([[0.9, 0.2], [-0.2, 0.9]])
    row, column = (np.indices((PIXELS, PIXELS)) + 0.5) / PIXELS
    uv = np.stack([column, row], -1) @ turn.T
    jacobian = np.broadcast_to(turn / PIXELS, (PIXELS, PIXELS, 2, 2)).copy()
    asked = image, uv, jacobian if "mipmap" in filter else None, 0.0, filter
    return {"filter": filter, **measure.medians({
        "forward": lambda: mipmapping.texture(*asked),
        "backward": lambda: mipmapping.texture_backward(grad_colour, *asked)})}


if __name__ == "__main__":
    main()
