"""More faces and fewer: a coarse ring made smooth (lab 11), and the bunny made coarse (lab 12)."""
import warnings

import numpy as np

from ..given import image, mesh
from .drawing import BRASS, LIGHT, SIZE, painted, save, size_in_words, unit_bunny
from .portrait import BUNNY_EYE
from .viewing import clip_positions

RING_EYE = np.array([1.5, 1.75, 2.35])
MOST_BY_POINTS = 2000  # faces that take a second; four times as many take sixteen


def rounded(labs, out="rounded", shape=None):
    """A ring of 64 faces, or FILE, and three steps of Loop, point by point (lab 11)."""
    vertices, faces = shape or mesh.torus(64, radius=0.8, tube=0.45)
    corners, origin = labs.subdivision.split_fans(faces.ravel(), np.full(len(faces), 3))
    vertices, faces = vertices[origin], corners.reshape(-1, 3)
    yield size_in_words(vertices, faces), None
    yield f"{len(faces):,} faces", save(out, "0", faceted(labs, vertices, faces, RING_EYE))
    for step in "123":
        vertices, faces = loop_step(labs, vertices, faces)
        picture = faceted(labs, vertices, faces, RING_EYE)
        yield f"{len(faces):,} faces", save(out, step, picture)


def loop_step(labs, vertices, faces):
    """One step of Loop, with the exercises that say it point by point. Of many faces, as a matrix,
    which gives the same.
    """
    lab11, loop = labs.subdivision, labs.loop_subdivision
    if len(faces) > MOST_BY_POINTS:
        return loop.loop(vertices, faces, loop.loop_weight)
    edges, corner_edge = lab11.edges_of(faces.ravel(), np.full(len(faces), 3))
    u = loop.loop_weight(lab11.valences(edges, len(vertices)))
    return loop.loop_slow(vertices, faces, u), loop.loop_faces(faces, corner_edge, len(vertices))


def simplified(labs, out="simplified", shape=None):
    """The bunny, or FILE, in ever fewer faces, at the end by the loop without a heap (lab 12)."""
    vertices, faces = shape or unit_bunny()
    yield (size_in_words(vertices, faces),
           save(out, "0", faceted(labs, vertices, faces, BUNNY_EYE)))
    count = min(1000, len(faces) // 2)
    with warnings.catch_warnings(action="ignore"):  # the line below says how many are left
        vertices, faces, _ = labs.collapse_heap.simplify(vertices, faces, count)
    yield (f"{len(faces):,} faces, by the heap",
           save(out, "1", faceted(labs, vertices, faces, BUNNY_EYE)))
    lab12 = labs.simplification
    for step, face_count in ("2", 2 * count // 5), ("3", count // 10):
        quadrics = lab12.mesh_quadrics(vertices, faces)
        vertices, faces = lab12.simplify_loop(vertices, faces, quadrics, face_count)
        yield (f"{len(faces)} faces, by the loop",
               save(out, step, faceted(labs, vertices, faces, BUNNY_EYE)))


def faceted(labs, vertices, faces, eye):
    """A picture (SIZE, SIZE, 3) with one shade for each face."""
    clip = clip_positions(labs, vertices, eye)
    face_index, _ = labs.rasterization.rasterize(clip, faces, SIZE, SIZE)
    seen = face_index >= 0
    facing = mesh.face_normals(vertices, faces) @ LIGHT / np.linalg.norm(LIGHT)
    shades = ((0.5 + 0.5 * facing) ** 2)[:, None] * BRASS
    return painted(seen, image.to_srgb(shades[face_index[seen]]))
