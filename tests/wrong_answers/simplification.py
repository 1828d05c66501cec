"""Wrong answers to simplification, written without a look at the checks."""


def plane_quadrics(planes):
    """the quadrics of all planes are added up to one, there should be one for each plane

    told by: one for each | each plane | added up | sum & planes | leading | all planes
    """
    rows = planes.reshape(-1, 4)
    return rows.T @ rows


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """+= with repeated indices keeps only one of the faces in which a vertex is the same corner

    told by: += | repeated | np.add.at | scatter | only one | last face | more than once | several faces | lost
    """
    total = np.zeros((vertex_count, 4, 4))
    for corner in range(3):
        total[faces[:, corner]] += face_quadrics
    return total


def quadric_error(q, x):
    """v ends with 0, not with 1: b and c are ignored

    told by: (x, 1) | ends with | homogeneous | last number | b and c | fourth | v = (x | offset | append
    """
    v = np.concatenate([x, np.zeros_like(x[..., :1])], -1)
    return np.einsum("...i,...ij,...j->...", v, q, v)


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


def flips(before, after):
    """only the turn is tested, not whether the shape becomes too thin for a certain normal

    told by: shape | thin | uncertain | LEAST_SHAPE | longest edge | sliver
    """
    n = np.cross(before[:, 1] - before[:, 0], before[:, 2] - before[:, 0])
    m = np.cross(after[:, 1] - after[:, 0], after[:, 2] - after[:, 0])
    size, new_size = np.linalg.norm(n, axis=1), np.linalg.norm(m, axis=1)
    return bool(((n * m).sum(1) < LEAST_COSINE * size * new_size).any())


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
