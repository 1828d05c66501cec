"""Wrong answers to catmull_clark, written without a look at the checks."""


def catmull_clark_slow(vertices, corners, counts):
    """r is the mean of the neighbours instead of the mean of the middles of the edges

    told by: middle & edge & R | midpoint & R | R & neighbour | R & ring | mean of the middles | mean of the neighbours | middle & vert
    """
    polys = polygons(corners, counts)
    at_edge = faces_at_edges(corners, counts)
    centre = np.array([vertices[p].mean(0) for p in polys])
    moved = []
    for v in range(len(vertices)):
        ring, rim = ring_of(v, at_edge)
        n = len(ring)
        if rim:
            moved.append(0.75 * vertices[v] + 0.125 * vertices[rim].sum(0))
        elif n == 0:
            moved.append(vertices[v])
        else:
            F = np.mean([centre[f] for f, p in enumerate(polys) if v in p], axis=0)
            R = vertices[ring].mean(0)
            moved.append((F + 2 * R + (n - 3) * vertices[v]) / n)
    on_edges = []
    for (a, b), its in at_edge:
        s = vertices[a] + vertices[b]
        on_edges.append(s / 2 if len(its) == 1 else (s + centre[its].sum(0)) / 4)
    return np.concatenate([moved, on_edges, centre])


def catmull_clark_slow(vertices, corners, counts):
    """all edge points are plain middles of their edge, without the face points

    told by: edge & middle & face point | edge & midpoint | edge & face point | edge & f_1 | (A + B) / 2 | 1/2 (A + B) | edge & plain & middle
    """
    polys = polygons(corners, counts)
    at_edge = faces_at_edges(corners, counts)
    centre = np.array([vertices[p].mean(0) for p in polys])
    moved = []
    for v in range(len(vertices)):
        ring, rim = ring_of(v, at_edge)
        if rim:
            moved.append(0.75 * vertices[v] + 0.125 * vertices[rim].sum(0))
        elif ring:
            n = len(ring)
            F = np.mean([centre[f] for f, p in enumerate(polys) if v in p], axis=0)
            R = np.mean([(vertices[v] + vertices[o]) / 2 for o in ring], axis=0)
            moved.append((F + 2 * R + (n - 3) * vertices[v]) / n)
        else:
            moved.append(vertices[v])
    on_edges = [(vertices[a] + vertices[b]) / 2 for (a, b), _ in at_edge]
    return np.concatenate([moved, on_edges, centre])


def catmull_clark_slow(vertices, corners, counts):
    """the face points stand before the edge points

    told by: order & point | face points & before | face points & first | edge points & last | edge points & after | order & block
    """
    polys = polygons(corners, counts)
    at_edge = faces_at_edges(corners, counts)
    centre = np.stack([vertices[p].sum(0) / len(p) for p in polys])
    moved = np.array(vertices, float)
    for v in range(len(vertices)):
        ring, rim = ring_of(v, at_edge)
        if rim:
            moved[v] = 3 / 4 * vertices[v] + 1 / 8 * vertices[rim].sum(0)
        elif ring:
            n = len(ring)
            F = centre[[v in p for p in polys]].mean(0)
            R = (vertices[v] + vertices[ring].mean(0)) / 2
            moved[v] = (F + 2 * R + (n - 3) * vertices[v]) / n
    on_edges = []
    for (a, b), its in at_edge:
        s = vertices[a] + vertices[b]
        on_edges.append(s / 2 if len(its) == 1 else (s + centre[its[0]] + centre[its[1]]) / 4)
    return np.concatenate([moved, centre, on_edges])


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):
    """the columns of the face points are f instead of vertex_count + f, so they hit old vertices

    told by: vertex_count + f | V + f | vertex_count & column | face point & column | offset | old vertex & column
    """
    rim = on_boundary(corner_edge)
    r, c, weights = [], [], []
    for e, (a, b) in enumerate(edges):
        for end in (a, b):
            r.append(e)
            c.append(end)
            weights.append(0.5 if rim[e] else 0.25)
    for e, f in zip(corner_edge, face_of_corner(counts)):
        if not rim[e]:
            r.append(e)
            c.append(f)
            weights.append(0.25)
    return np.array(r), np.array(c), np.array(weights)


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):
    """neighbours pull by 2 / n^2: that the middle of an edge is only half way to them is forgotten

    told by: half way | halfway | midpoint | 2 / n^2 | 2/n^2 | twice & neighbour | middle & neighbour
    """
    safe = np.where(n > 0, n, 1)
    strong = 2.0 / safe**2
    inside = ~np.isin(corners, edges[is_boundary])
    here = corners[inside]
    to_face = len(n) + face_of_corner(counts)[inside]
    return join(vertex_rows(edges, is_boundary, strong, 1 / 8),
                pull_entries(here, to_face, 1.0 / safe[here]**2))


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):
    """the edges ahead and behind are exchanged, so the quads are wound the other way round

    told by: ahead & behind | wound | winding | clockwise | orient | other way round | exchang & edge
    """
    middle = vertex_count + corner_edge.max() + 1 + face_of_corner(counts)
    before = np.empty_like(corner_edge)
    before[next_corner(counts)] = corner_edge
    return np.stack([corners, vertex_count + before, middle, vertex_count + corner_edge], axis=1)


