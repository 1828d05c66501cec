"""Wrong answers to simplification, written without a look at the checks."""


def plane_quadrics(planes):
    """only the normal goes into the quadric: the row and column of d are left 0

    told by: row & column & d | last row | last column | normal alone | normal only | without d | d & left out
    """
    q = np.zeros(planes.shape[:-1] + (4, 4))
    normal = planes[..., :3]
    q[..., :3, :3] = normal[..., :, None] * normal[..., None, :]
    return q


def plane_quadrics(planes):
    """the quadrics of all planes are added up to one

    told by: sum & all planes | added up | one quadric | each plane & own | leading & shape | summed & plane | adds & planes
    """
    flat = planes.reshape(-1, 4)
    return flat.T @ flat


def plane_quadrics(planes):
    """the plane is multiplied by itself number by number, so q is diagonal

    told by: diagonal | outer product | elementwise | element by element | number by number | mixed product
    """
    q = np.zeros((*planes.shape, 4))
    for k in range(4):
        q[..., k, k] = planes[..., k] ** 2
    return q


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """with += on repeated indices only the last face at a vertex counts

    told by: += | repeated | last face | add.at | only one & face | one face & vertex | overwrit
    """
    q = np.zeros((vertex_count, 4, 4))
    q[faces] += face_quadrics[:, None]
    return q


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """the quadrics at a vertex are averaged over its faces instead of summed

    told by: mean | average | number of faces | divid & faces
    """
    q = np.zeros((vertex_count, 4, 4))
    count = np.zeros(vertex_count)
    for face, own in zip(faces, face_quadrics):
        for v in face:
            q[v] += own
            count[v] += 1
    return q / np.maximum(count, 1)[:, None, None]


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """each corner gets only a third of its face's quadric

    told by: third | 1/3 | 1 / 3 | divid & 3 | divid & three | factor & 3 | factor & three
    """
    q = np.zeros((vertex_count, 4, 4))
    np.add.at(q, faces, face_quadrics[:, None] / 3)
    return q


def quadric_error(q, x):
    """the 1 of v stands first, not last

    told by: 1 & first & x | 1 & front | 1 & last | 1 & before | (1, x) | (x, 1) | 1 & at the end
    """
    v = np.concatenate([np.ones_like(x[..., :1]), x], -1)
    return np.einsum("...i,...ij,...j->...", v, q, v)


def quadric_error(q, x):
    """2 b . x is taken only once: x A x + b . x + c

    told by: 2 b | twice & b | b & once | b & half | mixed term | cross term | linear term
    """
    A, b, c = q[..., :3, :3], q[..., :3, 3], q[..., 3, 3]
    return ((A @ x[..., None])[..., 0] * x).sum(-1) + (b * x).sum(-1) + c


def quadric_error(q, x):
    """the root is taken: the distance instead of the squared distance

    told by: root | sqrt | squared distance | not squared | distance itself | square of | the error is its square | it is the distance
    """
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    total = 0
    for i in range(4):
        for j in range(4):
            total = total + q[..., i, j] * v[..., i] * v[..., j]
    return np.sqrt(np.maximum(total, 0))


def quadric_error_backward(grad_error, q, x):
    """grad_x takes 2 q v for (q + q^t) v, which holds for symmetric q only

    told by: symmetric | Q + Q^T | Q^T | 2 Q | transpos | q.T
    """
    v = np.concatenate([x, np.ones(x.shape[:-1] + (1,))], -1)
    grad_q = grad_error[..., None, None] * v[..., :, None] * v[..., None, :]
    grad_v = 2 * grad_error[..., None] * np.einsum("...ij,...j->...i", q, v)
    return grad_q, grad_v[..., :3]


def boundary_planes(vertices, faces):
    """n points into the face instead of away from it

    told by: away from | inward | into the face | towards the face | outward | outside | n & opposite
    """
    edges, face_edges = mesh.edges(faces)
    lonely = np.bincount(face_edges.ravel(), minlength=len(edges)) == 1
    unit = mesh.face_normals(vertices, faces)
    planes = []
    for a, b in edges[lonely]:
        f = np.flatnonzero((faces == a).any(1) & (faces == b).any(1))[0]
        row = faces[f].tolist()
        if row[(row.index(a) + 1) % 3] != b:
            a, b = b, a
        n = np.cross(unit[f], vertices[b] - vertices[a])
        length = np.linalg.norm(n)
        n = n / length if length > 0 else n
        planes.append([*n, -n @ vertices[a]])
    return edges[lonely], np.array(planes).reshape(-1, 4)


