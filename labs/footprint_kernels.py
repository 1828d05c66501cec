"""Footprint kernels: where each pixel looks up a texture, and the way back to (u, v) and to clip.

    footprint_rows              (5), (6) of rasterization.py and (5), (6) of interpolation.py
    add_to_uv                   the way back to the corners' (u, v)
    add_to_clip                 the way back to their positions, at the same time
    gather_rows, scatter_rows   only pixels that see a face have a footprint

A run is a part of a row that sees one face. What its corners know is read once for a run. Along it
each edge function is linear. So the way back needs some sums over each run, whatever the corner,
and writes to a corner once. Each result is summed by one thread, in the order of the pixels.
"""
import numpy as np

from course.given.compiled import cores, each_band, kernel

from . import interpolation, rasterization, texel_kernels
from .pipeline import Texture

BAND = 1 << 14  # pixels that a thread takes at a time


@kernel
def run_end(face_index, start, end):
    """The end of the run that begins at pixel start, at most end."""
    face = face_index[start]
    pixel = start + 1
    while pixel < end and face_index[pixel] == face:
        pixel += 1
    return pixel


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
def footprint_rows(face_index, screen, faces, uv, uv_faces, width, bottom, top, n, at, footprint):
    """The footprints of rows bottom <= row < top, of which the first seen pixel is number n.

    face_index (H W,), screen (V, 3): x, y, w -> at (2 N,), footprint (4 N,).
    """
    n = np.uintp(n)
    for row in range(bottom, top):
        start, last, py = row * width, (row + 1) * width, row + 0.5
        while start < last:
            end, face = run_end(face_index, start, last), face_index[start]
            if face >= 0:
                a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
                corners = (screen[a, 0], screen[a, 1], screen[a, 2], screen[b, 0], screen[b, 1],
                           screen[b, 2], screen[c, 0], screen[c, 1], screen[c, 2])
                a, b, c = uv_faces[face, 0], uv_faces[face, 1], uv_faces[face, 2]
                u0, u1, u2 = uv[a, 0], uv[b, 0], uv[c, 0]
                v0, v1, v2 = uv[a, 1], uv[b, 1], uv[c, 1]
                x0, x1, x2, y0, y1, y2 = edge_steps(*corners)
                x, y = x0 + x1 + x2, y0 + y1 + y2
                column = start - row * width
                for i in range(np.uintp(end - start)):
                    c0, c1, c2 = edges_at(column + np.int32(i) + 0.5, py, *corners)
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
                n += np.uintp(end - start)
            start = end


