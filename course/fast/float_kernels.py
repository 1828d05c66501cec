"""Float kernels: what apps/bridge does with float32 numbers, there and back, as compiled loops.

    draw_pixels                       labs 2, 5 and 7, by footprint_kernels: of u and v, not of the
                                      third weight
    unpacked                          what rast sees
    mix_attributes                    lab 5, by mix_corners
    blended_pairs, blend_pairs        lab 8 as nvdiffrast has it, by pair_kernels
    blend_pairs_backward

rast (H, W, 4) has u, v, z/w and the face's number + 1, rast_db du/dX, du/dY, dv/dX, dv/dY.

Arithmetic is of 64 bits, and what is found is NumPy's to rounding.
"""
import functools

import numpy as np

from course.given import inputs
from course.given.compiled import each_band, kernel

from . import compiled_pipeline, footprint_kernels, pair_kernels, pipeline, scanline
from .compiled_pipeline import on_all_cores
from .texel_kernels import constant


@kernel
def corners_of(faces, face):
    """The vertices of a face."""
    return np.uintp(faces[face, 0]), np.uintp(faces[face, 1]), np.uintp(faces[face, 2])


@kernel
def unpack(rast, face_index, depth):
    """Writes face_index (P,) and depth (P,), inf where no face is seen."""
    for p in range(np.uintp(len(rast))):
        face_index[p] = np.int32(rast[p, 3]) - 1
        depth[p] = rast[p, 2] if face_index[p] >= 0 else np.inf


@kernel
def pack(face_index, depth, first, rast):
    """Writes z/w and the faces' numbers, from first + 1 on, to rast (P, 4)."""
    for p in range(np.uintp(len(rast))):
        if face_index[p] >= 0:
            rast[p, 2], rast[p, 3] = depth[p], face_index[p] + first + 1


@kernel
def mix_corners(values, faces, look, chosen, part, out, out_da):
    """Eq. (5) of interpolation.py at pixels of a part: values (V, A) -> out (P, A), out_da (P, 2 D)
    of the chosen (D,), 0 before. look: face_index (P,), rast (P, 4), rast_db (P or 0, 4).
    """
    face_index, rast, rast_db = look
    for p in range(np.uintp(part[0]), np.uintp(part[1])):
        if face_index[p] >= 0:
            i, j, k = corners_of(faces, np.uintp(face_index[p]))
            u, v = np.float64(rast[p, 0]), np.float64(rast[p, 1])
            for c in range(np.uintp(values.shape[1])):
                out[p, c] = u * values[i, c] + v * values[j, c] + (1 - u - v) * values[k, c]
            for d in range(np.uintp(len(chosen))):
                c = np.uintp(chosen[d])
                by_u, by_v = values[i, c] - values[k, c], values[j, c] - values[k, c]
                for axis in (np.uintp(0), np.uintp(1)):
                    out_da[p, np.uintp(2) * d + axis] = (
                        rast_db[p, axis] * by_u + rast_db[p, np.uintp(2) + axis] * by_v)


@kernel
def mix_corners_backward(grad_out, values, faces, look, grads):
    """Eq. (7): adds to grads of values (V, A), rast (P, 4), rast_db. grad_out (P, A)."""
    face_index, rast, _ = look
    grad_values, grad_rast, _ = grads
    for p in range(np.uintp(len(face_index))):
        if face_index[p] >= 0:
            i, j, k = corners_of(faces, np.uintp(face_index[p]))
            u, v, grad_u, grad_v = np.float64(rast[p, 0]), np.float64(rast[p, 1]), 0.0, 0.0
            for c in range(np.uintp(grad_out.shape[1])):
                grad = np.float64(grad_out[p, c])
                grad_u += grad * (values[i, c] - values[k, c])
                grad_v += grad * (values[j, c] - values[k, c])
                grad_values[i, c] += u * grad
                grad_values[j, c] += v * grad
                grad_values[k, c] += (1 - u - v) * grad
            grad_rast[p, 0], grad_rast[p, 1] = grad_u, grad_v


