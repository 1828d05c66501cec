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

from course.given.arrays import scatter


def tetrahedral_grid(n):
    """[-1, 1]^3 in n^3 cubes, each cut into 6 tetrahedra, which fit those of its neighbours.

    -> points ((n + 1)^3, 3), of which z changes fastest, and tetrahedra (6 n^3, 4): vertex 3 sees
    vertices 0, 1, 2 counter-clockwise. Each path from a cube's lowest corner to its highest along
    three edges, one for each axis, has the four corners of a tetrahedron.
    """
    return grid_points(n), tetrahedra_of(np.arange(n**3), n)


def grid_points(n):
    """The points of `tetrahedral_grid` alone, ((n + 1)^3, 3)."""
    axis = np.linspace(-1, 1, n + 1)
    return np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)


def tetrahedra_of(cubes, n):
    """The tetrahedra of some cubes of `tetrahedral_grid`: cubes (C,), numbers -> (6 C, 4)."""
    step = np.array([(n + 1)**2, n + 1, 1])  # from a point to the next one along x, y, z
    lowest = np.stack(np.unravel_index(cubes, (n, n, n)), -1) @ step
    paths = []
    for axes in itertools.permutations(range(3)):
        path = np.cumsum([0, *step[list(axes)]])
        if is_odd(axes):
            path[[1, 2]] = path[[2, 1]]
        paths.append(path)
    return (lowest[:, None, None] + np.array(paths)).reshape(-1, 4)


def is_odd(order):
    """Does an odd number of swaps sort this order of 0, 1, 2, ...? Then it turns space over."""
    return np.linalg.det(np.eye(len(order))[list(order)]) < 0


def grid_weights(points, n):
    """Trilinear look-ups in a grid of (n + 1)^3 numbers over [-1, 1]^3, as a sparse matrix.

    points (P, 3) -> W (P, (n + 1)^3): W @ grid are the numbers at the points, 0 beyond the grid
    and at NaN, and W.T @ grad is the backward pass. The grid's order is that of `tetrahedral_grid`.
    """
    place = (points + 1) * (n / 2)
    inside = ((place >= 0) & (place <= n)).all(-1)
    place = np.where(inside[:, None], place, 0)
    low = np.minimum(np.floor(place), n - 1).astype(int)
    part = place - low
    x, y, z = np.stack([1 - part, part], -1).swapaxes(0, 1)  # (P, 2): of the lower, of the upper
    weights = np.einsum("p,pi,pj,pk->pijk", inside, x, y, z)
    step = np.array([(n + 1)**2, n + 1, 1])
    corners = (low @ step)[:, None] + np.indices((2, 2, 2)).reshape(3, 8).T @ step
    entries = weights.ravel(), corners.ravel(), np.arange(0, corners.size + 1, 8)
    return scipy.sparse.csr_array(entries, shape=(len(points), (n + 1)**3))


def tetrahedron_triangles(inside):  # step 15.7
    """The surface in one tetrahedron: inside (4,) bool, of its vertices -> triangles (K, 3, 2).

    Each corner is an edge, a vertex inside and one outside. Seen from the vertices outside, it is
    counter-clockwise, as 0, 1, 2 are, seen from 3. An order of the four that `is_odd` mirrors.

    >>> tetrahedron_triangles(np.array([True, False, False, False])).tolist()
    [[[0, 1], [0, 2], [0, 3]]]

    Fine print. Without a surface it is an array (0, 3, 2). The order of the triangles, the corner
    that comes first and the diagonal between two triangles are free.
    """
    count = inside.sum()
    order = np.argsort(~inside, kind="stable")  # those inside come first
    if is_odd(order):  # swap two that are on the same side
        swapped = [0, 1] if count > 1 else [2, 3]
        order[swapped] = order[swapped[::-1]]
    a, b, c, d = order
    around = {1: [(a, b), (a, c), (a, d)],
              2: [(a, c), (a, d), (b, d), (b, c)],
              3: [(a, d), (b, d), (c, d)]}.get(count, [])
    fan = [(around[0], *pair) for pair in itertools.pairwise(around[1:])]
    return np.array(fan, int).reshape(-1, 3, 2)


def zero_crossing(p_a, p_b, s_a, s_b):
    """Eq. (8): the point between p_a and p_b where the distance is 0, if it is linear.

    p_a, p_b (E, 3), s_a, s_b (E,) -> p (E, 3).

    >>> p_a, p_b = np.array([[0.0, 0.0, 8.0]]), np.array([[4.0, 0.0, 0.0]])
    >>> zero_crossing(p_a, p_b, np.array([-1.0]), np.array([3.0]))
    array([[1., 0., 6.]])
    """
    return (p_a * s_b[:, None] - p_b * s_a[:, None]) / (s_b - s_a)[:, None]


