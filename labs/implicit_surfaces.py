"""Implicit surfaces: one object as a signed distance, and as a volume of density.

    s(p) < 0 inside, > 0 outside, |s(p)| is the distance to the surface     signed distance      (1)
    |s(p) - s(q)| <= L |p - q|, for a distance L = 1                        Lipschitz condition  (2)
    min(a, b) - k h^2 / 4,   h = max(1 - |a - b| / k, 0)                    smooth union         (3)
    t' = t + s(o + t d) / L                       along a ray o + t d       sphere tracing       (4)
    w_i = T_i (1 - exp(-sigma_i delta_i)),   T_i = exp(-sum_(j<i) sigma_j delta_j)               (5)
    C = sum_i w_i c_i + T_end background          colour of a ray           volume rendering     (6)
    sigma = exp(-s / beta) / (2 beta) outside, (1 - exp(s / beta) / 2) / beta inside             (7)

Sample i has density sigma_i and colour c_i, and stands for the length delta_i of the ray.
A shape is a tuple, and may hold other shapes:

    ("sphere", radius)   ("box", half_size)   ("torus", radius, tube)   ("moved", offset, shape)
    ("union", shape, shape)    ("intersection", shape, shape)    ("complement", shape)
    ("smooth union", k, shape, shape)    ("rippled", height, frequency, shape)

Sources: lecture "Differentiable graphics 1", Hart 1996 (2) and (4), Quilez 2013 (3), Max 1995 and
Mildenhall et al. 2020 (5) and (6), Yariv et al. 2021 (7).
"""
import numpy as np

from course.given.arrays import largest
from course.given.mesh import length, unit

# --- signed distances: eq. (1) to (3) -----------------------------------------------------------


def sphere(points, radius):
    """Eq. (1) of a sphere around the origin: points (..., 3) -> distance (...)."""
    return length(points) - radius


def sphere_backward(grad_distance, points, radius):
    """Backward of `sphere`: grad_distance (...) -> grad_points (..., 3), 0 at the centre."""
    return grad_distance[..., None] * unit(points)


def box(points, half_size):
    """Eq. (1) of a box from -half_size to half_size: points (..., 3) -> distance (...).

    Outside, the nearest point may be on a side, an edge or a corner. Inside, the nearest side
    counts.

    >>> box(np.array([[4.0, 6.0, 0.0], [0.0, 1.0, -2.5]]), np.array([1.0, 2.0, 3.0]))
    array([ 5. , -0.5])
    """
    beyond = np.abs(points) - half_size
    return length(np.maximum(beyond, 0)) + np.minimum(largest(beyond), 0)


def box_backward(grad_distance, points, half_size):  # extra 15.1 (2 points)
    """Backward of `box`: grad_distance (...) -> grad_points (..., 3).

    Outside, the distance grows fastest straight away from the nearest point of the box. Inside, it
    grows toward the nearest side, and only along that axis.

    >>> points = np.array([[4.0, 6.0, 0.0], [0.0, 1.0, -2.5]])
    >>> box_backward(np.array([10.0, 7.0]), points, np.array([1.0, 2.0, 3.0]))
    array([[ 6.,  8.,  0.],
           [ 0.,  0., -7.]])

    Fine print. On the surface it is as inside. Of equally near sides take that of the first axis,
    and the positive one of two opposite sides: a normal has length 1 everywhere.
    """
    # Outside s = |max(beyond, 0)|, which grows along this vector. Inside s is the largest beyond.
    beyond = np.abs(points) - half_size
    outward = np.where(points < 0, -1.0, 1.0)
    nearest_side = np.arange(3) == beyond.argmax(-1)[..., None]
    is_outside = largest(beyond)[..., None] > 0
    slope = np.where(is_outside, unit(np.maximum(beyond, 0)), nearest_side)
    return grad_distance[..., None] * outward * slope


def torus(points, radius, tube):
    """Eq. (1) of a ring around the y axis: points (..., 3) -> distance (...).

    The ring is all that is nearer than tube to a circle of this radius around the origin, in the
    plane y = 0.
    """
    from_axis = np.hypot(points[..., 0], points[..., 2])
    return np.hypot(from_axis - radius, points[..., 1]) - tube


def torus_backward(grad_distance, points, radius, tube):  # extra 15.2 (2 points)
    """Backward of `torus`: grad_distance (...) -> grad_points (..., 3).

    >>> torus_backward(np.array([10.0]), np.array([[4.8, 4.0, 6.4]]), 5.0, 1.0).round(9)
    array([[3.6, 8. , 4.8]])

    Fine print. Where no direction is the nearest one, none is taken: on the y axis x and z get 0,
    and on the circle in the middle of the tube all three do. One nan would end a fit.
    """
    # s = hypot(u, y) - tube with u = hypot(x, z) - radius. The gradient of a hypot is the unit
    # vector: ds/dy = y / hypot(u, y), ds/du = u / hypot(u, y), and from u on to x and z.
    x, y, z = np.moveaxis(points, -1, 0)
    from_axis = np.hypot(x, z)
    from_circle = np.hypot(from_axis - radius, y)
    g = grad_distance / np.where(from_circle > 0, from_circle, 1)
    g_axis = g * (from_axis - radius) / np.where(from_axis > 0, from_axis, 1)
    return np.stack([g_axis * x, g * y, g_axis * z], -1)


