"""Wrong answers to remeshing, written without a look at the checks."""


def delaunay_gain(corners):
    """the sign is turned: pi - gamma - delta, positive where the edge is Delaunay already

    told by: sign | pi - gamma | pi - (gamma | negative | reversed | already delaunay | should stay
    """
    a, b, c, d = corners.swapaxes(0, 1)
    at_c = corner_angles(np.stack([c, a, b], 1))[:, 0]
    at_d = corner_angles(np.stack([d, b, a], 1))[:, 0]
    return np.pi - (at_c + at_d)


def delaunay_gain(corners):
    """the angles at a and b are taken (the first corners of abc and bad), not the opposite ones at c and d

    told by: at a and b | at a and at b | at c and d | at c and at d | ends of the edge | opposite to the edge | first corner
    """
    total = np.zeros(len(corners))
    for face in ([0, 1, 2], [1, 0, 3]):
        total += corner_angles(corners[:, face])[:, 0]
    return total - np.pi


def delaunay_gain(corners):
    """the angles at c and d are those of the new faces adc and bcd, after the flip, instead of abc and bad

    told by: after the flip | after a flip | new face | adc & bcd | a, d, c | edge cd | before the flip
    """
    faces = flip(np.tile(np.arange(4), (len(corners), 1)))[0]
    gamma = corner_angles(corners[:, faces[0]])[:, 2]
    delta = corner_angles(corners[:, faces[1]])[:, 2]
    return gamma + delta - np.pi


def relax_step(vertices, normals, edges, rate):
    """an edge counts for its first vertex only, the second one does not see the first as a neighbour

    told by: one direction | both directions | only one end | one end | both ends | second vertex | neighbours & missing
    """
    total = np.zeros(vertices.shape)
    count = np.zeros(len(vertices))
    for i, j in edges:
        total[i] += vertices[j]
        count[i] += 1
    mean = np.where(count[:, None] > 0, total / np.maximum(count, 1)[:, None], vertices)
    move = rate * (mean - vertices)
    return vertices + move - (move * normals).sum(1)[:, None] * normals


def delaunay_gain(corners):
    """pi - gamma - delta: the sign is the other way round, positive where the edge is Delaunay already

    told by: sign | other way | pi - gamma | negative | reversed | minus
    """
    c_first = corners[:, [2, 0, 1]]
    d_first = corners[:, [3, 1, 0]]
    return np.pi - corner_angles(c_first)[:, 0] - corner_angles(d_first)[:, 0]


def delaunay_gain(corners):
    """the face of d is taken as a, c, d: its angle is between the wrong sides

    told by: a, c, d | acd | wrong face | wrong triangle | a, b, d | b, a, d | between c | other triangle
    """
    gamma = corner_angles(corners[:, [2, 0, 1]])[:, 0]
    delta = corner_angles(corners[:, [3, 0, 2]])[:, 0]
    return gamma + delta - np.pi


def relax_step(vertices, normals, edges, rate):
    """only the normal part of the move is kept, n n^T instead of I - n n^T

    told by: only the normal | only & normal part | only & along n | I - n n^T | instead of the tangent | normal part is kept | part of the move along the normal n is kept | along the normal & instead
    """
    valence = np.bincount(edges.ravel(), minlength=len(vertices))
    move = smooth_explicit(vertices, edges, np.ones(len(edges)), valence, rate) - vertices
    return vertices + (move * normals).sum(1, keepdims=True) * normals
