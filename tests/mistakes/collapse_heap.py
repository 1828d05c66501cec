"""Mistakes of lab 12; each docstring goes on after "this is what comes out when"."""


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """a vertex keeps its own quadric; it gets the sum of both"""
    vertices, quadrics, count = vertices.copy(), quadrics.copy(), len(faces)
    rows, rows_at = incidence(close_boundary(faces, len(vertices)), len(vertices) + 1)
    became, age = np.arange(len(vertices)).tolist(), np.zeros(len(vertices), int)
    heap = entries(vertices, quadrics, pairs, age)
    heapq.heapify(heap)
    waiting, known, refused = {}, set(), np.zeros(3, int)
    while count > face_count and has_cheapest(heap, vertices, quadrics, became, age, known):
        entry = heapq.heappop(heap)
        _, a, b, now, position = entry
        around = np.array([rows[f] for f in rows_at[a] | rows_at[b]])
        reason = why_refused(vertices, around, a, b, np.array(position))
        if reason:
            refused[reason - 1] += 1
            for vertex in (a, b):
                waiting.setdefault(vertex, []).append(entry)
        else:
            count -= merge(rows, rows_at, a, b)
            vertices[a], quadrics[a] = position, quadrics[a]
            became[b], age[a] = a, now + 1
            put_back(heap, waiting, set(around.ravel().tolist()))
    left = [row for row in rows if row and len(vertices) not in row]
    return vertices, np.array(left, int).reshape(-1, 3), refused


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """it goes on where there are just as many faces as asked for"""
    vertices, quadrics, count = vertices.copy(), quadrics.copy(), len(faces)
    rows, rows_at = incidence(close_boundary(faces, len(vertices)), len(vertices) + 1)
    became, age = np.arange(len(vertices)).tolist(), np.zeros(len(vertices), int)
    heap = entries(vertices, quadrics, pairs, age)
    heapq.heapify(heap)
    waiting, known, refused = {}, set(), np.zeros(3, int)
    while count >= face_count and has_cheapest(heap, vertices, quadrics, became, age, known):
        entry = heapq.heappop(heap)
        _, a, b, now, position = entry
        around = np.array([rows[f] for f in rows_at[a] | rows_at[b]])
        reason = why_refused(vertices, around, a, b, np.array(position))
        if reason:
            refused[reason - 1] += 1
            for vertex in (a, b):
                waiting.setdefault(vertex, []).append(entry)
        else:
            count -= merge(rows, rows_at, a, b)
            vertices[a], quadrics[a] = position, quadrics[a] + quadrics[b]
            became[b], age[a] = a, now + 1
            put_back(heap, waiting, set(around.ravel().tolist()))
    left = [row for row in rows if row and len(vertices) not in row]
    return vertices, np.array(left, int).reshape(-1, 3), refused


def simplify_heap(vertices, faces, quadrics, pairs, face_count):
    """what was refused once never comes back"""
    vertices, quadrics, count = vertices.copy(), quadrics.copy(), len(faces)
    rows, rows_at = incidence(close_boundary(faces, len(vertices)), len(vertices) + 1)
    became, age = np.arange(len(vertices)).tolist(), np.zeros(len(vertices), int)
    heap = entries(vertices, quadrics, pairs, age)
    heapq.heapify(heap)
    waiting, known, refused = {}, set(), np.zeros(3, int)
    while count > face_count and has_cheapest(heap, vertices, quadrics, became, age, known):
        entry = heapq.heappop(heap)
        _, a, b, now, position = entry
        around = np.array([rows[f] for f in rows_at[a] | rows_at[b]])
        reason = why_refused(vertices, around, a, b, np.array(position))
        if reason:
            refused[reason - 1] += 1
            for vertex in (a, b):
                waiting.setdefault(vertex, []).append(entry)
        else:
            count -= merge(rows, rows_at, a, b)
            vertices[a], quadrics[a] = position, quadrics[a] + quadrics[b]
            became[b], age[a] = a, now + 1
    left = [row for row in rows if row and len(vertices) not in row]
    return vertices, np.array(left, int).reshape(-1, 3), refused
