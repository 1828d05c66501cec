"""Footprint kernels: where each pixel looks up a texture, and the way back to (u, v) and to clip.

    a thread a band    footprints_along   (5), (6) of rasterization.py and of interpolation.py
                       run_gradients      the way back, summed along each run of pixels
    one thread         add_to_corners     runs -> vertices and (u, v), in the order of the pixels

A run is a part of a row that sees one face. What its corners know is read once for a run. With the
normals n_k = q_i x q_j of rasterizer_gradients.py and the corners' u_k, a pixel looks at
u = sum u_k e_k / sum e_k, and all e_k of a run are linear in its n_k. So a run needs the gradients
of sum u_k n_k and of sum n_k alone, and writes to a corner once.
"""
import numpy as np

from course.given.compiled import each_band, kernel

from . import interpolation, pyramid_kernels, rasterization, texel_kernels
from .pipeline import Texture


@kernel
def seen_runs(face_index, width):
    """The runs of a flat picture (R, 3): first pixel, end, and what number the first pixel has
    among those that see a face.
    """
    runs, count, number = np.empty((len(face_index), 3), np.int32), 0, 0
    for first in range(0, len(face_index), max(width, 1)):
        start, last = first, first + width
        while start < last:
            end = start + 1
            while end < last and face_index[end] == face_index[start]:
                end += 1
            if face_index[start] >= 0:
                runs[count, 0], runs[count, 1], runs[count, 2] = start, end, number
                count, number = count + 1, number + end - start
            start = end
    return runs[:count].copy()


@kernel
def edges_at(px, py, x0, y0, w0, x1, y1, w1, x2, y2, w2):
    """c of eq. (5) of rasterization.py."""
    x0, y0, x1, y1, x2, y2 = x0 - px, y0 - py, x1 - px, y1 - py, x2 - px, y2 - py
    return (x1 * y2 - x2 * y1) / w0, (x2 * y0 - x0 * y2) / w1, (x0 * y1 - x1 * y0) / w2


@kernel
def edge_steps(x0, y0, w0, x1, y1, w1, x2, y2, w2):
    """dc/dx and dc/dy, the same all over the face."""
    return ((y1 - y2) / w0, (y2 - y0) / w1, (y0 - y1) / w2,
            (x2 - x1) / w0, (x0 - x2) / w1, (x1 - x0) / w2)


@kernel
def footprints_along(runs, face_index, screen, faces, uv, uv_faces, width, at, footprint):
    """The footprints of some runs: screen (V, 3): x, y, w -> at (2 N,), footprint (4 N,). False if
    a pixel sees a face, or a face has a vertex, that is not there.
    """
    for run in range(len(runs)):
        face, n = face_index[runs[run, 0]], np.uintp(runs[run, 2])
        if face >= min(len(faces), len(uv_faces)):
            return False
        a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
        if min(a, b, c) < 0 or max(a, b, c) >= len(screen):
            return False
        corners = (screen[a, 0], screen[a, 1], screen[a, 2], screen[b, 0], screen[b, 1],
                   screen[b, 2], screen[c, 0], screen[c, 1], screen[c, 2])
        a, b, c = uv_faces[face, 0], uv_faces[face, 1], uv_faces[face, 2]
        u0, u1, u2, v0, v1, v2 = uv[a, 0], uv[b, 0], uv[c, 0], uv[a, 1], uv[b, 1], uv[c, 1]
        x0, x1, x2, y0, y1, y2 = edge_steps(*corners)
        x, y = x0 + x1 + x2, y0 + y1 + y2
        px, py = runs[run, 0] % width + 0.5, runs[run, 0] // width + 0.5
        for i in range(np.uintp(runs[run, 1] - runs[run, 0])):
            c0, c1, c2 = edges_at(px + np.int32(i), py, *corners)
            s = c0 + c1 + c2
            b0, b1, b2 = c0 / s, c1 / s, c2 / s
            k = np.uintp(2) * (n + i)
            at[k] = 0.0 + b0 * u0 + b1 * u1 + b2 * u2
            at[k + np.uintp(1)] = 0.0 + b0 * v0 + b1 * v1 + b2 * v2
            k = k + k
            d0, d1, d2 = (x0 - b0 * x) / s, (x1 - b1 * x) / s, (x2 - b2 * x) / s
            footprint[k] = 0.0 + d0 * u0 + d1 * u1 + d2 * u2
            footprint[k + np.uintp(2)] = 0.0 + d0 * v0 + d1 * v1 + d2 * v2
            d0, d1, d2 = (y0 - b0 * y) / s, (y1 - b1 * y) / s, (y2 - b2 * y) / s
            footprint[k + np.uintp(1)] = 0.0 + d0 * u0 + d1 * u1 + d2 * u2
            footprint[k + np.uintp(3)] = 0.0 + d0 * v0 + d1 * v1 + d2 * v2
    return True


@kernel
def cross(p, q):
    """p x q of two tuples."""
    return p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]


