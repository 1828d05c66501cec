"""Wrong answers to regularization, written without a look at the checks."""


def cotangents(triangles):
    """divided by the area, but |p x q| is twice the area, so all are twice too large

    told by: twice | double | factor 2 | factor of 2 | factor of two | half | halv
    """
    p, q = sides(triangles)
    area = np.linalg.norm(area_vectors(triangles), axis=-1) / 2
    longest = (p**2).sum(-1).max(-1)
    out = np.zeros(triangles.shape[:-1])
    for k in range(3):
        dot = (p[..., k, :] * q[..., k, :]).sum(-1)
        good = 2 * area > NO_AREA * longest
        out[..., k] = np.where(good, dot / np.where(good, area, 1), 0)
    return out


def laplacian_entries(edges, weights, vertex_count):
    """the diagonal holds the number of edges at the vertex instead of the sum of their weights

    told by: valence | number of edges | how many edges | diagonal & count | diagonal & sum of & weights | rows & sum to 0 | row & sums to 0
    """
    rows, columns, values = [], [], []
    valence = [0.0] * vertex_count
    for (i, j), w in zip(edges, weights):
        rows += [i, j]
        columns += [j, i]
        values += [-w, -w]
        valence[i] += 1
        valence[j] += 1
    rows += range(vertex_count)
    columns += range(vertex_count)
    return np.array(rows, int), np.array(columns, int), np.array(values + valence)


def smooth_explicit(x, edges, weights, mass, step):
    """L x is multiplied by the mass instead of divided by it

    told by: multipl & mass | divid & mass | times & mass | m^-1 | inverse & mass
    """
    return x - step * mass[:, None] * (laplacian(edges, weights, len(x)) @ x)


def smooth_implicit(x, edges, weights, mass, step):
    """the columns of L are divided by the mass instead of its rows

    told by: column | L M^-1 | rows & mass | row & mass | neighbour & mass | wrong side of L | transpose
    """
    safe = np.where(mass > 0, mass, 1)
    dense = laplacian(edges, weights, len(x)).toarray() / safe
    return np.linalg.solve(np.eye(len(x)) + step * dense, x)


def enclosed_volume_backward(grad_volume, triangles):
    """the factor 1/6 is missing

    told by: 1/6 | 1 / 6 | factor 6 | factor of 6 | six times | 6 times | sixth
    """
    corners = [triangles[:, k] for k in range(3)]
    return grad_volume * np.stack([np.cross(corners[(k + 1) % 3], corners[(k + 2) % 3])
                                   for k in range(3)], 1)
