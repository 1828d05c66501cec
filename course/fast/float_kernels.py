"""Float kernels: what apps/bridge does with float32 numbers, there and back, as compiled loops.

    draw_pixels                       labs 2, 5 and 7, by put_pixels and, on the way back,
                                      footprint_kernels
    interpolated                      lab 5, by mix_corners
    blended_pairs, blend_pairs        lab 8 as nvdiffrast has it, by pair_kernels
    blend_pairs_backward

rast (H, W, 4) has u, v, z/w and the face's number + 1, rast_db du/dX, du/dY, dv/dX, dv/dY.

Arithmetic is of 64 bits, and what is found is NumPy's to rounding.
"""
import numpy as np

from course.given.compiled import kernel

from . import compiled_pipeline, footprint_kernels, scanline
from .compiled_pipeline import on_all_cores
from .texel_kernels import constant

blend_pairs = compiled_pipeline.blend_pairs
blend_pairs_backward = compiled_pipeline.blend_pairs_backward
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
def put_pixels(seen, points, faces, first, rows, rasts):
    """Writes some rows of rast (P, 4), and of rast_db (P, 4) by eq. (6) there. seen: face_index and
    depth (P,), and the width. Faces are numbered from first on.
    """
    (face_index, depth, width), (rast, rast_db) = seen, rasts
    for row in range(*rows):
        p, last = np.uintp(row * width), np.uintp((row + 1) * width)
        while p < last:
            face, start = face_index[p], p
            p += np.uintp(1)
            while p < last and face_index[p] == face:
                p += np.uintp(1)
            if face >= 0:
                put_run((np.intp(face), row, start - np.uintp(row * width)), (start, p), depth,
                        points, faces, first, rasts)
            else:
                rast[start:p] = rast_db[start:p] = 0


@kernel
def put_run(where, pixels, depth, points, faces, first, rasts):
    """Those of neighbours in a row that see one face. where: face, row, first column."""
    (face, row, column), (rast, rast_db) = where, rasts
    x, y = np.int32(column) + 0.5, row + 0.5
    i, j, k = corners_of(faces, np.uintp(face))
    a, a_x, a_y = edge_line(points, j, k, i, x, y)
    b, b_x, b_y = edge_line(points, k, i, j, x, y)
    c, c_x, c_y = edge_line(points, i, j, k, x, y)
    s, s_x, s_y = a + b + c, a_x + b_x + c_x, a_y + b_y + c_y
    for p in range(*pixels):
        t = np.int32(p - pixels[0])
        r = 1 / (s + t * s_x)
        u, v = (a + t * a_x) * r, (b + t * b_x) * r
        rast[p, 0], rast[p, 1], rast[p, 2], rast[p, 3] = u, v, depth[p], face + first + 1
        rast_db[p, 0], rast_db[p, 1] = (a_x - u * s_x) * r, (a_y - u * s_y) * r
        rast_db[p, 2], rast_db[p, 3] = (b_x - v * s_x) * r, (b_y - v * s_y) * r


@kernel
def mix_corners(values, faces, rasts, chosen, channels, part, outs):
    """Eq. (5) of interpolation.py at pixels of a part, values (V, A), and how those chosen (D,)
    change -> whether all is there. rasts: rast and rast_db (P, 4). channels: a tuple of A numbers,
    so that A is known when this is compiled. outs: where (P, A) and (P, 2 D) are written.
    """
    (rast, rast_db), (out, out_da) = rasts, outs
    for p in range(np.uintp(part[0]), np.uintp(part[1])):
        face = face_in(rast, p)
        if face >= len(faces):
            return False
        if face < 0:
            for c in range(np.uintp(len(channels))):
                out[p, c] = 0
            for d in range(np.uintp(2 * len(chosen))):
                out_da[p, d] = 0
            continue
        i, j, k = corners_of(faces, np.uintp(face))
        u, v = np.float64(rast[p, 0]), np.float64(rast[p, 1])
        for c in range(np.uintp(len(channels))):
            out[p, c] = u * values[i, c] + v * values[j, c] + (1.0 - u - v) * values[k, c]
        for d in range(len(chosen)):
            along_u, along_v = slopes(values, i, j, k, chosen[d])
            out_da[p, 2 * d] = rast_db[p, 0] * along_u + rast_db[p, 2] * along_v
            out_da[p, 2 * d + 1] = rast_db[p, 1] * along_u + rast_db[p, 3] * along_v
    return part[0] > 0 or are_vertices(faces, len(values))


@kernel
def slopes(values, i, j, k, c):
    """How a face's attribute c changes with u and with v."""
    last = np.float64(values[k, c])
    return values[i, c] - last, values[j, c] - last


