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


def loop_faces(faces, corner_edge, vertex_count):
    """the middle triangle is wound the other way round

    told by: middle | wound | winding | clockwise | orient | fourth | other way round
    """
    out = []
    for f, (a, b, c) in enumerate(faces):
        ab, bc, ca = vertex_count + corner_edge[3 * f:3 * f + 3]
        out += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, ca, bc)]
    return np.array(out)


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
    """the division by n at the end is forgotten

    told by: divided by n | division by n | divide by n | n times | factor n | factor 1/n
    """
    return 5 / 8 - (3 / 8 + np.cos(2 * np.pi / n) / 4) ** 2


def loop_weight(n):
    """the cosine is taken of pi / n instead of 2 pi / n

    told by: half & angle | angle & twice | full turn | 2 pi & instead | pi/n & instead | pi / n & instead
    """
    bracket = 3 / 8 + 1 / 4 * np.cos(np.pi / n)
    return 1 / n * (5 / 8 - bracket * bracket)


def loop_weight(n):
    """the cosine is not divided by 4

    told by: by 4 | factor 1/4 | factor 4 | quarter | four times | cosine's 1/4 & missing
    """
    return (5 / 8 - (3 / 8 + np.cos(2 * np.pi / n)) ** 2) / n


def loop_slow(vertices, faces, u):
    """vertices on the boundary are moved by the rule for vertices inside

    told by: boundary & vert & inside | boundary vert | w = 1/8 | old vert & boundary | vert & on the boundary | boundary & inner rule
    """
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    points = []
    for v in range(len(vertices)):
        ring, _ = ring_of(v, at_edge)
        points.append((1 - len(ring) * u[v]) * vertices[v] + u[v] * vertices[ring].sum(0))
    for edge, its_faces in at_edge:
        ends = vertices[list(edge)].sum(0)
        opposite = [v for f in its_faces for v in faces[f] if v not in edge]
        if len(its_faces) == 1:
            points.append(ends / 2)
        else:
            points.append(3 / 8 * ends + 1 / 8 * vertices[opposite].sum(0))
    return np.stack(points)


def loop_slow(vertices, faces, u):
    """an old vertex takes the mean of its ring instead of the sum, so its weights do not add up to 1

    told by: mean & ring | sum & ring | add up & 1 | average & ring | mean instead of sum
    """
    at_edge = faces_at_edges(faces.ravel(), np.full(len(faces), 3))
    points = []
    for v in range(len(vertices)):
        ring, along = ring_of(v, at_edge)
        if along:
            points.append(3 / 4 * vertices[v] + 1 / 8 * vertices[along].sum(0))
        else:
            n = len(ring)
            points.append((1 - n * u[v]) * vertices[v] + u[v] * vertices[ring].mean(0))
    for edge, its_faces in at_edge:
        A, B = vertices[edge[0]], vertices[edge[1]]
        if len(its_faces) == 1:
            points.append((A + B) / 2)
            continue
        C, D = (vertices[[v for v in faces[f] if v not in edge][0]] for f in its_faces)
        points.append(3 / 8 * (A + B) + 1 / 8 * (C + D))
    return np.array(points)


def loop_slow(vertices, faces, u):
    """the edge's weights are exchanged: 1/8 for its ends and 3/8 for the opposite corners

    told by: 3/8 & 1/8 | weights & exchang | weights & swap | opposite & 3/8 | ends & 1/8
    """
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
        if len(its_faces) == 2:
            points.append(1 / 8 * ends + 3 / 8 * vertices[opposite].sum(0))
        else:
            points.append(0.5 * ends)
    return np.stack(points)


def loop_edge_rows(faces, edges, corner_edge):
    """an inner edge's opposite corner is written only once: the second face's overwrites the first's

    told by: only one & face | second face | one opposite | overwrit | other face | both faces
    """
    is_boundary = on_boundary(corner_edge)
    every = np.arange(len(edges))
    end_weight = np.where(is_boundary, 1 / 2, 3 / 8)
    across = np.zeros(len(edges), int)
    across[corner_edge] = np.roll(faces, 1, axis=1).ravel()
    inner = every[~is_boundary]
    return join((every, edges[:, 0], end_weight), (every, edges[:, 1], end_weight),
                (inner, across[inner], np.full(len(inner), 1 / 8)))


def loop_faces(faces, corner_edge, vertex_count):
    """the three edges of a face are taken to be opposite to its corners: BC, CA, AB instead of AB, BC, CA

    told by: opposite | BC, CA | BC & first | edges & order | cyclic | shifted & edge
    """
    new = []
    for f in range(len(faces)):
        A, B, C = faces[f]
        BC, CA, AB = vertex_count + corner_edge[3 * f:3 * f + 3]
        new += [(A, AB, CA), (AB, B, BC), (CA, BC, C), (AB, BC, CA)]
    return np.array(new)


def loop_faces(faces, corner_edge, vertex_count):
    """the middle triangle is wound the other way round

    told by: wound | winding | orientation | clockwise | turned round | middle & order
    """
    a, b, c = faces.T
    ab, bc, ca = (vertex_count + corner_edge).reshape(-1, 3).T
    return np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, ca, bc], axis=1).reshape(-1, 3)


def loop_faces(faces, corner_edge, vertex_count):
    """the middle triangle is left out: three new triangles a face

    told by: no middle | middle & missing | middle & left out | three & triangle | fourth | 3 F
    """
    a, b, c = faces.T
    ab, bc, ca = (vertex_count + corner_edge).reshape(-1, 3).T
    return np.stack([a, ab, ca, ab, b, bc, ca, bc, c], axis=1).reshape(-1, 3)


def limit_weight(n, u):
    """the fraction is 3 u / 8 instead of 3 / (8 u)

    told by: 3 u / 8 | 3/8 u | 3u/8 | divided by u | multiplied by u | times u
    """
    return 1 / (n + 3 / 8 * u)


def limit_weight(n, u):
    """the plus is read as a product: 1 / (n 3 / (8 u))

    told by: product & sum | times & plus | multipl & add | product & plus | times instead of
    """
    return 1 / (n * 3 / (8 * u))
