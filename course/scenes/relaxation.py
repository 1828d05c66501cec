"""Better surfaces: noise taken from the bunny, thin triangles from the teapot (lab 13)."""
import numpy as np

from ..given import mesh
from .drawing import SIZE, save, smooth, unit_bunny, wireframe
from .portrait import BUNNY_EYE, TEAPOT_EYE
from .viewing import clip_positions


def smoothed(labs):
    """The noise of a rough bunny smoothed away, its volume restored (lab 13)."""
    lab13, (vertices, faces) = labs.regularization, unit_bunny()
    rough = vertices + np.random.default_rng(1).normal(0, 0.012, vertices.shape)
    for name, x in zip(("rough", "smooth", "restored"), without_noise(lab13, rough, faces, 1.5e-3),
                       strict=True):
        clip = clip_positions(labs, x, BUNNY_EYE)
        yield (f"{name}: volume {lab13.enclosed_volume(x[faces]):.3f}",
               save("smoothed", name, smooth(labs, x, faces, clip)))


def without_noise(lab13, rough, faces, step):
    """Yield a rough surface, what a step by its cotangents leaves, and that in its old volume."""
    yield rough
    edges, weights, areas = lab13.cotangent_laplacian(rough, faces)
    x = lab13.smooth_implicit(rough, edges, weights, areas, step)
    yield x
    yield lab13.restore_volume(x, faces, lab13.enclosed_volume(rough[faces]))


def relaxation(labs, out="relaxation", shape=None):
    """The thin triangles of the teapot, or FILE, made rounder, the surface kept (lab 13)."""
    vertices, faces = shape or split_in_four(*mesh.merge(*mesh.teapot()))
    size = np.linalg.norm(np.ptp(vertices, axis=0))
    yield f"{len(vertices):,} vertices, {len(faces):,} faces", None
    moved, flipped = labs.remeshing.relax(vertices, faces, 0.004 * size)
    yield "flips and slides, four times", None
    for name, shape, triangles in ("before", vertices, faces), ("after", moved, flipped):
        angle = np.degrees(labs.regularization.corner_angles(shape[triangles]).min(1).mean())
        yield (f"{name}: mean least angle {angle:.1f} degrees",
               save(out, name, drawn(labs, shape, triangles)))


def split_in_four(vertices, faces):
    """Each face as four of its own shape: the surface stays, and so do its angles."""
    edges, number = mesh.edges(faces)
    (a, b, c), (bc, ca, ab) = faces.T, (len(vertices) + number).T
    faces = np.stack([a, ab, ca,  b, bc, ab,  c, ca, bc,  ab, bc, ca], 1).reshape(-1, 3)
    return np.concatenate([vertices, vertices[edges].mean(1)]), faces


def drawn(labs, vertices, faces, size=SIZE):
    """The visible edges of a mesh, seen as the teapot is: a picture (size, size, 3)."""
    clip = clip_positions(labs, mesh.normalize(vertices), TEAPOT_EYE)
    seen = labs.pipeline.visible(clip, faces, size, size)
    derivatives = labs.interpolation.barycentrics_derivatives(seen.face_index, clip, faces)
    return wireframe(seen.face_index >= 0, seen.barycentric, derivatives)
