"""The heap of lab 12 once more: the collapses first, the refused ones after."""
import heapq
from collections import Counter

import numpy as np

from reference.collapse_heap import collapse, has_cheapest, initial_state, rows_around, wait
from reference.simplification import why_refused


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    state, refused, left = initial_state(vertices, faces, quadrics, pairs), Counter(), len(faces)
    while left > face_count and has_cheapest(state):
        entry = heapq.heappop(state.heap)
        a, b, place = entry[1], entry[2], np.array(entry[4])
        reason = why_refused(state.vertices, rows_around(state, a, b), a, b, place)
        if reason == 0:
            left -= collapse(state, entry)
            continue
        refused[reason] += 1
        wait(state, entry)
    kept = [face for face in state.rows if face and len(vertices) not in face]
    return (state.vertices, np.array(kept, int).reshape(-1, 3),
            np.array([refused[reason] for reason in (1, 2, 3)]))
