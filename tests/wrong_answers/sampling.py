"""Wrong answers to sampling, written without a look at the checks."""


def alias_frequency(frequency, rate):
    """the remainder lies between 0 and r, not between -r/2 and r/2, so nothing seems to turn backwards

    told by: 0 to r | between 0 and | modulo | remainder | never negative | backwards
    """
    return frequency % rate


def alias_frequency(frequency, rate):
    """the sign is lost: the absolute value of the alias is returned

    told by: absolute | sign | magnitude | never negative | backwards | np.abs
    """
    folded = frequency - rate * np.floor(frequency / rate + 0.5)
    return np.abs(folded)


def alias_frequency(frequency, rate):
    """folds at the rate instead of at half the rate: the range is -r to r

    told by: half the rate | -r to r | twice the range | 2 * rate | rate instead of half | nyquist
    """
    out = np.empty(frequency.shape)
    for k, f in np.ndenumerate(frequency):
        out[k] = (f + rate) % (2 * rate) - rate
    return out


def dft_matrix(n):
    """the exponent has a plus: this is the matrix of the inverse transform, the conjugate

    told by: sign | conjugate | inverse | exponent & plus | +2 | minus
    """
    k = np.arange(n)
    return np.exp(2j * np.pi * np.outer(k, k) / n)


def dft_matrix(n):
    """divided by n, as if it were the mean of the samples

    told by: 1/n | by n | / n | normali | factor n | factor of n
    """
    k = np.arange(n)
    return np.exp(-2j * np.pi * np.outer(k, k) / n) / n


def dft_matrix(n):
    """the unitary transform: divided by the square root of n

    told by: sqrt | square root | unitary | orthonormal | normali
    """
    D = np.empty((n, n), complex)
    for k in range(n):
        for m in range(n):
            D[k, m] = np.exp(-2j * np.pi * k * m / n) / np.sqrt(n)
    return D


def dft_matrix(n):
    """k and n count from 1, not from 0, so that the first row is not constant

    told by: from 1 | starts at | off by one | first row | k = 0 | count from
    """
    k = np.arange(1, n + 1)
    return np.exp(-2j * np.pi * np.outer(k, k) / n)


def band_pass(picture, low, high):
    """all frequencies count as positive, from 0 to 1: those above 1/2 are not folded to negative ones

    told by: negative freq | 0 to 1 | fold | above 1/2 | fftfreq | conjugate
    """
    height, width = picture.shape
    fy = np.arange(height) / height
    fx = np.arange(width) / width
    length = np.sqrt(fy[:, None] ** 2 + fx ** 2)
    return picture_of(spectrum_of(picture) * ((low <= length) & (length < high)))


def band_pass(picture, low, high):
    """the greater of |f_y| and |f_x| is compared instead of the length: a square instead of a disc

    told by: square instead | maximum | greater of | hypot | euclid | circle
    """
    height, width = picture.shape
    f = np.maximum(np.abs(frequencies(height))[:, None], np.abs(frequencies(width)))
    keep = (f >= low) & (f < high)
    return picture_of(np.where(keep, spectrum_of(picture), 0))


