"""Cube maps: a texture for all directions, on the six sides of a cube.

The eye stands in the middle of a cube, and each side is a picture of n x n texels. The equations
go on from mipmapping.py and its lecture. On each face, right is the direction along which u grows,
down that along which v grows, and out leads from the middle to the face. They are unit vectors
along the axes, and d is any direction, of any length:

    face = the one with the largest m = out . d                                             (10)
    u = 1/2 (1 + right . d / m),  v = 1/2 (1 + down . d / m)                                (11)
    d = (2u - 1) right + (2v - 1) down + out                      back from (u, v)          (12)
    u_x = (right . d_x - (2u - 1) out . d_x) / (2 m),  v_x alike with down                  (13)

d_x is dd/dx, the change of d from pixel to pixel. A tap of the bilinear look-up may lie beyond its
face: then (12) is the direction to its centre, and the texel that this direction sees takes its
place. At a corner of the cube only three texels meet. The mean of the three stands for the fourth.

Sources: the OpenGL specification (order and axes of the faces); nvdiffrast (the corner).
"""
import numpy as np

from course.given.arrays import masked_scatter

from .mipmapping import (
    footprint_level,
    footprint_level_backward,
    mixture,
    pack,
    pyramid,
    pyramid_backward,
    taps_backward,
    unpack,
)
from .texturing import (
    LARGEST,
    Footprint,
    Sampler,
    each_pair,
    in_parts,
    linear_texels,
    look_up,
    look_up_backward,
    nearest_texel,
    require,
    require_gradient,
    require_texture,
)

FRAMES = np.array([  # right, down, out
    [[0, 0, -1], [0, -1, 0], [1, 0, 0]],    # face 0: +x
    [[0, 0, 1], [0, -1, 0], [-1, 0, 0]],    # 1: -x
    [[1, 0, 0], [0, 0, 1], [0, 1, 0]],      # 2: +y
    [[1, 0, 0], [0, 0, -1], [0, -1, 0]],    # 3: -y
    [[1, 0, 0], [0, -1, 0], [0, 0, 1]],     # 4: +z
    [[-1, 0, 0], [0, -1, 0], [0, 0, -1]],   # 5: -z
], float)
AXIS = np.abs(FRAMES).argmax(-1)  # each of their rows is along an axis,
SIGN = FRAMES.sum(-1)             # or opposite to it
SHORTEST = 1e-150  # of a direction: one over its square is still a number


# --- directions and faces ------------------------------------------------------------------------

def on_face(directions):  # extra 6.13 (2 points)
    """Eqs. (10) and (11): directions (N, 3), not 0 -> face (N,), uv (N, 2) where they meet it.

    FRAMES[face] has the rows right, down and out.

    >>> on_face(np.array([[2.0, 0.0, 1.0], [0.0, -4.0, 0.0]]))
    (array([0, 3]), array([[0.25, 0.5 ],
           [0.5 , 0.5 ]]))

    Fine print. On an edge several faces have the largest m. The first of them counts.
    """
    face = np.argmax(directions @ FRAMES[:, 2].T, 1)
    right, down, m = to_face_axes(directions, face).T
    return face, (1 + np.stack([right / m, down / m], -1)) / 2


def to_face_axes(directions, face):
    """FRAMES[face] d, whose numbers are d's or their opposites: (N, 3, ...) -> (N, 3, ...)."""
    n = np.arange(len(face))[:, None]
    return (SIGN[face].T * directions[n, AXIS[face]].T).T


def from_face_axes(values, face):
    """The inverse of `to_face_axes`, and its transpose: (N, 3, ...) -> (N, 3, ...)."""
    directions = np.empty(values.shape)
    directions[np.arange(len(face))[:, None], AXIS[face]] = (SIGN[face].T * values.T).T
    return directions


def on_face_backward(grad_uv, directions):
    """Backward of `on_face`: grad_uv (N, 2) -> grad_directions (N, 3).

    >>> on_face_backward(np.array([[8.0, 0.0]]), np.array([[2.0, 0.0, 1.0]])) + 0.0
    array([[ 1.,  0., -2.]])
    """
    # u = (1 + a/m)/2 with a = right . d, so du = (da - (a/m) dm) / (2 m), and a/m = 2u - 1.
    # da, db and dm are dd in the frame's axes; `from_face_axes` turns them back.
    face, uv = on_face(directions)
    m = to_face_axes(directions, face)[:, 2:]
    grad_m = -(grad_uv * (2 * uv - 1)).sum(1, keepdims=True)
    grad = np.concatenate([grad_uv, grad_m], 1) / (2 * m)
    return from_face_axes(grad, face)


