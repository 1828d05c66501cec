"""Implicit surfaces: one object as a signed distance, as a volume of density, and as a mesh.

    s(p) < 0 inside, > 0 outside, |s(p)| is the distance to the surface     signed distance      (1)
    |s(p) - s(q)| <= L |p - q|, for a distance L = 1                        Lipschitz condition  (2)
    min(a, b) - k h^2 / 4,   h = max(1 - |a - b| / k, 0)                    smooth union         (3)
    t' = t + s(o + t d) / L                       along a ray o + t d       sphere tracing       (4)
    w_i = T_i (1 - exp(-sigma_i delta_i)),   T_i = exp(-sum_(j<i) sigma_j delta_j)               (5)
    C = sum_i w_i c_i + T_end background          colour of a ray           volume rendering     (6)
    sigma = exp(-s / beta) / (2 beta) outside, (1 - exp(s / beta) / 2) / beta inside             (7)
    p = (p_a s_b - p_b s_a) / (s_b - s_a)         s_a < 0 <= s_b            marching tetrahedra  (8)

sigma is the density of a sample i, delta the length of ray that it stands for, c its colour.
A shape is a tuple, and may hold other shapes:

    ("sphere", radius)   ("box", half_size)   ("torus", radius, tube)   ("moved", offset, shape)
    ("union", shape, shape)    ("intersection", shape, shape)    ("complement", shape)
    ("smooth union", k, shape, shape)    ("rippled", height, frequency, shape)

Gradients go to points, densities, colours and distances; a shape's own numbers are given.

Sources: lecture "Differentiable graphics 1"; Hart 1996 (2), (4); Quilez 2013 (3); Max 1995 and
Mildenhall et al. 2020 (5), (6); Yariv et al. 2021 (7); Doi and Koide 1991, Shen et al. 2021 (8).
"""
import itertools

import numpy as np
import scipy.sparse

from . import pipeline

CHUNK = 1 << 17  # samples of a volume in flight at once

# --- signed distances: eq. (1) to (3) -----------------------------------------------------------


def sphere(points, radius):
    """Eq. (1) of a sphere around the origin: points (..., 3) -> distance (...)."""
    return np.linalg.norm(points, axis=-1) - radius


def sphere_backward(grad_distance, points, radius):
    """Backward of `sphere`: grad_distance (...) -> grad_points (..., 3); 0 at the centre."""
    return grad_distance[..., None] * unit(points)


