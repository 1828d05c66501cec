"""neural_renderer: faces on their own, cubes of texels, and gradients that look along the picture.

Faces come as corners (F, 3, 3): x, y in ndc, y up, and z, the distance in front of the camera (w of
clip space). On screen, p = (1 + ndc) size / 2 and centres are at j + 1/2, as everywhere here; the
original counts from centres: its p is ours - 1/2, from -1/2 to size - 1/2.

    M = [p_0 p_1 p_2; 1 1 1]                       columns: a face's corners on screen         (1)
    c = M^-1 (x, y, 1),  u = clamp(c, 0, 1),  w = u / sum u         weights on screen          (2)
    z = 1 / sum_k w_k / z_k                        depth, right in perspective                 (3)
    t_k = (T - 1) w_k z / z_k                      place in the face's cube of T^3 texels      (4)
    colour = sum over 8 taps of texel prod_k a_k,  a_k = t_k - low_k or 1 - that               (5)
    light = A + D max(0, n . l)                    n: unit normal, l: towards the light        (6)

M^-1 is face_inv; its rows are the edge functions of lab 2 over 2A, and it is the M^-1 of lab 7.
What an edge does to the picture has a gradient in two approximate ways, beside lab 8's:

    g_i = -sum_j max(0, (I_j - I_beyond) . dL/dI_j) / (d_j + eps)   Kato: sweep along a line   (7)
    d_j = (2 / W) (x_j - x_edge) / share_i         how far corner i must go to bring it there  (8)
    S = 1 - prod_f (1 - D_f),  D = 1 / (1 + exp(-+ d^2 / sigma))    SoftRas: - inside          (9)

Sources: a reading of neural_renderer's rasterizer; Kato, Ushiku, Harada 2018; Liu et al. 2019
(SoftRas). Where the original's kernel does something else, the functions say so.
"""
import numpy as np

from course.given import inputs

from . import mipmapping, msaa, scanline, transforms

EDGES = (1, 2), (2, 0), (0, 1)  # edge k runs from the first to the second, opposite to vertex k
SOFT_END = 1e-6                 # a probability below this is not looked at, eq. (9)


# --- pass 1: faces ------------------------------------------------------------------------------


def corners_of(clip, faces):
    """clip (V, 4), faces (F, 3) -> corners (F, 3, 3): x, y in ndc, and z = w. No w is 0."""
    return np.concatenate([clip[:, :2] / clip[:, 3:], clip[:, 3:]], 1)[faces]


def on_screen(corners, width, height):
    """corners (F, 3, 3) -> screen (F, 3, 2) in pixels: the one place where conventions meet."""
    return (corners[..., :2] + 1) * [width / 2, height / 2]


def front_faces(screen, z):  # exercise 10.1 (1 point)
    """Which faces are drawn: bool (F,). screen (F, 3, 2), z (F, 3).

    Those that are counter-clockwise on screen, y up, with all three z > 0. A face without area is
    not drawn. (The original does not ask for z > 0.)

    >>> a, b, c = [0.0, 0.0], [4.0, 0.0], [0.0, 3.0]
    >>> front_faces(np.array([[a, b, c], [a, c, b], [a, b, b], [a, b, c]]),
    ...             np.array([[1.0, 1, 1], [1, 1, 1], [1, 1, 1], [1, 1, -1]]))
    array([ True, False, False, False])
    """
    side, other = screen[:, 1] - screen[:, 0], screen[:, 2] - screen[:, 0]
    return (side[:, 0] * other[:, 1] - other[:, 0] * side[:, 1] > 0) & (z > 0).all(1)


def face_inverse(screen):  # exercise 10.2 (2 points)
    """The inverse of eq. (1): screen (..., 3, 2), of an area other than 0 -> (..., 3, 3).

    Its product with (x, y, 1) is c: row k belongs to corner k.

    >>> face_inverse(np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 2.0]]))
    array([[-0.25, -0.5 ,  1.  ],
           [ 0.25,  0.  ,  0.  ],
           [ 0.  ,  0.5 ,  0.  ]])
    """
    # Row k is the edge function of the edge from i to j, opposite to corner k: n . p + constant.
    x, y = screen[..., 0], screen[..., 1]
    rows = [np.stack([y[..., i] - y[..., j], x[..., j] - x[..., i],
                      x[..., i] * y[..., j] - x[..., j] * y[..., i]], -1) for i, j in EDGES]
    double_area = rows[0][..., 2] + rows[1][..., 2] + rows[2][..., 2]
    return (np.stack(rows, -2) + 0.0) / double_area[..., None, None]


def face_inverse_backward(grad_inverse, inverse):
    """Backward of `face_inverse`, by its result: both (..., 3, 3) -> grad_screen (..., 3, 2)."""
    # d M^-1 = -M^-1 dM M^-1, as in lab 7.
    transposed = np.swapaxes(inverse, -1, -2)
    grad_matrix = -transposed @ grad_inverse @ transposed
    return np.swapaxes(grad_matrix[..., :2, :], -1, -2)


# --- pass 2: pixels -----------------------------------------------------------------------------


