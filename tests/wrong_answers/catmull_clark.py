"""Wrong answers to catmull_clark, written without a look at the checks."""


def catmull_clark_slow(vertices, corners, counts):
    """the vertex rule weighs R once instead of twice

    told by: 2 R | 2R | factor 2 | twice & middles | weigh & twice | weigh & once
    """
    faces = polygons(corners, counts)
    at_edge = faces_at_edges(corners, counts)
    centres = np.array([vertices[face].mean(0) for face in faces])
    moved = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        n = len(ring)
        if along:
            moved.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        elif n:
            F = centres[[f for f, face in enumerate(faces) if v in face]].mean(0)
            R = (vertices[v] + vertices[ring].mean(0)) / 2
            moved.append((F + R + (n - 3) * vertices[v]) / n)
        else:
            moved.append(vertices[v])
    middles = []
    for (a, b), near in at_edge:
        if len(near) == 1:
            middles.append((vertices[a] + vertices[b]) / 2)
        else:
            middles.append((vertices[a] + vertices[b] + centres[near].sum(0)) / 4)
    return np.concatenate([moved, middles, centres])


def catmull_clark_slow(vertices, corners, counts):
    """R is the mean of the neighbours, not of the middles of the edges

    told by: mean of the neighbours | mean of the ring | midpoint | middles | middle of & edge
    """
    faces = polygons(corners, counts)
    at_edge = faces_at_edges(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        elif ring:
            F = face_points[[v in face for face in faces]].mean(0)
            R = vertices[ring].mean(0)
            points.append((F + 2 * R + (len(ring) - 3) * vertices[v]) / len(ring))
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        points.append(ends / 2 if len(its_faces) == 1 else
                      (ends + face_points[its_faces].sum(0)) / 4)
    return np.concatenate([points, face_points])


def catmull_clark_slow(vertices, corners, counts):
    """R is the mean of the new edge points of eq. (8), not of the middles of the edges

    told by: edge point | eq. (8) | middles | midpoint | middle of & edge
    """
    faces = polygons(corners, counts)
    at_edge = faces_at_edges(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    edge_points = {}
    for (a, b), its_faces in at_edge:
        s = vertices[a] + vertices[b]
        edge_points[a, b] = (s / 2 if len(its_faces) == 1
                             else (s + face_points[its_faces].sum(0)) / 4)
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        elif ring:
            F = face_points[[v in face for face in faces]].mean(0)
            R = np.mean([edge_points[min(v, o), max(v, o)] for o in ring], axis=0)
            points.append((F + 2 * R + (len(ring) - 3) * vertices[v]) / len(ring))
        else:
            points.append(vertices[v])
    points += [edge_points[edge] for edge, _ in at_edge]
    return np.concatenate([points, face_points])


def catmull_clark_slow(vertices, corners, counts):
    """boundary edges take the mean with their single face point: (A + B + f) / 3 instead of (A + B) / 2

    told by: boundary edge | edge & boundary | / 3 | one face & edge | 1/2 (A + B) | single face
    """
    faces = polygons(corners, counts)
    at_edge = faces_at_edges(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        elif ring:
            F = face_points[[v in face for face in faces]].mean(0)
            R = ((vertices[v] + vertices[ring]) / 2).mean(0)
            points.append((F + 2 * R + (len(ring) - 3) * vertices[v]) / len(ring))
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge:
        points.append(np.concatenate([vertices[list(edge)], face_points[its_faces]]).mean(0))
    return np.concatenate([points, face_points])


def catmull_clark_slow(vertices, corners, counts):
    """the valence is fixed to 4, as in a regular grid: n is not counted

    told by: valence | n = 4 | regular | quad grid | number of neighbours | length of the ring
    """
    faces = polygons(corners, counts)
    at_edge = faces_at_edges(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        elif ring:
            F = face_points[[v in face for face in faces]].mean(0)
            R = ((vertices[v] + vertices[ring]) / 2).mean(0)
            points.append((F + 2 * R + vertices[v]) / 4)
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        points.append(ends / 2 if len(its_faces) == 1 else
                      (ends + face_points[its_faces].sum(0)) / 4)
    return np.concatenate([points, face_points])


def catmull_clark_slow(vertices, corners, counts):
    """face points are summed corners over 4, also for faces that have another number of corners

    told by: triangle & 4 | face point & 4 | number of corners | divided by 4 | face point & quad
    """
    faces = polygons(corners, counts)
    at_edge = faces_at_edges(corners, counts)
    face_points = np.stack([vertices[face].sum(0) / 4 for face in faces])
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        elif ring:
            F = face_points[[v in face for face in faces]].mean(0)
            R = ((vertices[v] + vertices[ring]) / 2).mean(0)
            points.append((F + 2 * R + (len(ring) - 3) * vertices[v]) / len(ring))
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        points.append(ends / 2 if len(its_faces) == 1 else
                      (ends + face_points[its_faces].sum(0)) / 4)
    return np.concatenate([points, face_points])


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):
    """the weights are Loop's: 3/8 for the ends and 1/8 for the face points

    told by: loop | 3/8 | 1/8 | weights & triangle scheme
    """
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end_weight = np.where(is_boundary, 1 / 2, 3 / 8)
    inside = ~is_boundary[corner_edge]
    face_point = vertex_count + face_of_corner(counts)
    return join((every, edges[:, 0], end_weight), (every, edges[:, 1], end_weight),
                (corner_edge[inside], face_point[inside], np.full(inside.sum(), 1 / 8)))


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):
    """each pull is 1/n instead of 1/n^2

    told by: n^2 | n**2 | squared | 1/n instead | n times
    """
    u = 1 / np.maximum(n, 1)
    inside = ~np.isin(corners, edges[is_boundary])
    face_point = len(n) + face_of_corner(counts)
    return join(vertex_rows(edges, is_boundary, u, 1 / 8),
                pull_entries(corners[inside], face_point[inside], u[corners[inside]]))


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):
    """face points pull at boundary vertices as well

    told by: boundary & face point | boundary & face | boundary vert & pull | boundary & inside
    """
    u = 1 / np.maximum(n, 1) ** 2
    face_point = len(n) + face_of_corner(counts)
    return join(vertex_rows(edges, is_boundary, u, 1 / 8),
                pull_entries(corners, face_point, u[corners]))


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):
    """the neighbours pull with 2/n^2: that R is a middle, half way to the neighbour, is forgotten

    told by: 2/n^2 | half way | halfway | middle | twice & neighbour | neighbour & half
    """
    valence = np.maximum(n, 1)
    u = 1 / valence / valence
    inside = ~np.isin(corners, edges[is_boundary])
    face_point = len(n) + face_of_corner(counts)
    return join(vertex_rows(edges, is_boundary, 2 * u, 1 / 8),
                pull_entries(corners[inside], face_point[inside], u[corners[inside]]))


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):
    """the edges ahead and behind are exchanged, so the quads are wound the other way

    told by: ahead & behind | wound | winding | orientation | clockwise | exchang & edge
    """
    ahead = vertex_count + corner_edge
    behind = np.zeros_like(ahead)
    behind[next_corner(counts)] = ahead
    middle = vertex_count + corner_edge.max() + 1 + face_of_corner(counts)
    return np.stack([corners, behind, middle, ahead], axis=1)


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):
    """the edge behind is taken as the previous entry of corner_edge, across the borders of the faces

    told by: np.roll | roll & face | first corner & face | previous face | face & border | behind & face
    """
    ahead = vertex_count + corner_edge
    behind = np.roll(ahead, 1)
    middle = vertex_count + corner_edge.max() + 1 + face_of_corner(counts)
    return np.stack([corners, ahead, middle, behind], axis=1)


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):
    """the number of edges is taken as that of the corners, although two faces share an edge

    told by: number of edges | edge count | number of corners | len(corner_edge) | share & edge
    """
    ahead = vertex_count + corner_edge
    behind = np.empty_like(ahead)
    behind[next_corner(counts)] = ahead
    face_vertex = vertex_count + len(corner_edge)
    quads = []
    c = 0
    for f in range(len(counts)):
        for _ in range(counts[f]):
            quads.append([corners[c], ahead[c], face_vertex + f, behind[c]])
            c += 1
    return np.array(quads)


def catmull_clark_limit_rows(edges, is_boundary, quads, n):
    """on the boundary w is 1/8, that of a step, instead of 1/6, that of the limit

    told by: 1/6 | 1/8 | boundary & limit | step & limit
    """
    u = 1 / (np.maximum(n, 1) * (n + 5))
    rim = np.zeros(len(n), bool)
    rim[edges[is_boundary].ravel()] = True
    rows, columns = [], []
    for quad in quads:
        for k in range(4):
            if not rim[quad[k]]:
                rows.append(quad[k])
                columns.append(quad[k - 2])
    rows, columns = np.array(rows, int), np.array(columns, int)
    return join(vertex_rows(edges, is_boundary, 4 * u, 1 / 8),
                pull_entries(rows, columns, u[rows]))
