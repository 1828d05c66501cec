"""Wrong answers to regularization, written without a look at the checks."""


def corner_angles(triangles):
    """arctan instead of arctan2, so an obtuse angle comes out negative

    told by: arctan2 | obtuse | negative angle | angle & negative | beyond 90 | above pi / 2 | quadrant
    """
    p, q = sides(triangles)
    dots = (p * q).sum(-1)
    return np.arctan(twice_areas(triangles)[..., None] / dots)


def radius_ratio(triangles):
    """the length of the cross product is taken for the area A, but it is twice the area

    told by: twice the area | area & double | area & half | area & halv | 4 times | four times | factor 4
    """
    a, b, c = np.moveaxis(np.linalg.norm(sides(triangles)[0], axis=-1), -1, 0)
    area = np.linalg.norm(area_vectors(triangles), axis=-1)
    inner = 2 * area / (a + b + c)
    outer = a * b * c / np.where(area > 0, 4 * area, 1)
    return np.where(area > 0, 2 * inner / outer, 0.0)


def cotangents(triangles):
    """these are cosines: divided by |p| |q| instead of |p x q|

    told by: cosine | product of the lengths | lengths of the sides | lengths of p and q | length & not & cross product | p x q & length
    """
    p, q = sides(triangles)
    twice_area = np.linalg.norm(area_vectors(triangles), axis=-1, keepdims=True)
    flat = twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    lengths = np.linalg.norm(p, axis=-1) * np.linalg.norm(q, axis=-1)
    return np.where(flat, 0, (p * q).sum(-1) / np.where(flat, 1, lengths))


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


def cotangents(triangles):
    """each cotangent stands one corner further: that of corner k + 1 at k

    told by: k + 1 | next corner | other corner | another corner | one corner | shifted | corners & mixed up
    """
    x = triangles
    here, after, last = np.roll(x, -1, -2), np.roll(x, -2, -2), x
    p, q = after - here, last - here
    s = np.linalg.norm(area_vectors(x), axis=-1, keepdims=True)
    none = s <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    return np.where(none, 0, (p * q).sum(-1) / np.where(none, 1, s))


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
    """off the diagonal only (i, j) is listed and not (j, i), so the matrix is not symmetric

    told by: symmetric | (j, i) | one direction | both directions | other direction | transpose | only one of & two
    """
    first, second = edges[:, 0], edges[:, 1]
    rows = np.concatenate([first, first, second])
    columns = np.concatenate([second, first, second])
    return rows, columns, np.concatenate([-weights, weights, weights])


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


def laplacian_entries(edges, weights, vertex_count):
    """diagonal[i] += weights adds only one edge where an index stands several times

    told by: += | np.add.at | more than once | several times | repeated | only one edge | overwrit
    """
    i, j = edges.T
    diagonal = np.zeros(vertex_count)
    diagonal[i] += weights
    diagonal[j] += weights
    every = np.arange(vertex_count)
    return (np.concatenate([i, j, every]), np.concatenate([j, i, every]),
            np.concatenate([-weights, -weights, diagonal]))


def laplacian_energy(x, edges, weights, mass):
    """divided by the mass twice: |L x / m|^2 instead of |L x|^2 / m

    told by: m^2 | mass & twice | mass & squar | m_i & twice | M^-1 & twice | L x / m
    """
    mean_offset = per_mass(laplacian(edges, weights, len(x)) @ x, mass)
    return (mean_offset**2).sum()


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """grad_weights has the part of the edge's first vertex only, the one of z_j is missing

    told by: z_j | both ends | other end | one end | first vertex | second vertex | only one of & two vertices
    """
    L = laplacian(edges, weights, len(x))
    scaled = per_mass(L @ x, mass)
    grad_weights = np.zeros(len(edges))
    for e, (i, j) in enumerate(edges):
        grad_weights[e] = 2 * grad_energy * scaled[i] @ (x[i] - x[j])
    return 2 * grad_energy * (L @ scaled), grad_weights, -grad_energy * (scaled**2).sum(1)


def smooth_explicit(x, edges, weights, mass, step):
    """the step has the other sign: x + s M^-1 L x, which sharpens

    told by: sign | minus | plus | away from | opposite direction | wrong way | sharpen
    """
    offset = per_mass(laplacian(edges, weights, len(x)) @ x, mass)
    return x + step * offset


