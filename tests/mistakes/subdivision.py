"""Mistakes of lab 11; each docstring goes on after "this is what comes out when"."""


def edges_of(corners, counts):
    """an edge runs as the face does, not from low to high: one of two faces is there twice"""
    start = corners.astype(np.int64)
    end = start[next_corner(counts)]
    vertex_count = start.max() + 1
    key = start * vertex_count + end
    key, corner_edge = np.unique(key, return_inverse=True)
    return np.stack(np.divmod(key, vertex_count), axis=1), corner_edge


def edges_of(corners, counts):
    """edges run from high to low, and ascend by high"""
    start = corners.astype(np.int64)
    end = start[next_corner(counts)]
    vertex_count = start.max() + 1
    key = np.maximum(start, end) * vertex_count + np.minimum(start, end)
    key, corner_edge = np.unique(key, return_inverse=True)
    return np.stack(np.divmod(key, vertex_count), axis=1), corner_edge


def edges_of(corners, counts):
    """a face's last corner is joined to the next face's first; it is to its own first"""
    start = corners.astype(np.int64)
    end = np.roll(start, -1)
    vertex_count = start.max() + 1
    key = np.minimum(start, end) * vertex_count + np.maximum(start, end)
    key, corner_edge = np.unique(key, return_inverse=True)
    return np.stack(np.divmod(key, vertex_count), axis=1), corner_edge


def is_extraordinary(valence, at_boundary, regular):
    """on the boundary half of the valence counts as regular; it is one more"""
    return (valence != np.where(at_boundary, regular // 2, regular)) & (valence > 0)


def is_extraordinary(valence, at_boundary, regular):
    """the boundary is not looked at"""
    return (valence != regular) & (valence > 0)


def is_extraordinary(valence, at_boundary, regular):
    """vertices of no edge are extraordinary; they are not"""
    return valence != np.where(at_boundary, regular // 2 + 1, regular)


def euler_characteristic(corners, counts):
    """vertices of no face are counted"""
    return int(corners.max() + 1) - len(edges_of(corners, counts)[0]) + len(counts)


def euler_characteristic(corners, counts):
    """an edge counts once for each of its faces"""
    return len(np.unique(corners)) - len(corners) + len(counts)


def euler_characteristic(corners, counts):
    """faces are taken away; they are added"""
    return len(np.unique(corners)) - len(edges_of(corners, counts)[0]) - len(counts)


def loop_weight(n):
    """the square is missing"""
    return (5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4)) / n


def loop_weight(n):
    """it is not divided by n: u is the weight of one neighbour, not of all"""
    return 5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4) ** 2


def loop_weight(n):
    """the cosine's 1/4 is missing"""
    return (5 / 8 - (3 / 8 + np.cos(2 * np.pi / n)) ** 2) / n


def loop_slow(vertices, faces, u):
    """the ring's mean is weighted with u; each neighbour has u for itself"""
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    points = []
    for v in range(len(vertices)):
        ring, beside = ring_of(v, at_edge)
        if beside:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[beside].sum(0))
        else:
            points.append((1 - len(ring) * u[v]) * vertices[v] + u[v] * vertices[ring].mean(0))
    for edge, its_faces in at_edge.items():
        ends = vertices[list(edge)].sum(0)
        opposite = [v for f in its_faces for v in faces[f] if v not in edge]
        points.append(ends / 2 if len(its_faces) == 1 else
                      3 / 8 * ends + 1 / 8 * vertices[opposite].sum(0))
    return np.stack(points)


def loop_slow(vertices, faces, u):
    """v keeps 1 - u instead of 1 - n u"""
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    points = []
    for v in range(len(vertices)):
        ring, beside = ring_of(v, at_edge)
        if beside:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[beside].sum(0))
        else:
            points.append((1 - u[v]) * vertices[v] + u[v] * vertices[ring].sum(0))
    for edge, its_faces in at_edge.items():
        ends = vertices[list(edge)].sum(0)
        opposite = [v for f in its_faces for v in faces[f] if v not in edge]
        points.append(ends / 2 if len(its_faces) == 1 else
                      3 / 8 * ends + 1 / 8 * vertices[opposite].sum(0))
    return np.stack(points)