def weights_and_depth(inverse, z, x, y):  # exercise 10.3 (2 points)
    """Eqs. (2) and (3) at points of the screen: weight (..., 3), depth (...).

    inverse (..., 3, 3) of `face_inverse`, z (..., 3), all positive, x, y (...). The clamp is for
    points on an edge, where rounding makes some c_k negative. A point far outside does not become
    its nearest point of the face by this; of (1/4, 3/2, -3/4) comes (1/5, 4/5, 0).

    >>> inverse = np.array([[-0.25, -0.5, 1.0], [0.25, 0.0, 0.0], [0.0, 0.5, 0.0]])
    >>> weights_and_depth(inverse, np.array([1.0, 1.0, 4.0]), np.array(1.0), np.array(1.0))
    (array([0.25, 0.25, 0.5 ]), np.float64(1.6))
    """
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    clamped = np.clip(c, 0, 1)
    weight = clamped / (clamped[..., :1] + clamped[..., 1:2] + clamped[..., 2:])
    part = weight / z
    return weight, 1 / (part[..., 0] + part[..., 1] + part[..., 2])


def weights_and_depth_backward(grad_weight, grad_depth,  # exercise 10.4 (3 points)
                               inverse, z, x, y):
    """Backward of eqs. (2) and (3): grad_weight (..., 3), grad_depth (...) -> grad_inverse
    (..., 3, 3), grad_z (..., 3).

    depth depends on z directly, on inverse through weight. Where the clamp changes c_k, it counts
    as constant; where c_k is exactly 0 or 1 it does not.

    >>> inverse = np.array([[-0.25, -0.5, 1.0], [0.25, 0.0, 0.0], [0.0, 0.5, 0.0]])
    >>> z, x, y = np.array([1.0, 1.0, 4.0]), np.array(1.0), np.array(1.0)
    >>> weights_and_depth_backward(np.zeros(3), np.array(25.0), inverse, z, x, y)
    (array([[-24., -24., -24.],
           [-24., -24., -24.],
           [ 24.,  24.,  24.]]), array([16., 16.,  2.]))
    """
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight, depth = weights_and_depth(inverse, z, x, y)
    # depth = 1 / q, q = sum w_k / z_k.
    grad_q = (-grad_depth * depth**2)[..., None]
    grad_weight = grad_weight + grad_q / z
    grad_z = -grad_q * weight / z**2
    # w = u / s, s = sum u: the part along w is lost.
    total = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_c = (grad_weight - (grad_weight * weight).sum(-1, keepdims=True)) / total
    grad_c = np.where((c < 0) | (c > 1), 0, grad_c)
    return grad_c[..., None] * np.stack([x, y, np.ones_like(x)], -1)[..., None, :], grad_z


def covers(screen, x, y):
    """Is (x, y) in a face, border included? screen (..., 3, 2), counter-clockwise, x, y (...).

    Both faces at an edge cover a point that lies on it: no top-left rule; the z-buffer decides.
    """
    inside = np.ones(np.shape(x), bool)
    for i, j in EDGES:
        (x0, y0), (x1, y1) = np.moveaxis(screen[..., [i, j], :], (-2, -1), (0, 1))
        inside &= (y - y0) * (x1 - x0) >= (x - x0) * (y1 - y0)
    return inside


def pixel_box(screen, width, height):
    """The pixels whose centres lie in the box around a face, border included: screen (..., 3, 2)
    -> x0, y0, x1, y1 (...): columns x0 <= j < x1, rows y0 <= i < y1, perhaps none.
    """
    low = np.clip(np.ceil(screen.min(-2) - 0.5), 0, [width, height]).astype(int)
    high = np.clip(np.floor(screen.max(-2) + 0.5), low, [width, height]).astype(int)
    return low[..., 0], low[..., 1], high[..., 0], high[..., 1]


def rasterize_loop(corners, width, height, near=0.1, far=100.0):  # exercise 10.5 (3 points)
    """Face by face and pixel by pixel: the maps face_index (height, width), -1 for no face; weight
    (height, width, 3) of eq. (2), 0 there; depth (height, width) of eq. (3), np.inf there.

    corners (F, 3, 3). Of the `front_faces`, all that have a pixel's centre in their `pixel_box` and
    that `covers` it count, if near < depth < far. The nearest is seen; of equally deep ones, the
    first.

    >>> corners = np.array([[[-1.0, -1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, 1.0, 2.0]]])
    >>> face_index, weight, depth = rasterize_loop(corners, 4, 2)
    >>> face_index, depth
    (array([[ 0,  0,  0, -1],
           [ 0, -1, -1, -1]]), array([[ 2.,  2.,  2., inf],
           [ 2., inf, inf, inf]]))
    >>> weight[0, 1]
    array([0.375, 0.375, 0.25 ])
    """
    face_index, depth = np.full((height, width), -1), np.full((height, width), np.inf)
    weight = np.zeros((height, width, 3))
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        inverse = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        for i in range(y0, y1):
            for j in range(x0, x1):
                x, y = np.array(j + 0.5), np.array(i + 0.5)
                if covers(screen[f], x, y):
                    w, d = weights_and_depth(inverse, z[f], x, y)
                    if near < d < far and d < depth[i, j]:
                        face_index[i, j], weight[i, j], depth[i, j] = f, w, d
    return face_index, weight, depth


