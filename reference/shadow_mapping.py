"""Shadow mapping: a point is in shadow if the light sees something else before it.

The light is a camera at its position, turned by rotation, with a matrix C = clip_from_light. Its
picture is the map: in each texel the distance of the nearest surface, along the light's axis.

    q = rotation (p - position),   distance = -q_z               the light's frame           (1)
    x = (C_00 q_x / w + 1) width / 2,   w = C_32 q_z + C_33      place on the map, y alike   (2)
    lit  <=>  distance <= stored + bias,   stored = map[floor y, floor x]                    (3)
    slope = d distance / dx = -w n_x / (n . ray) 2 / (C_00 width),   n . q = constant        (4)
    bias = constant + factor (|slope_x| + |slope_y|) / 2                                     (5)
    PCF:  the mean of (3) around (x, y), each at the distance of the plane there             (6)
    PCSS: (6) over a disc of radius R (1/blocker - 1/distance) C_00 width / 2                (7)
    VSM:  E = blur of (stored, stored^2),   variance = E_1 - E_0^2                           (8)
          lit share = variance / (variance + (distance - E_0)^2) beyond E_0, else 1          (9)
    dE = -(1, 2 stored) dq_z - sum over the 4 borders of shift (step of E across it) / 2     (10)

Light from a direction has an orthographic C and w = 1; light from a point, a perspective C and w =
distance. Its map is a cone: shadows outside are lost, and all is lit there. (Six maps, the sides
of a cube, would lose nothing.) The caller guarantees w > 0 for all points.

Sources: GAMES101 lecture 12 (its map holds the greatest depth; the nearest is right); Williams 1978
(3); Reeves et al. 1987 (6); Fernando 2005 (7); Donnelly and Lauritzen 2006 (8), (9).
"""
import numpy as np

from course.given import inputs, mesh

from . import interpolation, inverse_rendering, mipmapping, rasterization, scanline, transforms

GRAZING = 1e-2   # the least |n . ray|: a plane seen edge-on has no slope
WIDEST = np.radians(75)  # from a cone's axis to its side; beyond, texels are wasted on the border
NARROWEST = 1e-6         # of a map's width, where all vertices lie on the light's axis
PAIRS = ((0, np.s_[:, :-1], np.s_[:, 1:]),  # neighbours in x: the left ones, the right ones
         (1, np.s_[:-1], np.s_[1:]))        # in y: the lower ones, the upper ones


def to_light(points, position, rotation):  # exercise 14.1 (1 point)
    """Eq. (1): points (N, 3) in the light's frame -> q (N, 3); the light looks down -z.

    position (3,): the light's place; rows of rotation (3, 3): its x, y and z axis in the world.

    >>> rotation = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])  # looks down -y
    >>> to_light(np.array([[1.0, 2.0, 3.0]]), np.array([0.0, 6.0, 0.0]), rotation)
    array([[ 1., -3., -4.]])
    """
    return (points - position) @ rotation.T


def to_light_backward(grad_q, points, position, rotation):  # exercise 14.2 (2 points)
    """Backward of eq. (1): grad_q (N, 3) -> grad_points (N, 3), grad_position (3,).

    The light moves without turning: rotation is held.

    >>> rotation = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    >>> grad_q = np.array([[0.0, 2.0, 0.0], [1.0, 0.0, 3.0]])
    >>> to_light_backward(grad_q, np.zeros((2, 3)), np.zeros(3), rotation)
    (array([[ 0.,  0., -2.],
           [ 1.,  3.,  0.]]), array([-1., -3.,  2.]))
    """
    grad_points = grad_q @ rotation
    return grad_points, -grad_points.sum(0)


def w_of(q, clip_from_light):
    """The w of eq. (2): q (N, 3) -> (N,)."""
    return clip_from_light[3, 2] * q[:, 2] + clip_from_light[3, 3]


def map_position(q, clip_from_light, width, height):  # exercise 14.3 (2 points)
    """Eq. (2): where points of the light's frame lie on its map -> x, y, each (N,), in texels.

    q (N, 3), w > 0; clip_from_light C (4, 4), of which only C_00, C_11, C_32 and C_33 matter here:
    y goes with C_11 and height. (The light looks straight ahead.)

    >>> C = np.array([[2.0, 0, 0, 0], [0, 4, 0, 0], [0, 0, -3, -4], [0, 0, -1, 0]])
    >>> map_position(np.array([[1.0, 0.0, -4.0], [0.0, -0.5, -2.0]]), C, 8, 6)
    (array([6., 4.]), array([3., 0.]))
    """
    w = w_of(q, clip_from_light)
    x = (clip_from_light[0, 0] * q[:, 0] / w + 1) * (width / 2)
    y = (clip_from_light[1, 1] * q[:, 1] / w + 1) * (height / 2)
    return x, y


