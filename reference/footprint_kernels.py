"""Footprint kernels: where each pixel looks up the texture, and the way back to (u, v) and clip.

    footprint_rows      (5), (6) of rasterization.py and of interpolation.py, a band of rows a thread
    add_to_uv           the way back to the corners' (u, v)
    add_to_clip         the way back to the corners' positions, at the same time on another thread

A run is a part of a row that sees one face. What its corners know is read once for a run. On the
way back, only sums over a run are needed, because along it each edge function is linear. So each
corner is written to once. Pixels that see no face have no place in the arrays of footprints.
"""
import numpy as np

from course.given.compiled import cores, each_band, kernel

from . import interpolation, mipmapping, rasterization
from .arrays import masked_scatter
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
