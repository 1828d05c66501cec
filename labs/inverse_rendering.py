"""Inverse rendering: from pictures back to the scene, by the gradient of everything before.

    I = R(theta),   theta = argmin L(R(theta), T)     theta: positions, colours, pose, texture   (1)
    L = mean (I - T)^2                                squared error, T is the target             (2)
    L = 1 - sum(c t) / sum(c + t - c t)               silhouettes: 1 - intersection over union   (3)
    m' = b1 m + (1 - b1) g,   s' = b2 s + (1 - b2) g^2,   x' = x - rate m^ / (sqrt(s^) + epsilon),
    m^ = m' / (1 - b1^n),     s^ = s' / (1 - b2^n)    step n of Adam, from n = 1                 (4)
    d_v = x_v - mean of x over v's neighbours         uniform Laplacian: 0 on a smooth mesh      (5)
    v' = q v q* / |q|^2                               a turn by a quaternion q = (w, x, y, z)    (6)

    positions -> clip -> face_index, depth -> barycentric -> colour -> picture                   (7)
              1       2                    2              5          8                      lab

R is the chain (7). Each lab wrote a link and its backward pass; here they are joined. The gradient
of a position comes along two ways: through the colours inside of faces (lab 7), and through the
edges between pixels (lab 8). A face of one colour has only the second.

grad_x of a parameter x has its shape. Adam's m and s are arrays like x, at first 0; what they hold
between two steps is the caller's to keep.

Sources: lecture "Differentiable graphics 1"; Kingma and Ba 2015 (4); Laine et al. 2020.
"""
import numpy as np

from . import antialiasing, interpolation, rasterization, texturing, transforms, vertex_gradients


def squared_error(picture, target):  # exercise 9.1 (1 point)
    """Eq. (2): the mean, over all pixels and channels, of squared differences: a number.

    picture, target: arrays of one shape, any.

    >>> squared_error(np.array([[[1.0, 2.0], [3.0, 4.0]]]), np.array([[[1.0, 0.0], [3.0, 0.0]]]))
    np.float64(5.0)
    """
    raise NotImplementedError("exercise 9.1: squared_error")


def squared_error_backward(grad_loss, picture, target):  # exercise 9.2 (1 point)
    """Backward of eq. (2): grad_loss, a number -> grad_picture, of the picture's shape.

    >>> squared_error_backward(10.0, np.array([[1.0, 2.0, 3.0, 8.0]]), np.array([[1.0, 0, 3, 4]]))
    array([[ 0., 10.,  0., 20.]])
    """
    raise NotImplementedError("exercise 9.2: squared_error_backward")


def silhouette_loss(coverage, target):  # exercise 9.3 (1 point)
    """Eq. (3): 0 for the same silhouette, 1 for two that do not meet: a number.

    coverage, target: arrays of one shape, any, of numbers from 0 to 1: how much of each pixel is
    covered. Not both are 0 everywhere. (Pixels covered in part count in part: where c = t = 1/2,
    the loss is not 0.)

    >>> silhouette_loss(np.array([1.0, 1.0, 0.5, 0.0]), np.array([0.0, 1.0, 1.0, 0.0])).round(9)
    np.float64(0.5)
    """
    raise NotImplementedError("exercise 9.3: silhouette_loss")


def silhouette_loss_backward(grad_loss, coverage, target):  # exercise 9.4 (2 points)
    """Backward of eq. (3): grad_loss, a number -> grad_coverage, of coverage's shape.

    >>> coverage, target = np.array([1.0, 1.0, 0.5, 0.0]), np.array([0.0, 1.0, 1.0, 0.0])
    >>> silhouette_loss_backward(18.0, coverage, target)
    array([ 3., -6., -6.,  3.])
    """
    raise NotImplementedError("exercise 9.4: silhouette_loss_backward")