def map_position_backward(grad_x, grad_y, q, clip_from_light,  # exercise 14.4 (3 points)
                          width, height):
    """Backward of eq. (2): grad_x, grad_y (N,) -> grad_q (N, 3). clip_from_light is held.

    >>> C = np.array([[2.0, 0, 0, 0], [0, 4, 0, 0], [0, 0, -3, -4], [0, 0, -1, 0]])
    >>> q = np.array([[1.0, 0.0, -4.0]])
    >>> map_position_backward(np.array([1.0]), np.array([0.0]), q, C, 8, 6)
    array([[2. , 0. , 0.5]])
    """
    # dx = C_00 width / 2 (dq_x / w - q_x dw / w^2), and dw = C_32 dq_z; y alike.
    w = w_of(q, clip_from_light)
    grad_q_x = grad_x * clip_from_light[0, 0] * (width / 2) / w
    grad_q_y = grad_y * clip_from_light[1, 1] * (height / 2) / w
    grad_w = -(grad_q_x * q[:, 0] + grad_q_y * q[:, 1]) / w
    return np.stack([grad_q_x, grad_q_y, clip_from_light[3, 2] * grad_w], -1)


def distance_of_depth(depth, clip_from_light):  # exercise 14.5 (2 points)
    """What distance = -q_z has a depth of the rasterizer? depth (H, W) -> distance (H, W).

    depth = (C_22 q_z + C_23) / (C_32 q_z + C_33), the z / w of clip space, from -1 to 1; np.inf
    where the light sees nothing: there the distance is np.inf, and nothing is raised or warned of.

    >>> C = np.array([[2.0, 0, 0, 0], [0, 4, 0, 0], [0, 0, -3, -4], [0, 0, -1, 0]])
    >>> distance_of_depth(np.array([[-1.0, 1.0, 0.5, np.inf]]), C)
    array([[1. , 2. , 1.6, inf]])
    """
    distance = np.full(depth.shape, np.inf)
    seen = np.isfinite(depth)
    # Solve depth (C_32 q_z + C_33) = C_22 q_z + C_23 for -q_z.
    (c_22, c_23), (c_32, c_33) = clip_from_light[2:, 2:]
    distance[seen] = (c_33 * depth[seen] - c_23) / (c_32 * depth[seen] - c_22)
    return distance


def stored_distance(distance_map, x, y):  # exercise 14.6 (2 points)
    """What the map holds at (x, y) (N,): the texel [floor y, floor x] of it -> (N,).

    distance_map (H, W). Outside the map, that is unless 0 <= x < W and 0 <= y < H: np.inf.

    >>> distance_map = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
    >>> stored_distance(distance_map, np.array([0.9, 2.0, 2.5, -0.1]), np.array([0.1, 1.9, 2.0, 1]))
    array([ 1.,  6., inf, inf])
    """
    height, width = distance_map.shape
    stored = np.full(x.shape, np.inf)
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    stored[inside] = distance_map[y[inside].astype(int), x[inside].astype(int)]
    return stored


def is_lit(distance_map, x, y, distance, bias):  # exercise 14.7 (1 point)
    """Eq. (3): does light reach points at (x, y) of the map, at this distance? -> bool (N,).

    distance_map (H, W); x, y, distance (N,); bias a number or (N,). Outside the map: lit.

    >>> distance_map, x = np.array([[4.0, 9.0]]), np.array([0.5, 0.6, 0.7, 1.5])
    >>> is_lit(distance_map, x, 0 * x, np.array([4.0, 4.5, 4.6, 4.6]), 0.5)
    array([ True,  True, False,  True])
    """
    return distance <= stored_distance(distance_map, x, y) + bias