@kernel
def unit_of_corners(clip, a, b, c):
    """1 / the largest x, y or w of a face: in such units no product of two over- or underflows."""
    largest = 0.0
    for vertex in (a, b, c):
        largest = max(largest, abs(clip[vertex, 0]), abs(clip[vertex, 1]), abs(clip[vertex, 3]))
    return min(1 / largest, 1e300)


@kernel
def corner_from(clip, vertex, X, Y, unit):
    """q_k of rasterizer_gradients.py."""
    x, y, w = clip[vertex, 0] * unit, clip[vertex, 1] * unit, clip[vertex, 3] * unit
    return x - X * w, y - Y * w, w


@kernel
def sums_along(weighted, whole, step_x, step_y, grad_at, grad_footprint, n, count, axis):
    """Along a run, for u (axis 0) or v: the gradient of weighted = sum u_k n_k, and less that of
    whole = sum n_k. The run's pixels are numbers n to n + count - 1.
    """
    # N = weighted, S = whole: u = N / S and du/dX = (N_X - u S_X) / S at N = N_e + t N_X, and so S.
    # With the gradients g of u, g_X of du/dX, g_Y: dL/dN = (g - (S_X g_X + S_Y g_Y) / S) / S = p,
    # dL/dN_X = g_X / S + t p,  -dL/dS = u p + (du/dX g_X + du/dY g_Y) / S,  -dL/dS_X = u g_X / S.
    p_x, p_y, p_e, p_t, m_x, m_y, m_e, m_t = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(count):
        t = np.int32(i) * step_x
        s = whole[2] + t * whole[0]
        r = 0.0 if s == 0 else 1 / s
        u = (weighted[2] + t * weighted[0]) * r
        k, l = np.uintp(2) * (n + i) + axis, np.uintp(4) * (n + i) + np.uintp(2) * axis
        g_x, g_y = r * step_x * grad_footprint[l], r * step_y * grad_footprint[l + np.uintp(1)]
        p = r * (grad_at[k] - (whole[0] * g_x + whole[1] * g_y))
        m = u * p + r * ((weighted[0] - u * whole[0]) * g_x + (weighted[1] - u * whole[1]) * g_y)
        p_x, p_y, p_e, p_t = p_x + g_x, p_y + g_y, p_e + p, p_t + t * p
        m_x, m_y, m_e, m_t = m_x + u * g_x, m_y + u * g_y, m_e + m, m_t + t * m
    return (p_x + p_t, p_y, p_e), (m_x + m_t, m_y, m_e)


@kernel
def corner_gradient(record, at, X, Y, unit, p, grad_p, q, grad_q):
    """n_p x p and q x n_q are two normals: their gradients -> those of x, y, w of the corner."""
    u, v = cross(p, grad_p), cross(grad_q, q)  # g . (p x q) = p . (q x g) = q . (g x p)
    x, y = u[0] + v[0], u[1] + v[1]
    record[at], record[at + 1] = x * unit, y * unit
    record[at + 2] = (u[2] + v[2] - X * x - Y * y) * unit


