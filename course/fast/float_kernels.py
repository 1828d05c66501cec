"""Float kernels: what apps/bridge does with float32 numbers, there and back, as compiled loops.

    seen_weights, rasterize_backward  labs 2, 5 and 7, by footprint_kernels: of u and v, not of the
                                      third weight
    interpolate, interpolate_backward lab 5, by mix_corners
    blended_pairs, blend_pairs        lab 8 as nvdiffrast has it, by pair_kernels
    blend_pairs_backward

Arithmetic is of 64 bits, and what is found is NumPy's to rounding.
"""
import numpy as np

from course.given import inputs
from course.given.compiled import each_band, kernel

from . import compiled_pipeline, footprint_kernels, pair_kernels, pipeline, scanline
from .compiled_pipeline import BAND, on_all_cores, parts
from .texel_kernels import constant


@kernel
def corners_of(faces, face):
    """The vertices of a face."""
    return np.uintp(faces[face, 0]), np.uintp(faces[face, 1]), np.uintp(faces[face, 2])


@kernel
def mix_corners(values, faces, look, part, out):
    """Eq. (5) of interpolation.py at pixels of a part: values (V, A) -> out (P, A), 0 before. look:
    face_index (P,), weights (P, 3).
    """
    face_index, weights = look
    for p in range(np.uintp(part[0]), np.uintp(part[1])):
        if face_index[p] >= 0:
            i, j, k = corners_of(faces, np.uintp(face_index[p]))
            for c in range(np.uintp(values.shape[1])):
                out[p, c] = (weights[p, 0] * values[i, c] + weights[p, 1] * values[j, c]
                             + weights[p, 2] * values[k, c])


@kernel
def mix_corners_backward(grad_out, values, faces, look, grad_values, grad_weights):
    """Eq. (7): adds to grad_values (V, A), grad_weights (P, 3)."""
    face_index, weights = look
    for p in range(np.uintp(len(face_index))):
        if face_index[p] >= 0:
            sums, corners = (0.0, 0.0, 0.0), corners_of(faces, np.uintp(face_index[p]))
            for c in range(np.uintp(values.shape[1])):
                grad, (i, j, k) = np.float64(grad_out[p, c]), corners
                sums = (sums[0] + grad * values[i, c], sums[1] + grad * values[j, c],
                        sums[2] + grad * values[k, c])
                for corner in range(3):
                    grad_values[corners[corner], c] += weights[p, corner] * grad
            grad_weights[p, 0], grad_weights[p, 1], grad_weights[p, 2] = sums


def sound(clip, faces):
    """clip and faces as kernels take them. ValueError if faces name vertices that are not there."""
    if not 0 <= faces.min() <= faces.max() < len(clip):
        inputs.require_faces(faces, len(clip))
    return np.ascontiguousarray(clip, float), np.ascontiguousarray(faces, np.intp)


def weights_as_uv(count, first, epsilon):
    """uv, uv_faces and epsilon of a Wrapped of so many faces, whose u and v are two of the corners'
    weights, from the first of these on.
    """
    return np.eye(3, 2, -first), np.broadcast_to(np.arange(3), (count, 3)), epsilon