def smooth_explicit(x, edges, weights, mass, step):
    """divided by the sum of the weights at the vertex instead of its mass

    told by: sum of & weights | valence | weights & instead of & mass | weights & not & mass | diagonal of L | mass & not used | mass & ignored
    """
    i, j = edges.T
    total = np.bincount(i, weights, len(x)) + np.bincount(j, weights, len(x))
    moved = per_mass(laplacian(edges, weights, len(x)) @ x, total)
    return x - step * np.where(mass[:, None] > 0, moved, 0)


def smooth_explicit(x, edges, weights, mass, step):
    """a vertex is moved in place, so later ones see the new positions of their neighbours

    told by: in place | already moved | already smoothed | new position | old position | one after | at once
    """
    y = x.astype(float)
    for v in range(len(y)):
        if mass[v] <= 0:
            continue
        pull = np.zeros(y.shape[1])
        for (i, j), w in zip(edges, weights):
            if v == i:
                pull += w * (y[v] - y[j])
            elif v == j:
                pull += w * (y[v] - y[i])
        y[v] -= step * pull / mass[v]
    return y


def smooth_implicit(x, edges, weights, mass, step):
    """the right side is x instead of M x

    told by: right side | right-hand | instead of M x | x, not M x | mass & on one side | mass & only on the left | x & not multiplied
    """
    safe = np.where(mass > 0, mass, 1)
    system = scipy.sparse.diags_array(safe) + step * laplacian(edges, weights, len(x))
    return spsolve(system.tocsc(), x.astype(float)).reshape(x.shape)


def smooth_implicit(x, edges, weights, mass, step):
    """the matrix is M - s L instead of M + s L

    told by: sign | minus | M - s L | plus | M + s L | subtract | opposite
    """
    m = np.where(mass > 0, mass, 1)
    matrix = scipy.sparse.diags_array(m) - laplacian(edges, weights, len(x)) * step
    return spsolve(scipy.sparse.csc_array(matrix), m[:, None] * x).reshape(x.shape)


def smooth_implicit(x, edges, weights, mass, step):
    """the columns of L are divided by the mass instead of its rows

    told by: column | L M^-1 | rows & mass | row & mass | neighbour & mass | wrong side of L | transpose
    """
    safe = np.where(mass > 0, mass, 1)
    dense = laplacian(edges, weights, len(x)).toarray() / safe
    return np.linalg.solve(np.eye(len(x)) + step * dense, x)


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """the second step of a round has s = +grow, so it shrinks as well

    told by: sign | minus | -grow | + grow | shrinks twice | shrinks again | both & shrink
    """
    y = x
    for _ in range(rounds):
        for amount in (shrink, grow):
            y = smooth_explicit(y, edges, weights, mass, amount)
    return y


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """the second step of a round starts from the x before the first one, which is lost

    told by: first step & lost | result of the first | before the first | starts from | shrink & no effect | shrink & lost | shrink & ignored
    """
    for _ in range(rounds):
        smaller = smooth_explicit(x, edges, weights, mass, shrink)
        larger = smooth_explicit(x, edges, weights, mass, -grow)
        x = larger
    return x


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """a round is only one of the two steps: they take turns from round to round

    told by: take turns | alternat | every other | both steps | each round & two | half as many | too few steps
    """
    for k in range(rounds):
        x = smooth_explicit(x, edges, weights, mass, shrink if k % 2 == 0 else -grow)
    return x


def enclosed_volume_backward(grad_volume, triangles):
    """the middle corner has x_0 x x_2 instead of x_2 x x_0, so its sign is turned

    told by: sign & corner | sign & x_1 | x_0 x x_2 | x_2 x x_0 | second corner | order & cross | reversed
    """
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    grad = np.stack([np.cross(b, c), np.cross(a, c), np.cross(a, b)], axis=1)
    return grad * (grad_volume / 6)


def enclosed_volume_backward(grad_volume, triangles):
    """all three corners have the face's normal (a sixth of the area vector) instead of the cross product of the other two corners

    told by: normal | area vector | same at all | same for all | all corners alike | other two | sides
    """
    grad = np.zeros(triangles.shape)
    for f in range(len(triangles)):
        grad[f] = grad_volume * area_vectors(triangles[f]) / 6
    return grad


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


