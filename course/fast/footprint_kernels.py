"""Footprint kernels: where each pixel looks up a texture, and the way back to (u, v) and to clip.

    a thread a band    footprints_along   (3) to (6) of interpolation.py
                       run_gradients      the way back, summed along each run of pixels
    one thread         add_to_corners     runs -> vertices and (u, v), in the order of the pixels

A run is a part of a row that sees one face. What its corners know is read once for a run. With the
normals n_k = q_i x q_j of rasterizer_gradients.py and the corners' u_k, a pixel looks at
u = sum u_k e_k / sum e_k, and all e_k of a run are linear in its n_k. So a run needs the gradients
of sum u_k n_k and of sum n_k alone, and writes to a corner once.
"""
from collections import namedtuple

import numpy as np

from course.given.compiled import each_band, kernel

from . import interpolation, pyramid_kernels, rasterization
from .pixel_kernels import are_there

# Pixels start <= pixel < end that see one face, the first the number-th that sees any: (R,) each.
Runs = namedtuple("Runs", "start end number")

# A flat one: the face that each pixel sees (H W,), -1 for none, and how wide it is.
Picture = namedtuple("Picture", "face_index width")

# x, y, w on screen (V, 3) or clip (V, 4), faces, uv_faces (F or 1, 3), uv (T, 2), (8)'s epsilon.
Wrapped = namedtuple("Wrapped", "vertices faces uv uv_faces epsilon")

# Of a face: x, y and w on screen, or q_k of rasterizer_gradients.py. Or a normal n_k, whose w is
# its e; or a gradient of these.
Vector = namedtuple("Vector", "x y w")

# A number at each corner of a face.
Three = namedtuple("Three", "a b c")

# A run's record, its first pixel's number, how many, X, Y and steps in ndc; unit of its corners.
Look = namedtuple("Look", "record number count X Y step_x step_y unit epsilon")


@kernel
def seen_runs(picture, counts_all):
    """The Runs of a Picture that see a face. counts_all: number counts all pixels."""
    face_index, width = picture
    starts, ends, numbers = np.empty((3, len(face_index)), np.int32)
    count, number = 0, 0
    for first in range(0, len(face_index), max(width, 1)):
        start, last = first, first + width
        while start < last:
            end = start + 1
            while end < last and face_index[end] == face_index[start]:
                end += 1
            if face_index[start] >= 0:
                starts[count], ends[count] = start, end
                numbers[count] = start if counts_all else number
                count, number = count + 1, number + end - start
            start = end
    return Runs(starts[:count].copy(), ends[:count].copy(), numbers[:count].copy())


@kernel
def vector(screen, v):
    """Where a vertex is on screen."""
    return Vector(screen[v, 0], screen[v, 1], screen[v, 2])


@kernel
def places_of(uv, uv_faces, face):
    """u and v of a face's corners."""
    a, b, c = uv_faces[face, 0], uv_faces[face, 1], uv_faces[face, 2]
    return Three(uv[a, 0], uv[b, 0], uv[c, 0]), Three(uv[a, 1], uv[b, 1], uv[c, 1])


@kernel
def edges_at(x, y, a, b, c):
    """c of eq. (5) of rasterization.py."""
    x0, y0, x1, y1, x2, y2 = a.x - x, a.y - y, b.x - x, b.y - y, c.x - x, c.y - y
    return Three((x1 * y2 - x2 * y1) / a.w, (x2 * y0 - x0 * y2) / b.w, (x0 * y1 - x1 * y0) / c.w)


@kernel
def edge_steps(a, b, c):
    """dc/dx and dc/dy, the same all over the face."""
    return (Three((b.y - c.y) / a.w, (c.y - a.y) / b.w, (a.y - b.y) / c.w),
            Three((c.x - b.x) / a.w, (a.x - c.x) / b.w, (b.x - a.x) / c.w))


@kernel
def total(three):
    """The sum of its numbers."""
    return three.a + three.b + three.c


@kernel
def mixed(weights, three):
    """A corner's number, for each of these weights."""
    return 0.0 + weights.a * three.a + weights.b * three.b + weights.c * three.c