def loop_slow(vertices, faces, u):
    """the inside's rule is used on the boundary, too"""
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    points = []
    for v in range(len(vertices)):
        ring, _ = ring_of(v, at_edge)
        points.append((1 - len(ring) * u[v]) * vertices[v] + u[v] * vertices[ring].sum(0))
    for edge, its_faces in at_edge.items():
        ends = vertices[list(edge)].sum(0)
        opposite = [v for f in its_faces for v in faces[f] if v not in edge]
        points.append(ends / 2 if len(its_faces) == 1 else
                      3 / 8 * ends + 1 / 8 * vertices[opposite].sum(0))
    return np.stack(points)


def pull_entries(rows, columns, u):
    """the pulled vertex gets heavier: what it gives away has the other sign"""
    return (np.concatenate([rows, rows]), np.concatenate([columns, rows]),
            np.concatenate([u, u]))


def pull_entries(rows, columns, u):
    """the pulled vertex keeps its whole weight: a pull's entries add up to 0"""
    return (np.concatenate([rows, rows]), np.concatenate([columns, rows]),
            np.concatenate([u, 0 * u]))


def pull_entries(rows, columns, u):
    """rows and columns are swapped"""
    return (np.concatenate([columns, rows]), np.concatenate([rows, rows]),
            np.concatenate([u, -u]))


def vertex_rows(edges, is_boundary, u, beside):
    """a vertex on the boundary is pulled inwards, too, by its u"""
    every = np.arange(len(u))
    start, end = np.concatenate([edges, edges[:, ::-1]]).T
    along = np.concatenate([is_boundary, is_boundary])
    pulled = np.ones(len(start), bool)
    strength = np.where(along, beside, u[start])[pulled]
    return join((every, every, np.ones(len(u))),
                pull_entries(start[pulled], end[pulled], strength))


def vertex_rows(edges, is_boundary, u, beside):
    """a vertex is pulled with its neighbour's u instead of its own"""
    every = np.arange(len(u))
    start, end = np.concatenate([edges, edges[:, ::-1]]).T
    along = np.concatenate([is_boundary, is_boundary])
    at_boundary = np.isin(every, edges[is_boundary])
    pulled = along | ~at_boundary[start]
    strength = np.where(along, beside, u[end])[pulled]
    return join((every, every, np.ones(len(u))),
                pull_entries(start[pulled], end[pulled], strength))


def vertex_rows(edges, is_boundary, u, beside):
    """only the lower end of an edge is pulled, and twice"""
    every = np.arange(len(u))
    start, end = np.concatenate([edges, edges]).T
    along = np.concatenate([is_boundary, is_boundary])
    at_boundary = np.isin(every, edges[is_boundary])
    pulled = along | ~at_boundary[start]
    strength = np.where(along, beside, u[start])[pulled]
    return join((every, every, np.ones(len(u))),
                pull_entries(start[pulled], end[pulled], strength))


def loop_edge_rows(faces, edges, corner_edge):
    """the weights inside and on the boundary are swapped"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 3 / 8, 1 / 2)
    inside = ~is_boundary[corner_edge]
    opposite = np.roll(faces, 1, axis=1).ravel()
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], opposite[inside], np.full(inside.sum(), 1 / 8)))


def loop_edge_rows(faces, edges, corner_edge):
    """the opposite vertex pulls on the boundary, too"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 1 / 2, 3 / 8)
    inside = np.ones(len(corner_edge), bool)
    opposite = np.roll(faces, 1, axis=1).ravel()
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], opposite[inside], np.full(inside.sum(), 1 / 8)))


