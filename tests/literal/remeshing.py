"""Lab 13's flips as printed: what one types who has read the questions and the equations."""


def delaunay_gain(corners):
    a, b, c, d = corners[:, 0], corners[:, 1], corners[:, 2], corners[:, 3]
    gamma = corner_angles(np.stack([c, a, b], 1))[:, 0]
    delta = corner_angles(np.stack([d, a, b], 1))[:, 0]
    return gamma + delta - np.pi
