"""Wrong answers to remeshing, written without a look at the checks."""


def delaunay_gain(corners):
    """the sign is turned round: pi - gamma - delta is positive where the edge should stay

    told by: sign | pi - | should stay | opposite & flip | negative where | turned round
    """
    one = corner_angles(corners[:, [2, 0, 1]])[..., 0]
    two = corner_angles(corners[:, [3, 0, 1]])[..., 0]
    return np.pi - (one + two)
