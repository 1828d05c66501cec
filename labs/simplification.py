"""Simplification: fewer faces for nearly the same surface, by collapsing pairs of vertices.

    p = (n, d),  n . x + d = 0,  |n| = 1              the plane of a face                    (1)
    v^T Q v = (p . v)^2,  Q = p p^T,  v = (x, 1)      the squared distance of x to it        (2)
    Q_i = sum of area Q over the faces at vertex i    its quadric                            (3)
    cost of a pair = v^T Q v,  Q = Q_i + Q_j          v: where the two become one            (4)

Q in blocks is [A  b; b^T  c], with A (3, 3). v is best at the first of these that is unique:

    A x = -b                                          where the gradient 2 (A x + b) is 0    (5)
    x = x_i + t e,  t = -e.(A x_i + b) / (e.A e)      on the segment, e = x_j - x_i          (6)
    x_i, x_j or (x_i + x_j) / 2                       whichever costs least                  (7)

The cheapest pair is collapsed, again and again. On a closed surface a pair i j is refused unless

    the neighbours that i and j share  =  the third vertices of the faces at i j             (8)

Faces have three different vertices. collapse_heap.py does the same work faster.
Sources: lecture "Geometry, advanced", Garland and Heckbert 1997 (1) to (7), Dey et al. 1999 (8).
"""
import numpy as np
from scipy.spatial import cKDTree

from course.given import mesh
from course.given.arrays import scatter

from .transforms import to_homogeneous

LEAST_CURVATURE = 1e-6  # of the greatest eigenvalue of A: less is rounding, or flat
BOUNDARY_WEIGHT = 10    # of a plane through a boundary edge, times the square of its length
PULL = 1e-10            # to where a vertex is, of the trace of A: it decides where all is flat
LEAST_COSINE = 0.5**0.5  # of the angle by which a normal may turn in one collapse, 45 degrees
LEAST_SHAPE = 0.01      # of the shape that a triangle had before a collapse
LINK, TWINS, FLIP = 1, 2, 3  # the answers of why_refused, in words:
REFUSALS = ("the link condition", "a repeated face", "a flipped face")


def face_planes(vertices, faces):
    """Eq. (1): vertices (V, 3), faces (F, 3) -> p (F, 4), the rows (n, d).

    n points to the side that sees the face counter-clockwise. A face without area, up to rounding,
    has p = 0: `mesh.face_normals` decides that.

    >>> face_planes(np.array([[0.0, 0.0, 2.0], [3.0, 0.0, 2.0], [0.0, 1.0, 2.0]]),
    ...             np.array([[0, 1, 2]]))
    array([[ 0.,  0.,  1., -2.]])
    """
    n = mesh.face_normals(vertices, faces)
    return np.column_stack([n, -(n * vertices[faces[:, 0]]).sum(1)])


def plane_quadrics(planes):  # step 12.2
    """Eq. (2): planes (..., 4) -> Q (..., 4, 4).

    >>> plane_quadrics(np.array([1.0, 2.0, 0.0, 3.0]))[:2]
    array([[1., 2., 0., 3.],
           [2., 4., 0., 6.]])
    """
    raise NotImplementedError("exercise 12.2: plane_quadrics")


def quadric_error(q, x):  # step 12.3
    """Eq. (2): the error v^T Q v of points x: q (..., 4, 4), x (..., 3) broadcast -> (...).

    >>> quadric_error(plane_quadrics(np.array([0.0, 0.0, 1.0, -2.0])), np.array([7.0, 8.0, 5.0]))
    np.float64(9.0)
    """
    raise NotImplementedError("exercise 12.3: quadric_error")


def quadric_error_backward(grad_error, q, x):
    """Backward of `quadric_error`: grad_error (...) -> grad_q (..., 4, 4), grad_x (..., 3).

    q (..., 4, 4) and x (..., 3) have the same leading shape. All 16 numbers of q are free, so q
    need not be symmetric.

    >>> q = np.diag([3.0, 1.0, 1.0, 0.0])
    >>> q[0, 3] = 5.0
    >>> grad_q, grad_x = quadric_error_backward(np.array(1.0), q, np.array([2.0, 0.0, 1.0]))
    >>> grad_q[0], grad_x
    (array([4., 0., 2., 2.]), array([17.,  0.,  2.]))
    """
    v = to_homogeneous(x)
    # d(v^T Q v) = v^T dQ v + v^T (Q + Q^T) dv, and the last number of v is fixed.
    grad_q = grad_error[..., None, None] * plane_quadrics(v)
    grad_v = grad_error[..., None] * ((q + q.swapaxes(-1, -2)) @ v[..., None])[..., 0]
    return grad_q, grad_v[..., :3]