def distance_slopes(normal, q, clip_from_light, width, height):  # exercise 14.8 (4 points)
    """Eq. (4): how fast a surface recedes from texel to texel -> slope_x, slope_y, each (N,).

    normal n (N, 3) of unit length, q (N, 3), both in the light's frame: the distance of the plane
    through q at right angles to n, as a function of the place on the map, has these partial
    derivatives by x and by y (there with n_y, C_11 and height).
    ray, with z = -1, points along the light: ray_x = -C_32 q_x / w, ray_y alike. In a cone this is
    q / distance, in parallel light (0, 0, -1). Where |n . ray| < GRAZING, it is replaced by
    GRAZING with its sign; 0 counts as positive.

    >>> C = np.diag([0.5, 0.25, -1.0, 1.0])                          # parallel light
    >>> normal, q = np.array([[0.6, 0.0, 0.8]]), np.array([[1.0, 2.0, -5.0]])
    >>> slope_x, slope_y = distance_slopes(normal, q, C, 4, 2)       # a texel is 1 x 4
    >>> slope_x.round(9), slope_y.round(9) + 0.0
    (array([0.75]), array([0.]))
    """
    w = w_of(q, clip_from_light)
    # Parallel light: n . dq = 0 with dq = (du, 0, -dd), so dd/du = n_x / n_z.
    # A cone: q = d ray and ray = (u, v, -1), so dd (n . ray) + d n_x du = 0.
    along = (normal[:, :2] * q[:, :2]).sum(1) * -clip_from_light[3, 2] / w - normal[:, 2]
    along = np.where(np.abs(along) < GRAZING, np.where(along < 0, -GRAZING, GRAZING), along)
    slope_x = -w * normal[:, 0] / along * (2 / (clip_from_light[0, 0] * width))
    slope_y = -w * normal[:, 1] / along * (2 / (clip_from_light[1, 1] * height))
    return slope_x, slope_y


def slope_scaled_bias(slope_x, slope_y, constant, factor, most):  # exercise 14.9 (1 point)
    """Eq. (5), but never above most: slope_x, slope_y (N,), three numbers -> bias (N,).

    A point is at most half a texel in x and half in y from the centre where its texel was measured.
    So with factor 1 a plane does not shadow itself.

    >>> slope_scaled_bias(np.array([0.2, -0.2, 9.0]), np.array([-0.4, 0.0, 0.0]), 0.5, 2.0, 1.5)
    array([1.1, 0.7, 1.5])
    """
    return np.minimum(constant + factor * (np.abs(slope_x) + np.abs(slope_y)) / 2, most)


def on_plane(x, y, distance, slope_x, slope_y, dx, dy):  # exercise 14.10 (2 points)
    """A neighbouring texel, and how distant the receiver's plane is there.

    x, y, distance, slope_x, slope_y (N,): receivers, as above; dx, dy (N,): steps in texels ->
    x + dx, y + dy, and the distance that the plane has at the *centre* of the texel which holds
    that place, each (N,). The plane recedes by slope_x, slope_y to a texel, as if it were flat on
    the map. In a cone it lies a little farther: this may let light through, and is never acne.

    >>> one = np.ones(1)
    >>> on_plane(2.25 * one, 3.5 * one, 7.0 * one, 0.5 * one, 0.1 * one, one, 2 * one)
    (array([3.25]), array([5.5]), array([7.825]))
    """
    there_x, there_y = x + dx, y + dy
    centre_x, centre_y = np.floor(there_x) + 0.5, np.floor(there_y) + 0.5
    return there_x, there_y, distance + slope_x * (centre_x - x) + slope_y * (centre_y - y)


def percentage_closer(distance_map, x, y, distance, slope_x, slope_y,  # exercise 14.11 (3 points)
                      bias, offsets, radius):
    """Eq. (6): the share of places around (x, y) that light reaches -> (N,), from 0 to 1.

    The places: (x, y) + radius offsets, offsets (K, 2), radius in texels, a number or (N,); for
    each, `is_lit` with the distance of `on_plane`. The comparisons are averaged, not the distances:
    a mean of distances would be a surface that is nowhere. Others as in `is_lit` and `on_plane`.

    >>> distance_map, one = np.array([[4.0, 4.0, 9.0, 9.0]]), np.ones(1)
    >>> offsets = np.array([[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]])
    >>> percentage_closer(distance_map, 1.5 * one, 0.5 * one, 8 * one, 0 * one, 0 * one, 0.1,
    ...                   offsets, 1.0).round(3)
    array([0.333])
    """
    lit = np.zeros(x.shape)
    for dx, dy in offsets:
        there = on_plane(x, y, distance, slope_x, slope_y, radius * dx, radius * dy)
        lit += is_lit(distance_map, *there, bias)
    return lit / len(offsets)


