"""The heap of lab 12 once more: the collapses first, the refused ones after."""
import heapq

import numpy as np

from reference.collapse_heap import has_cheapest, merge, put_back, start
from reference.simplification import why_refused


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    state, refused, left = start(vertices, faces, quadrics, pairs), [0, 0, 0], len(faces)
    x, q, rows = state.vertices, state.quadrics, state.rows
    while left > face_count and has_cheapest(state):
        entry = heapq.heappop(state.heap)
        _, a, b, then, place = entry
        around = np.array([rows[f] for f in sorted(state.rows_at[a].union(state.rows_at[b]))])
        reason = why_refused(x, around, a, b, np.array(place))
        if reason == 0:
            left -= merge(state, a, b)
            x[a], state.became[b], state.age[a] = place, a, then + 1
            q[a] = q[a] + q[b]
            put_back(state, {a, b, *around.ravel().tolist()})
            continue
        refused[reason - 1] += 1
        for end in (a, b):
            state.waiting.setdefault(end, []).append(entry)
    kept = [face for face in rows if face and len(x) not in face]
    return x, np.array(kept, int).reshape(-1, 3), np.array(refused)