@kernel
def change_of(weights, step, sum_of_steps, s):
    """Eq. (6) of rasterization.py along one axis."""
    return Three((step.a - weights.a * sum_of_steps) / s, (step.b - weights.b * sum_of_steps) / s,
                 (step.c - weights.c * sum_of_steps) / s)


@kernel
def footprints_along(runs, picture, mesh, at, footprint):
    """Writes at (N, 2 or more), footprint (N, 4) of runs. False: a face or vertex is not there."""
    face_index, width = picture
    screen, faces, uv, uv_faces, _ = mesh
    starts, ends, numbers = runs
    for run in range(len(starts)):
        face = face_index[starts[run]]
        if face >= len(uv_faces) or not are_there(faces, face, len(screen)):
            return False
        a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
        corners = vector(screen, a), vector(screen, b), vector(screen, c)
        pixels = starts[run], ends[run], numbers[run], width
        footprints_of(pixels, corners, places_of(uv, uv_faces, face), at, footprint)
    return True


@kernel
def footprints_of(pixels, corners, places, at, footprint):
    """Those of one run: start, end, number, the row's width. places: u and v of the corners."""
    start, end, number, width = pixels
    u, v = places
    along_x, along_y = edge_steps(*corners)
    sum_x, sum_y = total(along_x), total(along_y)
    x, y = start % width + 0.5, start // width + 0.5
    for i in range(np.uintp(end - start)):
        edges = edges_at(x + np.int32(i), y, *corners)
        s = total(edges)
        weights = Three(edges.a / s, edges.b / s, edges.c / s)
        k = np.uintp(number) + i
        at[k, 0], at[k, 1] = mixed(weights, u), mixed(weights, v)
        by_x = change_of(weights, along_x, sum_x, s)
        by_y = change_of(weights, along_y, sum_y, s)
        footprint[k, 0], footprint[k, 1] = mixed(by_x, u), mixed(by_y, u)
        footprint[k, 2], footprint[k, 3] = mixed(by_x, v), mixed(by_y, v)


@kernel
def cross(p, q):
    """p x q."""
    return Vector(p.y * q.w - p.w * q.y, p.w * q.x - p.x * q.w, p.x * q.y - p.y * q.x)


@kernel
def dot(p, q):
    """p . q."""
    return p.x * q.x + p.y * q.y + p.w * q.w


@kernel
def unit_of_corners(clip, a, b, c):
    """1 / the largest x, y or w of a face: in such units no product of two over- or underflows."""
    largest = 0.0
    for vertex in (a, b, c):
        largest = max(largest, abs(clip[vertex, 0]), abs(clip[vertex, 1]), abs(clip[vertex, 3]))
    return min(1 / largest, 1e300)


@kernel
def vector_from(clip, vertex, look):
    """q_k of rasterizer_gradients.py, in the run's unit."""
    unit = look.unit
    x, y, w = clip[vertex, 0] * unit, clip[vertex, 1] * unit, clip[vertex, 3] * unit
    return Vector(x - look.X * w, y - look.Y * w, w)


@kernel
def sums_along(weighted, whole, look, axis, grad_at, grad_footprint):
    """Along a run, for u (axis 0) or v: the gradient of weighted = sum u_k n_k, and less that of
    whole = sum n_k.
    """
    # N = weighted, S = whole: u = N / S and du/dX = (N_X - u S_X) / S at N = N_e + t N_X, and so S.
    # With the gradients g of u, g_X of du/dX, g_Y, and q = (S_X g_X + S_Y g_Y) / S^2:
    # dL/dN = g / S - q = p,    -dL/dS = u p + (N_X g_X + N_Y g_Y) / S^2 - u q = m,
    # dL/dN_X = g_X / S + t p,  -dL/dS_X = u g_X / S + t m.
    p_x, p_y, p_e, p_t, m_x, m_y, m_e, m_t = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    has_footprint = len(grad_footprint) > 0
    for i in range(np.uintp(look.count)):
        t = np.int32(i) * look.step_x
        s = whole.w + t * whole.x
        r = 0.0 if s == 0 else 1 / (s + np.copysign(look.epsilon, s))
        u = (weighted.w + t * weighted.x) * r
        k, column = np.uintp(look.number) + i, np.uintp(2 * axis)
        p = r * grad_at[k, axis]
        m = u * p
        if has_footprint:
            g_x = r * look.step_x * grad_footprint[k, column]
            g_y = r * look.step_y * grad_footprint[k, column + np.uintp(1)]
            q = r * (whole.x * g_x + whole.y * g_y)
            p -= q
            m += r * (weighted.x * g_x + weighted.y * g_y) - 2 * u * q
            p_x, p_y, m_x, m_y = p_x + g_x, p_y + g_y, m_x + u * g_x, m_y + u * g_y
        p_e, p_t, m_e, m_t = p_e + p, p_t + t * p, m_e + m, m_t + t * m
    return Vector(p_x + p_t, p_y, p_e), Vector(m_x + m_t, m_y, m_e)


