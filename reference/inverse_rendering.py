"""Inverse rendering: from pictures back to the scene, by the gradient of everything before.

    I = R(theta),   theta = argmin L(R(theta), T)     theta: positions, colours, pose, texture   (1)
    R: positions -> clip -> face_index, depth -> barycentric -> colour -> picture
                 1       2                    2              5, 6      8                      lab
    L = mean (I - T)^2                                squared error, T is the target             (2)
    m' = b1 m + (1 - b1) g,   s' = b2 s + (1 - b2) g^2,   x' = x - rate m^ / (sqrt(s^) + epsilon),
    m^ = m' / (1 - b1^n),     s^ = s' / (1 - b2^n)    step n of Adam, from n = 1                 (3)
    v' = q v q* / |q|^2                               rotation by a quaternion q = (w, x, y, z)  (4)
    L = 1 - sum(c t) / sum(c + t - c t)               soft IoU loss of silhouettes c and t       (5)
    d_v = x_v - mean of x over v's neighbours         uniform Laplacian, 0 where flat and even   (6)

Each lab wrote a link of the chain R and its backward pass; here they are joined. The gradient of a
position comes along two ways: through the colours inside of faces (lab 7; with a texture, lab 6
comes before it), and through the edges between pixels (lab 8). A face of one colour has only the
second. grad_x of a parameter x has its shape. Adam's m and s are arrays like x, at first 0; what
they hold between two steps is the caller's to keep.

Sources: lecture "Differentiable graphics 1"; Kingma and Ba 2015 (3); Shoemake 1985 (4); Kato et al.
2018 (5); Taubin 1995 (6); Laine et al. 2020.
"""
import numpy as np

from course.given import inputs

from . import (
    antialiasing,
    interpolation,
    rasterization,
    scanline,
    texturing,
    transforms,
    vertex_gradients,
)


def squared_error(picture, target):  # exercise 9.1 (1 point)
    """Eq. (2): the mean, over all pixels and channels, of squared differences: a number.

    picture, target: floats of one shape, any.

    >>> squared_error(np.array([[[1.0, 2.0], [3.0, 4.0]]]), np.array([[[1.0, 0.0], [3.0, 0.0]]]))
    np.float64(5.0)
    """
    return ((picture - target)**2).mean()


def squared_error_backward(grad_loss, picture, target):  # exercise 9.2 (1 point)
    """Backward of eq. (2): grad_loss, a number -> grad_picture, of the picture's shape.

    >>> squared_error_backward(10.0, np.array([[1.0, 2.0, 3.0, 8.0]]), np.array([[1.0, 0, 3, 4]]))
    array([[ 0., 10.,  0., 20.]])
    """
    return grad_loss * 2 * (picture - target) / picture.size


def adam_step(x, grad_x, mean, square, step, rate,  # exercise 9.3 (3 points)
              beta_1=0.9, beta_2=0.999, epsilon=1e-8):
    """Eq. (3): one step of Adam downhill -> x, mean, square after it, the arguments unchanged.

    x, grad_x, mean (m), square (s): arrays of one shape, any; step (n) = 1 is the first one, to
    which mean and square come as 0. Every element goes its own way: the first step is nearly by
    rate in each, whatever the size of its gradient, if that is far above epsilon.

    >>> x, grad_x, zero = np.array([5.0, 5.0]), np.array([4.0, -100.0]), np.zeros(2)
    >>> x, mean, square = adam_step(x, grad_x, zero, zero, 1, rate=0.25)
    >>> x.round(6), mean.round(6), square.round(6)
    (array([4.75, 5.25]), array([  0.4, -10. ]), array([ 0.016, 10.   ]))
    """
    mean = beta_1 * mean + (1 - beta_1) * grad_x
    square = beta_2 * square + (1 - beta_2) * grad_x**2
    # Both began at 0, and are by these factors too small.
    corrected_mean, corrected_square = mean / (1 - beta_1**step), square / (1 - beta_2**step)
    return x - rate * corrected_mean / (np.sqrt(corrected_square) + epsilon), mean, square


