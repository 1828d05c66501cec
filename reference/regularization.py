"""Regularization: a mesh's triangles made round, its surface made smooth, its gradients made wise.

    q = 2 r / R                      radii of a triangle's inscribed, circumscribed circle   (1)
    (L x)_i = sum_j w_ij (x_i - x_j)                 Laplacian, over the edges at vertex i   (2)
    w_ij = 1    or    w_ij = (cot alpha + cot beta) / 2             uniform, or cotangents   (3)
    E = sum_i |(L x)_i|^2 / m_i                                           Laplacian energy   (4)
    x' = x - s M^-1 L x                            explicit smoothing: a step of diffusion   (5)
    (M + s L) x' = M x                             implicit smoothing: stable for any s      (6)
    6 volume = sum x_0 . (x_1 x x_2)                      tetrahedra from the origin         (7)
    gamma + delta > pi                          the edge is not Delaunay: flip it            (8)
    x' = x + rate (I - n n^T) (mean of the neighbours - x)       tangential relaxation       (9)
    u = (I + lambda L) x,   grad_u = (I + lambda L)^-1 grad_x    large steps                (10)

L is symmetric, its rows sum to 0, x . L x >= 0 for weights >= 0 and for cotangents. alpha and beta
lie opposite to the edge in its two faces. M is diagonal, m_i how much vertex i stands for: its
valence with uniform weights, its area with cotangents. (Lab 9 wrote (4) for uniform weights and
m = valence^2: no exercise calls another lab's. Here is the general one, and a test ties them.)

Edges (E, 2), low < high, and face_edges (F, 3) are those of `mesh.edges`: face_edges[f, k] is the
edge opposite to vertex k of face f, and in an array (F, 3, 3) of triangles corner k is vertex k. A
face that names a vertex twice must be left out before. Any number of faces may share an edge.

Sources: GAMES101's lecture on geometry; Pinkall and Polthier 1993 (3), Desbrun et al. 1999 (6),
Taubin 1995, Botsch and Kobbelt 2004 (9), Nicolet, Jacobson and Jakob 2021 (10).
"""
import numbers

import numpy as np
import scipy.sparse
from scipy.sparse.linalg import spsolve

from course.given import inputs, mesh
from course.given.distances import closest_points

NO_AREA = 1e-12       # twice a face's area over its longest side squared: up to this it has none
STRAIGHT = 0.9        # cosine of the largest angle between normals over which an edge may flip
LEAST_GAIN = 1e-9     # of a flip, so that rounding cannot flip to and fro
MOST_PASSES = 100     # of flips; in the plane Delaunay flips come to an end, in space nearly always


# --- quality -----------------------------------------------------------------------------------

def sides(triangles):
    """From each corner k of triangles (..., 3, 3) to corner k + 1, and to k + 2, modulo 3."""
    return np.roll(triangles, -1, -2) - triangles, np.roll(triangles, -2, -2) - triangles


