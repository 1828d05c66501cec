"""Pixel kernels: where on its face a pixel lies, its colour, and the way back to the vertices."""
import numpy as np

from course.given.compiled import kernel


@kernel
def barycentric_at(px, py, x0, y0, w0, x1, y1, w1, x2, y2, w2):
    """Lab 2's eq. (5), with its roundings."""
    x0, y0, x1, y1, x2, y2 = x0 - px, y0 - py, x1 - px, y1 - py, x2 - px, y2 - py
    c0, c1, c2 = (x1 * y2 - y1 * x2) / w0, (x2 * y0 - y2 * x0) / w1, (x0 * y1 - y0 * x1) / w2
    s = c0 + c1 + c2
    return c0 / s, c1 / s, c2 / s


@kernel
def shade_a(face_index, points, faces, colours, background, width, bottom, top, picture):
    """pixel by pixel"""
    channels = colours.shape[1]
    previous = -1
    a, b, c = 0, 0, 0
    x0, y0, w0, x1, y1, w1, x2, y2, w2 = 0., 0., 0., 0., 0., 0., 0., 0., 0.
    for row in range(bottom, top):
        py = row + 0.5
        for column in range(width):
            p = np.uintp(row * width + column)
            face = face_index[p]
            if face < 0:
                for k in range(channels):
                    picture[p, k] = background[k]
                continue
            if face != previous:
                a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
                x0, y0, w0 = points[a, 0], points[a, 1], points[a, 3]
                x1, y1, w1 = points[b, 0], points[b, 1], points[b, 3]
                x2, y2, w2 = points[c, 0], points[c, 1], points[c, 3]
                previous = face
            b0, b1, b2 = barycentric_at(column + 0.5, py, x0, y0, w0, x1, y1, w1, x2, y2, w2)
            for k in range(channels):
                picture[p, k] = (0.0 + b0 * colours[a, k]) + b1 * colours[b, k] + b2 * colours[c, k]


@kernel
def shade_b(face_index, points, faces, colours, background, width, bottom, top, picture):
    """run by run"""
    channels = colours.shape[1]
    B0, B1, B2 = np.empty(width), np.empty(width), np.empty(width)
    for row in range(bottom, top):
        py = row + 0.5
        base = row * width
        start = 0
        while start < width:
            face = face_index[np.uintp(base + start)]
            end = start + 1
            while end < width and face_index[np.uintp(base + end)] == face:
                end += 1
            if face < 0:
                for j in range(np.uintp(base + start), np.uintp(base + end)):
                    for k in range(channels):
                        picture[j, k] = background[k]
                start = end
                continue
            a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
            x0, y0, w0 = points[a, 0], points[a, 1], points[a, 3]
            x1, y1, w1 = points[b, 0], points[b, 1], points[b, 3]
            x2, y2, w2 = points[c, 0], points[c, 1], points[c, 3]
            for i in range(np.uintp(start), np.uintp(end)):
                B0[i], B1[i], B2[i] = barycentric_at(np.int32(i) + 0.5, py, x0, y0, w0, x1, y1, w1, x2, y2, w2)
            for k in range(channels):
                A0, A1, A2 = colours[a, k], colours[b, k], colours[c, k]
                for i in range(np.uintp(start), np.uintp(end)):
                    picture[np.uintp(base) + i, k] = (0.0 + B0[i] * A0) + B1[i] * A1 + B2[i] * A2
            start = end


@kernel
def shade_c(face_index, points, faces, colours, background, width, bottom, top, picture):
    """run by run"""
    channels = len(background)
    B0, B1, B2 = np.empty(width), np.empty(width), np.empty(width)
    out = picture.ravel()
    for row in range(bottom, top):
        py = row + 0.5
        base = row * width
        start = 0
        while start < width:
            face = face_index[np.uintp(base + start)]
            end = start + 1
            while end < width and face_index[np.uintp(base + end)] == face:
                end += 1
            if face < 0:
                for j in range(np.uintp(base + start), np.uintp(base + end)):
                    for k in range(channels):
                        out[j * np.uintp(channels) + np.uintp(k)] = background[k]
                start = end
                continue
            a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
            x0, y0, w0 = points[a, 0], points[a, 1], points[a, 3]
            x1, y1, w1 = points[b, 0], points[b, 1], points[b, 3]
            x2, y2, w2 = points[c, 0], points[c, 1], points[c, 3]
            for i in range(np.uintp(start), np.uintp(end)):
                B0[i], B1[i], B2[i] = barycentric_at(np.int32(i) + 0.5, py, x0, y0, w0, x1, y1, w1, x2, y2, w2)
            for i in range(np.uintp(start), np.uintp(end)):
                for k in range(channels):
                    out[(np.uintp(base) + i)*np.uintp(channels) + np.uintp(k)] = (0.0 + B0[i] * colours[a, k]) + B1[i] * colours[b, k] + B2[i] * colours[c, k]
            start = end
