"""Wrong answers to loop_subdivision, written without a look at the checks."""


def loop_weight(n):
    """the square of the bracket is forgotten

    told by: square | power | exponent
    """
    inner = 3 / 8 + np.cos(2 * np.pi / n) / 4
    return (5 / 8 - inner) / n


def loop_weight(n):
    """Warren's formula is computed instead of Loop's

    told by: warren | 3/(8 n) | 3/8n | 3 / (8 n) | other formula
    """
    return np.where(n == 3, 3 / 16, 3 / (8 * n))


def loop_weight(n):
    """the angle is in degrees: np.cos gets 360 / n

    told by: degree | radian | 360 | angle & unit
    """
    return (5 / 8 - (3 / 8 + np.cos(360 / n) / 4) ** 2) / n


def loop_slow(vertices, faces, u):
    """an edge's new point is the middle everywhere: the rule of the boundary is used inside as well

    told by: middle | midpoint | 1/2 (A + B) | opposite & ignored | opposite & left out | inner edge & boundary
    """
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    points = np.zeros((len(vertices) + len(at_edge), vertices.shape[1]))
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points[v] = 3 / 4 * vertices[v] + (vertices[along[0]] + vertices[along[1]]) / 8
        else:
            points[v] = (1 - len(ring) * u[v]) * vertices[v] + u[v] * vertices[ring].sum(0)
    for e, ((a, b), _) in enumerate(at_edge):
        points[len(vertices) + e] = (vertices[a] + vertices[b]) / 2
    return points


def loop_slow(vertices, faces, u):
    """the old vertices are moved in place, so later points are computed from moved ones

    told by: in place | already moved | moved & later | old position | changed & input | overwrit
    """
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            vertices[v] = 3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0)
        else:
            vertices[v] = (1 - len(ring) * u[v]) * vertices[v] + u[v] * vertices[ring].sum(0)
    points = list(vertices)
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        opposite = [v for f in its_faces for v in faces[f] if v not in edge]
        if len(its_faces) == 1:
            points.append(ends / 2)
        else:
            points.append(3 / 8 * ends + 1 / 8 * vertices[opposite].sum(0))
    return np.stack(points)


def loop_slow(vertices, faces, u):
    """a vertex on the boundary is pulled by 1/8 by its whole ring, not only by its two neighbours along the boundary

    told by: whole ring | all neighbours | along the boundary | two neighbours | ring & boundary | inner neighbour
    """
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        k = 1 / 8 if along else u[v]
        points.append((1 - len(ring) * k) * vertices[v] + k * vertices[ring].sum(0))
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        opposite = [v for f in its_faces for v in faces[f] if v not in edge]
        points.append(ends / 2 if len(its_faces) == 1
                      else 3 / 8 * ends + 1 / 8 * vertices[opposite].sum(0))
    return np.stack(points)


def loop_edge_rows(faces, edges, corner_edge):
    """the opposite corner is the next one after the edge's start, which is the edge's own end

    told by: own end | np.roll | roll & direction | end of the edge | next corner | wrong & opposite
    """
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end_weight = np.where(is_boundary, 1 / 2, 3 / 8)
    inside = ~is_boundary[corner_edge]
    opposite = np.roll(faces, -1, axis=1).ravel()
    return join((every, edges[:, 0], end_weight), (every, edges[:, 1], end_weight),
                (corner_edge[inside], opposite[inside], np.full(inside.sum(), 1 / 8)))


def loop_edge_rows(faces, edges, corner_edge):
    """the opposite corners pull at boundary edges as well, so their rows sum to more than 1

    told by: boundary & opposite | boundary & 1/8 | boundary & third | more than 1 | 9/8
    """
    rim = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end_weight = np.where(rim, 1 / 2, 3 / 8)
    opposite = faces[:, [2, 0, 1]].ravel()
    return join((every, edges[:, 0], end_weight), (every, edges[:, 1], end_weight),
                (corner_edge, opposite, np.full(len(corner_edge), 1 / 8)))


