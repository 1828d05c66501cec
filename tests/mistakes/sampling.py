"""Mistakes of lab 3; each docstring goes on after "this is what comes out when"."""


def alias_frequency(frequency, rate):
    """the sign is lost: the absolute value comes, and nothing seems to turn backwards"""
    return np.abs(frequency - rate * np.floor(frequency / rate + 0.5))


def alias_frequency(frequency, rate):
    """the rate is subtracted only once, even from a frequency of several times the rate"""
    return np.where(frequency >= rate / 2, frequency - rate, frequency)


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


def sampled_spectrum(spectrum, step):
    """neighbours, s of them in a row, are summed: eq. (6) sums entries that stand N/s apart"""
    height, width = spectrum.shape
    return spectrum.reshape(height // step, step, width // step, step).sum((1, 3)) / step**2


def sampled_spectrum(spectrum, step):
    """every s-th entry of the spectrum itself is taken, as if it were the picture"""
    return spectrum[::step, ::step]


def sampled_spectrum(spectrum, step):
    """the sum of the copies is not divided: the factor 1/s is missing, once for each axis"""
    height, width = spectrum.shape
    return spectrum.reshape(step, height // step, step, width // step).sum((0, 2))


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
    """only the product with the next vertex counts: each vertex occurs in the one before, too"""
    x, y = polygon[..., 0], polygon[..., 1]
    return grad_area[..., None, None] * np.stack([np.roll(y, -1, -1), -np.roll(x, -1, -1)], -1) / 2


def clamped_area(polygon, x, y):
    """only the polygon's vertices are clamped: the points at the cuts are left out"""
    corner = np.stack([x, y], -1)[:, None]
    return polygon_area(np.clip(polygon - corner, 0, 1))


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
