"""Remeshing: other triangles for nearly the same surface, by edge flips and by sliding vertices.

    gamma + delta > pi                          the edge is not Delaunay: flip it            (8)
    x' = x + rate (I - n n^T) (mean of the neighbours - x)       tangential relaxation       (9)

(1) to (7) and (10) are in `regularization.py`. An edge a b has the faces a b c and b a d. A flip
replaces it by the edge c d. gamma is the angle at c, and delta is the angle at d.

A mesh is vertices (V, 3) and faces (F, 3), none of which names a vertex twice. Any number of faces
may share an edge. Only an edge between two faces that wind alike can flip. All others are held.

Sources: notes on GAMES101, lecture on geometry; Botsch and Kobbelt 2004 (9).
"""
import numbers

import numpy as np

from course.given import inputs, mesh
from course.given.distances import closest_faces, closest_on_triangles, closest_points

from .regularization import corner_angles, smooth_explicit, triangle_normals

STRAIGHT = 0.9        # cosine of the largest angle between normals over which an edge may flip
LEAST_GAIN = 1e-9     # of a flip, so that rounding cannot flip to and fro
MOST_PASSES = 100     # of flips; in the plane Delaunay flips come to an end, in space nearly always
MOST_CUTS = 5         # of a triangle into four, to prove that all of it is near a surface


def edge_quads(faces):
    """The edges that can be flipped: quads (N, 4), their two faces (N, 2), held edges (H, 2).

    A row a, b, c, d of quads is an edge from a to b, a < b, with the faces (a, b, c) and (b, a, d).
    All other edges are held: at a hole, where three faces meet, or where two wind against each
    other.
    """
    edges, face_edges = mesh.edges(faces)
    # The edge opposite to corner k runs from k + 1 to k + 2: from a to b in one face, or back.
    forward = np.roll(faces, -1, 1) < np.roll(faces, -2, 1)
    corners = np.zeros((len(edges), 2), int)
    sound = np.ones(len(edges), bool)
    for side, runs in enumerate((forward, ~forward)):
        corners[face_edges[runs], side] = np.flatnonzero(runs)
        sound &= np.bincount(face_edges[runs], minlength=len(edges)) == 1
    corners = corners[sound]
    return np.hstack([edges[sound], faces.ravel()[corners]]), corners // 3, edges[~sound]


def flip(quads):
    """The faces after edge a b was replaced by c d: quads (N, 4) of a, b, c, d -> (N, 2, 3).

    Before, they are (a, b, c) and (b, a, d). Then they are (a, d, c), at a, and (b, c, d), at b.
    """
    return quads[:, [[0, 3, 2], [1, 2, 3]]]