@kernel
def mix_corners_backward(grad_out, values, faces, rast, channels, grad_values, grad_rast):
    """Eq. (7): grad_out (P, A) adds to grad_values (V, A), and goes to grad_rast (P, 4)."""
    for p in range(np.uintp(len(rast))):
        face = face_in(rast, p)
        if face >= 0:
            i, j, k = corners_of(faces, np.uintp(face))
            u, v, grad_u, grad_v = np.float64(rast[p, 0]), np.float64(rast[p, 1]), 0.0, 0.0
            for c in range(np.uintp(len(channels))):
                grad = np.float64(grad_out[p, c])
                along_u, along_v = slopes(values, i, j, k, c)
                grad_u, grad_v = grad_u + grad * along_u, grad_v + grad * along_v
                grad_values[i, c] += u * grad
                grad_values[j, c] += v * grad
                grad_values[k, c] += (1.0 - u - v) * grad
            grad_rast[p, 0], grad_rast[p, 1] = grad_u, grad_v


@kernel
def slopes_backward(grad_da, values, faces, rasts, chosen, grad_values, grad_db):
    """The same from grad_da (P, 2 D)."""
    rast, rast_db = rasts
    for p in range(np.uintp(len(rast))):
        face = face_in(rast, p)
        if face >= 0:
            i, j, k = corners_of(faces, np.uintp(face))
            for n in range(2 * len(chosen)):
                c, axis, grad = chosen[n // 2], n % 2, np.float64(grad_da[p, n])
                along_u, along_v = slopes(values, i, j, k, c)
                grad_db[p, axis] += grad * along_u
                grad_db[p, 2 + axis] += grad * along_v
                by_u, by_v = grad * rast_db[p, axis], grad * rast_db[p, 2 + axis]
                grad_values[i, c] += by_u
                grad_values[j, c] += by_v
                grad_values[k, c] -= by_u + by_v


def draw_pixels(clip, faces, first, beyond, rast, rast_db):
    """Writes to rast and rast_db (H, W, 4) -> face_index, depth (H, W). Faces are numbered from
    first on. beyond: a depth (H, W), of which only what lies deeper is seen, or None.
    """
    height, width, _ = rast.shape
    clip = np.ascontiguousarray(clip, float)
    if beyond is None:
        points, face_index, depth = compiled_pipeline.seen(clip, faces, width, height)
    else:
        points, _ = compiled_pipeline.screen_vertices(clip, width, height)
        face_index, depth = scanline.rasterize(clip, faces, width, height, beyond)
    given = (face_index.ravel(), depth.ravel(), width), points, faces, first
    rasts = rast.reshape(-1, 4), rast_db.reshape(-1, 4)
    on_all_cores(lambda *rows: put_pixels(*given, rows, rasts), height, face_index.size)
    return face_index, depth


def draw_pixels_backward(grad_rast, grad_rast_db, face_index, clip, faces, epsilon):
    """Backward of `draw_pixels` -> grad_clip (V, 4). A gradient that is None is 0."""
    faces = faces[:, (2, 0, 1)]  # the first one has 0 for u and for v
    mesh = footprint_kernels.Wrapped(np.asarray(clip, float), faces, *UNIT, epsilon)
    grads = (np.zeros((size, 4), np.float32) if grad is None else grad.reshape(-1, 4)
             for grad, size in ((grad_rast, face_index.size), (grad_rast_db, 0)))
    bands = footprint_kernels.runs_in_bands(face_index, counts_all=True)
    return footprint_kernels.gradients(*grads, footprint_kernels.flat(face_index), mesh, bands)[1]


def interpolated(values, faces, rast, rast_db, chosen):
    """Lab 5's `interpolate` of values (V, A) at the pixels of rast (H, W, 4) -> (P, A), and how
    those chosen (D,) change (P, 2 D). None: rast or faces name what is not there.
    """
    size, channels = rast.shape[0] * rast.shape[1], constant(values.shape[1])
    outs = tuple(np.empty((size, count), np.float32) for count in (len(channels), 2 * len(chosen)))
    given = values, faces, (rast.reshape(-1, 4), rast_db.reshape(-1, 4)), chosen, channels
    are_whole = on_all_cores(lambda *part: mix_corners(*given, part, outs), size, size)
    return outs if all(are_whole) else None


def interpolated_backward(grad_out, grad_da, values, faces, rast, rast_db, chosen):
    """Backward of `interpolated` -> gradients of values, rast and rast_db. grad_out and grad_da may
    be None.
    """
    grads = np.zeros(values.shape), np.zeros_like(rast), np.zeros_like(rast_db)
    (rast, rast_db), (by_rast, by_db) = ([each.reshape(-1, 4) for each in pair]
                                         for pair in ((rast, rast_db), grads[1:]))
    if grad_out is not None:
        mix_corners_backward(grad_out, values, faces, rast, constant(values.shape[1]), grads[0],
                             by_rast)
    if grad_da is not None:
        slopes_backward(grad_da, values, faces, (rast, rast_db), chosen, grads[0], by_db)
    return grads


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
