"""Shadow mapping: a point is in shadow if the light sees something else before it.

The light is a camera at its position, turned by rotation, with a matrix C = clip_from_light. Its
picture is the map: in each texel the distance of the nearest surface.

    q = rotation (p - position),   distance = -q_z               the light's frame           (1)
    x = (C_00 q_x / w + 1) width / 2,   w = C_32 q_z + C_33      place on the map, y alike   (2)
    lit  <=>  distance <= stored + bias,   stored = map[floor y, floor x]                    (3)
    slope_x = d distance / dx   where n . q = constant           a plane recedes, y alike    (4)
    bias = constant + factor times how far a plane recedes from its texel's centre at most   (5)

Each distance is an axial depth: along the light's axis, in the world's unit, not along the ray.
Light from a direction has an orthographic C and w = 1. Light from a point has a perspective C and
w = distance. `lights` makes both. All points must lie before the light: w > 0.

Sources: Williams 1978 (3), notes on GAMES101 lecture 12. In these, the map holds the greatest
depth. The nearest is right.
"""
import numbers
from typing import NamedTuple

import numpy as np

from course.given import inputs, mesh

from . import interpolation, pipeline, rasterization

GRAZING = 1e-2  # the least |n . ray|: a plane seen edge-on has no slope


class Light(NamedTuple):
    """A camera in the light's place, which looks down its -z axis.

    position (3,) in the world, rotation (3, 3), whose rows are its x, y and z axis in the world,
    and clip_from_light (4, 4).
    """

    position: np.ndarray
    rotation: np.ndarray
    clip_from_light: np.ndarray


def to_light(points, position, rotation):
    """Eq. (1): points (N, 3) in the light's frame -> q (N, 3).

    position (3,), rotation (3, 3), whose rows are the light's axes.

    >>> rotation = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])  # looks down -y
    >>> to_light(np.array([[1.0, 2.0, 3.0]]), np.array([0.0, 6.0, 0.0]), rotation)
    array([[ 1., -3., -4.]])
    """
    return (points - position) @ rotation.T


def to_light_backward(grad_q, points, position, rotation):
    """Backward of eq. (1): grad_q (N, 3) -> grad_points (N, 3), grad_position (3,).

    The light moves without turning: rotation is held.
    """
    # dq = rotation (dp - dposition) for each point, and all of them have one position.
    grad_points = grad_q @ rotation
    return grad_points, -grad_points.sum(0)


def w_of(q, clip_from_light):
    """The w of eq. (2): q (N, 3) -> (N,)."""
    return clip_from_light[3, 2] * q[:, 2] + clip_from_light[3, 3]


def map_position(q, clip_from_light, width, height):  # step 14.1
    """Eq. (2): where on the light's map are q (N, 3)? -> x and y in texels (N, 2).

    `w_of` gives w.

    >>> C = np.array([[2.0, 0, 0, 0], [0, 4, 0, 0], [0, 0, -3, -4], [0, 0, -1, 0]])
    >>> map_position(np.array([[1.0, 0.0, -4.0], [0.0, -0.5, -2.0]]), C, 8, 6)
    array([[6., 3.],
           [4., 0.]])
    """
    w = w_of(q, clip_from_light)
    x = (clip_from_light[0, 0] * q[:, 0] / w + 1) * (width / 2)
    y = (clip_from_light[1, 1] * q[:, 1] / w + 1) * (height / 2)
    return np.stack([x, y]).T


def map_position_backward(grad_place, q, clip_from_light,  # extra 14.2 (3 points)
                          width, height):
    """Backward of eq. (2): grad_place (N, 2) -> grad_q (N, 3). clip_from_light is held.

    >>> C = np.array([[2.0, 0, 0, 0], [0, 4, 0, 0], [0, 0, -3, -4], [0, 0, -1, 0]])
    >>> q = np.array([[1.0, 0.0, -4.0]])
    >>> map_position_backward(np.array([[1.0, 0.0]]), q, C, 8, 6)
    array([[2. , 0. , 0.5]])
    """
    # dx = C_00 width / 2 (dq_x / w - q_x dw / w^2), and dw = C_32 dq_z; y alike.
    w = w_of(q, clip_from_light)
    grad_q_x = grad_place[:, 0] * clip_from_light[0, 0] * (width / 2) / w
    grad_q_y = grad_place[:, 1] * clip_from_light[1, 1] * (height / 2) / w
    grad_w = -(grad_q_x * q[:, 0] + grad_q_y * q[:, 1]) / w
    return np.stack([grad_q_x, grad_q_y, clip_from_light[3, 2] * grad_w], -1)