def best_on_segment(q, a, b):
    """the b of the quadric is forgotten in t: -e.(A x_i) / (e.A e)

    told by: quadric's b | without b | b & left out | b & forgotten | b & missing | A x_i + b | linear part
    """
    e = b - a
    A = q[:, :3, :3]
    curve = np.einsum("ni,nij,nj->n", e, A, e)
    unique = curve > LEAST_CURVATURE * np.trace(A, axis1=1, axis2=2) * (e * e).sum(1)
    t = np.zeros(len(a))
    for k in np.flatnonzero(unique):
        t[k] = np.clip(-e[k] @ A[k] @ a[k] / curve[k], 0, 1)
    return a + t[:, None] * e, unique


def best_anywhere(q):
    """the minus before b is missing

    told by: minus | sign | -b | negat | mirrored | times -1
    """
    return np.linalg.solve(q[:, :3, :3], q[:, :3, 3:])[..., 0]


def best_anywhere(q):
    """the 2 of the gradient is kept before A alone: 2 A x = -b

    told by: half | 1/2 | 0.5 | 2 A | factor & 2 | twice | halved
    """
    places = np.empty((len(q), 3))
    for k, one in enumerate(q):
        places[k] = np.linalg.solve(2 * one[:3, :3], -one[:3, 3])
    return places


def best_anywhere(q):
    """only the diagonal of A is used, each coordinate is solved for on its own

    told by: diagonal | on its own | each coordinate | each axis | off-diagonal | separately | mixed
    """
    A = q[:, :3, :3]
    return -q[:, :3, 3] / np.diagonal(A, axis1=1, axis2=2)


def pair_costs(vertices, quadrics, pairs):
    """q is the mean of both quadrics instead of their sum, so all costs are halved

    told by: halved | half & cost | mean & quadric | average | Q_i + Q_j | sum & quadric | factor & 2
    """
    i, j = pairs[:, 0], pairs[:, 1]
    q = quadrics[pairs].mean(1)
    place = best_position(q, vertices[i], vertices[j])
    return place, quadric_error(q, place)


def pair_costs(vertices, quadrics, pairs):
    """the cost is taken in the middle of the pair, not at its best position

    told by: middle | midpoint | (a + b) / 2 | half way | halfway | cost & elsewhere | cost & best position
    """
    i, j = pairs.T
    q = quadrics[i] + quadrics[j]
    place = best_position(q, vertices[i], vertices[j])
    return place, quadric_error(q, (vertices[i] + vertices[j]) / 2)


def pair_costs(vertices, quadrics, pairs):
    """the cost is measured by the first vertex's quadric alone

    told by: Q_i | one quadric | first & quadric | only & quadric | both quadrics | second & quadric | one vertex & quadric
    """
    place = np.zeros((len(pairs), 3))
    cost = np.zeros(len(pairs))
    for k, (i, j) in enumerate(pairs):
        both = (quadrics[i] + quadrics[j])[None]
        place[k] = best_position(both, vertices[i][None], vertices[j][None])[0]
        cost[k] = quadric_error(quadrics[i], place[k])
    return place, cost


def collapse_faces(faces, a, b):
    """faces with a or b go, but only those with both should

    told by: a or b | with both | only one of | either | too many faces & go | one of them | one of the two
    """
    touched = ((faces == a) | (faces == b)).any(1)
    kept = faces[~touched]
    return np.where(kept == b, a, kept)


def collapse_faces(faces, a, b):
    """the new vertex is called b instead of a

    told by: called | a becomes b | b instead of a | renam | named | b & kept | exchang & a
    """
    out = []
    for face in faces.tolist():
        if a in face and b in face:
            continue
        out.append([b if v == a else v for v in face])
    return np.array(out, faces.dtype).reshape(-1, 3)


def collapse_faces(faces, a, b):
    """faces with both vertices stay and name a twice

    told by: twice | with both | both of them | both a and b | degenerate | not removed | two equal
    """
    merged = faces.copy()
    merged[merged == b] = a
    return merged


