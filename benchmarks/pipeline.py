"""What the differentiable pipeline costs, stage by stage: python3 benchmarks/pipeline.py

Rasterize, barycentrics, interpolate 3 attributes, antialias; then their backward passes, from the
picture to clip positions and attributes.
"render" and "d render" are `pipeline.render` and its backward pass, from positions to a picture and
back: the stages and what joins them. Milliseconds as benchmarks/measure.py has them. Also in
out/benchmarks/pipeline.json.

benchmarks/peers.py sets the whole beside other renderers.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks import measure
from reference import (
    antialiasing,
    interpolation,
    outlines,
    pipeline,
    rasterization,
    rasterizer_gradients,
)


def main():
    facts = measure.begin()
    rows = {"faces": [row(count, 512) for count in measure.FACES],
            "pixels": [row(10_000, size) for size in measure.SIZES]}
    for table in rows.values():
        measure.show(table)
    measure.save("pipeline", facts, {"medians in ms": rows})


def row(face_count, size):
    """{what: number}: one row of the table."""
    vertices, faces, clip = measure.sphere(face_count)
    attributes = np.random.default_rng(0).random((len(vertices), 3))
    took = measure.medians(stages(clip, faces, attributes, size))
    whole = measure.medians(renders(vertices, faces, attributes, size))
    forward = sum(value for name, value in took.items() if not name.startswith("d "))
    return {"faces": len(faces), "pixels": size * size, **took, "forward": forward,
            "backward": sum(took.values()) - forward, "all": sum(took.values()), **whole}


def stages(clip, faces, attributes, size):
    """{stage: call}, in order; "d " are the backward passes. Each gets what came before it."""
    opposite = antialiasing.opposite_corners(faces)  # once for a mesh
    face_index, depth = rasterization.rasterize(clip, faces, size, size)
    barycentric = interpolation.barycentrics(face_index, clip, faces)
    colour = interpolation.interpolate(attributes, faces, face_index, barycentric)
    grad = np.random.default_rng(1).normal(size=colour.shape)
    edges = face_index, depth, clip, faces, opposite
    grad_barycentric = interpolation.interpolate_backward(grad, attributes, faces, face_index,
                                                          barycentric)[1]
    return {
        "rasterize": lambda: rasterization.rasterize(clip, faces, size, size),
        "barycentrics": lambda: interpolation.barycentrics(face_index, clip, faces),
        "interpolate": lambda: interpolation.interpolate(attributes, faces, face_index,
                                                         barycentric),
        "antialias": lambda: outlines.antialias(colour, *edges),
        "d antialias": lambda: outlines.antialias_backward(grad, colour, *edges),
        "d interpolate": lambda: interpolation.interpolate_backward(grad, attributes, faces,
                                                                    face_index, barycentric),
        "d barycentrics": lambda: rasterizer_gradients.barycentrics_backward(grad_barycentric,
                                                                         face_index, clip, faces),
    }


def renders(vertices, faces, attributes, size):
    """{name: call}: the pipeline's `render` and its backward pass."""
    scene = (pipeline.make_mesh(vertices, faces), pipeline.Colours(attributes),
             pipeline.View(measure.CLIP_FROM_WORLD, size, size, np.zeros(3)))
    picture, buffers = pipeline.render(*scene)
    grad = np.random.default_rng(1).normal(size=picture.shape)
    return {"render": lambda: pipeline.render(*scene),
            "d render": lambda: pipeline.render_backward(grad, buffers, *scene)}


if __name__ == "__main__":
    main()
