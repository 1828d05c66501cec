"""Mistakes of lab 13; each docstring goes on after "this is what comes out when"."""


def delaunay_gain(corners):
    """pi is not subtracted: it is gamma + delta"""
    gamma = corner_angles(corners[:, [2, 0, 1]])[:, 0]
    delta = corner_angles(corners[:, [3, 1, 0]])[:, 0]
    return gamma + delta


def delaunay_gain(corners):
    """the sign is wrong: it is pi - gamma - delta"""
    gamma = corner_angles(corners[:, [2, 0, 1]])[:, 0]
    delta = corner_angles(corners[:, [3, 1, 0]])[:, 0]
    return np.pi - gamma - delta


def delaunay_gain(corners):
    """the angles are those at a and b, the ends of the edge; they are at c and d, opposite to it"""
    at_a = corner_angles(corners[:, [0, 1, 2]])[:, 0]
    at_b = corner_angles(corners[:, [1, 0, 3]])[:, 0]
    return at_a + at_b - np.pi


def delaunay_gain(corners):
    """the cotangents are added, with a minus sign, instead of the angles"""
    a, b, c, d = corners.swapaxes(0, 1)
    total = np.zeros(len(corners))
    for tip in (c, d):
        p, q = a - tip, b - tip
        area = np.linalg.norm(np.cross(p, q), axis=1)
        total += (p * q).sum(1) / np.where(area > 0, area, 1)
    return -total


def delaunay_gain(corners):
    """it is in degrees: gamma + delta - 180"""
    gamma = corner_angles(corners[:, [2, 0, 1]])[:, 0]
    delta = corner_angles(corners[:, [3, 1, 0]])[:, 0]
    return np.degrees(gamma + delta - np.pi)


def delaunay_gain(corners):
    """180 is subtracted from angles in radians; it is pi"""
    gamma = corner_angles(corners[:, [2, 0, 1]])[:, 0]
    delta = corner_angles(corners[:, [3, 1, 0]])[:, 0]
    return gamma + delta - 180


def relax_step(vertices, normals, edges, rate):
    """the move is not made tangential: its part along the normal n is not taken away"""
    valence = np.bincount(edges.ravel(), minlength=len(vertices))
    move = smooth_explicit(vertices, edges, np.ones(len(edges)), valence, rate) - vertices
    return vertices + move


def relax_step(vertices, normals, edges, rate):
    """the part of the move along the normal n is added once more instead of taken away"""
    valence = np.bincount(edges.ravel(), minlength=len(vertices))
    move = smooth_explicit(vertices, edges, np.ones(len(edges)), valence, rate) - vertices
    return vertices + move + (move * normals).sum(1, keepdims=True) * normals


def relax_step(vertices, normals, edges, rate):
    """the sum of the neighbours' offsets is taken instead of their mean: it is not divided by the
    valence"""
    move = (
        smooth_explicit(vertices, edges, np.ones(len(edges)), np.ones(len(vertices)), rate)
        - vertices
    )
    return vertices + move - (move * normals).sum(1, keepdims=True) * normals


def relax_step(vertices, normals, edges, rate):
    """the rate is left out"""
    valence = np.bincount(edges.ravel(), minlength=len(vertices))
    move = smooth_explicit(vertices, edges, np.ones(len(edges)), valence, 1.0) - vertices
    return vertices + move - (move * normals).sum(1, keepdims=True) * normals


def relax_step(vertices, normals, edges, rate):
    """only the part of the move along the normal n is kept; that part is to be taken away"""
    valence = np.bincount(edges.ravel(), minlength=len(vertices))
    move = smooth_explicit(vertices, edges, np.ones(len(edges)), valence, rate) - vertices
    return vertices + (move * normals).sum(1, keepdims=True) * normals


def relax_step(vertices, normals, edges, rate):
    """an edge pulls one end only, its first vertex: both ends are neighbours of each other"""
    i, j = edges.T
    pull = np.zeros(vertices.shape)
    np.add.at(pull, i, vertices[j] - vertices[i])
    move = rate * pull / np.maximum(np.bincount(i, minlength=len(vertices)), 1)[:, None]
    return vertices + move - (move * normals).sum(1, keepdims=True) * normals
