"""Lab 12 as printed: what one types who has read the questions and the equations."""


def plane_quadrics(planes):
    return planes[..., :, None] * planes[..., None, :]


def vertex_quadrics(face_quadrics, faces, vertex_count):
    Q = np.zeros((vertex_count, 4, 4))
    for f, face in enumerate(faces):
        for i in face:
            Q[i] += face_quadrics[f]
    return Q


def quadric_error(q, x):
    v = np.concatenate([x, np.ones((*x.shape[:-1], 1))], axis=-1)
    return (v[..., None, :] @ q @ v[..., :, None])[..., 0, 0]


def best_anywhere(q):
    return np.linalg.solve(q[:, :3, :3], -q[:, :3, 3][..., None])[..., 0]


def pair_costs(vertices, quadrics, pairs):
    i, j = pairs[:, 0], pairs[:, 1]
    Q = quadrics[i] + quadrics[j]
    v = best_position(Q, vertices[i], vertices[j])
    return v, quadric_error(Q, v)


def collapse_faces(faces, a, b):
    left = []
    for face in faces.tolist():
        if not (a in face and b in face):
            left.append([a if i == b else i for i in face])
    return np.array(left, int).reshape(-1, 3)


def satisfies_link_condition(faces, a, b):
    def neighbours(i):
        return {j for face in faces.tolist() if i in face for j in face} - {i}

    thirds = {j for face in faces.tolist() if a in face and b in face for j in face} - {a, b}
    return neighbours(a) & neighbours(b) == thirds


def simplify_loop(vertices, faces, quadrics, face_count):
    vertices, quadrics = vertices.copy(), quadrics.copy()
    while len(faces) > face_count:
        edges = mesh.edges(faces)[0]
        positions, costs = pair_costs(vertices, quadrics, edges)
        found = None
        for k in np.argsort(costs):
            if why_refused(vertices, faces, *edges[k], positions[k]) == 0:
                found = k
                break
        if found is None:
            break
        a, b = edges[found]
        vertices[a] = positions[found]
        quadrics[a] = quadrics[a] + quadrics[b]
        faces = collapse_faces(faces, a, b)
    return vertices, faces
