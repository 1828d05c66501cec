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
from collections import namedtuple

import numpy as np

from course.given.compiled import kernel

# A flat picture: the face that each pixel sees (H W,), -1 for none, and its sides.
Grid = namedtuple("Grid", "face_index width height")

# What is seen: vertices (V, 4), on screen or in clip space, faces (F, 3), colours (V, C).
Shape = namedtuple("Shape", "vertices faces colours")

# Pixels start <= pixel < end that see one face, of the row that begins at pixel first.
Run = namedtuple("Run", "face row first start end")

# Pixels that see one face: where their gradients begin, how many they are, the place of the first
# in ndc, and the step to the next.
Sight = namedtuple("Sight", "face begin count X Y step")

# Of a face: x, y and w on screen. Or q_k of rasterizer_gradients.py.
Vertex = namedtuple("Vertex", "x y w")

# An e along a run: its value at the first pixel, and its slope in X. Or the gradients of both: the
# sum of grad_e along the run, and that of X grad_e.
Line = namedtuple("Line", "value slope")

# At each pixel of a run: b_k, 1 / s, and the gradients of b_1 and b_2 less that of b_0.
Along = namedtuple("Along", "b0 b1 b2 r h1 h2")

# Of R runs: the face (R,), and what its corners get, x, y, w (R, 3, 3) and colours (R, 3, C).
Records = namedtuple("Records", "face corners colours")


@kernel
def row_of(grid, row):
    """The first pixel of a row, and that of the next."""
    return np.uintp(row * grid.width), np.uintp((row + 1) * grid.width)


@kernel
def run_at(grid, row, start):
    """The run that begins at a pixel of a row."""
    first, last = row_of(grid, row)
    face = grid.face_index[start]
    end = start + np.uintp(1)
    while end < last and grid.face_index[end] == face:
        end += np.uintp(1)
    return Run(face, row, first, start, end)


@kernel
def vertex(points, v):
    """Where a vertex is on screen."""
    return Vertex(points[v, 0], points[v, 1], points[v, 3])


@kernel
def weights_at(x, y, a, b, c):
    """Eq. (5) of rasterization.py."""
    x0, y0, x1, y1, x2, y2 = a.x - x, a.y - y, b.x - x, b.y - y, c.x - x, c.y - y
    c0, c1, c2 = (x1 * y2 - y1 * x2) / a.w, (x2 * y0 - y2 * x0) / b.w, (x0 * y1 - y0 * x1) / c.w
    s = c0 + c1 + c2
    return c0 / s, c1 / s, c2 / s


@kernel
def weigh(points, faces, run, weights):
    """Eq. (5) at the pixels of a run: weights (3, H W). 0 where no face is seen."""
    if run.face < 0:
        for pixel in range(run.start, run.end):
            weights[0, pixel] = weights[1, pixel] = weights[2, pixel] = 0.0
        return
    i, j, k = faces[run.face, 0], faces[run.face, 1], faces[run.face, 2]
    a, b, c = vertex(points, i), vertex(points, j), vertex(points, k)
    for column in range(run.start - run.first, run.end - run.first):
        pixel = run.first + column
        weights[0, pixel], weights[1, pixel], weights[2, pixel] = weights_at(
            np.int32(column) + 0.5, run.row + 0.5, a, b, c)


@kernel
def barycentric_rows(grid, points, faces, rows, weights):
    """What `barycentrics` finds on the rows bottom <= row < top: weights (3, H W)."""
    for row in range(*rows):
        start, last = row_of(grid, row)
        while start < last:
            run = run_at(grid, row, start)
            weigh(points, faces, run, weights)
            start = run.end


@kernel
def colour_rows(grid, shape, rows, background, weights, picture):
    """The same, and `interpolate`. picture: flat, C numbers a pixel. background: a tuple of C
    numbers, so that C is known when this is compiled.
    """
    for row in range(*rows):
        start, last = row_of(grid, row)
        while start < last:
            run = run_at(grid, row, start)
            weigh(shape.vertices, shape.faces, run, weights)
            if run.face < 0:
                fill_run(run, background, picture)
            else:
                colour_run(shape, run, np.uintp(len(background)), weights, picture)
            start = run.end


