"""Simplification: fewer faces for nearly the same surface, by collapsing pairs of vertices.

    p = (n, d),  n . x + d = 0,  |n| = 1              the plane of a face                    (1)
    v^T Q v = (p . v)^2,  Q = p p^T,  v = (x, 1)      the squared distance of x to it        (2)
    Q_i = sum of Q over the faces at vertex i         its quadric                            (3)
    cost of a pair = v^T Q v,  Q = Q_i + Q_j          v: where the two become one            (4)

Q in blocks is [A  b; b^T  c], with A (3, 3). The best place for v is the first of these there is:

    A x = -b                                          where the gradient 2 (A x + b) is 0    (5)
    x = x_i + t e,  t = -e.(A x_i + b) / e.A e        on the segment, e = x_j - x_i          (6)
    x_i, x_j or (x_i + x_j) / 2                       whichever costs least                  (7)

A heap gives the cheapest pair; the two become one vertex, whose quadric is Q_i + Q_j; and again.
A pair is refused if its collapse would break the surface. For a closed surface around edge i j:

    the neighbours that i and j share  =  the third vertices of the faces at i j             (8)

An open surface is closed first: each boundary edge gets a face to one more vertex, `outside`.

Sources: lecture "Geometry, advanced"; Garland and Heckbert 1997 (1)-(7); Dey et al. 1999, the link
condition (8). The caller guarantees faces of three different vertices.
"""
import heapq
import numbers
import warnings

import numpy as np
from scipy.spatial import cKDTree

from course.given import inputs, mesh

LEAST_CURVATURE = 1e-3  # of the greatest eigenvalue of A: less is rounding, or nearly flat
BOUNDARY_WEIGHT = 100   # of a plane through a boundary edge; that of a face has 1
REASONS = "the link condition", "a repeated face", "a flipped face"


def face_planes(vertices, faces):  # exercise 12.1 (2 points)
    """Eq. (1): vertices (V, 3), faces (F, 3) -> p (F, 4), the rows (n, d).

    n points to the side that sees the face counter-clockwise. A face without area, also one that is
    flat up to rounding, has p = 0: take n from `mesh.face_normals`, which decides that.

    >>> face_planes(np.array([[0.0, 0.0, 2.0], [3.0, 0.0, 2.0], [0.0, 1.0, 2.0]]),
    ...             np.array([[0, 1, 2]]))
    array([[ 0.,  0.,  1., -2.]])
    """
    raise NotImplementedError("exercise 12.1: face_planes")


def plane_quadrics(planes):  # exercise 12.2 (1 point)
    """Eq. (2): planes (..., 4) -> Q (..., 4, 4).

    >>> plane_quadrics(np.array([1.0, 2.0, 0.0, 3.0]))[:2]
    array([[1., 2., 0., 3.],
           [2., 4., 0., 6.]])
    """
    raise NotImplementedError("exercise 12.2: plane_quadrics")


def vertex_quadrics(face_quadrics, faces, vertex_count):  # exercise 12.3 (2 points)
    """Eq. (3): face_quadrics (F, 4, 4), faces (F, 3) -> Q (V, 4, 4), V = vertex_count.

    A vertex of no face has Q = 0.

    >>> q = vertex_quadrics(np.ones((2, 4, 4)), np.array([[0, 1, 2], [1, 2, 4]]), 5)
    >>> q[:, 0, 0]
    array([1., 2., 2., 0., 1.])
    """
    raise NotImplementedError("exercise 12.3: vertex_quadrics")


def quadric_error(q, x):  # exercise 12.4 (1 point)
    """Eq. (2): the error of points under quadrics: q (..., 4, 4), x (..., 3) -> (...).

    Leading shapes broadcast; q need not be symmetric.

    >>> quadric_error(plane_quadrics(np.array([0.0, 0.0, 1.0, -2.0])), np.array([7.0, 8.0, 5.0]))
    np.float64(9.0)
    """
    raise NotImplementedError("exercise 12.4: quadric_error")


