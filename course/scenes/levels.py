"""More faces and fewer: coarse meshes made smooth (lab 11), and the bunny made coarse (lab 12)."""
import itertools
import warnings

import numpy as np

from ..given import image, mesh
from .drawing import SIZE, lit, painted, save, size_in_words, smooth, unit_bunny
from .portrait import BUNNY_EYE
from .viewing import clip_positions

RING_EYE = np.array([1.5, 1.75, 2.35])
WALLS = ([0, 4, 3, 2, 1], [5, 6, 7, 8, 9], [1, 2, 7, 6], [2, 3, 8, 7], [3, 4, 8], [8, 4, 9],
         [4, 0, 5, 9])  # of a house, with its roof
RATE = 1.9  # of the descent on half the squared distances: no direction overshoots
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
    """One step of Loop, with the exercise that says it point by point. Of many faces, as a matrix,
    which gives the same.
    """
    lab11, loop = labs.subdivision, labs.loop_subdivision
    if len(faces) > MOST_BY_POINTS:
        return loop.loop(vertices, faces, loop.loop_weight)
    edges, _ = lab11.edges_of(faces.ravel(), np.full(len(faces), 3))
    return loop.loop_slow(vertices, faces, loop.loop_weight(lab11.valences(edges, len(vertices))))


def house(labs):
    """A house without a floor, and three steps of Catmull-Clark (lab 11)."""
    for step, (points, corners, counts) in enumerate(houses(labs, 3)):
        fans = [(part[0], *pair) for part in np.split(corners, np.cumsum(counts)[:-1])
                for pair in itertools.pairwise(part[1:])]
        yield (f"{len(counts)} faces",
               save("house", str(step), faceted(labs, points, np.array(fans), RING_EYE)))


def houses(labs, steps):
    """Yields points, corners and counts of the house, before each step and after the last."""
    corner = (-0.8, -0.8), (0.8, -0.8), (0.8, 0.3), (0.0, 1.0), (-0.8, 0.3)
    points = np.array([(x, y, z) for z in (-0.8, 0.8) for x, y in corner])
    corners, counts = np.concatenate(WALLS), np.array([len(wall) for wall in WALLS])
    yield points, corners, counts
    for _ in range(steps):
        points, quads = labs.catmull_clark.catmull_clark_slow(points, corners, counts)
        corners, counts = quads.ravel(), np.full(len(quads), 4)
        yield points, corners, counts


def cage(labs):
    """A cage whose smooth surface goes through the vertices of a coarse ring (lab 11)."""
    through, faces = mesh.torus(64, radius=0.52, tube=0.29)
    for step, (points, surface, fine) in enumerate(pulled(labs, through, faces, 2, 12)):
        if step in (0, 12):
            apart = np.linalg.norm(surface[:len(points)] - through, axis=1).max()
            clip = clip_positions(labs, surface, RING_EYE)
            sides = faceted(labs, points, faces, RING_EYE), smooth(labs, surface, fine, clip)
            reached = [("below 0.001", apart < 0.001)] if step else []
            yield (f"step {step}: the surface misses the ring's vertices by up to {apart:.4f}",
                   save("cage", f"step_{step}", np.hstack(sides)), *reached)


def pulled(labs, through, faces, levels, steps):
    """Yields a cage, its surface and the surface's faces, before each step and after the last. The
    cage begins as a mesh, through whose vertices the surface is to go.
    """
    loop, points = labs.loop_subdivision, through
    for _ in range(steps + 1):
        surface, fine = loop.loop_surface(points, faces, levels)
        yield points, surface, fine
        off = np.zeros(surface.shape)
        off[:len(points)] = surface[:len(points)] - through  # old vertices keep their numbers
        points = points - RATE * loop.loop_surface_backward(off, faces, len(points), levels)


def simplified(labs, out="simplified", shape=None):
    """The bunny, or FILE, in ever fewer faces, at the end by the loop without a heap (lab 12)."""
    vertices, faces = shape or unit_bunny()
    yield (size_in_words(vertices, faces),
           save(out, "0", faceted(labs, vertices, faces, BUNNY_EYE)))
    count = min(1000, len(faces) // 2)
    for step, (places, left) in enumerate(fewer(labs, vertices, faces, count), 1):
        yield (f"{len(left):,} faces, by the {'heap' if step == 1 else 'loop'}",
               save(out, str(step), faceted(labs, places, left, BUNNY_EYE)))


def fewer(labs, vertices, faces, count):
    """Yields a mesh in count faces, by the heap, then in two fifths and a tenth, by the loop."""
    with warnings.catch_warnings(action="ignore"):  # whoever draws sees how many are left
        vertices, faces, _ = labs.collapse_heap.simplify(vertices, faces, count)
    yield vertices, faces
    lab12 = labs.simplification
    for face_count in 2 * count // 5, count // 10:
        quadrics = lab12.mesh_quadrics(vertices, faces)
        vertices, faces = lab12.simplify_loop(vertices, faces, quadrics, face_count)
        yield vertices, faces


def faceted(labs, vertices, faces, eye):
    """A picture (SIZE, SIZE, 3) with one shade for each face."""
    clip = clip_positions(labs, vertices, eye)
    face_index, _ = labs.rasterization.rasterize(clip, faces, SIZE, SIZE)
    seen = face_index >= 0
    shades = lit(mesh.face_normals(vertices, faces))
    return painted(seen, image.to_srgb(shades[face_index[seen]]))
