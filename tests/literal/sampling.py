"""Lab 3 as printed: what one types who has read the questions and the equations."""


def alias_frequency(frequency, rate):
    return frequency - rate * np.round(frequency / rate)


def dft_matrix(n):
    D = np.zeros((n, n), complex)
    for k in range(n):
        for m in range(n):
            D[k, m] = np.exp(-2j * np.pi * k * m / n)
    return D


def convolve(picture, kernel):
    height, width = picture.shape
    h, w = kernel.shape
    result = np.zeros(picture.shape)
    for y in range(height):
        for x in range(width):
            for i in range(h):
                for j in range(w):
                    m_y, m_x = (y - (i - h // 2)) % height, (x - (j - w // 2)) % width
                    result[y, x] += picture[m_y, m_x] * kernel[i, j]
    return result


def sampled_spectrum(spectrum, step):
    h, w = spectrum.shape[0] // step, spectrum.shape[1] // step
    total = np.zeros((h, w), complex)
    for m in range(step):
        for n in range(step):
            total += spectrum[m * h:(m + 1) * h, n * w:(n + 1) * w]
    return total / step**2


def clip_polygon(polygon, a, b, c):
    points = []
    for n in range(len(polygon)):
        p, q = polygon[n], polygon[(n + 1) % len(polygon)]
        at_p, at_q = a * p[0] + b * p[1] + c, a * q[0] + b * q[1] + c
        if at_p >= 0:
            points.append(p)
        if at_p * at_q < 0:
            points.append(p + at_p / (at_p - at_q) * (q - p))
    return np.array(points).reshape(-1, 2)


def pixel_coverage_loop(triangle, width, height):
    coverage = np.zeros((height, width))
    for i in range(height):
        for j in range(width):
            part = clip_polygon(triangle, 1, 0, -j)
            part = clip_polygon(part, -1, 0, j + 1)
            part = clip_polygon(part, 0, 1, -i)
            part = clip_polygon(part, 0, -1, i + 1)
            coverage[i, j] = abs(polygon_area(part))
    return coverage
