"""Mistakes of lab 11; each docstring goes on after "this is what comes out when"."""


def loop_weight(n):
    """the square of the bracket is missing"""
    return (5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4)) / n


def loop_weight(n):
    """it is not divided by n: u must be the weight of one neighbour, not of all of them"""
    return 5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4) ** 2


def loop_weight(n):
    """the cosine's 1/4 is missing"""
    return (5 / 8 - (3 / 8 + np.cos(2 * np.pi / n)) ** 2) / n


def loop_weight(n):
    """it is Warren's formula, 3 / (8 n), instead of Loop's"""
    return np.where(n == 3, 3 / 16, 3 / (8 * n))


def loop_weight(n):
    """the cosine is taken of 360 / n degrees; np.cos takes radians, 2 pi / n"""
    return (5 / 8 - (3 / 8 + np.cos(360 / n) / 4) ** 2) / n


def loop_weight(n):
    """the angle is pi / n instead of 2 pi / n"""
    return (5 / 8 - (3 / 8 + np.cos(np.pi / n) / 4) ** 2) / n


def loop_slow(vertices, faces, u):
    """the ring's mean is weighted with u; each neighbour has u for itself"""
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        else:
            points.append((1 - len(ring) * u[v]) * vertices[v] + u[v] * vertices[ring].mean(0))
    for edge, its_faces in at_edge:
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
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        else:
            points.append((1 - u[v]) * vertices[v] + u[v] * vertices[ring].sum(0))
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        opposite = [v for f in its_faces for v in faces[f] if v not in edge]
        points.append(ends / 2 if len(its_faces) == 1 else
                      3 / 8 * ends + 1 / 8 * vertices[opposite].sum(0))
    return np.stack(points)


def loop_slow(vertices, faces, u):
    """the inside's rule is used for vertices on the boundary, too"""
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    points = []
    for v in range(len(vertices)):
        ring, _ = ring_of(v, at_edge)
        points.append((1 - len(ring) * u[v]) * vertices[v] + u[v] * vertices[ring].sum(0))
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        opposite = [v for f in its_faces for v in faces[f] if v not in edge]
        points.append(ends / 2 if len(its_faces) == 1 else
                      3 / 8 * ends + 1 / 8 * vertices[opposite].sum(0))
    return np.stack(points)


def loop_slow(vertices, faces, u):
    """a vertex on the boundary is pulled by 1/8 by its whole ring, not only by its two neighbours
    along the boundary"""
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        k = 1 / 8 if along else u[v]
        points.append((1 - len(ring) * k) * vertices[v] + k * vertices[ring].sum(0))
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        opposite = [v for f in its_faces for v in faces[f] if v not in edge]
        points.append(ends / 2 if len(its_faces) == 1 else
                      3 / 8 * ends + 1 / 8 * vertices[opposite].sum(0))
    return np.stack(points)


def loop_slow(vertices, faces, u):
    """every edge gets its middle: the opposite corners are left out inside as well"""
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        else:
            points.append((1 - len(ring) * u[v]) * vertices[v] + u[v] * vertices[ring].sum(0))
    for edge, _ in at_edge:
        points.append(vertices[list(edge)].mean(0))
    return np.stack(points)


def loop_slow(vertices, faces, u):
    """3/8 and 1/8 are exchanged; the edge's ends must have 3/8 each, the opposite corners 1/8"""
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        else:
            points.append((1 - len(ring) * u[v]) * vertices[v] + u[v] * vertices[ring].sum(0))
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        opposite = [v for f in its_faces for v in faces[f] if v not in edge]
        points.append(ends / 2 if len(its_faces) == 1 else
                      1 / 8 * ends + 3 / 8 * vertices[opposite].sum(0))
    return np.stack(points)