@kernel
def derivatives_backward(grad_da, values, faces, look, chosen, grads):
    """Adds to the same grads what comes by the derivatives (P, 2 D)."""
    face_index, _, rast_db = look
    grad_values, _, grad_db = grads
    for p in range(np.uintp(len(face_index))):
        if face_index[p] >= 0:
            i, j, k = corners_of(faces, np.uintp(face_index[p]))
            for d in range(np.uintp(2 * len(chosen))):
                c, axis = np.uintp(chosen[d // 2]), d % np.uintp(2)
                grad, across = np.float64(grad_da[p, d]), axis + np.uintp(2)
                grad_db[p, axis] += grad * (values[i, c] - values[k, c])
                grad_db[p, across] += grad * (values[j, c] - values[k, c])
                grad_values[i, c] += grad * rast_db[p, axis]
                grad_values[j, c] += grad * rast_db[p, across]
                grad_values[k, c] -= grad * (rast_db[p, axis] + rast_db[p, across])


def sound(clip, faces):
    """clip and faces as kernels take them. ValueError if faces name vertices that are not there."""
    if not 0 <= faces.min() <= faces.max() < len(clip):
        inputs.require_faces(faces, len(clip))
    return np.ascontiguousarray(clip, float), np.ascontiguousarray(faces, np.intp)


@functools.lru_cache
def weights_as_uv(count, first, epsilon):
    """uv, uv_faces and epsilon of a Wrapped of so many faces, whose u and v are two of the corners'
    weights, from the first of these on.
    """
    return np.eye(3, 2, -first), np.broadcast_to(np.arange(3), (count, 3)), epsilon


def runs_of(face_index):
    """The runs of a picture (H, W) in bands, each numbered by its first pixel."""
    return [(runs._replace(number=runs.start),)
            for runs, in footprint_kernels.runs_in_bands(face_index)]


def draw_pixels(clip, faces, first, beyond, rast, rast_db):
    """Writes to rast and rast_db, 0 before -> face_index, depth (H, W). Faces are numbered from
    first on. beyond: a depth (H, W), of which only what lies deeper is seen, or None.
    """
    height, width, _ = rast.shape
    clip, faces = sound(clip, faces)
    if beyond is None:
        points, face_index, depth = compiled_pipeline.seen(clip, faces, width, height)
    else:
        points, _ = compiled_pipeline.screen_vertices(clip, width, height)
        face_index, depth = scanline.rasterize(clip, faces, width, height, beyond)
    places = weights_as_uv(len(faces), 0, 0.0)
    mesh = footprint_kernels.Wrapped(points[:, (0, 1, 3)], faces, *places)
    pixels, changes = rast.reshape(-1, 4), rast_db.reshape(-1, 4)
    picture = footprint_kernels.flat(face_index)
    list(each_band(lambda runs: footprint_kernels.footprints_along(runs, picture, mesh, pixels,
                                                                   changes), runs_of(face_index)))
    pack(picture.face_index, depth.ravel(), first, pixels)
    return face_index, depth


def draw_pixels_backward(grad_rast, grad_rast_db, face_index, clip, faces, epsilon):
    """Backward of `draw_pixels` -> grad_clip (V, 4). A gradient that is None is 0."""
    clip, faces = sound(clip, faces[:, (2, 0, 1)])  # the first one has 0 for u and for v
    mesh = footprint_kernels.Wrapped(clip, faces, *weights_as_uv(len(faces), 1, epsilon))
    grads = (np.zeros((face_index.size, 4), np.float32) if grad is None else grad.reshape(-1, 4)
             for grad in (grad_rast, grad_rast_db))
    picture = footprint_kernels.flat(face_index)
    return footprint_kernels.gradients(*grads, picture, mesh, runs_of(face_index))[1]


def unpacked(rast):
    """face_index and depth (H, W) of what rast sees."""
    face_index, depth = np.empty(rast.shape[:2], np.int32), np.empty(rast.shape[:2], np.float32)
    unpack(rast.reshape(-1, 4), face_index.reshape(-1), depth.reshape(-1))
    return face_index, depth


def look_at(face_index, rast, rast_db):
    """What `mix_corners` looks at."""
    rast_db = np.empty((0, 4), np.float32) if rast_db is None else rast_db.reshape(-1, 4)
    return face_index.ravel(), rast.reshape(-1, 4), rast_db


def mix_attributes(values, faces, face_index, rast, rast_db, chosen):
    """Lab 5's `interpolate` of values (V, A) -> (P, A), and the derivatives of those chosen (D,),
    (P, 2 D).
    """
    values, faces = sound(values, faces)
    look = look_at(face_index, rast, rast_db)
    out, out_da = (np.zeros((face_index.size, count), np.float32)
                   for count in (values.shape[1], 2 * len(chosen)))
    on_all_cores(lambda *part: mix_corners(values, faces, look, chosen, part, out, out_da),
                 len(out), len(out))
    return out, out_da


def mix_attributes_backward(grad_out, grad_da, values, faces, face_index, rast, rast_db, chosen):
    """Backward of `mix_attributes` -> gradients of values, rast and rast_db. grad_out and grad_da
    may be None.
    """
    values, faces = sound(values, faces)
    look = look_at(face_index, rast, rast_db)
    grads = np.zeros(values.shape), np.zeros_like(look[1]), np.zeros_like(look[2])
    if grad_out is not None:
        mix_corners_backward(grad_out, values, faces, look, grads)
    if grad_da is not None:
        derivatives_backward(grad_da, values, faces, look, chosen, grads)
    return grads


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
