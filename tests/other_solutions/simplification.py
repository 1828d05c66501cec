"""Lab 12 once more: plane by plane, pair by pair, with sets; and errors as sums over planes."""
import itertools

import numpy as np

from course.given import mesh
from reference.simplification import (
    LEAST_COSINE,
    LEAST_CURVATURE,
    LEAST_SHAPE,
    best_position,
    why_refused,
)


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


def best_anywhere(q):
    return np.array([-np.linalg.inv(m[:3, :3]) @ m[:3, 3] for m in q]).reshape(-1, 3)


def pair_costs(vertices, quadrics, pairs):
    places, costs = [], []
    for a, b in pairs:
        both = quadrics[a] + quadrics[b]
        places.append(best_position(both[None], vertices[[a]], vertices[[b]])[0])
        costs.append(float(quadric_error(both, places[-1])))
    return np.array(places).reshape(-1, 3), np.array(costs)


def collapse_faces(faces, a, b):
    kept = [[a if vertex == b else vertex for vertex in face]
            for face in np.asarray(faces).tolist() if a not in face or b not in face]
    return np.array(kept, int).reshape(-1, 3)


def satisfies_link_condition(faces, a, b):
    faces = [set(face) for face in np.asarray(faces).tolist()]
    near_a, near_b = (set().union(*(face for face in faces if end in face)) for end in (a, b))
    thirds = set().union(*(face for face in faces if {a, b} <= face))
    return (near_a & near_b) - {a, b} == thirds - {a, b}


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


def simplify_loop(vertices, faces, quadrics, face_count):
    x, q, faces = np.array(vertices, float), np.array(quadrics), np.array(faces)
    while len(faces) > face_count:
        edges = sorted({tuple(sorted(pair)) for face in faces.tolist()
                        for pair in itertools.combinations(face, 2)})
        places, costs = pair_costs(x, q, np.array(edges))
        asked = sorted(zip(costs.tolist(), edges, places.tolist(), strict=True))
        for _, (a, b), place in asked:
            if why_refused(x, faces, a, b, np.array(place)) == 0:
                break
        else:
            break
        x[a], q[a] = place, q[a] + q[b]
        faces = collapse_faces(faces, a, b)
    return x, faces
