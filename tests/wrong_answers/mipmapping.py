"""Wrong answers to mipmapping, written without a look at the checks."""


def halve(image):
    """one texel of each 2 x 2 is taken instead of their mean

    told by: one texel | every second | no mean | first texel | instead of their mean | not averaged | one of the
    """
    return image[::2, ::2].copy()


def halve(image):
    """the sum of the 2 x 2 texels is halved, not divided by 4

    told by: by 4 | halved | twice as | too bright | divided by 2 | factor 2
    """
    if image.shape[0] == 1:
        return (image[:, 0::2] + image[:, 1::2]) / 2
    if image.shape[1] == 1:
        return (image[0::2] + image[1::2]) / 2
    return (image[0::2, 0::2] + image[1::2, 0::2] + image[0::2, 1::2] + image[1::2, 1::2]) / 2


def halve(image):
    """far texels are averaged, as each side is split into (2, h / 2) instead of (h / 2, 2)

    told by: far | reshape | split | upper and lower half | not neighbours | h / 2 apart | neighbour
    """
    h, w, c = image.shape
    rows, columns = min(h, 2), min(w, 2)
    return image.reshape(rows, h // rows, columns, w // columns, c).mean(axis=(0, 2))


def halve(image):
    """a side of 1 is filled up with zeros, so the mean of two texels comes out half as large (fine print)

    told by: side of 1 | zeros | half as large | two texels | one row | padd
    """
    h, w, c = image.shape
    padded = np.zeros((h + h % 2, w + w % 2, c))
    padded[:h, :w] = image
    return padded.reshape((h + 1) // 2, 2, (w + 1) // 2, 2, c).mean((1, 3))


def halve_backward(grad_half, image):
    """each texel gets the whole gradient instead of its fourth part

    told by: by 4 | fourth | whole gradient | full gradient | quarter | divided | four times
    """
    h, w, _ = image.shape
    grad = np.zeros(image.shape)
    for i in range(h):
        for j in range(w):
            grad[i, j] = grad_half[min(i // 2, len(grad_half) - 1), j // 2 if w > 1 else 0]
    return grad


def halve_backward(grad_half, image):
    """it is always divided by 4, also where the mean is of two texels, as a side is 1 (fine print)

    told by: always & by 4 | side of 1 | two texels | side is 1 | one row
    """
    rows = image.shape[0] // grad_half.shape[0]
    columns = image.shape[1] // grad_half.shape[1]
    return np.kron(grad_half, np.ones((rows, columns, 1))) / 4


def pyramid_backward(grad_levels):
    """each level's gradient goes to the image undivided: only repeated, never divided by 4

    told by: by 4 | undivided | only repeated | not divided | four times | 4 times | halve_backward
    """
    grad = grad_levels[-1]
    for level in reversed(grad_levels[:-1]):
        rows = level.shape[0] // grad.shape[0]
        columns = level.shape[1] // grad.shape[1]
        grad = level + grad.repeat(rows, 0).repeat(columns, 1)
    return grad


def pyramid_backward(grad_levels):
    """only levels 0 and 1 reach the image, the higher levels hand nothing down

    told by: levels 0 and 1 | higher level | only & level 1 | hand & down | other levels | upper levels | level 2
    """
    grad = grad_levels[0].copy()
    if len(grad_levels) > 1:
        grad += halve_backward(grad_levels[1], grad)
    return grad


def pyramid_backward(grad_levels):
    """the gradient of level 0 itself is left out

    told by: level 0 & left out | own gradient | level 0 itself | image's own | level 0 & missing | level 0 & forgotten | T_0
    """
    grad = grad_levels[-1]
    for n in range(len(grad_levels) - 2, -1, -1):
        grad = halve_backward(grad, grad_levels[n])
        if n > 0:
            grad = grad + grad_levels[n]
    return grad


def mip_level(jacobian, width, height):
    """the factor 1/2 is left out: S + R is the square of the singular value

    told by: 1/2 | half | square root | twice | square of the | factor 2 | squared
    """
    J = jacobian * np.array([[width], [height]])
    A, B = (J ** 2).sum(1).T
    C = J[:, 0, 0] * J[:, 0, 1] + J[:, 1, 0] * J[:, 1, 1]
    with np.errstate(divide="ignore"):
        return np.log2((A + B) / 2 + np.sqrt((A - B) ** 2 / 4 + C ** 2))


def mip_level(jacobian, width, height):
    """the natural logarithm is taken instead of the one to base 2

    told by: natural | base 2 | log2 | np.log | base e
    """
    scaled = np.stack([jacobian[:, 0] * width, jacobian[:, 1] * height], 1)
    out = np.empty(len(jacobian))
    for n, J in enumerate(scaled):
        largest = np.linalg.svd(J, compute_uv=False)[0]
        with np.errstate(divide="ignore"):
            out[n] = np.log(largest)
    return out


def mip_level(jacobian, width, height):
    """the smallest singular value is taken: S - R instead of S + R

    told by: smallest | S - R | smaller singular | lesser | minus R | shortest
    """
    J = jacobian * [[width], [height]]
    with np.errstate(divide="ignore"):
        return np.log2(np.linalg.svd(J, compute_uv=False)[:, -1])


def mip_level_backward(grad_level, jacobian, width, height):
    """ln 2 is left out: log2 is differentiated like ln

    told by: ln 2 | natural | log2 | log(2) | ln(2) | base 2
    """
    scale = np.array([[width], [height]])
    (s_x, s_y), (t_x, t_y) = np.moveaxis(jacobian * scale, 0, -1)
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    S, R = (A + B) / 2, np.sqrt((A - B)**2 / 4 + C**2)
    g = grad_level / (2 * np.where(S > 0, S + R, np.inf))
    safe = np.where(R > 0, R, np.inf)
    gA, gB, gC = g * (0.5 + (A - B) / (4 * safe)), g * (0.5 - (A - B) / (4 * safe)), g * C / safe
    out = np.array([[2 * gA * s_x + gC * s_y, 2 * gB * s_y + gC * s_x],
                    [2 * gA * t_x + gC * t_y, 2 * gB * t_y + gC * t_x]])
    return np.moveaxis(out, -1, 0) * scale


def mip_level_backward(grad_level, jacobian, width, height):
    """the chain rule's last factor is left out: the gradient is that of J in texels, not times width and height

    told by: in texels | times width | chain rule | by width | width and height | last factor
    """
    J = jacobian * [[width], [height]]
    s_x, s_y, t_x, t_y = J.reshape(-1, 4).T
    A, B = s_x**2 + t_x**2, s_y**2 + t_y**2
    C = s_x * s_y + t_x * t_y
    S = (A + B) / 2
    R = np.hypot((A - B) / 2, C)
    g = grad_level / (2 * np.log(2) * np.where(S > 0, S + R, np.inf))
    safe = np.where(R > 0, R, np.inf)
    gA, gB, gC = g / 2 + g * (A - B) / (4 * safe), g / 2 - g * (A - B) / (4 * safe), g * C / safe
    return np.stack([2 * gA * s_x + gC * s_y, 2 * gB * s_y + gC * s_x,
                     2 * gA * t_x + gC * t_y, 2 * gB * t_y + gC * t_x], -1).reshape(-1, 2, 2)


def blend_levels(level, top):
    """upper may be top + 1, a level that does not exist

    told by: top + 1 | does not exist | upper & top | at most top | beyond the
    """
    level = np.clip(level, 0, top)
    lower = np.floor(level).astype(int)
    return lower, lower + 1, level - lower


def blend_levels(level, top):
    """the level is rounded to the nearest instead of down, so f can be negative

    told by: rounded | rounding | nearest | floor | instead of down | fraction & negative
    """
    clamped = np.minimum(np.maximum(level, 0), top)
    lower = np.rint(clamped).astype(int)
    upper = np.minimum(lower + 1, top)
    return lower, upper, clamped - lower


def blend_levels(level, top):
    """lower and upper are numbers with a point, not integers, and cannot be used as an index

    told by: integer | float | dtype | astype | index & cannot
    """
    level = np.clip(level, 0, top)
    lower = np.floor(level)
    upper = np.minimum(lower + 1, top)
    return lower, upper, level - lower


def blend_levels(level, top):
    """at the top the lower level is top - 1 with fraction 1, instead of top with fraction 0 (fine print)

    told by: top - 1 | at the top | fraction 1 | f = 1 | last level | last two
    """
    level = np.clip(level, 0, top)
    lower = np.minimum(np.floor(level).astype(int), max(top - 1, 0))
    upper = np.minimum(lower + 1, top)
    return lower, upper, level - lower


def blend_levels(level, top):
    """only the upper end is clamped, a negative level stays negative

    told by: negative | below 0 | lower end | less than 0 | clamped to 0 | smaller than 0
    """
    level = np.maximum(np.minimum(level, top), -2**20)
    lower = np.floor(level).astype(int)
    return lower, np.minimum(lower + 1, top), level - lower