@kernel
def add_to_uv(face_index, screen, faces, uv_faces, width, grad_at, grad_footprint, grad_uv):
    """Adds the gradient with respect to (u, v) to grad_uv (T, 2), of all pixels in their order."""
    # At the i-th pixel of a run c_k = base_k + i dc_k, so with r = 1 / s a corner's (u, v) gets
    # b_k grad_at + db_k/dx grad_x + db_k/dy grad_y = c_k h + r (dc_k/dx grad_x + dc_k/dy grad_y),
    # where h = r (grad_at - r (ds/dx grad_x + ds/dy grad_y)).
    n = np.uintp(0)
    for row in range(len(face_index) // width):
        start, last, py = row * width, (row + 1) * width, row + 0.5
        while start < last:
            end, face = run_end(face_index, start, last), face_index[start]
            if face >= 0:
                a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
                corners = (screen[a, 0], screen[a, 1], screen[a, 2], screen[b, 0], screen[b, 1],
                           screen[b, 2], screen[c, 0], screen[c, 1], screen[c, 2])
                x0, x1, x2, y0, y1, y2 = edge_steps(*corners)
                c0, c1, c2 = edges_at(start - row * width + 0.5, py, *corners)
                s, x, y = c0 + c1 + c2, x0 + x1 + x2, y0 + y1 + y2
                u, u_i, u_x, u_y, v, v_i, v_x, v_y = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
                for i in range(np.uintp(end - start)):
                    r = 1 / (s + np.int32(i) * x)
                    k, l = np.uintp(2) * (n + i), np.uintp(4) * (n + i)
                    grad_x, grad_y = r * grad_footprint[l], r * grad_footprint[l + np.uintp(1)]
                    h = r * (grad_at[k] - (x * grad_x + y * grad_y))
                    u, u_i, u_x, u_y = u + h, u_i + np.int32(i) * h, u_x + grad_x, u_y + grad_y
                    k, l = k + np.uintp(1), l + np.uintp(2)
                    grad_x, grad_y = r * grad_footprint[l], r * grad_footprint[l + np.uintp(1)]
                    h = r * (grad_at[k] - (x * grad_x + y * grad_y))
                    v, v_i, v_x, v_y = v + h, v_i + np.int32(i) * h, v_x + grad_x, v_y + grad_y
                a, b, c = uv_faces[face, 0], uv_faces[face, 1], uv_faces[face, 2]
                u_i, v_i = u_i + u_x, v_i + v_x
                grad_uv[a, 0] += c0 * u + x0 * u_i + y0 * u_y
                grad_uv[a, 1] += c0 * v + x0 * v_i + y0 * v_y
                grad_uv[b, 0] += c1 * u + x1 * u_i + y1 * u_y
                grad_uv[b, 1] += c1 * v + x1 * v_i + y1 * v_y
                grad_uv[c, 0] += c2 * u + x2 * u_i + y2 * u_y
                grad_uv[c, 1] += c2 * v + x2 * v_i + y2 * v_y
                n += np.uintp(end - start)
            start = end


@kernel
def cross(p, q):
    return p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]


@kernel
def corner_from(clip, vertex, X, Y):
    """q_k of rasterizer_gradients.py."""
    w = clip[vertex, 3]
    return clip[vertex, 0] - X * w, clip[vertex, 1] - Y * w, w


@kernel
def add_corner(grad_clip, vertex, X, Y, p, G, q, H):
    """Adds p x G + H x q, the gradient of a corner seen from X, Y."""
    u, v = cross(p, G), cross(H, q)
    x, y, w = u[0] + v[0], u[1] + v[1], u[2] + v[2]
    grad_clip[vertex, 0] += x
    grad_clip[vertex, 1] += y
    grad_clip[vertex, 3] += w - X * x - Y * y