def quaternion_product(p, q):  # exercise 9.4 (2 points)
    """The product p q of quaternions: of the two rotations, first q's, then p's.

    p, q (..., 4), shapes that broadcast, elements (w, x, y, z) -> (..., 4). They are w + x i + y j
    + z k, with i i = j j = k k = -1, i j = k, j k = i, k i = j and, in the other order, j i = -k,
    k j = -i, i k = -j.

    >>> quaternion_product(np.array([0.0, 1.0, 0.0, 0.0]), np.array([2.0, 0.0, 3.0, 0.0]))
    array([0., 2., 0., 3.])
    """
    pw, px, py, pz = np.moveaxis(p, -1, 0)
    qw, qx, qy, qz = np.moveaxis(q, -1, 0)
    return np.stack([pw * qw - px * qx - py * qy - pz * qz,
                     pw * qx + px * qw + py * qz - pz * qy,
                     pw * qy + py * qw + pz * qx - px * qz,
                     pw * qz + pz * qw + px * qy - py * qx], -1)


def quaternion_matrix(q):  # exercise 9.5 (2 points)
    """Eq. (4): the matrix (4, 4) that rotates points as q (4,) does.

    q = (cos(angle/2), sin(angle/2) axis) rotates by angle about an axis of length 1, as lab 1's
    rotate; so does any multiple of it, of a length from 1e-100 to 1e100. In eq. (4) the point v is
    the quaternion (0, v), and q* has the other sign in x, y, z. `cross_matrix`, below, is given.

    >>> quaternion_matrix(np.array([2.0, 0.0, 0.0, 2.0])).round(9) @ np.array([1.0, 5.0, 7.0, 1.0])
    array([-5.,  1.,  7.,  1.])
    """
    # (w, u) (0, v) (w, -u) = (0, v') with v' = |q|^2 v + 2 w u x v + 2 u x (u x v).
    matrix, K = np.eye(4), cross_matrix(q[1:])
    matrix[:3, :3] += 2 / (q @ q) * (q[0] * K + K @ K)
    return matrix


def quaternion_matrix_backward(grad_matrix, q):  # exercise 9.6 (4 points)
    """Backward of `quaternion_matrix`: grad_matrix (4, 4) -> grad_q (4,).

    The last row and column of the matrix are constant. All four numbers of q count as free; its
    length makes no difference to the matrix, so grad_q is at right angles to q.

    >>> grad_matrix = np.zeros((4, 4))
    >>> grad_matrix[1, 0] = 3.0  # element [1, 0] is 2 (x y + w z) / |q|^2
    >>> quaternion_matrix_backward(grad_matrix, np.array([2.0, 0.0, 0.0, 1.0])) + 0.0
    array([-0.72,  0.  ,  0.  ,  1.44])
    """
    # R = I + s B, B = w K + K K, s = 2 / |q|^2. With G for grad_R, the loss changes by
    # G . B ds + s G . (dw K + w dK + dK K + K dK), and ds = -s^2 q . dq.
    G, K = grad_matrix[:3, :3], cross_matrix(q[1:])
    s, w = 2 / (q @ q), q[0]
    grad_K = s * (w * G + G @ K.T + K.T @ G)
    grad_xyz = [grad_K[2, 1] - grad_K[1, 2], grad_K[0, 2] - grad_K[2, 0],
                grad_K[1, 0] - grad_K[0, 1]]
    return np.append(s * (G * K).sum(), grad_xyz) - s**2 * (G * (w * K + K @ K)).sum() * q


def cross_matrix(u):
    """The matrix K (3, 3) with K v = u x v; u (3,)."""
    x, y, z = u
    return np.array([[ 0, -z,  y],
                     [ z,  0, -x],
                     [-y,  x,  0]])


def rotation_angle(p, q):  # exercise 9.7 (2 points)
    """By what angle, from 0 to pi, do two rotations differ? p, q (..., 4) of length 1 -> (...).

    It is the angle of the rotation from one to the other. q and -q are the same rotation. Every
    angle must keep its digits: one of 1e-9 comes out right to 1e-15, one of pi - 1e-6 to 1e-14.

    >>> quarter = np.array([1.0, 0.0, 0.0, 1.0]) / np.sqrt(2)
    >>> rotation_angle(quarter, np.array([1.0, 0.0, 0.0, 0.0])).round(6)
    np.float64(1.570796)
    """
    # Between p and q is half of the angle, as between points of a circle; arccos (p . q) would lose
    # the digits of a small one. Of a rhombus's two diagonals, the shorter is to q or to -q.
    diagonals = np.sort([np.linalg.norm(p - q, axis=-1), np.linalg.norm(p + q, axis=-1)], 0)
    return 4 * np.arctan2(diagonals[0], diagonals[1])


