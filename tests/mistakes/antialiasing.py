"""Mistakes of lab 8; each docstring goes on after "this is what comes out when"."""


def opposite_vertices(faces):
    """the face's own vertex k is taken for the one across: it is the third vertex of the other face
    at the edge"""
    edges = [frozenset((face[i], face[j])) for face in faces.tolist() for i, j in EDGES]
    shared = np.array([edges.count(edge) > 1 for edge in edges], bool)
    return np.where(shared.reshape(faces.shape), faces, -1)


def opposite_vertices(faces):
    """only the last face at an edge is kept, as in a dictionary with one entry for each edge: that
    face finds itself, and gets its own vertex or -1"""
    last = {frozenset((face[i], face[j])): face[k]
            for face in faces.tolist() for k, (i, j) in enumerate(EDGES)}
    return np.array([[last[frozenset((face[i], face[j]))]
                      if last[frozenset((face[i], face[j]))] != face[k] else -1
                      for k, (i, j) in enumerate(EDGES)] for face in faces.tolist()],
                    int).reshape(faces.shape)


def opposite_vertices(faces):
    """an edge from a to b is taken for another one than that from b to a"""
    thirds = {}
    for face in faces.tolist():
        for k, (i, j) in enumerate(EDGES):
            thirds.setdefault((face[i], face[j]), []).append(face[k])
    opposite = np.full(faces.shape, -1)
    for f, face in enumerate(faces.tolist()):
        for k, (i, j) in enumerate(EDGES):
            others = [third for third in thirds[face[i], face[j]] if third != face[k]]
            opposite[f, k] = others[0] if others else -1
    return opposite


def opposite_vertices(faces):
    """an edge is looked up in reverse order only: neighbours that run along it in the same
    direction, wound the other way, are not found"""
    thirds = {}
    for face in faces.tolist():
        for k, (i, j) in enumerate(EDGES):
            thirds.setdefault((face[i], face[j]), face[k])
    return np.array([[thirds.get((face[j], face[i]), -1) for i, j in EDGES]
                     for face in faces.tolist()], int).reshape(faces.shape)


def opposite_vertices(faces):
    """edge k starts at vertex k, from k to k + 1, so that columns are rolled; it is the one
    opposite to vertex k, from k + 1 to k + 2"""
    thirds = {}
    for face in faces.tolist():
        for k, (i, j) in enumerate(EDGES):
            thirds.setdefault(frozenset((face[i], face[j])), []).append(face[k])
    opposite = np.full(faces.shape, -1)
    for f, face in enumerate(faces.tolist()):
        for k, (i, j) in enumerate(EDGES):
            others = [v for v in thirds[frozenset((face[i], face[j]))] if v != face[k]]
            opposite[f, k - 2] = others[0] if others else -1
    return opposite


def opposite_vertices(faces):
    """edge k ends at vertex k, from k - 1 to k, so that columns are rolled; it is the one opposite
    to vertex k, from k + 1 to k + 2"""
    thirds = {}
    for face in faces.tolist():
        for k, (i, j) in enumerate(EDGES):
            thirds.setdefault(frozenset((face[i], face[j])), []).append(face[k])
    opposite = np.full(faces.shape, -1)
    for f, face in enumerate(faces.tolist()):
        for k, (i, j) in enumerate(EDGES):
            others = [v for v in thirds[frozenset((face[i], face[j]))] if v != face[k]]
            opposite[f, k - 1] = others[0] if others else -1
    return opposite


def silhouette_edges(x, y, w, faces, opposite):
    """only the border counts: folds are left out, where vertex k and the one across lie on one side
    of the edge"""
    return opposite < 0


def blend(colour, owner, other, alpha):
    """a pair reads colours that an earlier pair has changed; all read those from before any
    blend"""
    output = colour.reshape(-1, colour.shape[-1]).astype(float)
    for p, q, a in zip(owner, other, alpha, strict=True):
        output[p if a > 0 else q] += a * (output[q] - output[p])
    return output.reshape(colour.shape)


def blend_backward(grad_output, colour, owner, other, alpha):
    """the share of the neighbour is left out: alpha grad is not given to the other pixel, only
    taken from the one that changes"""
    pixels, grad_pixels = (p.reshape(-1, colour.shape[-1]).astype(float)
                           for p in (colour, grad_output))
    grad_changed = grad_pixels[np.where(alpha >= 0, owner, other)]
    grad_alpha = (grad_changed * (pixels[other] - pixels[owner])).sum(1)
    grad_colour = grad_pixels.copy()
    changed = np.where(alpha >= 0, owner, other)
    np.add.at(grad_colour, changed, -np.abs(alpha)[:, None] * grad_changed)
    return grad_colour.reshape(colour.shape), grad_alpha
