"""Wrong answers to loop_subdivision, written without a look at the checks."""


def loop_weight(n):
    """the whole is not divided by n

    told by: / n & missing | divid & by n | by n & not | divid & valence | n times | times n | factor & n & large
    """
    return 5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4) ** 2


def loop_weight(n):
    """the angle is pi / n instead of 2 pi / n

    told by: 2 pi | pi / n | pi/n | half & angle | angle & cos | twice & angle
    """
    out = np.zeros(np.shape(n))
    for at, k in np.ndenumerate(n):
        out[at] = (0.625 - (0.375 + 0.25 * np.cos(np.pi / k)) ** 2) / k
    return out


def loop_weight(n):
    """the difference as a whole is squared, not the bracket after 5/8 alone

    told by: square | **2 | ** 2 | ^2 & bracket | bracket | parenthes
    """
    return (5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4)) ** 2 / n


def loop_slow(vertices, faces, u):
    """vertices on the boundary are moved by the rule for the inside, with u and their whole ring

    told by: boundary & vert | vert & border | w = 1/8 | boundary & rule & inside | boundary & ring
    """
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    new = np.zeros((len(vertices) + len(at_edge), vertices.shape[1]))
    for v, here in enumerate(vertices):
        ring, _ = ring_of(v, at_edge)
        new[v] = (1 - len(ring) * u[v]) * here
        for other in ring:
            new[v] += u[v] * vertices[other]
    for e, ((a, b), near) in enumerate(at_edge):
        if len(near) == 1:
            point = (vertices[a] + vertices[b]) / 2
        else:
            tips = [v for f in near for v in faces[f] if v != a and v != b]
            point = 0.375 * (vertices[a] + vertices[b]) + 0.125 * vertices[tips].sum(0)
        new[len(vertices) + e] = point
    return new


def loop_slow(vertices, faces, u):
    """3/8 and 1/8 are exchanged: the ends of an edge get 1/8 and the opposite corners 3/8

    told by: 3/8 & 1/8 | exchang & weight | swap & weight | ends & opposite & weight | 3/8 & opposite | 1/8 & ends
    """
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    result = []
    for v in range(len(vertices)):
        ring, rim = ring_of(v, at_edge)
        if rim:
            result.append(0.75 * vertices[v] + 0.125 * (vertices[rim[0]] + vertices[rim[1]]))
        else:
            result.append((1 - len(ring) * u[v]) * vertices[v] + u[v] * vertices[ring].sum(0))
    for edge, near in at_edge:
        a, b = edge
        if len(near) == 1:
            result.append((vertices[a] + vertices[b]) / 2)
        else:
            tips = [v for f in near for v in faces[f] if v not in edge]
            result.append((vertices[a] + vertices[b]) / 8 + 3 / 8 * vertices[tips].sum(0))
    return np.array(result)


def loop_slow(vertices, faces, u):
    """the edge points are made from the moved vertices instead of the old ones

    told by: moved | already & new | old & position | old vertices & instead | old places | updated | in place
    """
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    moved = []
    for v in range(len(vertices)):
        ring, rim = ring_of(v, at_edge)
        pull = 1 / 8 if rim else u[v]
        near = rim if rim else ring
        moved.append((1 - len(near) * pull) * vertices[v] + pull * vertices[near].sum(0))
    moved = np.array(moved)
    edge_points = []
    for edge, its in at_edge:
        ends = moved[list(edge)].sum(0)
        if len(its) == 1:
            edge_points.append(ends / 2)
        else:
            tips = [v for f in its for v in faces[f] if v not in edge]
            edge_points.append(3 / 8 * ends + 1 / 8 * moved[tips].sum(0))
    return np.concatenate([moved, edge_points])


def loop_edge_rows(faces, edges, corner_edge):
    """the corner taken as opposite to an edge is the end of the edge itself

    told by: opposite & corner | end of the edge | own end | third corner | edge's end | C and D | opposite & edge
    """
    rim = on_boundary(corner_edge)
    e = np.arange(len(edges))
    half = np.where(rim, 0.5, 0.375)
    tip = np.roll(faces, -1, axis=1).ravel()
    use = ~rim[corner_edge]
    return (np.concatenate([e, e, corner_edge[use]]),
            np.concatenate([edges[:, 0], edges[:, 1], tip[use]]),
            np.concatenate([half, half, np.full(use.sum(), 0.125)]))


