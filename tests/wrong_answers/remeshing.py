"""Wrong answers to remeshing, written without a look at the checks."""


def delaunay_gain(corners):
    """the angles at a and b instead of those opposite to the edge, at c and d

    told by: at a and b | at the ends | opposite | c and d | ends of the edge | alpha
    """
    at_a = corner_angles(corners[:, [0, 1, 2]])[:, 0]
    at_b = corner_angles(corners[:, [1, 0, 3]])[:, 0]
    return at_a + at_b - np.pi


def delaunay_gain(corners):
    """the cotangents' sum negated instead of the angles: right sign, wrong value

    told by: cotangent | cot | not the angle | instead of the angle | in radians
    """
    a, b, c, d = corners.swapaxes(0, 1)
    total = np.zeros(len(corners))
    for tip in (c, d):
        p, q = a - tip, b - tip
        area = np.linalg.norm(np.cross(p, q), axis=1)
        total += (p * q).sum(1) / np.where(area > 0, area, 1)
    return -total


def delaunay_gain(corners):
    """the arccos of a cosine loses the digits of tiny angles and is nan where corners coincide (fine print)

    told by: arccos | acos | tiny | digits | nan | coincid | the cosine
    """
    def angle(tip, one, other):
        p, q = one - tip, other - tip
        with np.errstate(divide="ignore", invalid="ignore"):
            cosine = (p * q).sum(1) / (np.linalg.norm(p, axis=1) * np.linalg.norm(q, axis=1))
        return np.arccos(np.clip(cosine, -1, 1))

    a, b, c, d = corners.swapaxes(0, 1)
    return angle(c, a, b) + angle(d, a, b) - np.pi


def delaunay_gain(corners):
    """a bool, whether to flip, instead of the amount

    told by: bool | the amount | True or False | whether | comparison | yes or no
    """
    gamma = corner_angles(corners[:, [2, 0, 1]])[:, 0]
    delta = corner_angles(corners[:, [3, 1, 0]])[:, 0]
    return gamma + delta > np.pi


def delaunay_gain(corners):
    """pi is not subtracted: gamma + delta

    told by: pi is missing | pi is not | - pi | pi & subtract | without pi | forgot & pi | too large by pi | too big by pi | pi too
    """
    gain = np.zeros(len(corners))
    for n, (a, b, c, d) in enumerate(corners):
        gain[n] = corner_angles(np.stack([c, a, b]))[0] + corner_angles(np.stack([d, b, a]))[0]
    return gain


def relax_step(vertices, normals, edges, rate):
    """the move is not made tangential: the normal part is not taken away

    told by: normal part | tangential | tangent | along n | along the normal | n n^T | normal component | not projected | projection
    """
    valence = np.bincount(edges.ravel(), minlength=len(vertices))
    total = np.zeros(vertices.shape)
    for i, j in edges:
        total[i] += vertices[j]
        total[j] += vertices[i]
    mean = np.where(valence[:, None] > 0, total / np.maximum(valence, 1)[:, None], vertices)
    return vertices + rate * (mean - vertices)


def relax_step(vertices, normals, edges, rate):
    """the sum of the neighbours' offsets instead of their mean: not divided by the valence

    told by: sum instead | not the mean | instead of the mean | instead of their mean | valence | number of neighbours | not divided by | not averaged
    """
    move = smooth_explicit(vertices, edges, np.ones(len(edges)), np.ones(len(vertices)), rate) - vertices
    return vertices + move - (move * normals).sum(1, keepdims=True) * normals