def adam_step(x, grad_x, mean, square, step, rate,  # exercise 9.5 (3 points)
              beta_1=0.9, beta_2=0.999, epsilon=1e-8):
    """Eq. (4): one step of Adam downhill -> x, mean, square after it, the arguments unchanged.

    x, grad_x, mean (m), square (s): arrays of one shape, any; step (n) = 1 is the first one, to
    which mean and square come as 0. Every element goes its own way: the first step is nearly by
    rate in each, whatever the size of its gradient, if that is far above epsilon.

    >>> x, grad_x, zero = np.array([5.0, 5.0]), np.array([4.0, -100.0]), np.zeros(2)
    >>> x, mean, square = adam_step(x, grad_x, zero, zero, 1, rate=0.25)
    >>> x.round(6), mean.round(6), square.round(6)
    (array([4.75, 5.25]), array([  0.4, -10. ]), array([ 0.016, 10.   ]))
    """
    raise NotImplementedError("exercise 9.5: adam_step")


def laplacian(positions, edges):  # exercise 9.6 (2 points)
    """Eq. (5): how far each vertex is from the middle of its neighbours: d (V, C).

    positions (V, C), of any C; edges (E, 2) integers: two neighbours each, every edge once, in
    either order. A vertex of no edge has d = 0.

    >>> positions = np.array([[0.0, 3.0], [4.0, 5.0], [8.0, 1.0], [9.0, 9.0]])
    >>> laplacian(positions, np.array([[0, 1], [1, 2]]))
    array([[-4., -2.],
           [ 0.,  3.],
           [ 4., -4.],
           [ 0.,  0.]])
    """
    raise NotImplementedError("exercise 9.6: laplacian")


def laplacian_backward(grad_laplacian, positions, edges):  # exercise 9.7 (3 points)
    """Backward of eq. (5): grad_laplacian (V, C) -> grad_positions (V, C).

    >>> positions = np.array([[0.0], [4.0], [8.0], [9.0]])
    >>> grad_laplacian = np.array([[0.0], [1.0], [10.0], [100.0]])
    >>> laplacian_backward(grad_laplacian, positions, np.array([[0, 1], [1, 2]]))
    array([[-0.5],
           [-9. ],
           [ 9.5],
           [ 0. ]])
    """
    raise NotImplementedError("exercise 9.7: laplacian_backward")


def laplacian_energy(positions, edges):
    """The sum of |d_v|^2 over all vertices: a regularizer, the less the smoother the mesh."""
    return (laplacian(positions, edges)**2).sum()


def laplacian_energy_backward(grad_energy, positions, edges):
    """Backward of `laplacian_energy`: grad_energy, a number -> grad_positions (V, C)."""
    grad_laplacian = 2 * grad_energy * laplacian(positions, edges)
    return laplacian_backward(grad_laplacian, positions, edges)


def quaternion_product(p, q):  # exercise 9.8 (2 points)
    """The product p q of quaternions: of the two turns, first q's, then p's.

    p, q (..., 4), shapes that broadcast, elements (w, x, y, z) -> (..., 4). They are w + x i + y j
    + z k, with i i = j j = k k = -1, i j = k, j k = i, k i = j and, turned round, j i = -k etc.

    >>> quaternion_product(np.array([0.0, 1.0, 0.0, 0.0]), np.array([2.0, 0.0, 3.0, 0.0]))
    array([0., 2., 0., 3.])
    """
    raise NotImplementedError("exercise 9.8: quaternion_product")


def quaternion_matrix(q):  # exercise 9.9 (2 points)
    """Eq. (6): the matrix (4, 4) that turns points as q (4,) does, of any length but 0.

    q = (cos(angle/2), sin(angle/2) axis) turns by angle about an axis of length 1, as lab 1's
    rotate; so does any multiple of it. With s = 2 / |q|^2, and K v = (x, y, z) x v, the upper left
    3 x 3 is I + s (w K + K K).

    >>> quaternion_matrix(np.array([2.0, 0.0, 0.0, 2.0])).round(9) @ np.array([1.0, 5.0, 7.0, 1.0])
    array([-5.,  1.,  7.,  1.])
    """
    raise NotImplementedError("exercise 9.9: quaternion_matrix")


def quaternion_matrix_backward(grad_matrix, q):  # exercise 9.10 (4 points)
    """Backward of `quaternion_matrix`: grad_matrix (4, 4) -> grad_q (4,).

    The last row and column of the matrix are constant. All four numbers of q count as free; its
    length makes no difference, so grad_q is at right angles to q.

    >>> grad_matrix = np.zeros((4, 4))
    >>> grad_matrix[1, 0] = 3.0  # by 2 (x y + w z) / |q|^2
    >>> quaternion_matrix_backward(grad_matrix, np.array([2.0, 0.0, 0.0, 1.0])) + 0.0
    array([-0.72,  0.  ,  0.  ,  1.44])
    """
    raise NotImplementedError("exercise 9.10: quaternion_matrix_backward")


