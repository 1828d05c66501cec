"""A ball becomes a ring: the distances in a grid change their sign, and a hole opens (lab 15)."""
import numpy as np

from ..given import mesh
from ..given.arrays import scatter
from .drawing import SIZE, save, smooth
from .representations import wheel_camera

RING = "torus", 0.55, 0.25


def hole(labs):
    """A ball becomes a ring by descent on the distances in a grid (lab 15)."""
    clip_from_world = wheel_camera(labs)
    for step, (vertices, faces, _) in enumerate(pushed(labs, 20, 150)):
        if step % 50 == 0:
            clip = labs.pipeline.to_clip(vertices, clip_from_world)
            yield (f"step {step}: {len(faces):,} faces",
                   save("hole", f"step_{step}", smooth(labs, vertices, faces, clip, SIZE // 2)))
    euler = len(vertices) - len(faces) // 2
    yield f"V - E + F = {euler}", None, ("0, a ring", euler == 0)


def pushed(labs, n, steps):
    """Yields vertices, faces and distance of n^3 cells before each step, and at the end."""
    lab15 = labs.marching_tetrahedra
    points, tetrahedra = lab15.tetrahedral_grid(n)
    distance = labs.implicit_surfaces.signed_distance(points, ("sphere", 0.85))
    for _ in range(steps + 1):
        vertices, faces, ends = lab15.marching_tetrahedra(points, distance, tetrahedra)
        yield vertices, faces, distance
        # The ring's distance, summed over the inside, grows where a vertex moves out beyond it.
        area = np.repeat(mesh.area_vectors(vertices, faces)[:, None], 3, 1) / 6
        off = labs.implicit_surfaces.signed_distance(vertices, RING)
        push = off[:, None] * scatter(area, faces, len(vertices))
        _, grad_distance = lab15.marching_tetrahedra_backward(push, ends, points, distance)
        # A vertex's share of the surface is about 1 / 100, so it moves by 3 off at most.
        distance = distance - 300 * grad_distance