def blocker_distance(distance_map, x, y, distance, slope_x, slope_y,  # exercise 14.12 (3 points)
                     bias, offsets, radius):
    """The mean of the stored distances of blockers: of the places that are not lit -> (N,).

    The places, and when they are lit, as in `percentage_closer`. np.inf where there is no blocker;
    nothing is raised or warned of.

    >>> distance_map, one = np.array([[4.0, 5.0, 9.0, 9.0]]), np.ones(2)
    >>> offsets = np.array([[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]])
    >>> blocker_distance(distance_map, np.array([1.5, 3.5]), 0.5 * one, 8 * one, 0 * one, 0 * one,
    ...                  0.1, offsets, 1.0)
    array([4.5, inf])
    """
    total, count = np.zeros((2, *x.shape))
    for dx, dy in offsets:
        there_x, there_y, plane = on_plane(x, y, distance, slope_x, slope_y,
                                           radius * dx, radius * dy)
        blocks = ~is_lit(distance_map, there_x, there_y, plane, bias)
        total[blocks] += stored_distance(distance_map, there_x[blocks], there_y[blocks])
        count += blocks
    return np.where(count > 0, total / np.maximum(count, 1), np.inf)


def penumbra_radius(distance, blocker, light_radius, clip_from_light,  # exercise 14.13 (2 points)
                    width):
    """Eq. (7): how wide the shadow's soft border is on the map, in texels -> (N,), at least 0.

    A disc of light_radius R in the plane q_z = 0, seen past a blocker from a point at a distance:
    the rays to the disc's rim leave the ray to its middle. The radius is how far from it they lie
    on the map where they pass the plane q_z = -blocker.
    distance, blocker (N,), > 0; a blocker at np.inf, or behind the point, gives 0.
    clip_from_light C (4, 4) of a cone, width of its map, whose texels are square.

    >>> C = np.array([[2.0, 0, 0, 0], [0, 2, 0, 0], [0, 0, -3, -4], [0, 0, -1, 0]])
    >>> penumbra_radius(np.array([4.0, 4.0]), np.array([2.0, np.inf]), 0.5, C, 8)
    array([1., 0.])
    """
    spread = light_radius * (1 / blocker - 1 / distance)
    return np.maximum(spread, 0) * (clip_from_light[0, 0] * width / 2)


