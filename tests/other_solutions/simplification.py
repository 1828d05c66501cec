"""Lab 12 once more: plane by plane, pair by pair, with sets."""
import itertools

import numpy as np

from course.given import mesh
from reference import simplification as lab


def surface_quadrics(vertices, faces):
    quadrics = np.zeros((len(vertices), 4, 4))
    for n, face in zip(mesh.area_vectors(vertices, faces), faces, strict=True):
        p, size = np.append(n, -n @ vertices[face[0]]), np.linalg.norm(n)
        if size:
            for vertex in face:
                quadrics[vertex] += np.outer(p, p) / (2 * size)
    for ends, p in zip(*lab.boundary_planes(vertices, faces), strict=True):
        for vertex in ends:
            quadrics[vertex] += 10 * np.sum(np.diff(vertices[ends], axis=0)**2) * np.outer(p, p)
    return quadrics


def pair_costs(vertices, quadrics, pairs):
    places, costs = [], []
    for a, b in pairs:
        q, x, y = quadrics[[a]] + quadrics[[b]], vertices[[a]], vertices[[b]]
        low, _, high = np.linalg.svd(q[0, :3, :3])[1][::-1]
        place, unique = lab.best_on_segment(q, x, y) if low <= 1e-6 * high else (
            lab.best_anywhere(q), True)
        places.append((place if unique else lab.best_of_three(q, x, y))[0])
        costs.append(lab.quadric_error(q[0], places[-1]))
    return np.array(places).reshape(-1, 3), np.array(costs)


def why_refused(vertices, faces, a, b, position):
    is_edge = any({a, b} <= set(face) for face in faces.tolist())
    if is_edge and not lab.satisfies_link_condition(faces, a, b):
        return 1
    left = [face for face in faces.tolist()
            if not {a, b} <= set(face) and (is_edge or max(face) < len(vertices))]
    if len({frozenset(a if v == b else v for v in face) for face in left}) < len(left):
        return 2
    real, moved = [face for face in left if max(face) < len(vertices)], vertices.copy()
    moved[[a, b]] = position
    return 3 * lab.flips(vertices[real], moved[real]) if real else 0


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
        faces = lab.collapse_faces(faces, a, b)
    return x, faces