def catmull_clark_limit_rows(edges, is_boundary, quads, n):
    """the next corner of a quad is taken for the diagonal one

    told by: diagonal | across | opposite corner | next corner | two corners on | roll
    """
    u = 1 / (np.maximum(n, 1) * (n + 5))
    rim = set(edges[is_boundary].ravel().tolist())
    here, there = [], []
    for quad in quads.tolist():
        for k in range(4):
            if quad[k] not in rim:
                here.append(quad[k])
                there.append(quad[(k + 1) % 4])
    here, there = np.array(here, int), np.array(there, int)
    return join(vertex_rows(edges, is_boundary, 4 * u, 1 / 6), pull_entries(here, there, u[here]))


def catmull_clark_slow(vertices, corners, counts):
    """the points are returned in another order: old vertices, face points, edge points

    told by: order & points | edge points & face points & exchang | face points & before | edges & then & faces | face points & last
    """
    faces = polygons(corners, counts)
    at_edge = faces_at_edges(corners, counts)
    V, F, E = len(vertices), len(faces), len(at_edge)
    out = np.zeros((V + F + E, vertices.shape[1]))
    for f, face in enumerate(faces):
        out[V + f] = sum(vertices[v] for v in face) / len(face)
    for v in range(V):
        ring, along = ring_of(v, at_edge)
        n = len(ring)
        if along:
            out[v] = 3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0)
        elif n > 0:
            around = [V + f for f in range(F) if v in faces[f]]
            R = (vertices[v] + vertices[ring].mean(0)) / 2
            out[v] = (out[around].mean(0) + 2 * R + (n - 3) * vertices[v]) / n
        else:
            out[v] = vertices[v]
    for e, (edge, its_faces) in enumerate(at_edge):
        ends = vertices[list(edge)].sum(0)
        if len(its_faces) == 2:
            out[V + F + e] = (ends + out[V + its_faces[0]] + out[V + its_faces[1]]) / 4
        else:
            out[V + F + e] = ends / 2
    return out


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):
    """the face points' columns do not begin after the old vertices: vertex_count is not added

    told by: vertex_count | column & face point | not added | offset | after the old vertices
    """
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    k = np.where(is_boundary, 1 / 2, 1 / 4)
    inside = ~is_boundary[corner_edge]
    face = face_of_corner(counts)[inside]
    return join((every, edges[:, 0], k), (every, edges[:, 1], k),
                (corner_edge[inside], face, np.full(len(face), 1 / 4)))


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):
    """boundary edges have the weights of inner ones: 1/4 for the ends and for the one face point

    told by: boundary & 1/4 | boundary & 1/2 | boundary & half | boundary & face point | boundary & inner | 3/4
    """
    rows, columns = [], []
    for e in range(len(edges)):
        rows += [e, e]
        columns += [edges[e, 0], edges[e, 1]]
    face = face_of_corner(counts)
    for c in range(len(corner_edge)):
        rows.append(corner_edge[c])
        columns.append(vertex_count + face[c])
    return np.array(rows), np.array(columns), np.full(len(rows), 1 / 4)


def catmull_clark_limit_rows(edges, is_boundary, quads, n):
    """a quad's neighbouring corner is taken for the diagonal one: rolled by 1 instead of 2

    told by: diagonal & neighbour | roll & 1 | next corner | opposite corner | two corners | diagonal & adjacent
    """
    u = 1 / (np.maximum(n, 1) * (n + 5))
    inside = ~np.isin(quads, edges[is_boundary])
    across = np.roll(quads, 1, axis=1)
    return join(vertex_rows(edges, is_boundary, 4 * u, 1 / 6),
                pull_entries(quads[inside], across[inside], u[quads[inside]]))


def catmull_clark_limit_rows(edges, is_boundary, quads, n):
    """the neighbours' factor 4 is missing

    told by: factor 4 | 4 sum(ring) | 4 times | neighbour & 4 | ring & 4 | four times
    """
    safe = np.maximum(n, 1)
    u = 1 / (safe * (safe + 5))
    inside = ~np.isin(quads, edges[is_boundary])
    start, end = quads[inside], quads[:, [2, 3, 0, 1]][inside]
    return join(vertex_rows(edges, is_boundary, u, 1 / 6), pull_entries(start, end, u[start]))
