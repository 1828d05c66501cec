"""Mistakes of lab 13; each docstring goes on after "this is what comes out when"."""


def delaunay_gain(corners):
    """delta is the angle at the edge's end; it is the one at d"""
    gamma = corner_angles(corners[:, [2, 0, 1]])[:, 0]
    delta = corner_angles(corners[:, [3, 1, 0]])[:, 1]
    return gamma + delta - np.pi


def delaunay_gain(corners):
    """pi is not taken away"""
    gamma = corner_angles(corners[:, [2, 0, 1]])[:, 0]
    delta = corner_angles(corners[:, [3, 1, 0]])[:, 0]
    return gamma + delta


def delaunay_gain(corners):
    """the gain has the wrong sign"""
    gamma = corner_angles(corners[:, [2, 0, 1]])[:, 0]
    delta = corner_angles(corners[:, [3, 1, 0]])[:, 0]
    return np.pi - gamma - delta


def relax_step(vertices, normals, edges, rate):
    """the move along the normal is not taken away"""
    valence = np.bincount(edges.ravel(), minlength=len(vertices))
    move = smooth_explicit(vertices, edges, np.ones(len(edges)), valence, rate) - vertices
    return vertices + move


def relax_step(vertices, normals, edges, rate):
    """the move along the normal is doubled instead of taken away"""
    valence = np.bincount(edges.ravel(), minlength=len(vertices))
    move = smooth_explicit(vertices, edges, np.ones(len(edges)), valence, rate) - vertices
    return vertices + move + (move * normals).sum(1, keepdims=True) * normals


def relax_step(vertices, normals, edges, rate):
    """the neighbours' pulls are added; the mean is asked for"""
    move = (
        smooth_explicit(vertices, edges, np.ones(len(edges)), np.ones(len(vertices)), rate)
        - vertices
    )
    return vertices + move - (move * normals).sum(1, keepdims=True) * normals