def silhouette_loss(coverage, target):  # exercise 9.8 (1 point)
    """Eq. (5), soft IoU (Jaccard): 1 - intersection over union of two silhouettes, a number.

    coverage, target: floats of one shape, any, from 0 to 1: how much of each pixel is covered. Not
    both are 0 everywhere. It is 1 for two that do not meet, and 0 for equal ones of 0 and 1. Pixels
    covered in part count in part: with c = t = 1/2 it is 2/3, and its least is not at c = t.

    >>> silhouette_loss(np.array([1.0, 1.0, 0.5, 0.0]), np.array([0.0, 1.0, 1.0, 0.0])).round(9)
    np.float64(0.5)
    """
    return 1 - (coverage * target).sum() / (coverage + target - coverage * target).sum()


def silhouette_loss_backward(grad_loss, coverage, target):  # exercise 9.9 (2 points)
    """Backward of eq. (5): grad_loss, a number -> grad_coverage, of coverage's shape.

    >>> coverage, target = np.array([1.0, 1.0, 0.5, 0.0]), np.array([0.0, 1.0, 1.0, 0.0])
    >>> silhouette_loss_backward(18.0, coverage, target)
    array([ 3., -6., -6.,  3.])
    """
    # L = 1 - A / U: dL = -dA / U + A dU / U^2, with dA = t dc and dU = (1 - t) dc in each pixel.
    both, either = (coverage * target).sum(), (coverage + target - coverage * target).sum()
    return grad_loss * (both / either * (1 - target) - target) / either


def laplacian(positions, edges):  # exercise 9.10 (2 points)
    """Eq. (6): how far each vertex is from the middle of its neighbours: d (V, C).

    positions (V, C), C >= 1; edges (E, 2) integers: two neighbours each, every edge once, in
    either order. A vertex of no edge has d = 0.

    >>> positions = np.array([[0.0, 3.0], [4.0, 5.0], [8.0, 1.0], [9.0, 9.0]])
    >>> laplacian(positions, np.array([[0, 1], [1, 2]]))
    array([[-4., -2.],
           [ 0.,  3.],
           [ 4., -4.],
           [ 0.,  0.]])
    """
    count, (vertex, neighbour) = len(positions), np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=count)[:, None]
    total = np.stack([np.bincount(vertex, x[neighbour], count) for x in positions.T], -1)
    return np.where(valence > 0, positions - total / np.maximum(valence, 1), 0)


def laplacian_backward(grad_laplacian, positions, edges):  # exercise 9.11 (3 points)
    """Backward of eq. (6): grad_laplacian (V, C) -> grad_positions (V, C).

    Eq. (6) is linear, so that only the shape of positions counts.

    >>> positions = np.array([[0.0], [4.0], [8.0], [9.0]])
    >>> grad_laplacian = np.array([[0.0], [1.0], [10.0], [100.0]])
    >>> laplacian_backward(grad_laplacian, positions, np.array([[0, 1], [1, 2]]))
    array([[-0.5],
           [-9. ],
           [ 9.5],
           [ 0. ]])
    """
    # d = x - W x with W_vn = 1 / valence_v for each neighbour n of v: grad_x = grad_d - W^T grad_d.
    count, (vertex, neighbour) = len(positions), np.concatenate([edges, edges[:, ::-1]]).T
    valence = np.bincount(vertex, minlength=count)[:, None]
    share = grad_laplacian / np.maximum(valence, 1)
    total = np.stack([np.bincount(neighbour, g[vertex], count) for g in share.T], -1)
    return np.where(valence > 0, grad_laplacian, 0) - total


def laplacian_energy(positions, edges):
    """The sum of |d_v|^2 over all vertices, a thin plate's energy: the less, the smoother."""
    return (laplacian(positions, edges)**2).sum()


def laplacian_energy_backward(grad_energy, positions, edges):
    """Backward of `laplacian_energy`: grad_energy, a number -> grad_positions (V, C)."""
    grad_laplacian = 2 * grad_energy * laplacian(positions, edges)
    return laplacian_backward(grad_laplacian, positions, edges)