def direction_to(face, uv):
    """Eq. (12): the directions (N, 3) to the places uv (N, 2) of face (N,), or beyond its edge.

    >>> direction_to(np.array([4, 0]), np.array([[0.5, 0.5], [0.75, 1.25]])) + 0.0
    array([[ 0. ,  0. ,  1. ],
           [ 1. , -1.5, -0.5]])
    """
    return from_face_axes(np.concatenate([2 * uv - 1, np.ones((len(uv), 1))], 1), face)


def texel_directions(size):
    """Eq. (12): the directions (6, size, size, 3) to the centres of a cube map's texels."""
    face, row, column = np.indices((6, size, size)).reshape(3, -1)
    uv = (np.stack([column, row], -1) + 0.5) / size
    return direction_to(face, uv).reshape(6, size, size, 3)


def across_edge(face, column, row, size):  # extra 6.14 (3 points)
    """The texel that stands for one beyond its face's edge -> face, column, row.

    All are (N,), integers, as size is. One of column and row is -1 or size. The direction to the
    texel's centre, eq. (12), meets another face. There it is in the texel wanted (`nearest_texel`).

    >>> one, four = np.array([1]), np.array([4])
    >>> across_edge(four, np.array([-1]), np.array([5]), np.array([8]))
    (array([1]), array([7]), array([5]))
    >>> across_edge(one, np.array([2]), np.array([-1]), np.array([8]))
    (array([2]), array([0]), array([2]))
    """
    uv = (np.stack([column, row], -1) + 0.5) / size[:, None]
    face, uv = on_face(direction_to(face, uv))
    column, row = nearest_texel(uv.T, size)
    return face, column, row


def face_footprint(directions, jacobian):
    """Eq. (13): d(u, v)/d(x, y) on the face, (N, 2, 2), of directions that change with the pixel.

    directions (N, 3), jacobian (N, 3, 2), whose columns are d_x and d_y.

    >>> d, d_x, d_y = [2.0, 0.0, 1.0], [4.0, 0.0, 0.0], [0.0, -2.0, -1.0]
    >>> face_footprint(np.array([d]), np.array([np.transpose([d_x, d_y])])) + 0.0
    array([[[0.5 , 0.25],
            [0.  , 0.5 ]]])
    """
    face, uv = on_face(directions)
    m = to_face_axes(directions, face)[:, 2, None, None]
    change = to_face_axes(jacobian, face)
    return (change[:, :2] - (2 * uv - 1)[..., None] * change[:, 2:]) / (2 * m)


def face_footprint_backward(grad_footprint, directions, jacobian):
    """Backward of `face_footprint`: grad_footprint (N, 2, 2) -> grad_directions, grad_jacobian."""
    # J = (P - p q) / (2 m), where P holds right . d_x, ..., down . d_y, p = 2 uv - 1, and q is
    # out . (d_x, d_y). So dJ = (dP - dp q - p dq) / (2 m) - J dm / m, where dp = 2 d(uv).
    face, uv = on_face(directions)
    m = to_face_axes(directions, face)[:, 2, None, None]
    q = to_face_axes(jacobian, face)[:, 2:]
    grad_P = grad_footprint / (2 * m)
    grad_q = -(grad_P * (2 * uv - 1)[..., None]).sum(1, keepdims=True)
    grad_uv = -2 * (grad_P * q).sum(2)
    grad_m = -(grad_footprint * face_footprint(directions, jacobian) / m).sum((1, 2))
    grad_jacobian = from_face_axes(np.concatenate([grad_P, grad_q], 1), face)
    grad_directions = on_face_backward(grad_uv, directions) + grad_m[:, None] * FRAMES[face, 2]
    return grad_directions, grad_jacobian


# --- look-ups ------------------------------------------------------------------------------------

def cube_pyramid(image, filter_mode, max_level):
    """The levels of six faces, which stand one above the other in image (6 n, n, C).

    No mean is over two faces, as it ends where n is odd.
    """
    size = image.shape[1]
    halvings = (size & -size).bit_length() - 1  # how often size can be divided by 2
    top = halvings if max_level is None else min(halvings, max_level)
    return pyramid(image, top if "mipmap" in filter_mode else 0)


