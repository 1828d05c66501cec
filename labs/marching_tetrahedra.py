"""Marching tetrahedra: a mesh out of signed distances, and the gradient that comes back through it.

    p = (p_a s_b - p_b s_a) / (s_b - s_a)         s_a < 0 <= s_b            marching tetrahedra  (8)

Each point of a grid has a distance s, each cell of the grid is cut into tetrahedra, and within a
tetrahedron s is linear. Where it is 0 there is a triangle or two: their corners are the points p of
eq. (8) on the edges that are crossed. Which edges are crossed is a decision without a gradient. The
gradient of p goes to the distances and to the points.

Sources: Doi and Koide 1991 and Shen et al. 2021 (8), Freudenthal 1942 (the grid).
"""
import itertools

import numpy as np
import scipy.sparse

from .rasterization import scatter


def tetrahedral_grid(n):
    """[-1, 1]^3 in n^3 cubes, each cut into 6 tetrahedra, which fit those of its neighbours.

    -> points ((n + 1)^3, 3), of which z changes fastest, and tetrahedra (6 n^3, 4): vertex 3 sees
    vertices 0, 1, 2 counter-clockwise. Each path from a cube's lowest corner to its highest along
    three edges, one for each axis, has the four corners of a tetrahedron.
    """
    axis = np.linspace(-1, 1, n + 1)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
    number = np.arange((n + 1)**3).reshape(n + 1, n + 1, n + 1)
    lowest = number[:-1, :-1, :-1].reshape(-1, 1)
    tetrahedra = []
    step = np.array([(n + 1)**2, n + 1, 1])  # from a point to the next one along x, y, z
    for axes in itertools.permutations(range(3)):
        path = np.cumsum([0, *step[list(axes)]])
        if is_odd(axes):
            path[[1, 2]] = path[[2, 1]]
        tetrahedra.append(lowest + path)
    return points, np.stack(tetrahedra, 1).reshape(-1, 4)


def is_odd(order):
    """Do an odd number of swaps sort this order of 0, 1, 2, ...? Then it turns space over."""
    return np.linalg.det(np.eye(len(order))[list(order)]) < 0


def grid_weights(points, n):
    """Trilinear look-ups in a grid of (n + 1)^3 numbers over [-1, 1]^3, as a sparse matrix.

    points (P, 3) -> W (P, (n + 1)^3): W @ grid are the numbers at the points, 0 beyond the grid,
    and W.T @ grad is the backward pass. The grid's order is that of `tetrahedral_grid`.
    """
    place = (points + 1) * (n / 2)
    inside = ((place >= 0) & (place <= n)).all(-1)
    low = np.clip(np.floor(place), 0, n - 1).astype(int)
    part = place - low
    x, y, z = np.stack([1 - part, part], -1).swapaxes(0, 1)  # (P, 2): of the lower, of the upper
    weights = np.einsum("p,pi,pj,pk->pijk", inside, x, y, z)
    step = np.array([(n + 1)**2, n + 1, 1])
    corners = (low @ step)[:, None] + np.indices((2, 2, 2)).reshape(3, 8).T @ step
    entries = weights.ravel(), corners.ravel(), np.arange(0, corners.size + 1, 8)
    return scipy.sparse.csr_array(entries, shape=(len(points), (n + 1)**3))


def tetrahedron_triangles(inside):  # exercise 15.10 (4 points)
    """The surface in one tetrahedron: inside (4,) bool, of its vertices -> (K, 3, 2) integers.

    Vertex 3 sees vertices 0, 1, 2 counter-clockwise. Between a vertex inside and one outside, the
    surface crosses the edge: such a pair of vertices, the inside one first, is one corner of a
    triangle. The K = 0, 1 or 2 triangles (three or four edges are crossed, or none) are
    counter-clockwise seen from the side of the vertices outside. The order of the triangles, the
    corner that comes first, and the diagonal that cuts four corners into two triangles are free.

    Of the 16 cases, derive all from 1, 2 or 3 vertices inside: an even permutation of the four
    vertices, as (1, 2, 0, 3) or (1, 0, 3, 2), is a turn of the tetrahedron, and changes nothing
    else. `is_odd` tells which are not even.

    >>> tetrahedron_triangles(np.array([True, False, False, False])).tolist()
    [[[0, 1], [0, 2], [0, 3]]]
    """
    raise NotImplementedError("exercise 15.10: tetrahedron_triangles")


