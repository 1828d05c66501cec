"""Regularization: round triangles, smooth surfaces, and gradients that move a surface as a whole.

    q = 2 r / R             r, R: radii of a triangle's inscribed and circumscribed circle   (1)
    (L x)_i = sum_j w_ij (x_i - x_j)                 Laplacian, over the edges at vertex i   (2)
    w_ij = 1   or   w_ij = (cot alpha + cot beta) / 2,    cot = p . q / |p x q|              (3)
    E = sum_i |(L x)_i|^2 / m_i                                           Laplacian energy   (4)
    x' = x - s M^-1 L x                            explicit smoothing: a step of diffusion   (5)
    (M + s L) x' = M x                             implicit smoothing: stable for any s      (6)
    6 volume = sum x_0 . (x_1 x x_2)                      tetrahedra from the origin         (7)
    u = (I + lambda L) x,   grad_u = (I + lambda L)^-1 grad_x    large steps                (10)

Equations (8) and (9) are in `remeshing.py`. The angles alpha and beta lie opposite to the edge in
its two faces, between sides p and q. M is diagonal: m_i is a valence with uniform weights, an area
with cotangents. Lab 9's Laplacian is M^-1 L x with w = 1 and m = valence. edges (E, 2) and
face_edges (F, 3) are those of `mesh.edges`: no face may name a vertex twice.
Sources: Pinkall and Polthier 1993 (3), Desbrun et al. 1999 (6), Nicolet et al. 2021 (10).
"""
import numpy as np
import scipy.sparse
from scipy.sparse.linalg import spsolve

from course.given import mesh
from course.given.arrays import scatter

NO_AREA = 1e-12  # twice a face's area over its longest side squared: up to this it has none


def sides(triangles):
    """The sides p, q at each corner: from corner k of triangles (..., 3, 3) to k + 1 and k + 2."""
    return np.roll(triangles, -1, -2) - triangles, np.roll(triangles, -2, -2) - triangles


def triangle_normals(triangles):
    """A normal as long as twice the area, for each of triangles (..., 3, 3): (..., 3)."""
    a, b, c = np.moveaxis(triangles, -2, 0)
    return np.cross(b - a, c - a)


def twice_areas(triangles):
    """Twice the area of triangles (..., 3, 3): (...), exact to all digits even for a needle.

    |p x q| is the same at every corner. Between the two shortest sides, the fewest digits cancel.
    """
    p, q = sides(triangles)
    corner = (p**2 + q**2).sum(-1).argmin(-1, keepdims=True)
    return np.take_along_axis(np.linalg.norm(np.cross(p, q), axis=-1), corner, -1)[..., 0]


def corner_angles(triangles):  # extra 13.1 (2 points)
    """The angle at each corner, from 0 to pi: triangles (..., 3, 3) -> (..., 3), in radians.

    Its tangent is twice the area over p . q, where p and q are the sides at the corner.

    >>> corner_angles(np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]])).round(6)
    array([1.570796, 0.785398, 0.785398])

    Fine print. The angle is 0 at a corner that coincides with another one. Every angle is right to
    1e-14, and a needle's tip, across from a short side, to a relative 1e-9, as `twice_areas` is.
    """
    p, q = sides(triangles)
    return np.arctan2(twice_areas(triangles)[..., None], (p * q).sum(-1))


def radius_ratio(triangles):  # extra 13.2 (2 points)
    """Eq. (1): how round are triangles (..., 3, 3)? -> q (...), 1 for an equilateral one.

    With sides a, b, c and area A, r = 2 A / (a + b + c) and R = a b c / (4 A).

    >>> radius_ratio(np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]])).round(9)
    np.float64(0.8)

    Fine print. It is 0 for a triangle without area, even where corners coincide.
    """
    # q = 16 A^2 / (a b c (a + b + c)), and the normal is as long as 2 A.
    length = np.linalg.norm(sides(triangles)[0], axis=-1)
    below = length.prod(-1) * length.sum(-1)
    return 4 * (triangle_normals(triangles)**2).sum(-1) / np.where(below > 0, below, 1)


def cross_lengths(triangles):
    """|p x q| of triangles (..., 3, 3), twice the area: (..., 1), inf where it is next to nothing.

    It is that if it is at most NO_AREA times the longest side squared.
    """
    p, _ = sides(triangles)
    twice_area = np.linalg.norm(triangle_normals(triangles), axis=-1)
    has_area = twice_area > NO_AREA * (p**2).sum(-1).max(-1)
    return np.where(has_area, twice_area, np.inf)[..., None]


