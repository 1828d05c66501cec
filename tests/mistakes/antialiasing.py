"""Mistakes of lab 8; each docstring goes on after "this is what comes out when"."""


def opposite_corners(faces):
    """an edge is looked up in reverse order only: neighbours that run along it in the same
    direction, wound the other way, are not found"""
    thirds = {}
    for f, face in enumerate(faces.tolist()):
        for k, (i, j) in enumerate(EDGES):
            thirds.setdefault((face[i], face[j]), 3 * f + k)
    return np.array([[thirds.get((face[j], face[i]), -1) for i, j in EDGES]
                     for face in faces.tolist()], int).reshape(faces.shape)