def unit(vectors):
    """Vectors (..., 3) of length 1, in the same directions; (0, 0, 0) stays."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length > 0, length, 1)


def corner_angles(triangles):  # exercise 13.1 (2 points)
    """The angle at each corner, from 0 to pi: triangles (..., 3, 3) -> (..., 3), in radians.

    A small angle must keep its digits: one of 1e-9 comes out right to a relative 1e-9. At a corner
    that coincides with another one, the angle is 0.

    >>> corner_angles(np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]])).round(6)
    array([1.570796, 0.785398, 0.785398])
    """
    p, q = sides(triangles)
    return np.arctan2(np.linalg.norm(np.cross(p, q), axis=-1), (p * q).sum(-1))


def radius_ratio(triangles):  # exercise 13.2 (2 points)
    """Eq. (1): triangles (..., 3, 3) -> q (...), 1 for an equilateral one, 0 for one without area.

    Also where corners coincide, q is 0.

    >>> radius_ratio(np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]])).round(9)
    np.float64(0.8)
    """
    # r = 2 A / (a + b + c) and R = a b c / (4 A).
    p, q = sides(triangles)
    length = np.linalg.norm(p, axis=-1)
    twice_area = np.linalg.norm(np.cross(p, q)[..., 0, :], axis=-1)
    below = length.prod(-1) * length.sum(-1)
    return 4 * twice_area**2 / np.where(below > 0, below, 1)


# --- Laplacians --------------------------------------------------------------------------------

def cotangents(triangles):  # exercise 13.3 (2 points)
    """The cotangent of the angle at each corner: triangles (..., 3, 3) -> (..., 3).

    Where twice the area is at most NO_AREA times the longest side squared, all three are 0: such a
    triangle takes no part in anything.

    >>> cotangents(np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0]]))
    array([0. , 2. , 0.5])
    """
    p, q = sides(triangles)
    twice_area = np.linalg.norm(np.cross(p, q)[..., :1, :], axis=-1)
    flat = twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    return np.where(flat, 0, (p * q).sum(-1) / np.where(flat, 1, twice_area))


def cotangents_backward(grad_cotangents, triangles):  # exercise 13.4 (4 points)
    """Backward of `cotangents`: grad_cotangents (..., 3) -> grad_triangles (..., 3, 3).

    0 for a triangle whose cotangents are set to 0.

    >>> triangle = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    >>> cotangents_backward(np.array([0.0, 1.0, 0.0]), triangle)  # x_1 / y_2 if the rest stays
    array([[ 0.  ,  1.25,  0.  ],
           [ 0.5 , -0.25,  0.  ],
           [-0.5 , -1.  ,  0.  ]])
    """
    # cot_k = p_k . q_k / s, where s = |p_0 x q_0| = 2 A is the same at all corners. A corner that
    # rises over the opposite side makes s grow by that side: ds/dx_k = n x (q_k - p_k), |n| = 1.
    p, q = sides(triangles)
    area_vector = np.cross(p, q)[..., :1, :]
    s = np.linalg.norm(area_vector, axis=-1, keepdims=True)
    flat = s <= NO_AREA * (p**2).sum(-1).max(-1)[..., None, None]
    s = np.where(flat, 1, s)
    by_dot = np.where(flat, 0, grad_cotangents[..., None] / s)
    by_p, by_q = by_dot * q, by_dot * p
    by_s = -(by_dot * (p * q).sum(-1, keepdims=True)).sum(-2, keepdims=True) / s
    return (np.roll(by_p, 1, -2) + np.roll(by_q, 2, -2) - by_p - by_q
            + by_s * np.cross(area_vector / s, q - p))


def cotangent_weights(cotangents, face_edges, edge_count):  # exercise 13.5 (2 points)
    """Eq. (3): the cotangents (F, 3) of all faces' corners -> weight of each edge (edge_count,).

    An edge of one face has half of one cotangent, and an edge of three faces half of three. Where
    gamma + delta > pi, eq. (8), a weight is negative.

    >>> cotangent_weights(np.array([[1.0, 2.0, 3.0], [5.0, 7.0, 9.0]]),
    ...                   np.array([[0, 1, 2], [3, 2, 4]]), 5)
    array([0.5, 1. , 5. , 2.5, 4.5])
    """
    return np.bincount(face_edges.ravel(), cotangents.ravel(), edge_count) / 2


def vertex_areas(triangles, faces, vertex_count):
    """M of the cotangent Laplacian: each vertex has a third of its faces' areas: (vertex_count,).

    triangles (F, 3, 3), faces (F, 3).
    """
    p, q = sides(triangles)
    third = np.linalg.norm(np.cross(p, q)[:, 0], axis=-1) / 6
    return np.bincount(faces.ravel(), np.repeat(third, 3), vertex_count)


def vertex_areas_backward(grad_areas, triangles, faces):
    """Backward of `vertex_areas`: grad_areas (V,) -> grad_triangles (F, 3, 3)."""
    # As in `cotangents_backward`, 2 A grows by n x (q_k - p_k) with corner k.
    p, q = sides(triangles)
    normal = unit(np.cross(p, q)[:, :1])
    return grad_areas[faces].sum(1)[:, None, None] / 6 * np.cross(normal, q - p)


def laplacian_entries(edges, weights, vertex_count):  # exercise 13.6 (2 points)
    """Eq. (2) as a sparse matrix L: rows, columns (integers) and values of its entries, each (N,).

    edges (E, 2), weights (E,). In any order; several entries at one place are meant to be added.
    vertex_count, the number of rows, is there for those who want to list every diagonal entry.

    >>> rows, columns, values = laplacian_entries(np.array([[0, 2]]), np.array([5.0]), 3)
    >>> scipy.sparse.coo_array((values, (rows, columns)), shape=(3, 3)).toarray()
    array([[ 5.,  0., -5.],
           [ 0.,  0.,  0.],
           [-5.,  0.,  5.]])
    """
    i, j = edges.T
    rows, columns = np.concatenate([i, j, i, j]), np.concatenate([j, i, i, j])
    return rows, columns, np.concatenate([-weights, -weights, weights, weights])


def laplacian(edges, weights, vertex_count):
    """L of eq. (2) as a sparse matrix (V, V)."""
    rows, columns, values = laplacian_entries(edges, weights, vertex_count)
    return scipy.sparse.csc_array((values, (rows, columns)), shape=(vertex_count, vertex_count))


def per_mass(x, mass):
    """M^-1 x, where a mass is 0: 0. x (V, C), mass (V,) >= 0, both float."""
    return np.divide(x, mass[:, None], out=np.zeros_like(x), where=mass[:, None] > 0)


def laplacian_energy(x, edges, weights, mass):  # exercise 13.7 (1 point)
    """Eq. (4): the sum over all vertices and channels of (L x)^2 / m, a number: a regularizer.

    x (V, C), edges (E, 2), weights (E,), mass (V,) >= 0. A vertex of mass 0 adds nothing.

    >>> x, edges = np.array([[1.0], [2.0], [4.0]]), np.array([[0, 1], [1, 2]])
    >>> laplacian_energy(x, edges, np.ones(2), np.array([1.0, 2.0, 4.0]))  # L x is -1, -1, 2
    np.float64(2.5)
    """
    y = laplacian(edges, weights, len(x)) @ x
    return (y * per_mass(y, mass)).sum()


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):  # exercise 13.8 (4 points)
    """Backward of eq. (4): grad_energy, a number -> grad_x (V, C), grad_weights (E,),
    grad_mass (V,), which is 0 where the mass is 0.

    >>> x, edges = np.array([[1.0], [2.0], [4.0]]), np.array([[0, 1], [1, 2]])
    >>> grad_x, grad_weights, grad_mass = laplacian_energy_backward(
    ...     0.5, x, edges, np.ones(2), np.array([1.0, 2.0, 4.0]))
    >>> grad_x[:, 0], grad_weights, grad_mass
    (array([-0.5, -0.5,  1. ]), array([0.5, 2. ]), array([-0.5  , -0.125, -0.125]))
    """
    # E = y . z with y = L x and z = y / m, and L is symmetric:
    # dE = 2 z . L dx + 2 sum dw_ij (z_i - z_j) . (x_i - x_j) - sum dm_i z_i . z_i, each edge once.
    L, (i, j) = laplacian(edges, weights, len(x)), edges.T
    z = per_mass(L @ x, mass)
    grad_y = 2 * grad_energy * z
    grad_weights = ((grad_y[i] - grad_y[j]) * (x[i] - x[j])).sum(1)
    return L @ grad_y, grad_weights, -grad_energy * (z**2).sum(1)


def bending_energy(vertices, faces):
    """Eq. (4) of a surface's own vertices, with its own cotangents and areas -> a number.

    L x is the gradient of the whole area by x; on a fine mesh it has the length 2 (mean curvature)
    (area of the vertex). So this comes near the integral of 4 (mean curvature)^2, which has no
    unit: 16 pi for every sphere, and more for all else that is closed.
    """
    edges, face_edges = mesh.edges(faces)
    weights = cotangent_weights(cotangents(vertices[faces]), face_edges, len(edges))
    areas = vertex_areas(vertices[faces], faces, len(vertices))
    return laplacian_energy(vertices, edges, weights, areas)


def bending_energy_backward(grad_energy, vertices, faces):
    """Backward of `bending_energy`, through weights and areas, too -> grad_vertices (V, 3)."""
    edges, face_edges = mesh.edges(faces)
    weights = cotangent_weights(cotangents(vertices[faces]), face_edges, len(edges))
    areas = vertex_areas(vertices[faces], faces, len(vertices))
    grad_vertices, grad_weights, grad_areas = laplacian_energy_backward(
        grad_energy, vertices, edges, weights, areas)
    grad_triangles = (cotangents_backward(grad_weights[face_edges] / 2, vertices[faces])
                      + vertex_areas_backward(grad_areas, vertices[faces], faces))
    np.add.at(grad_vertices, faces, grad_triangles)
    return grad_vertices


# --- smoothing, and the volume that it costs ---------------------------------------------------

def smooth_explicit(x, edges, weights, mass, step):  # exercise 13.9 (2 points)
    """Eq. (5): x (V, C) -> x' (V, C); s is the step, the diagonal of M is the mass (V,).

    A vertex of mass 0 stays where it is. With uniform weights and the valences as mass, a step of 1
    puts each vertex at the mean of its neighbours, and a longer one may be unstable.

    >>> x, edges = np.array([[0.0], [4.0], [10.0], [7.0]]), np.array([[0, 1], [1, 2]])
    >>> smooth_explicit(x, edges, np.ones(2), np.array([1.0, 2.0, 1.0, 0.0]), 0.5)[:, 0]
    array([2. , 4.5, 7. , 7. ])
    """
    return x - step * per_mass(laplacian(edges, weights, len(x)) @ x, mass)


def smooth_implicit(x, edges, weights, mass, step):  # exercise 13.10 (3 points)
    """Eq. (6): x (V, C) -> x' (V, C), by one sparse solve.

    mass (V,); a vertex of mass 0 belongs to no edge of a weight other than 0, and stays.

    >>> x = np.array([[0.0], [3.0], [7.0]])
    >>> smooth_implicit(x, np.array([[0, 1]]), np.ones(1), np.array([1.0, 2.0, 0.0]), 2.0)[:, 0]
    array([1.5 , 2.25, 7.  ])
    """
    mass = np.where(mass > 0, mass, 1)  # of no edge: x' = x whatever its mass
    system = scipy.sparse.diags_array(mass) + step * laplacian(edges, weights, len(x))
    return spsolve(system.tocsc(), mass[:, None] * x).reshape(x.shape)


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):  # exercise 13.11 (2 points)
    """Smoothing that keeps the size: in each round eq. (5) by shrink, then the other way by grow.

    x (V, C) -> (V, C). 0 < shrink < grow: what is slow grows a little, and what is fast shrinks.

    >>> x, edges = np.array([[0.0], [4.0], [10.0]]), np.array([[0, 1], [1, 2]])
    >>> smooth_taubin(x, edges, np.ones(2), np.array([1.0, 2.0, 1.0]), 0.5, 1.0, 1)[:, 0]
    array([-0.5,  4.5,  9.5])
    """
    for _ in range(rounds):
        x = smooth_explicit(x, edges, weights, mass, shrink)
        x = smooth_explicit(x, edges, weights, mass, -grow)
    return x


def enclosed_volume(triangles):  # exercise 13.12 (1 point)
    """Eq. (7): what triangles (F, 3, 3) enclose, a number; positive if all are counter-clockwise
    seen from outside. (Of an open surface, the volume between it and the origin.)

    >>> enclosed_volume(np.array([[[3.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]]]))
    np.float64(1.0)
    """
    x0, x1, x2 = triangles.swapaxes(0, 1)
    return (x0 * np.cross(x1, x2)).sum() / 6


def enclosed_volume_backward(grad_volume, triangles):  # exercise 13.13 (2 points)
    """Backward of eq. (7): grad_volume, a number -> grad_triangles (F, 3, 3).

    >>> triangle = np.array([[3.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]])
    >>> enclosed_volume_backward(6.0, triangle[None])
    array([[[2., 0., 0.],
            [0., 3., 0.],
            [0., 0., 6.]]])
    """
    # A determinant stays the same when its rows go round, so each corner is the first one once.
    return grad_volume * np.cross(np.roll(triangles, -1, 1), np.roll(triangles, -2, 1)) / 6


def restore_volume(vertices, faces, volume):
    """The vertices (V, 3), moved along the gradient of their volume until it is the one wanted.

    Of a surface that encloses something, and a volume not far from that.
    """
    for _ in range(5):  # of Newton's steps; after three the rest is rounding
        missing = volume - enclosed_volume(vertices[faces])
        direction = np.zeros_like(vertices)
        np.add.at(direction, faces, enclosed_volume_backward(1.0, vertices[faces]))
        vertices = vertices + missing / (direction**2).sum() * direction
    return vertices


# --- edge flips --------------------------------------------------------------------------------

def edge_quads(faces):
    """The edges that can be flipped: quads (N, 4), their two faces (N, 2), held edges (H, 2).

    Row a, b, c, d: the edge of vertices a < b, with the faces (a, b, c) and (b, a, d) in any turn.
    Held are all others: at a hole, or where three faces meet or two wind against each other.
    """
    edges, face_edges = mesh.edges(faces)
    # The edge opposite to corner k runs from k + 1 to k + 2: from a to b in one face, or back.
    forward = np.roll(faces, -1, 1) < np.roll(faces, -2, 1)
    corners, sound = np.zeros((2, len(edges)), int), np.ones(len(edges), bool)
    for corner, way in zip(corners, (forward, ~forward), strict=True):
        corner[face_edges[way]] = np.flatnonzero(way)
        sound &= np.bincount(face_edges[way], minlength=len(edges)) == 1
    corners = corners.T[sound]
    return np.hstack([edges[sound], faces.ravel()[corners]]), corners // 3, edges[~sound]


def flip(quads):
    """The faces after edge a b was replaced by c d: quads (N, 4) of a, b, c, d -> (N, 2, 3).

    Before, they are (a, b, c) and (b, a, d); then (a, d, c), the one at a, and (b, c, d).
    """
    return quads[:, [[0, 3, 2], [1, 2, 3]]]


def delaunay_gain(corners):  # exercise 13.14 (2 points)
    """Eq. (8): gamma + delta - pi (N,), in radians, positive where an edge should be flipped.

    corners (N, 4, 3): the positions of a, b, c, d as in `flip`. gamma is the angle at c, delta that
    at d, each between the sides to a and b, both as exact as `corner_angles` has them.

    >>> delaunay_gain(np.array([[[-3.0, 0, 0], [3, 0, 0], [0, 3, 0], [0, -3, 0]],
    ...                         [[-3.0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 0]]])).round(6)
    array([0.      , 1.570796])
    """
    gamma = corner_angles(corners[:, [2, 0, 1]])[:, 0]
    delta = corner_angles(corners[:, [3, 1, 0]])[:, 0]
    return gamma + delta - np.pi


def valence_gain(valence, target):
    """How much nearer to their targets a flip brings four valences: (N,), integers.

    valence, target (N, 4): how many edges meet at a, b, c, d of `flip`, and how many should.
    """
    after = valence + np.array([-1, -1, 1, 1])
    return (np.abs(valence - target) - np.abs(after - target)).sum(1)


def can_flip(vertices, faces, quads):
    """Where a flip keeps a mesh sound and its surface nearly where it is: bool (N,).

    The new edge must be new, and the normals of the four faces, old and new, nearly alike. An old
    face without any area counts as lying in the other one's plane.
    """
    edges, _ = mesh.edges(faces)
    new = np.sort(quads[:, 2:], axis=1) @ [len(vertices), 1]
    corners = vertices[np.concatenate([quads[:, [[0, 1, 2], [1, 0, 3]]], flip(quads)], 1)]
    p, q = sides(corners)
    normal = unit(np.cross(p, q)[..., 0, :])
    empty = ~normal[:, :2].any(-1, keepdims=True)
    normal[:, :2] = np.where(empty, normal[:, 1::-1], normal[:, :2])
    alike = (normal @ normal.swapaxes(1, 2)).min((1, 2)) > STRAIGHT
    return alike & ~np.isin(new, edges @ [len(vertices), 1])


def flip_best(vertices, faces, quads, quad_faces, gain):
    """Flip all edges at once that gain more than any other one at their four vertices -> faces."""
    able = np.flatnonzero(gain > LEAST_GAIN)
    able = able[can_flip(vertices, faces, quads[able])]
    able = able[np.argsort(gain[able], kind="stable")]
    best = np.full(len(vertices), -1)
    rank = np.arange(len(able))
    np.maximum.at(best, quads[able], rank[:, None])
    chosen = able[(best[quads[able]] == rank[:, None]).all(1)]
    faces = faces.copy()
    faces[quad_faces[chosen]] = flip(quads[chosen])
    return faces


def flip_until_settled(vertices, faces, gain_of):
    """`flip_best` again and again; gain_of(quads, held edges) -> the gain of each flip (N,)."""
    for _ in range(MOST_PASSES):
        quads, quad_faces, held = edge_quads(faces)
        flipped = flip_best(vertices, faces, quads, quad_faces, gain_of(quads, held))
        if np.array_equal(flipped, faces):
            break
        faces = flipped
    return faces


def flip_to_delaunay(vertices, faces):
    """Faces (F, 3) of the same vertices, all edges Delaunay (8), but for those that cannot flip."""
    return flip_until_settled(vertices, faces, lambda quads, _: delaunay_gain(vertices[quads]))


def flip_to_valence_6(vertices, faces):
    """Faces (F, 3) of the same vertices, valences nearer to 6, to 4 on the ends of held edges."""
    def gain(quads, held):
        edges = np.concatenate([quads[:, :2], held])
        target = np.full(len(vertices), 6)
        target[held] = 4
        valence = np.bincount(edges.ravel(), minlength=len(vertices))
        return valence_gain(valence[quads], target[quads])

    return flip_until_settled(vertices, faces, gain)


# --- tangential relaxation ---------------------------------------------------------------------

def relax_step(vertices, normals, edges, rate):  # exercise 13.15 (3 points)
    """Eq. (9): vertices (V, 3) slide towards the mean of their neighbours -> x' (V, 3).

    normals (V, 3), n of unit length, or 0 where there is none, and then nothing is taken away from
    the move; edges (E, 2); rate from 0 to 1. A vertex of no edge stays.

    >>> vertices = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 2.0], [0.0, 8.0, 2.0], [9.0, 9.0, 9.0]])
    >>> normals = np.array([[0.0, 0.0, 1.0]] * 4)
    >>> relax_step(vertices, normals, np.array([[0, 1], [0, 2]]), 0.5)
    array([[1., 2., 0.],
           [2., 0., 2.],
           [0., 4., 2.],
           [9., 9., 9.]])
    """
    valence = np.bincount(edges.ravel(), minlength=len(vertices))
    move = smooth_explicit(vertices, edges, np.ones(len(edges)), valence, rate) - vertices
    return vertices + move - (move * normals).sum(1, keepdims=True) * normals


def held_vertices(vertices, faces, tolerance):
    """Which vertices must not slide: at a held edge, of no face, or standing out: bool (V,).

    A vertex that stands above its neighbours' mean by more than the tolerance would be missed.
    """
    *_, held = edge_quads(faces)
    edges, _ = mesh.edges(faces)
    valence = np.bincount(edges.ravel(), minlength=len(vertices))
    move = smooth_explicit(vertices, edges, np.ones(len(edges)), valence, 1.0) - vertices
    out = np.abs((move * mesh.vertex_normals(vertices, faces)).sum(1)) > tolerance
    out[held] = True
    return out | (valence == 0)


def relax(vertices, faces, tolerance, steps=4):
    """Thin triangles become rounder, the surface stays: -> vertices (V, 3), faces (F, 3).

    Flips, eq. (9), and back onto the surface, in turn. tolerance: see `held_vertices`; by up to
    twice this the surface may move, measure it. ValueError for what is no mesh, see `inputs.require_mesh`,
    or has a face that names a vertex twice, and for a negative tolerance or steps, or nan.
    """
    inputs.require_mesh(vertices, faces)
    vertices, faces = np.asarray(vertices, float), np.asarray(faces, int)
    if not (isinstance(tolerance, numbers.Real) and isinstance(steps, numbers.Integral)
            and tolerance >= 0 and steps >= 0):
        raise ValueError("relax needs a number tolerance >= 0 and a whole number steps >= 0, "
                         f"got tolerance {tolerance} and steps {steps}")
    free = ~held_vertices(vertices, faces, tolerance)
    moved, flipped = vertices.copy(), flip_to_delaunay(vertices, faces)
    for _ in range(steps):
        edges, _ = mesh.edges(flipped)
        slid = relax_step(moved, mesh.vertex_normals(moved, flipped), edges, 1.0)
        moved[free] = closest_points(slid[free], vertices, faces)
        flipped = flip_to_delaunay(moved, flipped)
    return moved, flipped


# --- large steps -------------------------------------------------------------------------------

def precondition(x, edges, weights, amount):
    """Eq. (10): (I + lambda L)^-1 x, which is (6) for M = I: x (V, C) -> (V, C), spread out."""
    return smooth_implicit(x, edges, weights, np.ones(len(x)), amount)


def uniform_adam_step(x, grad_x, mean, square, step, rate,
                      beta_1=0.9, beta_2=0.999, epsilon=1e-8):
    """Lab 9's `adam_step`, but all elements go at the rate of the one with the largest square.

    x, grad_x, mean, square: arrays of one shape, any -> x, mean, square after the step, which is
    1 for the first one. Where Adam turns each element its own way, this keeps grad_x's direction.
    """
    mean = beta_1 * mean + (1 - beta_1) * grad_x
    square = beta_2 * square + (1 - beta_2) * grad_x**2
    steepest = np.sqrt(square.max() / (1 - beta_2**step)) + epsilon
    return x - rate * mean / (1 - beta_1**step) / steepest, mean, square


def large_step(x, grad_x, mean, square, step, rate,  # exercise 13.16 (4 points)
               edges, weights, amount):
    """Eq. (10): downhill in u instead of x, with `uniform_adam_step` -> x, mean, square after it.

    x, grad_x (V, C); mean, square (V, C) and step belong to the gradients by u; the rate is that of
    u. edges (E, 2), weights (E,) >= 0; the amount is lambda >= 0.

    >>> x, grad_x, zero = np.array([[0.0], [0.0]]), np.array([[0.0], [3.0]]), np.zeros((2, 1))
    >>> x, *_ = large_step(x, grad_x, zero, zero, 1, 2.0, np.array([[0, 1]]), np.ones(1), 1.0)
    >>> x[:, 0].round(6)  # grad_u = (1, 2), u goes by (-1, -2), and x by a third of (-4, -5)
    array([-1.333333, -1.666667])
    """
    u = x + amount * laplacian(edges, weights, len(x)) @ x
    grad_u = precondition(grad_x, edges, weights, amount)
    u, mean, square = uniform_adam_step(u, grad_u, mean, square, step, rate)
    return precondition(u, edges, weights, amount), mean, square
