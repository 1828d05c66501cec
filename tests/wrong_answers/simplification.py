"""Wrong answers to simplification, written without a look at the checks."""


def plane_quadrics(planes):
    """divides p by the length of n first, although (2) takes p as it is

    told by: normalis | normaliz | unit length | divid & length | unit normal
    """
    length = np.linalg.norm(planes[..., :3], axis=-1, keepdims=True)
    p = planes / length
    return p[..., :, None] * p[..., None, :]


def plane_quadrics(planes):
    """the matrices of all planes are summed: the leading axes are lost

    told by: sum over the planes | all planes | leading | added up | one matrix | summed
    """
    rows = planes.reshape(-1, 4)
    return rows.T @ rows


def plane_quadrics(planes):
    """only the block n n^T is filled: d is left out

    told by: d is left out | last row | last column | without d | d is missing | n n^T | offset
    """
    q = np.zeros(planes.shape[:-1] + (4, 4))
    for i in range(3):
        for j in range(3):
            q[..., i, j] = planes[..., i] * planes[..., j]
    return q


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """+= with a repeated index adds only once: a vertex gets the quadric of one face per corner

    told by: += | add.at | repeated | twice & index | only once | last face | one of its faces | buffered | one face per
    """
    result = np.zeros((vertex_count, 4, 4))
    for corner in range(3):
        result[faces[:, corner]] += face_quadrics
    return result


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """the mean over the faces at a vertex instead of the sum

    told by: mean | average | divided by & number of faces | instead of the sum
    """
    total = scatter(np.stack(3 * [face_quadrics]), faces.T, vertex_count)
    count = np.bincount(faces.ravel(), minlength=vertex_count)
    return total / np.maximum(count, 1)[:, None, None]


def vertex_quadrics(face_quadrics, faces, vertex_count):
    """tile instead of repeat: the quadrics do not belong to the faces of the flattened corners

    told by: tile | repeat | other face | another face | wrong face | mixed up & faces | order & faces
    """
    out = np.zeros((vertex_count, 4, 4))
    np.add.at(out, faces.ravel(), np.tile(face_quadrics, (3, 1, 1)))
    return out


def quadric_error(q, x):
    """the fourth coordinate of v is 0 instead of 1

    told by: fourth & 0 | fourth & zero | homogeneous | (x, 0) | 0 instead of 1 | b and c | only A
    """
    v = np.concatenate([x, np.zeros_like(x[..., :1])], -1)
    return (v * (q @ v[..., None])[..., 0]).sum(-1)


def quadric_error(q, x):
    """the linear term counts once: x.A x + b.x + c without the factor 2 of b.x

    told by: factor 2 | 2 b.x too | linear term | b.x once | b.x twice | half of b | b . x | b counts once
    """
    A, b, c = q[..., :3, :3], q[..., :3, 3], q[..., 3, 3]
    quadratic = ((A @ x[..., None])[..., 0] * x).sum(-1)
    return quadratic + (b * x).sum(-1) + c


def quadric_error(q, x):
    """the 1 comes first in v, (1, x) instead of (x, 1)

    told by: (1, x) | 1 & comes first | 1 & in front | 1 & before | 1 & at the end | 1 & must be last
    """
    one = np.ones_like(x[..., :1])
    v = np.concatenate([one, x], -1)
    return ((q @ v[..., None])[..., 0] * v).sum(-1)


def quadric_error(q, x):
    """the squared length of Q v instead of v . Q v

    told by: length of Q v | norm of Q v | Q v & squared | Q v & square | Q twice | Q^2 | Q^T Q
    """
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    y = (q @ v[..., None])[..., 0]
    return (y * y).sum(-1)


def quadric_error_backward(grad_error, q, x):
    """grad_x is 2 Q v, which takes q for symmetric: the transposed Q is missing

    told by: symmetric | transpos | Q^T | 2 Q v | (Q + Q^T)
    """
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    grad_q = grad_error[..., None, None] * (v[..., :, None] * v[..., None, :])
    grad_v = 2 * grad_error[..., None] * (q @ v[..., None])[..., 0]
    return grad_q, grad_v[..., :3]


def quadric_error_backward(grad_error, q, x):
    """grad_x is not multiplied by grad_error: the chain rule is only in grad_q

    told by: chain | times grad_error | grad_error & grad_x | multiplied by grad_error | ignores grad_error | incoming
    """
    v = np.concatenate([x, np.ones_like(x[..., :1])], -1)
    grad_q = grad_error[..., None, None] * plane_quadrics(v)
    both = q + np.swapaxes(q, -1, -2)
    return grad_q, (both @ v[..., None])[..., :3, 0]


