"""Mistakes of lab 11; each docstring goes on after "this is what comes out when"."""


def catmull_clark_slow(vertices, corners, counts):
    """R counts once; it counts twice, as 2 R"""
    at_edge, faces = faces_at_edges(corners, counts), polygons(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        elif ring:
            around = [f for f, face in enumerate(faces) if v in face]
            middles = (vertices[v] + vertices[ring]) / 2
            points.append((face_points[around].mean(0) + middles.mean(0)
                           + (len(ring) - 3) * vertices[v]) / len(ring))
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        points.append(ends / 2 if len(its_faces) == 1 else
                      (ends + face_points[its_faces].sum(0)) / 4)
    return np.concatenate([points, face_points])


def catmull_clark_slow(vertices, corners, counts):
    """the inside's rule is used for vertices on the boundary, too"""
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
    for edge, its_faces in at_edge:
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
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        elif ring:
            around = [f for f, face in enumerate(faces) if v in face]
            middles = (vertices[v] + vertices[ring]) / 2
            points.append((face_points[around].sum(0) + 2 * middles.mean(0)
                           + (len(ring) - 3) * vertices[v]) / len(ring))
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        points.append(ends / 2 if len(its_faces) == 1 else
                      (ends + face_points[its_faces].sum(0)) / 4)
    return np.concatenate([points, face_points])


def catmull_clark_slow(vertices, corners, counts):
    """R is the mean of the ring, the neighbours; it is the mean of the edges' middles"""
    at_edge, faces = faces_at_edges(corners, counts), polygons(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        elif ring:
            around = [f for f, face in enumerate(faces) if v in face]
            middles = vertices[ring]
            points.append((face_points[around].mean(0) + 2 * middles.mean(0)
                           + (len(ring) - 3) * vertices[v]) / len(ring))
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        points.append(ends / 2 if len(its_faces) == 1 else
                      (ends + face_points[its_faces].sum(0)) / 4)
    return np.concatenate([points, face_points])


def catmull_clark_slow(vertices, corners, counts):
    """R is the mean of the new edge points of eq. (8); it is the mean of the edges' middles"""
    at_edge, faces = faces_at_edges(corners, counts), polygons(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    new = {}
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        new[edge] = (ends / 2 if len(its_faces) == 1 else
                     (ends + face_points[its_faces].sum(0)) / 4)
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        elif ring:
            around = [f for f, face in enumerate(faces) if v in face]
            middles = np.stack([new[min(v, end), max(v, end)] for end in ring])
            points.append((face_points[around].mean(0) + 2 * middles.mean(0)
                           + (len(ring) - 3) * vertices[v]) / len(ring))
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        points.append(ends / 2 if len(its_faces) == 1 else
                      (ends + face_points[its_faces].sum(0)) / 4)
    return np.concatenate([points, face_points])


def catmull_clark_slow(vertices, corners, counts):
    """n is always 4, as in a regular grid; it is the valence, the number of neighbours"""
    at_edge, faces = faces_at_edges(corners, counts), polygons(corners, counts)
    face_points = np.stack([vertices[face].mean(0) for face in faces])
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        elif ring:
            around = [f for f, face in enumerate(faces) if v in face]
            middles = (vertices[v] + vertices[ring]) / 2
            points.append((face_points[around].mean(0) + 2 * middles.mean(0)
                           + vertices[v]) / 4)
        else:
            points.append(vertices[v])
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        points.append(ends / 2 if len(its_faces) == 1 else
                      (ends + face_points[its_faces].sum(0)) / 4)
    return np.concatenate([points, face_points])


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):
    """the columns of the face points begin at 0; they must come after the vertices, from
    vertex_count on"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 1 / 2, 1 / 4)
    inside = ~is_boundary[corner_edge]
    face_point = face_of_corner(counts)
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], face_point[inside], np.full(inside.sum(), 1 / 4)))


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):
    """the ends of a boundary edge have the inside's 1/4; on the boundary each has 1/2"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.full(len(edges), 1 / 4)
    inside = ~is_boundary[corner_edge]
    face_point = vertex_count + face_of_corner(counts)
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], face_point[inside], np.full(inside.sum(), 1 / 4)))


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):
    """the face point pulls at boundary edges as well; there only the two ends do"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 1 / 2, 1 / 4)
    inside = np.ones(len(corner_edge), bool)
    face_point = vertex_count + face_of_corner(counts)
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], face_point[inside], np.full(inside.sum(), 1 / 4)))


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):
    """the weights are those of Loop, 3/8 and 1/8; here all four points have 1/4"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 1 / 2, 3 / 8)
    inside = ~is_boundary[corner_edge]
    face_point = vertex_count + face_of_corner(counts)
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], face_point[inside], np.full(inside.sum(), 1 / 8)))


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):
    """each pull is 1 / n instead of 1 / n^2"""
    u = 1 / np.maximum(n, 1)
    inside = ~np.isin(corners, edges[is_boundary])
    face_point = len(n) + face_of_corner(counts)
    return join(vertex_rows(edges, is_boundary, u, 1 / 8),
                pull_entries(corners[inside], face_point[inside], u[corners[inside]]))


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):
    """face points pull at boundary vertices as well; there only the two neighbours along the
    boundary do"""
    u = 1 / np.maximum(n, 1) ** 2
    inside = np.ones(len(corners), bool)
    face_point = len(n) + face_of_corner(counts)
    return join(vertex_rows(edges, is_boundary, u, 1 / 8),
                pull_entries(corners[inside], face_point[inside], u[corners[inside]]))


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):
    """a neighbour pulls by 2 / n^2; it is 1 / n^2, since R is the mean of the edges' middles, half
    way to the neighbours"""
    u = 1 / np.maximum(n, 1) ** 2
    inside = ~np.isin(corners, edges[is_boundary])
    face_point = len(n) + face_of_corner(counts)
    return join(vertex_rows(edges, is_boundary, 2 * u, 1 / 8),
                pull_entries(corners[inside], face_point[inside], u[corners[inside]]))


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):
    """the columns of the face points begin at 0; they must come after the vertices, from len(n)
    on"""
    u = 1 / np.maximum(n, 1) ** 2
    inside = ~np.isin(corners, edges[is_boundary])
    face_point = face_of_corner(counts)
    return join(vertex_rows(edges, is_boundary, u, 1 / 8),
                pull_entries(corners[inside], face_point[inside], u[corners[inside]]))


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):
    """quads are wound the other way: the edges ahead and behind are exchanged"""
    ahead = vertex_count + corner_edge
    behind = np.empty_like(ahead)
    behind[next_corner(counts)] = ahead
    middle = vertex_count + corner_edge.max() + 1 + face_of_corner(counts)
    return np.stack([corners, behind, middle, ahead], axis=1)


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):
    """the edge behind a corner is the previous entry of corner_edge, also where that belongs to
    another face; it must stay in the corner's own face"""
    ahead = vertex_count + corner_edge
    behind = np.empty_like(ahead)
    behind[:] = np.roll(ahead, 1)
    middle = vertex_count + corner_edge.max() + 1 + face_of_corner(counts)
    return np.stack([corners, ahead, middle, behind], axis=1)


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):
    """the edge of the next corner is taken for the edge behind"""
    ahead = vertex_count + corner_edge
    behind = np.empty_like(ahead)
    behind[:] = ahead[next_corner(counts)]
    middle = vertex_count + corner_edge.max() + 1 + face_of_corner(counts)
    return np.stack([corners, ahead, middle, behind], axis=1)


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):
    """the faces' vertices are numbered as if there were as many edges as corners; two faces share
    an edge"""
    ahead = vertex_count + corner_edge
    behind = np.empty_like(ahead)
    behind[next_corner(counts)] = ahead
    middle = vertex_count + len(corner_edge) + face_of_corner(counts)
    return np.stack([corners, ahead, middle, behind], axis=1)


