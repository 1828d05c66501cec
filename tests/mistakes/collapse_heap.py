"""Mistakes of lab 12; each docstring goes on after "this is what comes out when"."""


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """it goes on where there are just as many faces as asked for, by >= instead of >: one collapse
    too many"""
    state = initial_state(vertices, faces, quadrics, pairs)
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
    """a refused entry is thrown away and never tried again; it must `wait`, and comes back when
    something around it has changed"""
    state = initial_state(vertices, faces, quadrics, pairs)
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
    """the faces that went are not counted: the number that `collapse` returns is not subtracted"""
    state = initial_state(vertices, faces, quadrics, pairs)
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


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """all rows are counted at first, with the faces to `outside`; only the faces of the mesh
    count"""
    state = initial_state(vertices, faces, quadrics, pairs)
    count = len(state.rows)
    refused = np.zeros(3, int)
    while count > face_count and has_cheapest(state):
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
    """refused is indexed by the reason, which starts at 1; its place is reason - 1"""
    state = initial_state(vertices, faces, quadrics, pairs)
    count = len(faces)
    refused = np.zeros(3, int)
    while count > face_count and has_cheapest(state):
        entry = heapq.heappop(state.heap)
        _, a, b, _, position = entry
        reason = why_refused(state.vertices, rows_around(state, a, b), a, b, np.array(position))
        if reason:
            refused[reason % 3] += 1
            wait(state, entry)
        else:
            count -= collapse(state, entry)
    return state.vertices, open_faces(state), refused


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """it ends at the first refused entry; the next cheapest one must be tried"""
    state = initial_state(vertices, faces, quadrics, pairs)
    count = len(faces)
    refused = np.zeros(3, int)
    while count > face_count and has_cheapest(state):
        entry = heapq.heappop(state.heap)
        _, a, b, _, position = entry
        reason = why_refused(state.vertices, rows_around(state, a, b), a, b, np.array(position))
        if reason:
            refused[reason - 1] += 1
            break
        else:
            count -= collapse(state, entry)
    return state.vertices, open_faces(state), refused
