"""Mistakes of lab 12; each docstring goes on after "this is what comes out when"."""


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """a vertex that stands several times in one column of faces gets only the last of its faces: +=
    with an array of indices does not add up, np.add.at does"""
    total = np.zeros((vertex_count, 4, 4))
    for corner in faces.T:
        total[corner] += face_quadrics
    return total


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """it is the mean over the faces at a vertex instead of the sum"""
    total = np.zeros((vertex_count, 4, 4))
    for corner in faces.T:
        np.add.at(total, corner, face_quadrics)
    count = np.bincount(faces.ravel(), minlength=vertex_count)
    return total / np.maximum(count, 1)[:, None, None]


def quadric_error(q, x):
    """the linear term counts once: it is x . A x + b . x + c, and b . x needs the factor 2"""
    A, b, c = q[..., :3, :3], q[..., :3, 3], q[..., 3, 3]
    return ((A @ x[..., None])[..., 0] * x).sum(-1) + (b * x).sum(-1) + c


def simplify_loop(vertices, faces, quadrics, face_count):
    """edges and costs are computed once, before the loop, and never again after a collapse"""
    vertices, quadrics = vertices.copy(), quadrics.copy()
    edges, _ = mesh.edges(faces)
    positions, costs = pair_costs(vertices, quadrics, edges)
    for k in np.argsort(costs, kind="stable"):
        if len(faces) <= face_count:
            break
        a, b = edges[k]
        at = faces_at(faces, a, b)
        if ((at == a).any(1) & (at == b).any(1)).any() and not why_refused(
                vertices, at, a, b, positions[k]):
            vertices[a] = positions[k]
            quadrics[a] += quadrics[b]
            faces = collapse_faces(faces, a, b)
    return vertices, faces
