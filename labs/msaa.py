"""MSAA: several samples in each pixel for coverage and depth, but one shade for each face in it.

    pixel = integral of f over its square ~ 1/S sum_s f(corner + o_s)     o: sample pattern  (1)
    regular grid:  o_s = (j + 1/2, i + 1/2) / n,   s = n i + j,   S = n^2                    (2)
    lattice:       o_s = (s + 1/2, r_s + 1/2) / S,   r_s = (k (s + 1) mod (S + 1)) - 1       (3)
    sample o comes to the pixel's centre:   screen x, y  ->  x + 1/2 - o_x,  y + 1/2 - o_y   (4)
    error ~ C n^-p:   p is the observed order                                                (5)
    supersampling:   f(corner + o_s) = shade(corner + o_s, face seen there)                  (6)
    MSAA:            f(corner + o_s) = shade(centre,       face seen there)                  (7)

A pattern is an array (S, 2) of positions x, y in the unit pixel, from 0 to 1. By (4), lab 2's
rasterize finds the face and depth of every sample: face_index (S, H, W), -1 for no face. By (7), a
pixel needs one shade for each face that its samples see. Inside a face that is one, not S.

In a lattice each of S columns holds one sample. Each of S rows does, too, if k and S + 1 have no
common divisor but 1. S = 4 with k = 2 or 3 is known as the rotated grid. A sample sees one face or
another, so the vertices have no useful gradient here. The colours have one, `resolve_backward`.

Source: notes on GAMES101 lecture 6.
"""
import numpy as np

from course.given.arrays import EDGES, scatter

from . import rasterization

STEPS = {1: 1, 2: 2, 4: 3, 8: 2, 16: 4}  # k of eq. (3) for S samples, none near another


def regular_grid(n):
    """Eq. (2): the centres of n x n small squares, row by row from the bottom -> (n^2, 2).

    >>> regular_grid(2)
    array([[0.25, 0.25],
           [0.75, 0.25],
           [0.25, 0.75],
           [0.75, 0.75]])
    """
    i, j = np.divmod(np.arange(n * n), n)
    return (np.stack([j, i], -1) + 0.5) / n


def box_resolve(picture, n):  # step 4.1
    """Eq. (1) for n x n samples in a pixel: their means, picture (n H, n W, C) -> (H, W, C).

    >>> box_resolve(np.array([[1.0, 2.0, 5.0, 6.0], [3.0, 4.0, 7.0, 8.0]])[..., None], 2)[..., 0]
    array([[2.5, 6.5]])
    """
    raise NotImplementedError("exercise 4.1: box_resolve")


def box_resolve_backward(grad_output, picture, n):  # extra 4.2 (1 point)
    """Backward of `box_resolve`: grad_output (H, W, C) -> grad_picture (n H, n W, C).

    >>> box_resolve_backward(np.array([[[8.0]]]), np.zeros((2, 2, 1)), 2)[..., 0]
    array([[2., 2.],
           [2., 2.]])
    """
    # A pixel is the sum of n^2 pixels / n^2, so each of them gets its gradient / n^2.
    return (grad_output / n**2).repeat(n, 1).repeat(n, 0)


def lattice(count, step):  # step 4.3
    """Eq. (3): the lattice of S = count samples with k = step -> (S, 2).

    >>> lattice(4, 3)
    array([[0.125, 0.625],
           [0.375, 0.125],
           [0.625, 0.875],
           [0.875, 0.375]])
    """
    raise NotImplementedError("exercise 4.3: lattice")


def standard_pattern(count):
    """The lattice of 1, 2, 4, 8 or 16 samples -> (S, 2), or ValueError for another count.

    The four samples are those of Mesa's OpenGL.
    """
    if count not in STEPS:
        raise ValueError(f"a standard pattern has 1, 2, 4, 8 or 16 samples, got {count}: give one "
                         "of these, or make a pattern with regular_grid or lattice")
    return lattice(count, STEPS[count])


