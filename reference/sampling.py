"""Sampling: what is lost when a picture keeps one number per pixel, and how to lose less.

    alias = f - r m, m whole, -r/2 <= alias < r/2    what frequency f looks like at rate r   (1)
    F_k = sum_n f_n exp(-2 pi i k n / N)             discrete Fourier transform (DFT)        (2)
    (f * g)_n = sum_m f_m g_(n - m)                  circular convolution, n - m modulo N    (3)
    DFT(f * g) = DFT(f) DFT(g)                       convolution theorem                     (4)
    B_k = sin(pi w k/N) / (w sin(pi k/N))            DFT of a box, w wide: a sinc            (5)
    G_k = 1/s sum_m F_(k + m N/s), m = 0 .. s-1      DFT of every s-th sample                (6)
    coverage = area(triangle and pixel)              box of one pixel, sampled at its centre (7)
    area = 1/2 sum_n x_n y_(n+1) - x_(n+1) y_n       of a polygon: the shoelace formula      (8)
    d area = sum |q - p| integral n . ((1 - t) dp + t dq) dt,   over edges p + t (q - p)     (9)

Sampling lays copies of the spectrum on top of each other, 1/s apart (6). Where they overlap is
aliasing. A filter before sampling narrows the spectrum, so that less overlaps. A filter after
sampling comes too late, for it cannot tell the copies apart. In (9), the polygon is
counter-clockwise, n is an edge's outward unit normal, and t runs over what lies in the pixel.
Pictures (H, W) go round at their borders. Their frequencies along y and x are in cycles per pixel.
Screen coordinates are those of lab 2.

Sources: notes on GAMES101 lecture 6, Sutherland and Hodgman 1974 (clipping).
"""
import numpy as np


def alias_frequency(frequency, rate):  # step 3.1
    """Eq. (1): the slowest frequency that has the same samples.

    frequency (...), rate, a number -> (...): negative where a wheel seems to turn backwards.

    >>> alias_frequency(np.array([1.0, 9.0, 10.0, 13.0]), 10.0)
    array([ 1., -1.,  0.,  3.])

    Fine print. r/2 and -r/2 have the same samples. Eq. (1) gives -r/2.
    """
    return frequency - rate * np.floor(frequency / rate + 0.5)


def dft_matrix(n):  # step 3.2
    """Eq. (2) as a complex matrix D (n, n): D @ f is the spectrum of n samples f (n,).

    >>> dft_matrix(4)[:2].round(9) + 0.0
    array([[ 1.+0.j,  1.+0.j,  1.+0.j,  1.+0.j],
           [ 1.+0.j,  0.-1.j, -1.+0.j,  0.+1.j]])
    """
    k = np.arange(n)
    # Whole turns change nothing. Without them (% n) the angles are small and their rounding, too.
    return np.exp(-2j * np.pi * (np.outer(k, k) % n) / n)


def spectrum_of(picture):
    """Eq. (2) along both axes: picture (H, W) -> spectrum (H, W), complex, [k_y, k_x].

    >>> spectrum_of(np.array([[1.0, 2.0], [3.0, 4.0]])).real.round(9) + 0.0
    array([[10., -2.],
           [-4.,  0.]])
    """
    height, width = picture.shape
    return dft_matrix(height) @ picture @ dft_matrix(width).T


def picture_of(spectrum):
    """The inverse of `spectrum_of`: spectrum (H, W), complex -> picture (H, W), its real part.

    >>> picture_of(np.array([[10.0, -2.0], [-4.0, 0.0]])).round(9) + 0.0
    array([[1., 2.],
           [3., 4.]])
    """
    # Two columns of D are orthogonal, and each has n entries of length 1: conj(D) D = n I.
    height, width = spectrum.shape
    return (dft_matrix(height).conj() @ spectrum @ dft_matrix(width).conj().T).real / spectrum.size


def frequencies(n):
    """The frequency of each of a spectrum's n entries, in cycles per pixel, in [-1/2, 1/2).

    >>> frequencies(4), frequencies(5)
    (array([ 0.  ,  0.25, -0.5 , -0.25]), array([ 0. ,  0.2,  0.4, -0.4, -0.2]))
    """
    k = np.arange(n)
    return np.where(2 * k < n, k, k - n) / n


