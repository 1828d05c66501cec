"""Mistakes of lab 11; each docstring goes on after "this is what comes out when"."""


def catmull_clark_slow(vertices, corners, counts):
    """R counts once; it counts twice"""
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