def fragments(corners, width, height, near, far):
    """Every pixel that every face covers, the first face first: yields pixel (N,) = row * width +
    column, face (N,), weight (N, 3), depth (N,) in chunks.
    """
    screen, z = on_screen(corners, width, height), corners[..., 2]
    drawn = np.flatnonzero(front_faces(screen, z))
    screen, z = screen[drawn], z[drawn]
    inverse, (x0, y0, x1, y1) = face_inverse(screen), pixel_box(screen, width, height)
    owner, row = scanline.expand(y0, y1 - y0)
    for part in scanline.chunks((x1 - x0)[owner]):
        span, column = scanline.expand(x0[owner[part]], (x1 - x0)[owner[part]])
        face, i, j = owner[part][span], row[part][span], column
        inside = covers(screen[face], j + 0.5, i + 0.5)
        face, i, j = face[inside], i[inside], j[inside]
        weight, depth = weights_and_depth(inverse[face], z[face], j + 0.5, i + 0.5)
        kept = (near < depth) & (depth < far)
        yield (i * width + j)[kept], drawn[face[kept]], weight[kept], depth[kept]


def rasterize(corners, width, height, near=0.1, far=100.0):
    """What `rasterize_loop` returns, bit for bit, for whole meshes."""
    face_index, depth = np.full(height * width, -1), np.full(height * width, np.inf)
    weight = np.zeros((height * width, 3))
    for pixel, face, w, d in fragments(corners, width, height, near, far):
        # The nearest of each pixel; of equally deep ones the first, for the sort is stable.
        order = np.lexsort((d, pixel))
        _, first = np.unique(pixel[order], return_index=True)
        nearest = order[first]
        nearest = nearest[d[nearest] < depth[pixel[nearest]]]
        at = pixel[nearest]
        face_index[at], weight[at], depth[at] = face[nearest], w[nearest], d[nearest]
    return (face_index.reshape(height, width), weight.reshape(height, width, 3),
            depth.reshape(height, width))


def rasterize_backward(grad_weight, grad_depth, face_index, corners):
    """Backward of `rasterize`: grad_weight (H, W, 3), grad_depth (H, W) -> grad_corners (F, 3, 3).

    Exact, the face of each pixel taken as given; where no face is seen, both gradients do nothing.
    (The original has it for the depth alone.)
    """
    height, width = face_index.shape
    screen, z = on_screen(corners, width, height), corners[..., 2]
    row, column = np.nonzero(face_index >= 0)
    face = face_index[row, column]
    seen, pixel_face = np.unique(face, return_inverse=True)
    inverse = face_inverse(screen[seen])
    grads = weights_and_depth_backward(grad_weight[row, column], grad_depth[row, column],
                                       inverse[pixel_face], z[face], column + 0.5, row + 0.5)
    grad_inverse, grad_z = (per_face(grad, pixel_face, len(seen)) for grad in grads)
    grad_corners = np.zeros(corners.shape)
    grad_screen = face_inverse_backward(grad_inverse, inverse)
    grad_corners[seen, :, :2] = grad_screen * [width / 2, height / 2]
    grad_corners[seen, :, 2] = grad_z
    return grad_corners


def per_face(values, face, count):
    """The sum of values (N, ...) over the rows of each face: -> (count, ...)."""
    flat = values.reshape(len(values), np.prod(values.shape[1:], dtype=int))
    total = np.stack([np.bincount(face, column, count) for column in flat.T], -1)
    return total.reshape(count, *values.shape[1:])


# --- pass 3: texture cubes ----------------------------------------------------------------------


def cube_taps(weight, depth, z, size):  # exercise 10.6 (3 points)
    """Eqs. (4) and (5): which 8 texels of its face's cube a pixel reads, and their weights.

    weight (N, 3), depth (N,) of `rasterize`, z (N, 3) of the face's corners; size = T >= 2
    -> index (N, 8) integers, tap (N, 8). Of t_k, what rounding brings above T - 1 is cut off; low_k
    is t_k rounded down, T - 2 at most. Tap n takes texel low_k if bit k of n (of value 1, 2, 4 for
    k = 0, 1, 2) is 0, and low_k + 1 if it is 1; texel [i, j, k] has index i T^2 + j T + k.

    >>> weight, z = np.array([[0.25, 0.25, 0.5]]), np.array([[1.0, 1.0, 4.0]])
    >>> index, tap = cube_taps(weight, np.array([1.6]), z, 2)  # t = 0.4, 0.4, 0.2
    >>> index
    array([[0, 4, 2, 6, 1, 5, 3, 7]])
    >>> tap.round(9)
    array([[0.288, 0.192, 0.192, 0.128, 0.072, 0.048, 0.048, 0.032]])
    """
    t = np.minimum((size - 1) * weight * depth[:, None] / z, size - 1)
    low = np.minimum(np.floor(t), size - 2).astype(int)
    index, tap = np.zeros((len(t), 8), int), np.ones((len(t), 8))
    for n in range(8):
        for k in range(3):
            upper = n >> k & 1
            index[:, n] = index[:, n] * size + low[:, k] + upper
            tap[:, n] *= t[:, k] - low[:, k] if upper else 1 - (t[:, k] - low[:, k])
    return index, tap