def cotangents(triangles):  # step 13.3
    """Eq. (3): the cotangents at the corners of triangles (..., 3, 3) -> (..., 3).

    `sides` gives p and q, `cross_lengths` the length of p x q.

    >>> cotangents(np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0]]))
    array([0. , 2. , 0.5])

    Fine print. A triangle without area takes no part in anything: `cross_lengths` sees to that.
    """
    raise NotImplementedError("exercise 13.3: cotangents")


def cotangent_laplacian(vertices, faces):  # exercise 13.4 (4 points)
    """Eq. (3) and the masses of a mesh -> edges (E, 2), weights (E,), areas (V,).

    vertices (V, 3), faces (F, 3). The given `mesh.edges(faces)` returns the edges, and which lies
    opposite to each corner (F, 3). An edge of one face has half of one of its `cotangents`. A
    vertex has a third of the area of all its faces.

    >>> cotangent_laplacian(np.array([[0.0, 0, 0], [6, 0, 0], [0, 3, 0]]), np.array([[0, 1, 2]]))
    (array([[0, 1],
           [0, 2],
           [1, 2]]), array([0.25, 1.  , 0.  ]), array([3., 3., 3.]))

    Fine print. An edge of three faces has half of three cotangents. The area of a vertex without a
    face is 0. A face without area adds 0 to all weights: see `cross_lengths`.
    """
    raise NotImplementedError("exercise 13.4: cotangent_laplacian")


def laplacian_entries(edges, weights, vertex_count):  # step 13.5
    """Eq. (2) as a sparse matrix L: rows, columns (integers) and values of its entries, each (N,).

    edges (E, 2), weights (E,), vertex_count V. Any order will do: the matrix adds up. See
    `demo smoothed relaxation`.

    >>> rows, columns, values = laplacian_entries(np.array([[0, 2]]), np.array([5.0]), 3)
    >>> scipy.sparse.coo_array((values, (rows, columns)), shape=(3, 3)).toarray()
    array([[ 5.,  0., -5.],
           [ 0.,  0.,  0.],
           [-5.,  0.,  5.]])
    """
    raise NotImplementedError("exercise 13.5: laplacian_entries")


def laplacian(edges, weights, vertex_count):
    """The Laplacian of eq. (2) as a sparse matrix (V, V). It is symmetric, its rows sum to 0."""
    rows, columns, values = laplacian_entries(edges, np.asarray(weights, float), vertex_count)
    return scipy.sparse.csc_array((values, (rows, columns)), shape=(vertex_count, vertex_count))


def cotangents_backward(grad_cotangents, triangles):  # extra 13.6 (4 points)
    """Backward of `cotangents`: grad_cotangents (..., 3) -> grad_triangles (..., 3, 3).

    >>> triangle = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    >>> cotangents_backward(np.array([0.0, 1.0, 0.0]), triangle)  # x_1 / y_2 if the rest stays
    array([[ 0.  ,  1.25,  0.  ],
           [ 0.5 , -0.25,  0.  ],
           [-0.5 , -1.  ,  0.  ]])

    Fine print. It is 0 for a triangle whose cotangents are set to 0.
    """
    # d cot_k = (dp_k . q_k + p_k . dq_k - cot_k ds) / s, with one s = 2 A for all corners. A corner
    # that rises over the opposite side makes s grow by it: ds/dx_k = n x (q_k - p_k), |n| = 1.
    p, q = sides(triangles)
    s = cross_lengths(triangles)[..., None]
    by_dot = grad_cotangents[..., None] / s
    by_p, by_q = by_dot * q, by_dot * p
    by_s = -(by_dot * (p * q).sum(-1, keepdims=True) / s).sum(-2, keepdims=True)
    normal = triangle_normals(triangles)[..., None, :] / s
    return (np.roll(by_p, 1, -2) + np.roll(by_q, 2, -2) - by_p - by_q
            + by_s * np.cross(normal, q - p))


def areas_backward(grad_areas, triangles, faces):
    """Backward of `cotangent_laplacian`'s areas: grad_areas (V,) -> grad_triangles (F, 3, 3)."""
    # As in `cotangents_backward`, 2 A grows by n x (q_k - p_k) with corner k.
    p, q = sides(triangles)
    normal = mesh.unit(triangle_normals(triangles))[:, None]
    return grad_areas[faces].sum(1)[:, None, None] / 6 * np.cross(normal, q - p)


