"""Mistakes of lab 3; each docstring goes on after "this is what comes out when"."""


def alias_frequency(frequency, rate):
    """the alias is looked for in [0, rate) instead of around 0"""
    return frequency - rate * np.floor(frequency / rate)


def alias_frequency(frequency, rate):
    """halves are rounded to the even number: half the rate comes with either sign"""
    return frequency - rate * np.round(frequency / rate)


def alias_frequency(frequency, rate):
    """the sign is lost: negative means backwards"""
    return np.abs(frequency - rate * np.floor(frequency / rate + 0.5))


def dft_matrix(n):
    """the exponent lacks its minus: that is the inverse's matrix"""
    k = np.arange(n)
    return np.exp(2j * np.pi * (np.outer(k, k) % n) / n)


def dft_matrix(n):
    """it is pi instead of 2 pi"""
    k = np.arange(n)
    return np.exp(-2j * np.pi / 2 * (np.outer(k, k) % n) / n)


def dft_matrix(n):
    """the matrix is divided by n; that is left to the inverse"""
    k = np.arange(n)
    return np.exp(-2j * np.pi * (np.outer(k, k) % n) / n) / n


def band_pass(picture, low, high):
    """the greater of |f_y| and |f_x| is taken for the length: the band is a square"""
    height, width = picture.shape
    length = np.maximum(np.abs(frequencies(height))[:, None], np.abs(frequencies(width)))
    return picture_of(spectrum_of(picture) * ((low <= length) & (length < high)))


def band_pass(picture, low, high):
    """a band has its upper end and not its lower one"""
    height, width = picture.shape
    length = np.hypot(frequencies(height)[:, None], frequencies(width))
    return picture_of(spectrum_of(picture) * ((low < length) & (length <= high)))


def band_pass(picture, low, high):
    """frequencies above 1/2 are taken as they are: they stand for negative ones"""
    height, width = picture.shape
    length = np.hypot(np.arange(height)[:, None] / height, np.arange(width) / width)
    return picture_of(spectrum_of(picture) * ((low <= length) & (length < high)))


