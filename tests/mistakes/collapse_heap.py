"""Mistakes of lab 12; each docstring goes on after "this is what comes out when"."""


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """it goes on where there are just as many faces as asked for"""
    state = start(vertices, faces, quadrics, pairs)
    count = len(faces)
    refused = np.zeros(3, int)
    while count >= face_count and has_cheapest(state):
        entry = heapq.heappop(state.heap)
        _, a, b, _, position = entry
        reason = why_refused(state.vertices, rows_around(state, a, b), a, b, np.array(position))
        if reason:
            refused[reason - 1] += 1
            wait(state, entry)
        else:
            count -= collapse(state, entry)
    return state.vertices, open_faces(state), refused


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """what was refused once never comes back"""
    state = start(vertices, faces, quadrics, pairs)
    count = len(faces)
    refused = np.zeros(3, int)
    while count > face_count and has_cheapest(state):
        entry = heapq.heappop(state.heap)
        _, a, b, _, position = entry
        reason = why_refused(state.vertices, rows_around(state, a, b), a, b, np.array(position))
        if reason:
            refused[reason - 1] += 1
        else:
            count -= collapse(state, entry)
    return state.vertices, open_faces(state), refused


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """the faces that went are not counted"""
    state = start(vertices, faces, quadrics, pairs)
    count = len(faces)
    refused = np.zeros(3, int)
    while count > face_count and has_cheapest(state):
        entry = heapq.heappop(state.heap)
        _, a, b, _, position = entry
        reason = why_refused(state.vertices, rows_around(state, a, b), a, b, np.array(position))
        if reason:
            refused[reason - 1] += 1
            wait(state, entry)
        else:
            collapse(state, entry)
    return state.vertices, open_faces(state), refused