@kernel
def run_gradients(runs, face_index, clip, faces, uv, uv_faces, width, grad_at, grad_footprint,
                  record):
    """The way back from some runs: record[run] becomes the gradients of x, y, w of three corners,
    and of (u, v) of three.
    """
    height = len(face_index) // max(width, 1)
    for run in range(len(runs)):
        start, face = runs[run, 0], face_index[runs[run, 0]]
        X, Y = (2 * (start % width) + 1) / width - 1, (2 * (start // width) + 1) / height - 1
        a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
        unit = unit_of_corners(clip, a, b, c)
        q0, q1, q2 = (corner_from(clip, a, X, Y, unit), corner_from(clip, b, X, Y, unit),
                      corner_from(clip, c, X, Y, unit))
        n0, n1, n2 = cross(q1, q2), cross(q2, q0), cross(q0, q1)
        whole = n0[0] + n1[0] + n2[0], n0[1] + n1[1] + n2[1], n0[2] + n1[2] + n2[2]
        g0, g1, g2 = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        for axis in range(2):
            u0 = uv[uv_faces[face, 0], axis]  # u is measured from it, for the sake of digits
            u1, u2 = uv[uv_faces[face, 1], axis] - u0, uv[uv_faces[face, 2], axis] - u0
            weighted = (u1 * n1[0] + u2 * n2[0], u1 * n1[1] + u2 * n2[1], u1 * n1[2] + u2 * n2[2])
            p, m = sums_along(weighted, whole, 2 / width, 2 / height, grad_at, grad_footprint,
                              np.uintp(runs[run, 2]), np.uintp(runs[run, 1] - start),
                              np.uintp(axis))
            g0 = g0[0] - m[0], g0[1] - m[1], g0[2] - m[2]
            g1 = g1[0] + u1 * p[0] - m[0], g1[1] + u1 * p[1] - m[1], g1[2] + u1 * p[2] - m[2]
            g2 = g2[0] + u2 * p[0] - m[0], g2[1] + u2 * p[1] - m[1], g2[2] + u2 * p[2] - m[2]
            record[run, 9 + axis] = n0[0] * p[0] + n0[1] * p[1] + n0[2] * p[2]
            record[run, 11 + axis] = n1[0] * p[0] + n1[1] * p[1] + n1[2] * p[2]
            record[run, 13 + axis] = n2[0] * p[0] + n2[1] * p[1] + n2[2] * p[2]
        corner_gradient(record[run], 0, X, Y, unit, q1, g2, q2, g1)
        corner_gradient(record[run], 3, X, Y, unit, q2, g0, q0, g2)
        corner_gradient(record[run], 6, X, Y, unit, q0, g1, q1, g0)


@kernel
def add_to_corners(runs, face_index, faces, uv_faces, record, grad_clip, grad_uv):
    """Runs of `run_gradients` -> grad_clip (V, 4), grad_uv (T, 2)."""
    for run in range(len(runs)):
        for k in range(3):
            vertex = faces[face_index[runs[run, 0]], k]
            corner = uv_faces[face_index[runs[run, 0]], k]
            grad_clip[vertex, 0] += record[run, 3 * k]
            grad_clip[vertex, 1] += record[run, 3 * k + 1]
            grad_clip[vertex, 3] += record[run, 3 * k + 2]
            grad_uv[corner, 0] += record[run, 9 + 2 * k]
            grad_uv[corner, 1] += record[run, 10 + 2 * k]


def runs_in_bands(face_index):
    """The runs of a picture (H, W), in bands of about so many pixels as a thread takes."""
    runs = seen_runs(face_index.ravel(), face_index.shape[1])
    count = 1 + face_index.size // pyramid_kernels.STEP
    return [(band,) for band in np.array_split(runs, count)]


def footprints(clip, face_index, faces, uv, uv_faces, bands):
    """`pipeline.footprints`, without barycentrics: (u, v) (N, 2) and their change (N, 2, 2)."""
    require_corners(face_index, uv, uv_faces)
    height, width = face_index.shape
    count = np.count_nonzero(face_index >= 0)
    at, footprint = np.empty((count, 2)), np.empty((count, 2, 2))
    screen = np.stack(rasterization.screen_points(clip, width, height), -1)

    def band(runs):
        return footprints_along(runs, face_index.ravel(), screen, faces, uv, uv_faces, width,
                                at.reshape(-1), footprint.reshape(-1))

    if not all(list(each_band(band, bands))):
        raise IndexError("face_index names faces that are not there, or faces name vertices that "
                         "are not there: give the faces of this picture")
    return at, footprint


def require_corners(face_index, uv, uv_faces):
    """IndexError if a seen face names a corner that does not exist. Kernels would read beside uv.
    """
    if uv_faces.size and not 0 <= uv_faces.min() <= uv_faces.max() < len(uv):
        nowhere = np.zeros((*face_index.shape, 3))
        interpolation.interpolation_matrix(len(uv), uv_faces, face_index, nowhere)


def footprints_backward(grad_at, grad_footprint, clip, face_index, faces, uv, uv_faces, bands):
    """Backward of `footprints`: grad_at (N, 2), grad_footprint (N, 2, 2) -> grad_uv (T, 2),
    grad_clip (V, 4).
    """
    given = face_index.ravel(), clip, faces, uv, uv_faces, face_index.shape[1]
    grad_clip, grad_uv = np.zeros(clip.shape), np.zeros(uv.shape)

    def band(runs):
        record = np.empty((len(runs), 15))
        run_gradients(runs, *given, grad_at.ravel(), grad_footprint.ravel(), record)
        return runs, record

    for runs, record in each_band(band, bands):
        add_to_corners(runs, face_index.ravel(), faces, uv_faces, record, grad_clip, grad_uv)
    return grad_uv, grad_clip


def textured(clip, face_index, material, faces):
    """`pipeline.textured` without other Buffers: the colour (H, W, C), 0 where no face is seen."""
    at, footprint = footprints(clip, face_index, faces, np.asarray(material.uv, float),
                               material.uv_faces, runs_in_bands(face_index))
    picture = np.zeros((*face_index.shape, material.image.shape[2]))
    picture[face_index >= 0] = texel_kernels.texture(material.image, at, footprint,
                                                     filter=material.filter)
    return picture


def textured_backward(grad_colour, clip, face_index, material, faces):
    """Backward of `textured`: grad_colour (H, W, C) -> Texture of gradients, grad_clip (V, 4)."""
    where = (clip, face_index, faces, np.asarray(material.uv, float), material.uv_faces,
             runs_in_bands(face_index))
    at, footprint = footprints(*where)
    grad_image, grad_at, grad_footprint, _ = texel_kernels.texture_backward(
        grad_colour[face_index >= 0], material.image, at, footprint, filter=material.filter)
    grad_uv, grad_clip = footprints_backward(grad_at, grad_footprint, *where)
    return Texture(grad_uv, None, grad_image, None), grad_clip