# --- the pipeline: labs 1, 2, 5, 7, 8, and 6 for textures ---------------------------------------


def to_clip(positions, clip_from_model):
    """positions (V, 3), clip_from_model (4, 4) -> clip (V, 4)."""
    return transforms.transform(transforms.to_homogeneous(positions), clip_from_model)


def geometry_backward(grad_clip, grad_depth, face_index, clip, positions, faces, clip_from_model):
    """From clip (V, 4) and depth (H, W) back -> grad_positions (V, 3), grad_clip_from_model (4, 4).

    grad_depth may be None, if the loss does not look at the depth.
    """
    if grad_depth is not None:
        inputs.require_gradient("grad_depth", grad_depth, face_index.shape)
        grad_clip = grad_clip + vertex_gradients.depth_backward(grad_depth, face_index, clip, faces)
    grad_points, grad_clip_from_model = transforms.transform_backward(
        grad_clip, transforms.to_homogeneous(positions), clip_from_model)
    return grad_points[:, :3], grad_clip_from_model


def shade(clip, faces, colours, width, height, background):
    """What each pixel sees at its centre: colour (H, W, C), face_index, depth, barycentric."""
    face_index, depth = scanline.rasterize(clip, faces, width, height)
    barycentric = rasterization.barycentrics(face_index, clip, faces)
    colour = interpolation.interpolate(colours, faces, face_index, barycentric)
    colour[face_index < 0] = background
    return colour, face_index, depth, barycentric


def shade_backward(grad_colour, clip, faces, colours, face_index, barycentric):
    """`shade` read upwards: grad_colour (H, W, C) -> grad_clip (V, 4), grad_colours (V, C).

    A face of one colour looks the same wherever its corners are: they get exactly 0.
    """
    grad_colours, grad_barycentric = interpolation.interpolate_backward(
        grad_colour, colours, faces, face_index, barycentric)
    for corner in (1, 2, 0):  # the sum of the weights is 1: only differences matter
        grad_barycentric[..., corner] -= grad_barycentric[..., 0]
    return vertex_gradients.barycentrics_backward(grad_barycentric, face_index, clip,
                                                  faces), grad_colours


def render(positions, faces, colours, clip_from_model, width, height, background, opposite):
    """R of eq. (1): the antialiased picture (height, width, C), and `render_backward`'s buffers.

    positions (V, 3), faces (F, 3), colours (V, C), clip_from_model (4, 4), background (C,);
    opposite (F, 3) is `antialiasing.opposite_vertices(faces)`, once for a mesh. The buffers are
    clip (V, 4), face_index, depth (H, W), barycentric (H, W, 3), and colour (H, W, C), which is the
    picture before antialiasing. ValueError for what does not fit.
    """
    inputs.require_geometry(positions, faces, clip_from_model, width, height, opposite)
    inputs.require_colours(positions, colours, background)
    clip = to_clip(positions, clip_from_model)
    colour, *seen = shade(clip, faces, colours, width, height, background)
    picture = antialiasing.antialias(colour, *seen[:2], clip, faces, opposite)
    return picture, (clip, *seen, colour)


def render_backward(grad_picture, buffers, positions, faces, colours, clip_from_model, opposite,
                    grad_depth=None):
    """`render` read upwards: grad_picture (H, W, C) -> grad_positions (V, 3), grad_colours (V, C),
    grad_clip_from_model (4, 4). The face of each pixel and the blended edges are taken as given.
    A loss may look at the buffer depth, too: grad_depth (H, W) is its gradient.
    """
    clip, face_index, depth, barycentric, colour = buffers
    inputs.require_gradient("grad_picture", grad_picture, colour.shape)
    grad_colour, through_edges = antialiasing.antialias_backward(
        grad_picture, colour, face_index, depth, clip, faces, opposite)
    through_colours, grad_colours = shade_backward(
        grad_colour, clip, faces, colours, face_index, barycentric)
    grad_positions, grad_clip_from_model = geometry_backward(
        through_edges + through_colours, grad_depth, face_index, clip, positions, faces,
        clip_from_model)
    return grad_positions, grad_colours, grad_clip_from_model