def loop_edge_rows(faces, edges, corner_edge):
    """the next corner is taken for the opposite one: that is an end of the edge"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 1 / 2, 3 / 8)
    inside = ~is_boundary[corner_edge]
    opposite = np.roll(faces, -1, axis=1).ravel()
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], opposite[inside], np.full(inside.sum(), 1 / 8)))


def loop_faces(faces, corner_edge, vertex_count):
    """the third child begins with its old corner: corner k of child k is the old one"""
    a, b, c = faces.T
    ab, bc, ca = (vertex_count + corner_edge).reshape(-1, 3).T
    return np.stack([a, ab, ca, ab, b, bc, c, ca, bc, ab, bc, ca], axis=1).reshape(-1, 3)


def loop_faces(faces, corner_edge, vertex_count):
    """the triangle in the middle is wound the other way"""
    a, b, c = faces.T
    ab, bc, ca = (vertex_count + corner_edge).reshape(-1, 3).T
    return np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, ca, bc], axis=1).reshape(-1, 3)


def loop_faces(faces, corner_edge, vertex_count):
    """the new vertices are numbered from 0; they come after the old ones"""
    a, b, c = faces.T
    ab, bc, ca = corner_edge.reshape(-1, 3).T
    return np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)


def catmull_clark_slow(vertices, corners, counts):
    """R counts once; it counts twice"""
    at_edge, faces = faces_at_edges(corners, counts), polygons(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    points = []
    for v in range(len(vertices)):
        ring, beside = ring_of(v, at_edge)
        if beside:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[beside].sum(0))
        elif ring:
            around = [f for f, face in enumerate(faces) if v in face]
            middles = (vertices[v] + vertices[ring]) / 2
            points.append((face_points[around].mean(0) + middles.mean(0)
                           + (len(ring) - 3) * vertices[v]) / len(ring))
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge.items():
        ends = vertices[list(edge)].sum(0)
        points.append(ends / 2 if len(its_faces) == 1 else
                      (ends + face_points[its_faces].sum(0)) / 4)
    return np.concatenate([points, face_points])


def catmull_clark_slow(vertices, corners, counts):
    """the inside's rule is used on the boundary, too"""
    at_edge, faces = faces_at_edges(corners, counts), polygons(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    points = []
    for v in range(len(vertices)):
        ring, _ = ring_of(v, at_edge)
        if ring:
            around = [f for f, face in enumerate(faces) if v in face]
            middles = (vertices[v] + vertices[ring]) / 2
            points.append((face_points[around].mean(0) + 2 * middles.mean(0)
                           + (len(ring) - 3) * vertices[v]) / len(ring))
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge.items():
        ends = vertices[list(edge)].sum(0)
        points.append(ends / 2 if len(its_faces) == 1 else
                      (ends + face_points[its_faces].sum(0)) / 4)
    return np.concatenate([points, face_points])


def catmull_clark_slow(vertices, corners, counts):
    """F is the sum of the face points instead of their mean"""
    at_edge, faces = faces_at_edges(corners, counts), polygons(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    points = []
    for v in range(len(vertices)):
        ring, beside = ring_of(v, at_edge)
        if beside:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[beside].sum(0))
        elif ring:
            around = [f for f, face in enumerate(faces) if v in face]
            middles = (vertices[v] + vertices[ring]) / 2
            points.append((face_points[around].sum(0) + 2 * middles.mean(0)
                           + (len(ring) - 3) * vertices[v]) / len(ring))
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge.items():
        ends = vertices[list(edge)].sum(0)
        points.append(ends / 2 if len(its_faces) == 1 else
                      (ends + face_points[its_faces].sum(0)) / 4)
    return np.concatenate([points, face_points])


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):
    """face points are in the columns from 0 on; these are the vertices'"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 1 / 2, 1 / 4)
    inside = ~is_boundary[corner_edge]
    face_point = face_of_corner(counts)
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], face_point[inside], np.full(inside.sum(), 1 / 4)))


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):
    """1/4 is taken on the boundary, too"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.full(len(edges), 1 / 4)
    inside = ~is_boundary[corner_edge]
    face_point = vertex_count + face_of_corner(counts)
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], face_point[inside], np.full(inside.sum(), 1 / 4)))


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):
    """the face point pulls on the boundary, too"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 1 / 2, 1 / 4)
    inside = np.ones(len(corner_edge), bool)
    face_point = vertex_count + face_of_corner(counts)
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], face_point[inside], np.full(inside.sum(), 1 / 4)))


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):
    """the pull is 1 / n; it is 1 / n^2"""
    u = 1 / np.maximum(n, 1)
    inside = ~np.isin(corners, edges[is_boundary])
    face_point = len(n) + face_of_corner(counts)
    return join(vertex_rows(edges, is_boundary, u, 1 / 8),
                pull_entries(corners[inside], face_point[inside], u[corners[inside]]))


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):
    """face points pull at the boundary, too"""
    u = 1 / np.maximum(n, 1) ** 2
    inside = np.ones(len(corners), bool)
    face_point = len(n) + face_of_corner(counts)
    return join(vertex_rows(edges, is_boundary, u, 1 / 8),
                pull_entries(corners[inside], face_point[inside], u[corners[inside]]))


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):
    """a neighbour pulls by 2 / n^2: R is of the middles, which halves it"""
    u = 1 / np.maximum(n, 1) ** 2
    inside = ~np.isin(corners, edges[is_boundary])
    face_point = len(n) + face_of_corner(counts)
    return join(vertex_rows(edges, is_boundary, 2 * u, 1 / 8),
                pull_entries(corners[inside], face_point[inside], u[corners[inside]]))


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):
    """quads are wound the other way"""
    ahead = vertex_count + corner_edge
    behind = np.empty_like(ahead)
    behind[next_corner(counts)] = ahead
    middle = vertex_count + corner_edge.max() + 1 + face_of_corner(counts)
    return np.stack([corners, behind, middle, ahead], axis=1)


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):
    """quads begin with the face's vertex; they begin with the corner"""
    ahead = vertex_count + corner_edge
    behind = np.empty_like(ahead)
    behind[next_corner(counts)] = ahead
    middle = vertex_count + corner_edge.max() + 1 + face_of_corner(counts)
    return np.stack([middle, behind, corners, ahead], axis=1)


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):
    """the edge of the next corner is taken for that of the one before"""
    ahead = vertex_count + corner_edge
    behind = np.empty_like(ahead)
    behind[:] = ahead[next_corner(counts)]
    middle = vertex_count + corner_edge.max() + 1 + face_of_corner(counts)
    return np.stack([corners, ahead, middle, behind], axis=1)


