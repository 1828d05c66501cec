"""Loop's exercises of lab 11 as printed."""


def loop_slow(vertices, faces, u):
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    new = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            a, b = along
            new.append((1 - 2 / 8) * vertices[v] + 1 / 8 * (vertices[a] + vertices[b]))
        else:
            n = len(ring)
            new.append((1 - n * u[v]) * vertices[v] + u[v] * sum(vertices[w] for w in ring))
    for (a, b), at in at_edge:
        if len(at) == 1:
            new.append(1 / 2 * (vertices[a] + vertices[b]))
        else:
            c, d = (next(v for v in faces[f] if v not in (a, b)) for f in at)
            new.append(3 / 8 * (vertices[a] + vertices[b]) + 1 / 8 * (vertices[c] + vertices[d]))
    return np.array(new)


def loop_edge_rows(faces, edges, corner_edge):
    rows, columns, weights = [], [], []
    is_boundary = on_boundary(corner_edge)
    for e, (a, b) in enumerate(edges):
        rows += [e, e]
        columns += [a, b]
        weights += [1 / 2, 1 / 2] if is_boundary[e] else [3 / 8, 3 / 8]
    for corner, e in enumerate(corner_edge):
        if not is_boundary[e]:
            rows.append(e)
            columns.append(faces[corner // 3, (corner + 2) % 3])
            weights.append(1 / 8)
    return np.array(rows), np.array(columns), np.array(weights)