def cube_taps_backward(grad_tap, weight, depth, z, size):  # exercise 10.7 (3 points)
    """Backward of the taps: grad_tap (N, 8) -> grad_weight (N, 3), grad_depth (N,), grad_z (N, 3).

    weight, depth and z count as free here, each for itself. The texels are taken as given.

    >>> weight, z = np.array([[0.25, 0.25, 0.5]]), np.array([[1.0, 1.0, 4.0]])
    >>> grad_tap = np.array([[0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0]])  # their sum is t_0
    >>> grads = cube_taps_backward(grad_tap, weight, np.array([1.6]), z, 2)
    >>> tuple(grad.round(9) + 0.0 for grad in grads)
    (array([[1.6, 0. , 0. ]]), array([0.25]), array([[-0.4,  0. ,  0. ]]))
    """
    scale = (size - 1) / z
    t = scale * weight * depth[:, None]
    part = t - np.minimum(np.floor(t), size - 2)
    # Along axis k a tap is part_k or 1 - part_k: the others' product, with + or -.
    grad_t = np.zeros(t.shape)
    for n in range(8):
        factor = [part[:, k] if n >> k & 1 else 1 - part[:, k] for k in range(3)]
        for k, (i, j) in enumerate(EDGES):
            sign = 1 if n >> k & 1 else -1
            grad_t[:, k] += sign * grad_tap[:, n] * factor[i] * factor[j]
    grad_weight = grad_t * scale * depth[:, None]
    return grad_weight, (grad_t * scale * weight).sum(1), -grad_weight * weight / z


def sample_cubes(textures, face, index, tap):  # exercise 10.8 (1 point)
    """Eq. (5): textures (F, T, T, T, C), face (N,), index, tap (N, 8) of `cube_taps` -> (N, C).

    >>> textures = np.arange(16.0).reshape(2, 2, 2, 2, 1)
    >>> index, tap = np.array([[0, 4, 2, 6, 1, 5, 3, 7]]), np.array([[0.5, 0.5, 0, 0, 0, 0, 0, 0]])
    >>> sample_cubes(textures, np.array([1]), index, tap)
    array([[10.]])
    """
    texels, first = textures.reshape(-1, textures.shape[-1]), face * textures.shape[1]**3
    return sum(tap[:, n, None] * texels[first + index[:, n]] for n in range(8))


def sample_cubes_backward(grad_colour, textures, face, index, tap):  # exercise 10.9 (2 points)
    """Backward of eq. (5): grad_colour (N, C) -> grad_textures, shaped like textures, and grad_tap
    (N, 8).

    >>> textures = np.arange(16.0).reshape(2, 2, 2, 2, 1)
    >>> index, tap = np.array([[0, 4, 2, 6, 1, 5, 3, 7]]), np.array([[0.5, 0.5, 0, 0, 0, 0, 0, 0]])
    >>> grad_textures, grad_tap = sample_cubes_backward(np.array([[2.0]]), textures, np.array([1]),
    ...                                                 index, tap)
    >>> grad_textures[1].ravel(), grad_tap
    (array([1., 0., 0., 0., 1., 0., 0., 0.]), array([[16., 24., 20., 28., 18., 26., 22., 30.]]))
    """
    texels, first = textures.reshape(-1, textures.shape[-1]), face * textures.shape[1]**3
    cell = first[:, None] + index
    grad_textures = [np.bincount(cell.ravel(), (tap * grad[:, None]).ravel(), len(texels))
                     for grad in grad_colour.T]
    grad_tap = [(texels[cell[:, n]] * grad_colour).sum(1) for n in range(8)]
    return np.stack(grad_textures, -1).reshape(textures.shape), np.stack(grad_tap, 1)


def texel_weights(size):
    """Where on a face each texel of its cube lies: barycentrics (T, T, T, 3).

    A face sees the plane i + j + k = T - 1 alone. A texel beside it stands for its foot there, so
    that eight taps of a linear function give back that function. (The original divides i, j, k by
    their sum if this is above T - 1, and else leaves them, with a sum that is not 1.)
    """
    share = np.stack(np.indices((size, size, size)), -1) / (size - 1)
    return share + (1 - share.sum(-1, keepdims=True)) / 3


def bake(image, uv, faces, size):
    """A photograph image (h, w, C) as texture cubes: textures (F, T, T, T, C), bilinear, by uv
    (V, 2) of the corners of faces (F, 3). At the border the image's last texels go on. Two faces at
    an edge agree exactly only if they make a parallelogram in uv.
    """
    at = texel_weights(size).reshape(-1, 3) @ uv[faces]
    texels = mipmapping.texture(image, at, boundary="clamp")
    return texels.reshape(len(faces), size, size, size, -1)


def both_sides(faces, textures):
    """faces (F, 3), textures (F, T, T, T, C) -> the same and, after them, the same from behind."""
    return (np.concatenate([faces, faces[:, ::-1]]),
            np.concatenate([textures, textures.transpose(0, 3, 2, 1, 4)]))