def footprints(uv, uv_faces, face_index, barycentric, derivatives):
    """Where the N pixels that see a face look up its texture: (u, v) (N, 2), change (N, 2, 2)."""
    seen = face_index >= 0
    at = interpolation.interpolate(uv, uv_faces, face_index, barycentric)
    footprint = interpolation.interpolate_derivatives(uv, uv_faces, face_index, derivatives)
    return at[seen], footprint[seen]


def shade_textured(clip, faces, uv, uv_faces, image, width, height, background, filter):
    """`shade` with lab 6: the colour at (u, v), filtered for the footprint of the pixel.

    -> colour (H, W, C), face_index, depth, barycentric, derivatives.
    """
    face_index, depth = scanline.rasterize(clip, faces, width, height)
    barycentric = rasterization.barycentrics(face_index, clip, faces)
    derivatives = rasterization.barycentrics_derivatives(face_index, clip, faces)
    at, footprint = footprints(uv, uv_faces, face_index, barycentric, derivatives)
    colour = np.empty((height, width, image.shape[2]))
    colour[face_index < 0] = background
    colour[face_index >= 0] = texturing.texture(image, at, footprint, filter=filter)
    return colour, face_index, depth, barycentric, derivatives


def shade_textured_backward(grad_colour, clip, faces, uv, uv_faces, image, filter, face_index,
                            barycentric, derivatives):
    """`shade_textured` read upwards -> grad_clip (V, 4), grad_uv (T, 2), grad_image (h, w, C)."""
    seen, at_uv = face_index >= 0, (uv, uv_faces, face_index)
    at, footprint = footprints(*at_uv, barycentric, derivatives)
    grad_image, *by_footprint, _ = texturing.texture_backward(grad_colour[seen], image, at,
                                                              footprint, filter=filter)
    grad_at, grad_footprint = np.zeros((*seen.shape, 2)), np.zeros((*seen.shape, 2, 2))
    grad_at[seen], grad_footprint[seen] = by_footprint
    grad_uv, grad_barycentric = interpolation.interpolate_backward(grad_at, *at_uv, barycentric)
    grad_uv_too, grad_derivatives = interpolation.interpolate_derivatives_backward(
        grad_footprint, *at_uv, derivatives)
    grad_clip = vertex_gradients.rasterize_backward(grad_barycentric, grad_derivatives, None,
                                                    face_index, clip, faces)
    return grad_clip, grad_uv + grad_uv_too, grad_image


def render_textured(positions, faces, uv, uv_faces, image, clip_from_model, width, height,
                    background, opposite, filter="linear-mipmap-linear"):
    """`render` with a texture: image (h, w, C), seen by one of lab 6's filters.

    uv (T, 2), uv_faces (F, 3): the (u, v) of each face's corners. Where there is no seam they can
    be one for each vertex, and uv_faces = faces. The buffers hold derivatives (H, W, 3, 2) after
    barycentric; the rest as in `render`.
    """
    inputs.require_geometry(positions, faces, clip_from_model, width, height, opposite)
    inputs.require_texture(faces, uv, uv_faces, image, background)
    clip = to_clip(positions, clip_from_model)
    colour, *seen = shade_textured(clip, faces, uv, uv_faces, image, width, height, background,
                                   filter)
    picture = antialiasing.antialias(colour, *seen[:2], clip, faces, opposite)
    return picture, (clip, *seen, colour)


def render_textured_backward(grad_picture, buffers, positions, faces, uv, uv_faces, image,
                             clip_from_model, opposite, filter="linear-mipmap-linear",
                             grad_depth=None):
    """`render_textured` read upwards: grad_picture (H, W, C) -> grad_positions (V, 3), grad_uv
    (T, 2), grad_image (h, w, C), grad_clip_from_model (4, 4). grad_depth as in `render_backward`.
    """
    clip, face_index, depth, barycentric, derivatives, colour = buffers
    inputs.require_gradient("grad_picture", grad_picture, colour.shape)
    grad_colour, through_edges = antialiasing.antialias_backward(
        grad_picture, colour, face_index, depth, clip, faces, opposite)
    through_colours, grad_uv, grad_image = shade_textured_backward(
        grad_colour, clip, faces, uv, uv_faces, image, filter, face_index, barycentric, derivatives)
    grad_positions, grad_clip_from_model = geometry_backward(
        through_edges + through_colours, grad_depth, face_index, clip, positions, faces,
        clip_from_model)
    return grad_positions, grad_uv, grad_image, grad_clip_from_model