def loop_edge_rows(faces, edges, corner_edge):
    """boundary edges get the weight 1/8 of their opposite corner as well, besides 1/2 for the ends

    told by: boundary & 1/8 | boundary & opposite | boundary & third | boundary & sum | boundary & 9/8 | boundary & C
    """
    rim = on_boundary(corner_edge)
    e = np.arange(len(edges))
    half = np.where(rim, 1 / 2, 3 / 8)
    tip = faces[:, [2, 0, 1]].ravel()
    return join((e, edges[:, 0], half), (e, edges[:, 1], half),
                (corner_edge, tip, np.full(len(tip), 1 / 8)))


def loop_edge_rows(faces, edges, corner_edge):
    """only one of the two opposite corners of an edge is kept, the other is overwritten

    told by: one of & two & opposite | only one | one opposite | both opposite | overwrit | second face | both faces
    """
    rim = on_boundary(corner_edge)
    tip = {}
    for f, face in enumerate(faces):
        for k in range(3):
            tip[int(corner_edge[3 * f + k])] = face[k - 1]
    r, c, weights = [], [], []
    for e, (a, b) in enumerate(edges):
        if rim[e]:
            r += [e, e]
            c += [a, b]
            weights += [1 / 2, 1 / 2]
        else:
            r += [e, e, e]
            c += [a, b, tip[e]]
            weights += [3 / 8, 3 / 8, 1 / 8]
    return np.array(r), np.array(c), np.array(weights)


def loop_faces(faces, corner_edge, vertex_count):
    """the three edges of a face are read as those opposite to a, b, c, not those that start there

    told by: opposite & edge | starts at | AB & BC | edges & rotat | edges & shifted | order & edges | corner to the next
    """
    new = vertex_count + corner_edge.reshape(-1, 3)
    bc, ca, ab = new[:, 0], new[:, 1], new[:, 2]
    a, b, c = faces[:, 0], faces[:, 1], faces[:, 2]
    four = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    return np.stack([np.stack(three, -1) for three in four], 1).reshape(-1, 3)


def loop_faces(faces, corner_edge, vertex_count):
    """the new faces are grouped by kind, all first ones, then all second ones, and not face by face

    told by: face by face | order of the & faces | grouped | all first | kind | order & rows | interleav
    """
    a, b, c = faces.T
    ab, bc, ca = (vertex_count + corner_edge).reshape(-1, 3).T
    return np.concatenate([np.stack([a, ab, ca], 1), np.stack([ab, b, bc], 1),
                           np.stack([ca, bc, c], 1), np.stack([ab, bc, ca], 1)])


def limit_weight(n, u):
    """3 / (8 u) is computed as 3 / 8 * u

    told by: 3 / (8 u) | 3/(8 u) | 3/8 u | 3/8 * u | 3 / 8 * u | divid & u | multipl & u
    """
    return 1 / (n + 3 / 8 * u)


def limit_weight(n, u):
    """the bracket is forgotten: 1 / n + 3 / (8 u) instead of 1 over the sum

    told by: 1 / n + | 1/n + | bracket | parenthes | reciprocal & sum | 1 over & sum | precedence
    """
    return 1 / n + 3 / (8 * u)


def limit_weight(n, u):
    """the given u is not used: warren's weight of n is put in its place

    told by: Warren | given u | ignor & u | u & not used | argument u | depend & u
    """
    own = warren_weight(n)
    return 1 / (n + 3 / (8 * own))


def loop_weight(n):
    """the brackets are missing: only the square is divided by n, not 5/8 as well

    told by: 5/8 | bracket | parenthes | division by n | all & divided by n | only the square | 0.625
    """
    centre = 3 / 8 + np.cos(2 * np.pi / n) / 4
    return 5 / 8 - centre**2 / n


def loop_weight(n):
    """the angle is pi/n, it should be 2 pi/n

    told by: the angle | 2 pi | pi / n | pi/n | full turn | 2pi | cosine | half a turn
    """
    return (5 / 8 - (3 / 8 + np.cos(np.pi / n) / 4)**2) / n