def centre_sample(clip, offset, width, height):  # step 4.4
    """Eq. (4): clip (V, 4) moved so that the sample at offset (2,) comes to its pixel's centre.

    -> (V, 4), z and w as they were. On screen x = (x_clip / w + 1) width / 2.

    >>> clip = np.array([[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 2.0]])
    >>> centre_sample(clip, np.array([0.25, 1.0]), 8, 4)
    array([[ 0.0625, -0.25  ,  0.    ,  1.    ],
           [ 0.125 , -0.5   ,  0.    ,  2.    ]])

    Fine print. A vertex behind the camera (w < 0) obeys the same formula. The offset (1/2, 1/2)
    changes no bit: one sample at the centre is lab 2's picture.
    """
    raise NotImplementedError("exercise 4.4: centre_sample")


def rasterize_samples(clip, faces, width, height, pattern):  # exercise 4.5 (2 points)
    """Eq. (4): the face and the depth of every sample, each by your own `rasterize` of lab 2.

    clip (V, 4), faces (F, 3), pattern (S, 2) -> face_index, depth (S, height, width).
    `centre_sample` is a step on the way. See `demo msaa`.

    >>> clip = np.array([[-1.0, -1, 0, 1], [0, -1, 0, 1], [0, 3, 0, 1], [-1, 3, 0, 1]])
    >>> faces = np.array([[0, 1, 2], [0, 2, 3]])  # the left half of the picture
    >>> pattern = np.array([[0.2, 0.9], [0.2, 0.4], [0.9, 0.4]])
    >>> rasterize_samples(clip, faces, 1, 1, pattern)[0].ravel()
    array([ 1,  0, -1])
    """
    raise NotImplementedError("exercise 4.5: rasterize_samples")


def coverage(face_index):
    """Eq. (1), f = 1 on faces, else 0: which fraction of a pixel's samples see a face?

    face_index (S, H, W), -1 for no face -> (H, W).

    >>> coverage(np.array([[[0, -1]], [[7, 3]]]))
    array([[1. , 0.5]])
    """
    return (face_index >= 0).mean(0)


def observed_order(n, error):  # extra 4.6 (2 points)
    """Eq. (5): which p fits measured errors best? n (M,), error (M,), all positive -> a number.

    -p is the slope of the line through log error over log n with the least sum of squares.

    >>> observed_order(np.array([1.0, 2.0, 4.0]), np.array([3.0, 0.75, 0.1875])).round(9)
    np.float64(2.0)
    """
    x, y = np.log(n), np.log(error)
    x = x - x.mean()
    return -(x @ y) / (x @ x)


def barycentric_at(px, py, face, clip, faces, width, height):
    """Where on its face does a screen point lie? px, py (N,) in pixels, face (N,) -> b (N, 3).

    These are lab 5's weights b = c / sum c. A point beside the face is taken as one in the face's
    plane. Some weight is then negative.
    """
    x, y, _, w = clip.T[:, faces[face].T]  # in clip space, where nothing is divided yet
    x, y = x - (2 * px / width - 1) * w, y - (2 * py / height - 1) * w
    c = np.stack([x[i] * y[j] - x[j] * y[i] for i, j in EDGES])
    return (c / c.sum(0)).T


def supersample(clip, faces, width, height, n, shade, background):
    """Eq. (6) on the regular grid: a picture n times as wide and high, then `box_resolve`.

    shade(px, py, face) -> colours (N, C) at screen points px, py (N,), in pixels, on face (N,).
    background (C,) -> picture (H, W, C). n is 1 or more.
    """
    if n < 1:
        raise ValueError(f"supersampling needs n x n samples with n of 1 or more, got n = {n}")
    face_index, _ = rasterization.rasterize(clip, faces, n * width, n * height)
    row, column = np.nonzero(face_index >= 0)
    picture = np.tile(background, (*face_index.shape, 1))
    picture[row, column] = shade((column + 0.5) / n, (row + 0.5) / n, face_index[row, column])
    return box_resolve(picture, n)