# --- light --------------------------------------------------------------------------------------


def face_light(corners, ambient, directional, towards):  # exercise 10.10 (2 points)
    """Eq. (6): light (F, C) of faces with corners (F, 3, 3) in space, not on screen.

    ambient, directional (C,): colours; towards = l (3,): to the light, of any length: twice as long
    is twice as bright. n points to the side that sees the corners counter-clockwise; of a face with
    three corners in one place, n = 0.

    >>> corners = np.array([[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
    >>> face_light(corners, np.array([0.5, 0.0]), np.array([0.0, 2.0]), np.array([1.0, 0.0, 0.25]))
    array([[0.5, 0.5]])
    """
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    cosine = (area / np.where(length > 0, length, 1)) @ towards
    return ambient + np.maximum(cosine, 0)[:, None] * directional


def face_light_backward(grad_light, corners, ambient,  # exercise 10.11 (3 points)
                        directional, towards):
    """Backward of eq. (6): grad_light (F, C) -> grad_corners (F, 3, 3), grad_ambient (C,),
    grad_directional (C,), grad_towards (3,). Where n . l <= 0, the light is constant.

    >>> corners = np.array([[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
    >>> lights = np.array([0.5]), np.array([2.0]), np.array([1.0, 0.0, 0.25])
    >>> grad_corners, *grads = face_light_backward(np.array([[3.0]]), corners, *lights)
    >>> grads
    [array([3.]), array([0.75]), array([0., 0., 6.])]
    >>> grad_corners + 0.0
    array([[[ 0.,  0.,  3.],
            [ 0.,  0., -3.],
            [ 0.,  0.,  0.]]])
    """
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    length[length == 0] = 1
    normal = area / length
    cosine = (normal @ towards)[:, None]
    grad_cosine = np.where(cosine > 0, (grad_light * directional).sum(1, keepdims=True), 0)
    # n = N / |N|, N = (b - a) x (c - a): G . (db x (c - a) + (b - a) x dc), turned round.
    grad_area = grad_cosine * (towards - cosine * normal) / length
    grad_b, grad_c = np.cross(c - a, grad_area), np.cross(grad_area, b - a)
    return (np.stack([-grad_b - grad_c, grad_b, grad_c], 1), grad_light.sum(0),
            (grad_light * np.maximum(cosine, 0)).sum(0), (grad_cosine * normal).sum(0))


# --- the sweep ----------------------------------------------------------------------------------


def edge_lines(a, b, height):  # exercise 10.12 (2 points)
    """Where the edge from a to b (2,), on screen, crosses the rows of a picture's centres.

    -> row (K,) integers, ascending, those with 0 <= row < height whose centre y = row + 1/2 is
    from a_y to b_y, both included (none if a_y = b_y); crossing (K,): x there; share (K, 2): by how
    much the crossing moves if a alone, or b alone, is moved by 1 along x.

    >>> row, crossing, share = edge_lines(np.array([8.0, 3.5]), np.array([4.0, 1.5]), 3)
    >>> row, crossing, share.T
    (array([1, 2]), array([4., 6.]), array([[0. , 0.5],
           [1. , 0.5]]))
    """
    low, high = min(a[1], b[1]), max(a[1], b[1])
    row = np.arange(max(np.ceil(low - 0.5), 0), min(np.floor(high + 0.5), height)).astype(int)
    if a[1] == b[1]:
        row = row[:0]
    toward_b = (row + 0.5 - a[1]) / (b[1] - a[1])
    return row, a[0] + toward_b * (b[0] - a[0]), np.stack([1 - toward_b, toward_b], -1)


def sweep_line(grad_colour, colour, sees, crossing, side,  # exercise 10.13 (3 points)
               share, eps=1e-4):
    """Eqs. (7) and (8): one edge on one line of pixels -> the gradient (2,) of its ends, by ndc.

    grad_colour, colour (W, C): the line, centres at j + 1/2; sees (W,) bool: the pixel sees the
    edge's face; crossing: where the edge is; side: 1 if outside is where j grows, else -1;
    share (2,): of `edge_lines`. An end of share 0 has gradient 0.

    inner is the last pixel whose centre is not outside of the crossing; outer is its neighbour
    outside. If one of them is not in the picture, the gradient is 0. Else it has two sums:

    - The edge moves out, if inner sees the face: over outer and all pixels beyond it, up to the
      picture's border, whatever they see. I_beyond is inner's colour.
    - The edge moves in: over inner and all pixels on its side, those that see the face. I_beyond
      is outer's colour.

    I_j becoming I_beyond must lower the loss, else max(0, ...) is 0. d_j is in ndc, where the line
    has length 2 = W pixels. It has the sign of the way, side or -side, and so has eps, also where
    d_j = 0.

    >>> colour, grad_colour = np.array([[0.0], [1.0], [1.0], [0.0], [0.0]]), np.zeros((5, 1))
    >>> grad_colour[4] = -1.0   # it should be brighter: the edge at 2.75 is to go to 4.5
    >>> sees = colour[:, 0] > 0
    >>> sweep_line(grad_colour, colour, sees, 2.75, 1, np.array([0.25, 0.75]), eps=0.0).round(6)
    array([-0.357143, -1.071429])
    """
    inner = int(np.floor(crossing - 0.5) if side > 0 else np.ceil(crossing - 0.5))
    outer, pixel = inner + side, np.arange(len(colour))
    if not (0 <= min(inner, outer) and max(inner, outer) < len(colour)):
        return np.zeros(2)
    is_out = (pixel - inner) * side > 0
    beyond = np.where(is_out[:, None], colour[inner], colour[outer])
    pull = ((colour - beyond) * grad_colour).sum(1)
    asked = (pull > 0) & np.where(is_out, sees[inner], sees)
    way = np.where(is_out, side, -side)[asked] * eps
    distance = 2 / len(colour) * (pixel[asked] + 0.5 - crossing)
    return np.array([-(pull[asked] / (distance / s + way)).sum() if s > 0 else 0.0 for s in share])