def per_mass(x, mass):
    """M^-1 x, but 0 where a mass is 0: x (V, C), mass (V,) >= 0 -> (V, C)."""
    return x / np.where(mass > 0, mass, np.inf)[:, None]


def laplacian_energy(x, edges, weights, mass):
    """Eq. (4): the Laplacian energy E, a number: x (V, C), edges (E, 2), weights (E,), mass (V,).

    A vertex of mass 0 adds nothing.

    >>> x, edges = np.array([[1.0], [2.0], [4.0]]), np.array([[0, 1], [1, 2]])
    >>> laplacian_energy(x, edges, np.ones(2), np.array([1.0, 2.0, 4.0]))  # L x is -1, -1, 2
    np.float64(2.5)
    """
    y = laplacian(edges, weights, len(x)) @ x
    return (y * per_mass(y, mass)).sum()


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):  # extra 13.7 (4 points)
    """Backward of eq. (4): grad_energy -> grad_x (V, C), grad_weights (E,), grad_mass (V,).

    >>> x, edges = np.array([[1.0], [2.0], [4.0]]), np.array([[0, 1], [1, 2]])
    >>> grad_x, grad_weights, grad_mass = laplacian_energy_backward(
    ...     0.5, x, edges, np.ones(2), np.array([1.0, 2.0, 4.0]))
    >>> grad_x[:, 0], grad_weights, grad_mass
    (array([-0.5, -0.5,  1. ]), array([0.5, 2. ]), array([-0.5  , -0.125, -0.125]))

    Fine print. A vertex of mass 0 adds nothing, so its grad_mass is 0.
    """
    # E = y . z with y = L x and z = y / m, and L is symmetric:
    # dE = 2 z . L dx + 2 sum dw_ij (z_i - z_j) . (x_i - x_j) - sum dm_i z_i . z_i, each edge once.
    L = laplacian(edges, weights, len(x))
    i, j = edges.T
    z = per_mass(L @ x, mass)
    grad_y = 2 * grad_energy * z
    grad_weights = ((grad_y[i] - grad_y[j]) * (x[i] - x[j])).sum(1)
    return L @ grad_y, grad_weights, -grad_energy * (z**2).sum(1)


def bending_energy(vertices, faces):
    """Eq. (4) for a surface's own vertices, cotangents and areas -> a number.

    On a fine mesh |L x| is 2 (mean curvature) (area of the vertex), and the energy comes near the
    integral of 4 (mean curvature)^2: 16 pi for all spheres, more for other closed surfaces.
    """
    return laplacian_energy(vertices, *cotangent_laplacian(vertices, faces))


def bending_energy_backward(grad_energy, vertices, faces):
    """Backward of `bending_energy`: grad_energy, a number -> grad_vertices (V, 3)."""
    # A vertex changes L x itself, and with its triangles the weights and the areas around it.
    grad_vertices, grad_weights, grad_areas = laplacian_energy_backward(
        grad_energy, vertices, *cotangent_laplacian(vertices, faces))
    _, face_edges = mesh.edges(faces)
    grad_triangles = (cotangents_backward(grad_weights[face_edges] / 2, vertices[faces])
                      + areas_backward(grad_areas, vertices[faces], faces))
    return grad_vertices + scatter(grad_triangles, faces, len(vertices))


def smooth_explicit(x, edges, weights, mass, step):
    """Eq. (5): smooth x (V, C) by one step s -> x' (V, C).

    edges (E, 2), weights (E,). mass (V,) is the diagonal of M. A vertex of mass 0 stays.

    >>> x, edges = np.array([[0.0], [4.0], [10.0]]), np.array([[0, 1], [1, 2]])
    >>> smooth_explicit(x, edges, np.ones(2), np.array([1.0, 2.0, 1.0]), 0.5)[:, 0]
    array([2. , 4.5, 7. ])
    """
    return x - step * per_mass(laplacian(edges, weights, len(x)) @ x, mass)


