"""Wrong answers to collapse_heap, written without a look at the checks."""


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """a refused entry is thrown away instead of waiting

    told by: wait | thrown away | put_back | put back | dropped | discarded | never tried again | lost
    """
    state = start(vertices, faces, quadrics, pairs)
    left = len(faces)
    refused = np.zeros(3, int)
    while left > face_count and has_cheapest(state):
        entry = heapq.heappop(state.heap)
        a, b, place = entry[1], entry[2], np.array(entry[4])
        reason = why_refused(state.vertices, rows_around(state, a, b), a, b, place)
        if reason:
            refused[reason - 1] += 1
            continue
        left -= collapse(state, entry)
    return state.vertices, open_faces(state), refused


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """counts all rows at first, with the faces to outside, so too many collapses follow

    told by: outside | boundary faces | state.rows | first count | closing faces | too many & boundary
    """
    state = start(vertices, faces, quadrics, pairs)
    refused = np.zeros(3, int)
    number = len(state.rows)
    while number > face_count and has_cheapest(state):
        entry = heapq.heappop(state.heap)
        _, a, b, _, place = entry
        why = why_refused(state.vertices, rows_around(state, a, b), a, b, np.array(place))
        if why > 0:
            refused[why - 1] += 1
            wait(state, entry)
        else:
            number -= collapse(state, entry)
    return state.vertices, open_faces(state), refused


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """refused is indexed by the reason itself, which starts at 1: each count is one place too late

    told by: reason - 1 | starts at 1 | start at 1 | off by one | one place | index & reason | shifted | from 1
    """
    state = start(vertices, faces, quadrics, pairs)
    left = len(faces)
    refused = np.zeros(3, int)
    while left > face_count and has_cheapest(state):
        entry = heapq.heappop(state.heap)
        _, a, b, _, place = entry
        reason = why_refused(state.vertices, rows_around(state, a, b), a, b, np.array(place))
        if reason == 0:
            left -= collapse(state, entry)
        else:
            refused[reason % 3] += 1
            wait(state, entry)
    return state.vertices, open_faces(state), refused