def sweep_backward_loop(grad_colour, colour, face_index, corners, eps=1e-4):
    """The outline's gradient, edge by edge and line by line: grad_corners (F, 3, 3), 0 for z.

    grad_colour, colour (H, W, C); face_index (H, W) of `rasterize`, corners (F, 3, 3). Rows give
    the gradients by x, columns those by y.

    The paper lets no gradient pass where something hides the edge. The kernel, and so this, asks
    for that on the way out alone. On the way in it lets eps be negative for d_j = 0 on either side,
    which turns the gradient round on one of them; and its bound for that way divides by 0 where the
    third edge is parallel to the line and the line goes through a corner. Neither is repeated here.
    """
    grad_corners = np.zeros(corners.shape)
    height, width = face_index.shape
    screen = on_screen(corners, width, height)
    for f in np.flatnonzero(front_faces(screen, corners[..., 2])):
        for axis, swapped in (0, False), (1, True):
            for i, j in EDGES:
                a, b = (screen[f, k, ::-1] if swapped else screen[f, k] for k in (i, j))
                # Going up, a counter-clockwise face is on the left, where x is less.
                side = int(np.sign(b[1] - a[1])) * (-1 if swapped else 1)
                lines = edge_lines(a, b, width if swapped else height)
                for line, crossing, share in zip(*lines, strict=True):
                    at = (slice(None), line) if swapped else line
                    sees = face_index[at] == f
                    grad_corners[f, [i, j], axis] += sweep_line(
                        grad_colour[at], colour[at], sees, crossing, side, share, eps)
    return grad_corners


def sweep_backward(grad_colour, colour, face_index, corners, eps=1e-4):
    """What `sweep_backward_loop` returns, to rounding, for whole meshes."""
    height, width = face_index.shape
    screen = on_screen(corners, width, height)
    drawn = np.flatnonzero(front_faces(screen, corners[..., 2]))
    across = (axis.swapaxes(0, 1) for axis in (grad_colour, colour, face_index))
    grad_corners = np.zeros(corners.shape)
    grad_corners[drawn, :, 0] = sweep_rows(grad_colour, colour, face_index, screen[drawn], drawn, 1,
                                           eps)
    grad_corners[drawn, :, 1] = sweep_rows(*across, screen[drawn][..., ::-1], drawn, -1, eps)
    return grad_corners


def sweep_rows(grad_colour, colour, face_index, screen, drawn, winding, eps):
    """`sweep_line` on all rows, for the faces drawn (D,) at screen (D, 3, 2): grad (D, 3) by ndc x.
    winding: 1 if they are counter-clockwise, else -1.
    """
    grad = np.zeros(screen.shape[:2])
    for i, j in EDGES:
        a, b = screen[:, i], screen[:, j]
        face, row, crossing, share = all_edge_lines(a, b, len(face_index))
        side = (winding * np.sign(b[:, 1] - a[:, 1])[face]).astype(int)
        for line, ratio in pulls(grad_colour, colour, face_index, drawn[face], row, crossing, side,
                                 share, eps):
            for end, k in enumerate((i, j)):
                grad[:, k] -= np.bincount(face[line], ratio[:, end], len(grad))
    return grad


def all_edge_lines(a, b, height):
    """`edge_lines` of edges a, b (D, 2): face (K,), row (K,), crossing (K,), share (K, 2)."""
    low, high = np.minimum(a[:, 1], b[:, 1]), np.maximum(a[:, 1], b[:, 1])
    first = np.clip(np.ceil(low - 0.5), 0, height).astype(int)
    last = np.where(low == high, first, np.clip(np.floor(high + 0.5), first, height)).astype(int)
    face, row = scanline.expand(first, last - first)
    a, b = a[face], b[face]
    toward_b = (row + 0.5 - a[:, 1]) / (b[:, 1] - a[:, 1])
    crossing = a[:, 0] + toward_b * (b[:, 0] - a[:, 0])
    return face, row, crossing, np.stack([1 - toward_b, toward_b], -1)