@kernel
def added(grad, factor, p, m):
    """grad + factor p - m."""
    return Vector(grad.x + factor * p.x - m.x, grad.y + factor * p.y - m.y,
                  grad.w + factor * p.w - m.w)


@kernel
def vector_backward(k, p, grad_p, q, grad_q, look, to_corners):
    """Two normals are n_p = r x p and n_q = q x r of corner r, number k: their gradients -> those
    of its x, y and w.
    """
    u, v = cross(p, grad_p), cross(grad_q, q)  # g . (p x q) = p . (q x g) = q . (g x p)
    x, y = u.x + v.x, u.y + v.y
    to_corners[look.record, k, 0] = x * look.unit
    to_corners[look.record, k, 1] = y * look.unit
    to_corners[look.record, k, 2] = (u.w + v.w - look.X * x - look.Y * y) * look.unit


@kernel
def axis_backward(axis, place, normals, look, grad_at, grad_footprint, grads, to_uv):
    """The way back from u (axis 0) or v along a run: to its values at the corners, and to the
    normals, whose grads were those so far -> those now.
    """
    n0, n1, n2 = normals
    g0, g1, g2 = grads
    u1, u2 = place.b - place.a, place.c - place.a  # from the first, for the sake of digits
    weighted = Vector(u1 * n1.x + u2 * n2.x, u1 * n1.y + u2 * n2.y, u1 * n1.w + u2 * n2.w)
    whole = Vector(n0.x + n1.x + n2.x, n0.y + n1.y + n2.y, n0.w + n1.w + n2.w)
    p, m = sums_along(weighted, whole, look, axis, grad_at, grad_footprint)
    to_uv[look.record, 0, axis] = dot(n0, p)
    to_uv[look.record, 1, axis] = dot(n1, p)
    to_uv[look.record, 2, axis] = dot(n2, p)
    return added(g0, 0.0, p, m), added(g1, u1, p, m), added(g2, u2, p, m)


@kernel
def look_backward(look, corners, places, grad_at, grad_footprint, records):
    """The way back from a run to its record. places: u and v of the corners."""
    to_corners, to_uv = records
    q0, q1, q2 = corners
    normals = cross(q1, q2), cross(q2, q0), cross(q0, q1)
    none = Vector(0.0, 0.0, 0.0)
    grads = axis_backward(0, places[0], normals, look, grad_at, grad_footprint,
                          (none, none, none), to_uv)
    g0, g1, g2 = axis_backward(1, places[1], normals, look, grad_at, grad_footprint, grads, to_uv)
    vector_backward(0, q1, g2, q2, g1, look, to_corners)
    vector_backward(1, q2, g0, q0, g2, look, to_corners)
    vector_backward(2, q0, g1, q1, g0, look, to_corners)