def unit(vectors):
    """vectors (..., 3) divided by their length; 0 stays 0."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length > 0, length, 1)


def box(points, half_size):  # exercise 15.1 (2 points)
    """Eq. (1) of a box around the origin, its sides along the axes: points (..., 3) -> (...).

    half_size (3,), positive: the box goes from -half_size to half_size. Outside, the nearest point
    may lie on a side, on an edge or on a corner; inside, it is on the nearest of the six sides.

    >>> box(np.array([[4.0, 6.0, 0.0], [0.0, 1.0, -2.5]]), np.array([1.0, 2.0, 3.0]))
    array([ 5. , -0.5])
    """
    beyond = np.abs(points) - half_size
    return np.linalg.norm(np.maximum(beyond, 0), axis=-1) + np.minimum(beyond.max(-1), 0)


def box_backward(grad_distance, points, half_size):  # exercise 15.2 (2 points)
    """Backward of `box`: grad_distance (...) -> grad_points (..., 3).

    Outside, the distance grows fastest straight away from the nearest point of the box. Inside and
    on the surface it does toward the nearest side, and only along that axis; of equally near ones,
    take the first axis, and of two opposite sides, the positive one.

    >>> points = np.array([[4.0, 6.0, 0.0], [0.0, 1.0, -2.5]])
    >>> box_backward(np.array([10.0, 7.0]), points, np.array([1.0, 2.0, 3.0]))
    array([[ 6.,  8.,  0.],
           [ 0.,  0., -7.]])
    """
    beyond = np.abs(points) - half_size
    outward = np.where(points < 0, -1.0, 1.0)
    nearest_side = np.arange(3) == beyond.argmax(-1)[..., None]
    is_outside = beyond.max(-1, keepdims=True) > 0
    slope = np.where(is_outside, unit(np.maximum(beyond, 0)), nearest_side)
    return grad_distance[..., None] * outward * slope


def torus(points, radius, tube):  # exercise 15.3 (1 point)
    """Eq. (1) of a ring around the y axis: points (..., 3) -> distance (...).

    The ring is all that is nearer than tube to a circle of this radius around the origin in the
    plane y = 0; 0 < tube < radius.

    >>> torus(np.array([[0.0, 4.0, 8.0], [3.0, 0.5, 4.0]]), 5.0, 1.0)
    array([ 4. , -0.5])
    """
    from_axis = np.hypot(points[..., 0], points[..., 2])
    return np.hypot(from_axis - radius, points[..., 1]) - tube


def torus_backward(grad_distance, points, radius, tube):  # exercise 15.4 (2 points)
    """Backward of `torus`: grad_distance (...) -> grad_points (..., 3).

    On the y axis, x and z get 0; on the circle in the middle of the tube all three do.

    >>> torus_backward(np.array([10.0]), np.array([[4.8, 4.0, 6.4]]), 5.0, 1.0).round(9)
    array([[3.6, 8. , 4.8]])
    """
    x, y, z = np.moveaxis(points, -1, 0)
    from_axis = np.hypot(x, z)
    from_circle = np.hypot(from_axis - radius, y)
    g = grad_distance / np.where(from_circle > 0, from_circle, 1)
    # By from_axis, and from there to x and z.
    g_axis = g * (from_axis - radius) / np.where(from_axis > 0, from_axis, 1)
    return np.stack([g_axis * x, g * y, g_axis * z], -1)


def union(a, b):
    """What belongs to one shape or the other: distances a, b (...) -> distance (...).

    Outside of both it is exact, if a and b are; inside, it can be nearer to 0 than the surface is.
    """
    return np.minimum(a, b)


def union_backward(grad_distance, a, b):
    """Backward of `union`: grad_distance (...) -> grad_a, grad_b; of equals, a gets all."""
    return np.where(a <= b, grad_distance, 0), np.where(a <= b, 0, grad_distance)


def intersection(a, b):
    """What belongs to both: the complement of the union of the complements. a, b (...) -> (...).

    Within both it is exact, if a and b are; outside, it can be nearer to 0 than the surface is.
    """
    return -union(-a, -b)


def intersection_backward(grad_distance, a, b):
    """Backward of `intersection`: grad_distance (...) -> grad_a, grad_b. Two signs cancel."""
    return union_backward(grad_distance, -a, -b)


def smooth_union(a, b, k):  # exercise 15.5 (1 point)
    """Eq. (3): a union whose seam is filled where |a - b| < k. a, b (...), number k > 0 -> (...).

    >>> smooth_union(np.array([1.0, 1.0, 5.0]), np.array([1.0, 2.0, 1.0]), 2.0)
    array([0.5  , 0.875, 1.   ])
    """
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return np.minimum(a, b) - k * h**2 / 4


def smooth_union_backward(grad_distance, a, b, k):  # exercise 15.6 (2 points)
    """Backward of eq. (3): grad_distance (...) -> grad_a, grad_b (...). k is given.

    Nothing jumps where a = b. The two shares are never negative, and their sum is grad_distance: so
    eq. (2) holds for the smooth union with L = 1, if it does for a and b.

    >>> a, b = np.array([1.0, 1.0, 5.0]), np.array([1.0, 2.0, 1.0])
    >>> smooth_union_backward(np.array([4.0, 4.0, 4.0]), a, b, 2.0)
    (array([2., 3., 0.]), array([2., 1., 4.]))
    """
    # d(k h^2 / 4) = h/2 k dh, and k h = k - |a - b|: the larger gets h/2, the smaller 1 - h/2.
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    share = np.where(a < b, 1 - h / 2, h / 2)
    return grad_distance * share, grad_distance * (1 - share)


def ripples(points, height, frequency):
    """Bumps and dents up to height: points (..., 3) -> (...). Their L is height * frequency."""
    return height * np.sin(frequency * points).prod(-1)


def ripples_backward(grad_ripples, points, height, frequency):
    """Backward of `ripples`: grad_ripples (...) -> grad_points (..., 3)."""
    sine, slope = np.sin(frequency * points), frequency * np.cos(frequency * points)
    others = np.roll(sine, 1, -1) * np.roll(sine, 2, -1)
    return (height * grad_ripples)[..., None] * slope * others


def signed_distance(points, shape):
    """The distance of points (..., 3) to a shape of the header -> (...).

    Often only a bound, see `union`; with ripples s / L is one, L = 1 + height * frequency.
    """
    def of(part):
        return signed_distance(points, part)

    match shape:
        case "sphere", radius:
            return sphere(points, radius)
        case "box", half_size:
            return box(points, half_size)
        case "torus", radius, tube:
            return torus(points, radius, tube)
        case "moved", offset, part:
            return signed_distance(points - offset, part)
        case "union", first, second:
            return union(of(first), of(second))
        case "intersection", first, second:
            return intersection(of(first), of(second))
        case "complement", part:
            return -of(part)
        case "smooth union", k, first, second:
            return smooth_union(of(first), of(second), k)
        case "rippled", height, frequency, part:
            return of(part) + ripples(points, height, frequency)
    raise unknown(shape)


def signed_distance_backward(grad_distance, points, shape):
    """Backward of `signed_distance`: grad_distance (...) -> grad_points (..., 3)."""
    def back(grad, part):
        return signed_distance_backward(grad, points, part)

    def of(part):
        return signed_distance(points, part)

    match shape:
        case "sphere", radius:
            return sphere_backward(grad_distance, points, radius)
        case "box", half_size:
            return box_backward(grad_distance, points, half_size)
        case "torus", radius, tube:
            return torus_backward(grad_distance, points, radius, tube)
        case "moved", offset, part:
            return signed_distance_backward(grad_distance, points - offset, part)
        case "complement", part:
            return -back(grad_distance, part)
        case "rippled", height, frequency, part:
            bumps = ripples_backward(grad_distance, points, height, frequency)
            return back(grad_distance, part) + bumps
        case "union", first, second:
            grads = union_backward(grad_distance, of(first), of(second))
        case "intersection", first, second:
            grads = intersection_backward(grad_distance, of(first), of(second))
        case "smooth union", k, first, second:
            grads = smooth_union_backward(grad_distance, of(first), of(second), k)
        case _:
            raise unknown(shape)
    return back(grads[0], first) + back(grads[1], second)


def unknown(shape):
    """The error for what is no shape, in one sentence."""
    return ValueError(f"there is no shape {shape!r}: give a tuple such as ('sphere', 1.0); the "
                      "header of implicit_surfaces lists them all")


def normals(points, shape):
    """Unit normals of the surface through each of points (..., 3): the gradient's direction."""
    return unit(signed_distance_backward(np.ones(points.shape[:-1]), points, shape))


