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
    """transposes the whole array instead of the last axis, so it fails for more than one plane

    told by: .T | transpos | only & single plane | one plane | more than one | leading shape | last axis | last two axes
    """
    return planes[..., None] * planes[..., None].T


def plane_quadrics(planes):
    """the inner product p . p instead of the outer product

    told by: inner | dot product | outer product | p^T p | diagonal
    """
    squared = (planes * planes).sum(-1)
    return squared[..., None, None] * np.eye(4)


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """each of the three corners gets a third of the face's quadric instead of all of it

    told by: third | 1/3 | / 3 | divided by 3 | divided by three
    """
    share = face_quadrics / 3
    out = np.zeros((vertex_count, 4, 4))
    for f, face in enumerate(faces):
        for v in face:
            out[v] += share[f]
    return out


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """the loop over the corners ends after two: the last corner of each face gets nothing

    told by: last corner | third corner | two corners | first two | range(2) | corner & left out | corner & missing
    """
    out = np.zeros((vertex_count, 4, 4))
    for corner in range(2):
        np.add.at(out, faces[:, corner], face_quadrics)
    return out


def quadric_error(q, x):
    """takes the square root: the distance instead of the squared distance

    told by: square root | sqrt | root | not squared | distance, not its square | distance instead of
    """
    v = np.concatenate([x, np.ones(x.shape[:-1] + (1,))], -1)
    return np.sqrt(np.abs(np.einsum("...i,...ij,...j->...", v, q, v)))


def best_on_segment(q, a, b):
    """t is not clipped to 0..1, so x may leave the segment

    told by: clip | clamp | outside the segment | beyond | leaves the segment | from 0 to 1 | on the line
    """
    e = b - a
    A, offset = q[:, :3, :3], q[:, :3, 3]
    along = np.einsum("ni,nij,nj->n", e, A, e)
    unique = along > LEAST_CURVATURE * A.trace(axis1=1, axis2=2) * (e * e).sum(1)
    slope = np.einsum("ni,ni->n", e, np.einsum("nij,nj->ni", A, a) + offset)
    t = np.where(unique, -slope / np.where(unique, along, 1), 0)
    return a + t[:, None] * e, unique


def best_on_segment(q, a, b):
    """the slope lacks b of the quadric: only e.A x_i

    told by: lacks b | without b | b is missing | b is left out | + b | offset | linear term | forgot b
    """
    e = b - a
    A = q[:, :3, :3]
    Ae = (A @ e[..., None])[..., 0]
    curvature = (Ae * e).sum(1)
    unique = curvature > LEAST_CURVATURE * np.trace(A, axis1=1, axis2=2) * (e * e).sum(1)
    t = np.zeros(len(a))
    t[unique] = -(Ae * a).sum(1)[unique] / curvature[unique]
    return a + np.clip(t, 0, 1)[:, None] * e, unique


def best_anywhere(q):
    """solves A x = b: the minus sign is missing

    told by: sign | minus | negative | A x = b | +b | mirrored | opposite side
    """
    return np.linalg.solve(q[:, :3, :3], q[:, :3, 3:])[..., 0]


def best_anywhere(q):
    """divides by the diagonal of A as if the other entries were zero

    told by: diagonal | off-diagonal | component by component | each coordinate | separately
    """
    best = np.zeros((len(q), 3))
    for n in range(len(q)):
        for k in range(3):
            best[n, k] = -q[n, k, 3] / q[n, k, k]
    return best


def best_anywhere(q):
    """multiplies by A instead of by its inverse

    told by: inverse | multiplies by A | multiplied by A | not solved | instead of solving | A @ b
    """
    return -(q[:, :3, :3] @ q[:, :3, 3:])[..., 0]


def pair_costs(vertices, quadrics, pairs):
    """the cost uses only the quadric of the first vertex instead of Q_i + Q_j

    told by: quadric alone | only & first | Q_i + Q_j | only Q_i | sum of the quadrics | second vertex | other vertex | both quadrics | Q_j
    """
    i, j = pairs[:, 0], pairs[:, 1]
    positions = best_position(quadrics[i] + quadrics[j], vertices[i], vertices[j])
    return positions, quadric_error(quadrics[i], positions)


def pair_costs(vertices, quadrics, pairs):
    """the positions are the middles of the pairs instead of best_position

    told by: middle | midpoint | mid-point | half way | halfway | best_position | average of
    """
    a, b = pairs.T
    q = quadrics[a] + quadrics[b]
    middle = (vertices[a] + vertices[b]) / 2
    return middle, quadric_error(q, middle)


def pair_costs(vertices, quadrics, pairs):
    """the cost is taken at the first vertex of the pair instead of at the best position

    told by: at the first | at vertex a | at x_i | old position | not at the best | not at its position | cost & at & position
    """
    a, b = pairs.T
    q = quadrics[a] + quadrics[b]
    positions = best_position(q, vertices[a], vertices[b])
    return positions, quadric_error(q, vertices[a])


def collapse_faces(faces, a, b):
    """writes a into the caller's faces: the input is changed in place

    told by: in place | input & changed | argument & changed | modif | overwrit | copy
    """
    both = (faces == a).any(1) & (faces == b).any(1)
    faces[faces == b] = a
    return faces[~both]


def satisfies_link_condition(faces, a, b):
    """subset instead of equality: the third vertices are always shared, so it is always True

    told by: subset | superset | always True | contained | issubset | >= | equality
    """
    ring_a = set(faces[(faces == a).any(1)].ravel().tolist()) - {a, b}
    ring_b = set(faces[(faces == b).any(1)].ravel().tolist()) - {a, b}
    third = set()
    for face in faces.tolist():
        if a in face and b in face:
            third |= set(face) - {a, b}
    return third <= (ring_a & ring_b)


def flips(before, after):
    """45 goes to np.cos as if it were radians

    told by: radian | degrees | cos(45) | np.cos | deg2rad
    """
    corners = np.stack([before, after])
    edges = corners[:, :, [1, 2, 0]] - corners
    n = np.cross(edges[:, :, 0], edges[:, :, 1])
    length, new_length = np.linalg.norm(n, axis=2)
    longest, new_longest = (edges**2).sum(3).max(2)
    turns = (n[0] * n[1]).sum(1) < np.cos(45) * length * new_length
    thins = new_length * longest < LEAST_SHAPE * length * new_longest
    return bool((turns | thins).any())


def simplify_loop(vertices, faces, quadrics, face_count):
    """vertices and quadrics are not copied: the caller's arrays change

    told by: copy | copied | in place | input & change | argument & change | caller | modif | overwrit
    """
    while len(faces) > face_count:
        edges, _ = mesh.edges(faces)
        positions, costs = pair_costs(vertices, quadrics, edges)
        for k in np.argsort(costs, kind="stable"):
            a, b = edges[k]
            if not why_refused(vertices, faces_at(faces, a, b), a, b, positions[k]):
                break
        else:
            return vertices, faces
        vertices[a] = positions[k]
        quadrics[a] += quadrics[b]
        faces = collapse_faces(faces, a, b)
    return vertices, faces
