"""Pixel kernels: the colour of each pixel, and its gradient on the way back to the vertices.

    a thread a band    barycentric_rows  weights (5) of rasterization.py
                       colour_rows      colours (5) of lab 5
                       gradient_rows    the way back, summed along each run of pixels
    one thread         add_runs         runs -> vertices, in the order of the pixels

A run is a part of a row that sees one face. Pictures are flat: pixel = row * width + column, and
what the face's corners know is read once for a run. On the way back, each e_k of (9) in
rasterizer_gradients.py is linear along a run. So a run needs two sums for each edge, of grad_e_k
and of X grad_e_k, and writes to each of its vertices once.

The sums are those of NumPy's twin in another order: along each run first.
"""
import numpy as np

from course.given.compiled import kernel


@kernel
def run_end(face_index, start, end):
    """The end of the run that begins at pixel start, at most end."""
    face = face_index[start]
    pixel = start + np.uintp(1)
    while pixel < end and face_index[pixel] == face:
        pixel += np.uintp(1)
    return pixel


@kernel
def screen_corners(points, a, b, c):
    """x, y and w of three vertices."""
    return (points[a, 0], points[a, 1], points[a, 3], points[b, 0], points[b, 1], points[b, 3],
            points[c, 0], points[c, 1], points[c, 3])


@kernel
def weights_at(px, py, x0, y0, w0, x1, y1, w1, x2, y2, w2):
    """Eq. (5) of rasterization.py."""
    x0, y0, x1, y1, x2, y2 = x0 - px, y0 - py, x1 - px, y1 - py, x2 - px, y2 - py
    c0, c1, c2 = (x1 * y2 - y1 * x2) / w0, (x2 * y0 - y2 * x0) / w1, (x0 * y1 - y0 * x1) / w2
    s = c0 + c1 + c2
    return c0 / s, c1 / s, c2 / s


@kernel
def weigh(points, faces, face, row, first, start, end, weights):
    """Eq. (5) at the pixels of a run: weights, three arrays (H W,). 0 where no face is seen."""
    b0, b1, b2 = weights
    if face < 0:
        for pixel in range(start, end):
            b0[pixel] = b1[pixel] = b2[pixel] = 0.0
        return
    corners = screen_corners(points, faces[face, 0], faces[face, 1], faces[face, 2])
    for column in range(start - first, end - first):
        b0[first + column], b1[first + column], b2[first + column] = weights_at(
            np.int32(column) + 0.5, row + 0.5, *corners)


@kernel
def barycentric_rows(face_index, points, faces, width, bottom, top, weights):
    """What `barycentrics` finds in rows bottom <= row < top: weights, three arrays (H W,)."""
    for row in range(bottom, top):
        first, last = np.uintp(row * width), np.uintp((row + 1) * width)
        start = first
        while start < last:
            end = run_end(face_index, start, last)
            weigh(points, faces, face_index[start], row, first, start, end, weights)
            start = end


@kernel
def colour_rows(face_index, points, faces, colours, background, width, bottom, top, weights,
                picture):
    """The same, and `interpolate`. picture: flat, C numbers a pixel. background: a tuple of C
    numbers, so that C is known when this is compiled.
    """
    channels = np.uintp(len(background))
    b0, b1, b2 = weights
    for row in range(bottom, top):
        first, last = np.uintp(row * width), np.uintp((row + 1) * width)
        start = first
        while start < last:
            end = run_end(face_index, start, last)
            face = face_index[start]
            weigh(points, faces, face, row, first, start, end, weights)
            if face < 0:
                for pixel in range(start, end):
                    for k in range(channels):
                        picture[pixel * channels + k] = background[k]
            else:
                a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
                for pixel in range(start, end):
                    for k in range(channels):
                        picture[pixel * channels + k] = (0.0 + b0[pixel] * colours[a, k]
                                                         + b1[pixel] * colours[b, k]
                                                         + b2[pixel] * colours[c, k])
            start = end


@kernel
def are_there(faces, face, vertex_count):
    """Is it one of the faces, and are its corners vertices?"""
    if face >= len(faces):
        return False
    a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
    return min(a, b, c) >= 0 and max(a, b, c) < vertex_count


