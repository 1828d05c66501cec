"""Wrong answers to sampling, written without a look at the checks."""


def alias_frequency(frequency, rate):
    """the rate is subtracted at most once, but it takes as many times as fit

    told by: once | one rate | several | many & times | more than one | multiple | whole m
    """
    f = np.asarray(frequency, float)
    return np.where(f >= rate / 2, f - rate, np.where(f < -rate / 2, f + rate, f))


def dft_matrix(n):
    """the exponent is positive: this is the matrix of the inverse transform, the conjugate

    told by: sign | conjugate | inverse | exp(+ | minus | positive exponent | negative exponent
    """
    k = np.arange(n)
    return np.exp(2j * np.pi * k[:, None] * k / n)


def band_pass(picture, low, high):
    """max(|f_y|, |f_x|) is compared instead of the length of (f_y, f_x): a square band, not a ring

    told by: square | ring | circle | maximum | max( | hypot | length of | euclid | pythag | diagonal
    """
    h, w = picture.shape
    f_y, f_x = abs(frequencies(h)), abs(frequencies(w))
    spectrum = spectrum_of(picture)
    for i in range(h):
        for j in range(w):
            if not low <= max(f_y[i], f_x[j]) < high:
                spectrum[i, j] = 0
    return picture_of(spectrum)


def convolve(picture, kernel):
    """beyond the border the picture is taken as 0 instead of going round

    told by: beyond & border | goes round | go round | going round | wrap | circular | periodic | zero & border | padd
    """
    H, W = picture.shape
    h, w = kernel.shape
    padded = np.pad(picture, ((h // 2, h // 2), (w // 2, w // 2)))
    result = np.zeros((H, W))
    for (i, j), weight in np.ndenumerate(kernel[::-1, ::-1]):
        result += weight * padded[i:i + H, j:j + W]
    return result


def convolve_by_spectrum(picture, kernel):
    """the kernel's middle is not brought to [0, 0] before the transform

    told by: middle | centre | center | roll | shifted | [0, 0] | corner
    """
    big = np.zeros(picture.shape)
    big[:kernel.shape[0], :kernel.shape[1]] = kernel
    return picture_of(spectrum_of(picture) * spectrum_of(big))


def box_spectrum(width, n):
    """the denominator is pi w k/N, the sinc of a continuous box, without the second sine

    told by: continuous | denominator | sin(pi k | second sine | np.sinc | sine & below | periodic
    """
    return np.sinc(width * np.arange(n) / n)


def sampled_spectrum(spectrum, step):
    """neighbouring entries are added in blocks instead of entries that lie N/s apart

    told by: neighbour | adjacent | N/s | apart | block | consecutive | H / step
    """
    h, w = spectrum.shape
    groups = spectrum.reshape(h // step, step, w // step, step)
    return groups.mean(axis=(1, 3))


def folded_energy(spectrum, step):
    """a frequency counts only if both |f_y| and |f_x| are too fast, it should be one or the other

    told by: both | either | or instead of and | one of | and & or | smaller of | minimum
    """
    height, width = spectrum.shape
    limit = 1 / (2 * step)
    fast_y, fast_x = np.abs(frequencies(height)) >= limit, np.abs(frequencies(width)) >= limit
    power = np.abs(spectrum) ** 2 * (fast_y[:, None] & fast_x[None, :])
    return power.sum() / spectrum.size**2


def clip_polygon(polygon, a, b, c):
    """an edge's crossing is added before its first vertex instead of after it, so the points are in the wrong order

    told by: order | before & crossing | crossing & after | sequence | first vertex & crossing | border & itself
    """
    inside = [a * v[0] + b * v[1] + c for v in polygon]
    result = []
    for k, v in enumerate(polygon):
        here, there = inside[k], inside[(k + 1) % len(polygon)]
        if (here >= 0) != (there >= 0):
            towards = polygon[(k + 1) % len(polygon)]
            result.append((v * there - towards * here) / (there - here))
        if here >= 0:
            result.append(v)
    return np.array(result).reshape(-1, 2)


def polygon_area_backward(grad_area, polygon):
    """the gradients of x and of y are exchanged in the last axis

    told by: x and y | exchanged | swapped | mixed up | x & in place of & y | columns
    """
    x, y = polygon[..., 0], polygon[..., 1]
    g = np.zeros(polygon.shape)
    count = polygon.shape[-2]
    for n in range(count):
        nxt, prev = (n + 1) % count, n - 1
        g[..., n, 1] = grad_area * (y[..., nxt] - y[..., prev]) / 2
        g[..., n, 0] = grad_area * (x[..., prev] - x[..., nxt]) / 2
    return g


def pixel_coverage_loop(triangle, width, height):
    """only the centre is tested, covered or not: 0 or 1 instead of the area

    told by: 0 or 1 | centre | center | 0 and 1 | partial | fraction | all or nothing
    """
    turn = np.sign(polygon_area(triangle))
    result = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            middle = np.array([j + 0.5, i + 0.5])
            pieces = [polygon_area(np.stack([triangle[k], triangle[(k + 1) % 3], middle])) for k in range(3)]
            result[i, j] = float(min(turn * piece for piece in pieces) >= 0)
    return result


def cuts(polygon, x, y):
    """edge n leads to the previous vertex instead of the next: the roll goes the wrong way

    told by: previous | roll & way | next vertex | n - 1 | other neighbour | backwards | roll & -1
    """
    other = np.roll(polygon, 1, axis=0)
    t = np.empty((len(x), len(polygon), 6))
    t[..., 0], t[..., 1] = 0, 1
    for n, (p, q) in enumerate(zip(polygon, other)):
        for axis, low in enumerate((x, y)):
            run = q[axis] - p[axis] if q[axis] != p[axis] else 1.0
            t[:, n, 2 + 2 * axis] = np.clip((low - p[axis]) / run, 0, 1)
            t[:, n, 3 + 2 * axis] = np.clip((low + 1 - p[axis]) / run, 0, 1)
    return np.sort(t, axis=-1)


def clamped_area(polygon, x, y):
    """only the polygon's vertices are clamped to the square, without the cuts of its edges

    told by: cuts | only the vertices | vertices & clamp | crossing | edges & not cut | where & edges cross
    """
    area = np.zeros(len(x))
    for k in range(len(x)):
        area[k] = polygon_area(np.clip(polygon - np.array([x[k], y[k]]), 0, 1))
    return area


def clamped_area_backward(grad_area, polygon, x, y):
    """the weights 1 - t of p and t of q are exchanged: each end of an edge gets the other's share

    told by: exchang | swap | 1 - t | p and q | other end | mixed up | ends & edge
    """
    p = polygon[:, None]
    run = np.roll(polygon, -1, axis=0)[:, None] - p
    low = np.stack([x, y], -1)[:, None, None]
    t = cuts(polygon, x, y)
    begin, end = t[..., :-1], t[..., 1:]
    place = p + 0.5 * (begin + end)[..., None] * run - low
    within = ((place >= 0) & (place < 1)).all(-1)
    share = grad_area[:, None, None] * within
    with_t = (share * (end**2 - begin**2) / 2).sum((0, 2))
    rest = (share * (end - begin)).sum((0, 2)) - with_t
    outward = np.concatenate([run[..., 1], -run[..., 0]], -1)
    return with_t[:, None] * outward + np.roll(rest[:, None] * outward, 1, axis=0)