def quadric_error_backward(grad_error, q, x):  # exercise 12.5 (2 points)
    """Backward of `quadric_error`: grad_error (...) -> grad_q (..., 4, 4), grad_x (..., 3).

    q (..., 4, 4) and x (..., 3) with the same leading shape. The 16 numbers of q are free: q need
    not be symmetric.

    >>> q = np.diag([3.0, 1.0, 1.0, 0.0])
    >>> q[0, 3] = 5.0
    >>> grad_q, grad_x = quadric_error_backward(np.array(1.0), q, np.array([2.0, 0.0, 1.0]))
    >>> grad_q[0], grad_x
    (array([4., 0., 2., 2.]), array([17.,  0.,  2.]))
    """
    raise NotImplementedError("exercise 12.5: quadric_error_backward")


def boundary_planes(vertices, faces):  # exercise 12.6 (3 points)
    """The planes that hold the boundary: edges (B, 2), p (B, 4).

    A boundary edge has one face. Its plane contains the edge and is perpendicular to that face; n
    of eq. (1) points away from the face. Edges as in `mesh.boundary_edges`, in its order. An edge
    of a face without area has p = 0.

    >>> square = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    >>> edges, p = boundary_planes(square, np.array([[0, 1, 2]]))
    >>> edges[:2].tolist(), (p[:2] + 0.0).tolist()
    ([[0, 1], [0, 2]], [[0.0, -1.0, 0.0, 0.0], [-1.0, 0.0, 0.0, 0.0]])
    """
    raise NotImplementedError("exercise 12.6: boundary_planes")


def valid_pairs(vertices, faces, t):  # exercise 12.7 (2 points)
    """The pairs that may become one vertex: (N, 2), low < high, ascending, each once.

    These are the edges, and all pairs of vertices of faces whose distance is less than t >= 0, an
    edge between them or not. With t = 0, only edges.

    >>> x = np.array([0.0, 2.0, 4.0, 2.1, 4.2, 2.2])
    >>> valid_pairs(np.stack([x, x > 4, 0 * x], 1), np.array([[0, 1, 2], [5, 4, 3]]), 0.15).tolist()
    [[0, 1], [0, 2], [1, 2], [1, 3], [3, 4], [3, 5], [4, 5]]
    """
    raise NotImplementedError("exercise 12.7: valid_pairs")


def best_on_segment(q, a, b):  # exercise 12.8 (3 points)
    """Eq. (6): the best place x (N, 3) on the segments from a to b, and whether it is unique (N,).

    q (N, 4, 4) symmetric, a, b (N, 3). t is clipped to the segment, from 0 to 1. Where e.A e is not
    greater than LEAST_CURVATURE trace(A) e.e, the error hardly changes along the segment: not
    unique, x = a.

    >>> q = plane_quadrics(np.array([[1.0, 0.0, 0.0, -2.0]]))
    >>> best_on_segment(q, np.array([[0.0, 0.0, 0.0]]), np.array([[8.0, 4.0, 0.0]]))
    (array([[2., 1., 0.]]), array([ True]))
    """
    raise NotImplementedError("exercise 12.8: best_on_segment")


def best_of_three(q, a, b):  # exercise 12.9 (2 points)
    """Eq. (7): a, b or the middle of the two, whichever has the least error: (N, 3).

    q (N, 4, 4), a, b (N, 3). Of equal errors, the first in this order counts.

    >>> q = plane_quadrics(np.array([[1.0, 0.0, 0.0, -2.0]]))
    >>> best_of_three(q, np.array([[0.0, 0.0, 0.0]]), np.array([[6.0, 4.0, 0.0]]))
    array([[3., 2., 0.]])
    """
    raise NotImplementedError("exercise 12.9: best_of_three")


def best_position(q, a, b):  # exercise 12.10 (3 points)
    """Where to put the vertex that a pair becomes: (N, 3).

    q (N, 4, 4), the sum of the pair's quadrics, symmetric; a, b (N, 3), its two vertices. Eq. (5)
    counts where the least eigenvalue of A is greater than LEAST_CURVATURE times its greatest one;
    else eq. (6) where that is unique; else eq. (7).

    >>> corner = plane_quadrics(np.array([[1.0, 0, 0, -1], [0, 1, 0, -2], [0, 0, 1, -3]])).sum(0)
    >>> best_position(corner[None], np.array([[0.0, 0.0, 0.0]]), np.array([[1.0, 0.0, 0.0]]))
    array([[1., 2., 3.]])
    """
    raise NotImplementedError("exercise 12.10: best_position")


