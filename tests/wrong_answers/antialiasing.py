"""Wrong answers to antialiasing, written without a look at the checks."""


def opposite_vertices(faces):
    """a neighbour is only found if it is wound the same way, so that it walks the edge backwards

    told by: wound | winding | direct & edge | either way | orient | backward & edge | same direction
    """
    third = {}
    for face in faces:
        for k, (i, j) in enumerate(EDGES):
            third.setdefault((face[i], face[j]), face[k])
    across = np.full(faces.shape, -1)
    for f, face in enumerate(faces):
        for k, (i, j) in enumerate(EDGES):
            vertex = third.get((face[j], face[i]), -1)
            if vertex != face[k]:
                across[f, k] = vertex
    return across


def silhouette_edges(x, y, w, faces, opposite):
    """an edge without a face across is no silhouette: -1 reads the last vertex

    told by: -1 | last vertex | no face across | border | boundary | open edge | surface ends | without a face
    """
    p = np.stack([x, y], 1)
    out = np.zeros(faces.shape, bool)
    for k, (i, j) in enumerate(EDGES):
        a, b = p[faces[:, i]], p[faces[:, j]]
        mine = edge_function(p[faces[:, k]], a, b) * np.prod(np.sign(w[faces]), 1)
        turned = np.sign(w[faces[:, i]] * w[faces[:, j]] * w[opposite[:, k]])
        theirs = edge_function(p[opposite[:, k]], a, b) * turned
        out[:, k] = (mine < 0) == (theirs < 0)
    return out


def crossing(x0, y0, x1, y1):
    """x and y are exchanged: where the line meets x = 0

    told by: x = 0 | x and y | exchanged | swapped | meets the y | y axis | mixed up
    """
    slope = (y1 - y0) / (x1 - x0)
    return y0 - x0 * slope


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """grad_x1 has the wrong sign: r was not turned into -r for this end

    told by: grad_x1 & sign | grad_x1 & minus | grad_x1 & negat | x1 & -r | r becomes -r | grad_x1 & opposite | x1 & sign
    """
    h = y1 - y0
    k = grad_c / (h + np.copysign(epsilon, h))
    c = (x0 * y1 - x1 * y0) / (h + np.copysign(epsilon, h))
    return k * y1, k * (c - x1), k * y0, -k * (c - x0)


def blend_weight(c):
    """the sign: alpha = c - 1/2

    told by: sign | c - 1/2 | minus | negative | c - 0.5 | turned round | opposite
    """
    return np.minimum(np.maximum(c, 0), 1) - 0.5


def blend(colour, owner, other, alpha):
    """a pixel in several pairs keeps only one change, as output[changed] += adds only once for each index

    told by: several pairs | only one & change | add.at | repeated | add up | last & pair | more than one pair | accumul | overwrit
    """
    flat = colour.reshape(-1, colour.shape[-1]).astype(float)
    result = flat.copy()
    changed = np.where(alpha > 0, owner, other)
    result[changed] += alpha[:, None] * (flat[other] - flat[owner])
    return result.reshape(colour.shape)


def blend_backward(grad_output, colour, owner, other, alpha):
    """the identity is missing: grad_colour lacks grad_output itself

    told by: identity | grad_output itself | unblended | not in any pair | unchanged pixel | start & grad_output | copy of grad_output | without & grad_output | from zero
    """
    channels = colour.shape[-1]
    flat = np.asarray(colour, float).reshape(-1, channels)
    g = np.asarray(grad_output, float).reshape(-1, channels)
    at = g[np.where(alpha >= 0, owner, other)]
    by_colour = np.zeros(flat.shape)
    np.add.at(by_colour, owner, -alpha[:, None] * at)
    np.add.at(by_colour, other, alpha[:, None] * at)
    return by_colour.reshape(colour.shape), (at * (flat[other] - flat[owner])).sum(1)
