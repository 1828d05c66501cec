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