def radius_ratio(triangles):
    """the 2 is left out: r / R, which is 1/2 for an equilateral triangle

    told by: r / R | half | factor 2 | 1/2 | twice | 2 is left out | 2 is missing | 0.5
    """
    length = np.linalg.norm(sides(triangles)[0], axis=-1)
    a, b, c = length[..., 0], length[..., 1], length[..., 2]
    area = np.linalg.norm(area_vectors(triangles), axis=-1) / 2
    r = 2 * area / np.where(a + b + c > 0, a + b + c, 1)
    product = a * b * c
    return r * 4 * area / np.where(product > 0, product, 1)


def cotangents(triangles):
    """the tangent instead of the cotangent: |p x q| / p . q

    told by: tangent instead | tan instead | reciprocal | upside down | inverted | 1 / cot | numerator | fraction | it is the tangent
    """
    p, q = sides(triangles)
    twice_area = np.linalg.norm(area_vectors(triangles), axis=-1, keepdims=True)
    flat = twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    dot = (p * q).sum(-1)
    return np.where(flat, 0, twice_area / np.where(dot == 0, 1, dot))


def cotangents(triangles):
    """the cosine: divided by the lengths |p| |q| instead of |p x q|

    told by: cosine | lengths of the sides | product of the lengths | cos instead | divided by the lengths
    """
    p, q = sides(triangles)
    twice_area = np.linalg.norm(area_vectors(triangles), axis=-1, keepdims=True)
    flat = twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    product = np.linalg.norm(p, axis=-1) * np.linalg.norm(q, axis=-1)
    return np.where(flat, 0, (p * q).sum(-1) / np.where(product > 0, product, 1))


def cotangents(triangles):
    """divides by the area instead of twice the area: all cotangents are doubled

    told by: area instead of twice | doubled | twice as | twice too | factor 2 | factor of 2 | area is halved | times 2 | half the denominator
    """
    p, q = sides(triangles)
    area = np.linalg.norm(area_vectors(triangles), axis=-1) / 2
    flat = 2 * area <= NO_AREA * (p**2).sum(-1).max(-1)
    result = np.zeros(p.shape[:-1])
    for k in range(3):
        dot = (p[..., k, :] * q[..., k, :]).sum(-1)
        result[..., k] = np.where(flat, 0, dot / np.where(flat, 1, area))
    return result