def cross_matrix(u):
    """The matrix K (3, 3) with K v = u x v; u (3,)."""
    x, y, z = u
    return np.array([[ 0, -z,  y],
                     [ z,  0, -x],
                     [-y,  x,  0]])


def rotation_angle(p, q):  # exercise 9.11 (2 points)
    """By what angle, from 0 to pi, do two turns differ? p, q (..., 4) of length 1 -> (...).

    It is the angle of the turn that leads from one to the other. q and -q are the same turn. A
    small angle must keep its digits: one of 1e-9 comes out right to 1e-15.

    >>> quarter = np.array([1.0, 0.0, 0.0, 1.0]) / np.sqrt(2)
    >>> rotation_angle(quarter, np.array([1.0, 0.0, 0.0, 0.0])).round(6)
    np.float64(1.570796)
    """
    raise NotImplementedError("exercise 9.11: rotation_angle")


# --- the pipeline: labs 1, 2, 5, 7, 8, and 6 for textures ---------------------------------------


def shade(clip, faces, colours, width, height, background):
    """What each pixel sees at its centre: colour (H, W, C), face_index, depth, barycentric."""
    face_index, depth = rasterization.rasterize(clip, faces, width, height)
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
    grad_barycentric -= grad_barycentric[..., :1]  # the sum is 1: only differences matter
    return vertex_gradients.barycentrics_backward(grad_barycentric, face_index, clip,
                                                  faces), grad_colours


def render(positions, faces, colours, clip_from_model, width, height, background, opposite):
    """Eq. (7): the antialiased picture (height, width, C), and the buffers of `render_backward`.

    positions (V, 3), faces (F, 3), colours (V, C), clip_from_model (4, 4), background (C,);
    opposite (F, 3) is `antialiasing.opposite_vertices(faces)`, once for a mesh. The buffers are
    clip (V, 4), face_index, depth (H, W), barycentric (H, W, 3), and colour (H, W, C), which is the
    picture before antialiasing. ValueError for what does not fit.
    """
    require_scene(positions, faces, clip_from_model, opposite)
    require_colours(colours, positions, background)
    clip = transforms.transform(transforms.to_homogeneous(positions), clip_from_model)
    colour, *seen = shade(clip, faces, colours, width, height, background)
    face_index, depth, barycentric = seen
    picture = antialiasing.antialias(colour, face_index, depth, clip, faces, opposite)
    return picture, (clip, face_index, depth, barycentric, colour)


def render_backward(grad_picture, buffers, positions, faces, colours, clip_from_model, opposite):
    """`render` read upwards: grad_picture (H, W, C) -> grad_positions (V, 3), grad_colours (V, C),
    grad_clip_from_model (4, 4). The face of each pixel and the blended edges are taken as given.
    """
    clip, face_index, depth, barycentric, colour = buffers
    grad_colour, grad_clip = antialiasing.antialias_backward(
        grad_picture, colour, face_index, depth, clip, faces, opposite)
    grad_clip_inside, grad_colours = shade_backward(
        grad_colour, clip, faces, colours, face_index, barycentric)
    grad_points, grad_matrix = transforms.transform_backward(
        grad_clip + grad_clip_inside, transforms.to_homogeneous(positions), clip_from_model)
    return grad_points[:, :3], grad_colours, grad_matrix


def shade_textured(clip, faces, uv, uv_faces, image, width, height, background, filter):
    """`shade` with lab 6: the colour at (u, v), filtered for the footprint of the pixel.

    -> colour (H, W, C), face_index, depth, barycentric, derivatives.
    """
    face_index, depth = rasterization.rasterize(clip, faces, width, height)
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