def pulls(grad_colour, colour, face_index, face, row, crossing, side, share, eps):
    """Yields, for chunks of the pixels that K lines pass: line (N,), which of the lines, and the
    terms of eq. (7) for both ends (N, 2); 0 where the pixel has no say.
    """
    width = face_index.shape[1]
    inner = np.where(side > 0, np.floor(crossing - 0.5), np.ceil(crossing - 0.5))
    kept = (np.minimum(inner, inner + side) >= 0) & (np.maximum(inner, inner + side) < width)
    line = np.flatnonzero(kept)
    inner = np.where(kept, inner, 0).astype(int)
    outer = np.where(kept, inner + side, 0)
    asked = (grad_colour != 0).any(2)
    for lines in (line[part] for part in scanline.chunks(np.full(len(line), width))):
        at, pixel = np.nonzero(asked[row[lines]])
        at = lines[at]
        is_out, y = (pixel - inner[at]) * side[at] > 0, row[at]
        counts = face_index[y, np.where(is_out, inner[at], pixel)] == face[at]
        at, pixel, is_out, y = (values[counts] for values in (at, pixel, is_out, y))
        beyond = colour[y, np.where(is_out, inner[at], outer[at])]
        pull = ((colour[y, pixel] - beyond) * grad_colour[y, pixel]).sum(1)
        lowers = pull > 0
        at, pixel, is_out, pull = (values[lowers] for values in (at, pixel, is_out, pull))
        way = np.where(is_out, side[at], -side[at]) * eps
        distance = 2 / width * (pixel + 0.5 - crossing[at])
        # pull / (distance / share + way), 0 for share 0
        scaled = distance[:, None] + way[:, None] * share[at]
        yield at, pull[:, None] * share[at] / np.where(share[at] > 0, scaled, 1)


# --- SoftRas ------------------------------------------------------------------------------------


def soft_fragments(screen, width, height, sigma):
    """The pixels near enough to a face to see it, eq. (9): pixel, face (N,), and of the point of
    the face's border that is nearest: edge (N,), t (N,) along it, away (N, 2) from it to the
    centre, and sign (N,), 1 inside and -1 outside.
    """
    reach = np.sqrt(sigma * np.log(1 / SOFT_END - 1))
    low, high = screen.min(1) - reach, screen.max(1) + reach
    x0, y0, x1, y1 = pixel_box(np.stack([low, high], 1), width, height)
    owner, row = scanline.expand(y0, y1 - y0)
    span, column = scanline.expand(x0[owner], (x1 - x0)[owner])
    face, row = owner[span], row[span]
    centre = np.stack([column, row], -1) + 0.5
    edge, t, away, sign = nearest_on_border(centre, screen[face])
    near = (sign > 0) | ((away**2).sum(1) < reach**2)
    return (row * width + column)[near], face[near], edge[near], t[near], away[near], sign[near]


def nearest_on_border(point, screen):
    """The point of a triangle's border that is nearest: point (N, 2), screen (N, 3, 2), of either
    winding -> edge, t (N,), away (N, 2), sign (N,), as of `soft_fragments`.
    """
    start, end = (screen[:, list(ends)] for ends in zip(*EDGES, strict=True))
    along, from_start = end - start, point[:, None] - start
    length = (along**2).sum(2)
    t = np.clip((from_start * along).sum(2) / np.where(length > 0, length, 1), 0, 1)
    away = from_start - t[..., None] * along
    edge = (away**2).sum(2).argmin(1)
    e = along[..., 0] * from_start[..., 1] - along[..., 1] * from_start[..., 0]
    inside = (e > 0).all(1) | (e < 0).all(1)
    n = np.arange(len(point))
    return edge, t[n, edge], away[n, edge], np.where(inside, 1, -1)


def soft_silhouette(screen, width, height, sigma):
    """Eq. (9): S (height, width), from 0 to 1. screen (F, 3, 2), sigma in pixels^2.

    Faces of either winding count. Where n faces lie over each other or side by side, a pixel on the
    border has 1 - 1/2^n. (SoftRas measures in ndc, sigma 1e-5 there; which is 0.01
    pixels^2 at 64 x 64; outside, a face with D below 1e-4 is left out there.)
    """
    pixel, _, _, _, away, sign = soft_fragments(screen, width, height, sigma)
    # log(1 - D) = -log(1 + exp(s)), s = +- d^2 / sigma
    total = np.bincount(pixel, np.logaddexp(0, sign * (away**2).sum(1) / sigma), width * height)
    return -np.expm1(-total).reshape(height, width)


def soft_silhouette_backward(grad_silhouette, screen, sigma):
    """Backward of eq. (9): grad_silhouette (H, W) -> grad_screen (F, 3, 2), exact."""
    height, width = grad_silhouette.shape
    pixel, face, edge, t, away, sign = soft_fragments(screen, width, height, sigma)
    s = sign * (away**2).sum(1) / sigma
    total = np.bincount(pixel, np.logaddexp(0, s), width * height)
    # dS = exp(-total) D ds
    probability = np.exp(-np.logaddexp(0, -s))
    grad_s = grad_silhouette.ravel()[pixel] * np.exp(-total[pixel]) * probability
    # d(away^2) = 2 away . (-(1 - t) da - t db): t is at its best, or fixed.
    grad_near = -2 * (grad_s * sign / sigma)[:, None] * away
    grad_screen = np.zeros(screen.shape)
    ends = np.array(EDGES)[edge]
    for k, share in enumerate((1 - t, t)):
        for axis in 0, 1:
            flat = np.bincount(3 * face + ends[:, k], share * grad_near[:, axis], 3 * len(screen))
            grad_screen[..., axis] += flat.reshape(-1, 3)
    return grad_screen


