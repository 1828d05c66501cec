"""Mistakes of lab 12; each docstring goes on after "this is what comes out when"."""


def plane_quadrics(planes):
    """only the squares on the diagonal are filled in"""
    return np.eye(4) * planes[..., None, :]**2


def plane_quadrics(planes):
    """d is left out of the last column"""
    return (planes[..., :, None] * planes[..., None, :]) * [1, 1, 1, 0]


def plane_quadrics(planes):
    """it is twice p p^T"""
    return 2 * planes[..., :, None] * planes[..., None, :]


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """of the faces that share a corner's number only the last one counts: += with an array does not
    add up"""
    total = np.zeros((vertex_count, 4, 4))
    for corner in faces.T:
        total[corner] += face_quadrics
    return total


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """the third corner is left out"""
    total = np.zeros((vertex_count, 4, 4))
    for corner in faces.T[:2]:
        np.add.at(total, corner, face_quadrics)
    return total


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """it is the mean over the faces instead of the sum"""
    total = np.zeros((vertex_count, 4, 4))
    for corner in faces.T:
        np.add.at(total, corner, face_quadrics)
    count = np.bincount(faces.ravel(), minlength=vertex_count)
    return total / np.maximum(count, 1)[:, None, None]


def quadric_error(q, x):
    """a 0 is appended: that is a direction; a point has a 1"""
    v = np.concatenate([x, np.zeros_like(x[..., :1])], -1)
    return ((q @ v[..., None])[..., 0] * v).sum(-1)


def quadric_error(q, x):
    """it is the distance; the error is its square"""
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    return np.sqrt(np.maximum(((q @ v[..., None])[..., 0] * v).sum(-1), 0))


def quadric_error(q, x):
    """it is the mean of four products instead of their sum"""
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    return ((q @ v[..., None])[..., 0] * v).mean(-1)


def quadric_error_backward(grad_error, q, x):
    """q is taken to be symmetric: 2 Q v"""
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    grad_q = grad_error[..., None, None] * plane_quadrics(v)
    grad_v = grad_error[..., None] * (2 * q @ v[..., None])[..., 0]
    return grad_q, grad_v[..., :3]


def quadric_error_backward(grad_error, q, x):
    """v counts on one side of Q alone; it is on both"""
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    grad_q = grad_error[..., None, None] * plane_quadrics(v)
    grad_v = grad_error[..., None] * (q @ v[..., None])[..., 0]
    return grad_q, grad_v[..., :3]


def quadric_error_backward(grad_error, q, x):
    """grad_error is left out of the gradient by q"""
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    grad_q = plane_quadrics(v)
    grad_v = grad_error[..., None] * ((q + q.swapaxes(-1, -2)) @ v[..., None])[..., 0]
    return grad_q, grad_v[..., :3]


def boundary_planes(vertices, faces):
    """n points into the face; outside is on the right of the edge"""
    edges, face_edges = mesh.edges(faces)
    lonely = np.bincount(face_edges.ravel(), minlength=len(edges)) == 1
    face, corner = np.nonzero(lonely[face_edges])
    face, corner = np.stack([face, corner])[:, np.argsort(face_edges[face, corner])]
    a, b = vertices[faces[face, corner - 2]], vertices[faces[face, corner - 1]]
    n = np.cross(mesh.face_normals(vertices, faces)[face], b - a)
    length = np.linalg.norm(n, axis=1, keepdims=True)
    n /= np.where(length > 0, length, 1)
    return edges[lonely], np.column_stack([n, -(n * a).sum(1)])


def boundary_planes(vertices, faces):
    """n is not brought to length 1"""
    edges, face_edges = mesh.edges(faces)
    lonely = np.bincount(face_edges.ravel(), minlength=len(edges)) == 1
    face, corner = np.nonzero(lonely[face_edges])
    face, corner = np.stack([face, corner])[:, np.argsort(face_edges[face, corner])]
    a, b = vertices[faces[face, corner - 2]], vertices[faces[face, corner - 1]]
    n = np.cross(b - a, mesh.face_normals(vertices, faces)[face])
    return edges[lonely], np.column_stack([n, -(n * a).sum(1)])


