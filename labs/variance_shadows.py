"""Variance shadows: a shadow that changes smoothly, and its gradient to the light's position.

A comparison is a step, and so is a mean of comparisons. Instead, the map holds two moments in each
texel, which may be blurred. Distances, lights and eqs. (1) to (7) are those of `shadow_mapping`.

    E = blur of (stored, stored^2),   variance = max(E_1 - E_0^2, least_variance)            (8)
    lit share = variance / (variance + (distance - E_0)^2) beyond E_0, else 1                (9)
    E' = (d - move_z, (d - move_z)^2) - sum over its borders of shift / 2 (E_b - E_a)       (10)

(10) is a texel before the blur, E = (d, d^2), when all points move in the light's frame. At each of
its borders are two texels, b to the right of a or above it, and the surface in front takes the
border along by shift texels. The light moves without turning, so all points move alike: those that
receive the shadow, and by (10) all that the map shows. The fit finds the light by both.

Source: Donnelly and Lauritzen 2006 (8), (9).
"""
import numbers
from typing import NamedTuple

import numpy as np

from . import inverse_rendering, lights, mipmapping, shadow_mapping

PAIRS = ((0, np.s_[:, :-1], np.s_[:, 1:]),  # neighbours in x: the left ones, the right ones
         (1, np.s_[:-1], np.s_[1:]))        # in y: the lower ones, the upper ones


class Settings(NamedTuple):
    """How a variance shadow is made.

    size: rows and columns of the map. radius of the blur: an integer, in texels. least_variance,
    > 0: this shadow's bias, in squares of the world's unit, about (a thousandth of the scene)^2.
    """

    size: int
    radius: int
    least_variance: float


class ShadowBuffers(NamedTuple):
    """What was found on the way to a variance shadow, which the way back needs.

    distance_map (S, S), its moments (S, S, 2), and of each point q (N, 3) and uv (N, 2) on the
    map.
    """

    distance_map: np.ndarray
    moments: np.ndarray
    q: np.ndarray
    uv: np.ndarray


def window_sums(picture, radius):
    """Sums over squares: of the pixels up to radius rows and columns away -> (H, W, C).

    picture (H, W, C), radius an integer >= 0. Squares end at the picture's border.

    >>> window_sums(np.array([[[1.0], [2.0], [4.0], [8.0]]]), 1)[..., 0]
    array([[ 3.,  7., 14., 12.]])
    """
    for axis in 0, 1:
        n = picture.shape[axis]
        running = np.insert(np.cumsum(picture, axis), 0, 0.0, axis)
        first = np.maximum(np.arange(n) - radius, 0)
        end = np.minimum(np.arange(n) + radius + 1, n)
        picture = running.take(end, axis) - running.take(first, axis)
    return picture


def box_blur(picture, radius):
    """The mean over the squares of `window_sums`: picture (H, W, C) -> (H, W, C).

    At the border it is the mean of the pixels that there are.

    >>> box_blur(np.array([[[1.0], [2.0], [6.0], [10.0]]]), 1)[..., 0]
    array([[1.5, 3. , 6. , 8. ]])
    """
    return window_sums(picture, radius) / window_sums(np.ones((*picture.shape[:2], 1)), radius)


def box_blur_backward(grad_output, radius):
    """Backward of `box_blur`: grad_output (H, W, C) -> grad_picture (H, W, C)."""
    # A box filter's sums are their own transpose: pixel j is in the square around i where i is in
    # the square around j. Each mean was divided by the number of pixels in its own square.
    count = window_sums(np.ones((*grad_output.shape[:2], 1)), radius)
    return window_sums(grad_output / count, radius)


