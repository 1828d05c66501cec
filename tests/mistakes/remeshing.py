"""Mistakes of lab 13; each docstring goes on after "this is what comes out when"."""


def delaunay_gain(corners):
    """the cotangents are added, with a minus sign, instead of the angles"""
    a, b, c, d = corners.swapaxes(0, 1)
    total = np.zeros(len(corners))
    for tip in (c, d):
        p, q = a - tip, b - tip
        area = np.linalg.norm(np.cross(p, q), axis=1)
        total += (p * q).sum(1) / np.where(area > 0, area, 1)
    return -total


def relax_step(vertices, normals, edges, rate):
    """an edge pulls one end only, its first vertex: both ends are neighbours of each other"""
    i, j = edges.T
    pull = np.zeros(vertices.shape)
    np.add.at(pull, i, vertices[j] - vertices[i])
    move = rate * pull / np.maximum(np.bincount(i, minlength=len(vertices)), 1)[:, None]
    return vertices + move - (move * normals).sum(1, keepdims=True) * normals
