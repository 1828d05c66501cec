"""The bunny through labs 1, 2 and 5: all that they say about a mesh, as pictures."""
import numpy as np

from ..given import image, mesh, plot
from .drawing import SIZE, lit, painted, save, size_in_words, wireframe
from .viewing import BUNNY_EYE, clip_positions

TEAPOT_EYE = np.array([0.6, 1.2, 2.2])


def bunny(labs, out="bunny", shape=None):
    """The Stanford bunny, or FILE, through labs 1, 2 and 5."""
    vertices, faces = shape or mesh.bunny()
    vertices = mesh.normalize(vertices)
    yield size_in_words(vertices, faces), None

    clip = clip_positions(labs, vertices, BUNNY_EYE)
    yield "vertices to clip space", None
    face_index, depth = labs.rasterization.rasterize(clip, faces, SIZE, SIZE)
    yield "rasterize: face index and depth", None
    yield "face index", save(out, "face_index", plot.face_colours(face_index))
    yield "depth", save(out, "depth", plot.depth_colours(depth))

    seen = face_index >= 0
    barycentric = labs.interpolation.barycentrics(face_index, clip, faces)
    yield "barycentrics", save(out, "barycentric", painted(seen, barycentric[seen]))
    normal = labs.interpolation.interpolate(mesh.vertex_normals(vertices, faces), faces,
                                            face_index, barycentric)
    yield "normals", save(out, "normals", painted(seen, image.to_srgb(lit(normal[seen]))))
    derivatives = labs.interpolation.barycentrics_derivatives(face_index, clip, faces)
    yield "wireframe", save(out, "wireframe", wireframe(seen, barycentric, derivatives))
