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


def sampled_spectrum(spectrum, step):
    """neighbouring entries are added in blocks instead of entries that lie N/s apart

    told by: neighbour | adjacent | N/s | apart | block | consecutive | H / step
    """
    h, w = spectrum.shape
    groups = spectrum.reshape(h // step, step, w // step, step)
    return groups.mean(axis=(1, 3))


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
