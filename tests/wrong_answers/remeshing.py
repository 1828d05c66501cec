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
    """delta is measured in the triangle b, c, d instead of b, a, d

    told by: b, c, d | bcd | triangle & delta | b, a, d & delta | triangle & at d | face & d | angle at d
    """
    gamma = corner_angles(corners[:, :3])[:, 2]
    delta = corner_angles(corners[:, 1:])[:, 2]
    return gamma + delta - np.pi


def delaunay_gain(corners):
    """the angles are taken at a and b, the ends of the edge, instead of at c and d opposite to it

    told by: opposite | ends of the edge | at a and b | at a & not at c | at c and d | at c & at d
    """
    gain = np.zeros(len(corners))
    for n, (a, b, c, d) in enumerate(corners):
        at_a = corner_angles(np.array([a, b, c]))[0]
        at_b = corner_angles(np.array([b, a, d]))[0]
        gain[n] = at_a + at_b - np.pi
    return gain


def delaunay_gain(corners):
    """the sign is turned round: pi - gamma - delta is positive where the edge should stay

    told by: sign | pi - | should stay | opposite & flip | negative where | turned round
    """
    one = corner_angles(corners[:, [2, 0, 1]])[..., 0]
    two = corner_angles(corners[:, [3, 0, 1]])[..., 0]
    return np.pi - (one + two)


def relax_step(vertices, normals, edges, rate):
    """the part of the move along the normal is kept, and the tangential part is taken away

    told by: along the normal | tangential | n n^t | normal part | i - n | off the surface
    """
    total, count = np.zeros(vertices.shape), np.zeros(len(vertices))
    for i, j in edges:
        total[i] += vertices[j]
        total[j] += vertices[i]
        count[[i, j]] += 1
    move = rate * (total / np.maximum(count, 1)[:, None] - vertices)
    move[count == 0] = 0
    return vertices + (move * normals).sum(1, keepdims=True) * normals