def close_boundary(faces, outside):
    """The faces, and after them one more for each boundary edge: from the edge to `outside`."""
    edges = mesh.boundary_edges(faces)
    return np.concatenate([faces, np.column_stack([edges, np.full(len(edges), outside)])])


def collapse_faces(faces, a, b):  # exercise 12.11 (2 points)
    """What becomes of faces (N, 3) when the vertices a and b become one, called a -> (M, 3).

    Faces with both of them go. In the others, b is renamed; their order stays.

    >>> collapse_faces(np.array([[0, 1, 2], [2, 1, 3], [4, 2, 3]]), 1, 2)
    array([[4, 1, 3]])
    """
    raise NotImplementedError("exercise 12.11: collapse_faces")


def satisfies_link_condition(faces, a, b):  # exercise 12.12 (3 points)
    """Eq. (8) -> bool: may the edge between the vertices a and b be collapsed?

    faces (N, 3): all faces at a or at b, and perhaps others. One or more of them have both. A
    neighbour of a vertex is another vertex of one of its faces. Below, a ring of three edges,
    1 2 3, lies around a double pyramid. To collapse one of them would pinch it.

    >>> faces = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [4, 2, 1], [4, 3, 2], [4, 1, 3]])
    >>> satisfies_link_condition(faces, 0, 1), satisfies_link_condition(faces, 1, 2)
    (True, False)
    """
    raise NotImplementedError("exercise 12.12: satisfies_link_condition")


def has_twins(faces):  # exercise 12.13 (1 point)
    """Do two of the faces (N, 3) have the same three vertices, in any order? -> bool

    >>> has_twins(np.array([[0, 1, 2], [1, 2, 3], [2, 1, 0]]))
    True
    """
    raise NotImplementedError("exercise 12.13: has_twins")


def flips(before, after):  # exercise 12.14 (2 points)
    """Does one of the triangles turn by 90 degrees or more, or lose its area? -> bool

    before, after (N, 3, 3): the corners of N triangles. The two normals' product n . n' tells: not
    greater than 0, it flips. One that had no area before (n = 0 exactly) never does; one that is
    flat only up to rounding may, by chance.

    >>> before = np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
    >>> flips(before, before + 1), flips(before, before[:, [1, 0, 2]])
    (False, True)
    """
    raise NotImplementedError("exercise 12.14: flips")


def why_refused(vertices, faces, a, b, position):
    """May the pair a, b become one vertex at position (3,)?

    -> 0 for yes, else 1, 2 or 3 for the first of REASONS against it. faces (N, 3): all at a or b of
    the closed surface, whose `outside` is len(vertices). A pair that is no edge joins two sheets:
    what eq. (8) forbids is its very purpose.
    """
    kept = collapse_faces(faces, a, b)
    real = (kept < len(vertices)).all(1)
    is_edge = len(kept) < len(faces)
    if is_edge and not satisfies_link_condition(faces, a, b):
        return 1
    if has_twins(kept if is_edge else kept[real]):
        return 2
    stay = ~((faces == a).any(1) & (faces == b).any(1))
    before, kept = vertices[faces[stay][real]], kept[real]
    after = np.where(((kept == a) | (kept == b))[..., None], position, vertices[kept])
    return 3 if flips(before, after) else 0


def simplify_loop(vertices, faces, quadrics, pairs, face_count):  # exercise 12.15 (4 points)
    """The greedy algorithm without a heap: all pairs anew for every collapse. Slow and obvious.

    vertices (V, 3), faces (F, 3) without boundary, quadrics (V, 4, 4), pairs (N, 2) as those of
    `valid_pairs` -> vertices (V, 3), faces (F', 3).

    While there are more than face_count faces: of all pairs that are not refused (`why_refused` at
    their `best_position` is 0), take the one of the least cost, eq. (4), the first of equal ones.
    Its lower vertex moves to this position, gets the sum of both quadrics, and takes the higher
    one's place in faces (`collapse_faces`) and pairs, which ascend as before, none with itself,
    none twice. If all are refused, end. The higher vertex stays in vertices, unused.

    >>> vertices, faces = mesh.icosphere(20)
    >>> q = vertex_quadrics(plane_quadrics(face_planes(vertices, faces)), faces, 12)
    >>> pairs = valid_pairs(vertices, faces, 0.0)
    >>> [len(simplify_loop(vertices, faces, q, pairs, n)[1]) for n in (20, 13, 0)]
    [20, 12, 4]
    """
    raise NotImplementedError("exercise 12.15: simplify_loop")