def satisfies_link_condition(faces, a, b):
    """it only counts the faces at the edge and never looks at the neighbours that a and b share

    told by: number of faces | count & faces | two faces | shared neighbour | neighbours & share | common neighbour | always & True
    """
    at_edge = [face for face in faces.tolist() if a in face and b in face]
    return len(at_edge) == 2


def satisfies_link_condition(faces, a, b):
    """a and b are taken out of the shared neighbours but left among the third vertices

    told by: a and b & themselves | third vertices & a and b | own ends | always & False | never & True | both ends | the pair itself
    """
    has_a = (faces == a).any(1)
    has_b = (faces == b).any(1)
    near_a = set(np.unique(faces[has_a]).tolist())
    near_b = set(np.unique(faces[has_b]).tolist())
    third = set(np.unique(faces[has_a & has_b]).tolist())
    return (near_a & near_b) - {a, b} == third


def satisfies_link_condition(faces, a, b):
    """the answer is turned round: True where the edge must stay

    told by: turned round | opposite answer | negat | revers | invert | opposite of | True & False & exchang
    """
    ring_a, ring_b, third = set(), set(), set()
    for face in faces.tolist():
        rest = set(face) - {a, b}
        if a in face:
            ring_a |= rest
        if b in face:
            ring_b |= rest
        if a in face and b in face:
            third |= rest
    return (ring_a & ring_b) != third


def flips(before, after):
    """only the turn is tested, not whether the shape becomes too thin for a certain normal

    told by: shape | thin | uncertain | LEAST_SHAPE | longest edge | sliver
    """
    n = np.cross(before[:, 1] - before[:, 0], before[:, 2] - before[:, 0])
    m = np.cross(after[:, 1] - after[:, 0], after[:, 2] - after[:, 0])
    size, new_size = np.linalg.norm(n, axis=1), np.linalg.norm(m, axis=1)
    return bool(((n * m).sum(1) < LEAST_COSINE * size * new_size).any())


def simplify_loop(vertices, faces, quadrics, face_count):
    """the quadric of the vertex that goes is not added to that of the one that stays

    told by: sum & quadric | both quadrics | quadric & added | add & quadric | quadric & not & updat | quadric & lost | quadric & forg
    """
    vertices = vertices.copy()
    while len(faces) > face_count:
        edges = mesh.edges(faces)[0]
        places, costs = pair_costs(vertices, quadrics, edges)
        found = False
        for k in np.argsort(costs, kind="stable"):
            a, b = edges[k]
            if why_refused(vertices, faces_at(faces, a, b), a, b, places[k]) == 0:
                found = True
                break
        if not found:
            break
        vertices[a] = places[k]
        faces = collapse_faces(faces, a, b)
    return vertices, faces


def simplify_loop(vertices, faces, quadrics, face_count):
    """it stops at the first refusal instead of trying the next cheapest edge

    told by: next cheapest | refus & stop | refus & next | gives up | first refus | stops & early | cheapest & refused
    """
    vertices, quadrics = vertices.copy(), quadrics.copy()
    while len(faces) > face_count:
        edges, _ = mesh.edges(faces)
        places, costs = pair_costs(vertices, quadrics, edges)
        k = np.argmin(costs)
        a, b = edges[k]
        if why_refused(vertices, faces_at(faces, a, b), a, b, places[k]):
            break
        vertices[a] = places[k]
        quadrics[a] = quadrics[a] + quadrics[b]
        faces = collapse_faces(faces, a, b)
    return vertices, faces


def simplify_loop(vertices, faces, quadrics, face_count):
    """the lower vertex stays where it was, it does not move to the pair's best position

    told by: best position | pair_costs & position | stays where | not moved | does not move | not & move | old place
    """
    vertices, quadrics = vertices.copy(), quadrics.copy()
    while len(faces) > face_count:
        edges, _ = mesh.edges(faces)
        places, costs = pair_costs(vertices, quadrics, edges)
        chosen = None
        for k in np.argsort(costs, kind="stable"):
            a, b = edges[k]
            if not why_refused(vertices, faces_at(faces, a, b), a, b, places[k]):
                chosen = a, b
                break
        if chosen is None:
            return vertices, faces
        a, b = chosen
        quadrics[a] += quadrics[b]
        faces = collapse_faces(faces, a, b)
    return vertices, faces