def distance_of_depth(depth, clip_from_light):  # extra 14.3 (2 points)
    """From the rasterizer's depth (H, W) back to the axial depth: distance = -q_z (H, W).

    depth = (C_22 q_z + C_23) / (C_32 q_z + C_33) is the z / w of clip space.

    >>> C = np.array([[2.0, 0, 0, 0], [0, 4, 0, 0], [0, 0, -3, -4], [0, 0, -1, 0]])
    >>> distance_of_depth(np.array([[-1.0, 1.0, 0.5, np.inf]]), C)
    array([[1. , 2. , 1.6, inf]])

    Fine print. Where the light sees nothing, depth is np.inf, and so is the distance: whatever lies
    there is lit.
    """
    distance = np.full(depth.shape, np.inf)
    seen = np.isfinite(depth)
    # Solve depth (C_32 q_z + C_33) = C_22 q_z + C_23 for -q_z.
    (c_22, c_23), (c_32, c_33) = clip_from_light[2:, 2:]
    distance[seen] = (c_33 * depth[seen] - c_23) / (c_32 * depth[seen] - c_22)
    return distance


def stored_distance(distance_map, place):
    """What the map holds at the places (x, y): its texel [floor y, floor x] -> (N,).

    distance_map (H, W), place (N, 2). Unless 0 <= x < W and 0 <= y < H: np.inf.

    >>> distance_map = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
    >>> stored_distance(distance_map, np.array([[0.9, 0.1], [2.0, 1.9], [2.5, 2.0], [-0.1, 1.0]]))
    array([ 1.,  6., inf, inf])
    """
    height, width = distance_map.shape
    x, y = place.T
    stored = np.full(x.shape, np.inf)
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    stored[inside] = distance_map[y[inside].astype(int), x[inside].astype(int)]
    return stored


def distance_slopes(normal, q, clip_from_light, width, height):  # step 14.4
    """Eq. (4): how fast does a plane recede from texel to texel? -> slope (N, 2), by x and by y.

    normal n (N, 3), of unit length, and q (N, 3) are in the light's frame. `w_of` gives w.
    ray (N, 3) = (-C_32 q_x / w, -C_32 q_y / w, -1).

    >>> C = np.diag([0.5, 0.25, -1.0, 1.0])                          # parallel light
    >>> normal, q = np.array([[0.6, 0.0, 0.8]]), np.array([[2.5, 2.0, -5.0]])
    >>> distance_slopes(normal, q, C, 4, 2).round(9) + 0.0           # a texel is 1 x 4
    array([[0.75, 0.  ]])
    >>> C[3, 2:] = -1.0, 0.0                                         # a cone
    >>> distance_slopes(normal, q, C, 4, 2).round(9) + 0.0
    array([[6., 0.]])

    Fine print. A plane seen edge-on would recede without a bound. Where |n . ray| < GRAZING, put
    GRAZING with its sign in its place. 0 counts as positive.
    """
    w = w_of(q, clip_from_light)
    # Parallel light: n . dq = 0 with dq = (du, 0, -dd), so dd/du = n_x / n_z.
    # A cone: q = d ray and ray = (u, v, -1), so dd (n . ray) + d n_x du = 0.
    across = normal[:, 0] * q[:, 0] + normal[:, 1] * q[:, 1]
    n_ray = across * -clip_from_light[3, 2] / w - normal[:, 2]
    n_ray = np.where(np.abs(n_ray) < GRAZING, np.where(n_ray < 0, -GRAZING, GRAZING), n_ray)
    slope_x = -w * normal[:, 0] / n_ray * (2 / (clip_from_light[0, 0] * width))
    slope_y = -w * normal[:, 1] / n_ray * (2 / (clip_from_light[1, 1] * height))
    return np.stack([slope_x, slope_y]).T