def pack_cube(levels):
    """The levels of `cube_pyramid` -> Mipmap, whose width and height are those of a face."""
    mipmap = pack(levels)
    return mipmap._replace(height=mipmap.width)


def cube_texels(face, uv, size, filter_mode):
    """Eqs. (1) to (3) on a cube of 6 size^2 texels: index, weight, missing (K, N), K = 1 or 4.

    missing: the fourth texel at a corner of the cube. Its weight goes to the others in thirds.
    """
    if filter_mode == "nearest":
        column, row = np.minimum(nearest_texel(uv.T, size), size - 1)
        index = (face * size + row) * size + column
        return index[None], np.ones((1, len(uv))), np.zeros((1, len(uv)), bool)
    columns, column_weight = linear_texels(uv[:, 0], size)
    rows, row_weight = linear_texels(uv[:, 1], size)
    weight = each_pair(np.multiply, row_weight, column_weight)
    index, missing = four_texels(face, columns, rows, size)
    return index, (weight + (weight * missing).sum(0) / 3) * ~missing, missing


def four_texels(face, columns, rows, size):
    """The 2 x 2 texels in columns (2, N) and rows (2, N) of face (N,) -> index, missing (4, N).

    Beyond one edge of the face, the texel `across_edge` takes a texel's place. Beyond two, at a
    corner of the cube, there is none: it is missing, and has the index 0. size: a number, or (N,).
    """
    texel = np.stack([np.tile(face, (4, 1)), np.tile(columns, (2, 1)), rows.repeat(2, 0)])
    beyond = (texel[1:] < 0) | (texel[1:] >= size)
    missing = beyond.all(0)
    across = beyond[0] != beyond[1]
    texel[:, across] = across_edge(*texel[:, across], np.broadcast_to(size, across.shape)[across])
    face, column, row = texel
    return np.where(missing, 0, (face * size + row) * size + column), missing


def cube_map_taps(face, uv, level, mipmap, filter_mode):
    """The texels that make a colour: index, weight, missing (N, K), as `taps` of mipmapping.py."""
    found = []
    for at, share in mixture(level, filter_mode, len(mipmap.start) - 1):
        index, weight, missing = cube_texels(face, uv, mipmap.width[at], filter_mode)
        found.append((mipmap.start[at] + index, share * weight, missing))
    return tuple(part.T.copy() for part in map(np.concatenate, zip(*found, strict=True)))