def boundary_planes(vertices, faces):  # extra 12.5 (3 points)
    """The planes that hold the boundary: edges (B, 2) as in `mesh.boundary_edges`, p (B, 4).

    A boundary edge has one face. Its plane contains the edge and is perpendicular to that face. The
    n of eq. (1) points away from the face.

    >>> square = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    >>> edges, p = boundary_planes(square, np.array([[0, 1, 2]]))
    >>> edges[:2].tolist(), (p[:2] + 0.0).tolist()
    ([[0, 1], [0, 2]], [[0.0, -1.0, 0.0, 0.0], [-1.0, 0.0, 0.0, 0.0]])

    Fine print. The plane is p = 0 where the face has no area.
    """
    edges, face_edges = mesh.edges(faces)
    lonely = np.bincount(face_edges.ravel(), minlength=len(edges)) == 1
    face, corner = np.nonzero(lonely[face_edges])
    order = np.argsort(face_edges[face, corner])
    face, corner = face[order], corner[order]
    # From a to b, in the direction of the face, outside is on the right. These are the next two
    # corners: an index of -1 or -2 counts from the end.
    a, b = vertices[faces[face, corner - 2]], vertices[faces[face, corner - 1]]
    n = np.cross(b - a, mesh.face_normals(vertices, faces)[face])
    length = np.linalg.norm(n, axis=1, keepdims=True)  # |b - a|; 0 for a face without area
    n /= np.where(length > 0, length, 1)
    return edges[lonely], np.column_stack([n, -(n * a).sum(1)])


def surface_quadrics(vertices, faces):  # exercise 12.4 (3 points)
    """Eq. (3) for all vertices, and the planes that hold the boundary: (V, 4, 4).

    vertices (V, 3), faces (F, 3). A face counts at its three vertices, with its area. Each of
    `boundary_planes` counts at both ends of its edge, with BOUNDARY_WEIGHT times the edge's length
    squared. `face_planes` and `scatter(values, index, count)` are given. See `demo simplified`.

    >>> triangle = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    >>> surface_quadrics(triangle, np.array([[0, 1, 2]]))[0].diagonal()
    array([10., 40.,  1.,  0.])
    """
    raise NotImplementedError("exercise 12.4: surface_quadrics")


def mesh_quadrics(vertices, faces):
    """`surface_quadrics`, and a slight PULL to where a vertex is: (V, 4, 4)."""
    quadrics = surface_quadrics(vertices, faces)
    pull = PULL * quadrics[:, :3, :3].trace(axis1=1, axis2=2)
    return quadrics + pull[:, None, None] * point_quadrics(vertices)


def point_quadrics(points):
    """Q of the squared distances to points (N, 3), by three planes through each: (N, 4, 4)."""
    normals = np.broadcast_to(np.eye(3), (len(points), 3, 3))
    return plane_quadrics(np.concatenate([normals, -points[:, :, None]], 2)).sum(1)


def valid_pairs(vertices, faces, t):
    """The pairs that may become one vertex: (N, 2), low < high, ascending, each once.

    These are the edges, and all pairs of faces' vertices whose distance is less than t >= 0. With
    t = 0 there are only edges.
    """
    used = np.unique(faces)
    near = used[cKDTree(vertices[used]).query_pairs(t, output_type="ndarray")]
    distance = np.linalg.norm(vertices[near[:, 0]] - vertices[near[:, 1]], axis=1)
    return np.unique(np.concatenate([mesh.edges(faces)[0], near[distance < t]]), axis=0)


def best_anywhere(q):  # step 12.6
    """Eq. (5): the places x (N, 3) of least error. q (N, 4, 4) symmetric, A invertible.

    `np.linalg.solve` takes the right-hand sides as (N, 3, 1).

    >>> corner = plane_quadrics(np.array([[1.0, 0, 0, -1], [0, 1, 0, -2], [0, 0, 1, -3]])).sum(0)
    >>> best_anywhere(corner[None])
    array([[1., 2., 3.]])
    """
    raise NotImplementedError("exercise 12.6: best_anywhere")


def best_on_segment(q, a, b):  # extra 12.8 (3 points)
    """Eq. (6): the best place x (N, 3) on the segments from a to b, and whether it is unique (N,).

    q (N, 4, 4) symmetric, a, b (N, 3). Clip t to the segment, from 0 to 1.

    >>> q = plane_quadrics(np.array([[1.0, 0.0, 0.0, -2.0]]))
    >>> best_on_segment(q, np.array([[0.0, 0.0, 0.0]]), np.array([[8.0, 4.0, 0.0]]))
    (array([[2., 1., 0.]]), array([ True]))

    Fine print. If e.A e is not greater than LEAST_CURVATURE trace(A) e.e, the error hardly changes
    along the segment. Then the place is not unique, and x = a.
    """
    e = b - a
    A, offset = q[:, :3, :3], q[:, :3, 3]
    along = ((A @ e[..., None])[..., 0] * e).sum(1)
    unique = along > LEAST_CURVATURE * A.trace(axis1=1, axis2=2) * (e * e).sum(1)
    slope = (((A @ a[..., None])[..., 0] + offset) * e).sum(1)
    t = np.where(unique, -slope / np.where(unique, along, 1), 0)
    return a + np.clip(t, 0, 1)[:, None] * e, unique


def best_of_three(q, a, b):
    """Eq. (7): a, b or the middle of the two, whichever has the least error: (N, 3).

    q (N, 4, 4), a, b (N, 3). The first of equal errors counts.
    """
    three = np.stack([a, b, (a + b) / 2])
    least = np.argmin(quadric_error(q[None], three), axis=0)
    return three[least, np.arange(len(a))]


