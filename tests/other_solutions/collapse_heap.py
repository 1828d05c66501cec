"""The heap of lab 12 once more: a sorted list, of which all costs are up to date."""
import numpy as np

from reference.collapse_heap import close_boundary
from reference.simplification import collapse_faces, pair_costs, why_refused


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    x, q, outside = vertices.copy(), quadrics.copy(), len(vertices)
    faces, waiting, refused = close_boundary(faces, outside), set(), np.zeros(3, int)
    pairs = {tuple(pair) for pair in pairs.tolist()}
    while (faces < outside).all(1).sum() > face_count and pairs - waiting:
        asked = np.array(sorted(pairs - waiting))
        places, costs = pair_costs(x, q, asked)
        k = int(np.argmin(costs))
        a, b = asked[k].tolist()
        reason = why_refused(x, faces, a, b, places[k])
        if reason:
            refused[reason - 1] += 1
            waiting.add((a, b))
            continue
        around = set(faces[np.isin(faces, (a, b)).any(1)].ravel().tolist())
        x[a], q[a] = places[k], q[a] + q[b]
        faces = collapse_faces(faces, a, b)
        renamed = ({a if v == b else v for v in pair} for pair in pairs)
        pairs = {tuple(sorted(pair)) for pair in renamed if len(pair) == 2}
        waiting = {pair for pair in waiting if not around & set(pair)}
    return x, faces[(faces < outside).all(1)], refused