def lit_by_moments(moments, uv, distance, radius,  # exercise 14.9 (2 points)
                   least_variance):
    """Eqs. (8) and (9): the largest share of the light that can come to the receivers -> (N,).

    moments (H, W, 2): each texel's distance and its square. `box_blur` them by radius, and read
    them at uv (N, 2) by `mipmapping.texture`, boundary="clamp". distance (N,). Unless 0 <= u < 1
    and 0 <= v < 1, all is lit.

    >>> moments, distance = np.array([[[1.0, 1.0], [3.0, 9.0]]]), np.array([3.0, 3.0, 2.0, 9.0])
    >>> uv = np.array([[0.5, 0.5], [0.3, 0.5], [0.5, 0.5], [1.0, 0.5]])
    >>> lit_by_moments(moments, uv, distance, 0, 0.1).round(9)
    array([0.5, 0.1, 1. , 1. ])
    """
    raise NotImplementedError("exercise 14.9: lit_by_moments")


def lit_by_moments_backward(grad_lit, moments, uv, distance,  # exercise 14.10 (4 points)
                            radius, least_variance):
    """Backward of `lit_by_moments`: grad_lit (N,) -> grad_moments (H, W, 2), grad_uv (N, 2),
    grad_distance (N,).

    Where the variance is floored, it is a constant. `box_blur_backward` is given,
    `mipmapping.texture_backward` returns grad_image, then grad_uv. See `demo light_from_shadow`.

    >>> moments, uv = np.array([[[1.0, 1.0], [3.0, 9.0]]]), np.array([[0.5, 0.5]])
    >>> lit_by_moments_backward(np.ones(1), moments, uv, np.array([3.0]), 0, 0.1)
    (array([[[-0.25 ,  0.125],
            [-0.25 ,  0.125]]]), array([[2., 0.]]), array([-0.5]))
    """
    raise NotImplementedError("exercise 14.10: lit_by_moments_backward")


def map_motion(distance_map, clip_from_light):
    """How far does the content of each texel move on the map when all points move by dq?

    distance_map (H, W), finite -> motion (H, W, 2, 3): the derivatives of eq. (2), x and y in
    texels, with respect to q, for the point at the texel's centre and distance. C is as there.

    >>> C = np.array([[2.0, 0, 0, 0], [0, 4, 0, 0], [0, 0, -3, -4], [0, 0, -1, 0]])
    >>> map_motion(np.array([[4.0, 2.0, 4.0]]), C)[0, 2] + 0.0
    array([[0.75, 0.  , 0.25],
           [0.  , 0.5 , 0.  ]])
    """
    height, width = distance_map.shape
    w = clip_from_light[3, 3] - clip_from_light[3, 2] * distance_map
    motion = np.zeros((height, width, 2, 3))
    # x - width / 2 = C_00 width / 2 q_x / w, so dx / dq_z = -(x - width / 2) C_32 / w.
    motion[..., 0, 0] = clip_from_light[0, 0] * (width / 2) / w
    motion[..., 1, 1] = clip_from_light[1, 1] * (height / 2) / w
    from_middle = np.arange(width) + 0.5 - width / 2, np.arange(height)[:, None] + 0.5 - height / 2
    for axis in 0, 1:
        motion[..., axis, 2] = -from_middle[axis] * clip_from_light[3, 2] / w
    return motion


def moments_of(distance_map):
    """Eq. (8) before the blur: distance_map (H, W) -> the distance and its square (H, W, 2)."""
    distance_map = np.asarray(distance_map, float)
    return np.stack([distance_map, distance_map**2], -1)


def moved_moments(distance_map, motion, move):  # extra 14.11 (4 points)
    """Eq. (10): the moments (H, W, 2) of a map when all points have moved by move (3,).

    distance_map d (H, W), motion (H, W, 2, 3). E_a and E_b are d and d^2 before the move. At a
    border in x (or y), shift is x (or y) of motion @ move where d is smaller.

    >>> C = np.diag([1.0, 1.0, -1.0, 1.0])
    >>> distance_map = np.array([[2.0, 2.0, 3.0]])
    >>> motion = map_motion(distance_map, C)                        # 1.5 texels to the unit of q_x
    >>> moved_moments(distance_map, motion, np.array([0.2, 0.0, 0.0]))[0]
    array([[2.  , 4.  ],
           [1.85, 3.25],
           [2.85, 8.25]])
    """
    moments = moments_of(distance_map)
    moved = moments_of(distance_map - move[2])
    for axis, a, b in PAIRS:
        speed = motion[..., axis, :] @ move
        shift = np.where(distance_map[a] <= distance_map[b], speed[a], speed[b])
        change = shift[..., None] / 2 * (moments[b] - moments[a])
        moved[a] -= change
        moved[b] -= change
    return moved


