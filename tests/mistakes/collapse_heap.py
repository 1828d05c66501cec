"""Mistakes of lab 12; each docstring goes on after "this is what comes out when"."""


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """a vertex keeps its own quadric; it gets the sum of both"""
    state = start(vertices, faces, quadrics, pairs)
    count = len(faces)
    refused = np.zeros(3, int)
    while count > face_count and has_cheapest(state):
        entry = heapq.heappop(state.heap)
        _, a, b, age, position = entry
        around = np.array([state.rows[f] for f in state.rows_at[a] | state.rows_at[b]])
        reason = why_refused(state.vertices, around, a, b, np.array(position))
        if reason:
            refused[reason - 1] += 1
            state.waiting.setdefault(a, []).append(entry)
            state.waiting.setdefault(b, []).append(entry)
        else:
            count -= merge(state, a, b)
            state.vertices[a] = position
            state.became[b] = a
            state.age[a] = age + 1
            put_back(state, set(around.ravel().tolist()))
    return state.vertices, open_faces(state), refused


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """it goes on where there are just as many faces as asked for"""
    state = start(vertices, faces, quadrics, pairs)
    count = len(faces)
    refused = np.zeros(3, int)
    while count >= face_count and has_cheapest(state):
        entry = heapq.heappop(state.heap)
        _, a, b, age, position = entry
        around = np.array([state.rows[f] for f in state.rows_at[a] | state.rows_at[b]])
        reason = why_refused(state.vertices, around, a, b, np.array(position))
        if reason:
            refused[reason - 1] += 1
            state.waiting.setdefault(a, []).append(entry)
            state.waiting.setdefault(b, []).append(entry)
        else:
            count -= merge(state, a, b)
            state.vertices[a] = position
            state.quadrics[a] += state.quadrics[b]
            state.became[b] = a
            state.age[a] = age + 1
            put_back(state, set(around.ravel().tolist()))
    return state.vertices, open_faces(state), refused


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """what was refused once never comes back"""
    state = start(vertices, faces, quadrics, pairs)
    count = len(faces)
    refused = np.zeros(3, int)
    while count > face_count and has_cheapest(state):
        entry = heapq.heappop(state.heap)
        _, a, b, age, position = entry
        around = np.array([state.rows[f] for f in state.rows_at[a] | state.rows_at[b]])
        reason = why_refused(state.vertices, around, a, b, np.array(position))
        if reason:
            refused[reason - 1] += 1
            state.waiting.setdefault(a, []).append(entry)
            state.waiting.setdefault(b, []).append(entry)
        else:
            count -= merge(state, a, b)
            state.vertices[a] = position
            state.quadrics[a] += state.quadrics[b]
            state.became[b] = a
            state.age[a] = age + 1
    return state.vertices, open_faces(state), refused