def plane_quadrics(planes):
    """the quadrics of all planes are added up to one, there should be one for each plane

    told by: one for each | each plane | added up | sum & planes | leading | all planes
    """
    rows = planes.reshape(-1, 4)
    return rows.T @ rows


def plane_quadrics(planes):
    """d has the other sign, as for planes written n . x = d

    told by: n . x = d | -d | sign | minus | negative
    """
    p = planes * np.array([1.0, 1.0, 1.0, -1.0])
    return np.einsum("...i,...j->...ij", p, p)


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """+= with repeated indices keeps only one of the faces in which a vertex is the same corner

    told by: += | repeated | np.add.at | scatter | only one | last face | more than once | several faces | lost
    """
    total = np.zeros((vertex_count, 4, 4))
    for corner in range(3):
        total[faces[:, corner]] += face_quadrics
    return total


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """the sum is divided by the number of faces: it is a mean, not a sum

    told by: mean | average | number of faces | divided & count | sum & not & mean
    """
    total = np.zeros((vertex_count, 4, 4))
    count = np.zeros(vertex_count)
    for f, face in enumerate(faces):
        for v in face:
            total[v] += face_quadrics[f]
            count[v] += 1
    return total / np.maximum(count, 1)[:, None, None]


def quadric_error(q, x):
    """v ends with 0, not with 1: b and c are ignored

    told by: (x, 1) | ends with | homogeneous | last number | b and c | fourth | v = (x | offset | append
    """
    v = np.concatenate([x, np.zeros_like(x[..., :1])], -1)
    return np.einsum("...i,...ij,...j->...", v, q, v)


def quadric_error(q, x):
    """this is |Q v|^2, not v^T Q v

    told by: q v & square | v^t q v | squared length | squares & q v | q twice | q^2 | q v & length
    """
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    Qv = (q @ v[..., None])[..., 0]
    return (Qv**2).sum(-1)


def best_anywhere(q):
    """the sign of b is missing: A x = b is solved, not A x = -b

    told by: -b | sign | minus | negative | mirrored | a x = b | opposite
    """
    places = np.empty((len(q), 3))
    for k in range(len(q)):
        places[k] = np.linalg.solve(q[k, :3, :3], q[k, :3, 3])
    return places


def best_anywhere(q):
    """the gradient is taken to be 2 A x + b, so the place is half of what it should be

    told by: half | twice | factor | 2 a | 0.5 | 1/2 | 2 (a x + b) | 2 b
    """
    A, b = q[:, :3, :3], q[:, :3, 3:]
    return -np.linalg.solve(2 * A, b)[..., 0]


def pair_costs(vertices, quadrics, pairs):
    """the cost is half: the mean of the two quadrics is taken, not their sum

    told by: half | sum of & quadrics | mean | q_i + q_j | average | factor 2 | factor of 2 | twice | 0.5
    """
    first, second = pairs[:, 0], pairs[:, 1]
    q = (quadrics[first] + quadrics[second]) / 2
    x = best_position(q, vertices[first], vertices[second])
    return x, quadric_error(q, x)


def pair_costs(vertices, quadrics, pairs):
    """the cost counts the first vertex's quadric only, not the sum of both

    told by: sum of both | q_i + q_j | only & quadric | both quadrics | first vertex | second vertex | one & quadric | q_a | sum of the | sum & quadrics | other vertex
    """
    places, costs = np.zeros((len(pairs), 3)), np.zeros(len(pairs))
    for k, (i, j) in enumerate(pairs):
        both = (quadrics[i] + quadrics[j])[None]
        places[k] = best_position(both, vertices[[i]], vertices[[j]])[0]
        costs[k] = quadric_error(quadrics[i], places[k])
    return places, costs


def collapse_faces(faces, a, b):
    """the merged vertex is called b, it should be called a

    told by: called a | called b | a & renamed | a & b & exchanged | a & b & swapped | b stays | a by b
    """
    left = []
    for face in faces.tolist():
        if not (a in face and b in face):
            left.append([b if v == a else v for v in face])
    return np.array(left, faces.dtype).reshape(-1, 3)