def moved_moments_backward(grad_moments, distance_map, motion, move):  # extra 14.12 (4 points)
    """Backward of `moved_moments` with respect to move: grad_moments (H, W, 2) -> grad_move (3,).

    distance_map and motion are held.

    >>> C = np.diag([1.0, 1.0, -1.0, 1.0])
    >>> distance_map = np.array([[2.0, 2.0, 3.0]])
    >>> grad_moments = np.array([[[0.0, 0.0], [4.0, 0.0], [0.0, 1.0]]])
    >>> motion = map_motion(distance_map, C)
    >>> moved_moments_backward(grad_moments, distance_map, motion, np.zeros(3)) + 0.0
    array([ -6.75,   0.  , -10.  ])
    """
    # moved = moments_of(d - move_z) - shift / 2 (moments[b] - moments[a]) at a and at b, and shift
    # = motion @ move of the texel in front.
    moments = moments_of(distance_map)
    grad_distance = grad_moments[..., 0] + 2 * (distance_map - move[2]) * grad_moments[..., 1]
    grad_move = np.array([0.0, 0.0, -grad_distance.sum()])
    for axis, a, b in PAIRS:
        grad_change = -(grad_moments[a] + grad_moments[b])
        grad_shift = (grad_change * (moments[b] - moments[a])).sum(-1) / 2
        in_front = (distance_map[a] <= distance_map[b])[..., None]
        by_move = np.where(in_front, motion[..., axis, :][a], motion[..., axis, :][b])
        grad_move += (grad_shift[..., None] * by_move).sum((0, 1))
    return grad_move


# --- a shadow with a gradient -----------------------------------------------------------------


def closed_map(vertices, faces, light, size):
    """`depth_map` with the far plane's distance where the light sees nothing: (size, size)."""
    distance_map = shadow_mapping.depth_map(vertices, faces, light, size)
    far = shadow_mapping.distance_of_depth(np.ones(1), light.clip_from_light)
    return np.where(np.isfinite(distance_map), distance_map, far)


def variance_shadow(points, vertices, faces, light, settings):
    """Eqs. (8) and (9): the lit share of points (N, 3) -> (N,), and ShadowBuffers for its backward.

    The map of moments is blurred over (2 radius + 1)^2 texels, and read bilinearly. Points outside
    the map are lit. ValueError for what does not fit.
    """
    require_settings(settings)
    size, radius, least_variance = settings
    distance_map = closed_map(vertices, faces, light, size)
    moments = moments_of(distance_map)
    q = shadow_mapping.before_light(points, light)
    place = shadow_mapping.map_position(q, light.clip_from_light, size, size)
    uv = np.ascontiguousarray(place) / size
    lit = lit_by_moments(moments, uv, -q[:, 2], radius, least_variance)
    return lit, ShadowBuffers(distance_map, moments, q, uv)


