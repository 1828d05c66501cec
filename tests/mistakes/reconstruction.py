"""Mistakes of lab 16; each docstring goes on after "this is what comes out when"."""


def vertex_normals_backward(grad_normals, vertices, faces):
    """a vertex that is the same corner of several faces counts once: += with indices keeps the last
    face, `scatter` adds them all
    """
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    length = np.where(length > 0, length, np.inf)
    n = m / length
    grad_m = (grad_normals - (grad_normals * n).sum(1, keepdims=True) * n) / length
    g = grad_m[faces].sum(1)
    grad_vertices = np.zeros(vertices.shape)
    for corner, opposite in enumerate((b - c, c - a, a - b)):
        grad_vertices[faces[:, corner]] += np.cross(opposite, g)
    return grad_vertices
