"""Mistakes of lab 12; each docstring goes on after "this is what comes out when"."""


def plane_quadrics(planes):
    """only the squares on the diagonal are filled in"""
    return np.eye(4) * planes[..., None, :]**2


def plane_quadrics(planes):
    """d is left out: only n n^T is filled, and the last row and the last column are 0"""
    n = planes * [1, 1, 1, 0]
    return n[..., :, None] * n[..., None, :]


def plane_quadrics(planes):
    """d is left out of the last column"""
    return (planes[..., :, None] * planes[..., None, :]) * [1, 1, 1, 0]


def plane_quadrics(planes):
    """p is divided by the length of its normal first; (2) takes p as it is, without normalising"""
    p = planes / np.linalg.norm(planes[..., :3], axis=-1, keepdims=True)
    return p[..., :, None] * p[..., None, :]


def plane_quadrics(planes):
    """the matrices of all planes are summed into one: the leading axes are lost"""
    rows = planes.reshape(-1, 4)
    return rows.T @ rows


def plane_quadrics(planes):
    """it is p . p, row times column: a number, not a matrix; Q is p p^T, column times row"""
    return (planes * planes).sum(-1)


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """a vertex that stands several times in one column of faces gets only the last of its faces: +=
    with an array of indices does not add up, np.add.at does"""
    total = np.zeros((vertex_count, 4, 4))
    for corner in faces.T:
        total[corner] += face_quadrics
    return total


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """only the last of a vertex's faces counts: = in a loop, or += with repeated indices, does not
    add them up, and np.add.at does"""
    total = np.zeros((vertex_count, 4, 4))
    total[faces] += face_quadrics[:, None]
    return total


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """it is the mean over the faces at a vertex instead of the sum"""
    total = np.zeros((vertex_count, 4, 4))
    for corner in faces.T:
        np.add.at(total, corner, face_quadrics)
    count = np.bincount(faces.ravel(), minlength=vertex_count)
    return total / np.maximum(count, 1)[:, None, None]


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """each corner gets a third of the face's quadric; each gets the whole"""
    total = np.zeros((vertex_count, 4, 4))
    for corner in faces.T:
        np.add.at(total, corner, face_quadrics)
    return total / 3


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """the quadrics are repeated in another order than the corners (tile, not repeat), so a vertex
    gets those of other faces"""
    total = np.zeros((vertex_count, 4, 4))
    np.add.at(total, faces.ravel(), np.tile(face_quadrics, (3, 1, 1)))
    return total


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """vertex_count is ignored: there are only as many rows as the largest vertex of the faces asks
    for"""
    total = np.zeros((faces.max() + 1, 4, 4))
    for corner in faces.T:
        np.add.at(total, corner, face_quadrics)
    return total


def quadric_error(q, x):
    """the fourth number of v is 0 instead of 1: (x, 0) is a direction, and the point is (x, 1)"""
    v = np.concatenate([x, np.zeros_like(x[..., :1])], -1)
    return ((q @ v[..., None])[..., 0] * v).sum(-1)


def quadric_error(q, x):
    """it is the distance; the error is its square"""
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    return np.sqrt(np.maximum(((q @ v[..., None])[..., 0] * v).sum(-1), 0))


def quadric_error(q, x):
    """the 1 comes first in v, as (1, x); it must be last, as (x, 1)"""
    v = np.concatenate([np.ones_like(x[..., :1]), x], -1)
    return ((q @ v[..., None])[..., 0] * v).sum(-1)


def quadric_error(q, x):
    """the linear term counts once: it is x . A x + b . x + c, and b . x needs the factor 2"""
    A, b, c = q[..., :3, :3], q[..., :3, 3], q[..., 3, 3]
    return ((A @ x[..., None])[..., 0] * x).sum(-1) + (b * x).sum(-1) + c


def quadric_error(q, x):
    """it is the squared length of Q v instead of v . Q v"""
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    return ((q @ v[..., None])[..., 0] ** 2).sum(-1)


def quadric_error(q, x):
    """only the block A counts, and c: the linear term 2 b . x is left out"""
    A, c = q[..., :3, :3], q[..., 3, 3]
    return ((A @ x[..., None])[..., 0] * x).sum(-1) + c