# --- sphere tracing: eq. (4) --------------------------------------------------------------------


def camera_rays(clip_from_world, width, height):
    """The rays through the centres of all pixels, row by row, R = width * height.

    -> origins (R, 3) on the near plane, directions (R, 3) of unit length, world space.
    """
    y, x = (np.indices((height, width)).reshape(2, -1) + 0.5) * [[2 / height], [2 / width]] - 1
    ends = np.array([[x, y, 0 * x + depth, 1 + 0 * x] for depth in (-1, 1)]).swapaxes(1, 2)
    near, far = (end[:, :3] / end[:, 3:] for end in ends @ np.linalg.inv(clip_from_world).T)
    return near, unit(far - near)


def sphere_trace(origins, directions, shape, far,  # exercise 15.7 (4 points)
                 lipschitz=1.0, epsilon=1e-5, most=200):
    """Eq. (4): where do rays hit a shape? No point of it is nearer than s / L: so far one can go.

    origins (R, 3), directions (R, 3) of unit length, a shape of the header, four numbers > 0
    -> t (R,), evaluations (R,).

    Each ray begins at t = 0. Evaluate s by `signed_distance` at its present t. If s < epsilon, the
    ray has hit, and this t is its t. If not, go on by eq. (4), with L = lipschitz; beyond far, the
    ray has missed. So has a ray that did not hit in `most` evaluations. The t of a miss is np.inf.
    evaluations, integers: how many times s was evaluated for the ray. R may be 0.

    >>> origins = np.array([[0.0, 0.0, 5.0], [0.0, 3.0, 5.0]])
    >>> directions = np.array([[0.0, 0.0, -1.0], [0.0, 0.0, -1.0]])
    >>> sphere_trace(origins, directions, ("sphere", 2.0), far=4.0)
    (array([ 3., inf]), array([2, 2]))
    """
    t, evaluations = np.zeros(len(origins)), np.zeros(len(origins), int)
    hit, active = np.zeros(len(origins), bool), np.arange(len(origins))
    for _ in range(most):
        s = signed_distance(origins[active] + t[active, None] * directions[active], shape)
        evaluations[active] += 1
        hit[active[s < epsilon]] = True
        active, s = active[s >= epsilon], s[s >= epsilon]
        t[active] += s / lipschitz
        active = active[t[active] <= far]
    return np.where(hit, t, np.inf), evaluations


