"""Wrong answers to mipmapping, written without a look at the checks."""


def halve(image):
    """every second texel is kept, nothing is averaged

    told by: every second | each second | every other | averag | one texel of | ::2 | subsampl
    """
    rows = image[::2] if len(image) > 1 else image
    return rows[:, ::2].copy() if image.shape[1] > 1 else rows.copy()


def halve(image):
    """the sum of the four texels is divided by 2 instead of 4

    told by: divided by 2 | twice | factor 2 | divided by 4 | 1/4 | factor of 2 | double
    """
    height, width, channels = image.shape
    a, b = min(height, 2), min(width, 2)
    cut = image.reshape(height // a, a, width // b, b, channels)
    return cut.sum((1, 3)) / max(1, a * b // 2)


def halve(image):
    """texels half a picture apart are averaged instead of neighbours

    told by: neighbour | half a picture | halves | far apart | adjacent | next to each other
    """
    height, width, channels = image.shape
    rows, columns = min(2, height), min(2, width)
    folded = image.reshape(rows, height // rows, columns, width // columns, channels)
    return folded.mean((0, 2))


def halve_backward(grad_half, image):
    """the gradient is copied to the four texels without the 1/4 of the mean

    told by: 1/4 | 1 / 4 | divided by 4 | four times | factor 4 | quarter | factor of 4
    """
    height, width = image.shape[:2]
    grad = np.empty(image.shape)
    for i in range(height):
        for j in range(width):
            grad[i, j] = grad_half[i * len(grad_half) // height, j * grad_half.shape[1] // width]
    return grad


def pyramid_backward(grad_levels):
    """only level 1 is handed down, the gradients of level 2 and above are lost

    told by: level 2 | above level 1 | higher level | only level 1 | all the way | coarse | one step
    """
    grad = grad_levels[0].copy()
    if len(grad_levels) > 1:
        grad += halve_backward(grad_levels[1], grad)
    return grad


def mip_level(jacobian, width, height):
    """J is scaled by columns: width goes to the x derivatives and height to the y derivatives, instead of u and v

    told by: columns | width & height & exchanged | width & height & swapped | x derivatives | not square | u & width & v & height
    """
    in_texels = jacobian * np.array([width, height])
    sx, sy, tx, ty = (in_texels[:, i, j] for i in (0, 1) for j in (0, 1))
    A, B, C = sx**2 + tx**2, sy**2 + ty**2, sx * sy + tx * ty
    with np.errstate(divide="ignore"):
        return 0.5 * np.log2((A + B) / 2 + np.sqrt((A - B)**2 / 4 + C**2))


def mip_level(jacobian, width, height):
    """the longer of the two steps, in x and in y, as OpenGL has it, instead of the greatest singular value

    told by: singular | longer | max(A, B | greater of | larger of | OpenGL | without C
    """
    level = np.empty(len(jacobian))
    for n, J in enumerate(jacobian):
        J = np.array([[width], [height]]) * J
        with np.errstate(divide="ignore"):
            level[n] = np.log2(max(np.hypot(J[0, 0], J[1, 0]), np.hypot(J[0, 1], J[1, 1])))
    return level


def mip_level(jacobian, width, height):
    """log2 of S + R without the 1/2: S + R is the square of the singular value

    told by: 1/2 | half | twice | square of | squared | double | factor of 2
    """
    texels = jacobian * [[width], [height]]
    A, B = (texels**2).sum(1).T
    C = texels.prod(-1).sum(-1)
    with np.errstate(divide="ignore"):
        return np.log2((A + B) / 2 + np.sqrt(((A - B) / 2)**2 + C**2))


def mip_level_backward(grad_level, jacobian, width, height):
    """the factors w and h from J in texels to J in u and v are missing in the result

    told by: width | in texels | w and h | chain rule | times w | size of the texture
    """
    s_x, s_y, t_x, t_y = (jacobian * [[width], [height]]).reshape(-1, 4).T
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    S, D = (A + B) / 2, (A - B) / 2
    R = np.hypot(D, C)
    safe = np.where(R > 0, R, np.inf)
    outer = grad_level / (2 * np.log(2) * np.where(S > 0, S + R, np.inf))
    by_A = outer * (1 + D / safe) / 2
    by_B = outer * (1 - D / safe) / 2
    by_C = outer * C / safe
    x = [2 * by_A * s + by_C * s2 for s, s2 in ((s_x, s_y), (t_x, t_y))]
    y = [2 * by_B * s + by_C * s2 for s, s2 in ((s_y, s_x), (t_y, t_x))]
    return np.stack([np.stack(x, -1), np.stack(y, -1)], -1)


def blend_levels(level, top):
    """the level is rounded to the nearest instead of down

    told by: round | nearest | floor | negative fraction | fraction & negative | fraction & below 0
    """
    level = np.clip(level, 0, top)
    lower = np.rint(level).astype(int)
    return lower, np.minimum(lower + 1, top), level - lower


def blend_levels(level, top):
    """the fraction belongs to the wrong one of the levels: 1 - f, the share of lower, is returned instead of f

    told by: 1 - f | share of lower | share of the lower | exchanged | swapped | weight of the lower | reversed
    """
    lower, upper, fraction = [], [], []
    for value in np.clip(level, 0, top):
        below = int(value)
        lower.append(below)
        upper.append(min(below + 1, top))
        fraction.append(1 - (value - below))
    return np.array(lower), np.array(upper), np.array(fraction)


def blend_levels(level, top):
    """top is taken for the number of levels: clamped to top - 1, the last level is never reached

    told by: top - 1 | number of levels | last level | never reach | coarsest | off by one
    """
    level = np.clip(level, 0, top - 1)
    lower = np.floor(level).astype(int)
    upper = np.minimum(lower + 1, top - 1)
    return lower, upper, level - lower


def halve(image):
    """a side of 1 is halved to 0, so nothing is left of it (fine print)

    told by: side of 1 | one row | side 1 | single row | height of 1 | not square
    """
    h, w, c = image.shape
    return image[:h // 2 * 2, :w // 2 * 2].reshape(h // 2, 2, w // 2, 2, c).mean((1, 3))


def halve(image):
    """the greatest of the 2 x 2 texels is taken instead of their mean

    told by: max | greatest | largest | brightest
    """
    h, w, c = image.shape
    rows, columns = min(h, 2), min(w, 2)
    out = np.empty((h // rows, w // columns, c))
    for i in range(h // rows):
        for j in range(w // columns):
            out[i, j] = image[rows * i:rows * i + rows, columns * j:columns * j + columns].max((0, 1))
    return out


def halve(image):
    """the texels are averaged in linear light, with a gamma of 2.2, instead of as they are

    told by: gamma | linear light | sRGB | 2.2 | power
    """
    h, w, c = image.shape
    rows, columns = np.minimum((h, w), 2)
    light = image ** 2.2
    return light.reshape(h // rows, rows, w // columns, columns, c).mean((1, 3)) ** (1 / 2.2)


def mip_level(jacobian, width, height):
    """J is not brought into texels: width and height are not used

    told by: in texels | into texels | width and height & not used | width and height & ignored | not multiplied | to texels
    """
    with np.errstate(divide="ignore"):
        return np.log2(np.linalg.norm(jacobian, 2, axis=(1, 2)))


def mip_level(jacobian, width, height):
    """the longer of the two columns is taken, as OpenGL does it, instead of the greatest singular value

    told by: OpenGL | longer & column | singular value | longer of | length of & column | max(A, B) | C is left out
    """
    J = jacobian * np.array([width, height])[:, None]
    A = J[:, 0, 0] ** 2 + J[:, 1, 0] ** 2
    B = J[:, 0, 1] ** 2 + J[:, 1, 1] ** 2
    with np.errstate(divide="ignore"):
        return 0.5 * np.log2(np.maximum(A, B))


def mip_level(jacobian, width, height):
    """width and height multiply the columns of J instead of its rows: x by width and y by height

    told by: columns | x by width | rows of J | instead of its rows | rows instead | transpos | x and y
    """
    s_x, s_y, t_x, t_y = (jacobian * [width, height]).reshape(-1, 4).T
    A = s_x ** 2 + t_x ** 2
    B = s_y ** 2 + t_y ** 2
    C = s_x * s_y + t_x * t_y
    with np.errstate(divide="ignore"):
        return np.log2((A + B) / 2 + np.sqrt((A - B) ** 2 / 4 + C ** 2)) / 2


def mip_level(jacobian, width, height):
    """a negative level is already raised to 0 here, also -inf of J = 0 (fine print)

    told by: clamp | -inf | negative level | raised to 0 | below 0 | clip
    """
    s = jacobian[:, 0] * width
    t = jacobian[:, 1] * height
    A, B = (s ** 2 + t ** 2).T
    C = s[:, 0] * s[:, 1] + t[:, 0] * t[:, 1]
    rho2 = (A + B) / 2 + np.sqrt((A - B) ** 2 / 4 + C ** 2)
    return 0.5 * np.log2(np.maximum(rho2, 1.0))


def mip_level_backward(grad_level, jacobian, width, height):
    """nothing guards the division by R: where R = 0 or J = 0 the gradient is not a number (fine print)

    told by: R = 0 | J = 0 | nan | divi & by 0 | divi & by zero | not a number
    """
    scale = np.array([[width], [height]])
    (s_x, s_y), (t_x, t_y) = np.moveaxis(jacobian * scale, 0, -1)
    A, B, C = s_x**2 + t_x**2, s_y**2 + t_y**2, s_x * s_y + t_x * t_y
    R = np.sqrt((A - B)**2 / 4 + C**2)
    g = grad_level / (2 * np.log(2) * ((A + B) / 2 + R))
    gA, gB, gC = g * (0.5 + (A - B) / (4 * R)), g * (0.5 - (A - B) / (4 * R)), g * C / R
    out = np.array([[2 * gA * s_x + gC * s_y, 2 * gB * s_y + gC * s_x],
                    [2 * gA * t_x + gC * t_y, 2 * gB * t_y + gC * t_x]])
    return np.moveaxis(out, -1, 0) * scale


def blend_levels(level, top):
    """the fraction is computed from the level before it is clamped

    told by: fraction & clamp | before & clamp | unclamped | not clamped | fraction & outside | more than 1
    """
    inside = np.clip(level, 0, top)
    lower = np.floor(inside).astype(int)
    upper = np.minimum(lower + 1, top)
    return lower, upper, level - np.floor(np.where(np.isfinite(level), level, 0))


def blend_levels(level, top):
    """the fraction is 1 - f: it is the share of the lower level

    told by: 1 - f | share of & lower | reversed | upper - level | exchanged | swapped | other way round
    """
    n = len(level)
    lower, upper, fraction = np.zeros(n, int), np.zeros(n, int), np.zeros(n)
    for k in range(n):
        l = min(max(level[k], 0), top)
        lower[k] = int(l)
        upper[k] = min(lower[k] + 1, top)
        fraction[k] = lower[k] + 1 - l
    return lower, upper, fraction


def blend_levels(level, top):
    """upper is the level rounded up, so on a whole level it is lower itself and not the next (fine print)

    told by: rounded up | ceil | whole level | whole number | lower itself | next level | upper & lower
    """
    level = np.clip(level, 0, top)
    lower = np.floor(level).astype(int)
    upper = np.ceil(level).astype(int)
    return lower, upper, level - lower


def blend_levels(level, top):
    """the given levels themselves are clamped: the input is changed in place

    told by: in place | input & chang | copy | itself is changed | argument & chang | modif
    """
    np.clip(level, 0, top, out=level)
    lower = np.floor(level).astype(int)
    return lower, np.minimum(lower + 1, top), level - lower