def quadric_error_backward(grad_error, q, x):
    """grad_x is 2 Q v, as for a symmetric Q; it is (Q + Q^T) v, with the transposed Q as well"""
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    grad_q = grad_error[..., None, None] * plane_quadrics(v)
    grad_v = grad_error[..., None] * (2 * q @ v[..., None])[..., 0]
    return grad_q, grad_v[..., :3]


def quadric_error_backward(grad_error, q, x):
    """grad_x is Q v alone: v stands on both sides of Q, which gives Q^T v as well"""
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    grad_q = grad_error[..., None, None] * plane_quadrics(v)
    grad_v = grad_error[..., None] * (q @ v[..., None])[..., 0]
    return grad_q, grad_v[..., :3]


def quadric_error_backward(grad_error, q, x):
    """grad_q is not multiplied by grad_error: the chain rule is only in grad_x"""
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    grad_q = plane_quadrics(v)
    grad_v = grad_error[..., None] * ((q + q.swapaxes(-1, -2)) @ v[..., None])[..., 0]
    return grad_q, grad_v[..., :3]


def quadric_error_backward(grad_error, q, x):
    """grad_x is not multiplied by grad_error: the chain rule is only in grad_q"""
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    grad_q = grad_error[..., None, None] * plane_quadrics(v)
    grad_v = ((q + q.swapaxes(-1, -2)) @ v[..., None])[..., 0]
    return grad_q, grad_v[..., :3]


def boundary_planes(vertices, faces):
    """n points into the face instead of away from it: its sign is wrong, as outside is on the right
    of the edge"""
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
    """n is not normalised to length 1: it is as long as the edge"""
    edges, face_edges = mesh.edges(faces)
    lonely = np.bincount(face_edges.ravel(), minlength=len(edges)) == 1
    face, corner = np.nonzero(lonely[face_edges])
    face, corner = np.stack([face, corner])[:, np.argsort(face_edges[face, corner])]
    a, b = vertices[faces[face, corner - 2]], vertices[faces[face, corner - 1]]
    n = np.cross(b - a, mesh.face_normals(vertices, faces)[face])
    return edges[lonely], np.column_stack([n, -(n * a).sum(1)])


def boundary_planes(vertices, faces):
    """d has the wrong sign: n . x + d = 0 gives d = -n . a"""
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
    """t is not clipped to the segment, from 0 to 1"""
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


def best_on_segment(q, a, b):
    """b of the quadric is left out of the slope e.(A x_i + b)"""
    e, A = b - a, q[:, :3, :3]
    along = ((A @ e[..., None])[..., 0] * e).sum(1)
    unique = along > LEAST_CURVATURE * A.trace(axis1=1, axis2=2) * (e * e).sum(1)
    slope = ((A @ a[..., None])[..., 0] * e).sum(1)
    t = np.where(unique, -slope / np.where(unique, along, 1), 0)
    return a + np.clip(t, 0, 1)[:, None] * e, unique


def best_anywhere(q):
    """b has the wrong sign: A x = -b"""
    return np.linalg.solve(q[:, :3, :3], q[:, :3, 3:])[..., 0]


def best_anywhere(q):
    """it solves 2 A x = -b, and x is half as long: the factor 2 of the gradient 2 (A x + b) belongs
    to b as well"""
    return np.linalg.solve(2 * q[:, :3, :3], -q[:, :3, 3:])[..., 0]


def best_anywhere(q):
    """b is multiplied by A; the system A x = -b is to be solved"""
    return -(q[:, :3, :3] @ q[:, :3, 3:])[..., 0]


def best_anywhere(q):
    """the last axis of the solution (N, 3, 1) is left; x is (N, 3)"""
    return np.linalg.solve(q[:, :3, :3], -q[:, :3, 3:])


def pair_costs(vertices, quadrics, pairs):
    """the higher vertex's quadric is left out; a pair has the sum of both"""
    a, b = pairs.T
    q = quadrics[a]
    positions = best_position(q, vertices[a], vertices[b])
    return positions, quadric_error(q, positions)


def pair_costs(vertices, quadrics, pairs):
    """the lower vertex's quadric is left out; a pair has the sum of both"""
    a, b = pairs.T
    q = quadrics[b]
    positions = best_position(q, vertices[a], vertices[b])
    return positions, quadric_error(q, positions)