@kernel
def corner_at(clip, vertex, X, Y):
    """q_k of rasterizer_gradients.py: a corner, measured from the place X, Y in ndc."""
    w = clip[vertex, 3]
    return clip[vertex, 0] - X * w, clip[vertex, 1] - Y * w, w


@kernel
def unit_of(p, q, r):
    """A unit in which no product of two of the corners' numbers over- or underflows."""
    size = ((abs(p[0]) + abs(p[1]) + abs(p[2])) + (abs(q[0]) + abs(q[1]) + abs(q[2]))
            + (abs(r[0]) + abs(r[1]) + abs(r[2])))
    return min(1 / size, 1e300)


@kernel
def scaled(q, unit):
    """A corner in another unit."""
    return q[0] * unit, q[1] * unit, q[2] * unit


@kernel
def edge_along(p, q):
    """e of the edge from p to q, along a run: its value at the first pixel, and its slope in X."""
    return p[0] * q[1] - p[1] * q[0], p[1] * q[2] - p[2] * q[1]


@kernel
def edge_along_backward(grad_e, slope, p, q):
    """Gradients of p and q: grad_e is summed along the run, and slope is the sum of X grad_e."""
    # With G = (slope, 0, grad_e), G . (p x q) = p . (q x G) = q . (G x p).
    return ((q[1] * grad_e, q[2] * slope - q[0] * grad_e, -q[1] * slope),
            (-p[1] * grad_e, p[0] * grad_e - p[2] * slope, p[1] * slope))


@kernel
def weights_along(count, step, edge_0, edge_1, edge_2, b0, b1, b2, r):
    """b_k = e_k / s and 1 / s at each pixel of a run; of a face without area 1 / s counts as 0."""
    for i in range(count):
        X = np.int32(i) * step
        e0, e1, e2 = (edge_0[0] + edge_0[1] * X, edge_1[0] + edge_1[1] * X,
                      edge_2[0] + edge_2[1] * X)
        s = e0 + e1 + e2
        r[i] = 0.0 if s == 0 else 1 / s
        b0[i], b1[i], b2[i] = e0 * r[i], e1 * r[i], e2 * r[i]


@kernel
def edge_sums(count, step, h1, h2, b1, b2, r):
    """For each edge the sums along a run of grad_e_k, and of X grad_e_k.

    h1, h2: the gradients of b_1 and b_2 less that of b_0, as all three sum to 1.
    """
    sum0, sum1, sum2, slope0, slope1, slope2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(count):
        X = np.int32(i) * step
        mean = h1[i] * b1[i] + h2[i] * b2[i]
        g0, g1, g2 = -mean * r[i], (h1[i] - mean) * r[i], (h2[i] - mean) * r[i]
        sum0, sum1, sum2 = sum0 + g0, sum1 + g1, sum2 + g2
        slope0, slope1, slope2 = slope0 + X * g0, slope1 + X * g1, slope2 + X * g2
    return (sum0, slope0), (sum1, slope1), (sum2, slope2)


@kernel
def write_corner(record, run, at, X, Y, u, v):
    """Gradients u + v of q_k -> those of the corner's x, y and w."""
    x, y = u[0] + v[0], u[1] + v[1]
    record[run, at], record[run, at + 1] = x, y
    record[run, at + 2] = u[2] + v[2] - X * x - Y * y  # as q = (x - X w, y - Y w, w)


