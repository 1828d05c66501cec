"""Regularization: round triangles, smooth surfaces, and gradients that move a surface as a whole.

    q = 2 r / R                      radii of a triangle's inscribed, circumscribed circle   (1)
    (L x)_i = sum_j w_ij (x_i - x_j)                 Laplacian, over the edges at vertex i   (2)
    w_ij = 1    or    w_ij = (cot alpha + cot beta) / 2             uniform, or cotangents   (3)
    E = sum_i |(L x)_i|^2 / m_i                                           Laplacian energy   (4)
    x' = x - s M^-1 L x                            explicit smoothing: a step of diffusion   (5)
    (M + s L) x' = M x                             implicit smoothing: stable for any s      (6)
    6 volume = sum x_0 . (x_1 x x_2)                      tetrahedra from the origin         (7)
    u = (I + lambda L) x,   grad_u = (I + lambda L)^-1 grad_x    large steps                (10)

Equations (8) and (9) are in `remeshing.py`. alpha and beta lie opposite to the edge in its two
faces. M is diagonal: m_i is a valence with uniform weights, an area with cotangents. Lab 9's
Laplacian is M^-1 L x with w = 1 and m = valence. Edges (E, 2) and face_edges (F, 3) are those of
`mesh.edges`: no face may name a vertex twice.
Sources: GAMES101; Pinkall and Polthier 1993 (3), Desbrun 1999 (6), Taubin 1995, Nicolet 2021 (10).
"""
import numpy as np
import scipy.sparse
from scipy.sparse.linalg import spsolve

from course.given import mesh

from .rasterization import scatter

NO_AREA = 1e-12  # twice a face's area over its longest side squared: up to this it has none


def sides(triangles):
    """From each corner k of triangles (..., 3, 3) to corner k + 1, and to k + 2, modulo 3."""
    return np.roll(triangles, -1, -2) - triangles, np.roll(triangles, -2, -2) - triangles


def area_vectors(triangles):
    """A normal as long as twice the area, for each of triangles (..., 3, 3): (..., 3)."""
    a, b, c = np.moveaxis(triangles, -2, 0)
    return np.cross(b - a, c - a)


def twice_areas(triangles):
    """Twice the area of triangles (..., 3, 3): (...), also of a needle with all its digits.

    |p x q| is the same at every corner. Between the two shortest sides, the fewest digits cancel.
    """
    p, q = sides(triangles)
    corner = (p**2 + q**2).sum(-1).argmin(-1, keepdims=True)
    return np.take_along_axis(np.linalg.norm(np.cross(p, q), axis=-1), corner, -1)[..., 0]


def corner_angles(triangles):  # exercise 13.1 (2 points)
    """The angle at each corner, from 0 to pi: triangles (..., 3, 3) -> (..., 3), in radians.

    Its tangent is twice the area over p . q, where p and q are the sides at the corner. At a corner
    that coincides with another one, the angle is 0.

    Fine print. Every angle is right to 1e-14. Between two long sides, an angle of 1e-9 is right to
    a relative 1e-9: `twice_areas` has the digits, and the cross product of the two has lost half.

    >>> corner_angles(np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]])).round(6)
    array([1.570796, 0.785398, 0.785398])
    """
    raise NotImplementedError("exercise 13.1: corner_angles")


def radius_ratio(triangles):  # exercise 13.2 (2 points)
    """Eq. (1): triangles (..., 3, 3) -> q (...), 1 for an equilateral one, 0 for one without area.

    >>> radius_ratio(np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]])).round(9)
    np.float64(0.8)
    """
    raise NotImplementedError("exercise 13.2: radius_ratio")


def cotangents(triangles):  # exercise 13.3 (2 points)
    """The cotangent of the angle at each corner: triangles (..., 3, 3) -> (..., 3).

    Where twice the area is at most NO_AREA times the longest side squared, all three are 0: such a
    triangle takes no part in anything.

    >>> cotangents(np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0]]))
    array([0. , 2. , 0.5])
    """
    raise NotImplementedError("exercise 13.3: cotangents")


def cotangents_backward(grad_cotangents, triangles):  # exercise 13.4 (4 points)
    """Backward of `cotangents`: grad_cotangents (..., 3) -> grad_triangles (..., 3, 3),
    0 for a triangle whose cotangents are set to 0.

    >>> triangle = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    >>> cotangents_backward(np.array([0.0, 1.0, 0.0]), triangle)  # x_1 / y_2 if the rest stays
    array([[ 0.  ,  1.25,  0.  ],
           [ 0.5 , -0.25,  0.  ],
           [-0.5 , -1.  ,  0.  ]])
    """
    raise NotImplementedError("exercise 13.4: cotangents_backward")


