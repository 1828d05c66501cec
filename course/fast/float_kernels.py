"""Float kernels: what apps/bridge does with float32 numbers, there and back, as compiled loops.

    draw_pixels                       labs 2, 5 and 7, by put_runs and, on the way back,
                                      footprint_kernels
    unpacked                          what rast sees
    mix_attributes                    lab 5, by mix_corners
    blended_pairs, blend_pairs        lab 8 as nvdiffrast has it, by pair_kernels
    blend_pairs_backward

rast (H, W, 4) has u, v, z/w and the face's number + 1, rast_db du/dX, du/dY, dv/dX, dv/dY.

Arithmetic is of 64 bits, and what is found is NumPy's to rounding.
"""
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
        face_index[p] = max(np.int32(rast[p, 3]) - 1, -1)
        depth[p] = rast[p, 2] if face_index[p] >= 0 else np.inf


@kernel
def edge_line(points, p, q, r, x, y):
    """Eq. (5) of rasterization.py at (x, y) for the edge p q of a corner r, and how it changes."""
    x0, y0, x1, y1 = points[p, 0] - x, points[p, 1] - y, points[q, 0] - x, points[q, 1] - y
    w = points[r, 3]
    return (x0 * y1 - x1 * y0) / w, (y0 - y1) / w, (x1 - x0) / w


@kernel
def put_runs(runs, seen, points, faces, first, rast, rast_db):
    """Writes runs to rast (P, 4), and to rast_db (P, 4) by eq. (6) there. seen: a Picture, and the
    depth (P,). Faces are numbered from first on.
    """
    picture, depth = seen
    for run in range(len(runs.start)):
        start, end = runs.start[run], runs.end[run]
        x, y = start % picture.width + 0.5, start // picture.width + 0.5
        face = picture.face_index[start]
        i, j, k = corners_of(faces, np.uintp(face))
        a, a_x, a_y = edge_line(points, j, k, i, x, y)
        b, b_x, b_y = edge_line(points, k, i, j, x, y)
        c, c_x, c_y = edge_line(points, i, j, k, x, y)
        s, s_x, s_y = a + b + c, a_x + b_x + c_x, a_y + b_y + c_y
        for step in range(np.uintp(end - start)):
            p, t = np.uintp(start) + step, np.int32(step)
            r = 1 / (s + t * s_x)
            u, v = (a + t * a_x) * r, (b + t * b_x) * r
            rast[p, 0], rast[p, 1], rast[p, 2], rast[p, 3] = u, v, depth[p], face + first + 1
            rast_db[p, 0], rast_db[p, 1] = (a_x - u * s_x) * r, (a_y - u * s_y) * r
            rast_db[p, 2], rast_db[p, 3] = (b_x - v * s_x) * r, (b_y - v * s_y) * r


@kernel
def mix_corners(values, faces, look, channels, part, out):
    """Eq. (5) of interpolation.py at pixels of a part: values (V, A) -> out (P, A), 0 before.

    look: face_index (P,), the weights of two corners (P, 2), and the sum of all three. channels: a
    tuple of A numbers, so that A is known when this is compiled.
    """
    face_index, uv, total = look
    for p in range(np.uintp(part[0]), np.uintp(part[1])):
        if face_index[p] >= 0:
            i, j, k = corners_of(faces, np.uintp(face_index[p]))
            u, v = np.float64(uv[p, 0]), np.float64(uv[p, 1])
            for c in range(np.uintp(len(channels))):
                out[p, c] = u * values[i, c] + v * values[j, c] + (total - u - v) * values[k, c]


