"""What a look-up costs, and its gradients: python3 benchmarks/texturing.py

512 x 512 pixels, all covered, 3 channels, a texture of 1024 x 1024, turned by some degrees; the
pixels are about two texels wide. Medians, in milliseconds.
"""
import platform
import statistics
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from reference import texturing

PIXELS, TEXELS, ROUNDS = 512, 1024, 11


def main():
    rng = np.random.default_rng(0)
    image, grad_colour = rng.random((TEXELS, TEXELS, 3)), rng.normal(size=(PIXELS, PIXELS, 3))
    turn = np.array([[0.9, 0.2], [-0.2, 0.9]])
    row, column = (np.indices((PIXELS, PIXELS)) + 0.5) / PIXELS
    uv = np.stack([column, row], -1) @ turn.T
    jacobian = np.broadcast_to(turn / PIXELS, (PIXELS, PIXELS, 2, 2)).copy()
    print(f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}; "
          f"{PIXELS} x {PIXELS} pixels, {TEXELS} x {TEXELS} texels, 3 channels")
    print(f"{'ms':24}{'forward':>10}{'backward':>10}")
    for filter in texturing.FILTERS:
        arguments = image, uv, jacobian if "mipmap" in filter else None, 0.0, filter
        forward = median(lambda given=arguments: texturing.texture(*given))
        backward = median(lambda given=arguments: texturing.texture_backward(grad_colour, *given))
        print(f"{filter:24}{forward:10.1f}{backward:10.1f}")


def median(call):
    """Milliseconds, after one call to warm up."""
    took = []
    for _ in range(ROUNDS + 1):
        start = time.perf_counter()
        call()
        took.append(1000 * (time.perf_counter() - start))
    return statistics.median(took[1:])


if __name__ == "__main__":
    main()