def boundary_planes(vertices, faces):
    """n points into the face instead of away from it

    told by: inside | inward | sign | towards the face | into the face | away from | opposite direction | outward
    """
    edges, face_edges = mesh.edges(faces)
    lonely = np.bincount(face_edges.ravel(), minlength=len(edges)) == 1
    face, corner = np.nonzero(lonely[face_edges])
    order = np.argsort(face_edges[face, corner])
    face, corner = face[order], corner[order]
    a, b = vertices[faces[face, corner - 2]], vertices[faces[face, corner - 1]]
    n = np.cross(mesh.face_normals(vertices, faces)[face], b - a)
    size = np.linalg.norm(n, axis=1, keepdims=True)
    n = n / np.where(size > 0, size, 1)
    return edges[lonely], np.column_stack([n, -(n * a).sum(1)])


def boundary_planes(vertices, faces):
    """n is not normalised: it is as long as the edge

    told by: normalis | normaliz | unit | length 1 | as long as | its length
    """
    edges, face_edges = mesh.edges(faces)
    lonely = np.bincount(face_edges.ravel(), minlength=len(edges)) == 1
    face, corner = np.nonzero(lonely[face_edges])
    order = np.argsort(face_edges[face, corner])
    face, corner = face[order], corner[order]
    a, b = vertices[faces[face, corner - 2]], vertices[faces[face, corner - 1]]
    n = np.cross(b - a, mesh.face_normals(vertices, faces)[face])
    return edges[lonely], np.column_stack([n, -(n * a).sum(1)])


def best_anywhere(q):
    """solves 2 A x = -b: the gradient of b.x was taken without the 2

    told by: 2 A x | half | factor 2 | twice | factor 1/2 | 0.5
    """
    A = q[:, :3, :3]
    b = q[:, :3, 3:]
    return np.linalg.solve(2 * A, -b)[:, :, 0]


def best_anywhere(q):
    """the right-hand sides are (N, 3), which solve takes for one matrix

    told by: (N, 3, 1) | right-hand side | one matrix | shape of b | trailing axis | 3:4
    """
    return np.linalg.solve(q[:, :3, :3], -q[:, :3, 3])


def pair_costs(vertices, quadrics, pairs):
    """returns (costs, positions) in the wrong order

    told by: order | swapped | exchanged | first & second & return | costs & before & positions | costs, positions
    """
    a, b = pairs.T
    q = quadrics[a] + quadrics[b]
    place = best_position(q, vertices[a], vertices[b])
    return quadric_error(q, place), place


def pair_costs(vertices, quadrics, pairs):
    """halves the sum: the mean of the two quadrics instead of their sum

    told by: mean | average | half | halved | 0.5 | 1/2 | divided by 2
    """
    place = np.empty((len(pairs), 3))
    cost = np.empty(len(pairs))
    for n, (a, b) in enumerate(pairs):
        q = ((quadrics[a] + quadrics[b]) / 2)[None]
        place[n] = best_position(q, vertices[a][None], vertices[b][None])[0]
        cost[n] = quadric_error(q[0], place[n])
    return place, cost


def collapse_faces(faces, a, b):
    """keeps the faces with both vertices: they become degenerate, with a twice

    told by: both & kept | both & go | both & still | degenerate | a twice | names & twice | not removed
    """
    return np.where(faces == b, a, faces)


def collapse_faces(faces, a, b):
    """removes every face with a or b instead of those with both

    told by: or instead of and | either | only one of | too many faces | any of | a or b instead | a or b goes
    """
    touched = ((faces == a) | (faces == b)).any(1)
    kept = faces[~touched]
    return np.where(kept == b, a, kept)


def collapse_faces(faces, a, b):
    """the new vertex is called b instead of a

    told by: called b | named b | b instead of a | b stays | exchanged | a & b & swapped | renames a
    """
    both = np.array([a in face and b in face for face in faces.tolist()], bool)
    kept = faces[~both]
    return np.where(kept == a, b, kept)


def collapse_faces(faces, a, b):
    """numbers above b are lowered by one, although vertices keep their numbers

    told by: renumber | lowered | by one | shift | above b | greater than b | keep their numbers | decrement
    """
    kept = faces[~((faces == a).any(1) & (faces == b).any(1))]
    kept = np.where(kept == b, a, kept)
    return np.where(kept > b, kept - 1, kept)


def satisfies_link_condition(faces, a, b):
    """the answer is inverted: True where the pair is refused

    told by: invert | negat | opposite | reverse | other way | True and False | != where
    """
    at_a, at_b = (faces == a).any(1), (faces == b).any(1)
    common = np.intersect1d(faces[at_a], faces[at_b])
    third = np.unique(faces[at_a & at_b])
    return not np.array_equal(common, third)


def satisfies_link_condition(faces, a, b):
    """the union of the neighbours instead of the shared ones

    told by: union | all neighbours | intersection | either of | not shared | instead of & shared
    """
    at_a = (faces == a).any(1)
    at_b = (faces == b).any(1)
    near = set(faces[at_a | at_b].ravel().tolist())
    return near == set(faces[at_a & at_b].ravel().tolist())