def cube_map_taps_backward(grad_weight, missing, uv, level, mipmap, filter_mode):
    """Backward of `cube_map_taps`: grad_weight (N, K) -> grad_uv (N, 2), grad_level (N,)."""
    # A missing texel's weight went to the other three in thirds, so its gradient is the mean of
    # theirs. After that, all is as on a texture that has no border.
    N, K = grad_weight.shape
    if K > 1:
        grad = (grad_weight * ~missing).reshape(N, K // 4, 4)
        mean = grad.sum(2, keepdims=True) / 3
        grad_weight = np.where(missing.reshape(grad.shape), mean, grad).reshape(N, K)
    return taps_backward(grad_weight, np.ones(missing.shape, bool), uv, level, mipmap,
                         Sampler(filter_mode, "clamp", None))


def cube_texture(faces, directions, jacobian=None, bias=0.0, filter_mode="linear", max_level=None):
    """The colour that each pixel's direction sees on a cube map.

    faces (6, n, n, C), in the order +x, -x, +y, -y, +z, -z, directions (..., 3) -> colour (..., C).
    filter_mode, bias and max_level are those of `texture` in mipmapping.py; jacobian (..., 3, 2) is
    d(direction)/d(x, y). A direction shorter than SHORTEST, such as 0, has colour 0, no gradient.

    All arrays are read as float64. ValueError for what does not fit.
    """
    image, look = require_cube(faces, Footprint(directions, jacobian, bias), filter_mode, max_level)
    return cube_filtered(cube_pyramid(image, filter_mode, max_level), look, filter_mode)


def cube_texture_backward(grad_colour, faces, directions, jacobian=None, bias=0.0,
                          filter_mode="linear", max_level=None):
    """Backward of `cube_texture`: grad_colour (..., C) -> grad_faces, grad_directions,
    grad_jacobian, grad_bias, each of its argument's shape (None for a jacobian that is None).
    """
    image, look = require_cube(faces, Footprint(directions, jacobian, bias), filter_mode, max_level)
    grad_colour = require_gradient(grad_colour, image, look)
    levels = cube_pyramid(image, filter_mode, max_level)
    grad_levels, *grads = cube_filtered_backward(grad_colour, levels, look, filter_mode)
    return pyramid_backward(grad_levels).reshape(np.shape(faces)), *grads


def cube_filtered(levels, look, filter_mode):
    """The colours (..., C) that a Footprint of directions sees of a cube's levels."""
    mipmap = pack_cube(levels)
    seen, _, places = cube_places(mipmap, look, filter_mode)

    def colours(*at):
        index, weight, _ = cube_map_taps(*at, mipmap, filter_mode)
        return look_up(mipmap.texels, index, weight)

    return masked_scatter(in_parts(colours, *places), seen)


def cube_filtered_backward(grad_colour, levels, look, filter_mode):
    """Backward of `cube_filtered`: grad_colour (N, C) -> a gradient for each level,
    grad_directions, grad_jacobian, grad_bias.
    """
    mipmap = pack_cube(levels)
    # `cube_filtered` read upwards: the look-up, its taps, the level, the direction.
    seen, footprint, places = cube_places(mipmap, look, filter_mode)
    index, weight, missing = in_parts(lambda *at: cube_map_taps(*at, mipmap, filter_mode), *places)
    grad_texels, grad_weight = look_up_backward(grad_colour[seen.ravel()], mipmap.texels, index,
                                                weight)
    grad_uv, grad_level = in_parts(lambda *at: cube_map_taps_backward(*at, mipmap, filter_mode),
                                   grad_weight, missing, *places[1:])
    grad_footprint, grad_bias = footprint_level_backward(grad_level, footprint, mipmap)
    grads = on_faces_backward(Footprint(grad_uv, grad_footprint, grad_bias), look, seen)
    return unpack(grad_texels, pack(levels)), *grads


def all_cube_taps(mipmap, look, filter_mode):
    """Which pixels see anything (...), and of these N the `cube_map_taps`, all three."""
    seen, _, places = cube_places(mipmap, look, filter_mode)
    return seen, *in_parts(lambda *at: cube_map_taps(*at, mipmap, filter_mode), *places)


def cube_places(mipmap, look, filter_mode):
    """Which pixels see anything (...), and of these N the Footprint, and face, uv and level."""
    seen = (np.abs(look.uv) > SHORTEST).any(-1)
    face, footprint = on_faces(look, seen)
    return seen, footprint, (face, footprint.uv, footprint_level(footprint, mipmap, filter_mode))


def on_faces(look, seen):
    """Pixels' directions (..., 3), their change and bias -> of the N that are seen, where it is
    True: face (N,) and the Footprint on it.
    """
    directions, jacobian, bias = look
    face, uv = on_face(directions[seen])
    if jacobian is not None:
        jacobian = face_footprint(directions[seen], jacobian[seen])
        require((np.abs(jacobian) < LARGEST).all(), "a jacobian that is less than "
                f"{LARGEST:g} times as long as its direction", "a longer one; scale it down")
    return face, Footprint(uv, jacobian, bias[seen] if bias.ndim else bias)


def on_faces_backward(grad, look, seen):
    """Backward of `on_faces`: grad of the Footprint -> grad_directions, grad_jacobian, grad_bias.
    """
    directions = look.uv[seen]
    grad_directions = on_face_backward(grad.uv, directions)
    grad_jacobian = None
    if look.jacobian is not None:
        by_footprint, grad_jacobian = face_footprint_backward(grad.jacobian, directions,
                                                              look.jacobian[seen])
        grad_directions += by_footprint
        grad_jacobian = masked_scatter(grad_jacobian, seen)
    grad_bias = masked_scatter(grad.bias, seen) if look.bias.ndim else grad.bias
    return masked_scatter(grad_directions, seen), grad_jacobian, grad_bias


def require_cube(faces, look, filter_mode, max_level):
    """The arguments of `cube_texture`, look a Footprint with directions for uv -> the six faces one
    above the other (6 n, n, C), and look, as float64. ValueError if they do not fit.
    """
    faces = np.asarray(faces, float)
    require(faces.ndim == 4 and faces.size and len(faces) == 6 and faces.shape[1] == faces.shape[2],
            "faces (6, n, n, C) with at least one texel each", faces.shape)
    return require_texture(faces.reshape(-1, *faces.shape[2:]), look,
                           Sampler(filter_mode, "clamp", max_level), axes=3)