def crossing(p_a, p_b, s_a, s_b):  # exercise 15.11 (1 point)
    """Eq. (8): the point between p_a and p_b where the distance is 0, if it is linear.

    p_a, p_b (E, 3), s_a, s_b (E,), s_a < 0 <= s_b -> p (E, 3).

    >>> p_a, p_b = np.array([[0.0, 0.0, 8.0]]), np.array([[4.0, 0.0, 0.0]])
    >>> crossing(p_a, p_b, np.array([-1.0]), np.array([3.0]))
    array([[1., 0., 6.]])
    """
    raise NotImplementedError("exercise 15.11: crossing")


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):  # exercise 15.12 (2 points)
    """Backward of eq. (8): grad_p (E, 3) -> grad_p_a, grad_p_b (E, 3), grad_s_a, grad_s_b (E,).

    >>> p_a, p_b = np.array([[0.0, 0.0, 8.0]]), np.array([[4.0, 0.0, 0.0]])
    >>> crossing_backward(np.array([[16.0, 0, 0]]), p_a, p_b, np.array([-1.0]), np.array([3.0]))
    (array([[12.,  0.,  0.]]), array([[4., 0., 0.]]), array([-12.]), array([-4.]))
    """
    raise NotImplementedError("exercise 15.12: crossing_backward")


def marching_tetrahedra(points, distance, tetrahedra):  # exercise 15.13 (3 points)
    """The surface of all tetrahedra as a mesh: vertices (V, 3), integers faces (F, 3), ends (V, 2).

    points (G, 3), distance (G,), and tetrahedra (T, 4), integers: vertex 3 sees 0, 1, 2
    counter-clockwise. T may be a million: loop over the 16 cases, not over the tetrahedra. A point
    is inside where its distance is < 0, so 0 is outside. Then vertices may be at one place and
    faces have no area. They stay.
    Each tetrahedron has its `tetrahedron_triangles`, whose corners are points of eq. (8). Where
    tetrahedra share an edge they share its point. ends: the two points of the grid on whose edge
    a vertex lies, the inside one first. Each crossed edge comes once, sorted by the first, then by
    the second. The order of the faces and their first corner are free. No surface: V = F = 0.

    >>> points = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]])
    >>> distance, tetrahedra = np.array([2.0, -1.0, 1.0, 2.0]), np.array([[0, 1, 2, 3]])
    >>> vertices, faces, ends = marching_tetrahedra(points, distance, tetrahedra)
    >>> vertices.tolist(), ends.tolist()
    ([[2.0, 0.0, 0.0], [1.5, 1.5, 0.0], [2.0, 0.0, 1.0]], [[1, 0], [1, 2], [1, 3]])
    """
    raise NotImplementedError("exercise 15.13: marching_tetrahedra")


def marching_tetrahedra_backward(grad_vertices, ends, points, distance):
    """Backward of `marching_tetrahedra`, which gave ends: which edges are crossed is held.

    grad_vertices (V, 3) -> grad_points (G, 3), grad_distance (G,).
    """
    # A vertex gathers what it needs from its two ends, so its gradients are scattered to them.
    a, b = ends.T
    grad_a, grad_b, *grad_s = crossing_backward(grad_vertices, points[a], points[b],
                                                distance[a], distance[b])
    both_ends = np.concatenate([a, b])
    grad_points = scatter(np.concatenate([grad_a, grad_b]), both_ends, len(points))
    return grad_points, scatter(np.concatenate(grad_s), both_ends, len(points))