# --- volume rendering: eq. (5) to (7) -----------------------------------------------------------


def ray_weights(density, spacing):  # exercise 15.8 (2 points)
    """Eq. (5): how much each sample on a ray adds to its colour, and what light passes them all.

    density (R, N), not negative: sigma of N samples on each of R rays, from front to back; spacing
    (R, N): delta -> weights (R, N), remaining (R,), which is T_end, T behind the last sample. The
    sum of a ray's weights and its remaining is 1.

    >>> weights, remaining = ray_weights(np.log(2) * np.array([[1.0, 1, 0, 2]]), np.ones((1, 4)))
    >>> weights.round(9), remaining.round(9)
    (array([[0.5   , 0.25  , 0.    , 0.1875]]), array([0.0625]))
    """
    thickness = density * spacing
    passed = np.exp(-np.cumsum(thickness, -1))  # T behind each sample
    before = np.concatenate([np.ones_like(passed[:, :1]), passed[:, :-1]], -1)
    return before * -np.expm1(-thickness), passed[:, -1]


def volume_render(density, colour, spacing, background):
    """Eq. (6): density (R, N), colour (R, N, C), spacing (R, N), background (C,) -> (R, C)."""
    weights, remaining = ray_weights(density, spacing)
    return np.einsum("rn,rnc->rc", weights, colour) + remaining[:, None] * background


def volume_render_backward(grad_output, density, colour,  # exercise 15.9 (4 points)
                           spacing, background):
    """Backward of eq. (6): grad_output (R, C) -> grad_density (R, N), grad_colour (R, N, C).

    density, colour, spacing, background as in `volume_render`; the last two are given. A sample
    that becomes denser adds more of its own colour, and hides some of all that is behind it, the
    background included. It must hold where no light passes, as with a density of 1e9, and where a
    density is 0: divide by no weight and no T.

    >>> density, colour = np.log(2) * np.array([[1.0, 1.0]]), np.array([[[1.0], [4.0]]])
    >>> given = density, colour, np.ones((1, 2)), np.array([8.0])
    >>> grad_density, grad_colour = volume_render_backward(np.array([[100.0]]), *given)
    >>> grad_density.round(9), grad_colour.round(9)
    (array([[-250., -100.]]), array([[[50.],
            [25.]]]))
    """
    weights, remaining = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)  # the loss feels colours as these numbers
    # dw_i = T_(i+1) d(sigma_i delta_i), and all that is behind i shrinks by d(sigma_i delta_i).
    seen = np.concatenate([weights * along, (remaining * (grad_output @ background))[:, None]], -1)
    behind = np.cumsum(seen[:, :0:-1], -1)[:, ::-1]
    passed = np.exp(-np.cumsum(density * spacing, -1))
    return spacing * (passed * along - behind), weights[..., None] * grad_output[:, None]


