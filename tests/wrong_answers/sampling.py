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
    """rate / 2 itself is not turned into -rate / 2: the interval is open at the wrong end (fine print)

    told by: -rate/2 | -rate / 2 | half the rate | r/2 | upper end | ceil
    """
    return frequency - rate * np.ceil(frequency / rate - 0.5)


def alias_frequency(frequency, rate):
    """the rate is subtracted only once, which is too few times for a frequency above 3/2 of the rate

    told by: only once | several times | more than one | whole number of | many times | one time
    """
    return np.where(frequency >= rate / 2, frequency - rate, frequency)


def dft_matrix(n):
    """the 2 of 2 pi is forgotten: the frequencies are half as high

    told by: 2 pi | 2pi | factor 2 | factor of 2
    """
    index = np.arange(n)
    angle = np.pi * index[:, None] * index / n
    return np.cos(angle) - 1j * np.sin(angle)


def convolve(picture, kernel):
    """correlation: the kernel is not flipped, f_(n + m) is taken instead of f_(n - m)

    told by: correlation | flip | n + m | mirrored | turned round | reversed
    """
    H, W = picture.shape
    h, w = kernel.shape
    out = np.zeros((H, W))
    for y in range(H):
        for x in range(W):
            for i in range(h):
                for j in range(w):
                    out[y, x] += kernel[i, j] * picture[(y + i - h // 2) % H, (x + j - w // 2) % W]
    return out


def convolve(picture, kernel):
    """the kernel's first entry [0, 0] is taken as g_0, not its middle, so the result is shifted

    told by: shift | middle | centre of the kernel | center | h // 2 | w // 2
    """
    total = np.zeros(picture.shape)
    for i, row in enumerate(kernel):
        for j, weight in enumerate(row):
            total += weight * np.roll(picture, (i, j), axis=(0, 1))
    return total


def convolve(picture, kernel):
    """the border pixels are repeated outwards (clamped), they should go round

    told by: clamp | border & repeat | replicate | circular | wrap | go round
    """
    H, W = picture.shape
    h, w = kernel.shape
    padded = np.pad(picture, ((h // 2,), (w // 2,)), mode="edge")
    total = np.zeros((H, W))
    for i in range(h):
        for j in range(w):
            top, left = h - 1 - i, w - 1 - j
            total += kernel[i, j] * padded[top:top + H, left:left + W]
    return total


def convolve_by_spectrum(picture, kernel):
    """the kernel stays in the corner: it is padded, but its middle is not moved to [0, 0]

    told by: middle | shift | roll | [0, 0] | corner | centre
    """
    height, width = picture.shape
    h, w = kernel.shape
    padded = np.zeros((height, width))
    padded[:h, :w] = kernel
    return picture_of(spectrum_of(picture) * spectrum_of(padded))


def sampled_spectrum(spectrum, step):
    """divided by the step only once, though there are two axes

    told by: step**2 | s^2 | squared | two axes | both axes | only once
    """
    H, W = spectrum.shape
    blocks = spectrum.reshape(step, H // step, step, W // step)
    return blocks.sum(axis=(0, 2)) / step


def folded_energy(spectrum, step):
    """only what is too fast along both axes counts: and where or is needed

    told by: both axes | and instead of or | and where | minimum | f_y or f_x | both & must
    """
    height, width = spectrum.shape
    limit = 1 / (2 * step)
    total = 0.0
    for i, f_y in enumerate(frequencies(height)):
        for j, f_x in enumerate(frequencies(width)):
            if abs(f_y) >= limit and abs(f_x) >= limit:
                total += abs(spectrum[i, j]) ** 2
    return total / spectrum.size ** 2


def clip_polygon(polygon, a, b, c):
    """the last edge, from the last vertex back to the first, is forgotten

    told by: last edge | closing edge | back to the first | last vertex | last to the first | wrap
    """
    kept = []
    value = polygon @ np.array([a, b]) + c
    for k in range(len(polygon)):
        if value[k] >= 0:
            kept.append(polygon[k])
        if k + 1 < len(polygon) and (value[k] >= 0) != (value[k + 1] >= 0):
            t = value[k] / (value[k] - value[k + 1])
            kept.append(polygon[k] + t * (polygon[k + 1] - polygon[k]))
    return np.array(kept).reshape(-1, 2)


def clip_polygon(polygon, a, b, c):
    """the crossing is measured from the wrong end of the edge: t and 1 - t are exchanged

    told by: wrong end | 1 - t | other end | exchanged | swapped | mirrored
    """
    kept = []
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        at_p, at_q = a * p[0] + b * p[1] + c, a * q[0] + b * q[1] + c
        if at_p >= 0:
            kept.append(p)
        if (at_p >= 0) != (at_q >= 0):
            t = abs(at_p) / (abs(at_p) + abs(at_q))
            kept.append(t * p + (1 - t) * q)
    return np.array(kept).reshape(-1, 2)


def clip_polygon(polygon, a, b, c):
    """the crossings are not added: only the vertices inside are kept

    told by: crossing & missing | crossing & not added | only the vertices | only vertices | no crossing | crossings are
    """
    inside = a * polygon[:, 0] + b * polygon[:, 1] + c >= 0
    return polygon[inside]


def polygon_area_backward(grad_area, polygon):
    """only the terms of the edge that leaves the vertex are there: those of the edge that arrives are left out

    told by: previous | arrives | only one edge | one of its two | n-1 | n - 1 | only & next
    """
    x, y = polygon[..., 0], polygon[..., 1]
    by_x = np.roll(y, -1, -1)
    by_y = -np.roll(x, -1, -1)
    return grad_area[..., None, None] * np.stack([by_x, by_y], -1) / 2


def polygon_area_backward(grad_area, polygon):
    """the y component has the wrong sign: the minus of the second product is lost

    told by: sign of y | sign of the y | y component | second component | along y | y & minus & second | sign & [..., 1]
    """
    before, after = np.roll(polygon, 1, -2), np.roll(polygon, -1, -2)
    by_x = after[..., 1] - before[..., 1]
    by_y = after[..., 0] - before[..., 0]
    return 0.5 * grad_area[..., None, None] * np.stack([by_x, by_y], -1)


def pixel_coverage_loop(triangle, width, height):
    """a clockwise triangle has a negative coverage: the area's sign is not removed

    told by: clockwise | negative | absolute | np.abs | sign of the area | winding
    """
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            part = clip_polygon(triangle, 1, 0, -j)
            part = clip_polygon(part, -1, 0, j + 1)
            part = clip_polygon(part, 0, 1, -i)
            part = clip_polygon(part, 0, -1, i + 1)
            coverage[i, j] = polygon_area(part)
    return coverage


def pixel_coverage_loop(triangle, width, height):
    """one sample at the pixel's centre decides, 0 or 1: no area is measured

    told by: 0 or 1 | one sample | 0 and 1 | fraction | binary | sample at
    """
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            sides = []
            for k in range(3):
                p, q = triangle[k], triangle[(k + 1) % 3]
                sides.append((q[0] - p[0]) * (i + 0.5 - p[1]) - (q[1] - p[1]) * (j + 0.5 - p[0]))
            if min(sides) >= 0 or max(sides) <= 0:
                coverage[i, j] = 1.0
    return coverage


def cuts(polygon, x, y):
    """the t are not sorted along the edge

    told by: sort | in order | order of | ascending | increasing | monoton
    """
    N = len(polygon)
    t = np.zeros((len(x), N, 6))
    t[..., 5] = 1
    for n in range(N):
        p, q = polygon[n], polygon[(n + 1) % N]
        for m, (axis, line) in enumerate([(0, x), (0, x + 1), (1, y), (1, y + 1)]):
            d = q[axis] - p[axis]
            t[:, n, 1 + m] = np.clip((line - p[axis]) / (d if d != 0 else 1.0), 0, 1)
    return t


def clamped_area(polygon, x, y):
    """only the polygon's vertices are clamped, without the points at the cuts

    told by: cuts | only the vertices | only vertices | crossings | vertices alone | corners alone
    """
    corner = np.stack([x, y], -1)[:, None]
    points = np.clip(polygon - corner, 0, 1)
    return polygon_area(points)


def clamped_area(polygon, x, y):
    """the sign is lost: the area of a clockwise polygon comes out positive

    told by: sign | absolute | clockwise | negative | np.abs | orientation
    """
    t = cuts(polygon, x, y)[..., None]
    p, q = polygon[:, None], np.roll(polygon, -1, axis=0)[:, None]
    corner = np.stack([x, y], -1)[:, None, None]
    points = np.clip(p + t * (q - p) - corner, 0, 1)
    return np.abs(polygon_area(points.reshape(len(x), -1, 2)))


def clamped_area_backward(grad_area, polygon, x, y):
    """the weights t and 1 - t are exchanged between the two ends of the edge

    told by: 1 - t | exchanged | swapped | ends of the edge | wrong end | other end
    """
    p = polygon[:, None]
    edge = np.roll(polygon, -1, axis=0)[:, None] - p
    corner = np.stack([x, y], -1)[:, None, None]
    t = cuts(polygon, x, y)
    t0, t1 = t[..., :-1], t[..., 1:]
    middle = p + (t0 + t1)[..., None] / 2 * edge - corner
    inside = ((middle >= 0) & (middle < 1)).all(-1)
    first = np.einsum("p,pni->n", grad_area, inside * (t1**2 - t0**2) / 2)
    second = np.einsum("p,pni->n", grad_area, inside * (t1 - t0)) - first
    normal = np.concatenate([edge[..., 1], -edge[..., 0]], -1)
    return first[:, None] * normal + np.roll(second[:, None] * normal, 1, axis=0)