def cotangents(triangles):
    """flat triangles are not caught: division by a zero area gives inf or nan (fine print)

    told by: is inf | inf or nan | nan | divi & zero | divi & by 0 | NO_AREA | without area | degenerate
    """
    p, q = sides(triangles)
    cross = np.linalg.norm(np.cross(p, q), axis=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return (p * q).sum(-1) / cross


def cotangents_backward(grad_cotangents, triangles):
    """the area is held constant: the derivative of |p x q| is left out

    told by: area is & constant | area & held | area & fixed | denominator | quotient rule | change of the area | derivative of the area | by_s
    """
    p, q = sides(triangles)
    s = np.linalg.norm(area_vectors(triangles), axis=-1)[..., None, None]
    flat = s <= NO_AREA * (p**2).sum(-1).max(-1)[..., None, None]
    g = np.where(flat, 0, grad_cotangents[..., None] / np.where(flat, 1, s))
    grad_p, grad_q = g * q, g * p
    return np.roll(grad_p, 1, -2) + np.roll(grad_q, 2, -2) - grad_p - grad_q


def laplacian_energy(x, edges, weights, mass):
    """divides by the mass squared: the square of M^-1 L x is summed

    told by: mass squared | m^2 | squared mass | mass & twice | square of the mass | mass is squared | M^-1 L x | m_i^2
    """
    y = per_mass(laplacian(edges, weights, len(x)) @ x, mass)
    return (y**2).sum()


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """grad_mass has no minus sign

    told by: grad_mass & sign | grad_mass & minus | mass & sign | mass & minus | mass & negative | -1 / m
    """
    L = laplacian(edges, weights, len(x))
    y = L @ x
    z = per_mass(y, mass)
    i, j = edges[:, 0], edges[:, 1]
    grad_y = 2 * grad_energy * z
    grad_weights = ((grad_y[i] - grad_y[j]) * (x[i] - x[j])).sum(1)
    return L @ grad_y, grad_weights, grad_energy * (z**2).sum(1)


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """grad_weights has only row i of each edge: row j is left out

    told by: row j | row i | both ends | one end | other end | symmetric | z_j | grad_y[j] | second vertex | w_ij & both
    """
    L = laplacian(edges, weights, len(x))
    z = per_mass(L @ x, mass)
    grad_y = 2 * grad_energy * z
    grad_weights = np.zeros(len(edges))
    for e, (i, j) in enumerate(edges):
        grad_weights[e] = grad_y[i] @ (x[i] - x[j])
    return L @ grad_y, grad_weights, -grad_energy * (z**2).sum(1)


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """the factor 2 of the square is left out in grad_x and grad_weights

    told by: factor 2 | half | twice | 1/2 | 2 is missing | 2 is left out | derivative of a square | derivative of the square
    """
    L = laplacian(edges, weights, len(x))
    i, j = edges.T
    z = per_mass(L @ x, mass)
    grad_y = grad_energy * z
    grad_weights = ((grad_y[i] - grad_y[j]) * (x[i] - x[j])).sum(1)
    return L @ grad_y, grad_weights, -grad_energy * (z * z).sum(1)


def smooth_explicit(x, edges, weights, mass, step):
    """multiplies by the mass instead of dividing by it

    told by: multipl & mass | M L x | times the mass | instead of dividing | M instead of M^-1 | divi & instead
    """
    y = laplacian(edges, weights, len(x)) @ x
    return x - step * mass[:, None] * y


def smooth_implicit(x, edges, weights, mass, step):
    """the right-hand side is x instead of M x

    told by: right-hand side | right side | M times x | x instead of M x | mass & right
    """
    mass = np.where(mass > 0, mass, 1)
    matrix = scipy.sparse.diags_array(mass) + step * laplacian(edges, weights, len(x))
    return spsolve(matrix.tocsc(), x).reshape(x.shape)


def smooth_implicit(x, edges, weights, mass, step):
    """the step is left out of the matrix: M + L

    told by: step & left out | M + L | step & ignored | step & missing | s = 1 | step & not used | whatever the step
    """
    mass = np.where(mass > 0, mass, 1)
    matrix = scipy.sparse.diags_array(mass) + laplacian(edges, weights, len(x))
    return spsolve(matrix.tocsc(), mass[:, None] * x).reshape(x.shape)


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """shrink and grow are exchanged

    told by: exchang | swap | mixed up | grow & shrink & other
    """
    for k in range(2 * rounds):
        step = -shrink if k % 2 else grow
        x = smooth_explicit(x, edges, weights, mass, step)
    return x


def enclosed_volume_backward(grad_volume, triangles):
    """the 1/6 is left out

    told by: 1/6 | sixth | / 6 | six times | 6 times | factor 6 | divided by 6 | divided by six | 6 too
    """
    a, b, c = triangles.swapaxes(0, 1)
    return grad_volume * np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], 1)


def enclosed_volume_backward(grad_volume, triangles):
    """all three corners get a third of the normal, as if every triangle moved as a whole

    told by: face normal | triangle's normal | third of the normal | all three corners | same gradient | area vector | same for all | moved as a whole
    """
    normal = area_vectors(triangles)
    return np.repeat(grad_volume * normal[:, None] / 18, 3, axis=1)


def enclosed_volume_backward(grad_volume, triangles):
    """only the first corner has a gradient: x_1 and x_2 in the cross product are taken as constants

    told by: only & first corner | only one corner | x_1 and x_2 | other corners | two corners | as constant | other two | product rule
    """
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    grad = np.zeros_like(triangles)
    grad[:, 0] = grad_volume * np.cross(b, c) / 6
    return grad


def large_step(x, grad_x, mean, square, step, rate, spread):
    """the step is made in x with the smoothed gradient, not in u, so the second smoothing is missing

    told by: made in x | step in x | instead of u | not in u | u is never | second precondition | second smoothing | preconditioned once | only once | back from u | back to x
    """
    smooth_grad = precondition(grad_x, *spread)
    x, mean, square = uniform_adam_step(x, smooth_grad, mean, square, step, rate)
    return x, mean, square


def large_step(x, grad_x, mean, square, step, rate, spread):
    """lambda is left out of u: (I + L) x

    told by: lambda | amount | I + L
    """
    edges, weights, amount = spread
    u = x + laplacian(edges, weights, len(x)) @ x
    grad_u = precondition(grad_x, edges, weights, amount)
    u, mean, square = uniform_adam_step(u, grad_u, mean, square, step, rate)
    return precondition(u, edges, weights, amount), mean, square