def runs_of(face_index):
    """The runs of a picture (H, W) that see a face, in bands, each numbered by its first pixel."""
    runs = footprint_kernels.seen_runs(footprint_kernels.flat(face_index))
    return [(footprint_kernels.Runs(runs.start[i:j], runs.end[i:j], runs.start[i:j]),)
            for i, j in parts(len(runs.start), 1 + face_index.size // BAND)]


def seen_weights(clip, faces, width, height, beyond):
    """face_index, depth (H, W), also of what lies beyond a depth (H, W), if that is one; u and v
    (H, W, 2), and their derivatives (H, W, 2, 2).
    """
    clip, faces = sound(clip, faces)
    if beyond is None:
        points, face_index, depth = compiled_pipeline.seen(clip, faces, width, height)
    else:
        points, _ = compiled_pipeline.screen_vertices(clip, width, height)
        face_index, depth = scanline.rasterize(clip, faces, width, height, beyond)
    places = weights_as_uv(len(faces), 0, 0.0)
    mesh = footprint_kernels.Wrapped(points[:, (0, 1, 3)], faces, *places)
    uv, derivatives = (np.zeros((height, width, *shape), np.float32) for shape in ((2,), (2, 2)))
    list(each_band(lambda runs: footprint_kernels.footprints_along(
        runs, footprint_kernels.flat(face_index), mesh, uv.reshape(-1), derivatives.reshape(-1)),
        runs_of(face_index)))
    return face_index, depth, uv, derivatives


def rasterize_backward(grad_uv, grad_derivatives, _, face_index, clip, faces, epsilon):
    """`rasterizer_gradients.rasterize_backward` of u and v: (H, W, 2), (H, W, 2, 2)."""
    clip, faces = sound(clip, faces[:, (2, 0, 1)])  # the first one has 0 for u and for v
    mesh = footprint_kernels.Wrapped(clip, faces, *weights_as_uv(len(faces), 1, epsilon))
    picture = footprint_kernels.flat(face_index)
    grads = grad_uv.ravel(), grad_derivatives.ravel()
    grad_clip, unused = np.zeros(clip.shape), np.zeros((3, 2))

    def band(runs):
        records = np.empty((len(runs.start), 3, 3)), np.empty((len(runs.start), 3, 2))
        footprint_kernels.run_gradients(runs, picture, mesh, *grads, records)
        return runs, records

    for runs, records in each_band(band, runs_of(face_index)):
        footprint_kernels.add_to_corners(runs, picture.face_index, mesh, records, grad_clip, unused)
    return grad_clip


def interpolate(attributes, faces, face_index, barycentric):
    """Lab 5's `interpolate`."""
    values, faces = sound(attributes, faces)
    look = face_index.ravel(), barycentric.reshape(-1, 3)
    out = np.zeros((face_index.size, values.shape[1]), np.float32)
    on_all_cores(lambda *part: mix_corners(values, faces, look, part, out), *2 * out.shape[:1])
    return out.reshape(*face_index.shape, -1)


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    """Lab 5's `interpolate_backward`."""
    values, faces = sound(attributes, faces)
    look = face_index.ravel(), barycentric.reshape(-1, 3)
    grad_values, grad_weights = np.zeros(values.shape), np.zeros(barycentric.shape)
    mix_corners_backward(grad_output.reshape(-1, values.shape[1]), values, faces, look,
                         grad_values, grad_weights.reshape(-1, 3))
    return grad_values, grad_weights


def blended_pairs(face_index, depth, clip, faces, opposite):
    """`outlines.blended_pairs`."""
    clip, faces = sound(clip, faces)
    points, _ = compiled_pipeline.screen_vertices(clip, *face_index.shape[::-1])
    return compiled_pipeline.all_pairs(face_index, depth, clip, points, faces, opposite,
                                       walks=False)


def blend_pairs(colour, pairs):
    """`antialiasing.blend_pairs`."""
    picture = colour.copy()
    pair_kernels.blend(picture.reshape(-1), colour.reshape(-1), pairs, constant(colour.shape[2]))
    return picture


def blend_pairs_backward(grad_picture, colour, pairs, clip, epsilon):
    """`antialiasing.blend_pairs_backward`."""
    grad_clip, grad_colour = np.zeros(clip.shape), grad_picture.copy()
    buffers = pipeline.Buffers(np.asarray(clip, float), None, None, None, colour, pairs)
    pixels, grads = compiled_pipeline.pairs_backward(grad_picture, buffers, None, grad_clip,
                                                     epsilon)
    channels = colour.shape[2]
    np.add.at(grad_colour.reshape(-1, channels), pixels, grads.reshape(-1, channels))
    return grad_colour, grad_clip