@kernel
def add_to_clip(face_index, clip, faces, uv, uv_faces, width, grad_at, grad_footprint, grad_clip):
    """Adds the gradient with respect to the corners to grad_clip (V, 4), of all pixels in order."""
    # Eqs. (7) and (8), with e, e_X and e_Y for the rows of the normals q_i x q_j. Let U_k be corner
    # k's u less that of corner 0, U = sum b_k U_k and dU = sum U_k db_k, in x and in y. Then the
    # gradients of e_k, e_X,k and e_Y,k for u are, with r = 1 / s and grad_x per X, not per pixel,
    #   (U_k - U) P - r (dU_x grad_x + dU_y grad_y),   P = r (grad_at - r (s_X grad_x + s_Y grad_y))
    #   (U_k - U) r grad_x,   (U_k - U) r grad_y
    # and those for v are alike. Where X grows by t along a run, e_k grows by t e_X,k.
    height, n = len(face_index) // width, np.uintp(0)
    step_x, step_y = 2 / width, 2 / height
    for row in range(height):
        start, last = row * width, (row + 1) * width
        Y = (2 * row + 1) / height - 1
        while start < last:
            end, face = run_end(face_index, start, last), face_index[start]
            if face >= 0:
                a, b, c = uv_faces[face, 0], uv_faces[face, 1], uv_faces[face, 2]
                u1, u2 = uv[b, 0] - uv[a, 0], uv[c, 0] - uv[a, 0]
                v1, v2 = uv[b, 1] - uv[a, 1], uv[c, 1] - uv[a, 1]
                a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
                X = (2 * (start - row * width) + 1) / width - 1
                q0, q1, q2 = (corner_from(clip, a, X, Y), corner_from(clip, b, X, Y),
                              corner_from(clip, c, X, Y))
                n0, n1, n2 = cross(q1, q2), cross(q2, q0), cross(q0, q1)
                s_x, s_y, s = n0[0] + n1[0] + n2[0], n0[1] + n1[1] + n2[1], n0[2] + n1[2] + n2[2]
                u_x, u_y, u_e = (u1 * n1[0] + u2 * n2[0], u1 * n1[1] + u2 * n2[1],
                                 u1 * n1[2] + u2 * n2[2])
                v_x, v_y, v_e = (v1 * n1[0] + v2 * n2[0], v1 * n1[1] + v2 * n2[1],
                                 v1 * n1[2] + v2 * n2[2])
                P, Q, R, P_t, Q_t, R_t = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
                P_x, Q_x, R_x, P_y, Q_y, R_y = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
                for i in range(np.uintp(end - start)):
                    t = np.int32(i) * step_x
                    d = s + t * s_x
                    r = 0.0 if d == 0 else 1 / d
                    u, v = (u_e + t * u_x) * r, (v_e + t * v_x) * r
                    k, l = np.uintp(2) * (n + i), np.uintp(4) * (n + i)
                    grad_ux = step_x * r * grad_footprint[l]
                    grad_uy = step_y * r * grad_footprint[l + np.uintp(1)]
                    grad_vx = step_x * r * grad_footprint[l + np.uintp(2)]
                    grad_vy = step_y * r * grad_footprint[l + np.uintp(3)]
                    p = r * (grad_at[k] - (s_x * grad_ux + s_y * grad_uy))
                    q = r * (grad_at[k + np.uintp(1)] - (s_x * grad_vx + s_y * grad_vy))
                    u_X, u_Y = r * (u_x - u * s_x), r * (u_y - u * s_y)
                    v_X, v_Y = r * (v_x - v * s_x), r * (v_y - v * s_y)
                    m = (u * p + v * q + u_X * grad_ux + u_Y * grad_uy + v_X * grad_vx
                         + v_Y * grad_vy)
                    P, Q, R = P + p, Q + q, R + m
                    P_t, Q_t, R_t = P_t + t * p, Q_t + t * q, R_t + t * m
                    P_x, Q_x, R_x = P_x + grad_ux, Q_x + grad_vx, R_x + (u * grad_ux + v * grad_vx)
                    P_y, Q_y, R_y = P_y + grad_uy, Q_y + grad_vy, R_y + (u * grad_uy + v * grad_vy)
                P_x, Q_x, R_x = P_x + P_t, Q_x + Q_t, R_x + R_t
                G0 = -R_x, -R_y, -R
                G1 = u1 * P_x + v1 * Q_x - R_x, u1 * P_y + v1 * Q_y - R_y, u1 * P + v1 * Q - R
                G2 = u2 * P_x + v2 * Q_x - R_x, u2 * P_y + v2 * Q_y - R_y, u2 * P + v2 * Q - R
                # g . (p x q) = p . (q x g) = q . (g x p)
                add_corner(grad_clip, a, X, Y, q1, G2, q2, G1)
                add_corner(grad_clip, b, X, Y, q2, G0, q0, G2)
                add_corner(grad_clip, c, X, Y, q0, G1, q1, G0)
                n += np.uintp(end - start)
            start = end


@kernel
def gather_rows(face_index, picture, rows, channels):
    """picture[seen], all flat."""
    size, n = np.uintp(len(channels)), np.uintp(0)
    for p in range(np.uintp(len(face_index))):
        if face_index[p] >= 0:
            for k in range(size):
                rows[n + np.uintp(k)] = picture[p * size + np.uintp(k)]
            n += size


@kernel
def scatter_rows(face_index, rows, picture, channels):
    """`masked_scatter` of the rows of seen pixels, all flat."""
    size, n = np.uintp(len(channels)), np.uintp(0)
    for p in range(np.uintp(len(face_index))):
        seen = face_index[p] >= 0
        for k in range(size):
            picture[p * size + np.uintp(k)] = rows[n + np.uintp(k)] if seen else 0.0
        n += size if seen else np.uintp(0)