def incidence(faces, vertex_count):
    """faces (F, 3) as lists, and for each vertex the set of its faces' numbers."""
    faces_at = [set() for _ in range(vertex_count)]
    for f, face in enumerate(faces.tolist()):
        for vertex in face:
            faces_at[vertex].add(f)
    return faces.tolist(), faces_at


def merge(faces, faces_at, a, b):
    """`collapse_faces` in lists of `incidence` -> how many faces went, those to outside left out.

    What goes is []. Two faces to outside that have become twins go, too: there, two boundaries have
    been sewn together.
    """
    outside = len(faces_at) - 1
    gone = faces_at[a] & faces_at[b]
    count = sum(outside not in faces[f] for f in gone)
    for f in faces_at[b]:
        faces[f] = [a if vertex == b else vertex for vertex in faces[f]]
    faces_at[a], faces_at[b] = faces_at[a] | faces_at[b], set()
    seams = [f for f in faces_at[a] - gone if outside in faces[f]]
    sides = [set(faces[f]) for f in seams]
    gone |= {f for f, side in zip(seams, sides, strict=True) if sides.count(side) == 2}
    for f in gone:
        for vertex in faces[f]:
            faces_at[vertex].discard(f)
        faces[f] = []
    return count


def entries(vertices, quadrics, pairs, age):
    """What the heap holds of pairs (N, 2): cost, a, b, the pair's age when asked, position."""
    a, b = pairs.T
    q = quadrics[a] + quadrics[b]
    positions = best_position(q, vertices[a], vertices[b])
    costs = quadric_error(q, positions).tolist()
    ages = (age[a] + age[b]).tolist()
    return list(zip(costs, a.tolist(), b.tolist(), ages, positions.tolist(), strict=True))


def root(became, vertex):
    """What a vertex has become in all collapses so far, by a chain that is cut short on the way."""
    while became[vertex] != vertex:
        became[vertex] = vertex = became[became[vertex]]
    return vertex


def out_of_date(heap, became, age, known):
    """Take what is out of date from the top of the heap -> the pairs (N, 2) to ask again.

    An entry is out of date if a vertex of it has merged since it was made. What its two vertices
    became stands for them; known holds the pairs, with their ages, that were asked before.
    """
    pairs = []
    while heap:
        _, a, b, then, _ = heap[0]
        a, b = sorted((root(became, a), root(became, b)))
        now = int(age[a] + age[b])
        if then == now:
            break
        heapq.heappop(heap)
        if a != b and (a, b, now) not in known:
            known.add((a, b, now))
            pairs.append((a, b))
    return np.array(pairs, int).reshape(-1, 2)


def has_cheapest(heap, vertices, quadrics, became, age, known):
    """Lazy update: ask pairs anew until the top of the heap is up to date -> bool, is there one?"""
    while len(pairs := out_of_date(heap, became, age, known)):
        for entry in entries(vertices, quadrics, pairs, age):
            heapq.heappush(heap, entry)
    return len(heap) > 0


def put_back(heap, waiting, around):
    """Refused entries that wait for a change at one of the vertices around go back to the heap."""
    for vertex in around:
        for entry in waiting.pop(vertex, ()):
            for other in {entry[1], entry[2]} & waiting.keys():
                waiting[other].remove(entry)
            heapq.heappush(heap, entry)


