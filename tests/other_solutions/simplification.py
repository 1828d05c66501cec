"""Lab 12 once more: plane by plane, pair by pair, with sets; and errors as sums over planes."""
import itertools

import numpy as np

from reference.simplification import best_position, why_refused


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