def footprints(uv, uv_faces, face_index, barycentric, derivatives):
    """Where the N pixels that see a face look up its texture: (u, v) (N, 2), change (N, 2, 2)."""
    seen = face_index >= 0
    at = interpolation.interpolate(uv, uv_faces, face_index, barycentric)
    footprint = interpolation.interpolate_derivatives(uv, uv_faces, face_index, derivatives)
    return at[seen], footprint[seen]


def render_textured(positions, faces, uv, uv_faces, image, clip_from_model, width, height,
                    background, opposite, filter="linear-mipmap-linear"):
    """`render` with a texture: image (h, w, C), seen by one of lab 6's filters.

    uv (T, 2), uv_faces (F, 3): the (u, v) of each face's corners. Where there is no seam they can
    be one for each vertex, and uv_faces = faces. The buffers hold derivatives (H, W, 3, 2) after
    barycentric; the rest as in `render`.
    """
    require_scene(positions, faces, clip_from_model, opposite)
    require_background(background, np.shape(image)[-1])
    clip = transforms.transform(transforms.to_homogeneous(positions), clip_from_model)
    colour, *seen = shade_textured(clip, faces, uv, uv_faces, image, width, height, background,
                                   filter)
    picture = antialiasing.antialias(colour, *seen[:2], clip, faces, opposite)
    return picture, (clip, *seen, colour)


def render_textured_backward(grad_picture, buffers, positions, faces, uv, uv_faces, image,
                             clip_from_model, opposite, filter="linear-mipmap-linear"):
    """`render_textured` read upwards: grad_picture (H, W, C) -> grad_positions (V, 3), grad_uv
    (T, 2), grad_image (h, w, C), grad_clip_from_model (4, 4).
    """
    clip, face_index, depth, barycentric, derivatives, colour = buffers
    grad_colour, grad_clip = antialiasing.antialias_backward(
        grad_picture, colour, face_index, depth, clip, faces, opposite)
    grad_clip_inside, grad_uv, grad_image = shade_textured_backward(
        grad_colour, clip, faces, uv, uv_faces, image, filter, face_index, barycentric, derivatives)
    grad_points, grad_matrix = transforms.transform_backward(
        grad_clip + grad_clip_inside, transforms.to_homogeneous(positions), clip_from_model)
    return grad_points[:, :3], grad_uv, grad_image, grad_matrix


def require(fits, expected, came):
    """ValueError, in one sentence, unless what came fits."""
    if not fits:
        raise ValueError(f"render expects {expected}; it got {came}")


def require_scene(positions, faces, clip_from_model, opposite):
    """ValueError, in one sentence, unless there is a mesh, and a camera to see it."""
    def is_finite(array, shape):
        return np.shape(array) == shape and np.isfinite(array).all()

    require(is_finite(positions, (len(positions), 3)), "positions (V, 3) of finite numbers (a fit "
            "that diverges wants a smaller rate)", f"{np.shape(positions)}, or NaN or infinity")
    require(is_finite(clip_from_model, (4, 4)), "clip_from_model (4, 4) of finite numbers",
            f"{np.shape(clip_from_model)}, or NaN or infinity")
    require(np.shape(faces) == (len(faces), 3) and np.asarray(faces).dtype.kind in "iu",
            "faces (F, 3) of integers", f"{np.shape(faces)} of {np.asarray(faces).dtype}")
    require(not len(faces) or (np.min(faces) >= 0 and np.max(faces) < len(positions)),
            f"faces that name vertices from 0 to {len(positions) - 1}",
            f"{np.min(faces, initial=0)} to {np.max(faces, initial=0)}")
    require(np.shape(opposite) == np.shape(faces), f"opposite {np.shape(faces)}, made by "
            "antialiasing.opposite_vertices(faces)", np.shape(opposite))


def require_colours(colours, positions, background):
    """ValueError, in one sentence, unless each vertex has a colour, and so has the background."""
    require(np.shape(colours)[:1] == (len(positions),) and np.ndim(colours) == 2, "colours "
            f"({len(positions)}, C), one for each vertex; give grey ones as grey[:, None]",
            np.shape(colours))
    require_background(background, np.shape(colours)[1])


def require_background(background, channels):
    """ValueError, in one sentence, unless the background is one colour of so many channels."""
    require(np.shape(background) == (channels,), f"a background ({channels},), of as many channels "
            "as the colours have", np.shape(background))
