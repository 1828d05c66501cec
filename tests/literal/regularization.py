"""Lab 13 as printed: what one types who has read the questions and the equations."""


def cotangents(triangles):
    p, q = sides(triangles)
    return (p * q).sum(-1) / np.linalg.norm(np.cross(p, q), axis=-1)


def laplacian_entries(edges, weights, vertex_count):
    rows, columns, values = [], [], []
    for (i, j), w in zip(edges, weights, strict=True):
        rows += [i, i, j, j]
        columns += [i, j, j, i]
        values += [w, -w, w, -w]
    return np.array(rows), np.array(columns), np.array(values)


def smooth_explicit(x, edges, weights, mass, step):
    return x - step * (laplacian(edges, weights, len(x)) @ x) / mass[:, None]


def smooth_implicit(x, edges, weights, mass, step):
    system = scipy.sparse.diags_array(mass) + step * laplacian(edges, weights, len(x))
    return spsolve(system.tocsc(), mass[:, None] * x).reshape(x.shape)


def enclosed_volume_backward(grad_volume, triangles):
    x0, x1, x2 = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    return grad_volume / 6 * np.stack([np.cross(x1, x2), np.cross(x2, x0), np.cross(x0, x1)], 1)