def window_sums(picture, radius):  # exercise 14.14 (2 points)
    """Sums over squares: of the pixels up to radius rows and columns away -> (H, W, C).

    picture (H, W, C); radius a whole number >= 0. Squares end at the picture's border.

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


def box_blur(picture, radius):  # exercise 14.15 (1 point)
    """The mean over the squares of `window_sums`: picture (H, W, C) -> (H, W, C).

    At the border, the mean of the pixels that there are.

    >>> box_blur(np.array([[[1.0], [2.0], [6.0], [10.0]]]), 1)[..., 0]
    array([[1.5, 3. , 6. , 8. ]])
    """
    return window_sums(picture, radius) / window_sums(np.ones((*picture.shape[:2], 1)), radius)


def box_blur_backward(grad_output, radius):  # exercise 14.16 (2 points)
    """Backward of `box_blur`: grad_output (H, W, C) -> grad_picture (H, W, C).

    >>> box_blur_backward(np.array([[[6.0], [0.0], [0.0], [0.0]]]), 1)[..., 0]
    array([[3., 3., 0., 0.]])
    """
    # Pixel j is in the square around i where i is in the square around j: the sums are their own
    # transpose, and each mean was divided by the number of its own square.
    count = window_sums(np.ones((*grad_output.shape[:2], 1)), radius)
    return window_sums(grad_output / count, radius)


def chebyshev(distance, mean, mean_square, least_variance):  # exercise 14.17 (2 points)
    """Eq. (9): at most how much of a filtered map lies at `distance` or beyond? -> (N,), 0 to 1.

    distance, mean E_0, mean_square E_1 (N,). The variance is at least the number least_variance
    > 0: it stands in for the slope inside a texel, and for rounding. Where distance <= mean: 1.

    >>> chebyshev(np.array([2.0, 5.0, 5.0]), np.array([3.0, 3.0, 4.0]), np.array([11, 11, 16.0]), 1)
    array([1.        , 0.33333333, 0.5       ])
    """
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    return variance / (variance + beyond**2)


def chebyshev_backward(grad_lit, distance, mean, mean_square,  # exercise 14.18 (3 points)
                       least_variance):
    """Backward of eq. (9): grad_lit (N,) -> grad_distance, grad_mean, grad_mean_square, each (N,).

    The variance has a gradient only where it is greater than least_variance.

    >>> E_0, E_1 = np.array([3.0, 3.0]), np.array([12.0, 10.0])                # variances 3 and 2
    >>> grads = chebyshev_backward(np.ones(2), np.array([5.0, 5.0]), E_0, E_1, 2.0)
    >>> grads[0] * [49, 36], grads[1] * [49, 36], grads[2] * [49, 36]
    (array([-12.,  -8.]), array([-12.,   8.]), array([4., 0.]))
    """
    # p = v / s with s = v + b^2, so dp = b^2 / s^2 dv - 2 v b / s^2 db.
    variance = np.maximum(mean_square - mean**2, least_variance)
    beyond = np.maximum(distance - mean, 0)
    total = variance + beyond**2
    grad_beyond = grad_lit * -2 * variance * beyond / total**2
    grad_mean_square = grad_lit * (beyond / total)**2 * (mean_square - mean**2 > least_variance)
    return grad_beyond, -grad_beyond - 2 * mean * grad_mean_square, grad_mean_square


def map_motion(distance_map, clip_from_light):  # exercise 14.19 (3 points)
    """How far the content of each texel moves on the map when all points move in the light's frame.

    distance_map (H, W), finite -> motion (H, W, 2, 3): the partial derivatives of eq. (2), x and y
    in texels, by q_x, q_y and q_z, at the texel's centre, for the point at its distance.
    clip_from_light C as in `map_position`.

    >>> C = np.array([[2.0, 0, 0, 0], [0, 4, 0, 0], [0, 0, -3, -4], [0, 0, -1, 0]])
    >>> map_motion(np.array([[4.0, 2.0, 4.0]]), C)[0, 2] + 0.0
    array([[0.75, 0.  , 0.25],
           [0.  , 0.5 , 0.  ]])
    """
    height, width = distance_map.shape
    w = clip_from_light[3, 3] - clip_from_light[3, 2] * distance_map
    motion = np.zeros((height, width, 2, 3))
    # x - width / 2 = C_00 width / 2 q_x / w, so by q_z it is -(x - width / 2) C_32 / w.
    motion[..., 0, 0] = clip_from_light[0, 0] * (width / 2) / w
    motion[..., 1, 1] = clip_from_light[1, 1] * (height / 2) / w
    from_middle = np.arange(width) + 0.5 - width / 2, np.arange(height)[:, None] + 0.5 - height / 2
    for axis in 0, 1:
        motion[..., axis, 2] = -from_middle[axis] * clip_from_light[3, 2] / w
    return motion


def moved_moments(distance_map, motion, move):  # exercise 14.20 (4 points)
    """Eq. (10): the moments when all points have moved by a little in the light's frame.

    distance_map (H, W), finite; motion (H, W, 2, 3) of `map_motion`; move (3,): q becomes q + move
    -> moments (H, W, 2). With d = distance_map: first, each texel has d - move_z and its square.
    Then, of each pair of neighbours a and b, b to the right of a or above it: the border between
    them moves with the surface in front, by s texels to the right (or up). s is x (or y) of motion
    @ move, of the texel with the smaller d. (Equal ones have no step between them.) Each of the two
    loses s / 2 times (moments of b - moments of a), the moments as they were before: d and d^2.

    >>> C = np.diag([1.0, 1.0, -1.0, 1.0])
    >>> distance_map = np.array([[2.0, 2.0, 3.0]])
    >>> motion = map_motion(distance_map, C)                        # 1.5 texels to the unit of q_x
    >>> moved_moments(distance_map, motion, np.array([0.2, 0.0, 0.0]))[0]
    array([[2.  , 4.  ],
           [1.85, 3.25],
           [2.85, 8.25]])
    """
    moments = np.stack([distance_map, distance_map**2], -1)
    moved = np.stack([distance_map - move[2], (distance_map - move[2])**2], -1)
    for axis, a, b in PAIRS:
        speed = motion[..., axis, :] @ move
        shift = np.where(distance_map[a] <= distance_map[b], speed[a], speed[b])
        change = shift[..., None] / 2 * (moments[b] - moments[a])
        moved[a] -= change
        moved[b] -= change
    return moved


def moved_moments_backward(grad_moments, distance_map, motion, move):  # exercise 14.21 (4 points)
    """Backward of `moved_moments` by the last input: grad_moments (H, W, 2) -> grad_move (3,).

    distance_map and motion are held.

    >>> C = np.diag([1.0, 1.0, -1.0, 1.0])
    >>> distance_map = np.array([[2.0, 2.0, 3.0]])
    >>> grad_moments = np.array([[[0.0, 0.0], [4.0, 0.0], [0.0, 1.0]]])
    >>> motion = map_motion(distance_map, C)
    >>> moved_moments_backward(grad_moments, distance_map, motion, np.zeros(3)) + 0.0
    array([ -6.75,   0.  , -10.  ])
    """
    moments = np.stack([distance_map, distance_map**2], -1)
    grad_distance = grad_moments[..., 0] + 2 * (distance_map - move[2]) * grad_moments[..., 1]
    grad_move = np.array([0.0, 0.0, -grad_distance.sum()])
    for axis, a, b in PAIRS:
        grad_change = -(grad_moments[a] + grad_moments[b])
        grad_shift = (grad_change * (moments[b] - moments[a])).sum(-1) / 2
        in_front = (distance_map[a] <= distance_map[b])[..., None]
        by_move = np.where(in_front, motion[..., axis, :][a], motion[..., axis, :][b])
        grad_move += (grad_shift[..., None] * by_move).sum((0, 1))
    return grad_move


# --- lights, maps and receivers ---------------------------------------------------------------
# A light is a tuple: position (3,), rotation (3, 3), clip_from_light (4, 4).


def axes_of(toward):
    """rotation (3, 3) of a light that looks along toward (3,); up is y, or z beside it."""
    up = np.eye(3)[1 if np.hypot(toward[0], toward[2]) > 1e-3 * abs(toward[1]) else 2]
    return transforms.look_at(np.zeros(3), toward, up)[:3, :3]


def bounds(vertices):
    """The least and the greatest x, y and z of vertices (V, 3), each (3,)."""
    if not (vertices.shape[1:] == (3,) and len(vertices) and np.isfinite(vertices).all()
            and np.ptp(vertices, axis=0).any()):
        raise ValueError("a light expects vertices (V, 3), finite and not all in one place, got "
                         f"{vertices.shape}; give it the vertices of the scene")
    return vertices.min(0), vertices.max(0)


def directional_light(direction, vertices):
    """Light that falls along direction (3,), its map around all vertices (V, 3)."""
    direction, vertices = np.asarray(direction, float), np.asarray(vertices, float)
    if direction.shape != (3,) or not 0 < np.linalg.norm(direction) < np.inf:
        raise ValueError("directional_light expects a direction of three numbers and some length, "
                         f"got {direction}; give the direction in which the light falls")
    bounds(vertices)
    rotation = axes_of(direction)
    low, high = bounds(to_light(vertices, np.zeros(3), rotation))
    far = np.linalg.norm(high - low)
    side = max(0.51 * (high - low)[:2].max(), NARROWEST * far)
    position = np.append((low + high)[:2] / 2, high[2] + far) @ rotation
    return position, rotation, transforms.orthographic(-side, side, -side, side, far / 2, 2.5 * far)


def in_a_cone(vertices, position, toward):
    """rotation (3, 3) of a light that looks along toward (3,), and q (V, 3), all before it."""
    if not np.linalg.norm(toward) > 0:
        raise ValueError("point_light stands in the middle of the scene, and a cone sees only one "
                         "side; move it out of the scene")
    rotation = axes_of(toward)
    q = to_light(vertices, position, rotation)
    if not (np.hypot(q[:, 0], q[:, 1]) < -np.tan(WIDEST) * q[:, 2]).all():
        raise ValueError("point_light expects all vertices within a cone of "
                         f"{np.degrees(WIDEST):.0f} degrees around its axis, and some are outside; "
                         "move it away from the scene")
    return rotation, q


def point_light(position, vertices):
    """Light from position (3,), its map a cone around all vertices (V, 3)."""
    position, vertices = np.asarray(position, float), np.asarray(vertices, float)
    if position.shape != (3,) or not np.isfinite(position).all():
        raise ValueError(f"point_light expects a position of three finite numbers, got {position}; "
                         "give the light's place in the world")
    rotation, q = in_a_cone(vertices, position, sum(bounds(vertices)) / 2 - position)
    # Look at the middle of what is seen from here, so that no side of the map stays empty.
    angle = np.arctan(q[:, :2] / -q[:, 2:])
    middle = np.append(np.tan((angle.min(0) + angle.max(0)) / 2), -1.0)
    rotation, q = in_a_cone(vertices, position, middle @ rotation)
    slope = max(1.02 * (np.abs(q[:, :2]) / -q[:, 2:]).max(), NARROWEST)
    near, far = 0.9 * -q[:, 2].max(), 1.1 * -q[:, 2].min()
    return position, rotation, transforms.perspective(2 * np.arctan(slope), 1.0, near, far)


def depth_map(vertices, faces, light, size):
    """The light's picture: the distance of the nearest surface, (size, size), np.inf for none."""
    inputs.require_mesh(vertices, faces)
    vertices, faces = np.asarray(vertices), np.asarray(faces)
    position, rotation, clip_from_light = light
    q = transforms.to_homogeneous(to_light(vertices, position, rotation))
    clip = transforms.transform(q, clip_from_light)
    _, depth = scanline.rasterize(clip, faces, size, size)
    return distance_of_depth(depth, clip_from_light)


