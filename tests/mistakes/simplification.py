"""Mistakes of lab 12: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
NO_AREA = "a face without area divides 0 by 0; it has no plane"
OUTER = "planes[..., :, None] * planes[..., None, :]"
ADDED_UP = "np.add.at(total, corner, face_quadrics)"
CURVED = "spread[:, 0] > LEAST_CURVATURE * spread[:, 2]"
SORTED_PAIRS = "np.sort(np.where(pairs == b[k], a[k], pairs), axis=1)"
TWINS = "len({frozenset(face) for face in faces.tolist()}) < len(faces)"
ON_SEGMENT = "np.where(unique[:, None], on_segment, best_of_three(*rest))"
SHARED = "return shared == set(faces[at_a & at_b].ravel().tolist())"
SUM_OF_BOTH = "a vertex keeps its own quadric; it gets the sum of both"

MISTAKES = {
    "12.1": [
        ("-(n * vertices", "(n * vertices", "d has the wrong sign: n . x + d = 0"),
        ("n = mesh.face_normals(vertices, faces)", "n = -mesh.face_normals(vertices, faces)",
         "normals point to the side that sees the face clockwise"),
        ("mesh.face_normals(vertices, faces)", "np.cross(vertices[faces[:, 1]] - "
         "vertices[faces[:, 0]], vertices[faces[:, 2]] - vertices[faces[:, 0]])",
         "n is not brought to length 1"),
        ("vertices[faces[:, 0]]", "vertices[np.arange(len(faces)) % len(vertices)]",
         "d is measured from vertex f of the mesh, instead of a corner of face f"),
        ("-(n * vertices[faces[:, 0]]).sum(1)", "-np.linalg.norm(n * vertices[faces[:, 0]], "
         "axis=1)", "the length of the products is taken instead of their sum"),
    ],
    "12.2": [
        (OUTER, "np.eye(4) * planes[..., None, :]**2", "only the squares on the diagonal are "
         "filled in"),
        (OUTER, "planes[..., :, None] + planes[..., None, :]", "numbers are added; a quadric has "
         "their products"),
        (OUTER, f"({OUTER}) * [1, 1, 1, 0]", "d is left out of the last column"),
        (OUTER, f"2 * {OUTER}", "it is twice p p^T"),
        (OUTER, f"np.triu({OUTER})", "only the upper half of the matrix is filled in"),
    ],
    "12.3": [
        (ADDED_UP, "total[corner] += face_quadrics", "of the faces that share a corner's number "
         "only the last one counts: += with an array does not add up"),
        (ADDED_UP, "np.add.at(total, corner, face_quadrics / 3)",
         "each face is shared out in thirds; each corner gets all of it"),
        ("for corner in faces.T", "for corner in faces.T[:2]", "the third corner is left out"),
        ("    return total\n", "    count = np.bincount(faces.ravel(), minlength=vertex_count)\n"
         "    return total / np.maximum(count, 1)[:, None, None]\n",
         "it is the mean over the faces instead of the sum"),
    ],
    "12.4": [
        ("np.ones_like", "np.zeros_like", "a 0 is appended: that is a direction; a point has a 1"),
        ("((q @ v[..., None])[..., 0] * v).sum(-1)",
         "np.sqrt(np.maximum(((q @ v[..., None])[..., 0] * v).sum(-1), 0))",
         "it is the distance; the error is its square"),
        ("[..., 0] * v).sum(-1)", "[..., 0] * v).mean(-1)", "it is the mean of four products "
         "instead of their sum"),
        ("((q @ v[..., None])[..., 0] * v).sum(-1)", "((q @ v[..., None])[..., 0]**2).sum(-1)",
         "it is |Q v|^2; eq. (2) is v^T Q v"),
        ("(q @ v[..., None])[..., 0] * v)", "q.diagonal(axis1=-2, axis2=-1) * v**2)",
         "only the diagonal of q counts"),
    ],
    "12.5": [
        ("(q + q.swapaxes(-1, -2))", "(2 * q)", "q is taken to be symmetric: 2 Q v"),
        ("(q + q.swapaxes(-1, -2))", "q", "v counts on one side of Q alone; it is on both"),
        ("grad_error[..., None, None] * plane_quadrics(v)", "plane_quadrics(v)",
         "grad_error is left out of the gradient by q"),
        ("grad_error[..., None] * ((q", "((q", "grad_error is left out of the gradient by x"),
        ("grad_v[..., :3]", "grad_v", "the 1 after x, y, z has a gradient, too; it is fixed"),
        ("plane_quadrics(v)\n", "plane_quadrics(v) * (2 - np.eye(4))\n",
         "q is taken to be symmetric: its 16 numbers are free"),
    ],
    "12.6": [
        ("np.cross(b - a, mesh.face_normals(vertices, faces)[face])",
         "np.cross(mesh.face_normals(vertices, faces)[face], b - a)",
         "n points into the face; outside is on the right of the edge"),
        ("np.cross(b - a, mesh.face_normals(vertices, faces)[face])",
         "mesh.face_normals(vertices, faces)[face]", "it is the face's own plane; the one asked "
         "for is perpendicular to it"),
        ("    n /= np.where(length > 0, length, 1)\n", "", "n is not brought to length 1"),
        ("-(n * a).sum(1)", "(n * a).sum(1)", "d has the wrong sign: n . x + d = 0"),
        ("[:, np.argsort(face_edges[face, corner])]", "",
         "planes are in the order of the faces; they go with the edges"),
        ("== 1\n", ">= 1\n", "edges inside have planes, too; a boundary edge has one face"),
        ("faces[face, corner - 2]], vertices[faces[face, corner - 1]]",
         "faces[face, corner]], vertices[faces[face, corner - 2]]",
         "edge k is taken to begin at corner k; it is the one opposite to it"),
    ],
    "12.7": [
        ("near[distance < t]", "near[distance <= t]", "pairs at just the distance t count; it "
         "must be less"),
        ("used = np.unique(faces)", "used = np.arange(len(vertices))",
         "vertices of no face are paired"),
        ("np.concatenate([mesh.edges(faces)[0], near[distance < t]])", "near[distance < t]",
         "edges are left out; all of them are pairs, however long"),
        ("np.concatenate([mesh.edges(faces)[0], near[distance < t]])", "mesh.edges(faces)[0]",
         "only edges are pairs"),
        ("return np.unique(np.concatenate([mesh.edges(faces)[0], near[distance < t]]), axis=0)",
         "return np.concatenate([mesh.edges(faces)[0], near[distance < t]])",
         "pairs do not ascend, and an edge that is short comes twice"),
        ("used[cKDTree", "(used - used + np.arange(len(used)))[cKDTree",
         "near vertices are numbered among those of faces, not among all"),
    ],
    "12.8": [
        ("-slope /", "slope /", "t has the wrong sign"),
        ("[..., 0] + offset)", "[..., 0])", "b of the quadric is left out"),
        ("np.clip(t, 0, 1)", "t", "t is not kept on the segment"),
        ("np.where(unique, -slope / np.where(unique, along, 1), 0)",
         "np.where(unique, -slope / np.where(unique, along, 1), 0.5)",
         "where no place is best, the middle is taken; it is a"),
        ("LEAST_CURVATURE * A.trace(axis1=1, axis2=2) * (e * e).sum(1)", "LEAST_CURVATURE",
         "e.A e is compared with LEAST_CURVATURE as it is: the scale decides"),
        ("LEAST_CURVATURE * A.trace(axis1=1, axis2=2) * (e * e).sum(1)", "0",
         "only e.A e = 0 counts as flat"),
        ("-slope / np.where", "-slope / 2 / np.where", "the factor 2 of the gradient is taken into "
         "account on one side alone"),
        ("(A @ a[..., None])", "(A @ b[..., None])", "the slope is that at b; t is counted from a"),
    ],
    "12.9": [
        ("np.argmin", "np.argmax", "the worst of the three is taken"),
        ("[a, b, (a + b) / 2]", "[a, b, a]", "the middle is left out"),
        ("[a, b, (a + b) / 2]", "[(a + b) / 2, a, b]", "of equal errors the middle counts first; "
         "the order is a, b, middle"),
        ("[a, b, (a + b) / 2]", "[b, a, (a + b) / 2]", "of equal errors b counts before a"),
        ("quadric_error(q[None], three)", "np.abs(quadric_error(q[None], three))",
         "the error lost its sign"),
    ],
    "12.10": [
        ("-q[curved, :3, 3:])", "q[curved, :3, 3:])", "b has the wrong sign: A x = -b"),
        (CURVED, "np.zeros(len(q), bool)", "eq. (5) is left out: the place stays on the segment"),
        (CURVED, "spread[:, 0] > LEAST_CURVATURE", "the least eigenvalue is compared with "
         "LEAST_CURVATURE as it is: the scale decides"),
        (CURVED, "spread.prod(1) > LEAST_CURVATURE * spread[:, 2]**3",
         "the determinant decides instead of the least eigenvalue"),
        (CURVED, "spread[:, 0] > LEAST_CURVATURE * spread[:, 1]",
         "the least eigenvalue is compared with the middle one; it is the greatest"),
        (ON_SEGMENT, "on_segment", "where eq. (6) is not unique, a is taken; it is eq. (7)"),
        (ON_SEGMENT, "best_of_three(*rest)", "eq. (6) is left out"),
    ],
    "12.11": [
        ("np.where(kept == b, a, kept)", "np.where(kept == a, b, kept)",
         "a is renamed to b; the vertex that stays is a"),
        ("faces[~((faces == a).any(1) & (faces == b).any(1))]", "faces",
         "faces with both vertices stay"),
        ("(faces == a).any(1) & (faces == b).any(1)", "(faces == a).any(1) | (faces == b).any(1)",
         "faces with one of the vertices go; only those with both do"),
        ("np.where(kept == b, a, kept)", "np.where(kept == b, a, kept - (kept > b))",
         "the vertices above b are renumbered; the numbers stay"),
        ("return np.where(kept == b, a, kept)", "kept = np.where(kept == b, a, kept)\n"
         "    return kept[np.lexsort(kept.T[::-1])]", "faces are sorted; their order stays"),
    ],
    "12.12": [
        (SHARED, "return len(shared) == 4", "shared vertices are counted: two besides the edge's "
         "ends, though an edge may have three faces"),
        (SHARED, "return True", "every edge may be collapsed, whatever its ends share"),
        (SHARED, SHARED.replace("&", "|"), "the vertices of all faces at a or b are taken; the "
         "thirds are those of faces with both"),
        (SHARED, "return shared != set(faces[at_a & at_b].ravel().tolist())",
         "yes and no are swapped"),
        (SHARED, "return shared - {a, b} == set()", "no neighbour may be shared at all; the "
         "thirds of the edge's faces must be"),
    ],
    "12.13": [
        (TWINS, "len({tuple(face) for face in faces.tolist()}) < len(faces)",
         "the order of the vertices counts: a face that begins elsewhere is another one"),
        (TWINS, "len({sum(face) for face in faces.tolist()}) < len(faces)",
         "faces of equal sums are taken for twins"),
        (TWINS, "len({min((a, b, c), (b, c, a), (c, a, b)) for a, b, c in faces.tolist()}) "
         "< len(faces)", "a twin that is wound the other way is not found"),
        (TWINS, "len({frozenset(face) for face in faces.tolist()}) == len(faces)",
         "yes and no are swapped"),
        (TWINS, "len({(min(face), max(face)) for face in faces.tolist()}) < len(faces)",
         "the least and the greatest vertex decide; the third counts, too"),
    ],
    "12.14": [
        ("<= 0)", "< 0)", "a right angle does not flip; it does"),
        ("[n.any(1)].any()", "[n.any(1)].all()", "all triangles must flip; one is enough"),
        ("[n.any(1)]", "", "a triangle that had no area flips; it never does"),
        ("<= 0)", "> 0)", "yes and no are swapped"),
        ("<= 0)", "<= 1e-9)", "small triangles flip whatever they do: n . n' is compared with a "
         "number that has a unit"),
        ("both[:, :, 1] - both[:, :, 0], both[:, :, 2] - both[:, :, 0]",
         "both[:, :, 1], both[:, :, 2]", "sides are measured from the origin, not from a corner"),
        ("((n * n1).sum(1) <= 0)", "(n * n1 <= 0).all(1)",
         "each of x, y, z is asked by itself; their sum decides"),
    ],
    "12.15": [
        ("len(faces) > face_count", "len(faces) >= face_count", "it goes on where there are just "
         "as many faces as asked for"),
        ("positions[k], q[k]", "positions[k], quadrics[a[k]]", SUM_OF_BOTH),
        ("vertices[a[k]], quadrics[a[k]] = positions[k], q[k]", "quadrics[a[k]] = q[k]",
         "the vertex that stays does not move"),
        ("if not why_refused(vertices, near, a[k], b[k], positions[k])", "if True",
         "nothing is refused"),
        ("            if not why_refused(vertices, near, a[k], b[k], positions[k]):\n"
         "                break\n        else:\n            return vertices, faces\n",
         "            if why_refused(vertices, near, a[k], b[k], positions[k]):\n"
         "                return vertices, faces\n            break\n",
         "it ends when the cheapest pair is refused; the next one has its turn"),
        (SORTED_PAIRS, "pairs[(pairs != b[k]).all(1)]",
         "the pairs of the vertex that goes are lost; they are those of the other one now"),
        ("faces = collapse_faces(faces, a[k], b[k])", "faces = collapse_faces(faces, b[k], a[k])",
         "the higher number stays; the lower vertex takes the higher one's place"),
        ("kind=\"stable\")", "kind=\"stable\")[::-1]", "the dearest pair is taken"),
        ("np.unique(pairs[pairs[:, 0] < pairs[:, 1]], axis=0)", "pairs[pairs[:, 0] < pairs[:, 1]]",
         "pairs do not ascend any more: of equal costs another one is taken"),
    ],
    "12.16": [
        ("position, quadrics[a] + quadrics[b]", "position, quadrics[a]", SUM_OF_BOTH),
        ("count > face_count", "count >= face_count", "it goes on where there are just as many "
         "faces as asked for"),
        ("            put_back(heap, waiting, set(around.ravel().tolist()))\n", "",
         "what was refused once never comes back"),
        ("put_back(heap, waiting, set(around.ravel().tolist()))", "put_back(heap, waiting, {a, b})",
         "only what waits at a or b comes back; at their neighbours, too, something has changed"),
        ("set(around.ravel().tolist())", "list(waiting)",
         "all that waits comes back, however far away"),
        ("refused[reason - 1] += 1", "refused[reason % 3] += 1", "the reasons are counted one too "
         "far: why_refused begins with 1"),
        ("if row and len(vertices) not in row", "if row", "the faces to outside are returned, "
         "too"),
        ("count -= merge(rows, rows_at, a, b)",
         "merge(rows, rows_at, a, b)\n            count -= 2",
         "every collapse is taken to cost two faces; at the boundary it is one"),
        ("close_boundary(faces, len(vertices))", "faces", "the boundary is not closed: it may be "
         "torn or sewn up"),
        ("vertices[a], quadrics[a] = position,", "_, quadrics[a] = position,",
         "the vertex that stays does not move"),
        ("reason = why_refused(vertices, around, a, b, np.array(position))", "reason = 0",
         "nothing is refused"),
    ],
}
