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
    """sums the 2 x 2 texels instead of their mean: four times too large

    told by: sum & mean | four times | factor 4 | factor of 4 | / 4 | 1/4 | divide & 4 | not a mean | quarter | instead of averaged
    """
    h, w, channels = image.shape
    rows, columns = min(h, 2), min(w, 2)
    blocks = image.reshape(h // rows, rows, w // columns, columns, channels)
    return blocks.sum(axis=(1, 3))


def halve(image):
    """every second texel is taken, the first one of each 2 x 2, instead of the mean

    told by: every second | every other | upper left | top left | first of | one of the four | one texel & 2 x 2 | subsampl | decimat | one & four & texel
    """
    down = 1 if image.shape[0] == 1 else 2
    right = 1 if image.shape[1] == 1 else 2
    return image[::down, ::right].copy()


def halve_backward(grad_half, image):
    """the quarter is missing: each texel gets the whole gradient of the mean

    told by: quarter | four times | factor 4 | factor of 4 | / 4 | 1/4 | divide & 4 | whole gradient | sum & mean
    """
    rows, columns = (1 if side == 1 else 2 for side in image.shape[:2])
    return np.kron(grad_half, np.ones((rows, columns, 1)))


def mip_level(jacobian, width, height):
    """the 1/2 before log2 is missing: log2 of the squared length, twice the level

    told by: twice | 1/2 | half | factor 2 | factor of 2 | squared | square root | sqrt & log2 | doubled | 0.5
    """
    s = width * jacobian[:, 0]
    t = height * jacobian[:, 1]
    A = s[:, 0]**2 + t[:, 0]**2
    B = s[:, 1]**2 + t[:, 1]**2
    C = s[:, 0] * s[:, 1] + t[:, 0] * t[:, 1]
    with np.errstate(divide="ignore"):
        return np.log2((A + B) / 2 + np.sqrt(((A - B) / 2)**2 + C**2))


def mip_level(jacobian, width, height):
    """OpenGL's level: the longer one of the columns (max of A and B), not the greatest singular value

    told by: singular value | longer column | max(A, B) | opengl | longer of | greater of A and B | C & left out | C & missing | C & ignored | longest column | without C
    """
    levels = []
    for J in jacobian:
        A = (width * J[0, 0])**2 + (height * J[1, 0])**2
        B = (width * J[0, 1])**2 + (height * J[1, 1])**2
        with np.errstate(divide="ignore"):
            levels.append(np.log2(max(A, B)) / 2)
    return np.array(levels)


def mip_level_backward(grad_level, jacobian, width, height):
    """the last factor is missing: the gradient is for J in texels, without width and height

    told by: in texels | width & height & missing | width & height & left out | factor & width | times width | multipl & width | w and h | rows & scaled
    """
    s_x, s_y, t_x, t_y = (jacobian * [[width], [height]]).reshape(-1, 4).T
    A, B = s_x**2 + t_x**2, s_y**2 + t_y**2
    C = s_x * s_y + t_x * t_y
    R = np.sqrt((A - B)**2 / 4 + C**2)
    R_safe = np.where(R > 0, R, np.inf)
    S = (A + B) / 2
    g = grad_level / (2 * np.log(2) * np.where(S > 0, S + R, np.inf))
    by_A = g * (0.5 + (A - B) / (4 * R_safe))
    by_B = g * (0.5 - (A - B) / (4 * R_safe))
    by_C = g * C / R_safe
    first = np.stack([2 * by_A * s_x + by_C * s_y, 2 * by_B * s_y + by_C * s_x], -1)
    second = np.stack([2 * by_A * t_x + by_C * t_y, 2 * by_B * t_y + by_C * t_x], -1)
    return np.stack([first, second], 1)


def blend_levels(level, top):
    """the fraction is computed before the clamp: level below 0 or above top have a fraction outside

    told by: before & clamp | clamp & fraction | not clamped | unclamped | clamped too late | clip & fraction | fraction & outside
    """
    lower = np.floor(np.clip(level, 0, top)).astype(int)
    upper = np.minimum(lower + 1, top)
    raw = np.maximum(level, -1e3)
    return lower, upper, raw - np.floor(raw)


def blend_levels(level, top):
    """the level is rounded to the nearest integer, not floored: f can be negative

    told by: floor | nearest | np.round | rounded | rint | f & negative | fraction & negative
    """
    inside = np.clip(level, 0, top)
    low = np.rint(inside).astype(int)
    high = np.minimum(low + 1, top)
    return low, high, inside - low