def visible_points(vertices, faces, clip_from_world, width, height):
    """What the eye sees: face_index (H, W), and of the pixels that see a face, row by row, points
    (N, 3) in the world and unit normals (N, 3) of their faces, as the faces are wound.
    """
    inputs.require_mesh(vertices, faces)
    vertices, faces = np.asarray(vertices), np.asarray(faces)
    clip = transforms.transform(transforms.to_homogeneous(vertices), clip_from_world)
    face_index, _ = scanline.rasterize(clip, faces, width, height)
    barycentric = rasterization.barycentrics(face_index, clip, faces)
    points = interpolation.interpolate(vertices, faces, face_index, barycentric)
    seen = face_index >= 0
    return face_index, points[seen], mesh.face_normals(vertices, faces)[face_index[seen]]


def receivers(points, normals, light, size):
    """Points (N, 3) on the light's map: x, y, distance, slope_x, slope_y, each (N,)."""
    if not np.isfinite(points).all():
        raise ValueError("a shadow expects finite points, got some that are not; give the points "
                         "of pixels that see a face")
    position, rotation, clip_from_light = light
    q = to_light(points, position, rotation)
    x, y = map_position(q, clip_from_light, size, size)
    return x, y, -q[:, 2], *distance_slopes(normals @ rotation.T, q, clip_from_light, size, size)


