"""Mistakes of lab 11; each docstring goes on after "this is what comes out when"."""


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
    """the inside's rule is used on the boundary, too"""
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


def limit_weight(n, u):
    """the fraction is upside down"""
    return 1 / (n + 8 * u / 3)


def limit_weight(n, u):
    """it is multiplied by u instead of divided"""
    return 1 / (n + 3 / 8 * u)


def limit_weight(n, u):
    """the weight of one step is taken for that of the limit"""
    return u
