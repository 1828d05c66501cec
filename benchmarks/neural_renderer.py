"""The original's renderer and three silhouettes' gradients: python3 benchmarks/neural_renderer.py

The teapot, from both sides, with cubes of 4^3 texels, in 256 x 256 pixels; goal: 500 ms for a
picture. Medians of wall time, in milliseconds. Then a ball of 320 faces in 64 x 64 pixels: forward
and backward of its silhouette, by each of the three gradients.
"""
import platform
import statistics
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from course import demo, fits, mesh
from reference import neural_renderer, transforms

SIZE, TEXELS, ROUNDS = 256, 4, 5
LABS = demo.Labs("reference")


def main():
    print(f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}")
    rng, (vertices, faces) = np.random.default_rng(0), mesh.teapot()
    vertices, camera = mesh.normalize(vertices), fits.teapot_camera(LABS)
    textures = rng.random((len(faces), TEXELS, TEXELS, TEXELS, 3))
    faces, textures = neural_renderer.both_sides(faces, textures)
    lights = np.full(3, 0.5), np.full(3, 0.5), np.array([0.0, 1.0, 0.0])
    scene = vertices, faces, textures, camera, lights
    clip = transforms.transform(transforms.to_homogeneous(vertices), camera)
    corners = neural_renderer.corners_of(clip, faces)
    print(f"teapot, {SIZE} x {SIZE}")
    took("  three maps", lambda: neural_renderer.rasterize(corners, SIZE, SIZE))
    for samples in 1, 2:
        def picture(samples=samples):
            return neural_renderer.render(*scene, SIZE, SIZE, np.zeros(3), samples)

        took(f"  picture, {samples} x {samples} samples", picture)
    picture, buffers = neural_renderer.render(*scene, SIZE, SIZE, np.zeros(3), 1)
    grad_picture = rng.normal(size=picture.shape)
    took("  its gradients, 1 x 1",
         lambda: neural_renderer.render_backward(grad_picture, buffers, *scene, 1))

    print("silhouette, 320 faces, 64 x 64: forward and backward")
    ball, faces = mesh.icosphere(320)
    clip = transforms.transform(transforms.to_homogeneous(0.7 * ball), camera)
    goal = fits.teapot_mask(LABS, 64)
    for name, outline in fits.OUTLINES.items():
        def both(outline=outline):
            picture, backward = outline(LABS, clip, faces, 64)
            backward(picture - goal)

        took(f"  {name}", both)


def took(name, call):
    """Prints the median, after one call to warm up."""
    rounds = []
    for _ in range(ROUNDS + 1):
        start = time.perf_counter()
        call()
        rounds.append(1000 * (time.perf_counter() - start))
    print(f"{name:32}{statistics.median(rounds[1:]):9.1f}")


if __name__ == "__main__":
    main()
