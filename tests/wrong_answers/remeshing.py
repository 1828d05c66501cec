"""Wrong answers to remeshing, written without a look at the checks."""


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
