"""Mistakes of lab 6's cube maps; each docstring goes on after "this is what comes out when"."""


def on_face_backward(grad_uv, directions):
    """m's part is left out: m is in both quotients, and changes with the direction"""
    face, _ = on_face(directions)
    m = in_frame(directions, face)[:, 2:]
    return np.einsum("nij,ni->nj", FRAMES[face, :2], grad_uv / (2 * m))


def across_edge(face, column, row, size):
    """the face begins again beyond its edge, as with wrap: another face lies there"""
    return face, column % size, row % size


def across_edge(face, column, row, size):
    """the face's own border goes on, as with clamp: another face lies there"""
    return face, np.clip(column, 0, size - 1), np.clip(row, 0, size - 1)