def collapse_faces(faces, a, b):
    """the vertices above b are renumbered, as if b had been deleted

    told by: renumber | above b | deleted | greater than b | number & other vert | other vertices | shift | keep & number | lowered
    """
    doomed = (faces == a).any(axis=1) & (faces == b).any(axis=1)
    rest = faces[~doomed].copy()
    rest[rest == b] = a
    rest[rest > b] -= 1
    return rest


def satisfies_link_condition(faces, a, b):
    """it only asks whether the third vertices are among the shared neighbours, which is always so: both sets must be equal

    told by: always true | subset | contained | among | sets & equal | never refus | more shared | third & shared | always & true | other direction
    """
    near_a, near_b, third = set(), set(), set()
    for face in faces.tolist():
        if a in face:
            near_a |= set(face) - {a}
        if b in face:
            near_b |= set(face) - {b}
        if a in face and b in face:
            third |= set(face) - {a, b}
    return third <= (near_a & near_b)


def satisfies_link_condition(faces, a, b):
    """a and b themselves are counted as shared neighbours but not as third vertices, so every edge is refused

    told by: themselves | a and b | always false | every edge | never | own neighbour | refuses all | always & false | include & a
    """
    with_a = [set(face) for face in faces.tolist() if a in face]
    with_b = [set(face) for face in faces.tolist() if b in face]
    shared = set().union(*with_a) & set().union(*with_b)
    third = set().union(*(face for face in with_a if b in face)) - {a, b}
    return shared == third


def simplify_loop(vertices, faces, quadrics, face_count):
    """the kept vertex does not get the sum of both quadrics: it keeps its own

    told by: sum of both | quadric & add | quadric & sum | quadric & own | quadric & kept | quadrics & both | quadric & not updated | quadric & forgot | q_i + q_j
    """
    vertices = vertices.copy()
    while len(faces) > face_count:
        edges = mesh.edges(faces)[0]
        places, costs = pair_costs(vertices, quadrics, edges)
        done = False
        for k in np.argsort(costs, kind="stable"):
            a, b = edges[k]
            if why_refused(vertices, faces_at(faces, a, b), a, b, places[k]) == 0:
                vertices[a] = places[k]
                faces = collapse_faces(faces, a, b)
                done = True
                break
        if not done:
            break
    return vertices, faces


def simplify_loop(vertices, faces, quadrics, face_count):
    """it stops at the first refused edge, where it should try the next cheapest

    told by: refused & next | stops | next cheapest | gives up | other edges | first refused | too early | next edge | too many faces
    """
    vertices, quadrics = vertices.copy(), quadrics.copy()
    while len(faces) > face_count:
        edges = mesh.edges(faces)[0]
        places, costs = pair_costs(vertices, quadrics, edges)
        k = np.argmin(costs)
        a, b = edges[k]
        if why_refused(vertices, faces_at(faces, a, b), a, b, places[k]):
            break
        vertices[a] = places[k]
        quadrics[a] = quadrics[a] + quadrics[b]
        faces = collapse_faces(faces, a, b)
    return vertices, faces


def quadric_error_backward(grad_error, q, x):
    """q is taken to be symmetric: 2 Q v stands where (Q + Q^T) v should

    told by: symmetric | transpos | q^t | q.t | 2 q v
    """
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    grad_q = np.einsum("...,...i,...j->...ij", grad_error, v, v)
    grad_v = 2 * grad_error[..., None] * np.einsum("...ij,...j->...i", q, v)
    return grad_q, grad_v[..., :3]


def best_on_segment(q, a, b):
    """t is not clipped from 0 to 1, so places beyond the segment's ends come out

    told by: clip | beyond | outside & segment | 0 to 1 | ends of the segment | past the end | clamp
    """
    places, unique = np.array(a, float), np.zeros(len(a), bool)
    for k in range(len(a)):
        e = b[k] - a[k]
        A, off = q[k, :3, :3], q[k, :3, 3]
        bend = e @ A @ e
        unique[k] = bend > LEAST_CURVATURE * np.trace(A) * (e @ e)
        if unique[k]:
            places[k] = a[k] - (e @ (A @ a[k] + off)) / bend * e
    return places, unique


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """the sums are kept in float32: seven digits only

    told by: float32 | single precision | digits | precision | float64 | dtype
    """
    total = np.zeros((vertex_count, 4, 4), np.float32)
    np.add.at(total, faces.ravel(), np.repeat(face_quadrics, 3, axis=0))
    return total