def union(a, b):
    """What belongs to one shape or the other: distances a, b (...) -> distance (...).

    Outside both it is exact, if a and b are. Inside, it can be nearer to 0 than the surface is.
    """
    return np.minimum(a, b)


def union_backward(grad_distance, a, b):
    """Backward of `union`: grad_distance (...) -> grad_a, grad_b. If a = b, a gets all."""
    return np.where(a <= b, grad_distance, 0), np.where(a <= b, 0, grad_distance)


def intersection(a, b):
    """What belongs to both: the complement of the union of the complements. a, b (...) -> (...).

    Within both it is exact, if a and b are. Outside, it can be nearer to 0 than the surface is.
    """
    return -union(-a, -b)


def intersection_backward(grad_distance, a, b):
    """Backward of `intersection`: grad_distance (...) -> grad_a, grad_b. Two signs cancel."""
    return union_backward(grad_distance, -a, -b)


def smooth_union(a, b, k):
    """Eq. (3): a union whose seam is filled where |a - b| < k. a, b (...), k > 0 -> (...)."""
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return np.minimum(a, b) - k * h**2 / 4


def smooth_union_backward(grad_distance, a, b, k):
    """Backward of eq. (3): grad_distance (...) -> grad_a, grad_b (...).

    The two shares are never negative, and their sum is grad_distance. So eq. (2) holds for the
    smooth union with L = 1, if it does for a and b.
    """
    # d(k h^2 / 4) = h/2 d(k h), and k h = k - |a - b|: the larger gets h/2, the smaller 1 - h/2.
    # Both are 1/2 + (b - a) / (2 k) for a, as far as that lies between 0 and 1.
    share = np.clip((1 + (b - a) / k) / 2, 0, 1)
    return grad_distance * share, grad_distance * (1 - share)


def ripples(points, height, frequency):
    """Bumps and dents up to height: points (..., 3) -> (...). Their L is height * frequency."""
    return height * np.sin(frequency * points).prod(-1)


def ripples_backward(grad_ripples, points, height, frequency):
    """Backward of `ripples`: grad_ripples (...) -> grad_points (..., 3)."""
    # The product rule: the slope of one sine, times the other two.
    sine = np.sin(frequency * points)
    slope = frequency * np.cos(frequency * points)
    others = np.roll(sine, 1, -1) * np.roll(sine, 2, -1)
    return (height * grad_ripples)[..., None] * slope * others


def signed_distance(points, shape):
    """The distance of points (..., 3) to a shape of the header -> (...).

    Often it is only a bound, see `union`. With ripples s / L is one, L = 1 + height * frequency.
    ValueError, in one sentence, for what is no shape.
    """
    match shape:
        case "moved", offset, part:
            return signed_distance(points - offset, part)
        case "complement", part:
            return -signed_distance(points, part)
        case "rippled", height, frequency, part:
            return signed_distance(points, part) + ripples(points, height, frequency)
        case "union" | "intersection" | "smooth union", *_, first, second:
            joined, _, numbers = formula(shape)
            return joined(signed_distance(points, first), signed_distance(points, second), *numbers)
    distance, _, numbers = formula(shape)
    return distance(points, *numbers)


def signed_distance_backward(grad_distance, points, shape):
    """Backward of `signed_distance`: grad_distance (...) -> grad_points (..., 3)."""
    # The chain rule: an offset or a term passes the gradient on, a minus turns it round, and two
    # parts share it, so that their gradients with respect to the points add up.
    match shape:
        case "moved", offset, part:
            return signed_distance_backward(grad_distance, points - offset, part)
        case "complement", part:
            return signed_distance_backward(-grad_distance, points, part)
        case "rippled", height, frequency, part:
            return (signed_distance_backward(grad_distance, points, part)
                    + ripples_backward(grad_distance, points, height, frequency))
        case "union" | "intersection" | "smooth union", *_, first, second:
            _, backward, numbers = formula(shape)
            grad_a, grad_b = backward(grad_distance, signed_distance(points, first),
                                      signed_distance(points, second), *numbers)
            return (signed_distance_backward(grad_a, points, first)
                    + signed_distance_backward(grad_b, points, second))
    _, backward, numbers = formula(shape)
    return backward(grad_distance, points, *numbers)