def density_of(distance, beta):
    """Eq. (7): distance (...) -> density (...), from 1 / beta inside to 0, within a few beta."""
    half = np.exp(-np.abs(distance) / beta) / 2
    return np.where(distance > 0, half, 1 - half) / beta


def ray_samples(origins, directions, near, far, count):
    """The middles of count equal pieces of each ray, t from near to far.

    -> points (R, count, 3), spacing (R, count).
    """
    spacing = (far - near) / count
    t = near + spacing * (np.arange(count) + 0.5)
    return (origins[:, None] + t[:, None] * directions[:, None],
            np.full((len(origins), count), spacing))


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


# --- marching tetrahedra: eq. (8) ---------------------------------------------------------------


def tetrahedral_grid(n):
    """[-1, 1]^3 in n^3 cubes, each cut into 6 tetrahedra, which fit those of its neighbours.

    -> points ((n + 1)^3, 3), of which z changes fastest; tetrahedra (6 n^3, 4): vertex 3 sees
    vertices 0, 1, 2 counter-clockwise. Each way from a cube's lowest corner to its highest along
    three edges, one for each axis, has the four corners of a tetrahedron (Freudenthal 1942).
    """
    along = np.linspace(-1, 1, n + 1)
    points = np.stack(np.meshgrid(along, along, along, indexing="ij"), -1).reshape(-1, 3)
    number = np.arange((n + 1)**3).reshape(n + 1, n + 1, n + 1)
    lowest = number[:-1, :-1, :-1].reshape(-1, 1)
    tetrahedra = []
    for axes in itertools.permutations(range(3)):
        way = np.cumsum([0, *(number[tuple(np.eye(3, dtype=int)[axis])] for axis in axes)])
        if is_odd(axes):
            way[[1, 2]] = way[[2, 1]]
        tetrahedra.append(lowest + way)
    return points, np.stack(tetrahedra, 1).reshape(-1, 4)


def is_odd(order):
    """Do an odd number of swaps sort this order of 0, 1, 2, ...? Then it turns space over."""
    return np.linalg.det(np.eye(len(order))[list(order)]) < 0


def tetrahedron_triangles(inside):  # exercise 15.10 (4 points)
    """The surface in one tetrahedron: inside (4,) bool, of its vertices -> (K, 3, 2) integers.

    Vertex 3 sees vertices 0, 1, 2 counter-clockwise. Between a vertex inside and one outside, the
    surface crosses the edge: such a pair of vertices, the inside one first, is one corner of a
    triangle. The K = 0, 1 or 2 triangles (three or four edges are crossed, or none) are
    counter-clockwise seen from the side of the vertices outside. The order of the triangles, the
    corner that comes first, and the diagonal that cuts four corners into two triangles are free.

    Of the 16 cases, derive all from 1, 2 or 3 vertices inside: an even permutation of the four
    vertices, as (1, 2, 0, 3) or (1, 0, 3, 2), is a turn of the tetrahedron, and changes nothing
    else; `is_odd` tells which are not even.

    >>> tetrahedron_triangles(np.array([True, False, False, False])).tolist()
    [[[0, 1], [0, 2], [0, 3]]]
    """
    count, order = inside.sum(), np.argsort(~inside, kind="stable")  # those inside come first
    if is_odd(order):  # swap two that are on the same side
        swapped = [0, 1] if count > 1 else [2, 3]
        order[swapped] = order[swapped[::-1]]
    a, b, c, d = order
    around = {1: [(a, b), (a, c), (a, d)],
              2: [(a, c), (a, d), (b, d), (b, c)],
              3: [(a, d), (b, d), (c, d)]}.get(count, [])
    fan = [(around[0], *pair) for pair in itertools.pairwise(around[1:])]
    return np.array(fan, int).reshape(-1, 3, 2)


