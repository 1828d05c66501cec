"""Wrong answers to regularization, written without a look at the checks."""


def corner_angles(triangles):
    """arctan instead of arctan2, so an obtuse angle comes out negative

    told by: arctan2 | obtuse | negative angle | angle & negative | beyond 90 | above pi / 2 | quadrant
    """
    p, q = sides(triangles)
    dots = (p * q).sum(-1)
    return np.arctan(twice_areas(triangles)[..., None] / dots)


def radius_ratio(triangles):
    """the factor 2 of q = 2 r / R is left out: an equilateral triangle has 1/2

    told by: factor & 2 | half | twice | 1/2 | 2 r | factor of two
    """
    a, b, c = np.moveaxis(np.linalg.norm(sides(triangles)[0], axis=-1), -1, 0)
    area = np.linalg.norm(area_vectors(triangles), axis=-1) / 2
    r = 2 * area / (a + b + c)
    R = a * b * c / (4 * area)
    return r / R


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


def cotangents_backward(grad_cotangents, triangles):
    """the area is held: only the gradient through the dot product is there

    told by: area & held | area & constant | area & missing | through the area | p x q & constant | p x q & missing | denominator
    """
    p, q = sides(triangles)
    s = np.linalg.norm(area_vectors(triangles), axis=-1)[..., None, None]
    flat = s <= NO_AREA * (p**2).sum(-1).max(-1)[..., None, None]
    g = np.where(flat, 0, grad_cotangents[..., None] / np.where(flat, 1, s))
    grad = -g * (p + q)
    for k in range(3):
        grad[..., (k + 1) % 3, :] += (g * q)[..., k, :]
        grad[..., (k + 2) % 3, :] += (g * p)[..., k, :]
    return grad


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


def laplacian_energy(x, edges, weights, mass):
    """divided by the mass twice: |L x / m|^2 instead of |L x|^2 / m

    told by: m^2 | mass & twice | mass & squar | m_i & twice | M^-1 & twice | L x / m
    """
    mean_offset = per_mass(laplacian(edges, weights, len(x)) @ x, mass)
    return (mean_offset**2).sum()


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """grad_weights has z_i (x_i - x_j) only: the row of the edge's second vertex is left out

    told by: z_j | second vertex | other end | both ends | other vertex | z_i - z_j | both vertices
    """
    L = laplacian(edges, weights, len(x))
    z = per_mass(L @ x, mass)
    by_weight = np.array([2 * grad_energy * z[i] @ (x[i] - x[j]) for i, j in edges])
    return 2 * grad_energy * (L @ z), by_weight, -grad_energy * (z * z).sum(1)


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


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """a round is only one of the two steps: they take turns from round to round

    told by: take turns | alternat | every other | both steps | each round & two | half as many | too few steps
    """
    for k in range(rounds):
        x = smooth_explicit(x, edges, weights, mass, shrink if k % 2 == 0 else -grow)
    return x


def enclosed_volume_backward(grad_volume, triangles):
    """the factor 1/6 is missing

    told by: 1/6 | 1 / 6 | factor 6 | factor of 6 | six times | 6 times | sixth
    """
    corners = [triangles[:, k] for k in range(3)]
    return grad_volume * np.stack([np.cross(corners[(k + 1) % 3], corners[(k + 2) % 3])
                                   for k in range(3)], 1)


def large_step(x, grad_x, mean, square, step, rate, spread):
    """grad_x goes into Adam as it is, without (I + lambda L)^-1

    told by: grad_u | grad_x & as it is | gradient & not preconditioned | gradient & not spread | precondition & grad_x | (I + lambda L)^-1 & grad | adam & grad_x
    """
    edges, weights, amount = spread
    u = x + amount * (laplacian(edges, weights, len(x)) @ x)
    moved, mean, square = uniform_adam_step(u, grad_x, mean, square, step, rate)
    return precondition(moved, edges, weights, amount), mean, square