def catmull_clark_limit_rows(edges, is_boundary, quads, n):
    """diagonals pull at boundary vertices as well"""
    u = 1 / (np.maximum(n, 1) * (n + 5))
    inside = np.ones(quads.shape, bool)
    across = np.roll(quads, 2, axis=1)
    return join(vertex_rows(edges, is_boundary, 4 * u, 1 / 6),
                pull_entries(quads[inside], across[inside], u[quads[inside]]))


def catmull_clark_limit_rows(edges, is_boundary, quads, n):
    """the ring's 4 is missing: a neighbour pulls as much as a diagonal"""
    u = 1 / (np.maximum(n, 1) * (n + 5))
    inside = ~np.isin(quads, edges[is_boundary])
    across = np.roll(quads, 2, axis=1)
    return join(vertex_rows(edges, is_boundary, u, 1 / 6),
                pull_entries(quads[inside], across[inside], u[quads[inside]]))


def catmull_clark_limit_rows(edges, is_boundary, quads, n):
    """w on the boundary is 1/8, that of a step; that of the limit is 1/6"""
    u = 1 / (np.maximum(n, 1) * (n + 5))
    inside = ~np.isin(quads, edges[is_boundary])
    across = np.roll(quads, 2, axis=1)
    return join(vertex_rows(edges, is_boundary, 4 * u, 1 / 8),
                pull_entries(quads[inside], across[inside], u[quads[inside]]))


def catmull_clark_limit_rows(edges, is_boundary, quads, n):
    """a neighbour is taken for the end of the diagonal: across a quad is np.roll by 2, not by 1"""
    u = 1 / (np.maximum(n, 1) * (n + 5))
    inside = ~np.isin(quads, edges[is_boundary])
    across = np.roll(quads, 1, axis=1)
    return join(vertex_rows(edges, is_boundary, 4 * u, 1 / 6),
                pull_entries(quads[inside], across[inside], u[quads[inside]]))