@kernel
def fill_run(run, background, picture):
    """The colour of a run that sees no face."""
    channels = np.uintp(len(background))
    for pixel in range(run.start, run.end):
        for k in range(channels):
            picture[pixel * channels + k] = background[k]


@kernel
def colour_run(shape, run, channels, weights, picture):
    """The colours of a run that sees a face."""
    _, faces, colours = shape
    a, b, c = faces[run.face, 0], faces[run.face, 1], faces[run.face, 2]
    for pixel in range(run.start, run.end):
        for k in range(channels):
            picture[pixel * channels + k] = (0.0 + weights[0, pixel] * colours[a, k]
                                             + weights[1, pixel] * colours[b, k]
                                             + weights[2, pixel] * colours[c, k])


@kernel
def are_there(faces, face, vertex_count):
    """Is it one of the faces, and are its corners vertices?"""
    if face >= len(faces):
        return False
    a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
    return min(a, b, c) >= 0 and max(a, b, c) < vertex_count


@kernel
def seen_from(clip, v, sight):
    """q_k of rasterizer_gradients.py: a corner, measured from the place X, Y in ndc."""
    w = clip[v, 3]
    return Vertex(clip[v, 0] - sight.X * w, clip[v, 1] - sight.Y * w, w)


@kernel
def unit_of(p, q, r):
    """A unit in which no product of two of the corners' numbers over- or underflows."""
    size = ((abs(p.x) + abs(p.y) + abs(p.w)) + (abs(q.x) + abs(q.y) + abs(q.w))
            + (abs(r.x) + abs(r.y) + abs(r.w)))
    return min(1 / size, 1e300)


@kernel
def scaled(q, unit):
    """A corner in another unit."""
    return Vertex(q.x * unit, q.y * unit, q.w * unit)


@kernel
def edge_along(p, q):
    """e of the edge from p to q, along a run."""
    return Line(p.x * q.y - p.y * q.x, p.y * q.w - p.w * q.y)


@kernel
def edge_along_backward(grad, p, q):
    """The gradients of p and q, from those of e and its slope."""
    # With G = (slope, 0, grad_e), G . (p x q) = p . (q x G) = q . (G x p).
    return (Vertex(q.y * grad.value, q.w * grad.slope - q.x * grad.value, -q.y * grad.slope),
            Vertex(-p.y * grad.value, p.x * grad.value - p.w * grad.slope, p.y * grad.slope))


@kernel
def weights_along(sight, edge_0, edge_1, edge_2, along):
    """b_k = e_k / s and 1 / s at each pixel of a run; of a face without area 1 / s counts as 0."""
    b0, b1, b2, r, _, _ = along
    for i in range(sight.count):
        X = np.int32(i) * sight.step
        e0 = edge_0.value + edge_0.slope * X
        e1 = edge_1.value + edge_1.slope * X
        e2 = edge_2.value + edge_2.slope * X
        s = e0 + e1 + e2
        r[i] = 0.0 if s == 0 else 1 / s
        b0[i], b1[i], b2[i] = e0 * r[i], e1 * r[i], e2 * r[i]


@kernel
def edge_sums(sight, along, unit):
    """For each edge the gradients of its e, and of its slope, in that unit."""
    _, b1, b2, r, h1, h2 = along
    sum0, sum1, sum2, slope0, slope1, slope2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(sight.count):
        X = np.int32(i) * sight.step
        mean = h1[i] * b1[i] + h2[i] * b2[i]
        g0, g1, g2 = -mean * r[i], (h1[i] - mean) * r[i], (h2[i] - mean) * r[i]
        sum0, sum1, sum2 = sum0 + g0, sum1 + g1, sum2 + g2
        slope0, slope1, slope2 = slope0 + X * g0, slope1 + X * g1, slope2 + X * g2
    return (Line(sum0 * unit, slope0 * unit), Line(sum1 * unit, slope1 * unit),
            Line(sum2 * unit, slope2 * unit))