def simplify_heap(vertices, faces, quadrics, pairs, face_count):  # exercise 12.16 (6 points)
    """`simplify_loop` by a heap with lazy updates; the faces may have a boundary.

    -> vertices (V, 3), faces (F', 3) in their order, refused (3,): how often, for each of REASONS.

    Ask all pairs once (`entries`), and make a heap of them. While there are more than face_count
    faces, take the cheapest entry that is up to date (`has_cheapest`); if there is none, end.
    If `why_refused` refuses it, count that, each time, and let it wait at both of its vertices.
    Else it is collapsed as in `simplify_loop` (`merge`), the age of the vertex that stays becomes 1
    more than the pair's, and all that waits at a, b or a neighbour of either (before the merge)
    goes back to the heap (`put_back`). Faces to `outside` (`close_boundary`, which has the number
    V) take part, but count neither in face_count nor in the result. What the given functions need,
    and change:

    rows, rows_at   `incidence` of the closed faces, with V + 1 vertices
    became          a list: for each vertex what it has become, at first itself
    age             an array of integers, one for each vertex, at first 0
    waiting         a dict, at first empty: vertex -> a list of entries
    known           a set, at first empty

    >>> vertices, faces = mesh.grid(32)
    >>> q, pairs = mesh_quadrics(vertices, faces), valid_pairs(vertices, faces, 0.0)
    >>> vertices, faces, refused = simplify_heap(vertices, faces, q, pairs, 2)
    >>> vertices[np.unique(faces)].round(9).astype(int).tolist()
    [[0, 0, 0], [4, 0, 0], [0, 4, 0], [4, 4, 0]]
    """
    raise NotImplementedError("exercise 12.16: simplify_heap")


def plain_faces(faces):
    """Of faces (F, 3) with the same three vertices the first; none that names a vertex twice."""
    ascending = np.sort(faces, axis=1)
    first = np.unique(ascending, axis=0, return_index=True)[1]
    return faces[np.intersect1d(first, np.flatnonzero((np.diff(ascending) > 0).all(1)))]


def mesh_quadrics(vertices, faces):
    """Eq. (3) with the planes of the boundary, BOUNDARY_WEIGHT times: (V, 4, 4)."""
    quadrics = vertex_quadrics(plane_quadrics(face_planes(vertices, faces)), faces, len(vertices))
    edges, planes = boundary_planes(vertices, faces)
    for ends in edges.T:
        np.add.at(quadrics, ends, BOUNDARY_WEIGHT * plane_quadrics(planes))
    return quadrics


def simplify(vertices, faces, face_count, t=0.0):
    """A mesh of at most face_count faces -> vertices (V', 3), faces (F', 3), refused (3,).

    Pairs nearer than t become one as well, which closes cracks and joins parts. With t = 0, what
    was manifold stays so, boundary and topology included. If every pair that is left is refused, a
    warning says so, and the mesh has more faces. refused counts by REASONS.
    ValueError for what is no mesh, for a negative t or face_count, or nan.
    """
    inputs.require_mesh(vertices, faces)
    vertices, faces = np.asarray(vertices, float), plain_faces(np.asarray(faces, int))
    if not all(isinstance(number, numbers.Real) and number >= 0 for number in (face_count, t)):
        raise ValueError("simplify needs face_count >= 0 and t >= 0, "
                         f"got face_count {face_count} and t {t}")
    if len(faces) == 0:
        raise ValueError("every face names a vertex twice: there is no surface to simplify")
    used, faces = np.unique(faces, return_inverse=True)
    vertices, faces = vertices[used], faces.reshape(-1, 3)
    # Near the origin and of size 1, the numbers of a quadric keep their digits.
    centre = vertices.mean(0)
    size = 2.0 ** np.frexp(np.abs(vertices - centre).max())[1]
    vertices = (vertices - centre) / size
    pairs, quadrics = valid_pairs(vertices, faces, t / size), mesh_quadrics(vertices, faces)
    vertices, faces, refused = simplify_heap(vertices, faces, quadrics, pairs, face_count)
    if len(faces) > face_count:
        counts = ", ".join(f"{n} for {reason}" for n, reason in zip(refused, REASONS, strict=True))
        warnings.warn(f"{len(faces)} faces are left, {face_count} were asked for: every other "
                      f"collapse would break the surface (refused: {counts})", stacklevel=2)
    used, faces = np.unique(faces, return_inverse=True)
    return vertices[used] * size + centre, faces.reshape(-1, 3), refused