def pair_costs(vertices, quadrics, pairs):
    """it is the mean of both quadrics instead of their sum: the costs are half as large"""
    a, b = pairs.T
    q = (quadrics[a] + quadrics[b]) / 2
    positions = best_position(q, vertices[a], vertices[b])
    return positions, quadric_error(q, positions)


def pair_costs(vertices, quadrics, pairs):
    """the cost is that of staying at the lower vertex, not of the best position"""
    a, b = pairs.T
    q = quadrics[a] + quadrics[b]
    positions = best_position(q, vertices[a], vertices[b])
    return positions, quadric_error(q, vertices[a])


def pair_costs(vertices, quadrics, pairs):
    """the cost is that at the middle of the pair, not at the best position"""
    a, b = pairs.T
    q = quadrics[a] + quadrics[b]
    positions = best_position(q, vertices[a], vertices[b])
    return positions, quadric_error(q, (vertices[a] + vertices[b]) / 2)


def pair_costs(vertices, quadrics, pairs):
    """costs and positions are returned in the wrong order, exchanged; the positions come first"""
    a, b = pairs.T
    q = quadrics[a] + quadrics[b]
    positions = best_position(q, vertices[a], vertices[b])
    return quadric_error(q, positions), positions


def collapse_faces(faces, a, b):
    """the new vertex is called b instead of a: a is renamed to b"""
    kept = faces[~((faces == a).any(1) & (faces == b).any(1))]
    return np.where(kept == a, b, kept)


def collapse_faces(faces, a, b):
    """faces with both vertices are kept, where they name a twice; they must go"""
    return np.where(faces == b, a, faces)


def collapse_faces(faces, a, b):
    """every face with a or b goes; only those with both must be removed"""
    kept = faces[~((faces == a).any(1) | (faces == b).any(1))]
    return np.where(kept == b, a, kept)


def collapse_faces(faces, a, b):
    """the numbers above b are lowered by one; all other vertices keep their numbers"""
    kept = faces[~((faces == a).any(1) & (faces == b).any(1))]
    kept = np.where(kept == b, a, kept)
    return np.where(kept > b, kept - 1, kept)


def collapse_faces(faces, a, b):
    """b is not renamed to a: faces of b alone still name b"""
    kept = faces[~((faces == a).any(1) & (faces == b).any(1))]
    return kept


def satisfies_link_condition(faces, a, b):
    """shared vertices are counted: two besides the edge's ends, though an edge may have three
    faces"""
    at_a, at_b = (faces == a).any(1), (faces == b).any(1)
    shared = set(faces[at_a].ravel().tolist()) & set(faces[at_b].ravel().tolist())
    return len(shared) == 4


def satisfies_link_condition(faces, a, b):
    """every edge may be collapsed, always True, whatever its ends share"""
    return True


def satisfies_link_condition(faces, a, b):
    """every edge is refused, always False: a and b are left among the third vertices alone, or no
    neighbour is allowed to be shared at all"""
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
    """it goes on where there are just as many faces as asked for, by >= instead of >: one collapse
    too many"""
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
    """the quadrics are not summed: the vertex that stays keeps its own"""
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
    """the vertex that stays does not move: it stays where it was"""
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


def simplify_loop(vertices, faces, quadrics, face_count):
    """it gives up when the cheapest edge is refused; the next cheapest one must be tried"""
    vertices, quadrics = vertices.copy(), quadrics.copy()
    while len(faces) > face_count:
        edges, _ = mesh.edges(faces)
        positions, costs = pair_costs(vertices, quadrics, edges)
        k = np.argmin(costs)
        a, b = edges[k]
        if why_refused(vertices, faces_at(faces, a, b), a, b, positions[k]):
            break
        vertices[a] = positions[k]
        quadrics[a] += quadrics[b]
        faces = collapse_faces(faces, a, b)
    return vertices, faces


def simplify_loop(vertices, faces, quadrics, face_count):
    """the cheapest edge is collapsed without asking why_refused"""
    vertices, quadrics = vertices.copy(), quadrics.copy()
    while len(faces) > face_count:
        edges, _ = mesh.edges(faces)
        positions, costs = pair_costs(vertices, quadrics, edges)
        k = np.argmin(costs)
        a, b = edges[k]
        vertices[a] = positions[k]
        quadrics[a] += quadrics[b]
        faces = collapse_faces(faces, a, b)
    return vertices, faces


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