def cotangent_weights(cotangents, face_edges, edge_count):  # exercise 13.5 (2 points)
    """Eq. (3): the cotangents (F, 3) of all faces' corners -> weight of each edge (edge_count,).

    An edge of one face has half of one cotangent, and an edge of three faces half of three. Where
    gamma + delta > pi, eq. (8), a weight is negative.

    >>> cotangent_weights(np.array([[1.0, 2.0, 3.0], [5.0, 7.0, 9.0]]),
    ...                   np.array([[0, 1, 2], [3, 2, 4]]), 5)
    array([0.5, 1. , 5. , 2.5, 4.5])
    """
    raise NotImplementedError("exercise 13.5: cotangent_weights")


def unit(vectors):
    """Vectors (..., 3) of length 1, in the same directions; (0, 0, 0) stays."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length > 0, length, 1)


def vertex_areas(triangles, faces, vertex_count):
    """M with cotangents, a third of all areas at each vertex: triangles (F, 3, 3) -> areas (V,)."""
    twice_area = np.linalg.norm(area_vectors(triangles), axis=-1, keepdims=True)
    return scatter(np.broadcast_to(twice_area / 6, faces.shape), faces, vertex_count)


def vertex_areas_backward(grad_areas, triangles, faces):
    """Backward of `vertex_areas`: grad_areas (V,) -> grad_triangles (F, 3, 3)."""
    # As in `cotangents_backward`, 2 A grows by n x (q_k - p_k) with corner k.
    p, q = sides(triangles)
    normal = unit(area_vectors(triangles))[:, None]
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
    raise NotImplementedError("exercise 13.6: laplacian_entries")


def laplacian(edges, weights, vertex_count):
    """The Laplacian of eq. (2) as a sparse matrix (V, V). It is symmetric, its rows sum to 0, and
    x . L x >= 0 for weights >= 0 and for cotangents.
    """
    rows, columns, values = laplacian_entries(edges, weights, vertex_count)
    return scipy.sparse.csc_array((values, (rows, columns)), shape=(vertex_count, vertex_count))


def cotangent_laplacian(vertices, faces):
    """L and M of a surface, by its own shape: edges (E, 2), weights (E,) and areas (V,)."""
    edges, face_edges = mesh.edges(faces)
    weights = cotangent_weights(cotangents(vertices[faces]), face_edges, len(edges))
    return edges, weights, vertex_areas(vertices[faces], faces, len(vertices))


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
    raise NotImplementedError("exercise 13.7: laplacian_energy")


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):  # exercise 13.8 (4 points)
    """Backward of eq. (4): grad_energy, a number -> grad_x (V, C), grad_weights (E,),
    grad_mass (V,), which is 0 where the mass is 0.

    >>> x, edges = np.array([[1.0], [2.0], [4.0]]), np.array([[0, 1], [1, 2]])
    >>> grad_x, grad_weights, grad_mass = laplacian_energy_backward(
    ...     0.5, x, edges, np.ones(2), np.array([1.0, 2.0, 4.0]))
    >>> grad_x[:, 0], grad_weights, grad_mass
    (array([-0.5, -0.5,  1. ]), array([0.5, 2. ]), array([-0.5  , -0.125, -0.125]))
    """
    raise NotImplementedError("exercise 13.8: laplacian_energy_backward")


def bending_energy(vertices, faces):
    """Eq. (4) of a surface's own vertices, with its own cotangents and areas -> a number.

    On a fine mesh |L x| is 2 (mean curvature) (area of the vertex), and the energy comes near the
    integral of 4 (mean curvature)^2: 16 pi for every sphere, more for all else that is closed.
    """
    return laplacian_energy(vertices, *cotangent_laplacian(vertices, faces))


def bending_energy_backward(grad_energy, vertices, faces):
    """Backward of `bending_energy`, through weights and areas, too -> grad_vertices (V, 3)."""
    # A vertex moves L x itself, and by its triangles the weights and the areas around it.
    grad_vertices, grad_weights, grad_areas = laplacian_energy_backward(
        grad_energy, vertices, *cotangent_laplacian(vertices, faces))
    _, face_edges = mesh.edges(faces)
    grad_triangles = (cotangents_backward(grad_weights[face_edges] / 2, vertices[faces])
                      + vertex_areas_backward(grad_areas, vertices[faces], faces))
    return grad_vertices + scatter(grad_triangles, faces, len(vertices))


def smooth_explicit(x, edges, weights, mass, step):  # exercise 13.9 (2 points)
    """Eq. (5): x (V, C) -> x' (V, C); s is the step, the diagonal of M is the mass (V,).

    A vertex of mass 0 stays where it is. With uniform weights and the valences as mass, a step of 1
    puts each vertex at the mean of its neighbours, and a longer one may be unstable.

    >>> x, edges = np.array([[0.0], [4.0], [10.0], [7.0]]), np.array([[0, 1], [1, 2]])
    >>> smooth_explicit(x, edges, np.ones(2), np.array([1.0, 2.0, 1.0, 0.0]), 0.5)[:, 0]
    array([2. , 4.5, 7. , 7. ])
    """
    raise NotImplementedError("exercise 13.9: smooth_explicit")


def smooth_implicit(x, edges, weights, mass, step):  # exercise 13.10 (3 points)
    """Eq. (6): x (V, C) -> x' (V, C), by one sparse solve.

    mass (V,); a vertex of mass 0 belongs to no edge of a weight other than 0, and stays.

    >>> x = np.array([[0.0], [3.0], [7.0]])
    >>> smooth_implicit(x, np.array([[0, 1]]), np.ones(1), np.array([1.0, 2.0, 0.0]), 2.0)[:, 0]
    array([1.5 , 2.25, 7.  ])
    """
    raise NotImplementedError("exercise 13.10: smooth_implicit")


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):  # exercise 13.11 (2 points)
    """Smoothing that keeps the size: in each round eq. (5) by shrink, then the other way by grow.

    x (V, C) -> (V, C). 0 < shrink < grow: what is slow grows a little, and what is fast shrinks.

    >>> x, edges = np.array([[0.0], [4.0], [10.0]]), np.array([[0, 1], [1, 2]])
    >>> smooth_taubin(x, edges, np.ones(2), np.array([1.0, 2.0, 1.0]), 0.5, 1.0, 1)[:, 0]
    array([-0.5,  4.5,  9.5])
    """
    raise NotImplementedError("exercise 13.11: smooth_taubin")


def enclosed_volume(triangles):  # exercise 13.12 (1 point)
    """Eq. (7): what triangles (F, 3, 3) enclose, a number; positive if all are counter-clockwise
    seen from outside. For an open surface, it is the volume between it and the origin.

    >>> enclosed_volume(np.array([[[3.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]]]))
    np.float64(1.0)
    """
    raise NotImplementedError("exercise 13.12: enclosed_volume")


def enclosed_volume_backward(grad_volume, triangles):  # exercise 13.13 (2 points)
    """Backward of eq. (7): grad_volume, a number -> grad_triangles (F, 3, 3).

    >>> triangle = np.array([[3.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]])
    >>> enclosed_volume_backward(6.0, triangle[None])
    array([[[2., 0., 0.],
            [0., 3., 0.],
            [0., 0., 6.]]])
    """
    raise NotImplementedError("exercise 13.13: enclosed_volume_backward")


def restore_volume(vertices, faces, volume):
    """The vertices (V, 3), moved along their volume's gradient to a wanted volume not far away."""
    for _ in range(5):  # Newton's steps: after three the rest is rounding
        missing = volume - enclosed_volume(vertices[faces])
        direction = scatter(enclosed_volume_backward(1.0, vertices[faces]), faces, len(vertices))
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


def large_step(x, grad_x, mean, square, step, rate,  # exercise 13.16 (4 points)
               edges, weights, amount):
    """Eq. (10): downhill in u instead of x, with `uniform_adam_step` -> x, mean, square after it.

    x, grad_x (V, C). mean, square (V, C) and step are those of grad_u, and the rate is that of u.
    edges (E, 2), weights (E,) >= 0. The amount is lambda >= 0.

    >>> x, grad_x, zero = np.array([[0.0], [0.0]]), np.array([[0.0], [3.0]]), np.zeros((2, 1))
    >>> x, *_ = large_step(x, grad_x, zero, zero, 1, 2.0, np.array([[0, 1]]), np.ones(1), 1.0)
    >>> x[:, 0].round(6)  # grad_u = (1, 2), u goes by (-1, -2), and x by a third of (-4, -5)
    array([-1.333333, -1.666667])
    """
    raise NotImplementedError("exercise 13.16: large_step")