def boundary_planes(vertices, faces):
    """d has the wrong sign: n . x + d = 0"""
    edges, face_edges = mesh.edges(faces)
    lonely = np.bincount(face_edges.ravel(), minlength=len(edges)) == 1
    face, corner = np.nonzero(lonely[face_edges])
    face, corner = np.stack([face, corner])[:, np.argsort(face_edges[face, corner])]
    a, b = vertices[faces[face, corner - 2]], vertices[faces[face, corner - 1]]
    n = np.cross(b - a, mesh.face_normals(vertices, faces)[face])
    length = np.linalg.norm(n, axis=1, keepdims=True)
    n /= np.where(length > 0, length, 1)
    return edges[lonely], np.column_stack([n, (n * a).sum(1)])


def best_on_segment(q, a, b):
    """t has the wrong sign"""
    e, (A, offset) = b - a, (q[:, :3, :3], q[:, :3, 3])
    along = ((A @ e[..., None])[..., 0] * e).sum(1)
    unique = along > LEAST_CURVATURE * A.trace(axis1=1, axis2=2) * (e * e).sum(1)
    slope = (((A @ a[..., None])[..., 0] + offset) * e).sum(1)
    t = np.where(unique, slope / np.where(unique, along, 1), 0)
    return a + np.clip(t, 0, 1)[:, None] * e, unique


def best_on_segment(q, a, b):
    """t is not kept on the segment"""
    e, (A, offset) = b - a, (q[:, :3, :3], q[:, :3, 3])
    along = ((A @ e[..., None])[..., 0] * e).sum(1)
    unique = along > LEAST_CURVATURE * A.trace(axis1=1, axis2=2) * (e * e).sum(1)
    slope = (((A @ a[..., None])[..., 0] + offset) * e).sum(1)
    t = np.where(unique, -slope / np.where(unique, along, 1), 0)
    return a + t[:, None] * e, unique


def best_on_segment(q, a, b):
    """the slope is that at b; t is counted from a"""
    e, (A, offset) = b - a, (q[:, :3, :3], q[:, :3, 3])
    along = ((A @ e[..., None])[..., 0] * e).sum(1)
    unique = along > LEAST_CURVATURE * A.trace(axis1=1, axis2=2) * (e * e).sum(1)
    slope = (((A @ b[..., None])[..., 0] + offset) * e).sum(1)
    t = np.where(unique, -slope / np.where(unique, along, 1), 0)
    return a + np.clip(t, 0, 1)[:, None] * e, unique


def best_anywhere(q):
    """b has the wrong sign: A x = -b"""
    return np.linalg.solve(q[:, :3, :3], q[:, :3, 3:])[..., 0]


def best_anywhere(q):
    """b is multiplied by A; the system A x = -b is to be solved"""
    return -(q[:, :3, :3] @ q[:, :3, 3:])[..., 0]


def pair_costs(vertices, quadrics, pairs):
    """the higher vertex's quadric is left out; a pair has the sum of both"""
    a, b = pairs.T
    positions = best_position(quadrics[a], vertices[a], vertices[b])
    return positions, quadric_error(quadrics[a], positions)


def pair_costs(vertices, quadrics, pairs):
    """it is the mean of both quadrics instead of their sum"""
    a, b = pairs.T
    q = (quadrics[a] + quadrics[b]) / 2
    positions = best_position(q, vertices[a], vertices[b])
    return positions, quadric_error(q, positions)


def pair_costs(vertices, quadrics, pairs):
    """the cost is that of staying at the lower vertex, not of the best position"""
    a, b = pairs.T
    q = quadrics[a] + quadrics[b]
    return best_position(q, vertices[a], vertices[b]), quadric_error(q, vertices[a])