def hard_shadow(points, normals, vertices, faces, light, size, constant, factor=1.0, most=np.inf):
    """Which points (N, 3) are lit: eqs. (1) to (5), by a map of size x size texels -> bool (N,)."""
    x, y, distance, slope_x, slope_y = receivers(points, normals, light, size)
    bias = slope_scaled_bias(slope_x, slope_y, constant, factor, most)
    return is_lit(depth_map(vertices, faces, light, size), x, y, distance, bias)


def soft_shadow(points, normals, vertices, faces, light, light_radius, size, bias, offsets):
    """PCSS, eq. (7): the lit share of points (N, 3) under a disc of light_radius -> (N,).

    The disc is a point light's, and faces the scene; offsets (K, 2) are places in the unit disc.
    One search for blockers, where the nearest of all could be; then (6) over the radius that their
    mean has.
    """
    if light[2][3, 2] == 0:
        raise ValueError("soft_shadow expects a point light, got light from a direction; "
                         "make the light with point_light")
    on_map = receivers(points, normals, light, size)
    distance_map, clip_from_light = depth_map(vertices, faces, light, size), light[2]
    nearest = np.full(len(points), distance_map.min(initial=np.inf))
    search = penumbra_radius(on_map[2], nearest, light_radius, clip_from_light, size)
    blocker = blocker_distance(distance_map, *on_map, bias, offsets, search)
    radius = penumbra_radius(on_map[2], blocker, light_radius, clip_from_light, size)
    return percentage_closer(distance_map, *on_map, bias, offsets, radius)


# --- a shadow with a gradient -----------------------------------------------------------------