def band_pass(picture, low, high):  # extra 3.3 (2 points)
    """The part of a picture whose frequencies have a length low <= |(f_y, f_x)| < high.

    picture (H, W) -> (H, W). A low-pass filter has low = 0, a high-pass filter has high = np.inf.

    >>> band_pass(np.array([[1.0, 3.0]]), 0.25, np.inf)
    array([[-1.,  1.]])
    """
    height, width = picture.shape
    length = np.hypot(frequencies(height)[:, None], frequencies(width))
    return picture_of(spectrum_of(picture) * ((low <= length) & (length < high)))


def convolve(picture, kernel):  # exercise 3.4 (3 points)
    """Filter a picture, by eq. (3) along both axes: picture (H, W), kernel (h, w) -> (H, W).

    h and w are odd, and kernel[h // 2, w // 2] is g_0.

    >>> convolve(np.array([[0.0, 0.0, 0.0, 1.0]]), np.array([[1.0, 2.0, 3.0]]))
    array([[3., 0., 1., 2.]])

    Fine print. A kernel may be larger than the picture: a wide blur of a small one. It then goes
    round more than once.
    """
    h, w = kernel.shape
    total = np.zeros(picture.shape)
    for i in range(h):
        for j in range(w):
            total += kernel[i, j] * np.roll(picture, (i - h // 2, j - w // 2), (0, 1))
    return total


def convolve_by_spectrum(picture, kernel):  # extra 3.5 (2 points)
    """Eq. (4): `convolve` as a product of spectra, for h <= H and w <= W.

    First make a picture (H, W) of the kernel, with its middle at [0, 0] and the rest around it.

    >>> convolve_by_spectrum(np.array([[0.0, 0.0, 0.0, 1.0]]), np.array([[1.0, 2.0, 3.0]])).round(9)
    array([[3., 0., 1., 2.]])
    """
    height, width = picture.shape
    h, w = kernel.shape
    padded = np.pad(kernel, ((0, height - h), (0, width - w)))
    centred = np.roll(padded, (-(h // 2), -(w // 2)), (0, 1))
    return picture_of(spectrum_of(picture) * spectrum_of(centred))


def box_spectrum(width, n):  # extra 3.6 (2 points)
    """Eq. (5): the spectrum (n,), real, of a box filter on n samples. It is 1 at frequency 0.

    The box is 1 / width at width samples, and its middle is at 0. width is odd, and at most n.

    >>> box_spectrum(3, 4).round(9)
    array([ 1.        ,  0.33333333, -0.33333333,  0.33333333])
    """
    f = np.arange(1, n) / n
    return np.concatenate([[1.0], np.sin(np.pi * width * f) / (width * np.sin(np.pi * f))])


def sampled_spectrum(spectrum, step, limit):  # exercise 3.7 (3 points)
    """Eq. (6) along y and along x: the spectrum of every step-th pixel, after an ideal filter.

    spectrum (H, W), complex -> (H / step, W / step). The filter drops what has |f_y| >= limit or
    |f_x| >= limit, by `frequencies`. See `demo aliasing`.

    >>> sampled_spectrum(np.array([[8.0, 1.0, 2.0, 1.0], [0.0, 0.0, 4.0, 0.0]]), 2, np.inf)
    array([[3.5, 0.5]])
    """
    height, width = spectrum.shape
    f_y, f_x = np.abs(frequencies(height))[:, None], np.abs(frequencies(width))
    kept = np.where(np.maximum(f_y, f_x) < limit, spectrum, 0)
    copies = kept.reshape(step, height // step, step, width // step)
    return copies.sum((0, 2)) / step**2


def folded_energy(spectrum, step):  # extra 3.8 (2 points)
    """How much of a picture is too fast for every step-th sample? It comes back as aliasing.

    spectrum (H, W) -> the mean square over the pixels of the part with |f_y| or |f_x| of at least
    1 / (2 step). By Parseval's theorem, the sum of |pixel|^2 is the sum of |F|^2 / (H W).

    >>> folded_energy(np.array([[8.0, 1.0, 2.0, 1.0]]), 2)  # the mean square of all is 70 / 16
    np.float64(0.375)
    """
    height, width = spectrum.shape
    f_y, f_x = np.abs(frequencies(height))[:, None], np.abs(frequencies(width))
    folds = np.maximum(f_y, f_x) >= 0.5 / step
    return (np.abs(spectrum[folds]) ** 2).sum() / spectrum.size**2


def box_filter(width):
    """The kernel (width, width) that takes a mean. ValueError if the width is not odd."""
    if width % 2 != 1 or width < 1:
        raise ValueError(f"a box needs an odd width, 1 or more, for its middle pixel, got {width}")
    return np.full((width, width), width**-2.0)


def filter_then_sample(picture, step):
    """The mean of step x step pixels around every step-th one. step is odd."""
    return convolve(picture, box_filter(step))[::step, ::step]


def sample_then_blur(picture, step, width=3):
    """Every step-th pixel, then the mean of width x width of those, width odd: too late."""
    return convolve(picture[::step, ::step], box_filter(width))


def clip_polygon(polygon, a, b, c):  # step 3.9
    """The part of a convex polygon (N, 2) where a x + b y + c >= 0 -> (M, 2), or (0, 2).

    A vertex inside stays, and an edge that crosses the line adds its crossing. Start anywhere.

    >>> clip_polygon(np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]]), -1.0, 0.0, 1.0)  # x <= 1
    array([[0., 0.],
           [1., 0.],
           [1., 1.],
           [0., 2.]])
    """
    kept = []
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        at_p, at_q = a * p[0] + b * p[1] + c, a * q[0] + b * q[1] + c
        if at_p >= 0:
            kept.append(p)
        if (at_p >= 0) != (at_q >= 0):
            kept.append(p + (q - p) * (at_p / (at_p - at_q)))
    return np.array(kept).reshape(-1, 2)


def polygon_area(polygon):
    """Eq. (8): the area of a polygon (..., N, 2) -> (...), negative if clockwise.

    >>> polygon_area(np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [0.0, 2.0]]))
    np.float64(6.0)
    """
    polygon = np.asarray(polygon)
    if not polygon.size:  # perhaps [], which has no x and y
        return np.zeros(polygon.shape[:-2])
    # From one of its own points: far from the origin, x_n y_(n+1) is large, and the area is not.
    x, y = np.moveaxis(polygon - polygon[..., :1, :], -1, 0)
    return (x * np.roll(y, -1, -1) - np.roll(x, -1, -1) * y).sum(-1) / 2


def pixel_coverage_loop(triangle, width, height):  # exercise 3.10 (4 points)
    """Eq. (7): how much of each pixel does a triangle (3, 2) cover? -> (height, width)

    Clip it by the pixel's four sides (`clip_polygon`), and take the area that is left (8), by the
    given `polygon_area`. The triangle may be clockwise. See `demo aliasing`.

    >>> pixel_coverage_loop(np.array([[1.0, 0.5], [3.0, 0.5], [3.0, 2.5]]), 4, 2)
    array([[0.   , 0.375, 0.5  , 0.   ],
           [0.   , 0.125, 0.875, 0.   ]])
    """
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            part = triangle
            for a, b, c in (1, 0, -j), (-1, 0, j + 1), (0, 1, -i), (0, -1, i + 1):
                part = clip_polygon(part, a, b, c)
            coverage[i, j] = abs(polygon_area(part))
    return coverage


def cuts(polygon, x, y):
    """Where do the edges of a polygon (N, 2) cross the four lines through a unit square's sides?

    x, y (P,): the lower left corners -> t (P, N, 6), sorted along the last axis. Edge n leads from
    vertex n to the next, p + t (q - p). Its t are 0, 1 and the crossings with x, x + 1, y, y + 1.
    If an edge does not cross a line, or runs along it, t is some number in [0, 1].
    """
    p, q = polygon[:, None], np.roll(polygon, -1, axis=0)[:, None]      # (N, 1, 2)
    sides = np.stack([[x, y], [x + 1, y + 1]]).transpose(2, 0, 1)       # (P, 2, 2)
    across = np.where(p == q, 1.0, q - p)                               # no crossing, no 0/0
    t = np.clip((sides[:, None] - p) / across, 0, 1)                    # (P, N, 2, 2)
    t = np.pad(t.reshape(*t.shape[:2], 4), ((0, 0), (0, 0), (1, 1)), constant_values=(0, 1))
    return np.sort(t)


def clamped_area(polygon, x, y):  # extra 3.11 (3 points)
    """How much of each unit square does a polygon (N, 2) cover? area (P,), with the polygon's sign.

    x, y (P,): the lower left corners. Clamp the points of all edges at their `cuts`, in order, to
    the square. What lay outside now encloses nothing. These points are the polygon of this area.
    """
    t = cuts(polygon, x, y)[..., None]
    p, q = polygon[:, None], np.roll(polygon, -1, axis=0)[:, None]
    corner = np.stack([x, y], -1)[:, None, None]
    points = np.clip(p + t * (q - p) - corner, 0, 1)                    # (P, N, 6, 2)
    return polygon_area(points.reshape(len(x), 6 * len(polygon), 2))


def clamped_area_backward(grad_area, polygon, x, y):  # exercise 3.12 (4 points)
    """Backward of `clamped_area`, eq. (9): grad_area (P,) -> grad_polygon (N, 2).

    polygon (N, 2), x, y (P,): the squares' lower left corners. A piece of an edge between two of
    the given `cuts` lies inside a square if its middle does. It pulls at both ends of the edge.

    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> clamped_area_backward(np.array([2.0]), square / 2, np.zeros(1), np.zeros(1))[2]
    array([0.5, 0.5])

    Fine print. A piece along a side that two squares share counts in one of them. It is inside if
    x <= middle < x + 1, and y alike.
    """
    p = polygon[:, None]
    edge = np.roll(polygon, -1, axis=0)[:, None] - p
    corner = np.stack([x, y], -1)[:, None, None]
    t = cuts(polygon, x, y)
    t0, t1 = t[..., :-1], t[..., 1:]
    middle = p + (t0 + t1)[..., None] / 2 * edge - corner               # (P, N, 5, 2)
    inside = ((middle >= 0) & (middle < 1)).all(-1)
    # |q - p| n = (edge_y, -edge_x). The integral of t is (t1^2 - t0^2) / 2, that of 1 - t the rest.
    by_q = np.einsum("p,pni->n", grad_area, inside * (t1**2 - t0**2) / 2)
    by_p = np.einsum("p,pni->n", grad_area, inside * (t1 - t0)) - by_q
    normal = np.concatenate([edge[..., 1], -edge[..., 0]], -1)
    return by_p[:, None] * normal + np.roll(by_q[:, None] * normal, 1, axis=0)


def classify_pixels(triangle, width, height):
    """Which pixels lie wholly inside a triangle (3, 2), and which ones does its border touch?

    -> inside, touched, bool (height, width) each. A pixel that is just missed may count as touched.
    """
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    winding = np.sign(polygon_area(triangle))
    inside, near = np.ones((2, height, width), bool)
    for p, q in zip(triangle, np.roll(triangle, -1, axis=0), strict=True):
        a, b = winding * (p[1] - q[1]), winding * (q[0] - p[0])
        distance = a * (x - p[0]) + b * (y - p[1])
        reach = (abs(a) + abs(b)) * (0.5 + 1e-6)  # of the corner that is farthest from the centre
        inside &= distance > reach
        near &= distance >= -reach
    return inside, near & ~inside


def pixel_coverage(triangle, width, height):
    """Eq. (7) for whole pictures: only where the border touches a pixel is an area needed.

    triangle (3, 2) -> (height, width), as `pixel_coverage_loop`. A vertex 1e9 pixels away costs
    1e-7 of precision, one 1e12 pixels away 1e-4.
    """
    inside, touched = classify_pixels(triangle, width, height)
    coverage = inside.astype(float)
    y, x = np.nonzero(touched)
    coverage[touched] = np.abs(clamped_area(triangle, x, y))
    return coverage


def pixel_coverage_backward(grad_coverage, triangle):
    """Backward of `pixel_coverage`: grad_coverage (height, width) -> grad_triangle (3, 2)."""
    _, touched = classify_pixels(triangle, *grad_coverage.shape[::-1])
    y, x = np.nonzero(touched)
    grad_area = np.sign(polygon_area(triangle)) * grad_coverage[touched]
    return clamped_area_backward(grad_area, triangle, x, y)