@kernel
def colours_backward(grad_picture, sight, shape, channels, along, n, records):
    """The way back from the colours along a run: to its corners' colours, and to h1 and h2."""
    b0, b1, b2, _, h1, h2 = along
    size = np.uintp(len(channels))
    _, faces, colours = shape
    a, b, c = faces[sight.face, 0], faces[sight.face, 1], faces[sight.face, 2]
    for i in range(sight.count):
        h1[i] = h2[i] = 0.0
    for k in range(size):
        to_b, to_c = colours[b, k] - colours[a, k], colours[c, k] - colours[a, k]
        sum0, sum1, sum2 = 0.0, 0.0, 0.0
        for i in range(sight.count):
            grad = grad_picture[sight.begin + i * size + k]
            sum0, sum1, sum2 = sum0 + b0[i] * grad, sum1 + b1[i] * grad, sum2 + b2[i] * grad
            h1[i] += grad * to_b
            h2[i] += grad * to_c
        records.colours[n, 0, k] = sum0
        records.colours[n, 1, k] = sum1
        records.colours[n, 2, k] = sum2


@kernel
def vertex_backward(u, v, sight, n, k, records):
    """Gradients u + v of q_k -> those of the corner's x, y and w."""
    x, y = u.x + v.x, u.y + v.y
    records.corners[n, k, 0] = x
    records.corners[n, k, 1] = y
    # as q = (x - X w, y - Y w, w)
    records.corners[n, k, 2] = u.w + v.w - sight.X * x - sight.Y * y


@kernel
def run_backward(grad_picture, sight, shape, channels, along, n, records):
    """The way back from pixels that see one face, in a flat grad_picture -> record n."""
    clip, faces, _ = shape
    face = sight.face
    q0 = seen_from(clip, faces[face, 0], sight)
    q1 = seen_from(clip, faces[face, 1], sight)
    q2 = seen_from(clip, faces[face, 2], sight)
    unit = unit_of(q0, q1, q2)
    q0, q1, q2 = scaled(q0, unit), scaled(q1, unit), scaled(q2, unit)
    weights_along(sight, edge_along(q1, q2), edge_along(q2, q0), edge_along(q0, q1), along)
    colours_backward(grad_picture, sight, shape, channels, along, n, records)
    g0, g1, g2 = edge_sums(sight, along, unit)
    to_q1, to_q2 = edge_along_backward(g0, q1, q2)
    also_q2, to_q0 = edge_along_backward(g1, q2, q0)
    also_q0, also_q1 = edge_along_backward(g2, q0, q1)
    vertex_backward(to_q0, also_q0, sight, n, 0, records)
    vertex_backward(to_q1, also_q1, sight, n, 1, records)
    vertex_backward(to_q2, also_q2, sight, n, 2, records)
    records.face[n] = face


@kernel
def room_along(size):
    """Room for what `run_backward` finds along a run."""
    return Along(np.empty(size), np.empty(size), np.empty(size), np.empty(size), np.empty(size),
                 np.empty(size))


@kernel
def gradient_rows(grad_picture, grid, shape, rows, channels, records):
    """The way back from the rows bottom <= row < top -> how many runs, each with its record. -1: a
    pixel sees a face, or a face has a vertex, that is not there.
    """
    along = room_along(grid.width)
    n = 0
    for row in range(*rows):
        start, last = row_of(grid, row)
        Y = (2 * row + 1) / grid.height - 1
        while start < last:
            run = run_at(grid, row, start)
            if run.face >= 0:
                if not are_there(shape.faces, run.face, len(shape.vertices)):
                    return -1
                X = (2 * np.int32(start - run.first) + 1) / grid.width - 1
                sight = Sight(run.face, start * np.uintp(len(channels)), run.end - start, X, Y,
                              2 / grid.width)
                run_backward(grad_picture, sight, shape, channels, along, n, records)
                n += 1
            start = run.end
    return n


@kernel
def add_runs(faces, count, records, grad_clip, grad_colours):
    """The first of the records -> grad_clip (V, 4), grad_colours (V, C)."""
    for n in range(count):
        for k in range(3):
            vertex = faces[records.face[n], k]
            grad_clip[vertex, 0] += records.corners[n, k, 0]
            grad_clip[vertex, 1] += records.corners[n, k, 1]
            grad_clip[vertex, 3] += records.corners[n, k, 2]
            for channel in range(grad_colours.shape[1]):
                grad_colours[vertex, channel] += records.colours[n, k, channel]
