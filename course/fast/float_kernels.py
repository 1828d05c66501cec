"""Float kernels: what apps/bridge does with float32 numbers, there and back, as compiled loops.

    draw_pixels                       labs 2, 5 and 7, by put_runs and, on the way back,
                                      footprint_kernels
    mix_attributes                    lab 5, by mix_corners
    unpacked, blended_pairs           what lab 8 blends as nvdiffrast has it, by pair_kernels.
                                      compiled_pipeline blends it

rast (H, W, 4) has u, v, z/w and the face's number + 1, rast_db du/dX, du/dY, dv/dX, dv/dY.

Arithmetic is of 64 bits, and what is found is NumPy's to rounding.
"""
import numpy as np

from course.given.compiled import each_band, kernel

from . import compiled_pipeline, footprint_kernels, scanline
from .compiled_pipeline import on_all_cores
from .texel_kernels import constant

UNIT = np.eye(3, 2, -1), np.arange(3)[None]  # u and v at a face's corners: 0, 0; 1, 0; 0, 1


@kernel
def corners_of(faces, face):
    """The vertices of a face."""
    return np.uintp(faces[face, 0]), np.uintp(faces[face, 1]), np.uintp(faces[face, 2])


@kernel
def are_vertices(faces, vertex_count):
    """Are all corners of faces vertices?"""
    least, most = 0, 0
    for face in range(len(faces)):
        for k in range(3):
            least, most = min(least, faces[face, k]), max(most, faces[face, k])
    return least >= 0 and most < vertex_count


@kernel
def face_in(rast, p):
    """The face that pixel p sees, negative for none."""
    return np.int64(np.int32(rast[p, 3])) - 1


@kernel
def unpack(rast, faces, vertex_count, face_index, depth):
    """Writes face_index (P,) and depth (P,), inf where no face is seen -> whether all is there."""
    for p in range(np.uintp(len(rast))):
        face_index[p] = max(face_in(rast, p), -1)
        depth[p] = rast[p, 2] if face_index[p] >= 0 else np.inf
        if face_index[p] >= len(faces):
            return False
    return are_vertices(faces, vertex_count)


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
    Returns whether all faces are there, whose corners must be.

    look: rast (P, 4), the weights of two corners (P, 2), and the sum of all three. channels: a
    tuple of A numbers, so that A is known when this is compiled.
    """
    rast, uv, total = look
    for p in range(np.uintp(part[0]), np.uintp(part[1])):
        face = face_in(rast, p)
        if face >= len(faces):
            return False
        if face >= 0:
            i, j, k = corners_of(faces, np.uintp(face))
            u, v = np.float64(uv[p, 0]), np.float64(uv[p, 1])
            for c in range(np.uintp(len(channels))):
                out[p, c] = u * values[i, c] + v * values[j, c] + (total - u - v) * values[k, c]
    return True


@kernel
def mix_corners_backward(grad_out, values, faces, look, channels, grad_values, grad_uv):
    """Eq. (7): grad_out (P, A) adds to grad_values (V, A), and goes to grad_uv (P, 2)."""
    rast, uv, total = look
    for p in range(np.uintp(len(rast))):
        face = face_in(rast, p)
        if face >= 0:
            i, j, k = corners_of(faces, np.uintp(face))
            u, v, grad_u, grad_v = np.float64(uv[p, 0]), np.float64(uv[p, 1]), 0.0, 0.0
            for c in range(np.uintp(len(channels))):
                grad, last = np.float64(grad_out[p, c]), np.float64(values[k, c])
                grad_u += grad * (values[i, c] - last)
                grad_v += grad * (values[j, c] - last)
                grad_values[i, c] += u * grad
                grad_values[j, c] += v * grad
                grad_values[k, c] += (total - u - v) * grad
            grad_uv[p, 0], grad_uv[p, 1] = grad_u, grad_v


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
    given = (footprint_kernels.flat(face_index), depth.ravel()), points, faces, first
    rasts = rast.reshape(-1, 4), rast_db.reshape(-1, 4)
    bands = footprint_kernels.runs_in_bands(face_index, counts_all=True)
    list(each_band(lambda runs: put_runs(runs, *given, *rasts), bands))
    return face_index, depth, bands


def draw_pixels_backward(grad_rast, grad_rast_db, face_index, bands, clip, faces, epsilon):
    """Backward of `draw_pixels` -> grad_clip (V, 4). A gradient that is None is 0."""
    faces = faces[:, (2, 0, 1)]  # the first one has 0 for u and for v
    mesh = footprint_kernels.Wrapped(np.asarray(clip, float), faces, *UNIT, epsilon)
    grads = (np.zeros((size, 4), np.float32) if grad is None else grad.reshape(-1, 4)
             for grad, size in ((grad_rast, face_index.size), (grad_rast_db, 0)))
    return footprint_kernels.gradients(*grads, footprint_kernels.flat(face_index), mesh, bands)[1]


def mix_attributes(values, faces, rast, uv, total, out):
    """Writes lab 5's `interpolate` of values (V, A) to out (P, A), 0 before -> whether all is
    there. uv (P, 2): the weights of two corners; total: the sum of all three.
    """
    given = (np.ascontiguousarray(values), faces, (rast.reshape(-1, 4), uv, total),
             constant(out.shape[1]))
    return are_vertices(faces, len(values)) and all(
        on_all_cores(lambda *part: mix_corners(*given, part, out), len(out), len(out)))


def mix_attributes_backward(grad_out, values, faces, rast, uv, total, grad_uv):
    """Backward of `mix_attributes`: writes to grad_uv (P, 2) -> grad_values (V, A)."""
    values, grad_values = np.ascontiguousarray(values), np.zeros(values.shape)
    mix_corners_backward(grad_out, values, faces, (rast.reshape(-1, 4), uv, total),
                         constant(values.shape[1]), grad_values, grad_uv)
    return grad_values


def unpacked(rast, faces, vertex_count):
    """face_index and depth (H, W) of what rast sees. None: it or faces name what is not there."""
    face_index, depth = np.empty(rast.shape[:2], np.int32), np.empty(rast.shape[:2], np.float32)
    is_whole = unpack(rast.reshape(-1, 4), faces, vertex_count, face_index.reshape(-1),
                      depth.reshape(-1))
    return (face_index, depth) if is_whole else None


def blended_pairs(face_index, depth, clip, faces, opposite):
    """`outlines.blended_pairs`."""
    clip = np.asarray(clip, float)
    points, _ = compiled_pipeline.screen_vertices(clip, *face_index.shape[::-1])
    return compiled_pipeline.all_pairs(face_index, depth, clip, points, faces, opposite,
                                       walks=False)
