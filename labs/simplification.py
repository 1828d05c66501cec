"""Simplification: fewer faces for nearly the same surface, by collapsing pairs of vertices.

    p = (n, d),  n . x + d = 0,  |n| = 1              the plane of a face                    (1)
    v^T Q v = (p . v)^2,  Q = p p^T,  v = (x, 1)      the squared distance of x to it        (2)
    Q_i = sum of Q over the faces at vertex i         its quadric                            (3)
    cost of a pair = v^T Q v,  Q = Q_i + Q_j          v: where the two become one            (4)

Q in blocks is [A  b; b^T  c], with A (3, 3). The best place for v is the first of these there is:

    A x = -b                                          where the gradient 2 (A x + b) is 0    (5)
    x = x_i + t e,  t = -e.(A x_i + b) / e.A e        on the segment, e = x_j - x_i          (6)
    x_i, x_j or (x_i + x_j) / 2                       whichever costs least                  (7)

The cheapest pair is collapsed, and again. A pair i j is refused unless, on a closed surface,

    the neighbours that i and j share  =  the third vertices of the faces at i j             (8)

Sources: lecture "Geometry, advanced"; Garland and Heckbert 1997 (1)-(7); Dey et al. 1999, (8). The
caller guarantees faces of three different vertices.
"""
import numpy as np
from scipy.spatial import cKDTree

from course.given import mesh

from .rasterization import scatter

LEAST_CURVATURE = 1e-3  # of the greatest eigenvalue of A: less is rounding, or nearly flat
BOUNDARY_WEIGHT = 100   # of a plane through a boundary edge; that of a face has 1
LEAST_COSINE = 0.5**0.5  # of the angle by which a normal may turn in one collapse, 45 degrees
LEAST_SHAPE = 0.01      # of what a triangle's shape was before a collapse
LINK, TWINS, FLIP = 1, 2, 3  # the answers of why_refused, in words:
REASONS = ("the link condition", "a repeated face", "a flipped face")


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


def mesh_quadrics(vertices, faces):
    """Eq. (3) with the planes of the boundary, BOUNDARY_WEIGHT times: (V, 4, 4)."""
    quadrics = vertex_quadrics(plane_quadrics(face_planes(vertices, faces)), faces, len(vertices))
    edges, planes = boundary_planes(vertices, faces)
    held = np.stack(2 * [BOUNDARY_WEIGHT * plane_quadrics(planes)])
    return quadrics + scatter(held, edges.T, len(vertices))


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
    """Does the normal n of a triangle turn by more than 45 degrees, or become uncertain? -> bool

    before, after (N, 3, 3): the corners of N triangles. One is enough. A normal becomes uncertain
    where the triangle's shape, |n| / (longest edge)^2, falls below LEAST_SHAPE times what it was:
    after two or three such collapses a face could be a line up to rounding, or stand upright and
    then turn over. A triangle that had no area before (n = 0 exactly) never flips.

    >>> before = np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
    >>> flips(before, before + 1), flips(before, before[:, [1, 0, 2]])
    (False, True)
    >>> flips(before, np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.001, 0.0]]]))
    True
    """
    raise NotImplementedError("exercise 12.14: flips")


def why_refused(vertices, faces, a, b, position):
    """May the pair a, b become one vertex at position (3,)? -> 0 for yes, else LINK, TWINS or FLIP.

    faces (N, 3): all at a or b of the closed surface, whose `outside` is len(vertices). A pair that
    is no edge joins two sheets: what eq. (8) forbids is its very purpose.
    """
    vanish = (faces == a).any(1) & (faces == b).any(1)
    is_edge = vanish.any()
    if is_edge and not satisfies_link_condition(faces, a, b):
        return LINK
    kept = collapse_faces(faces, a, b)
    real = (kept < len(vertices)).all(1)
    if has_twins(kept if is_edge else kept[real]):
        return TWINS
    before = vertices[faces[~vanish][real]]
    moves = (kept[real] == a)[..., None]
    return FLIP if flips(before, np.where(moves, position, before)) else 0


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