def variance_shadow(points, vertices, faces, light, size, radius, least_variance):
    """Eqs. (8) and (9): the lit share of points (N, 3) -> (N,), and what backward takes again.

    The map of moments is blurred over (2 radius + 1)^2 texels, and read bilinearly. Where the light
    sees nothing, its distance is the far plane's. Points outside the map are lit. least_variance
    is this shadow's bias, in squares of the world's unit: about (a thousandth of the scene)^2.
    """
    if not (radius == round(radius) and radius >= 0):
        raise ValueError("variance_shadow expects a blur by a whole number of texels, at least 0, "
                         f"got {radius}; round it")
    position, rotation, clip_from_light = light
    distance_map = depth_map(vertices, faces, light, size)
    far = distance_of_depth(np.ones(1), clip_from_light)
    distance_map = np.where(np.isfinite(distance_map), distance_map, far)
    blurred = box_blur(np.stack([distance_map, distance_map**2], -1), radius)
    q = to_light(points, position, rotation)
    uv = np.stack(map_position(q, clip_from_light, size, size), -1) / size
    mean = mipmapping.texture(blurred, uv, boundary="clamp")
    inside = ((uv >= 0) & (uv < 1)).all(1)
    lit = np.where(inside, chebyshev(-q[:, 2], *mean.T, least_variance), 1.0)
    return lit, (distance_map, blurred, q, uv, mean, inside)


def variance_shadow_backward(grad_lit, buffers, points, light, radius, least_variance):
    """Backward of `variance_shadow` by the light's position: grad_lit (N,) -> (3,). Read upwards.

    The points move in the light's frame, and so does all that the map shows, by eq. (10). A texel
    of the map jumps when an edge passes its centre; (10) moves the edge evenly instead. So this is
    the slope of sums over many texels, and not of single ones. At a round body's rim, the texels'
    centres are nearer than the rim, and seem to move too far: this error falls with the root
    of the texel's size. In parallel light the gradient is 0 up to such errors: the shadow depends
    on the direction alone, and that is held.
    """
    position, rotation, clip_from_light = light
    distance_map, blurred, q, uv, mean, inside = buffers
    size = len(blurred)
    grad_distance, *grad_mean = chebyshev_backward(
        np.where(inside, grad_lit, 0.0), -q[:, 2], *mean.T, least_variance)
    grad_blurred, grad_uv, *_ = mipmapping.texture_backward(
        np.stack(grad_mean, -1), blurred, uv, boundary="clamp")
    grad_q = map_position_backward(*grad_uv.T / size, q, clip_from_light, size, size)
    grad_q[:, 2] -= grad_distance
    grad_move = moved_moments_backward(box_blur_backward(grad_blurred, radius), distance_map,
                                       map_motion(distance_map, clip_from_light), np.zeros(3))
    # When the light moves, all points of its frame move the other way.
    return to_light_backward(grad_q, points, position, rotation)[1] - grad_move @ rotation


def position_loss(target, points, vertices, faces, light, size, radius, least_variance):
    """The mean square error of a shadow against target (N,), and its gradient by the light's
    position (3,); the others as in `variance_shadow`.
    """
    lit, buffers = variance_shadow(points, vertices, faces, light, size, radius, least_variance)
    if np.shape(target) != lit.shape:
        raise ValueError(f"position_loss expects a target {lit.shape}, one number for each point, "
                         f"got {np.shape(target)}")
    grad_lit = 2 * (lit - target) / len(target)
    grad_position = variance_shadow_backward(grad_lit, buffers, points, light, radius,
                                             least_variance)
    return np.mean((lit - target)**2), grad_position


def moved_light(light, move, vertices):
    """The point light after a move (3,), halved until `point_light` accepts the place."""
    for part in 0.5 ** np.arange(20):
        try:
            return point_light(light[0] + part * move, vertices)
        except ValueError:
            continue
    return light


def fit_position(target, points, vertices, faces, guess, size, steps, rate, radius,
                 least_variance):
    """Where does the point light stand that casts this shadow? -> its positions (steps + 1, 3).

    target (N,): the lit shares of points (N, 3); guess (3,): the first position; rate: the first
    step's length, in the world's unit. Adam (lab 9), in the axes of a light that looks at the scene
    anew in each step: to go nearer or farther changes a shadow the least, and so has a step size of
    its own. The rate and the blur's radius fall to a tenth. Found from within about 20 % of the
    scene's size and a light well above the ground; from farther it may end elsewhere.
    """
    light = point_light(guess, vertices)
    path, mean, square = [light[0]], np.zeros(3), np.zeros(3)
    for step in range(1, steps + 1):
        fall = 0.1 ** ((step - 1) / steps)
        _, grad_position = position_loss(target, points, vertices, faces, light, size,
                                         round(radius * fall), least_variance)
        move, mean, square = inverse_rendering.adam_step(
            np.zeros(3), light[1] @ grad_position, mean, square, step, rate * fall, 0.9, 0.99)
        light = moved_light(light, move @ light[1], vertices)
        path.append(light[0])
    return np.array(path)
