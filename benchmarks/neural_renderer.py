"""The original's renderer and three silhouettes' gradients: python3 benchmarks/neural_renderer.py

The teapot, from both sides, with cubes of 4^3 texels, in 256 x 256 pixels; goal: 500 ms for a
picture. Then a ball of 320 faces in 64 x 64 pixels: forward and backward of its silhouette, by each
of the three gradients. Milliseconds as benchmarks/measure.py has them.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from course.given import mesh
from course.given.whose import Labs
from course.scenes import fit_outlines
from reference import neural_renderer, pipeline, sweep_gradient, texture_cubes

SIZE, TEXELS = 256, 4
LABS = Labs("reference")


def main():
    facts = measure.begin()
    took = measure.medians(pictures() | silhouettes(), runs=5)
    rows = [{"": name, "ms": ms} for name, ms in took.items()]
    measure.show(rows)
    measure.save("neural_renderer", facts, {"medians": rows})


def pictures():
    """{name: call}"""
    rng, (vertices, faces) = np.random.default_rng(0), mesh.teapot()
    vertices, camera = mesh.normalize(vertices), fit_outlines.teapot_camera(LABS)
    textures = rng.random((len(faces), TEXELS, TEXELS, TEXELS, 3))
    lights = texture_cubes.Lights(np.full(3, 0.5), np.full(3, 0.5), np.array([0.0, 1.0, 0.0]))
    scene = texture_cubes.LitMesh(vertices, *texture_cubes.both_sides(faces, textures), lights)
    view = pipeline.View(camera, SIZE, SIZE, np.zeros(3))
    picture, buffers = texture_cubes.render(scene, view, 1)
    grad_picture = rng.normal(size=picture.shape)
    return {
        "three maps": lambda: neural_renderer.rasterize(buffers.corners, SIZE, SIZE),
        "teapot, 1 x 1 samples": lambda: texture_cubes.render(scene, view, 1),
        "teapot, 2 x 2 samples": lambda: texture_cubes.render(scene, view, 2),
        "its gradients, 1 x 1": lambda: texture_cubes.render_backward(
            grad_picture, buffers, scene, view, sweep_gradient.sweep_backward, 1)}


def silhouettes():
    """{name: call}"""
    ball, faces = mesh.icosphere(320)
    clip = LABS.pipeline.to_clip(0.7 * ball, fit_outlines.teapot_camera(LABS))
    goal = fit_outlines.teapot_mask(LABS, 64)

    def both(outline):
        picture, backward = outline(LABS, clip, faces, 64)
        backward(picture - goal)

    return {f"silhouette by {name}": lambda outline=outline: both(outline)
            for name, outline in fit_outlines.OUTLINES.items()}


if __name__ == "__main__":
    main()
