"""More faces and fewer: a coarse ring made smooth (lab 11), and the bunny made coarse (lab 12)."""
import numpy as np

from ...given import image, mesh
from .drawing import BRASS, LIGHT, SIZE, painted, save, size_in_words, unit_bunny
from .portrait import BUNNY_EYE
from .viewing import clip_positions

RING_EYE = np.array([1.5, 1.75, 2.35])


def rounded(labs):
    """A ring of 64 faces and three steps of Loop, point by point (lab 11)."""
    vertices, faces = mesh.torus(64, radius=0.8, tube=0.45)
    yield size_in_words(vertices, faces), None
    yield "64 faces", save("rounded", "0", faceted(labs, vertices, faces, RING_EYE))
    for step in "123":
        vertices, faces = loop_step(labs, vertices, faces)
        picture = faceted(labs, vertices, faces, RING_EYE)
        yield f"{len(faces):,} faces", save("rounded", step, picture)


def loop_step(labs, vertices, faces):
    """One step of Loop, with the exercises that say it point by point."""
    lab11, loop = labs.subdivision, labs.loop_subdivision
    edges, corner_edge = lab11.edges_of(faces.ravel(), np.full(len(faces), 3))
    u = loop.loop_weight(lab11.valences(edges, len(vertices)))
    return loop.loop_slow(vertices, faces, u), loop.loop_faces(faces, corner_edge, len(vertices))


def simplified(labs):
    """The bunny in ever fewer faces, the last ones by the loop without a heap (lab 12)."""
    vertices, faces = unit_bunny()
    yield size_in_words(vertices, faces), save("simplified", f"{len(faces)}", faceted(
        labs, vertices, faces, BUNNY_EYE))
    vertices, faces, _ = labs.collapse_heap.simplify(vertices, faces, 1000)
    yield "1,000 faces, by the heap", save("simplified", "1000",
                                           faceted(labs, vertices, faces, BUNNY_EYE))
    lab12 = labs.simplification
    for face_count in 400, 100:
        quadrics = lab12.mesh_quadrics(vertices, faces)
        vertices, faces = lab12.simplify_loop(vertices, faces, quadrics, face_count)
        yield f"{len(faces)} faces, by the loop", save("simplified", f"{face_count}",
                                                       faceted(labs, vertices, faces, BUNNY_EYE))


def faceted(labs, vertices, faces, eye):
    """A picture (SIZE, SIZE, 3) with one shade for each face."""
    face_index, _ = labs.scanline.rasterize(clip_positions(labs, vertices, eye), faces, SIZE, SIZE)
    seen = face_index >= 0
    facing = mesh.face_normals(vertices, faces) @ LIGHT / np.linalg.norm(LIGHT)
    shades = ((0.5 + 0.5 * facing) ** 2)[:, None] * BRASS
    return painted(seen, image.to_srgb(shades[face_index[seen]]))
