"""Wrong answers to sampling, written without a look at the checks."""


def alias_frequency(frequency, rate):
    """the result lies between 0 and the rate instead of between -r/2 and r/2

    told by: 0 to r | 0 and r | remainder | modulo | % | negative | -r/2
    """
    return np.mod(frequency, rate)


def alias_frequency(frequency, rate):
    """the sign is lost: an absolute value is returned, where a wheel turns backwards it should be negative

    told by: sign | absolute | abs | negative | backwards | direction
    """
    turns = np.floor(frequency / rate + 0.5)
    return np.abs(frequency - turns * rate)


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


def dft_matrix(n):
    """the matrix is scaled by 1/sqrt(n), the unitary convention

    told by: sqrt | unitary | 1/n | scaled | factor | normali | root
    """
    d = np.empty((n, n), complex)
    for row in range(n):
        for column in range(n):
            d[row, column] = np.exp(-2j * np.pi * row * column / n)
    return d / np.sqrt(n)


def dft_matrix(n):
    """the indices k and n count from 1 instead of from 0

    told by: from 1 | from 0 | start & 0 | start & 1 | first row | shifted & index | index 0
    """
    count = np.arange(1, n + 1)
    return np.exp(-2j * np.pi * np.outer(count, count) / n)


def band_pass(picture, low, high):
    """frequencies are k/n from 0 to 1: the upper half of the spectrum is not taken as negative frequencies

    told by: negative & frequenc | k - n | wrap | above & half | upper half | 0 to 1 | [-1/2
    """
    height, width = picture.shape
    f_y, f_x = np.arange(height) / height, np.arange(width) / width
    radius = np.sqrt(f_y[:, None] ** 2 + f_x[None, :] ** 2)
    keep = (radius >= low) & (radius < high)
    return picture_of(np.where(keep, spectrum_of(picture), 0))


