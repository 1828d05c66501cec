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

    told by: ahead & behind | ahead | behind | wound | winding | reverse | clockwise | orientation
    """
    face = face_of_corner(counts)
    edge_count = corner_edge.max() + 1
    start = np.cumsum(counts) - counts
    quads = []
    for k, corner in enumerate(corners):
        f = face[k]
        previous = start[f] + (k - start[f] - 1) % counts[f]
        quads.append([corner, vertex_count + corner_edge[previous],
                      vertex_count + edge_count + f, vertex_count + corner_edge[k]])
    return np.array(quads)


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
