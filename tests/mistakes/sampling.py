"""Mistakes of lab 3; each docstring goes on after "this is what comes out when"."""


def alias_frequency(frequency, rate):
    """the remainder frequency % rate is returned, between 0 and the rate: from half the rate on,
    subtract the rate, for the wheel seems to turn backwards
    """
    return frequency - rate * np.floor(frequency / rate)


def alias_frequency(frequency, rate):
    """np.round rounds halves to the even number: half the rate comes with either sign"""
    return frequency - rate * np.round(frequency / rate)


def alias_frequency(frequency, rate):
    """the sign is lost: the absolute value comes, and nothing seems to turn backwards"""
    return np.abs(frequency - rate * np.floor(frequency / rate + 0.5))


def alias_frequency(frequency, rate):
    """the range is from -rate to rate, twice too wide: it must fold at half the rate"""
    return (frequency + rate) % (2 * rate) - rate


def alias_frequency(frequency, rate):
    """the rate is subtracted only once, even from a frequency of several times the rate"""
    return np.where(frequency >= rate / 2, frequency - rate, frequency)


def alias_frequency(frequency, rate):
    """half the rate comes as r/2 instead of -r/2: the interval has the wrong one of its ends"""
    return rate / 2 - (rate / 2 - frequency) % rate


def dft_matrix(n):
    """the exponent lacks its minus sign: that is the conjugate, the matrix of the inverse"""
    k = np.arange(n)
    return np.exp(2j * np.pi * (np.outer(k, k) % n) / n)


def dft_matrix(n):
    """the exponent has pi instead of 2 pi: a factor 2 is missing there"""
    k = np.arange(n)
    return np.exp(-2j * np.pi / 2 * (np.outer(k, k) % n) / n)


def dft_matrix(n):
    """the matrix is divided by n, a factor 1/n: that is left to the inverse"""
    k = np.arange(n)
    return np.exp(-2j * np.pi * (np.outer(k, k) % n) / n) / n


def dft_matrix(n):
    """the matrix is divided by the square root of n, which gives the unitary transform: eq. (2) has
    no such factor
    """
    k = np.arange(n)
    return np.exp(-2j * np.pi * (np.outer(k, k) % n) / n) / np.sqrt(n)


def dft_matrix(n):
    """k and n count from 1: both start at 0, so that the first row is constant"""
    k = np.arange(1, n + 1)
    return np.exp(-2j * np.pi * (np.outer(k, k) % n) / n)


def dft_matrix(n):
    """only the real part is there, the cosine: the imaginary part, minus the sine, is missing"""
    k = np.arange(n)
    return np.cos(2 * np.pi * (np.outer(k, k) % n) / n)


def band_pass(picture, low, high):
    """the greater of |f_y| and |f_x| (maximum) is taken for the length: the band is a square
    instead of a ring, see np.hypot
    """
    height, width = picture.shape
    length = np.maximum(np.abs(frequencies(height))[:, None], np.abs(frequencies(width)))
    return picture_of(spectrum_of(picture) * ((low <= length) & (length < high)))


def band_pass(picture, low, high):
    """a band has its upper end and not its lower one: it must be low <= length < high"""
    height, width = picture.shape
    length = np.hypot(frequencies(height)[:, None], frequencies(width))
    return picture_of(spectrum_of(picture) * ((low < length) & (length <= high)))


def band_pass(picture, low, high):
    """frequencies run from 0 to 1: those above 1/2 stand for negative frequencies, and are not
    folded to them
    """
    height, width = picture.shape
    length = np.hypot(np.arange(height)[:, None] / height, np.arange(width) / width)
    return picture_of(spectrum_of(picture) * ((low <= length) & (length < high)))


def band_pass(picture, low, high):
    """|f_y| + |f_x| is taken for the length, which is the root of the sum of squares, np.hypot"""
    height, width = picture.shape
    length = np.abs(frequencies(height))[:, None] + np.abs(frequencies(width))
    return picture_of(spectrum_of(picture) * ((low <= length) & (length < high)))