def loop_slow(vertices, faces, u):
    """vertices on the boundary move like those inside, by u and their whole ring

    told by: boundary & vert | boundary & u | boundary & ring | boundary & 1/8 | boundary & inside | w = 1/8 | boundary & old
    """
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    moved = np.zeros(vertices.shape)
    for v in range(len(vertices)):
        ring, _ = ring_of(v, at_edge)
        n = len(ring)
        moved[v] = (1 - n * u[v]) * vertices[v]
        for other in ring:
            moved[v] += u[v] * vertices[other]
    middles = []
    for (a, b), owners in at_edge:
        if len(owners) < 2:
            middles.append((vertices[a] + vertices[b]) / 2)
            continue
        c, d = (faces[f].sum() - a - b for f in owners)
        middles.append((3 * vertices[a] + 3 * vertices[b] + vertices[c] + vertices[d]) / 8)
    return np.concatenate([moved, middles])


def loop_slow(vertices, faces, u):
    """the weights of an inner edge are exchanged: its ends have 1/8 and the opposite corners 3/8

    told by: 3/8 & 1/8 | exchanged & edge | swapped & edge | 3/8 & ends | 1/8 & ends | 3/8 & opposite | 1/8 & opposite | weights & swapped | weights & exchanged
    """
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    out = []
    for v, x in enumerate(vertices):
        ring, rim = ring_of(v, at_edge)
        if len(rim):
            out.append(0.75 * x + 0.125 * (vertices[rim[0]] + vertices[rim[1]]))
        else:
            out.append(x + u[v] * (vertices[ring] - x).sum(0))
    for (a, b), owners in at_edge:
        if len(owners) == 1:
            out.append(0.5 * (vertices[a] + vertices[b]))
        else:
            c, d = (faces[f].sum() - a - b for f in owners)
            out.append(0.125 * (vertices[a] + vertices[b]) + 0.375 * (vertices[c] + vertices[d]))
    return np.array(out)


def loop_edge_rows(faces, edges, corner_edge):
    """the corner rolled to is the edge's own end, not the corner opposite to the edge

    told by: opposite | roll | own end | ends of the edge | third corner | across
    """
    rim = on_boundary(corner_edge)
    number = np.arange(len(edges))
    heavy = np.where(rim, 0.5, 0.375)
    third = np.roll(faces, -1, axis=1).ravel()
    inner = np.flatnonzero(~rim[corner_edge])
    return join((number, edges[:, 0], heavy), (number, edges[:, 1], heavy),
                (corner_edge[inner], third[inner], np.full(len(inner), 0.125)))


def loop_edge_rows(faces, edges, corner_edge):
    """an edge on the boundary gets 1/8 of its opposite corner as well, so its row adds up to 9/8

    told by: 9/8 | boundary & opposite | boundary & 1/8 | boundary & corner | 1.125 | boundary & only | boundary & add up | boundary & row
    """
    rim = on_boundary(corner_edge)
    r, c, w = [], [], []
    for e, (a, b) in enumerate(edges):
        share = 0.5 if rim[e] else 0.375
        r += [e, e]
        c += [a, b]
        w += [share, share]
    for k, e in enumerate(corner_edge):
        face = faces[k // 3]
        r.append(e)
        c.append(face[(k + 2) % 3])
        w.append(0.125)
    return np.array(r), np.array(c), np.array(w)


def loop_faces(faces, corner_edge, vertex_count):
    """the triangles are ordered by kind, all the first ones first, not face by face

    told by: face by face | order of the | order & faces | by kind | all first | grouped | concatenat | interleav | kind
    """
    a, b, c = faces.T
    ab, bc, ca = (corner_edge + vertex_count).reshape(-1, 3).T
    kinds = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.concatenate([np.stack(kind, axis=1) for kind in kinds])


def loop_faces(faces, corner_edge, vertex_count):
    """corner_edge is read as the edge opposite to each corner, it is the edge to the next corner

    told by: opposite | next corner | ab & bc | to the next | shifted | edges & cyclic | edges & order | edges & exchanged | edges & mixed
    """
    out = []
    for (a, b, c), own in zip(faces, corner_edge.reshape(-1, 3)):
        bc, ca, ab = own + vertex_count
        out += [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    return np.array(out)


def limit_weight(n, u):
    """3/8 is multiplied by u, but u stands in the denominator: 3/(8 u)

    told by: 8 u | 8u | denominator | bracket | parenthes | multipl & u | times u | divid & u | 3/8 u
    """
    return 1 / (n + 3 / 8 * u)


def limit_weight(n, u):
    """the brackets are missing: 1/n + 3/(8 u) is not 1/(n + 3/(8 u))

    told by: bracket | parenthes | 1/n | 1 / n | whole sum | reciprocal | denominator
    """
    return 1 / n + 3 / (8 * u)
