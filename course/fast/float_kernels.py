"""Float kernels: lab 2, 5, 7 and 8's operations on float32 numbers, as other people's programs have
them: apps/bridge.

    show, show_backward       weights and their derivatives, by footprint_kernels
    mix, mix_backward         (5) and (7) of interpolation.py
    blended_pairs, blend      what nvdiffrast blends, by pair_kernels; blend_pairs_backward

rast (P, 4) has u, v, z / w and a face's code at each pixel, rast_db (P, 4) the derivatives of u and
v. All arithmetic is of 64 bits, and what is found is NumPy's to rounding.
"""
import functools
from collections import namedtuple

import numpy as np

from course.given import inputs
from course.given.compiled import each_band, kernel

from . import compiled_pipeline, footprint_kernels, pair_kernels, pipeline, scanline
from .compiled_pipeline import BAND, on_all_cores, parts
from .texel_kernels import constant

EXACT = 2**24   # so far, float32 holds all whole numbers; what is larger comes as in nvdiffrast:
CODE = 0x4A800000  # the float32 whose bits are this and the number

# Flat: rast (4 P,), the same as int32, and rast_db (4 P,).
Pixels = namedtuple("Pixels", "rast codes rast_db")


@kernel
def write_rast(face_index, depth, weights, first, pixels, part):
    """rast of pixels in a part, from weights (2 P,). first: the number of face 0."""
    rast, codes, _ = pixels
    for p in range(*part):
        if face_index[p] >= 0:
            number = first + face_index[p] + 1
            rast[4 * p], rast[4 * p + 1] = weights[2 * p], weights[2 * p + 1]
            rast[4 * p + 2] = depth[p]
            if number <= EXACT:
                rast[4 * p + 3] = number
            else:
                codes[4 * p + 3] = number + CODE


@kernel
def face_at(pixels, p):
    """The face that a pixel sees, -1 for none."""
    number = pixels.rast[4 * p + 3]
    return np.intp(number) - 1 if number <= EXACT else np.intp(pixels.codes[4 * p + 3]) - CODE - 1


@kernel
def read_rast(pixels, count, face_index, depth):
    """face_index, depth (P,) of rast -> whether it sees none but so many faces."""
    for p in range(len(face_index)):
        face = face_at(pixels, p)
        if face >= count:
            return False
        face_index[p], depth[p] = face, pixels.rast[4 * p + 2] if face >= 0 else np.inf
    return True


@kernel
def mix(values, faces, look, part, out):
    """Eq. (5) of interpolation.py at pixels of a part: values (V, A) -> out (P, A), 0 before. look:
    face_index (P,), weights (P, 3).
    """
    face_index, weights = look
    for p in range(*part):
        for c in range(values.shape[1] if face_index[p] >= 0 else 0):
            for k in range(3):
                out[p, c] += weights[p, k] * values[faces[face_index[p], k], c]


@kernel
def mix_backward(grad_out, values, faces, look, grad_values, grad_weights):
    """Eq. (7): adds to grad_values (V, A), grad_weights (P, 3)."""
    face_index, weights = look
    for p in range(len(face_index)):
        for k in range(3 if face_index[p] >= 0 else 0):
            v = faces[face_index[p], k]
            for c in range(values.shape[1]):
                grad_values[v, c] += weights[p, k] * grad_out[p, c]
                grad_weights[p, k] += grad_out[p, c] * values[v, c]


@kernel
def add_rows(values, index, sums):
    """`scatter`: row index[n] of sums (P, C) gets the n-th C numbers of values."""
    for n in range(len(index)):
        for k in range(sums.shape[1]):
            sums[index[n], k] += values[n * sums.shape[1] + k]


def flat(rast, rast_db=None):
    """The Pixels of rast and rast_db (..., 4), if there is one."""
    rast_db = rast if rast_db is None else rast_db
    return Pixels(rast.reshape(-1), rast.reshape(-1).view(np.int32), rast_db.reshape(-1))


def exact(clip, faces):
    """clip and faces as kernels take them."""
    return np.ascontiguousarray(clip, float), np.ascontiguousarray(faces, np.intp)


def sound(clip, faces):
    """The same, if faces name only vertices that are there: otherwise ValueError."""
    if not 0 <= faces.min() <= faces.max() < len(clip):
        inputs.require_faces(faces, len(clip))
    return exact(clip, faces)


@functools.lru_cache(maxsize=16)
def weights_as_uv(count, first, epsilon):
    """uv, uv_faces and epsilon of a Wrapped of so many faces, whose u and v are two of the corners'
    weights, from the first of these on.
    """
    return np.eye(3, 2, -first), np.broadcast_to(np.arange(3), (count, 3)), epsilon