def convolve(picture, kernel):
    """zeros stand beyond the border, they should go round

    told by: zero & border | zeros beyond | zero padding | circular | wrap | go round
    """
    H, W = picture.shape
    h, w = kernel.shape
    padded = np.zeros((H + h - 1, W + w - 1))
    padded[h // 2:h // 2 + H, w // 2:w // 2 + W] = picture
    flipped = kernel[::-1, ::-1]
    result = np.zeros((H, W))
    for i in range(h):
        for j in range(w):
            result += flipped[i, j] * padded[i:i + H, j:j + W]
    return result


def convolve(picture, kernel):
    """for a kernel larger than the picture, entries that land on the same pixel overwrite each other instead of adding up (fine print)

    told by: larger than the picture | overwrit | same pixel | more than once | kernel is larger | twice round
    """
    H, W = picture.shape
    h, w = kernel.shape
    placed = np.zeros((H, W))
    rows = (np.arange(h) - h // 2) % H
    cols = (np.arange(w) - w // 2) % W
    placed[np.ix_(rows, cols)] = kernel
    return picture_of(spectrum_of(picture) * spectrum_of(placed))


def convolve_by_spectrum(picture, kernel):
    """the kernel's spectrum is conjugated, which makes it a correlation

    told by: conj | correlation | flip | mirrored | reversed | n + m
    """
    height, width = picture.shape
    h, w = kernel.shape
    padded = np.pad(kernel, ((0, height - h), (0, width - w)))
    centred = np.roll(padded, (-(h // 2), -(w // 2)), (0, 1))
    return picture_of(spectrum_of(picture) * np.conj(spectrum_of(centred)))


def box_spectrum(width, n):
    """the continuous sinc: pi k/N stands below where sin(pi k/N) should, so the box is not a sampled one

    told by: continuous | np.sinc | periodic | denominator & sin | dirichlet | sampled box
    """
    return np.sinc(width * np.arange(n) / n)


def box_spectrum(width, n):
    """not divided by the width: the box is 1 and not 1 / width

    told by: width times | divided by width | divided by the width | factor width | factor of width | sum of the box
    """
    result = np.ones(n)
    for k in range(1, n):
        result[k] = np.sin(np.pi * width * k / n) / np.sin(np.pi * k / n)
    return result


def sampled_spectrum(spectrum, step):
    """neighbouring entries are added up, instead of those N/s apart

    told by: neighbour | neighbor | adjacent | consecutive | n/s apart | n / s
    """
    H, W = spectrum.shape
    blocks = spectrum.reshape(H // step, step, W // step, step)
    return blocks.sum((1, 3)) / step**2


def sampled_spectrum(spectrum, step):
    """only the copy m = 0 is kept: the others, the aliases, are not added

    told by: copies | m = 0 | first block | aliases | cropped | cut off
    """
    H, W = spectrum.shape
    return spectrum[:H // step, :W // step] / step**2


def sampled_spectrum(spectrum, step):
    """the spectrum itself is sampled: every step-th entry is taken

    told by: every step-th | ::step | every s-th | spectrum itself | like the picture | as the picture
    """
    return spectrum[::step, ::step]


def sampled_spectrum(spectrum, step):
    """the imaginary part is lost: the sums go into an array of real numbers

    told by: imaginary | real part | real number | complex | real array | float array
    """
    H, W = spectrum.shape
    h, w = H // step, W // step
    out = np.zeros((h, w))
    for m in range(step):
        for n in range(step):
            out += spectrum[m * h:(m + 1) * h, n * w:(n + 1) * w].real
    return out / (step * step)


def folded_energy(spectrum, step):
    """divided by H W only once: this is the sum of squares over the pixels and not their mean

    told by: not the mean | not their mean | mean & sum | size**2 | number of pixels | only once
    """
    height, width = spectrum.shape
    f_y, f_x = np.abs(frequencies(height))[:, None], np.abs(frequencies(width))
    fast = (f_y >= 0.5 / step) | (f_x >= 0.5 / step)
    return (np.abs(spectrum) ** 2 * fast).sum() / (height * width)


def clip_polygon(polygon, a, b, c):
    """the other part is kept, where a x + b y + c <= 0

    told by: other part | other side | wrong side | wrong half | <= 0 | outside part
    """
    out = []
    for k in range(len(polygon)):
        p, q = polygon[k], polygon[(k + 1) % len(polygon)]
        dp = a * p[0] + b * p[1] + c
        dq = a * q[0] + b * q[1] + c
        if dp <= 0:
            out.append(p)
        if (dp <= 0) != (dq <= 0):
            out.append(p + (q - p) * (dp / (dp - dq)))
    return np.array(out).reshape(-1, 2)


def clip_polygon(polygon, a, b, c):
    """a crossing is added only where the polygon leaves the half-plane, not where it comes back in

    told by: leaves the | leaving | entering | enters | comes back | one crossing
    """
    kept = []
    N = len(polygon)
    for n in range(N):
        p, q = polygon[n], polygon[(n + 1) % N]
        at_p = a * p[0] + b * p[1] + c
        at_q = a * q[0] + b * q[1] + c
        if at_p >= 0:
            kept.append(p)
            if at_q < 0:
                kept.append(p + at_p / (at_p - at_q) * (q - p))
    return np.array(kept).reshape(-1, 2)


def polygon_area_backward(grad_area, polygon):
    """the factor 1/2 of the shoelace formula is forgotten

    told by: 1/2 | half | factor 2 | factor of 2 | twice | 0.5
    """
    x, y = polygon[..., 0], polygon[..., 1]
    g = grad_area[..., None]
    return np.stack([g * (np.roll(y, -1, -1) - np.roll(y, 1, -1)),
                     g * (np.roll(x, 1, -1) - np.roll(x, -1, -1))], -1)


def polygon_area_backward(grad_area, polygon):
    """next and previous vertex are exchanged, which flips the sign of everything

    told by: wrong sign | opposite sign | next and previous | previous and next | exchanged | swapped
    """
    N = polygon.shape[-2]
    grad = np.zeros(polygon.shape)
    for n in range(N):
        after, before = polygon[..., (n + 1) % N, :], polygon[..., n - 1, :]
        grad[..., n, 0] = grad_area * (before[..., 1] - after[..., 1]) / 2
        grad[..., n, 1] = grad_area * (after[..., 0] - before[..., 0]) / 2
    return grad


def polygon_area_backward(grad_area, polygon):
    """the gradients with respect to x and y are stored in exchanged columns

    told by: x and y | columns & exchanged | columns & swapped | components & exchanged | components & swapped | y and x
    """
    x, y = polygon[..., 0], polygon[..., 1]
    by_x = np.roll(y, -1, -1) - np.roll(y, 1, -1)
    by_y = np.roll(x, 1, -1) - np.roll(x, -1, -1)
    return grad_area[..., None, None] / 2 * np.stack((by_y, by_x), -1)


def pixel_coverage_loop(triangle, width, height):
    """rows and columns are exchanged: the row is taken as x and the column as y

    told by: rows and columns | row and column | transpos | x and y | i and j | exchanged
    """
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            part = triangle
            for line in [(1, 0, -i), (-1, 0, i + 1), (0, 1, -j), (0, -1, j + 1)]:
                part = clip_polygon(part, *line)
            coverage[i, j] = abs(polygon_area(part))
    return coverage


def pixel_coverage_loop(triangle, width, height):
    """the pixels lie half a pixel too low and too far left: their centres are at whole numbers

    told by: half a pixel | half pixel | 0.5 | centre | center | whole numbers
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
    """row 0 is the top row of the screen, so the picture is upside down

    told by: upside down | y up | y down | top row | flipped | bottom
    """
    coverage = np.zeros((height, width))
    for row in range(height):
        bottom = height - 1 - row
        for j in range(width):
            part = triangle
            for a, b, c in (1, 0, -j), (-1, 0, j + 1), (0, 1, -bottom), (0, -1, bottom + 1):
                part = clip_polygon(part, a, b, c)
            coverage[row, j] = abs(polygon_area(part))
    return coverage


def cuts(polygon, x, y):
    """t is not limited to 0 .. 1: crossings beyond the ends of the edge are kept

    told by: beyond | clip | clamp | outside [0, 1] | less than 0 | greater than 1
    """
    p, q = polygon[:, None], np.roll(polygon, -1, axis=0)[:, None]
    sides = np.stack([[x, y], [x + 1, y + 1]]).transpose(2, 0, 1)
    across = np.where(p == q, 1.0, q - p)
    t = (sides[:, None] - p) / across
    t = np.pad(t.reshape(*t.shape[:2], 4), ((0, 0), (0, 0), (1, 1)), constant_values=(0, 1))
    return np.sort(t)


def clamped_area_backward(grad_area, polygon, x, y):
    """the edge's normal is made a unit vector, and the factor |q - p| is lost

    told by: length of the edge | edge's length | unit | normali | factor & length | q - p
    """
    N = len(polygon)
    grad = np.zeros((N, 2))
    t = cuts(polygon, x, y)
    for n in range(N):
        m = (n + 1) % N
        e = polygon[m] - polygon[n]
        normal = np.array([e[1], -e[0]]) / np.hypot(e[0], e[1])
        for s in range(len(x)):
            for k in range(5):
                t0, t1 = t[s, n, k], t[s, n, k + 1]
                mid = polygon[n] + (t0 + t1) / 2 * e
                if x[s] <= mid[0] < x[s] + 1 and y[s] <= mid[1] < y[s] + 1:
                    to_q = (t1 ** 2 - t0 ** 2) / 2
                    grad[m] += grad_area[s] * to_q * normal
                    grad[n] += grad_area[s] * (t1 - t0 - to_q) * normal
    return grad