def convolve(picture, kernel):
    """the kernel is turned round: that is correlation"""
    h, w = kernel.shape
    total = np.zeros(picture.shape)
    for i in range(h):
        for j in range(w):
            total += kernel[i, j] * np.roll(picture, (h // 2 - i, w // 2 - j), (0, 1))
    return total


def convolve(picture, kernel):
    """the kernel's corner is its number (0, 0); it is its middle"""
    h, w = kernel.shape
    total = np.zeros(picture.shape)
    for i in range(h):
        for j in range(w):
            total += kernel[i, j] * np.roll(picture, (i, j), (0, 1))
    return total


def convolve(picture, kernel):
    """beyond the border is 0; rows and columns go round"""
    h, w = kernel.shape
    padded = np.pad(picture, ((h // 2, h // 2), (w // 2, w // 2)))
    total = np.zeros(picture.shape)
    for i in range(h):
        for j in range(w):
            moved = padded[h - 1 - i:, w - 1 - j:]
            total += kernel[i, j] * moved[:picture.shape[0], :picture.shape[1]]
    return total


def convolve_by_spectrum(picture, kernel):
    """the kernel's corner stands at [0, 0] instead of its middle"""
    (height, width), (h, w) = picture.shape, kernel.shape
    padded = np.pad(kernel, ((0, height - h), (0, width - w)))
    centred = padded
    return picture_of(spectrum_of(picture) * spectrum_of(centred))


def convolve_by_spectrum(picture, kernel):
    """the kernel is moved away from [0, 0] instead of to it"""
    (height, width), (h, w) = picture.shape, kernel.shape
    padded = np.pad(kernel, ((0, height - h), (0, width - w)))
    centred = np.roll(padded, (h // 2, w // 2), (0, 1))
    return picture_of(spectrum_of(picture) * spectrum_of(centred))


def convolve_by_spectrum(picture, kernel):
    """the kernel's spectrum is conjugated: that is correlation"""
    (height, width), (h, w) = picture.shape, kernel.shape
    padded = np.pad(kernel, ((0, height - h), (0, width - w)))
    centred = np.roll(padded, (-(h // 2), -(w // 2)), (0, 1))
    return picture_of(spectrum_of(picture) * spectrum_of(centred).conj())


def box_spectrum(width, n):
    """it is the sinc of a box that is not made of samples"""
    f = np.arange(1, n) / n
    return np.concatenate([[1.0], np.sin(np.pi * width * f) / (np.pi * width * f)])


def box_spectrum(width, n):
    """the sines are not divided by the width"""
    f = np.arange(1, n) / n
    return np.concatenate([[1.0], np.sin(np.pi * width * f) / np.sin(np.pi * f)])


def box_spectrum(width, n):
    """0 / 0 at frequency 0 is made 0; there the limit is 1"""
    f = np.arange(1, n) / n
    return np.concatenate([[0.0], np.sin(np.pi * width * f) / (width * np.sin(np.pi * f))])


def sampled_spectrum(spectrum, step):
    """neighbours are summed; copies stand N / s apart"""
    height, width = spectrum.shape
    return spectrum.reshape(height // step, step, width // step, step).sum((1, 3)) / step**2


def sampled_spectrum(spectrum, step):
    """it is divided by s once; there are two axes"""
    height, width = spectrum.shape
    copies = spectrum.reshape(step, height // step, step, width // step)
    return copies.sum((0, 2)) / step


def sampled_spectrum(spectrum, step):
    """the first copy alone is kept; all of them are summed"""
    height, width = spectrum.shape
    copies = spectrum.reshape(step, height // step, step, width // step)
    return copies[0, :, 0] / step**2


def folded_energy(spectrum, step):
    """half the rate is kept; it folds"""
    height, width = spectrum.shape
    f_y, f_x = np.abs(frequencies(height))[:, None], np.abs(frequencies(width))
    folds = np.maximum(f_y, f_x) > 0.5 / step
    return (np.abs(spectrum[folds]) ** 2).sum() / spectrum.size**2


def folded_energy(spectrum, step):
    """the squares are summed over the pixels; what is asked for is their mean"""
    height, width = spectrum.shape
    f_y, f_x = np.abs(frequencies(height))[:, None], np.abs(frequencies(width))
    folds = np.maximum(f_y, f_x) >= 0.5 / step
    return (np.abs(spectrum[folds]) ** 2).sum() / spectrum.size


def folded_energy(spectrum, step):
    """the whole sampling rate is the border; it is half of it"""
    height, width = spectrum.shape
    f_y, f_x = np.abs(frequencies(height))[:, None], np.abs(frequencies(width))
    folds = np.maximum(f_y, f_x) >= 1 / step
    return (np.abs(spectrum[folds]) ** 2).sum() / spectrum.size**2


def clip_polygon(polygon, a, b, c):
    """the wrong side of the line is kept"""
    kept = []
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        at_p, at_q = a * p[0] + b * p[1] + c, a * q[0] + b * q[1] + c
        if at_p <= 0:
            kept.append(p)
        if (at_p <= 0) != (at_q <= 0):
            kept.append(p + (q - p) * (at_p / (at_p - at_q)))
    return np.array(kept).reshape(-1, 2)


def clip_polygon(polygon, a, b, c):
    """the crossing is measured from the edge's other end"""
    kept = []
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        at_p, at_q = a * p[0] + b * p[1] + c, a * q[0] + b * q[1] + c
        if at_p >= 0:
            kept.append(p)
        if (at_p >= 0) != (at_q >= 0):
            kept.append(p + (q - p) * (at_q / (at_q - at_p)))
    return np.array(kept).reshape(-1, 2)


def clip_polygon(polygon, a, b, c):
    """a crossing is put before the vertex; it follows it"""
    kept = []
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        at_p, at_q = a * p[0] + b * p[1] + c, a * q[0] + b * q[1] + c
        if at_p >= 0:
            kept.append(p)
        if (at_p >= 0) != (at_q >= 0):
            kept.insert(len(kept) - (at_p >= 0), p + (q - p) * (at_p / (at_p - at_q)))
    return np.array(kept).reshape(-1, 2)


def polygon_area_backward(grad_area, polygon):
    """eq. (8) is taken without its 1/2"""
    x, y = polygon[..., 0], polygon[..., 1]
    by_x = np.roll(y, -1, -1) - np.roll(y, 1, -1)
    by_y = np.roll(x, 1, -1) - np.roll(x, -1, -1)
    return grad_area[..., None, None] * np.stack([by_x, by_y], -1)


def polygon_area_backward(grad_area, polygon):
    """the gradient points inwards: its sign is wrong"""
    x, y = polygon[..., 0], polygon[..., 1]
    by_x = np.roll(y, -1, -1) - np.roll(y, 1, -1)
    by_y = np.roll(x, 1, -1) - np.roll(x, -1, -1)
    return grad_area[..., None, None] * -np.stack([by_x, by_y], -1) / 2


def polygon_area_backward(grad_area, polygon):
    """the gradients by x and by y are swapped"""
    x, y = polygon[..., 0], polygon[..., 1]
    by_x = np.roll(y, -1, -1) - np.roll(y, 1, -1)
    by_y = np.roll(x, 1, -1) - np.roll(x, -1, -1)
    return grad_area[..., None, None] * np.stack([by_y, by_x], -1) / 2


def pixel_coverage_loop(triangle, width, height):
    """rows and columns are swapped"""
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            part = triangle
            for a, b, c in (1, 0, -i), (-1, 0, i + 1), (0, 1, -j), (0, -1, j + 1):
                part = clip_polygon(part, a, b, c)
            coverage[i, j] = abs(polygon_area(part))
    return coverage


def pixel_coverage_loop(triangle, width, height):
    """everything is half a pixel off: pixel j lies between j and j + 1"""
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            part = triangle
            for a, b, c in (1, 0, 0.5 - j), (-1, 0, j + 0.5), (0, 1, 0.5 - i), (0, -1, i + 0.5):
                part = clip_polygon(part, a, b, c)
            coverage[i, j] = abs(polygon_area(part))
    return coverage


def pixel_coverage_loop(triangle, width, height):
    """a clockwise triangle covers less than nothing"""
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            part = triangle
            for a, b, c in (1, 0, -j), (-1, 0, j + 1), (0, 1, -i), (0, -1, i + 1):
                part = clip_polygon(part, a, b, c)
            coverage[i, j] = polygon_area(part)
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
    """crossings before an edge's start and after its end are left outside [0, 1]"""
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
    """every square is the one at the origin"""
    t = cuts(polygon, x, y)[..., None]
    p, q = polygon[:, None], np.roll(polygon, -1, axis=0)[:, None]
    points = np.clip(p + t * (q - p), 0, 1)
    return polygon_area(points.reshape(len(x), 6 * len(polygon), 2))


def clamped_area(polygon, x, y):
    """x and y are taken for a square's centre; they are its lower left corner"""
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
    """the gradient points inwards: the normal points outwards"""
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