# --- the renderer -------------------------------------------------------------------------------


def shade_cubes(corners, textures, light, width, height, background, near=0.1, far=100.0):
    """Passes 2 and 3: colour (H, W, C), and the maps face_index, weight, depth.

    corners (F, 3, 3), textures (F, T, T, T, C), light (F, C), background (C,).
    """
    face_index, weight, depth = rasterize(corners, width, height, near, far)
    colour, seen = np.tile(np.asarray(background, float), (height, width, 1)), face_index >= 0
    face = face_index[seen]
    taps = cube_taps(weight[seen], depth[seen], corners[face, :, 2], textures.shape[1])
    colour[seen] = sample_cubes(textures, face, *taps) * light[face]
    return colour, face_index, weight, depth


def shade_cubes_backward(grad_colour, corners, textures, light, face_index, weight, depth):
    """Backward of `shade_cubes` inside of faces, exact: grad_colour (H, W, C) -> grad_corners
    (F, 3, 3), grad_textures, grad_light (F, C). (The original leaves out grad_corners.)
    """
    seen = face_index >= 0
    face, grad_colour = face_index[seen], grad_colour[seen]
    pixels = weight[seen], depth[seen], corners[face, :, 2], textures.shape[1]
    index, tap = cube_taps(*pixels)
    sampled = sample_cubes(textures, face, index, tap)
    grad_light = per_face(grad_colour * sampled, face, len(corners))
    grad_textures, grad_tap = sample_cubes_backward(grad_colour * light[face], textures, face,
                                                    index, tap)
    grad_weight, grad_depth, grad_z = np.zeros(weight.shape), np.zeros(depth.shape), 0
    grad_weight[seen], grad_depth[seen], grad_z = cube_taps_backward(grad_tap, *pixels)
    grad_corners = rasterize_backward(grad_weight, grad_depth, face_index, corners)
    grad_corners[..., 2] += per_face(grad_z, face, len(corners))
    return grad_corners, grad_textures, grad_light


def render(vertices, faces, textures, clip_from_world, lights, width, height, background,
           samples=2):
    """The original's picture (height, width, C), and the buffers of `render_backward`.

    vertices (V, 3), faces (F, 3), textures (F, T, T, T, C), clip_from_world (4, 4); lights: ambient
    (C,), directional (C,), towards (3,) of `face_light`; background (C,). Its antialiasing is
    samples = 2: 2 x 2 of them in a pixel, and their mean. ValueError for what does not fit.
    """
    inputs.require_cubes(vertices, faces, textures, clip_from_world, lights, width, height,
                         background, samples)
    clip = transforms.transform(transforms.to_homogeneous(vertices), clip_from_world)
    corners, light = corners_of(clip, faces), face_light(vertices[faces], *lights)
    colour, *maps = shade_cubes(corners, textures, light, samples * width, samples * height,
                                background)
    return msaa.box_resolve(colour, samples), (clip, corners, light, colour, *maps)


def render_backward(grad_picture, buffers, vertices, faces, textures, clip_from_world, lights,
                    samples=2, eps=1e-4):
    """grad_picture (H, W, C) -> grad_vertices (V, 3), grad_textures, and the gradients of the three
    lights. Approximate for outlines (`sweep_backward`), exact for all else.
    """
    clip, corners, light, colour, face_index, weight, depth = buffers
    grad_colour = msaa.box_resolve_backward(grad_picture, colour, samples)
    grad_corners, grad_textures, grad_light = shade_cubes_backward(
        grad_colour, corners, textures, light, face_index, weight, depth)
    grad_corners += sweep_backward(grad_colour, colour, face_index, corners, eps)
    grad_clip = clip_backward(per_vertex(grad_corners, faces, len(clip)), clip)
    grad_points, _ = transforms.transform_backward(
        grad_clip, transforms.to_homogeneous(vertices), clip_from_world)
    grad_world, *grad_lights = face_light_backward(grad_light, vertices[faces], *lights)
    grad_vertices = grad_points[:, :3] + per_vertex(grad_world, faces, len(clip))
    return grad_vertices, grad_textures, grad_lights


def per_vertex(grad_corners, faces, count):
    """Sums over the corners at each vertex: grad_corners (F, 3, 3) -> (count, 3)."""
    return np.stack([np.bincount(faces.ravel(), grad.ravel(), count)
                     for grad in np.moveaxis(grad_corners, -1, 0)], -1)


def clip_backward(grad_vertex, clip):
    """Backward of `corners_of` for vertices: by ndc x, y and z = w (V, 3) -> grad_clip (V, 4)."""
    grad_xy = grad_vertex[:, :2] / clip[:, 3:]
    grad_w = grad_vertex[:, 2] - (grad_xy * clip[:, :2]).sum(1) / clip[:, 3]
    return np.column_stack([grad_xy, np.zeros(len(clip)), grad_w])
