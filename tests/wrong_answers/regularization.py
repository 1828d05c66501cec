"""Wrong answers to regularization, written without a look at the checks."""


def corner_angles(triangles):
    """the arccos of the dot product of unit sides loses the digits of small angles (fine print)

    told by: arccos | acos | digits & lose | loses & digits | cancel | round-off | rounding | nan
    """
    p, q = sides(triangles)
    lengths = np.linalg.norm(p, axis=-1) * np.linalg.norm(q, axis=-1)
    cosine = (p * q).sum(-1) / np.where(lengths > 0, lengths, 1)
    return np.where(lengths > 0, np.arccos(np.clip(cosine, -1, 1)), 0)


def corner_angles(triangles):
    """arctan of the quotient gives obtuse angles as negative ones

    told by: obtuse | arctan2 | quotient | negative angle | above pi / 2 | greater than pi / 2 | 90 degrees | second quadrant
    """
    p, q = sides(triangles)
    dot = (p * q).sum(-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.arctan(twice_areas(triangles)[..., None] / dot)


def corner_angles(triangles):
    """the angles are in degrees instead of radians

    told by: degrees | radian | 180 | rad2deg
    """
    p, q = sides(triangles)
    return np.degrees(np.arctan2(twice_areas(triangles)[..., None], (p * q).sum(-1)))


def radius_ratio(triangles):
    """the length of area_vectors is taken for the area, but it is twice that

    told by: twice the area | area_vectors | double | four times | factor 4 | factor of 4 | half of
    """
    length = np.linalg.norm(sides(triangles)[0], axis=-1)
    area = np.linalg.norm(area_vectors(triangles), axis=-1)
    around, product = length.sum(-1), length.prod(-1)
    r = 2 * area / np.where(around > 0, around, 1)
    upside = 4 * area / np.where(product > 0, product, 1)
    return 2 * r * upside


def radius_ratio(triangles):
    """divides by zero where corners coincide, which gives nan instead of 0 (fine print)

    told by: nan | divi & zero | divi & by 0 | 0 / 0 | coincid | degenerate
    """
    length = np.linalg.norm(sides(triangles)[0], axis=-1)
    area = np.linalg.norm(area_vectors(triangles), axis=-1) / 2
    with np.errstate(divide="ignore", invalid="ignore"):
        r = 2 * area / length.sum(-1)
        R = length.prod(-1) / (4 * area)
        return 2 * r / R


def cotangents(triangles):
    """the sides go round the triangle, so p . q has the wrong sign: the angle outside is taken

    told by: sign | negative | negated | exterior | outside | outer angle | go round | minus
    """
    ahead = np.roll(triangles, -1, -2) - triangles
    behind = triangles - np.roll(triangles, 1, -2)
    twice_area = np.linalg.norm(area_vectors(triangles), axis=-1, keepdims=True)
    flat = twice_area <= NO_AREA * (ahead**2).sum(-1).max(-1, keepdims=True)
    return np.where(flat, 0, (ahead * behind).sum(-1) / np.where(flat, 1, twice_area))


def cotangents(triangles):
    """the cotangents are one corner off: that of corner k + 1 stands at k

    told by: other corner | next corner | wrong corner | shifted | cyclic | rolled | k + 1 | order of the corners | corner & instead of
    """
    a, b, c = np.moveaxis(triangles, -2, 0)
    s = np.linalg.norm(np.cross(b - a, c - a), axis=-1)
    longest = np.max([((b - a)**2).sum(-1), ((c - b)**2).sum(-1), ((a - c)**2).sum(-1)], axis=0)
    flat = s <= NO_AREA * longest
    s = np.where(flat, 1, s)
    at_b = ((a - b) * (c - b)).sum(-1) / s
    at_c = ((a - c) * (b - c)).sum(-1) / s
    at_a = ((b - a) * (c - a)).sum(-1) / s
    return np.where(flat[..., None], 0, np.stack([at_b, at_c, at_a], -1))


def cotangents_backward(grad_cotangents, triangles):
    """the corner itself gets nothing: -grad_p - grad_q is left out

    told by: corner itself | own corner | corner k | - by_p | minus | start of the sides | starting point | from which | both sides start
    """
    p, q = sides(triangles)
    normal = area_vectors(triangles)[..., None, :]
    s = np.linalg.norm(normal, axis=-1, keepdims=True)
    flat = s <= NO_AREA * (p**2).sum(-1).max(-1)[..., None, None]
    s = np.where(flat, 1, s)
    g = np.where(flat, 0, grad_cotangents[..., None] / s)
    grad_s = -(g * (p * q).sum(-1, keepdims=True)).sum(-2, keepdims=True) / s
    moved = np.roll(g * q, 1, -2) + np.roll(g * p, 2, -2)
    return moved + grad_s * np.cross(normal / s, q - p)


def laplacian_entries(edges, weights, vertex_count):
    """the signs are exchanged: negative on the diagonal, positive beside it

    told by: sign | negative | minus | negated | adjacency minus
    """
    i, j = edges[:, 0], edges[:, 1]
    rows = np.concatenate([i, j, i, j])
    columns = np.concatenate([j, i, i, j])
    return rows, columns, np.concatenate([weights, weights, -weights, -weights])


def laplacian_entries(edges, weights, vertex_count):
    """each edge is entered once, from i to j only: the other direction is missing

    told by: symmetric | other direction | one direction | both directions | j to i | only once | row of j | both ends | second vertex | second end
    """
    i, j = edges.T
    return (np.concatenate([i, i]), np.concatenate([j, i]),
            np.concatenate([-weights, weights]))


def laplacian_entries(edges, weights, vertex_count):
    """the diagonal is left out

    told by: diagonal | rows & sum to 0 | x_i & missing | only & x_j | adjacency
    """
    i, j = edges.T
    return np.concatenate([i, j]), np.concatenate([j, i]), -np.concatenate([weights, weights])


def laplacian_entries(edges, weights, vertex_count):
    """the diagonal is the valence instead of the sum of the weights

    told by: valence | number of edges | number of neighbours | count & diagonal | sum of the weights | degree
    """
    i, j = edges.T
    valence = np.bincount(edges.ravel(), minlength=vertex_count).astype(float)
    v = np.arange(vertex_count)
    return (np.concatenate([i, j, v]), np.concatenate([j, i, v]),
            np.concatenate([-weights, -weights, valence]))


def laplacian_entries(edges, weights, vertex_count):
    """a diagonal summed with += and repeated indices has only one edge of each vertex

    told by: += | repeated | add.at | bincount | only one edge | last edge | index & twice | buffered
    """
    i, j = edges.T
    diagonal = np.zeros(vertex_count)
    diagonal[i] += weights
    diagonal[j] += weights
    v = np.arange(vertex_count)
    rows = np.concatenate([i, j, v])
    columns = np.concatenate([j, i, v])
    return rows, columns, np.concatenate([-weights, -weights, diagonal])


def laplacian_entries(edges, weights, vertex_count):
    """rows are divided by their sums: this is already M^-1 L, the mean of the neighbours

    told by: M^-1 | normalis | normaliz | divided by | mean of the neighbours | row sum | average
    """
    i, j = edges.T
    total = np.bincount(i, weights, vertex_count) + np.bincount(j, weights, vertex_count)
    used = np.flatnonzero(total)
    rows = np.concatenate([i, j, used])
    columns = np.concatenate([j, i, used])
    values = np.concatenate([-weights / total[i], -weights / total[j], np.ones(len(used))])
    return rows, columns, values


def laplacian_energy(x, edges, weights, mass):
    """x . L x, the Dirichlet energy, instead of the squared Laplacian

    told by: Dirichlet | x . L x | x^T L x | L x & squared | (x_i - x_j)^2 | not squared | differences along the edges
    """
    i, j = edges.T
    return (weights[:, None] * (x[i] - x[j])**2).sum()


def laplacian_energy(x, edges, weights, mass):
    """multiplies by the mass instead of dividing by it

    told by: multipl & mass | times & mass | multipl & m_i | instead of dividing | divid & instead
    """
    y = laplacian(edges, weights, len(x)) @ x
    energy = 0.0
    for i in range(len(x)):
        energy += mass[i] * (y[i] @ y[i])
    return energy


def smooth_explicit(x, edges, weights, mass, step):
    """adds the Laplacian: the step goes away from the neighbours

    told by: sign | adds | plus | away from | added instead | x + s | wrong direction | sharpens | roughen
    """
    return x + step * per_mass(laplacian(edges, weights, len(x)) @ x, mass)


def smooth_explicit(x, edges, weights, mass, step):
    """M^-1 is left out: not divided by the mass

    told by: divided by the mass | M^-1 | not divided | without the mass | mass is & left out | mass is & missing | mass is not | ignores the mass | per_mass
    """
    return x - step * (laplacian(edges, weights, len(x)) @ x)


def smooth_explicit(x, edges, weights, mass, step):
    """only the move is returned, without x

    told by: only the move | without x | displacement | only & change | not added to x | x is missing | x is left out | x itself
    """
    return -step * per_mass(laplacian(edges, weights, len(x)) @ x, mass)


def smooth_explicit(x, edges, weights, mass, step):
    """divides by a mass of 0, so such a vertex becomes nan instead of staying (fine print)

    told by: nan | mass 0 | mass of 0 | divi & zero | divi & by 0 | per_mass | 0 / 0
    """
    y = laplacian(edges, weights, len(x)) @ x
    with np.errstate(divide="ignore", invalid="ignore"):
        return x - step * y / mass[:, None]


def smooth_explicit(x, edges, weights, mass, step):
    """the vertices move one after another, so later ones see neighbours that have moved already

    told by: one after another | already moved | moved already | in place | Gauss-Seidel | all at once | new places | same time | simultaneous | updated neighbours
    """
    new = x.astype(float)
    L = laplacian(edges, weights, len(x)).toarray()
    for i in range(len(new)):
        if mass[i] > 0:
            new[i] -= step * (L[i] @ new) / mass[i]
    return new


def smooth_implicit(x, edges, weights, mass, step):
    """M - s L instead of M + s L

    told by: sign | M - s L | minus | subtract | negative
    """
    mass = np.where(mass > 0, mass, 1)
    matrix = scipy.sparse.diags_array(mass) - step * laplacian(edges, weights, len(x))
    return spsolve(matrix.tocsc(), mass[:, None] * x).reshape(x.shape)


def smooth_implicit(x, edges, weights, mass, step):
    """I + s L: the mass is ignored, equation (10) instead of (6)

    told by: I + s L | mass & ignored | without the mass | identity | (10) | M is left out | masses are left out | mass is not used | mass 1 | M = I
    """
    matrix = scipy.sparse.eye_array(len(x)) + step * laplacian(edges, weights, len(x))
    return spsolve(matrix.tocsc(), x).reshape(x.shape)


def smooth_implicit(x, edges, weights, mass, step):
    """an explicit step, equation (5) instead of (6)

    told by: explicit | (5) | not solved | no system | equation 5
    """
    return x - step * per_mass(laplacian(edges, weights, len(x)) @ x, mass)


def smooth_implicit(x, edges, weights, mass, step):
    """a vertex of mass 0 makes the matrix singular (fine print)

    told by: singular | mass 0 | mass of 0 | zero row | nan | massless
    """
    matrix = scipy.sparse.diags_array(mass) + step * laplacian(edges, weights, len(x))
    return spsolve(matrix.tocsc(), mass[:, None] * x).reshape(x.shape)


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """both steps shrink: the minus sign before grow is missing

    told by: both & shrink | sign | minus | -grow | shrinks twice | + grow | negative
    """
    for _ in range(rounds):
        x = smooth_explicit(x, edges, weights, mass, shrink)
        x = smooth_explicit(x, edges, weights, mass, grow)
    return x


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """both steps start from the same x: the second does not see the result of the first

    told by: same x | result of the first | first step & result | second step & old | one step of shrink - grow | in one step | shrink - grow | simultaneous
    """
    for _ in range(rounds):
        smoothed = smooth_explicit(x, edges, weights, mass, shrink)
        inflated = smooth_explicit(x, edges, weights, mass, -grow)
        x = smoothed + inflated - x
    return x


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """only one round is made, because the return is inside the loop

    told by: one round | return & loop | first round | rounds & ignored | single round | rounds & not used
    """
    for _ in range(rounds):
        x = smooth_explicit(x, edges, weights, mass, shrink)
        x = smooth_explicit(x, edges, weights, mass, -grow)
        return x
    return x


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """grow is taken as what comes on top of shrink: the second step is -(shrink + grow)

    told by: shrink + grow | added to shrink | sum of shrink and grow | in addition to shrink
    """
    for _ in range(rounds):
        for step in (shrink, -(shrink + grow)):
            x = smooth_explicit(x, edges, weights, mass, step)
    return x


def enclosed_volume_backward(grad_volume, triangles):
    """the cross products have their factors exchanged, x_2 x x_1: all signs are flipped

    told by: sign is | signs are | wrong sign | negated | negative | order of the cross | order of the factors | factors & exchanged | factors & swapped | x_2 x x_1
    """
    ahead, behind = np.roll(triangles, -1, axis=1), np.roll(triangles, 1, axis=1)
    return grad_volume * np.cross(behind, ahead) / 6


def enclosed_volume_backward(grad_volume, triangles):
    """the sign of the middle corner alone is flipped: x_0 x x_2 instead of x_2 x x_0

    told by: middle corner | x_0 x x_2 | x_2 x x_0 | corner 1 | second corner | middle & sign | x_1 & sign
    """
    out = np.zeros(triangles.shape)
    for f, (a, b, c) in enumerate(triangles):
        out[f, 0] = np.cross(b, c)
        out[f, 1] = np.cross(a, c)
        out[f, 2] = np.cross(a, b)
    return grad_volume / 6 * out


def enclosed_volume_backward(grad_volume, triangles):
    """grad_volume is not multiplied in

    told by: grad_volume | chain rule | incoming | multiplied in | upstream
    """
    return np.cross(np.roll(triangles, -1, 1), np.roll(triangles, -2, 1)) / 6


def large_step(x, grad_x, mean, square, step, rate, spread):
    """the gradient of u is not preconditioned: grad_x goes into the step as it is

    told by: precondition & grad | grad_x & as it is | grad_u | grad_x instead of | gradient & not spread | chain rule
    """
    edges, weights, amount = spread
    u = x + amount * (laplacian(edges, weights, len(x)) @ x)
    u, mean, square = uniform_adam_step(u, grad_x, mean, square, step, rate)
    return precondition(u, *spread), mean, square