def convolve(picture, kernel):
    """the kernel is not flipped: this is a correlation, n + m instead of n - m

    told by: correlat | flip | mirror | n + m | rotated by 180 | turned round | revers
    """
    height, width = picture.shape
    h, w = kernel.shape
    out = np.zeros((height, width))
    for y in range(height):
        for x in range(width):
            for i in range(h):
                for j in range(w):
                    out[y, x] += kernel[i, j] * picture[(y + i - h // 2) % height, (x + j - w // 2) % width]
    return out


def convolve(picture, kernel):
    """beyond the border the picture is taken as 0 instead of going round

    told by: border | zero & pad | circular | wrap | go round | goes round | going round
    """
    height, width = picture.shape
    h, w = kernel.shape
    wide = np.pad(picture, ((h // 2, h // 2), (w // 2, w // 2)))
    flipped = kernel[::-1, ::-1]
    result = np.zeros(picture.shape)
    for i in range(h):
        for j in range(w):
            result += flipped[i, j] * wide[i:i + height, j:j + width]
    return result


def convolve(picture, kernel):
    """the kernel is not centred: kernel[0, 0] is taken as g_0 instead of the middle

    told by: centre | center | middle | g_0 | kernel[0, 0] | shifted | h // 2
    """
    result = np.zeros(picture.shape)
    for (i, j), g in np.ndenumerate(kernel):
        result += g * np.roll(np.roll(picture, i, axis=0), j, axis=1)
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
    """the sum of the copies is divided by s once, not once for each of the two axes

    told by: 1/s | s^2 | step**2 | s squared | both axes & factor | once for each | divi & step
    """
    rows, columns = spectrum.shape[0] // step, spectrum.shape[1] // step
    folded = np.zeros((rows, columns), complex)
    for i in range(step):
        for j in range(step):
            folded += spectrum[i * rows:(i + 1) * rows, j * columns:(j + 1) * columns]
    return folded / step


def sampled_spectrum(spectrum, step):
    """neighbouring entries are added in blocks instead of entries that lie N/s apart

    told by: neighbour | adjacent | N/s | apart | block | consecutive | H / step
    """
    h, w = spectrum.shape
    groups = spectrum.reshape(h // step, step, w // step, step)
    return groups.mean(axis=(1, 3))


def sampled_spectrum(spectrum, step):
    """only the first copy, m = 0, is kept: the others are not added, so nothing aliases

    told by: m = 0 | first copy | one copy | copies & add | other copies | all copies | cropped
    """
    h, w = spectrum.shape
    return spectrum[:h // step, :w // step] / step**2


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
    """the crossing is measured from the wrong end of the edge: t is 1 - t

    told by: wrong end | other end | 1 - t | from q | mirrored | end & edge | at_q
    """
    side = polygon @ np.array([a, b]) + c
    points = []
    for n in range(len(polygon)):
        m = (n + 1) % len(polygon)
        if side[n] >= 0:
            points.append(polygon[n])
        if (side[n] >= 0) != (side[m] >= 0):
            t = side[m] / (side[m] - side[n])
            points.append(polygon[n] + t * (polygon[m] - polygon[n]))
    return np.array(points).reshape(-1, 2)


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


def clip_polygon(polygon, a, b, c):
    """the closing edge, from the last vertex back to the first, gets no crossing

    told by: closing edge | last edge | last vertex | back to the first | edge & missing | closed | wrap
    """
    kept = []
    value = a * polygon[:, 0] + b * polygon[:, 1] + c
    for n in range(len(polygon)):
        if value[n] >= 0:
            kept.append(polygon[n])
        if n + 1 < len(polygon) and (value[n] >= 0) != (value[n + 1] >= 0):
            t = value[n] / (value[n] - value[n + 1])
            kept.append((1 - t) * polygon[n] + t * polygon[n + 1])
    return np.array(kept).reshape(-1, 2)


def polygon_area_backward(grad_area, polygon):
    """the factor 1/2 of the shoelace formula is missing

    told by: 1/2 | half | halve | twice | factor & 2 | double | 0.5
    """
    after, before = np.roll(polygon, -1, axis=-2), np.roll(polygon, 1, axis=-2)
    d = after - before
    return grad_area[..., None, None] * np.stack([d[..., 1], -d[..., 0]], -1)


def polygon_area_backward(grad_area, polygon):
    """only the term with the next vertex is derived, each point also occurs in the term with the previous one

    told by: previous | next & only | both neighbours | one neighbour | n-1 | two terms | occurs & twice
    """
    out = np.zeros(polygon.shape)
    count = polygon.shape[-2]
    for n in range(count):
        following = polygon[..., (n + 1) % count, :]
        out[..., n, 0] = grad_area * following[..., 1] / 2
        out[..., n, 1] = -grad_area * following[..., 0] / 2
    return out


def polygon_area_backward(grad_area, polygon):
    """the gradient of y has the opposite sign: the minus of the second term is forgotten

    told by: sign & y | minus | opposite & y | negative & y | y & sign | negated | y component | sign & [..., 1]
    """
    x, y = polygon[..., 0], polygon[..., 1]
    d_x = np.roll(y, -1, -1) - np.roll(y, 1, -1)
    d_y = np.roll(x, -1, -1) - np.roll(x, 1, -1)
    return grad_area[..., None, None] * 0.5 * np.stack([d_x, d_y], axis=-1)


def pixel_coverage_loop(triangle, width, height):
    """the area of a clockwise triangle stays negative, its absolute value is not taken

    told by: clockwise | negative | absolute | abs | winding | sign
    """
    shares = np.zeros((height, width))
    for i, j in np.ndindex(height, width):
        piece = clip_polygon(triangle, 1.0, 0.0, -j)
        piece = clip_polygon(piece, -1.0, 0.0, j + 1)
        piece = clip_polygon(piece, 0.0, 1.0, -i)
        piece = clip_polygon(piece, 0.0, -1.0, i + 1)
        shares[i, j] = polygon_area(piece)
    return shares


def pixel_coverage_loop(triangle, width, height):
    """the pixel's square lies around (j, i), from j - 0.5 to j + 0.5, instead of from j to j + 1

    told by: j + 1 | half a pixel | half pixel | 0.5 | shifted | centred | centre
    """
    shares = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            piece = triangle
            for a, b, c in [(1, 0, 0.5 - j), (-1, 0, j + 0.5), (0, 1, 0.5 - i), (0, -1, i + 0.5)]:
                piece = clip_polygon(piece, a, b, c)
            shares[i, j] = abs(polygon_area(piece))
    return shares


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
    """only the vertices are clamped to the square, not the points of the edges at their cuts

    told by: cuts | only the vert | crossing | vertices & clamp | points & edges | corners & clamp
    """
    corner = np.stack([x, y], -1)[:, None]
    moved = np.clip(polygon[None] - corner, 0, 1)
    return polygon_area(moved)


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


def alias_frequency(frequency, rate):
    """the alias lies in 0 ... r instead of -r/2 ... r/2: only frequency modulo rate

    told by: modulo | 0 to r | from 0 | never negative | not negative | % rate | -r/2 | can be negative | is negative | should be negative
    """
    return np.mod(frequency, rate)


def alias_frequency(frequency, rate):
    """folded at the rate instead of at half the rate: m is f / r rounded towards 0

    told by: towards 0 | toward zero | truncat | int( | half the rate | nearest & multiple | rounded down | whole part
    """
    m = (frequency / rate).astype(int)
    return frequency - rate * m


def dft_matrix(n):
    """the matrix is complex64, single precision

    told by: complex64 | single precision | float32 | 7 digits | precision | complex128
    """
    d = np.empty((n, n), np.complex64)
    for k in range(n):
        for m in range(n):
            d[k, m] = np.exp(-2j * np.pi * k * m / n)
    return d


def dft_matrix(n):
    """divided by n: the 1/N of the inverse transform

    told by: divided by n | 1/n | 1 / n | factor & n | n times | inverse & n | normali
    """
    k = np.arange(n)
    return np.exp(-2j * np.pi * k[:, None] * k / n) / n


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
    """a correlation: the kernel is not mirrored, f at n + m instead of n - m

    told by: correlation | mirror | n + m | flipped | n - m | reversed | backwards | turned by 180
    """
    H, W = picture.shape
    h, w = kernel.shape
    result = np.zeros((H, W))
    for y in range(H):
        for x in range(W):
            for i in range(h):
                for j in range(w):
                    result[y, x] += kernel[i, j] * picture[(y + i - h // 2) % H, (x + j - w // 2) % W]
    return result


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


def box_spectrum(width, n):
    """the continuous sinc, sin(x) / x, instead of the sine of pi k/N in the denominator

    told by: continuous | sin(x) / x | sin(x)/x | np.sinc | denominator | sin(pi k | dirichlet | not periodic | aliases of the sinc
    """
    return np.sinc(width * np.arange(n) / n)


def sampled_spectrum(spectrum, step):
    """neighbouring frequencies are summed instead of those N / s apart

    told by: neighbour | apart | adjacent | block | n/s | n / s | consecutive
    """
    H, W = spectrum.shape
    return spectrum.reshape(H // step, step, W // step, step).sum((1, 3)) / step**2


def sampled_spectrum(spectrum, step):
    """divided by s once instead of once for y and once for x: 1/s^2 is needed

    told by: s^2 | s**2 | step**2 | step^2 | twice & divided | factor & step | step times | s times | once & both | 1/s & both | each axis | both axes
    """
    H, W = spectrum.shape
    h, w = H // step, W // step
    total = np.zeros((h, w), complex)
    for m in range(step):
        for n in range(step):
            total += spectrum[m * h:(m + 1) * h, n * w:(n + 1) * w]
    return total / step


def clip_polygon(polygon, a, b, c):
    """the last edge, from the last vertex back to the first, is left out

    told by: last edge | closing | back to the first | last vertex | closes | wrap | last to the first
    """
    out = []
    n = len(polygon)
    for k in range(n):
        p = polygon[k]
        d = a * p[0] + b * p[1] + c
        if d >= 0:
            out.append(p)
        if k + 1 < n:
            q = polygon[k + 1]
            d_next = a * q[0] + b * q[1] + c
            if (d >= 0) != (d_next >= 0):
                out.append(p + d / (d - d_next) * (q - p))
    return np.array(out).reshape(-1, 2)


def clip_polygon(polygon, a, b, c):
    """the crossing is measured from the wrong end: p and q are exchanged in its interpolation

    told by: wrong end | other end | p and q | 1 - t | crossing & exchanged | crossing & swapped | crossing & end | from q | weights & exchanged | mirrored
    """
    out = []
    side = polygon @ np.array([a, b]) + c
    for k in range(len(polygon)):
        n = (k + 1) % len(polygon)
        if side[k] >= 0:
            out.append(polygon[k])
        if (side[k] >= 0) != (side[n] >= 0):
            t = side[k] / (side[k] - side[n])
            out.append(t * polygon[k] + (1 - t) * polygon[n])
    return np.reshape(out, (-1, 2))


def polygon_area_backward(grad_area, polygon):
    """each coordinate gets only the term with the next vertex, that with the previous one is missing

    told by: previous | both neighbour | next vertex | only the next | second term | two terms | n-1 | n - 1 | one neighbour | half of the terms
    """
    after = np.roll(polygon, -1, axis=-2)
    grad = np.stack([after[..., 1], -after[..., 0]], -1) / 2
    return grad_area[..., None, None] * grad


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
    """the pixel's square is half a pixel off: from j - 0.5 to j + 0.5 instead of j to j + 1

    told by: half a pixel | half pixel | 0.5 | 1/2 | shifted & pixel | j + 1 | moved by
    """
    picture = np.zeros((height, width))
    for i, j in np.ndindex(height, width):
        piece = clip_polygon(triangle, 1, 0, 0.5 - j)
        piece = clip_polygon(piece, -1, 0, j + 0.5)
        piece = clip_polygon(piece, 0, 1, 0.5 - i)
        piece = clip_polygon(piece, 0, -1, i + 0.5)
        picture[i, j] = abs(polygon_area(piece))
    return picture


def pixel_coverage_loop(triangle, width, height):
    """coverage is an array of integers, so every partly covered pixel becomes 0

    told by: integer | dtype & int | whole number | cut off | truncat | dtype | rounded down | fraction
    """
    picture = np.full((height, width), 0)
    for i, j in np.ndindex(height, width):
        piece = triangle
        for a, b, c in [(1, 0, -j), (-1, 0, j + 1), (0, 1, -i), (0, -1, i + 1)]:
            piece = clip_polygon(piece, a, b, c)
        picture[i, j] = abs(polygon_area(piece))
    return picture


def clamped_area(polygon, x, y):
    """only the polygon's vertices are clamped to the square, without the cuts of its edges

    told by: cuts | only the vertices | vertices & clamp | crossing | edges & not cut | where & edges cross
    """
    area = np.zeros(len(x))
    for k in range(len(x)):
        area[k] = polygon_area(np.clip(polygon - np.array([x[k], y[k]]), 0, 1))
    return area


def clamped_area_backward(grad_area, polygon, x, y):
    """the weights t and 1 - t are exchanged between an edge's first and second vertex

    told by: 1 - t | t and 1 | exchanged | swapped | mixed up | other end | first & second & vertex | p and q
    """
    ahead = np.roll(polygon, -1, axis=0)
    t = cuts(polygon, x, y)
    grad = np.zeros(polygon.shape)
    for n in range(len(polygon)):
        d = ahead[n] - polygon[n]
        normal = np.array([d[1], -d[0]])
        lo, hi = t[:, n, :-1], t[:, n, 1:]
        m = (lo + hi)[..., None] / 2 * d + polygon[n] - np.stack([x, y], -1)[:, None]
        seen = ((m >= 0) & (m < 1)).all(-1) * grad_area[:, None]
        with_t = (seen * (hi**2 - lo**2) / 2).sum()
        rest = (seen * (hi - lo)).sum() - with_t
        grad[n] += with_t * normal
        grad[(n + 1) % len(polygon)] += rest * normal
    return grad