def loop_edge_rows(faces, edges, corner_edge):
    """the opposite corner pulls at boundary edges as well; there only the two ends do"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 1 / 2, 3 / 8)
    inside = np.ones(len(corner_edge), bool)
    opposite = np.roll(faces, 1, axis=1).ravel()
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], opposite[inside], np.full(inside.sum(), 1 / 8)))


def loop_edge_rows(faces, edges, corner_edge):
    """boundary edges have the weights of inner edges, 3/8 and 1/8; on the boundary each end has
    1/2"""
    every = np.arange(len(edges))
    end = np.full(len(edges), 3 / 8)
    inside = np.ones(len(corner_edge), bool)
    opposite = np.roll(faces, 1, axis=1).ravel()
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], opposite[inside], np.full(inside.sum(), 1 / 8)))


def loop_edge_rows(faces, edges, corner_edge):
    """the ends of a boundary edge have the inside's 3/8; on the boundary each has 1/2"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.full(len(edges), 3 / 8)
    inside = ~is_boundary[corner_edge]
    opposite = np.roll(faces, 1, axis=1).ravel()
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], opposite[inside], np.full(inside.sum(), 1 / 8)))


def loop_edge_rows(faces, edges, corner_edge):
    """the next corner is taken for the opposite one (np.roll in the other direction): that is an
    end of the edge"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 1 / 2, 3 / 8)
    inside = ~is_boundary[corner_edge]
    opposite = np.roll(faces, -1, axis=1).ravel()
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], opposite[inside], np.full(inside.sum(), 1 / 8)))


def loop_edge_rows(faces, edges, corner_edge):
    """a corner is taken for the one opposite to its own edge: it is an end of that edge"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 1 / 2, 3 / 8)
    inside = ~is_boundary[corner_edge]
    opposite = faces.ravel()
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], opposite[inside], np.full(inside.sum(), 1 / 8)))


def loop_edge_rows(faces, edges, corner_edge):
    """the mask of inner edges, one entry for each edge, is used for the corners; they need
    is_boundary[corner_edge]"""
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end = np.where(is_boundary, 1 / 2, 3 / 8)
    inside = np.flatnonzero(~is_boundary)
    opposite = np.roll(faces, 1, axis=1).ravel()
    return join((every, edges[:, 0], end), (every, edges[:, 1], end),
                (corner_edge[inside], opposite[inside], np.full(len(inside), 1 / 8)))


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
    """the new vertices are numbered from 0; they come after the old ones, from vertex_count on"""
    a, b, c = faces.T
    ab, bc, ca = corner_edge.reshape(-1, 3).T
    return np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)


def loop_faces(faces, corner_edge, vertex_count):
    """a face's edges are read as BC, CA, AB, each opposite to a corner; corner_edge has the edge
    that starts at each corner: AB, BC, CA"""
    a, b, c = faces.T
    bc, ca, ab = (vertex_count + corner_edge).reshape(-1, 3).T
    return np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)


def loop_faces(faces, corner_edge, vertex_count):
    """the triangles come kind by kind, all first children first; they must come face by face"""
    a, b, c = faces.T
    ab, bc, ca = (vertex_count + corner_edge).reshape(-1, 3).T
    return np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca]).reshape(4, 3, -1).swapaxes(
        1, 2).reshape(-1, 3)


def loop_faces(faces, corner_edge, vertex_count):
    """corner_edge is cut into three thirds; each face has three entries in a row: reshape(-1, 3)"""
    a, b, c = faces.T
    ab, bc, ca = (vertex_count + corner_edge).reshape(3, -1)
    return np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)


def limit_weight(n, u):
    """the reciprocal is forgotten: it is 1 / m"""
    return n + 3 / (8 * u)


def limit_weight(n, u):
    """u is not used: it is 1 / (2 n), which holds for Warren's u alone"""
    return 1 / (2 * n)


def limit_weight(n, u):
    """the brackets around n + 3 / (8 u) are missing: the reciprocal is of n alone, as
    1 / n + 3 / (8 u)"""
    return 1 / n + 3 / (8 * u)


def limit_weight(n, u):
    """the fraction is upside down: 8 u / 3 instead of 3 / (8 u)"""
    return 1 / (n + 8 * u / 3)


def limit_weight(n, u):
    """3/8 is multiplied by u instead of divided: 3 / 8 * u needs brackets, 3 / (8 u)"""
    return 1 / (n + 3 / 8 * u)


def limit_weight(n, u):
    """the weight of one step, u, is taken for that of the limit"""
    return u