def runs_of(face_index):
    """The runs of a picture (H, W) that see a face, in bands, each numbered by its first pixel."""
    runs = footprint_kernels.seen_runs(footprint_kernels.flat(face_index))
    bands = parts(len(runs.start), 1 + face_index.size // BAND)
    return [(footprint_kernels.Runs(runs.start[i:j], runs.end[i:j], runs.start[i:j]),)
            for i, j in bands]


def seen(clip, faces, width, height, beyond):
    """`compiled_pipeline.seen`, or of what lies beyond a depth (H, W), if that is one."""
    if beyond is None:
        return compiled_pipeline.seen(clip, faces, width, height)
    points, _ = compiled_pipeline.screen_vertices(clip, width, height)
    return points, *scanline.rasterize(clip, faces, width, height, beyond)


def show(faces, seen, first, rast, rast_db):
    """Writes rast and rast_db (H, W, 4), of zeros: seen is `compiled_pipeline.seen`."""
    points, face_index, depth = seen
    screen = points[:, (0, 1, 3)]
    mesh = footprint_kernels.Wrapped(screen, faces, *weights_as_uv(len(faces), 0, 0.0))
    weights, pixels = np.empty(2 * face_index.size, np.float32), flat(rast, rast_db)
    list(each_band(lambda runs: footprint_kernels.footprints_along(
        runs, footprint_kernels.flat(face_index), mesh, weights, pixels.rast_db),
        runs_of(face_index)))
    on_all_cores(lambda *part: write_rast(face_index.ravel(), depth.ravel(), weights, first, pixels,
                                          part), face_index.size, face_index.size)


def show_backward(grad_rast, grad_rast_db, face_index, clip, faces, epsilon):
    """Backward of `show`, grads (H, W, 4) -> grad_clip (V, 4)."""
    clip, faces = exact(clip, faces[:, (2, 0, 1)])  # the first one has 0 for u and for v
    mesh = footprint_kernels.Wrapped(clip, faces, *weights_as_uv(len(faces), 1, epsilon))
    picture = footprint_kernels.flat(face_index)
    grads = grad_rast[..., :2].ravel(), grad_rast_db.ravel()
    grad_clip, grad_uv = np.zeros(clip.shape), np.zeros((3, 2))

    def band(runs):
        records = np.empty((len(runs.start), 3, 3)), np.empty((len(runs.start), 3, 2))
        footprint_kernels.run_gradients(runs, picture, mesh, *grads, records)
        return runs, records

    for runs, records in each_band(band, runs_of(face_index)):
        footprint_kernels.add_to_corners(runs, picture.face_index, mesh, records, grad_clip,
                                         grad_uv)
    return grad_clip


def interpolate(attributes, faces, face_index, barycentric):
    """Lab 5's `interpolate`."""
    values, faces = sound(attributes, faces)
    look = face_index.ravel(), barycentric.reshape(-1, 3)
    out = np.zeros((face_index.size, values.shape[1]), np.float32)
    on_all_cores(lambda *part: mix(values, faces, look, part, out), *2 * out.shape[:1])
    return out.reshape(*face_index.shape, -1)


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    """Lab 5's `interpolate_backward`."""
    values, faces = sound(attributes, faces)
    look = face_index.ravel(), barycentric.reshape(-1, 3)
    grad_values, grad_weights = np.zeros(values.shape), np.zeros(barycentric.shape)
    mix_backward(grad_output.reshape(-1, values.shape[1]), values, faces, look, grad_values,
                 grad_weights.reshape(-1, 3))
    return grad_values, grad_weights


def blended_pairs(rast, clip, faces, opposite):
    """`outlines.blended_pairs` of rast (H, W, 4) -> Pairs. None: it sees other faces."""
    clip, faces = sound(clip, faces)
    face_index, depth = np.empty(rast.shape[:2], np.int32), np.empty(rast.shape[:2])
    if not read_rast(flat(rast), len(faces), face_index.reshape(-1), depth.reshape(-1)):
        return None
    points, _ = compiled_pipeline.screen_vertices(clip, *face_index.shape[::-1])
    return compiled_pipeline.walked_pairs(face_index, depth, points, faces, opposite, False)


def blend(colour, pairs):
    """`antialiasing.blend_pairs`."""
    picture = colour.copy()
    pair_kernels.blend(picture.reshape(-1), colour.reshape(-1), pairs, constant(colour.shape[2]))
    return picture


def blend_pairs_backward(grad_picture, colour, pairs, clip, epsilon):
    """`antialiasing.blend_pairs_backward`."""
    grad_clip, grad_colour = np.zeros(clip.shape), grad_picture.copy()
    buffers = pipeline.Buffers(np.asarray(clip, float), None, None, None, colour, pairs)
    pixels, grads = compiled_pipeline.pairs_backward(grad_picture, buffers, grad_clip, epsilon)
    add_rows(grads, pixels, grad_colour.reshape(-1, colour.shape[2]))
    return grad_colour, grad_clip