def satisfies_link_condition(faces, a, b):
    """a and b are taken from the shared neighbours but not from the faces' vertices, so it is always False

    told by: a and b & one side | themselves | always False | third vertices & a and b | not third | ends of the edge | ends themselves
    """
    at_a = (faces == a).any(1)
    at_b = (faces == b).any(1)
    shared = set(faces[at_a].ravel().tolist()) & set(faces[at_b].ravel().tolist())
    return shared - {a, b} == set(faces[at_a & at_b].ravel().tolist())


def satisfies_link_condition(faces, a, b):
    """only the first face at the edge is looked at, so one of the two third vertices is missing

    told by: first face | one face | only one of the & faces | second face | one third vertex | return & loop | break
    """
    third = None
    for face in faces.tolist():
        if a in face and b in face:
            third = {v for v in face if v not in (a, b)}
            break
    near = []
    for end in (a, b):
        ring = {v for face in faces.tolist() if end in face for v in face}
        near.append(ring - {a, b})
    return near[0] & near[1] == third


def flips(before, after):
    """only the turn is tested: a normal that becomes uncertain is let through

    told by: uncertain | shape | thin | LEAST_SHAPE | needle | sliver
    """
    for old, new in zip(before, after):
        m = np.cross(old[1] - old[0], old[2] - old[0])
        n = np.cross(new[1] - new[0], new[2] - new[0])
        if m @ n < LEAST_COSINE * np.linalg.norm(m) * np.linalg.norm(n):
            return True
    return False


def simplify_loop(vertices, faces, quadrics, face_count):
    """gives up when the cheapest edge is refused instead of trying the next one

    told by: next cheapest | next edge | gives up | stops & refused | first refus | stops too early | only the cheapest | second cheapest
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
        quadrics[a] += quadrics[b]
        faces = collapse_faces(faces, a, b)
    return vertices, faces


def simplify_loop(vertices, faces, quadrics, face_count):
    """the quadrics are not added: a keeps its own

    told by: quadric & not added | quadric & sum | Q_i + Q_j | keeps its own | quadric & never | quadric & old | quadric & forg | quadric & unchanged
    """
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
    """the edges and costs are computed once, before the loop, and never again

    told by: once | out of date | stale | never again | recomput | anew | before the loop | after each collapse
    """
    vertices, quadrics = vertices.copy(), quadrics.copy()
    edges, _ = mesh.edges(faces)
    positions, costs = pair_costs(vertices, quadrics, edges)
    for k in np.argsort(costs, kind="stable"):
        if len(faces) <= face_count:
            break
        a, b = edges[k]
        near = faces_at(faces, a, b)
        together = (near == a).any(1) & (near == b).any(1)
        if not together.any() or why_refused(vertices, near, a, b, positions[k]):
            continue
        vertices[a] = positions[k]
        quadrics[a] += quadrics[b]
        faces = collapse_faces(faces, a, b)
    return vertices, faces


def simplify_loop(vertices, faces, quadrics, face_count):
    """collapses the cheapest edge without asking why_refused

    told by: why_refused | without asking | not asked | never asked | refused & collapsed | unchecked | not check | link condition
    """
    vertices, quadrics = vertices.copy(), quadrics.copy()
    while len(faces) > face_count:
        edges, _ = mesh.edges(faces)
        positions, costs = pair_costs(vertices, quadrics, edges)
        k = np.argmin(costs)
        a, b = edges[k]
        vertices[a] = positions[k]
        quadrics[a] = quadrics[a] + quadrics[b]
        faces = collapse_faces(faces, a, b)
    return vertices, faces


def simplify_loop(vertices, faces, quadrics, face_count):
    """>= instead of >: one collapse too many when face_count is already reached

    told by: >= | too many | one more | one too | already | too far | fewer than
    """
    vertices, quadrics = vertices.copy(), quadrics.copy()
    while len(faces) >= face_count:
        edges, _ = mesh.edges(faces)
        positions, costs = pair_costs(vertices, quadrics, edges)
        done = True
        for k in np.argsort(costs, kind="stable"):
            a, b = edges[k]
            if why_refused(vertices, faces_at(faces, a, b), a, b, positions[k]) == 0:
                done = False
                break
        if done:
            break
        vertices[a] = positions[k]
        quadrics[a] += quadrics[b]
        faces = collapse_faces(faces, a, b)
    return vertices, faces


def simplify_loop(vertices, faces, quadrics, face_count):
    """the vertex a stays where it was: it is not moved to the position of the pair

    told by: stays where | not moved | never moved | positions[k] | old place | its place | keeps its place | does not move
    """
    vertices, quadrics = vertices.copy(), quadrics.copy()
    while len(faces) > face_count:
        edges, _ = mesh.edges(faces)
        positions, costs = pair_costs(vertices, quadrics, edges)
        for k in costs.argsort(kind="stable"):
            a, b = edges[k]
            if not why_refused(vertices, faces_at(faces, a, b), a, b, positions[k]):
                quadrics[a] += quadrics[b]
                faces = collapse_faces(faces, a, b)
                break
        else:
            break
    return vertices, faces