def formula(shape):
    """What gives a shape's distance, from points or from the distances a, b of its two parts:
    a function, its backward pass, and the numbers that both take last.
    """
    match shape:
        case "sphere", radius:
            return sphere, sphere_backward, [radius]
        case "box", half_size:
            return box, box_backward, [half_size]
        case "torus", radius, tube:
            return torus, torus_backward, [radius, tube]
        case "union", _, _:
            return union, union_backward, []
        case "intersection", _, _:
            return intersection, intersection_backward, []
        case "smooth union", k, _, _:
            return smooth_union, smooth_union_backward, [k]
    raise ValueError(f"there is no shape {shape!r}: give a tuple such as ('sphere', 1.0); the "
                     "header of implicit_surfaces lists them all")


def normals(points, shape):
    """Unit normals of the surface through each of points (..., 3): the gradient's direction."""
    return unit(signed_distance_backward(np.ones(points.shape[:-1]), points, shape))


# --- sphere tracing: eq. (4) --------------------------------------------------------------------


def camera_rays(clip_from_world, width, height):
    """The rays through the centres of all pixels, row by row, R = width * height.

    -> origins (R, 3) on the near plane, directions (R, 3) of unit length, world space.
    """
    sides = np.maximum([[height], [width]], 1.0)  # 1 where there are no pixels
    y, x = (np.indices((height, width)).reshape(2, -1) + 0.5) * (2 / sides) - 1
    ends = np.stack(np.broadcast_arrays(x, y, [[-1], [1]], 1), -1)  # in clip space: near, far
    near, far = (end[:, :3] / end[:, 3:] for end in ends @ np.linalg.inv(clip_from_world).T)
    return near, unit(far - near)


def sphere_trace(origins, directions, shape, far,  # exercise 15.3 (3 points)
                 lipschitz=1.0, epsilon=1e-5, most=200):
    """Eq. (4): where does each ray hit a shape? -> t, evaluations (R,)

    origins, directions (R, 3). A ray starts at t = 0, hits where s, the `signed_distance`, is less
    than epsilon, and misses, t = np.inf, if t > far or after `most` evaluations. Count each ray's.

    >>> origins = np.array([[0.0, 0.0, 5.0], [0.0, 3.0, 5.0]])
    >>> directions = np.array([[0.0, 0.0, -1.0], [0.0, 0.0, -1.0]])
    >>> sphere_trace(origins, directions, ("sphere", 2.0), far=4.0)
    (array([ 3., inf]), array([2, 2]))
    """
    raise NotImplementedError("exercise 15.3: sphere_trace")


# --- volume rendering: eq. (5) to (7) -----------------------------------------------------------


def ray_weights(density, spacing):  # step 15.4
    """Eq. (5): the weights of all samples on their rays, and the light that passes them all.

    density, spacing (R, N) -> weights (R, N), T_end (R,).

    >>> weights, remaining = ray_weights(np.log(2) * np.array([[1.0, 1, 0, 2]]), np.ones((1, 4)))
    >>> weights.round(9), remaining.round(9)
    (array([[0.5   , 0.25  , 0.    , 0.1875]]), array([0.0625]))

    Fine print. A sum of all terms less the last one loses what lies in front of a dense wall: 0.3 +
    1e17 - 1e17 is 0. Sum only what is needed.
    """
    raise NotImplementedError("exercise 15.4: ray_weights")


def volume_render(density, colour, spacing, background):  # step 15.5
    """Eqs. (5) and (6): the colours (R, C) of R rays, each cut into N pieces.

    density, spacing (R, N), colour (R, N, C), background (C,). Sample 0 is the nearest. See
    `demo representations`.

    >>> density, colour = np.log(2) * np.array([[1.0, 1.0]]), np.array([[[1.0], [4.0]]])
    >>> volume_render(density, colour, np.ones((1, 2)), np.array([8.0])).round(9)
    array([[3.5]])
    """
    raise NotImplementedError("exercise 15.5: volume_render")


def volume_render_backward(grad_output, density, colour,  # exercise 15.6 (6 points)
                           spacing, background):
    """Backward of eq. (6): grad_output (R, C) -> grad_density (R, N), grad_colour (R, N, C).

    The other inputs are those of `volume_render`. Lecture 15 has dC / dtau of one sample, tau =
    density times spacing.

    >>> density, colour = np.log(2) * np.array([[1.0, 1.0]]), np.array([[[1.0], [4.0]]])
    >>> given = density, colour, np.ones((1, 2)), np.array([8.0])
    >>> grad_density, grad_colour = volume_render_backward(np.array([[100.0]]), *given)
    >>> grad_density.round(9), grad_colour.round(9)
    (array([[-250., -100.]]), array([[[50.],
            [25.]]]))

    Fine print. Walls, which let no light pass, and empty space have gradients, too. So divide by no
    weight and no T.
    """
    raise NotImplementedError("exercise 15.6: volume_render_backward")


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