def crossing(p_a, p_b, s_a, s_b):  # exercise 15.11 (1 point)
    """Eq. (8): the point between p_a and p_b where the distance is 0, if it is linear.

    p_a, p_b (E, 3), s_a, s_b (E,), s_a < 0 <= s_b -> p (E, 3).

    >>> p_a, p_b = np.array([[0.0, 0.0, 8.0]]), np.array([[4.0, 0.0, 0.0]])
    >>> crossing(p_a, p_b, np.array([-1.0]), np.array([3.0]))
    array([[1., 0., 6.]])
    """
    return (p_a * s_b[:, None] - p_b * s_a[:, None]) / (s_b - s_a)[:, None]


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):  # exercise 15.12 (2 points)
    """Backward of eq. (8): grad_p (E, 3) -> grad_p_a, grad_p_b (E, 3), grad_s_a, grad_s_b (E,).

    >>> p_a, p_b = np.array([[0.0, 0.0, 8.0]]), np.array([[4.0, 0.0, 0.0]])
    >>> crossing_backward(np.array([[16.0, 0, 0]]), p_a, p_b, np.array([-1.0]), np.array([3.0]))
    (array([[12.,  0.,  0.]]), array([[4., 0., 0.]]), array([-12.]), array([-4.]))
    """
    # p = (1 - t) p_a + t p_b with t = s_a / (s_a - s_b): dt/ds_a = -s_b / (s_a - s_b)^2.
    t, span = (s_a / (s_a - s_b))[:, None], s_b - s_a
    grad_t = (grad_p * (p_b - p_a)).sum(-1)
    return (1 - t) * grad_p, t * grad_p, -grad_t * s_b / span**2, grad_t * s_a / span**2


def marching_tetrahedra(points, distance, tetrahedra):  # exercise 15.13 (3 points)
    """The surface of all tetrahedra as a mesh: vertices (V, 3), integers faces (F, 3), ends (V, 2).

    points (G, 3), distance (G,); tetrahedra (T, 4) integers, vertex 3 sees 0, 1, 2
    counter-clockwise. T may be a million: loop over the 16 cases, not over the tetrahedra. A point
    is inside where its distance is < 0; so 0 is outside. Then vertices may be at one place and
    faces have no area; they stay.
    Each tetrahedron has its `tetrahedron_triangles`, whose corners are points of eq. (8); where
    tetrahedra share an edge they share its point. ends: the two points of the grid on whose edge
    a vertex lies, the inside one first; each crossed edge once, sorted by the first, then by the
    second. The order of the faces and their first corner are free. No surface: V = F = 0.

    >>> points = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]])
    >>> distance, tetrahedra = np.array([2.0, -1.0, 1.0, 2.0]), np.array([[0, 1, 2, 3]])
    >>> vertices, faces, ends = marching_tetrahedra(points, distance, tetrahedra)
    >>> vertices.tolist(), ends.tolist()
    ([[2.0, 0.0, 0.0], [1.5, 1.5, 0.0], [2.0, 0.0, 1.0]], [[1, 0], [1, 2], [1, 3]])
    """
    inside = distance < 0
    case = inside[tetrahedra] @ np.array([1, 2, 4, 8], np.uint8)
    crossed = (0 < case) & (case < 15)
    tetrahedra, case = tetrahedra[crossed], case[crossed]
    corners = [np.empty((0, 3, 2), int)]
    for number in range(1, 15):
        triangles = tetrahedron_triangles(number >> np.arange(4) & 1 == 1)
        corners.append(tetrahedra[case == number][:, triangles].reshape(-1, 3, 2))
    edge = np.concatenate(corners) @ np.array([len(points), 1])
    edge, faces = np.unique(edge, return_inverse=True)
    a, b = ends = np.divmod(edge, len(points))
    vertices = crossing(points[a], points[b], distance[a], distance[b])
    return vertices, faces.reshape(-1, 3), np.stack(ends, -1)