def variance_shadow_backward(grad_lit, buffers, points, light, settings):
    """Backward of `variance_shadow` with respect to the light's position: grad_lit (N,) -> (3,).

    A texel of the map jumps when an edge passes its centre. (10) moves the edge evenly instead. So
    this is the slope of sums over many texels, and not of single ones. At a round body's rim, the
    texels' centres are nearer than the rim, and seem to move too far: this error falls with the
    root of the texel's size. In parallel light the gradient is 0 up to such errors: the shadow
    depends on the direction alone, and that is held.
    """
    # Two ways from q to the shadow, read upwards: the receivers' places and distances (9), (2), and
    # the moments of the map (10). When the light moves, all points of its frame move the other way.
    size, radius, least_variance = settings
    distance_map, moments, q, uv = buffers
    grad_moments, grad_uv, grad_distance = lit_by_moments_backward(
        grad_lit, moments, uv, -q[:, 2], radius, least_variance)
    grad_q = shadow_mapping.map_position_backward(grad_uv / size, q, light.clip_from_light, size,
                                                  size)
    grad_q[:, 2] -= grad_distance
    motion = map_motion(distance_map, light.clip_from_light)
    grad_move = moved_moments_backward(grad_moments, distance_map, motion, np.zeros(3))
    _, grad_position = shadow_mapping.to_light_backward(grad_q, points, light.position,
                                                        light.rotation)
    return grad_position - grad_move @ light.rotation


def position_loss(target, points, vertices, faces, light, settings):
    """The mean square error of a shadow against target (N,), and its gradient with respect to the
    light's position (3,). The other arguments are those of `variance_shadow`.
    """
    if np.shape(target) != (len(points),) or len(points) == 0:
        raise ValueError("position_loss expects a target (N,), one number for each point, and at "
                         f"least one point, got {np.shape(target)} for {len(points)} points; "
                         "give the shadow at the points")
    lit, buffers = variance_shadow(points, vertices, faces, light, settings)
    loss, grad_lit = inverse_rendering.squared_error(lit, target)
    return loss, variance_shadow_backward(grad_lit, buffers, points, light, settings)


def moved_light(light, move, vertices):
    """The point light after a move (3,), halved until `point_light` accepts the place."""
    for part in 0.5 ** np.arange(20):
        try:
            return lights.point_light(light.position + part * move, vertices)
        except ValueError:
            continue
    return light


def step_in_light(position, grad_position, mean, square, step, rate, vertices):
    """`inverse_rendering.adam_step` for a point light's position, in the axes of that light.

    To go nearer or farther changes a shadow the least: in these axes it has a step size of its own.
    """
    light = lights.point_light(position, vertices)
    move, mean, square = inverse_rendering.adam_step(
        np.zeros(3), light.rotation @ grad_position, mean, square, step, rate, (0.9, 0.99, 1e-8))
    return moved_light(light, move @ light.rotation, vertices).position, mean, square


def fit_position(target, points, vertices, faces, guess, settings, schedule):
    """Where does the point light stand that casts this shadow? -> positions (steps + 1, 3).

    target (N,): the lit shares of points (N, 3). guess (3,): the first position. schedule: the
    length of each step, in the world's unit, as `inverse_rendering.decay` makes. The blur's radius
    falls as the rate does. The light looks at the scene anew in each step. Found from within about
    20 % of the scene's size and a light well above the ground. From farther it may end elsewhere.
    """
    path = [lights.point_light(guess, vertices).position]
    mean = square = np.zeros(3)
    for step, rate in enumerate(schedule, 1):
        light = lights.point_light(path[-1], vertices)
        blurred = settings._replace(radius=round(settings.radius * rate / schedule[0]))
        _, grad_position = position_loss(target, points, vertices, faces, light, blurred)
        position, mean, square = step_in_light(path[-1], grad_position, mean, square, step, rate,
                                               vertices)
        path.append(position)
    return np.array(path)


def require_settings(settings):
    """ValueError, in one sentence, unless `variance_shadow` can take settings like these."""
    if not (isinstance(settings.radius, numbers.Integral) and settings.radius >= 0):
        raise ValueError("variance_shadow expects a blur by a whole number of texels, at least 0, "
                         f"got {settings.radius!r}; round it")
    if not settings.least_variance > 0:
        raise ValueError("variance_shadow expects a least variance above 0, got "
                         f"{settings.least_variance}; try (a thousandth of the scene's size)^2")