def collapse_faces(faces, a, b):
    """a is renamed to b; the vertex that stays is a"""
    kept = faces[~((faces == a).any(1) & (faces == b).any(1))]
    return np.where(kept == a, b, kept)


def collapse_faces(faces, a, b):
    """faces with both vertices stay"""
    kept = faces
    return np.where(kept == b, a, kept)


def collapse_faces(faces, a, b):
    """faces with one of the vertices go; only those with both do"""
    kept = faces[~((faces == a).any(1) | (faces == b).any(1))]
    return np.where(kept == b, a, kept)


def satisfies_link_condition(faces, a, b):
    """shared vertices are counted: two besides the edge's ends, though an edge may have three
    faces"""
    at_a, at_b = (faces == a).any(1), (faces == b).any(1)
    shared = set(faces[at_a].ravel().tolist()) & set(faces[at_b].ravel().tolist())
    return len(shared) == 4


def satisfies_link_condition(faces, a, b):
    """every edge may be collapsed, whatever its ends share"""
    return True


def satisfies_link_condition(faces, a, b):
    """no neighbour may be shared at all; the thirds of the edge's faces must be"""
    at_a, at_b = (faces == a).any(1), (faces == b).any(1)
    shared = set(faces[at_a].ravel().tolist()) & set(faces[at_b].ravel().tolist())
    return shared - {a, b} == set()


def flips(before, after):
    """a face that becomes a needle is left alone; its normal is uncertain"""
    corners = np.stack([before, after])
    edges = corners[:, :, [1, 2, 0]] - corners
    n = np.cross(edges[:, :, 0], edges[:, :, 1])
    length, new_length = np.sqrt((n * n).sum(2))
    turns = (n[0] * n[1]).sum(1) < LEAST_COSINE * length * new_length
    return bool(turns.any())


def flips(before, after):
    """all triangles must flip; one is enough"""
    corners = np.stack([before, after])
    edges = corners[:, :, [1, 2, 0]] - corners
    n = np.cross(edges[:, :, 0], edges[:, :, 1])
    length, new_length = np.sqrt((n * n).sum(2))
    longest, new_longest = (edges * edges).sum(3).max(2)
    turns = (n[0] * n[1]).sum(1) < LEAST_COSINE * length * new_length
    thins = new_length * longest < LEAST_SHAPE * length * new_longest
    return bool((turns | thins).all())


def flips(before, after):
    """the faces whose normal stays flip; it is those whose normal turns"""
    corners = np.stack([before, after])
    edges = corners[:, :, [1, 2, 0]] - corners
    n = np.cross(edges[:, :, 0], edges[:, :, 1])
    length, new_length = np.sqrt((n * n).sum(2))
    longest, new_longest = (edges * edges).sum(3).max(2)
    turns = (n[0] * n[1]).sum(1) > LEAST_COSINE * length * new_length
    thins = new_length * longest < LEAST_SHAPE * length * new_longest
    return bool((turns | thins).any())


def simplify_loop(vertices, faces, quadrics, face_count):
    """it goes on where there are just as many faces as asked for"""
    vertices, quadrics = vertices.copy(), quadrics.copy()
    while len(faces) >= face_count:
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


def simplify_loop(vertices, faces, quadrics, face_count):
    """a vertex keeps its own quadric; it gets the sum of both"""
    vertices, quadrics = vertices.copy(), quadrics.copy()
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
        faces = collapse_faces(faces, a, b)
    return vertices, faces


def simplify_loop(vertices, faces, quadrics, face_count):
    """the vertex that stays does not move"""
    vertices, quadrics = vertices.copy(), quadrics.copy()
    while len(faces) > face_count:
        edges, _ = mesh.edges(faces)
        positions, costs = pair_costs(vertices, quadrics, edges)
        for k in np.argsort(costs, kind="stable"):
            a, b = edges[k]
            if not why_refused(vertices, faces_at(faces, a, b), a, b, positions[k]):
                break
        else:
            return vertices, faces
        quadrics[a] += quadrics[b]
        faces = collapse_faces(faces, a, b)
    return vertices, faces