@kernel
def run_backward(grad_picture, grad_at, count, X, Y, step, clip, corners, colours, channels,
                 scratch, record, run):
    """The way back from count pixels that see one face. Their gradients begin at grad_at in the
    flat grad_picture, the first is seen at X, Y. For each corner record[run] becomes the gradients
    of x, y and w, and of C colours.
    """
    b0, b1, b2, r, h1, h2 = scratch
    a, b, c = corners
    size, stride = np.uintp(len(channels)), 3 + len(channels)
    q0, q1, q2 = corner_at(clip, a, X, Y), corner_at(clip, b, X, Y), corner_at(clip, c, X, Y)
    unit = unit_of(q0, q1, q2)
    q0, q1, q2 = scaled(q0, unit), scaled(q1, unit), scaled(q2, unit)
    weights_along(count, step, edge_along(q1, q2), edge_along(q2, q0), edge_along(q0, q1),
                  b0, b1, b2, r)
    for i in range(count):
        h1[i] = h2[i] = 0.0
    for k in range(size):
        to_b, to_c = colours[b, k] - colours[a, k], colours[c, k] - colours[a, k]
        sum0, sum1, sum2 = 0.0, 0.0, 0.0
        for i in range(count):
            grad = grad_picture[grad_at + i * size + k]
            sum0, sum1, sum2 = sum0 + b0[i] * grad, sum1 + b1[i] * grad, sum2 + b2[i] * grad
            h1[i] += grad * to_b
            h2[i] += grad * to_c
        record[run, 3 + k] = sum0
        record[run, stride + 3 + k] = sum1
        record[run, 2 * stride + 3 + k] = sum2
    g0, g1, g2 = edge_sums(count, step, h1, h2, b1, b2, r)
    g0, g1, g2 = (g0[0] * unit, g0[1] * unit), (g1[0] * unit, g1[1] * unit), (
        g2[0] * unit, g2[1] * unit)
    to_q1, to_q2 = edge_along_backward(*g0, q1, q2)
    also_q2, to_q0 = edge_along_backward(*g1, q2, q0)
    also_q0, also_q1 = edge_along_backward(*g2, q0, q1)
    write_corner(record, run, 0, X, Y, to_q0, also_q0)
    write_corner(record, run, stride, X, Y, to_q1, also_q1)
    write_corner(record, run, 2 * stride, X, Y, to_q2, also_q2)


@kernel
def rows_for(size):
    """Room for what `run_backward` finds along a run."""
    return (np.empty(size), np.empty(size), np.empty(size), np.empty(size), np.empty(size),
            np.empty(size))


@kernel
def gradient_rows(grad_picture, face_index, clip, faces, colours, channels, width, height, bottom,
                  top, run_face, record):
    """The way back from rows bottom <= row < top -> how many runs, each with its face and record.
    -1: a pixel sees a face, or a face has a vertex, that is not there.
    """
    scratch = rows_for(width)
    run = 0
    for row in range(bottom, top):
        first, last = np.uintp(row * width), np.uintp((row + 1) * width)
        Y = (2 * row + 1) / height - 1
        start = first
        while start < last:
            end = run_end(face_index, start, last)
            face = face_index[start]
            if face >= 0:
                if not are_there(faces, face, len(clip)):
                    return -1
                X = (2 * np.int32(start - first) + 1) / width - 1
                corners = faces[face, 0], faces[face, 1], faces[face, 2]
                run_backward(grad_picture, start * np.uintp(len(channels)), end - start, X, Y,
                             2 / width, clip, corners, colours, channels, scratch, record, run)
                run_face[run] = face
                run += 1
            start = end
    return run


@kernel
def gradient_pixels(grad_pixels, pixels, face_index, clip, faces, colours, channels, width, height,
                    run_face, record):
    """The same for single pixels (N,), which may repeat: runs of length 1. All are there."""
    scratch = rows_for(1)
    run = 0
    for n in range(np.uintp(len(pixels))):
        face = face_index[pixels[n]]
        if face >= 0:
            X = (2 * (pixels[n] % width) + 1) / width - 1
            Y = (2 * (pixels[n] // width) + 1) / height - 1
            corners = faces[face, 0], faces[face, 1], faces[face, 2]
            run_backward(grad_pixels, n * np.uintp(len(channels)), np.uintp(1), X, Y, 0.0, clip,
                         corners, colours, channels, scratch, record, run)
            run_face[run] = face
            run += 1
    return run


@kernel
def add_runs(faces, runs, run_face, record, grad):
    """Runs of `gradient_rows` -> grad (V, 4 + C), the gradients of clip and colours."""
    stride = grad.shape[1] - 1
    for run in range(runs):
        for k in range(3):
            vertex = faces[run_face[run], k]
            grad[vertex, 0] += record[run, k * stride]
            grad[vertex, 1] += record[run, k * stride + 1]
            for channel in range(2, stride):
                grad[vertex, channel + 1] += record[run, k * stride + channel]