def delaunay_gain(corners):  # step 13.10
    """Eq. (8): gamma + delta - pi (N,), positive where an edge should flip.

    corners (N, 4, 3): the positions of a, b, c, d. `corner_angles` gives angles.

    >>> delaunay_gain(np.array([[[-3.0, 0, 0], [3, 0, 0], [0, 3, 0], [0, -3, 0]],
    ...                         [[-3.0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 0]]])).round(6)
    array([0.      , 1.570796])

    Fine print. Tiny angles, and those where corners coincide, are right as `corner_angles` has
    them.
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
    """Where does a flip keep a mesh sound and its surface nearly where it is? bool (N,).

    The edge must be a new one, and the normals of the four faces, old and new, nearly alike. An old
    face without area counts as lying in the plane of the other one.
    """
    edges, _ = mesh.edges(faces)
    to_key = np.array([len(vertices), 1], np.int64)
    new = np.sort(quads[:, 2:], axis=1) @ to_key
    corners = vertices[np.concatenate([quads[:, [[0, 1, 2], [1, 0, 3]]], flip(quads)], 1)]
    normal = mesh.unit(triangle_normals(corners))
    empty = ~normal[:, :2].any(-1, keepdims=True)
    normal[:, :2] = np.where(empty, normal[:, [1, 0]], normal[:, :2])
    alike = (normal @ normal.swapaxes(1, 2)).min((1, 2)) > STRAIGHT
    return alike & ~np.isin(new, edges @ to_key)


def flip_best(vertices, faces, quads, quad_faces, gain=None):  # exercise 13.11 (4 points)
    """Flip, all at once, the edges whose flip is best -> faces (F, 3).

    quads (N, 4), quad_faces (N, 2): some of `edge_quads`. gain (N,) of each flip, or None for
    `delaunay_gain`. A flip must gain more than LEAST_GAIN, and `can_flip` must allow it. Of those,
    flip each one that gains more than all others at its four vertices. `flip` is given. See
    `demo relaxation`.

    >>> vertices = np.array([[-3.0, 0, 0], [3, 0, 0], [0, 1, 0], [0, -1, 0]])
    >>> faces = np.array([[0, 1, 2], [1, 0, 3]])
    >>> quads, quad_faces, _ = edge_quads(faces)
    >>> flip_best(vertices, faces, quads, quad_faces)
    array([[0, 3, 2],
           [1, 2, 3]])

    Fine print. Of equal flips at a vertex, one is done: the last. Quads may be none.
    """
    if gain is None:
        gain = delaunay_gain(vertices[quads])
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


def until_settled(faces, flipped):
    """Faces (F, 3) -> flipped(faces), and so on, until nothing changes any more."""
    for _ in range(MOST_PASSES):
        new = flipped(faces)
        if np.array_equal(new, faces):
            break
        faces = new
    return faces


def flip_to_delaunay(vertices, faces):
    """Faces (F, 3) of the same vertices: all edges that can flip are Delaunay, eq. (8)."""
    return until_settled(faces, lambda now: flip_best(vertices, now, *edge_quads(now)[:2]))


def flip_to_valence_6(vertices, faces):
    """Faces (F, 3) of the same vertices, with valences near 6, or near 4 at held edges."""
    def flipped(faces):
        quads, quad_faces, held = edge_quads(faces)
        edges = np.concatenate([quads[:, :2], held])
        target = np.full(len(vertices), 6)
        target[held] = 4
        valence = np.bincount(edges.ravel(), minlength=len(vertices))
        gain = valence_gain(valence[quads], target[quads])
        return flip_best(vertices, faces, quads, quad_faces, gain)

    return until_settled(faces, flipped)


def relax_step(vertices, normals, edges, rate):  # extra 13.12 (3 points)
    """Eq. (9): vertices (V, 3) slide towards the mean of their neighbours -> x' (V, 3).

    normals (V, 3) are the n, of unit length. edges (E, 2), and a rate from 0 to 1.

    >>> vertices = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 2.0], [0.0, 8.0, 2.0], [9.0, 9.0, 9.0]])
    >>> normals = np.array([[0.0, 0.0, 1.0]] * 4)
    >>> relax_step(vertices, normals, np.array([[0, 1], [0, 2]]), 0.5)
    array([[1., 2., 0.],
           [2., 0., 2.],
           [0., 4., 2.],
           [9., 9., 9.]])

    Fine print. A vertex of no edge stays. Where n = 0, nothing is taken away from the move.
    """
    valence = np.bincount(edges.ravel(), minlength=len(vertices))
    move = smooth_explicit(vertices, edges, np.ones(len(edges)), valence, rate) - vertices
    return vertices + move - (move * normals).sum(1, keepdims=True) * normals


def held_vertices(vertices, faces, tolerance):
    """Which vertices must not slide? Those at a held edge, of no face, or standing out: bool (V,).

    A vertex stands out if it is farther above the mean of its neighbours than the tolerance.
    """
    *_, held = edge_quads(faces)
    edges, _ = mesh.edges(faces)
    to_mean = relax_step(vertices, np.zeros_like(vertices), edges, 1.0) - vertices
    out = np.abs((to_mean * mesh.vertex_normals(vertices, faces)).sum(1)) > tolerance
    out[held] = True
    out[np.setdiff1d(np.arange(len(vertices)), faces)] = True
    return out


def relax(vertices, faces, tolerance, steps=4):
    """Thin triangles become rounder, the surface stays: -> vertices (V, 3), faces (F, 3).

    Flips, slides by eq. (9) and ways back onto the surface take turns. No point of either surface
    is farther than 2 tolerance from the other one. ValueError for what is no mesh
    (`inputs.require_mesh`), a face that names a vertex twice, and a tolerance or steps below 0.
    """
    inputs.require_mesh(vertices, faces)
    vertices = np.asarray(vertices, float)
    faces = np.asarray(faces, int)
    if not (isinstance(tolerance, numbers.Real) and isinstance(steps, numbers.Integral)
            and tolerance >= 0 and steps >= 0):
        raise ValueError("relax needs a number tolerance >= 0 and a whole number steps >= 0, "
                         f"got tolerance {tolerance} and steps {steps}")
    frozen = np.zeros(len(vertices), bool)
    while True:  # a face of frozen vertices stays as it was, so each turn freezes another vertex
        moved, flipped = flip_and_slide(vertices, faces, tolerance, steps, frozen)
        far = far_faces(vertices, faces, moved, flipped, 2 * tolerance)
        if not far.any():
            return moved, flipped
        frozen[faces[far]] = frozen[flipped[far]] = True


def flip_and_slide(vertices, faces, tolerance, steps, frozen):
    """What `relax` does, but frozen vertices (V,) keep their places and their faces."""
    def flip_near(faces):
        quads, quad_faces, _ = edge_quads(faces)
        near = diagonal_distance(moved[quads]) <= tolerance
        may = near & ~frozen[quads].any(1)
        return flip_best(moved, faces, quads[may], quad_faces[may])

    free = ~held_vertices(vertices, faces, tolerance) & ~frozen
    moved = vertices.copy()
    flipped = until_settled(faces, flip_near)
    for _ in range(steps):
        edges, _ = mesh.edges(flipped)
        slid = relax_step(moved, mesh.vertex_normals(moved, flipped), edges, 1.0)
        moved[free] = closest_points(slid[free], vertices, faces)
        flipped = until_settled(flipped, flip_near)
    return moved, flipped


def diagonal_distance(corners):
    """How far does a flip move the surface? From line ab to cd: corners (N, 4, 3) -> (N,)."""
    a, b, c, d = corners.swapaxes(0, 1)
    return np.abs(((c - a) * mesh.unit(np.cross(b - a, d - c))).sum(1))


def far_faces(vertices, faces, moved, flipped, bound):
    """Which faces are not known to be within a bound of the other surface? bool (F,).

    True for face f if that of either surface may be farther from the other surface.
    """
    far = (moved != vertices).any(1)[faces].any(1) | (flipped != faces).any(1)
    changed = np.flatnonzero(far)
    far[changed] = (leaves(vertices[faces[changed]], moved, flipped, bound)
                    | leaves(moved[flipped[changed]], vertices, faces, bound))
    return far


def leaves(triangles, vertices, faces, bound):
    """Which triangles (N, 3, 3) have, or may have, a point farther from a surface than a bound?

    -> bool (N,). The distance to one face is convex, so no point of a piece is farther from it than
    a corner is. Pieces are cut in four until the face nearest to the middle is near all corners.
    """
    far = np.zeros(len(triangles), bool)
    pieces = triangles
    owner = np.arange(len(triangles))
    for _ in range(MOST_CUTS):
        middle = pieces.mean(1)
        nearest, closest = closest_faces(middle, vertices, faces)
        far[owner[np.linalg.norm(middle - closest, axis=1) > bound]] = True
        face = np.repeat(vertices[faces[nearest]], 3, 0)
        corners = pieces.reshape(-1, 3)
        apart = np.linalg.norm(corners - closest_on_triangles(corners, face), axis=1)
        unproven = (apart.reshape(-1, 3).max(1) > bound) & ~far[owner]
        pieces = in_four(pieces[unproven])
        owner = np.repeat(owner[unproven], 4)
    far[owner] = True
    return far


def in_four(triangles):
    """Triangles (N, 3, 3), each cut at the middles of its sides -> (4 N, 3, 3)."""
    middle = (np.roll(triangles, -1, 1) + np.roll(triangles, -2, 1)) / 2  # opposite to corner k
    at_corner = [np.stack([triangles[:, k], middle[:, k - 1], middle[:, k - 2]], 1)
                 for k in range(3)]
    return np.stack([*at_corner, middle], 1).reshape(-1, 3, 3)