@kernel
def run_gradients(runs, picture, mesh, grad_at, grad_footprint, records):
    """The way back from some runs: records, (R, 3, 3) of x, y, w of three corners, (R, 3, 2) of uv.
    """
    face_index, width = picture
    height = len(face_index) // max(width, 1)
    clip, faces, uv, uv_faces, epsilon = mesh
    for run in range(len(runs.start)):
        face = face_index[runs.start[run]]
        a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
        start, end, number = runs.start[run], runs.end[run], runs.number[run]
        X, Y = (2 * (start % width) + 1) / width - 1, (2 * (start // width) + 1) / height - 1
        unit = unit_of_corners(clip, a, b, c)
        look = Look(run, number, end - start, X, Y, 2 / width, 2 / height, unit,
                    epsilon * unit * unit)
        corners = (vector_from(clip, a, look), vector_from(clip, b, look),
                   vector_from(clip, c, look))
        places = places_of(uv, uv_faces, min(face, len(uv_faces) - 1))
        look_backward(look, corners, places, grad_at, grad_footprint, records)


@kernel
def add_to_corners(runs, face_index, mesh, records, grad_clip, grad_uv):
    """Runs of `run_gradients` -> grad_clip (V, 4), grad_uv (T, 2)."""
    _, faces, _, uv_faces, _ = mesh
    to_corners, to_uv = records
    for run in range(len(runs.start)):
        face = face_index[runs.start[run]]
        for k in range(3):
            vertex, place = faces[face, k], uv_faces[min(face, len(uv_faces) - 1), k]
            grad_clip[vertex, 0] += to_corners[run, k, 0]
            grad_clip[vertex, 1] += to_corners[run, k, 1]
            grad_clip[vertex, 3] += to_corners[run, k, 2]
            grad_uv[place, 0] += to_uv[run, k, 0]
            grad_uv[place, 1] += to_uv[run, k, 1]


def flat(face_index):
    """The Picture of face_index (H, W)."""
    return Picture(face_index.ravel(), face_index.shape[1])


def runs_in_bands(face_index, counts_all=False):
    """The runs of a picture (H, W), in bands of about so many pixels as a thread takes."""
    runs = seen_runs(flat(face_index), counts_all)
    size = 1 + len(runs.start) // (1 + face_index.size // pyramid_kernels.STEP)
    return [(Runs(*(part[k:k + size] for part in runs)),)
            for k in range(0, len(runs.start), size)]


def footprints(clip, face_index, faces, uv, uv_faces, bands):
    """`pipeline.footprints`, without barycentrics: (u, v) (N, 2) and their change (N, 2, 2)."""
    require_corners(face_index, uv, uv_faces)
    height, width = face_index.shape
    count = np.count_nonzero(face_index >= 0)
    at, footprint = np.empty((count, 2)), np.empty((count, 2, 2))
    screen = np.stack(rasterization.screen_points(clip, width, height), -1)
    mesh = Wrapped(screen, faces, uv, uv_faces, 0.0)

    def band(runs):
        return footprints_along(runs, flat(face_index), mesh, at, footprint.reshape(-1, 4))

    if not all(list(each_band(band, bands))):
        raise IndexError("face_index names faces that are not there, or faces name vertices that "
                         "are not there: give the faces of this picture")
    return at, footprint


def require_corners(face_index, uv, uv_faces):
    """IndexError if a seen face names a corner that is not in uv: kernels would read beside it."""
    if uv_faces.size and not 0 <= uv_faces.min() <= uv_faces.max() < len(uv):
        nowhere = np.zeros((*face_index.shape, 3))
        interpolation.interpolation_matrix(len(uv), uv_faces, face_index, nowhere)  # says which


def footprints_backward(grad_at, grad_footprint, clip, face_index, faces, uv, uv_faces, bands):
    """Backward of `footprints`: grad_at (N, 2), grad_footprint (N, 2, 2) -> grad_uv (T, 2),
    grad_clip (V, 4).
    """
    return gradients(grad_at, grad_footprint.reshape(-1, 4), flat(face_index),
                     Wrapped(clip, faces, uv, uv_faces, 0.0), bands)


def gradients(grad_at, grad_footprint, picture, mesh, bands):
    """The way back to a Wrapped mesh: grad_at (N, 2 or more), grad_footprint (N or 0, 4)."""
    grad_clip, grad_uv = np.zeros(mesh.vertices.shape), np.zeros(mesh.uv.shape)

    def band(runs):
        records = np.empty((len(runs.start), 3, 3)), np.empty((len(runs.start), 3, 2))
        run_gradients(runs, picture, mesh, grad_at, grad_footprint, records)
        return runs, records

    for runs, records in each_band(band, bands):
        add_to_corners(runs, picture.face_index, mesh, records, grad_clip, grad_uv)
    return grad_uv, grad_clip