def pair_costs(vertices, quadrics, pairs):  # exercise 12.7 (3 points)
    """Eq. (4): where does each pair go, and at what cost? -> positions (N, 3), costs (N,)

    vertices (V, 3), quadrics (V, 4, 4), pairs (N, 2). Eq. (5) is used where the least eigenvalue of
    A (`np.linalg.eigvalsh`) is greater than LEAST_CURVATURE times the greatest, else (6) where it
    is unique, else (7): `best_on_segment`, `best_of_three`.

    >>> vertices = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0]])
    >>> quadrics = plane_quadrics(np.array([[1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, -4.0]]))
    >>> pair_costs(vertices, quadrics, np.array([[0, 1]]))
    (array([[2., 0., 0.]]), array([8.]))
    """
    raise NotImplementedError("exercise 12.7: pair_costs")


def collapse_faces(faces, a, b):  # step 12.1
    """The faces (N, 3) after the vertices a and b became one, called a: (M, 3).

    Faces with both of them go. The others keep their order.

    >>> collapse_faces(np.array([[0, 1, 2], [2, 1, 3], [4, 2, 3]]), 1, 2)
    array([[4, 1, 3]])
    """
    raise NotImplementedError("exercise 12.1: collapse_faces")


def satisfies_link_condition(faces, a, b):  # step 12.9
    """Eq. (8): may the edge between the vertices a and b be collapsed? -> bool

    faces (N, 3): at least all that have a or b. Below is a double pyramid with the ring 1 2 3.

    >>> faces = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [4, 2, 1], [4, 3, 2], [4, 1, 3]])
    >>> satisfies_link_condition(faces, 0, 1), satisfies_link_condition(faces, 1, 2)
    (True, False)
    """
    raise NotImplementedError("exercise 12.9: satisfies_link_condition")


def has_twins(faces):
    """Do two of the faces (N, 3) have the same three vertices, in any order? -> bool"""
    return len({frozenset(face) for face in faces.tolist()}) < len(faces)


def flips(before, after):  # extra 12.11 (2 points)
    """Does the normal n of any triangle turn by more than 45 degrees, or become uncertain? -> bool

    before, after (N, 3, 3): the corners of N triangles. A normal becomes uncertain if the shape,
    |n| / (longest edge)^2, falls below LEAST_SHAPE times its old value. LEAST_COSINE is the cosine
    of 45 degrees.

    >>> before = np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
    >>> flips(before, before + 1), flips(before, before[:, [1, 0, 2]])
    (False, True)
    >>> flips(before, np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.001, 0.0]]]))
    True

    Fine print. A triangle that had no area before (n = 0 exactly) never flips. There may be no
    triangle at all.
    """
    corners = np.stack([before, after])
    edges = corners[:, :, [1, 2, 0]] - corners
    n = np.cross(edges[:, :, 0], edges[:, :, 1])
    length, new_length = np.sqrt((n * n).sum(2))
    longest, new_longest = (edges * edges).sum(3).max(2)
    turns = (n[0] * n[1]).sum(1) < LEAST_COSINE * length * new_length
    thins = new_length * longest < LEAST_SHAPE * length * new_longest
    return bool((turns | thins).any())


def why_refused(vertices, faces, a, b, position):  # exercise 12.10 (3 points)
    """May the edge a, b become one vertex at position (3,)? -> 0 for yes, else LINK, TWINS or FLIP.

    vertices (V, 3), faces (N, 3): at least all that have a or b, of a closed surface. The first
    reason counts. `has_twins` asks about the faces that are left, `flips` about their corners
    before and after. A face with the vertex V (`outside`) does not flip.

    >>> ring = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [4, 2, 1], [4, 3, 2], [4, 1, 3]])
    >>> x = np.array([[0.0, 0, 3], [1, 0, 0], [-1, 2, 0], [-1, -2, 0], [0, 0, -2]])
    >>> why_refused(x, ring, 1, 2, x[1]) == LINK, why_refused(x, ring, 0, 1, -9 * x[0]) == FLIP
    (True, True)

    Fine print. A pair that is no edge joins two sheets on purpose. It need not satisfy eq. (8), and
    its faces to outside may be twins.
    """
    raise NotImplementedError("exercise 12.10: why_refused")


def simplify_loop(vertices, faces, quadrics, face_count):  # exercise 12.12 (3 points)
    """Down to face_count faces, collapse the cheapest of `mesh.edges` with `why_refused` 0, if any.

    vertices (V, 3), closed faces (F, 3), quadrics (V, 4, 4) -> vertices (V, 3), faces. The lower
    vertex gets the place and the summed quadrics. See `demo simplified`.

    >>> vertices, faces = mesh.icosphere(20)
    >>> q = mesh_quadrics(vertices, faces)
    >>> [len(simplify_loop(vertices, faces, q, n)[1]) for n in (20, 13, 0)]
    [20, 12, 4]
    """
    raise NotImplementedError("exercise 12.12: simplify_loop")