def limit_weight(n, u):
    """the fraction is upside down"""
    return 1 / (n + 8 * u / 3)


def limit_weight(n, u):
    """it is multiplied by u instead of divided"""
    return 1 / (n + 3 / 8 * u)


def limit_weight(n, u):
    """the weight of one step is taken for that of the limit"""
    return u


def catmull_clark_limit_rows(edges, is_boundary, quads, n):
    """the ring's 4 is missing"""
    u = 1 / (np.maximum(n, 1) * (n + 5))
    inside = ~np.isin(quads, edges[is_boundary])
    across = np.roll(quads, 2, axis=1)
    return join(vertex_rows(edges, is_boundary, u, 1 / 6),
                pull_entries(quads[inside], across[inside], u[quads[inside]]))


def catmull_clark_limit_rows(edges, is_boundary, quads, n):
    """the boundary has the 1/8 of a step; the limit has 1/6"""
    u = 1 / (np.maximum(n, 1) * (n + 5))
    inside = ~np.isin(quads, edges[is_boundary])
    across = np.roll(quads, 2, axis=1)
    return join(vertex_rows(edges, is_boundary, 4 * u, 1 / 8),
                pull_entries(quads[inside], across[inside], u[quads[inside]]))


def catmull_clark_limit_rows(edges, is_boundary, quads, n):
    """a neighbour is taken for the diagonal's end"""
    u = 1 / (np.maximum(n, 1) * (n + 5))
    inside = ~np.isin(quads, edges[is_boundary])
    across = np.roll(quads, 1, axis=1)
    return join(vertex_rows(edges, is_boundary, 4 * u, 1 / 6),
                pull_entries(quads[inside], across[inside], u[quads[inside]]))