def convolve(picture, kernel):
    """the kernel is turned round (flipped, n + m instead of n - m): that is correlation"""
    h, w = kernel.shape
    total = np.zeros(picture.shape)
    for i in range(h):
        for j in range(w):
            total += kernel[i, j] * np.roll(picture, (h // 2 - i, w // 2 - j), (0, 1))
    return total


def convolve(picture, kernel):
    """the kernel's corner is taken for g_0: g_0 stands at its middle"""
    h, w = kernel.shape
    total = np.zeros(picture.shape)
    for i in range(h):
        for j in range(w):
            total += kernel[i, j] * np.roll(picture, (i, j), (0, 1))
    return total


def convolve(picture, kernel):
    """zeros stand beyond the border (zero padding): rows and columns go round, as in a circle"""
    h, w = kernel.shape
    padded = np.pad(picture, ((h // 2, h // 2), (w // 2, w // 2)))
    total = np.zeros(picture.shape)
    for i in range(h):
        for j in range(w):
            moved = padded[h - 1 - i:, w - 1 - j:]
            total += kernel[i, j] * moved[:picture.shape[0], :picture.shape[1]]
    return total


def convolve(picture, kernel):
    """beyond the border the last pixel is repeated: rows and columns go round there"""
    (height, width), (h, w) = picture.shape, kernel.shape
    padded = np.pad(picture, ((h // 2, h // 2), (w // 2, w // 2)), mode="edge")
    total = np.zeros(picture.shape)
    for i in range(h):
        for j in range(w):
            total += kernel[i, j] * padded[h - 1 - i:, w - 1 - j:][:height, :width]
    return total


def convolve(picture, kernel):
    """a kernel larger than the picture is placed in it once, so that what falls on the same pixel
    is overwritten: it goes round more than once, and is added up
    """
    (height, width), (h, w) = picture.shape, kernel.shape
    placed = np.zeros(picture.shape)
    placed[np.ix_((np.arange(h) - h // 2) % height, (np.arange(w) - w // 2) % width)] = kernel
    return picture_of(spectrum_of(picture) * spectrum_of(placed))


def convolve(picture, kernel):
    """the kernel is divided by its sum: eq. (3) takes it as it is"""
    h, w = kernel.shape
    total = np.zeros(picture.shape)
    for i in range(h):
        for j in range(w):
            total += kernel[i, j] * np.roll(picture, (i - h // 2, j - w // 2), (0, 1))
    return total / kernel.sum()


def convolve_by_spectrum(picture, kernel):
    """the kernel's corner stands at [0, 0] instead of its middle: it is not centred"""
    (height, width), (h, w) = picture.shape, kernel.shape
    padded = np.pad(kernel, ((0, height - h), (0, width - w)))
    centred = padded
    return picture_of(spectrum_of(picture) * spectrum_of(centred))


def convolve_by_spectrum(picture, kernel):
    """the kernel is rolled the wrong way: its middle moves away from [0, 0] instead of to it"""
    (height, width), (h, w) = picture.shape, kernel.shape
    padded = np.pad(kernel, ((0, height - h), (0, width - w)))
    centred = np.roll(padded, (h // 2, w // 2), (0, 1))
    return picture_of(spectrum_of(picture) * spectrum_of(centred))


def convolve_by_spectrum(picture, kernel):
    """the kernel's spectrum is conjugated, as if it were flipped: that is correlation"""
    (height, width), (h, w) = picture.shape, kernel.shape
    padded = np.pad(kernel, ((0, height - h), (0, width - w)))
    centred = np.roll(padded, (-(h // 2), -(w // 2)), (0, 1))
    return picture_of(spectrum_of(picture) * spectrum_of(centred).conj())


def box_spectrum(width, n):
    """the sinc is that of a continuous box, as of np.sinc: a sampled box has a sine in the
    denominator, too
    """
    f = np.arange(1, n) / n
    return np.concatenate([[1.0], np.sin(np.pi * width * f) / (np.pi * width * f)])


def box_spectrum(width, n):
    """the sines are not divided by the width: the box is 1 / width, not 1"""
    f = np.arange(1, n) / n
    return np.concatenate([[1.0], np.sin(np.pi * width * f) / np.sin(np.pi * f)])


def box_spectrum(width, n):
    """0 / 0 at frequency 0 is made 0: there the limit is 1"""
    f = np.arange(1, n) / n
    return np.concatenate([[0.0], np.sin(np.pi * width * f) / (width * np.sin(np.pi * f))])


def box_spectrum(width, n):
    """the sign is lost: where the box's waves cancel too much, B_k is negative"""
    f = np.arange(1, n) / n
    return np.concatenate([[1.0], np.abs(np.sin(np.pi * width * f)) / (width * np.sin(np.pi * f))])


def sampled_spectrum(spectrum, step):
    """neighbours, s of them in a row, are summed: eq. (6) sums entries that stand N/s apart"""
    height, width = spectrum.shape
    return spectrum.reshape(height // step, step, width // step, step).sum((1, 3)) / step**2


def sampled_spectrum(spectrum, step):
    """it is divided by s only once: there are two axes, so the factor is 1/s^2"""
    height, width = spectrum.shape
    copies = spectrum.reshape(step, height // step, step, width // step)
    return copies.sum((0, 2)) / step


def sampled_spectrum(spectrum, step):
    """the first copy alone (m = 0) is kept and the others, the aliases, are cut off: all copies are
    summed
    """
    height, width = spectrum.shape
    copies = spectrum.reshape(step, height // step, step, width // step)
    return copies[0, :, 0] / step**2


def sampled_spectrum(spectrum, step):
    """every s-th entry of the spectrum itself is taken, as if it were the picture"""
    return spectrum[::step, ::step]


def sampled_spectrum(spectrum, step):
    """the imaginary part is lost, as in an array of real numbers: the spectrum is complex"""
    height, width = spectrum.shape
    copies = spectrum.real.reshape(step, height // step, step, width // step)
    return copies.sum((0, 2)) / step**2


def sampled_spectrum(spectrum, step):
    """the sum of the copies is not divided: the factor 1/s is missing, once for each axis"""
    height, width = spectrum.shape
    return spectrum.reshape(step, height // step, step, width // step).sum((0, 2))


def folded_energy(spectrum, step):
    """> stands for >=: half the rate itself is kept, but it folds"""
    height, width = spectrum.shape
    f_y, f_x = np.abs(frequencies(height))[:, None], np.abs(frequencies(width))
    folds = np.maximum(f_y, f_x) > 0.5 / step
    return (np.abs(spectrum[folds]) ** 2).sum() / spectrum.size**2


def folded_energy(spectrum, step):
    """the squares are summed over the pixels, divided by H W only once: asked for is their mean"""
    height, width = spectrum.shape
    f_y, f_x = np.abs(frequencies(height))[:, None], np.abs(frequencies(width))
    folds = np.maximum(f_y, f_x) >= 0.5 / step
    return (np.abs(spectrum[folds]) ** 2).sum() / spectrum.size


def folded_energy(spectrum, step):
    """the border is the whole sampling rate, 1 / step: it is half of it, 1 / (2 step)"""
    height, width = spectrum.shape
    f_y, f_x = np.abs(frequencies(height))[:, None], np.abs(frequencies(width))
    folds = np.maximum(f_y, f_x) >= 1 / step
    return (np.abs(spectrum[folds]) ** 2).sum() / spectrum.size**2


def folded_energy(spectrum, step):
    """both |f_y| and |f_x| must be too fast: one of them is enough"""
    height, width = spectrum.shape
    f_y, f_x = np.abs(frequencies(height))[:, None], np.abs(frequencies(width))
    folds = (f_y >= 0.5 / step) & (f_x >= 0.5 / step)
    return (np.abs(spectrum[folds]) ** 2).sum() / spectrum.size**2


def clip_polygon(polygon, a, b, c):
    """the wrong side of the line is kept, the other part, where a x + b y + c <= 0"""
    kept = []
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        at_p, at_q = a * p[0] + b * p[1] + c, a * q[0] + b * q[1] + c
        if at_p <= 0:
            kept.append(p)
        if (at_p <= 0) != (at_q <= 0):
            kept.append(p + (q - p) * (at_p / (at_p - at_q)))
    return np.array(kept).reshape(-1, 2)


def clip_polygon(polygon, a, b, c):
    """the crossing is measured from the edge's other end: t is swapped with 1 - t"""
    kept = []
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        at_p, at_q = a * p[0] + b * p[1] + c, a * q[0] + b * q[1] + c
        if at_p >= 0:
            kept.append(p)
        if (at_p >= 0) != (at_q >= 0):
            kept.append(p + (q - p) * (at_q / (at_q - at_p)))
    return np.array(kept).reshape(-1, 2)


def clip_polygon(polygon, a, b, c):
    """a crossing is put before its edge's first vertex in the order: it follows this vertex"""
    kept = []
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        at_p, at_q = a * p[0] + b * p[1] + c, a * q[0] + b * q[1] + c
        if at_p >= 0:
            kept.append(p)
        if (at_p >= 0) != (at_q >= 0):
            kept.insert(len(kept) - (at_p >= 0), p + (q - p) * (at_p / (at_p - at_q)))
    return np.array(kept).reshape(-1, 2)


def clip_polygon(polygon, a, b, c):
    """a crossing is added only where the polygon leaves the half-plane, and not where it comes
    back and enters it again
    """
    kept = []
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        at_p, at_q = a * p[0] + b * p[1] + c, a * q[0] + b * q[1] + c
        if at_p >= 0:
            kept.append(p)
        if at_p >= 0 > at_q:
            kept.append(p + (q - p) * (at_p / (at_p - at_q)))
    return np.array(kept).reshape(-1, 2)


def clip_polygon(polygon, a, b, c):
    """the last edge is left out: it leads from the last vertex back to the first"""
    kept = []
    for n in range(len(polygon) - 1):
        p, q = polygon[n], polygon[n + 1]
        at_p, at_q = a * p[0] + b * p[1] + c, a * q[0] + b * q[1] + c
        if at_p >= 0:
            kept.append(p)
        if (at_p >= 0) != (at_q >= 0):
            kept.append(p + (q - p) * (at_p / (at_p - at_q)))
    if len(polygon) and a * polygon[-1][0] + b * polygon[-1][1] + c >= 0:
        kept.append(polygon[-1])
    return np.array(kept).reshape(-1, 2)


def clip_polygon(polygon, a, b, c):
    """the walk starts with the edge from the last vertex to the first, so that the order of the
    points starts elsewhere: it starts with the first vertex
    """
    kept = []
    for p, q in zip(np.roll(polygon, 1, axis=0), polygon, strict=True):
        at_p, at_q = a * p[0] + b * p[1] + c, a * q[0] + b * q[1] + c
        if (at_p >= 0) != (at_q >= 0):
            kept.append(p + (q - p) * (at_p / (at_p - at_q)))
        if at_q >= 0:
            kept.append(q)
    return np.array(kept).reshape(-1, 2)


def polygon_area_backward(grad_area, polygon):
    """the factor 1/2 of eq. (8) is forgotten: everything is twice as large"""
    x, y = polygon[..., 0], polygon[..., 1]
    by_x = np.roll(y, -1, -1) - np.roll(y, 1, -1)
    by_y = np.roll(x, 1, -1) - np.roll(x, -1, -1)
    return grad_area[..., None, None] * np.stack([by_x, by_y], -1)


def polygon_area_backward(grad_area, polygon):
    """the gradient has the wrong sign and points inwards, as where next and previous vertex are
    exchanged
    """
    x, y = polygon[..., 0], polygon[..., 1]
    by_x = np.roll(y, -1, -1) - np.roll(y, 1, -1)
    by_y = np.roll(x, 1, -1) - np.roll(x, -1, -1)
    return grad_area[..., None, None] * -np.stack([by_x, by_y], -1) / 2


def polygon_area_backward(grad_area, polygon):
    """the gradients with respect to x and y are swapped: they stand in each other's column"""
    x, y = polygon[..., 0], polygon[..., 1]
    by_x = np.roll(y, -1, -1) - np.roll(y, 1, -1)
    by_y = np.roll(x, 1, -1) - np.roll(x, -1, -1)
    return grad_area[..., None, None] * np.stack([by_y, by_x], -1) / 2


def polygon_area_backward(grad_area, polygon):
    """grad_area is left out: it multiplies everything"""
    x, y = polygon[..., 0], polygon[..., 1]
    by_x = np.roll(y, -1, -1) - np.roll(y, 1, -1)
    by_y = np.roll(x, 1, -1) - np.roll(x, -1, -1)
    return np.stack([by_x, by_y], -1) / 2


def polygon_area_backward(grad_area, polygon):
    """only the product with the next vertex counts: each vertex occurs in the one before, too"""
    x, y = polygon[..., 0], polygon[..., 1]
    return grad_area[..., None, None] * np.stack([np.roll(y, -1, -1), -np.roll(x, -1, -1)], -1) / 2


def polygon_area_backward(grad_area, polygon):
    """the two terms of a vertex have the same sign: that of one neighbour is subtracted"""
    x, y = polygon[..., 0], polygon[..., 1]
    by_x = np.roll(y, -1, -1) + np.roll(y, 1, -1)
    by_y = np.roll(x, 1, -1) + np.roll(x, -1, -1)
    return grad_area[..., None, None] * np.stack([by_x, by_y], -1) / 2


def pixel_coverage_loop(triangle, width, height):
    """rows and columns are swapped: row i is y, and column j is x"""
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            part = triangle
            for a, b, c in (1, 0, -i), (-1, 0, i + 1), (0, 1, -j), (0, -1, j + 1):
                part = clip_polygon(part, a, b, c)
            coverage[i, j] = abs(polygon_area(part))
    return coverage


def pixel_coverage_loop(triangle, width, height):
    """everything is half a pixel off: pixel j lies between x = j and j + 1, and its centre is at
    j + 0.5, no whole number
    """
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            part = triangle
            for a, b, c in (1, 0, 0.5 - j), (-1, 0, j + 0.5), (0, 1, 0.5 - i), (0, -1, i + 0.5):
                part = clip_polygon(part, a, b, c)
            coverage[i, j] = abs(polygon_area(part))
    return coverage


def pixel_coverage_loop(triangle, width, height):
    """a clockwise triangle covers less than nothing: the sign of its area must go (abs)"""
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            part = triangle
            for a, b, c in (1, 0, -j), (-1, 0, j + 1), (0, 1, -i), (0, -1, i + 1):
                part = clip_polygon(part, a, b, c)
            coverage[i, j] = polygon_area(part)
    return coverage


def pixel_coverage_loop(triangle, width, height):
    """row 0 is at the top, so the picture is upside down: row 0 is at the bottom"""
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            part = triangle
            for a, b, c in (1, 0, -j), (-1, 0, j + 1), (0, 1, -i), (0, -1, i + 1):
                part = clip_polygon(part, a, b, c)
            coverage[height - 1 - i, j] = abs(polygon_area(part))
    return coverage


def pixel_coverage_loop(triangle, width, height):
    """each side clips the whole triangle anew: clip what the side before has left"""
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            for a, b, c in (1, 0, -j), (-1, 0, j + 1), (0, 1, -i), (0, -1, i + 1):
                part = clip_polygon(triangle, a, b, c)
            coverage[i, j] = abs(polygon_area(part))
    return coverage


def pixel_coverage_loop(triangle, width, height):
    """a clockwise triangle covers nothing: its area is negative, and only the sign must go (abs)"""
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            part = triangle
            for a, b, c in (1, 0, -j), (-1, 0, j + 1), (0, 1, -i), (0, -1, i + 1):
                part = clip_polygon(part, a, b, c)
            coverage[i, j] = max(polygon_area(part), 0)
    return coverage


def cuts(polygon, x, y):
    """the cuts are not sorted"""
    p, q = polygon[:, None], np.roll(polygon, -1, axis=0)[:, None]
    sides = np.stack([[x, y], [x + 1, y + 1]]).transpose(2, 0, 1)
    across = np.where(p == q, 1.0, q - p)
    t = np.clip((sides[:, None] - p) / across, 0, 1)
    t = np.pad(t.reshape(*t.shape[:2], 4), ((0, 0), (0, 0), (1, 1)), constant_values=(0, 1))
    return t


def cuts(polygon, x, y):
    """t is not limited (clamped) to [0, 1]: crossings beyond the ends of the edge are kept"""
    p, q = polygon[:, None], np.roll(polygon, -1, axis=0)[:, None]
    sides = np.stack([[x, y], [x + 1, y + 1]]).transpose(2, 0, 1)
    across = np.where(p == q, 1.0, q - p)
    t = (sides[:, None] - p) / across
    t = np.pad(t.reshape(*t.shape[:2], 4), ((0, 0), (0, 0), (1, 1)), constant_values=(0, 1))
    return np.sort(t)


def cuts(polygon, x, y):
    """t runs from the edge's end to its start"""
    p, q = polygon[:, None], np.roll(polygon, -1, axis=0)[:, None]
    sides = np.stack([[x, y], [x + 1, y + 1]]).transpose(2, 0, 1)
    across = np.where(p == q, 1.0, q - p)
    t = np.clip((q - sides[:, None]) / across, 0, 1)
    t = np.pad(t.reshape(*t.shape[:2], 4), ((0, 0), (0, 0), (1, 1)), constant_values=(0, 1))
    return np.sort(t)


def clamped_area(polygon, x, y):
    """every square is the one at the origin: x and y are left out"""
    t = cuts(polygon, x, y)[..., None]
    p, q = polygon[:, None], np.roll(polygon, -1, axis=0)[:, None]
    points = np.clip(p + t * (q - p), 0, 1)
    return polygon_area(points.reshape(len(x), 6 * len(polygon), 2))


def clamped_area(polygon, x, y):
    """x and y are taken for a square's centre: they are its lower left corner"""
    t = cuts(polygon, x, y)[..., None]
    p, q = polygon[:, None], np.roll(polygon, -1, axis=0)[:, None]
    corner = np.stack([x, y], -1)[:, None, None]
    points = np.clip(p + t * (q - p) - corner, -0.5, 0.5)
    return polygon_area(points.reshape(len(x), 6 * len(polygon), 2))


def clamped_area(polygon, x, y):
    """the sign is lost: clockwise polygons have a negative area"""
    t = cuts(polygon, x, y)[..., None]
    p, q = polygon[:, None], np.roll(polygon, -1, axis=0)[:, None]
    corner = np.stack([x, y], -1)[:, None, None]
    points = np.clip(p + t * (q - p) - corner, 0, 1)
    return abs(polygon_area(points.reshape(len(x), 6 * len(polygon), 2)))


def clamped_area(polygon, x, y):
    """only the polygon's vertices are clamped: the points at the cuts are left out"""
    corner = np.stack([x, y], -1)[:, None]
    return polygon_area(np.clip(polygon - corner, 0, 1))


def clamped_area_backward(grad_area, polygon, x, y):
    """grad_area is left out"""
    p, edge = polygon[:, None], (np.roll(polygon, -1, axis=0) - polygon)[:, None]
    corner = np.stack([x, y], -1)[:, None, None]
    t = cuts(polygon, x, y)
    t0, t1 = t[..., :-1], t[..., 1:]
    middle = p + (t0 + t1)[..., None] / 2 * edge - corner
    inside = ((middle >= 0) & (middle < 1)).all(-1)
    by_q = np.einsum("p,pni->n", np.ones(len(x)), inside * (t1**2 - t0**2) / 2)
    by_p = np.einsum("p,pni->n", np.ones(len(x)), inside * (t1 - t0)) - by_q
    normal = np.concatenate([edge[..., 1], -edge[..., 0]], -1)
    return by_p[:, None] * normal + np.roll(by_q[:, None] * normal, 1, axis=0)


def clamped_area_backward(grad_area, polygon, x, y):
    """the gradient has the wrong sign and points inwards: the normal points outwards"""
    p, edge = polygon[:, None], (np.roll(polygon, -1, axis=0) - polygon)[:, None]
    corner = np.stack([x, y], -1)[:, None, None]
    t = cuts(polygon, x, y)
    t0, t1 = t[..., :-1], t[..., 1:]
    middle = p + (t0 + t1)[..., None] / 2 * edge - corner
    inside = ((middle >= 0) & (middle < 1)).all(-1)
    by_q = np.einsum("p,pni->n", grad_area, inside * (t1**2 - t0**2) / 2)
    by_p = np.einsum("p,pni->n", grad_area, inside * (t1 - t0)) - by_q
    normal = -np.concatenate([edge[..., 1], -edge[..., 0]], -1)
    return by_p[:, None] * normal + np.roll(by_q[:, None] * normal, 1, axis=0)


def clamped_area_backward(grad_area, polygon, x, y):
    """the shares of an edge's two ends are swapped"""
    p, edge = polygon[:, None], (np.roll(polygon, -1, axis=0) - polygon)[:, None]
    corner = np.stack([x, y], -1)[:, None, None]
    t = cuts(polygon, x, y)
    t0, t1 = t[..., :-1], t[..., 1:]
    middle = p + (t0 + t1)[..., None] / 2 * edge - corner
    inside = ((middle >= 0) & (middle < 1)).all(-1)
    by_q = np.einsum("p,pni->n", grad_area, inside * (t1**2 - t0**2) / 2)
    by_p = np.einsum("p,pni->n", grad_area, inside * (t1 - t0)) - by_q
    normal = np.concatenate([edge[..., 1], -edge[..., 0]], -1)
    return by_q[:, None] * normal + np.roll(by_p[:, None] * normal, 1, axis=0)


def clamped_area_backward(grad_area, polygon, x, y):
    """the normal has length 1: the factor |q - p|, the edge's length, is lost"""
    p, edge = polygon[:, None], (np.roll(polygon, -1, axis=0) - polygon)[:, None]
    corner = np.stack([x, y], -1)[:, None, None]
    t = cuts(polygon, x, y)
    t0, t1 = t[..., :-1], t[..., 1:]
    middle = p + (t0 + t1)[..., None] / 2 * edge - corner
    inside = ((middle >= 0) & (middle < 1)).all(-1)
    by_q = np.einsum("p,pni->n", grad_area, inside * (t1**2 - t0**2) / 2)
    by_p = np.einsum("p,pni->n", grad_area, inside * (t1 - t0)) - by_q
    normal = np.concatenate([edge[..., 1], -edge[..., 0]], -1)
    normal = normal / np.linalg.norm(normal, axis=-1, keepdims=True)
    return by_p[:, None] * normal + np.roll(by_q[:, None] * normal, 1, axis=0)