def smooth_implicit(x, edges, weights, mass, step):  # exercise 13.8 (3 points)
    """Eq. (6) with the parameters of `smooth_explicit`, by `spsolve` -> x' (V, C), also for C = 1.

    `laplacian` gives L. See `demo smoothed`.

    >>> x, mass = np.array([[0.0], [3.0]]), np.array([1.0, 2.0])
    >>> smooth_implicit(x, np.array([[0, 1]]), np.ones(1), mass, 2.0)
    array([[1.5 ],
           [2.25]])

    Fine print. A vertex of mass 0 moves as (6) says. If it has no edge, it stays: its row is all 0,
    so the matrix has no inverse.
    """
    raise NotImplementedError("exercise 13.8: smooth_implicit")


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """Taubin 1995, which keeps the size: in each round eq. (5) with s = shrink, then s = -grow.

    x (V, C) -> (V, C), with 0 < shrink < grow.

    >>> x, edges = np.array([[0.0], [4.0], [10.0]]), np.array([[0, 1], [1, 2]])
    >>> smooth_taubin(x, edges, np.ones(2), np.array([1.0, 2.0, 1.0]), 0.5, 1.0, 1)[:, 0]
    array([-0.5,  4.5,  9.5])
    """
    for _ in range(rounds):
        x = smooth_explicit(x, edges, weights, mass, shrink)
        x = smooth_explicit(x, edges, weights, mass, -grow)
    return x


def enclosed_volume(triangles):
    """Eq. (7): the volume that triangles (F, 3, 3) enclose, positive if they are counter-clockwise
    seen from outside. For an open surface, it is the volume between it and the origin.

    >>> enclosed_volume(np.array([[[3.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]]]))
    np.float64(1.0)
    """
    x0, x1, x2 = triangles.swapaxes(0, 1)
    return (x0 * np.cross(x1, x2)).sum() / 6


def restore_volume(vertices, faces, volume):  # extra 13.9 (3 points)
    """Eq. (7): a closed surface that has got smaller gets its volume back -> vertices (V, 3).

    vertices (V, 3), faces (F, 3). Do this five times: move all vertices along the gradient of their
    volume by as much as would be right if the volume were linear. `enclosed_volume` is given.

    >>> vertices = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    >>> faces = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
    >>> enclosed_volume(vertices[faces]).round(6), restore_volume(vertices, faces, 9.0)[0].round(6)
    (np.float64(2.666667), array([1.5, 1.5, 1.5]))
    """
    for _ in range(5):  # Newton's steps: each about squares the share that is missing
        corners = vertices[faces]
        # A determinant stays the same when its rows go round, so each corner is the first one once.
        by_corner = np.cross(np.roll(corners, -1, 1), np.roll(corners, -2, 1)) / 6
        direction = scatter(by_corner, faces, len(vertices))
        missing = volume - enclosed_volume(corners)
        vertices = vertices + missing / (direction**2).sum() * direction
    return vertices


def precondition(x, edges, weights, amount):
    """Eq. (10): (I + lambda L)^-1 x, which is (6) for M = I: x (V, C) -> (V, C), spread out."""
    return smooth_implicit(x, edges, weights, np.ones(len(x)), amount)


def uniform_adam_step(x, grad_x, mean, square, step, rate, constants=(0.9, 0.999, 1e-8)):
    """Lab 9's `adam_step` at one rate, that of the largest square: it keeps grad_x's direction."""
    beta_1, beta_2, epsilon = constants
    mean = beta_1 * mean + (1 - beta_1) * grad_x
    square = beta_2 * square + (1 - beta_2) * grad_x**2
    steepest = np.sqrt(square.max(initial=0) / (1 - beta_2**step)) + epsilon
    return x - rate * mean / (1 - beta_1**step) / steepest, mean, square


def large_step(x, grad_x, mean, square, step, rate, system):  # exercise 13.13 (4 points)
    """Eq. (10): go downhill in u instead of x, by `uniform_adam_step` -> the new x, mean, square.

    x, grad_x (V, C). mean, square (V, C), step and rate belong to u. system: edges (E, 2), weights
    (E,) and lambda >= 0. See `demo large_steps`.

    >>> x, grad_x, zero = np.array([[0.0], [0.0]]), np.array([[0.0], [3.0]]), np.zeros((2, 1))
    >>> system = np.array([[0, 1]]), np.ones(1), 1.0
    >>> x, *_ = large_step(x, grad_x, zero, zero, 1, 2.0, system)
    >>> x[:, 0].round(6)  # grad_u = (1, 2), u moves by (-1, -2), and x by a third of (-4, -5)
    array([-1.333333, -1.666667])
    """
    raise NotImplementedError("exercise 13.13: large_step")