def marching_tetrahedra_backward(grad_vertices, ends, points, distance):
    """Backward of `marching_tetrahedra`, which gave ends: which edges are crossed is held.

    grad_vertices (V, 3) -> grad_points (G, 3), grad_distance (G,).
    """
    a, b = ends.T
    grad_a, grad_b, *grad_s = crossing_backward(grad_vertices, points[a], points[b],
                                                distance[a], distance[b])
    at, grads = ends.T.ravel(), np.concatenate([grad_a, grad_b])
    grad_points = np.stack([np.bincount(at, g, len(points)) for g in grads.T], -1)
    return grad_points, np.bincount(at, np.concatenate(grad_s), len(points))


# --- one object, three representations ----------------------------------------------------------


def lit(normals, light, colour):
    """Normals (..., 3) and the direction to a light (3,) -> colours (..., 3).

    Full where they agree, a quarter at right angles, black only straight away from the light.
    """
    return (0.5 + 0.5 * normals @ unit(light))[..., None]**2 * colour


def render_distance(shape, clip_from_world, width, height, light, colour, background, far=20.0,
                    lipschitz=1.0):
    """A shape by sphere tracing: picture (height, width, 3), evaluations (height, width).

    far is along the ray, from the camera's near plane on.
    """
    origins, directions = camera_rays(clip_from_world, width, height)
    t, evaluations = sphere_trace(origins, directions, shape, far, lipschitz, most=1000)
    picture, seen = np.tile(background, (len(t), 1)), np.isfinite(t)
    points = origins[seen] + t[seen, None] * directions[seen]
    picture[seen] = lit(normals(points, shape), light, colour)
    return picture.reshape(height, width, 3), evaluations.reshape(height, width)


def render_volume(shape, clip_from_world, width, height, light, colour, background, near, far,
                  beta=0.01, count=128):
    """A shape as a volume of eq. (7), count samples on each ray: picture (height, width, 3).

    near and far are along the ray, from the camera's near plane on. Pieces longer than beta fray
    the edges. Samples of a weight up to 1e-6 are seen by nobody, and left black.
    """
    origins, directions = camera_rays(clip_from_world, width, height)
    picture = np.empty((len(origins), 3))
    for rays in np.array_split(np.arange(len(origins)), -(-len(origins) * count // CHUNK)):
        points, spacing = ray_samples(origins[rays], directions[rays], near, far, count)
        density = density_of(signed_distance(points, shape), beta)
        seen, colours = ray_weights(density, spacing)[0] > 1e-6, np.zeros(points.shape)
        colours[seen] = lit(normals(points[seen], shape), light, colour)
        picture[rays] = volume_render(density, colours, spacing, background)
    return picture.reshape(height, width, 3)


def render_mesh(shape, clip_from_world, width, height, light, colour, background, n=64):
    """A shape as a mesh, marched on n^3 cells and rendered: picture (height, width, 3).

    What reaches beyond [-1, 1]^3 is cut open.
    """
    points, tetrahedra = tetrahedral_grid(n)
    vertices, faces, _ = marching_tetrahedra(points, signed_distance(points, shape), tetrahedra)
    colours = lit(normals(vertices, shape), light, colour)
    view = pipeline.View(clip_from_world, width, height, background)
    mesh = pipeline.make_mesh(vertices, faces)
    return pipeline.render(mesh, pipeline.Colours(colours), view)[0]