def shading_requests(face_index):  # exercise 4.7 (4 points)
    """Eq. (7): what must be shaded? Each face that a pixel's samples see, once.

    face_index (S, H, W) -> pixel, face (N,), request (S, H, W): N pairs in any order, pixel =
    row * W + column, and the number of each sample's pair, or -1.

    >>> shading_requests(np.array([[[4, -1]], [[4, 6]], [[5, 4]]]))[2].tolist()
    [[[0, -1]], [[0, 3]], [[1, 2]]]

    Fine print. There may be millions of pixels, and of faces: their product needs 64 bits. Or no
    sample sees a face: N = 0.
    """
    raise NotImplementedError("exercise 4.7: shading_requests")


def resolve(shade, request, background):  # exercise 4.8 (3 points)
    """Eq. (1): the mean colour of each pixel's samples -> picture (H, W, C).

    shade (N, C), background (C,), request (S, H, W): each sample's row of shade, or -1 for the
    background. See `demo msaa`.

    >>> shade, background = np.array([[1.0], [4.0]]), np.array([0.1])
    >>> resolve(shade, np.array([[[0, 0, -1]], [[1, 0, -1]], [[1, 0, -1]]]), background)[..., 0]
    array([[3. , 1. , 0.1]])

    Fine print. Where all samples of a pixel have one colour, the pixel has exactly this colour,
    even if it comes from several requests. A sum divided by S would be rounded, and a seam would
    show between two faces. Nearly equal colours are mixed like others. N may be 0.
    """
    raise NotImplementedError("exercise 4.8: resolve")


def resolve_backward(grad_picture, shade, request, background):  # exercise 4.10 (3 points)
    """Backward of `resolve`: grad_picture (H, W, C) -> grad_shade (N, C), grad_background (C,).

    What `resolve` gathers is scattered, by the given `scatter(values, index, count)`. See
    `demo msaa`.

    >>> request = np.array([[[0, 0, -1]], [[1, 0, -1]]])
    >>> resolve_backward(np.ones((1, 3, 1)), np.zeros((2, 1)), request, np.zeros(1))
    (array([[1.5],
           [0.5]]), array([1.]))

    Fine print. N may be 0: nothing is seen.
    """
    raise NotImplementedError("exercise 4.10: resolve_backward")


def msaa(clip, faces, width, height, pattern, shade, background):
    """Eq. (7): many samples, few shades -> picture (H, W, C).

    shade and background: as for `supersample`, but shade gets the centres of pixels. A face may
    miss the centre of a pixel that it covers in part, see `barycentric_at`.
    """
    if len(pattern) == 0:
        raise ValueError("a pattern (S, 2) needs at least one sample, got none: give "
                         "regular_grid(1) for the centre alone")
    if 0 in (width, height):
        return np.zeros((height, width, len(background)))
    face_index, _ = rasterize_samples(clip, faces, width, height, pattern)
    pixel, face, request = shading_requests(face_index)
    row, column = np.divmod(pixel, width)
    return resolve(shade(column + 0.5, row + 0.5, face), request, background)


def cost(face_index, sample_bytes):  # extra 4.9 (2 points)
    """What does face_index (S, H, W) cost? -> three integers: samples, shades, bytes.

    samples counts all samples of all pixels. shades adds up, over the pixels, how many different
    faces >= 0 the samples of a pixel see. Each sample takes sample_bytes.

    >>> cost(np.array([[[4, -1]], [[4, 6]], [[5, 4]]]), 8)
    (6, 4, 48)
    """
    ordered = np.sort(face_index, 0)
    new = ordered >= 0
    new[1:] &= ordered[1:] != ordered[:-1]
    return face_index.size, int(new.sum()), face_index.size * sample_bytes