def loop_edge_rows(faces, edges, corner_edge):
    """rows and columns are exchanged: the transposed matrix

    told by: rows and columns | transpos | columns & rows & exchang | columns & rows & swap | column & edge
    """
    is_boundary = on_boundary(corner_edge)
    rows, columns, weights = [], [], []
    for e, (a, b) in enumerate(edges):
        k = 1 / 2 if is_boundary[e] else 3 / 8
        rows += [a, b]
        columns += [e, e]
        weights += [k, k]
    opposite = np.roll(faces, 1, axis=1).ravel()
    for c, e in enumerate(corner_edge):
        if not is_boundary[e]:
            rows.append(opposite[c])
            columns.append(e)
            weights.append(1 / 8)
    return np.array(rows), np.array(columns), np.array(weights)


def loop_edge_rows(faces, edges, corner_edge):
    """all edges get the weights of inner edges: no 1/2 on the boundary

    told by: boundary & 1/2 | boundary & half | boundary & 3/8 | boundary & inner | boundary rule | on_boundary
    """
    every = np.arange(len(edges))
    three = np.full(len(edges), 3 / 8)
    opposite = np.roll(faces, 1, axis=1).ravel()
    return join((every, edges[:, 0], three), (every, edges[:, 1], three),
                (corner_edge, opposite, np.full(len(opposite), 1 / 8)))


def loop_edge_rows(faces, edges, corner_edge):
    """the mask of inner edges has one entry for each edge, but is used for the corners

    told by: mask | per edge & corner | one for each corner | is_boundary[corner_edge] | edges & corners & mixed
    """
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end_weight = np.where(is_boundary, 1 / 2, 3 / 8)
    opposite = np.roll(faces, 1, axis=1).ravel()
    inner = np.flatnonzero(~is_boundary)
    return join((every, edges[:, 0], end_weight), (every, edges[:, 1], end_weight),
                (corner_edge[inner], opposite[inner], np.full(len(inner), 1 / 8)))


def loop_faces(faces, corner_edge, vertex_count):
    """the new vertices are numbered from 0: vertex_count is not added to the edge's number

    told by: vertex_count | number of old vertices | not added | offset | numbered from 0
    """
    a, b, c = faces.T
    ab, bc, ca = corner_edge.reshape(-1, 3).T
    return np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)


def loop_faces(faces, corner_edge, vertex_count):
    """the triangles come kind by kind, not face by face

    told by: face by face | order & triangles | kind by kind | grouped | order & faces | all first
    """
    a, b, c = faces.T
    ab, bc, ca = (vertex_count + corner_edge).reshape(-1, 3).T
    return np.concatenate([np.stack([a, ab, ca], 1), np.stack([ab, b, bc], 1),
                           np.stack([ca, bc, c], 1), np.stack([ab, bc, ca], 1)])


def loop_faces(faces, corner_edge, vertex_count):
    """vertex_count is replaced by the largest vertex number plus 1 of the faces, so unused vertices are forgotten

    told by: unused | vertex_count | largest & vertex | max & faces | isolated
    """
    n = faces.max() + 1
    new = np.empty((4 * len(faces), 3), dtype=int)
    for f, (a, b, c) in enumerate(faces):
        ab, bc, ca = n + corner_edge[3 * f:3 * f + 3]
        new[4 * f] = a, ab, ca
        new[4 * f + 1] = ab, b, bc
        new[4 * f + 2] = ca, bc, c
        new[4 * f + 3] = ab, bc, ca
    return new


def limit_weight(n, u):
    """the reciprocal is forgotten: n + 3 / (8 u) is returned

    told by: reciprocal | 1 / m | inverse | one over
    """
    return n + 3 / (8 * u)


def limit_weight(n, u):
    """u is ignored and Warren's 3 / (8 n) is put in, so m is 1 / (2 n) for every u

    told by: u is ignored | u is not used | warren | 1 / (2 n) | 1/(2n) | depend on u
    """
    return 1 / (n + n)


def limit_weight(n, u):
    """the numerator is 8 and the denominator 3: 8 / (3 u) instead of 3 / (8 u)

    told by: 8 / (3 | 8/(3 | 3 and 8 | 8/3 | 8 over 3 | upside down
    """
    return 1 / (n + 8 / (3 * u))