def marching_tetrahedra(points, distance, tetrahedra):  # exercise 15.8 (6 points)
    """The surface of all tetrahedra as a mesh -> vertices (V, 3), faces (F, 3), ends (V, 2).

    points (G, 3), distance (G,), tetrahedra (T, 4): 3 sees 0, 1, 2 counter-clockwise. From outside,
    faces are seen so. Each crossed edge has one vertex, its `zero_crossing`. ends are the edge's
    points, inside first, and vertices are sorted by them. Loop over the 16 cases, not over T. See
    `demo representations hole`.

    >>> points = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]])
    >>> distance, tetrahedra = np.array([2.0, -1.0, 1.0, 2.0]), np.array([[0, 1, 2, 3]])
    >>> vertices, faces, ends = marching_tetrahedra(points, distance, tetrahedra)
    >>> vertices.tolist(), ends.tolist()
    ([[2.0, 0.0, 0.0], [1.5, 1.5, 0.0], [2.0, 0.0, 1.0]], [[1, 0], [1, 2], [1, 3]])

    Fine print. A distance of 0 is outside. Then vertices may be at one place and faces have no
    area. They stay, so that the mesh is closed. Without a surface V = F = 0. The order of the faces
    and their first corner are free.
    """
    inside = distance < 0
    case = inside[tetrahedra] @ np.array([1, 2, 4, 8], np.uint8)
    crossed = (0 < case) & (case < 15)
    tetrahedra, case = tetrahedra[crossed], case[crossed]
    corners = [np.empty((0, 3, 2), int)]
    for number in range(1, 15):
        triangles = tetrahedron_triangles((number >> np.arange(4)) & 1 == 1)
        corners.append(tetrahedra[case == number][:, triangles].reshape(-1, 3, 2))
    edge = np.concatenate(corners) @ np.array([len(points), 1], np.int64)
    edge, faces = np.unique(edge, return_inverse=True)
    a, b = np.stack(np.divmod(edge, len(points))).astype(np.intp)
    vertices = zero_crossing(points[a], points[b], distance[a], distance[b])
    return vertices, faces.reshape(-1, 3), np.stack([a, b], -1)


def zero_crossing_backward(grad_p, p_a, p_b, s_a, s_b):  # step 15.9
    """Backward of eq. (8), `zero_crossing`: grad_p (E, 3) -> grad_p_a, grad_p_b (E, 3), grad_s_a,
    grad_s_b (E,).

    >>> p_a, p_b = np.array([[0.0, 0.0, 8.0]]), np.array([[4.0, 0.0, 0.0]])
    >>> s_a, s_b = np.array([-1.0]), np.array([3.0])
    >>> zero_crossing_backward(np.array([[16.0, 0, 0]]), p_a, p_b, s_a, s_b)
    (array([[12.,  0.,  0.]]), array([[4., 0., 0.]]), array([-12.]), array([-4.]))
    """
    # p = (1 - t) p_a + t p_b with t = s_a / (s_a - s_b): dt/ds_a = -s_b / (s_a - s_b)^2.
    t = (s_a / (s_a - s_b))[:, None]
    span = s_b - s_a
    grad_t = (grad_p * (p_b - p_a)).sum(-1)
    return (1 - t) * grad_p, t * grad_p, -grad_t * s_b / span**2, grad_t * s_a / span**2


def marching_tetrahedra_backward(grad_vertices, ends, points,  # exercise 15.10 (2 points)
                                 distance):
    """Backward of `marching_tetrahedra`: grad_vertices (V, 3) -> grad_points (G, 3), grad_distance
    (G,).

    ends (V, 2) are held: vertex v lies between the points ends[v]. A point sums what all of its
    vertices have for it, by `scatter(values, index, count)`. See `demo hole`.

    >>> points, distance = np.diag([0.0, 4.0, 8.0]), np.array([3.0, -1.0, 1.0])
    >>> grad_vertices, ends = np.array([[0.0, 4, 0], [0, 2, 0]]), np.array([[1, 0], [1, 2]])
    >>> marching_tetrahedra_backward(grad_vertices, ends, points, distance)
    (array([[0., 1., 0.],
           [0., 4., 0.],
           [0., 1., 0.]]), array([1., 5., 2.]))
    """
    # A vertex gathers what it needs from its two ends, so its gradients are scattered to them.
    a, b = ends.T
    grad_a, grad_b, *grad_s = zero_crossing_backward(grad_vertices, points[a], points[b],
                                                     distance[a], distance[b])
    both_ends = np.concatenate([a, b])
    grad_points = scatter(np.concatenate([grad_a, grad_b]), both_ends, len(points))
    return grad_points, scatter(np.concatenate(grad_s), both_ends, len(points))
