"""Lab 12 once more: plane by plane, pair by pair, with sets; and errors as sums over planes."""
import itertools
from collections import Counter

import numpy as np

from course.given import mesh
from reference.simplification import LEAST_COSINE, LEAST_CURVATURE, LEAST_SHAPE, why_refused


def face_planes(vertices, faces):
    planes = np.zeros((len(faces), 4))
    has_area = mesh.face_normals(vertices, faces).any(1)
    for f in np.flatnonzero(has_area):
        p, (a, b, c) = planes[f], vertices[faces[f]]
        normal = np.cross(b - a, c - a)
        p[:3] = normal / np.sqrt(normal @ normal)
        p[3] = -p[:3] @ (a + b + c) / 3
    return planes


def plane_quadrics(planes):
    return np.einsum("...i,...j->...ij", planes, planes)


def vertex_quadrics(face_quadrics, faces, vertex_count):
    quadrics = np.zeros((vertex_count, 4, 4))
    for q, face in zip(face_quadrics, faces, strict=True):
        for vertex in face:
            quadrics[vertex] += q
    return quadrics


def quadric_error(q, x):
    # In blocks: x . A x + (b + b') . x + c.
    A, b = q[..., :3, :3], q[..., :3, 3] + q[..., 3, :3]
    return np.einsum("...i,...ij,...j->...", x, A, x) + (b * x).sum(-1) + q[..., 3, 3]


def quadric_error_backward(grad_error, q, x):
    grad_q, grad_x = np.empty(np.shape(q)), np.empty(np.shape(x))
    for at in np.ndindex(np.shape(grad_error)):
        v = np.append(x[at], 1)
        grad_q[at] = grad_error[at] * v[:, None] * v
        grad_x[at] = grad_error[at] * ((q[at] + q[at].T) @ v)[:3]
    return grad_q, grad_x


def boundary_planes(vertices, faces):
    edges = mesh.boundary_edges(faces)
    planes = np.zeros((len(edges), 4))
    for p, (a, b) in zip(planes, edges, strict=True):
        third = next(({*face} - {a, b}).pop() for face in faces.tolist() if {a, b} <= {*face})
        # From the third vertex's foot on the edge, away from that vertex.
        along, inward = vertices[b] - vertices[a], vertices[third] - vertices[a]
        outward = along * (inward @ along) - inward * (along @ along)
        length = np.linalg.norm(outward)
        if np.linalg.norm(np.cross(along, inward)) > 0 and length > 0:
            p[:3] = outward / length
            p[3] = -p[:3] @ vertices[b]
    return edges, planes


def valid_pairs(vertices, faces, t):
    used = sorted(set(np.asarray(faces).ravel().tolist()))
    pairs = {tuple(sorted(pair)) for face in np.asarray(faces).tolist()
             for pair in itertools.combinations(face, 2)}
    pairs |= {(a, b) for a, b in itertools.combinations(used, 2)
              if np.linalg.norm(vertices[a] - vertices[b]) < t}
    return np.array(sorted(pairs))


def best_on_segment(q, a, b):
    places, unique = np.array(a, float), np.zeros(len(a), bool)
    for n in range(len(a)):
        A, along = q[n, :3, :3], b[n] - a[n]
        # The slope of the error along the segment, at its two ends: it is linear in between.
        start, end = (along @ (A @ x + q[n, :3, 3]) for x in (a[n], b[n]))
        curvature = along @ A @ along
        if curvature > LEAST_CURVATURE * np.trace(A) * (along @ along):
            t = start / (start - end)
            places[n], unique[n] = a[n] + min(max(t, 0), 1) * along, True
    return places, unique


def best_of_three(q, a, b):
    return np.array([min((x, y, (x + y) / 2), key=lambda place, m=m: float(quadric_error(m, place)))
                     for m, x, y in zip(q, a, b, strict=True)]).reshape(-1, 3)


def best_position(q, a, b):
    places = []
    for n in range(len(q)):
        one = slice(n, n + 1)
        sizes = np.linalg.eigvalsh(q[n, :3, :3])
        on_segment, unique = best_on_segment(q[one], a[one], b[one])
        if sizes[0] > LEAST_CURVATURE * sizes[-1]:
            places.append(-np.linalg.inv(q[n, :3, :3]) @ q[n, :3, 3])
        elif unique[0]:
            places.append(on_segment[0])
        else:
            places.append(best_of_three(q[one], a[one], b[one])[0])
    return np.reshape(places, (-1, 3))


def collapse_faces(faces, a, b):
    kept = [[a if vertex == b else vertex for vertex in face]
            for face in np.asarray(faces).tolist() if a not in face or b not in face]
    return np.array(kept, int).reshape(-1, 3)


def satisfies_link_condition(faces, a, b):
    faces = [set(face) for face in np.asarray(faces).tolist()]
    near_a, near_b = (set().union(*(face for face in faces if end in face)) for end in (a, b))
    thirds = set().union(*(face for face in faces if {a, b} <= face))
    return (near_a & near_b) - {a, b} == thirds - {a, b}


def has_twins(faces):
    return max(Counter(map(frozenset, np.asarray(faces).tolist())).values(), default=0) > 1


def flips(before, after):
    for old, new in zip(before, after, strict=True):
        n, m = (np.cross(x[1] - x[0], x[2] - x[0]) for x in (old, new))
        size, new_size = np.linalg.norm(n), np.linalg.norm(m)
        long, new_long = (max(np.linalg.norm(x[k] - x[k - 1]) for k in range(3))
                          for x in (old, new))
        if n.any() and (new_size / new_long**2 < LEAST_SHAPE * size / long**2
                        or n @ m / (size * new_size) < LEAST_COSINE):
            return True
    return False


def simplify_loop(vertices, faces, quadrics, pairs, face_count):
    x, q = list(np.array(vertices, float)), list(quadrics)
    faces, pairs = np.array(faces), [tuple(pair) for pair in np.asarray(pairs).tolist()]
    while len(faces) > face_count:
        asked = []
        for number, (a, b) in enumerate(pairs):
            both = q[a] + q[b]
            place = best_position(both[None], x[a][None], x[b][None])[0]
            asked.append((float(quadric_error(both, place)), number, a, b, place))
        for _, _, a, b, place in sorted(asked, key=lambda one: one[:2]):
            around = faces[np.isin(faces, (a, b)).any(1)]
            if why_refused(np.array(x), around, a, b, place) == 0:
                break
        else:
            break
        x[a], q[a] = place, q[a] + q[b]
        faces = collapse_faces(faces, a, b)
        renamed = {tuple(sorted(a if end == b else end for end in pair)) for pair in pairs}
        pairs = sorted(pair for pair in renamed if pair[0] != pair[1])
    return np.array(x), faces