def hard_shadow(points, normals, light, distance_map,  # exercise 14.5 (4 points)
                constant, factor=1.0, most=np.inf):
    """Eqs. (1) to (5): which points (N, 3) are lit? -> bool (N,)

    normals (N, 3) of their planes in the world. distance_map (S, S): the Light's. The bias is (5),
    but never above most. `before_light` gives q, and `side_of` S. See `demo shadow`.

    >>> light = Light(np.zeros(3), np.eye(3), np.diag([1.0, 1.0, -1.0, 1.0]))  # parallel light
    >>> points = np.array([[0.5, 0.5, -2.0], [0.0, 0.5, -2.4]])
    >>> hard_shadow(points, np.eye(3)[[2, 2]], light, np.full((2, 2), 1.7), 0.5)
    array([ True, False])
    """
    q, size = before_light(points, light), side_of(distance_map)
    on_map = light.clip_from_light, size, size
    place = map_position(q, *on_map)
    # A point is at most half a texel in x and half in y from the centre of its texel.
    recedes = np.abs(distance_slopes(normals @ light.rotation.T, q, *on_map)).sum(1) / 2
    bias = np.minimum(constant + factor * recedes, most)
    return -q[:, 2] <= stored_distance(distance_map, place) + bias


# --- maps, and the points that are looked up on them ------------------------------------------


def depth_map(vertices, faces, light, size):
    """The light's picture: the distance of the nearest surface, (size, size), np.inf for none.

    vertices (V, 3), faces (F, 3), light a Light. ValueError for a mesh without faces, or broken,
    and for a size that is no whole number of at least 1.
    """
    inputs.require_mesh(vertices, faces)
    require_side("depth_map", size, 1)
    q = to_light(np.asarray(vertices), light.position, light.rotation)
    clip = pipeline.to_clip(q, light.clip_from_light)
    _, depth = rasterization.rasterize(clip, np.asarray(faces), size, size)
    return distance_of_depth(depth, light.clip_from_light)


def visible_points(vertices, faces, clip_from_world, width, height):
    """What a camera sees: face_index (H, W), and of the pixels that see a face, row by row, points
    (N, 3) in the world and unit normals (N, 3) of their faces, as the faces are wound.

    ValueError for a mesh without faces, or broken, and for a width or height that is no count.
    """
    inputs.require_mesh(vertices, faces)
    for side in width, height:
        require_side("visible_points", side, 0)
    vertices, faces = np.asarray(vertices), np.asarray(faces)
    clip = pipeline.to_clip(vertices, clip_from_world)
    buffers = pipeline.visible(clip, faces, width, height)
    points = interpolation.interpolate(vertices, faces, buffers.face_index, buffers.barycentric)
    seen = buffers.face_index >= 0
    normals = mesh.face_normals(vertices, faces)[buffers.face_index[seen]]
    return buffers.face_index, points[seen], normals


def before_light(points, light):
    """Points (N, 3) in the light's frame -> q (N, 3). ValueError unless the light can see them."""
    if not np.isfinite(points).all():
        raise ValueError("a shadow expects finite points, got some that are not; give the points "
                         "of pixels that see a face")
    q = to_light(points, light.position, light.rotation)
    if not (w_of(q, light.clip_from_light) > 0).all():
        raise ValueError("a shadow expects points before the light, got some beside or behind it; "
                         "leave them out, or move the light away")
    return q


def require_side(function, side, least):
    """ValueError, in one sentence, unless side is a whole number, not below least."""
    if not (isinstance(side, numbers.Integral) and side >= least):
        raise ValueError(f"{function} expects a whole number of rows and columns, at least "
                         f"{least}, got {side!r}; give one such as 256")


def side_of(distance_map):
    """The S of a map (S, S). ValueError, in one sentence, unless it is one, and S at least 1."""
    shape = np.shape(distance_map)
    if len(shape) != 2 or shape[0] != shape[1] or shape[0] == 0:
        raise ValueError("a shadow expects a square map of at least one texel, got an array "
                         f"{shape}; make one with depth_map")
    return shape[0]