@kernel
def mix_corners_backward(grad_out, values, faces, look, channels, grad_values, grad_uv):
    """Eq. (7): grad_out (P, A) adds to grad_values (V, A), and goes to grad_uv (P, 2)."""
    face_index, uv, total = look
    for p in range(np.uintp(len(face_index))):
        if face_index[p] >= 0:
            i, j, k = corners_of(faces, np.uintp(face_index[p]))
            u, v, grad_u, grad_v = np.float64(uv[p, 0]), np.float64(uv[p, 1]), 0.0, 0.0
            for c in range(np.uintp(len(channels))):
                grad = np.float64(grad_out[p, c])
                grad_u += grad * (values[i, c] - values[k, c])
                grad_v += grad * (values[j, c] - values[k, c])
                grad_values[i, c] += u * grad
                grad_values[j, c] += v * grad
                grad_values[k, c] += (total - u - v) * grad
            grad_uv[p, 0], grad_uv[p, 1] = grad_u, grad_v


def sound(vertices, faces):
    """vertices in 64 bits. ValueError if faces name some that are not there."""
    if faces.size and not 0 <= faces.min() <= faces.max() < len(vertices):
        inputs.require_faces(faces, len(vertices))
    return np.ascontiguousarray(vertices, float)


def draw_pixels(clip, faces, first, beyond, rast, rast_db):
    """Writes to rast and rast_db, 0 before -> face_index, depth (H, W), and their runs in bands,
    each numbered by its first pixel. Faces are numbered from first on. beyond: a depth (H, W), of
    which only what lies deeper is seen, or None.
    """
    height, width, _ = rast.shape
    clip = np.ascontiguousarray(clip, float)
    if beyond is None:
        points, face_index, depth = compiled_pipeline.seen(clip, faces, width, height)
    else:
        points, _ = compiled_pipeline.screen_vertices(clip, width, height)
        face_index, depth = scanline.rasterize(clip, faces, width, height, beyond)
    pixels, changes = rast.reshape(-1, 4), rast_db.reshape(-1, 4)
    seen = footprint_kernels.flat(face_index), depth.ravel()
    bands = [(runs._replace(number=runs.start),)
             for runs, in footprint_kernels.runs_in_bands(face_index)]
    list(each_band(lambda runs: put_runs(runs, seen, points, faces, first, pixels, changes), bands))
    return face_index, depth, bands


def draw_pixels_backward(grad_rast, grad_rast_db, face_index, bands, clip, faces, epsilon):
    """Backward of `draw_pixels` -> grad_clip (V, 4). A gradient that is None is 0."""
    faces = faces[:, (2, 0, 1)]  # the first one has 0 for u and for v
    mesh = footprint_kernels.Wrapped(sound(clip, faces), faces, np.eye(3, 2, -1),
                                     np.broadcast_to(np.arange(3), faces.shape), epsilon)
    grads = (np.zeros((size, 4), np.float32) if grad is None else grad.reshape(-1, 4)
             for grad, size in ((grad_rast, face_index.size), (grad_rast_db, 0)))
    return footprint_kernels.gradients(*grads, footprint_kernels.flat(face_index), mesh, bands)[1]


def unpacked(rast):
    """face_index and depth (H, W) of what rast sees."""
    face_index, depth = np.empty(rast.shape[:2], np.int32), np.empty(rast.shape[:2], np.float32)
    unpack(rast.reshape(-1, 4), face_index.reshape(-1), depth.reshape(-1))
    return face_index, depth


def mix_attributes(values, faces, face_index, uv, total, out):
    """Writes lab 5's `interpolate` of values (V, A) to out (P, A), 0 before. uv (P, 2): the weights
    of two corners; total: the sum of all three.
    """
    given = sound(values, faces), faces, (face_index.ravel(), uv, total), constant(out.shape[1])
    on_all_cores(lambda *part: mix_corners(*given, part, out), len(out), len(out))


def mix_attributes_backward(grad_out, values, faces, face_index, uv, total, grad_uv):
    """Backward of `mix_attributes`: writes to grad_uv (P, 2) -> grad_values (V, A)."""
    values, grad_values = sound(values, faces), np.zeros(values.shape)
    mix_corners_backward(grad_out, values, faces, (face_index.ravel(), uv, total),
                         constant(values.shape[1]), grad_values, grad_uv)
    return grad_values


def blended_pairs(face_index, depth, clip, faces, opposite):
    """`outlines.blended_pairs`."""
    clip = sound(clip, faces)
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
