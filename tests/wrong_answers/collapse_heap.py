"""Wrong answers to collapse_heap, written without a look at the checks."""


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """every collapse is counted as two faces, but at the boundary only one goes

    told by: two faces | 2 faces | one face | how many faces | boundary & count | count & went | merge & count
    """
    state = initial_state(vertices, faces, quadrics, pairs)
    left = len(faces)
    refused = np.zeros(3, int)
    while left > face_count and has_cheapest(state):
        top = heapq.heappop(state.heap)
        a, b, place = top[1], top[2], np.array(top[4])
        why = why_refused(state.vertices, rows_around(state, a, b), a, b, place)
        if why == 0:
            collapse(state, top)
            left -= 2
            continue
        refused[why - 1] += 1
        wait(state, top)
    return state.vertices, open_faces(state), refused
