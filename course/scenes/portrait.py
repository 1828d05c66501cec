"""The bunny through labs 1 and 2: all that they say about a mesh, as pictures."""
import numpy as np

from ..given import mesh, plot
from .drawing import SIZE, painted, save, shaded, size_in_words, wireframe
from .viewing import clip_positions

BUNNY_EYE = np.array([-1.3, 0.7, 2.2])
TEAPOT_EYE = np.array([0.6, 1.2, 2.2])


def bunny(labs, out="bunny", shape=None):
    """The Stanford bunny, or FILE, through labs 1 and 2."""
    vertices, faces = shape or mesh.bunny()
    vertices = mesh.normalize(vertices)
    yield size_in_words(vertices, faces), None

    clip = clip_positions(labs, vertices, BUNNY_EYE)
    yield "vertices to clip space", None
    face_index, depth = labs.rasterization.rasterize(clip, faces, SIZE, SIZE)
    yield "rasterize: face index and depth", None
    barycentric = labs.rasterization.barycentrics(face_index, clip, faces)
    yield "barycentrics", None
    derivatives = labs.rasterization.barycentrics_derivatives(face_index, clip, faces)
    yield "derivatives of the barycentrics", None

    yield "face index", save(out, "face_index", plot.face_colours(face_index))
    yield "depth", save(out, "depth", plot.depth_colours(depth))
    seen = face_index >= 0
    yield "barycentrics", save(out, "barycentric", painted(seen, barycentric[seen]))
    yield "wireframe", save(out, "wireframe", wireframe(seen, barycentric, derivatives))
    yield "normals", save(out, "normals", shaded(vertices, faces, face_index, barycentric))