def footprints(clip, face_index, faces, uv, uv_faces, threads=None):
    """`pipeline.footprints`, without barycentrics: (u, v) (N, 2) and their change (N, 2, 2)."""
    require_corners(face_index, uv, uv_faces)
    height, width = face_index.shape
    rows = max(BAND // max(width, 1), 1)
    bottoms = range(0, height, rows)
    seen = [np.count_nonzero(face_index[bottom:bottom + rows] >= 0) for bottom in bottoms]
    first = np.cumsum([0, *seen])
    at, footprint = np.empty((first[-1], 2)), np.empty((first[-1], 2, 2))
    screen = np.stack(rasterization.screen_points(clip, width, height), -1)
    given = face_index.ravel(), screen, faces, np.asarray(uv, float), uv_faces, width

    def band(bottom, n):
        footprint_rows(*given, bottom, min(bottom + rows, height), n, at.reshape(-1),
                       footprint.reshape(-1))

    list(each_band(band, list(zip(bottoms, first, strict=False)), threads or cores()))
    return at, footprint


def require_corners(face_index, uv, uv_faces):
    """IndexError if a seen face names a corner that does not exist. Kernels would read beside uv.
    """
    if uv_faces.size and not 0 <= uv_faces.min() <= uv_faces.max() < len(uv):
        nowhere = np.zeros((*face_index.shape, 3))
        interpolation.interpolation_matrix(len(uv), uv_faces, face_index, nowhere)


def footprints_backward(grad_at, grad_footprint, clip, face_index, faces, uv, uv_faces,
                        threads=None):
    """Backward of `footprints`: grad_at (N, 2), grad_footprint (N, 2, 2) -> grad_uv (T, 2),
    grad_clip (V, 4).
    """
    require_corners(face_index, uv, uv_faces)
    height, width = face_index.shape
    screen = np.stack(rasterization.screen_points(clip, width, height), -1)
    grads, flat = (grad_at.ravel(), grad_footprint.ravel()), face_index.ravel()
    uv, clip = np.asarray(uv, float), np.asarray(clip, float)
    grad_uv, grad_clip = np.zeros(uv.shape), np.zeros(clip.shape)
    tasks = [(add_to_uv, flat, screen, faces, uv_faces, width, *grads, grad_uv),
             (add_to_clip, flat, clip, faces, uv, uv_faces, width, *grads, grad_clip)]
    list(each_band(lambda task, *given: task(*given), tasks, threads or cores()))
    return grad_uv, grad_clip


def textured(clip, face_index, material, faces, threads=None):
    """`pipeline.textured` without other Buffers: the colour (H, W, C), 0 where no face is seen."""
    at, footprint = footprints(clip, face_index, faces, material.uv, material.uv_faces, threads)
    colour = texel_kernels.texture(material.image, at, footprint, filter=material.filter,
                                   threads=threads)
    picture = np.empty((*face_index.shape, colour.shape[1]))
    scatter_rows(face_index.ravel(), colour.ravel(), picture.reshape(-1),
                 texel_kernels.constant(colour.shape[1]))
    return picture


def textured_backward(grad_colour, clip, face_index, material, faces, threads=None):
    """Backward of `textured`: grad_colour (H, W, C) -> Texture of gradients, grad_clip (V, 4)."""
    where = clip, face_index, faces, material.uv, material.uv_faces, threads
    at, footprint = footprints(*where)
    grad_seen = np.empty((len(at), grad_colour.shape[2]))
    gather_rows(face_index.ravel(), grad_colour.ravel(), grad_seen.reshape(-1),
                texel_kernels.constant(grad_colour.shape[2]))
    grad_image, grad_at, grad_footprint, _ = texel_kernels.texture_backward(
        grad_seen, material.image, at, footprint, filter=material.filter, threads=threads)
    grad_uv, grad_clip = footprints_backward(grad_at, grad_footprint, *where)
    return Texture(grad_uv, None, grad_image, None), grad_clip
