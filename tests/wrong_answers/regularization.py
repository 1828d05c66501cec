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


def cotangents(triangles):
    """the dot product is divided by the lengths of the two sides: this is the cosine, not the cotangent

    told by: cosine | length & of the & sides | product of the lengths | lengths of p and q | unit & sides | twice the area & length
    """
    p, q = sides(triangles)
    lengths = np.linalg.norm(p, axis=-1) * np.linalg.norm(q, axis=-1)
    return (p * q).sum(-1) / np.where(lengths > 0, lengths, 1)


def cotangents(triangles):
    """the dot product is divided by the triangle's area instead of twice the area

    told by: twice the area | twice as large | factor & 2 | factor of two | double | half & area
    """
    result = np.zeros(triangles.shape[:-1])
    for where in np.ndindex(*triangles.shape[:-2]):
        corner = triangles[where]
        area = np.linalg.norm(np.cross(corner[1] - corner[0], corner[2] - corner[0])) / 2
        longest = max(((corner[k] - corner[k - 1])**2).sum() for k in range(3))
        if 2 * area <= NO_AREA * longest:
            continue
        for k in range(3):
            u, v = corner[(k + 1) % 3] - corner[k], corner[(k + 2) % 3] - corner[k]
            result[where + (k,)] = u @ v / area
    return result


def cotangents(triangles):
    """the second side points the wrong way round the triangle, from corner k + 1 to k + 2 instead of from k to k + 2

    told by: from corner k + 1 | next corner | obtuse | around the triangle | exterior | start & same corner | both sides & start
    """
    after = np.roll(triangles, -1, -2)
    u, v = after - triangles, np.roll(triangles, -2, -2) - after
    twice = np.linalg.norm(area_vectors(triangles), axis=-1, keepdims=True)
    none = twice <= NO_AREA * (u**2).sum(-1).max(-1, keepdims=True)
    return np.where(none, 0, (u * v).sum(-1) / np.where(none, 1, twice))


def laplacian_entries(edges, weights, vertex_count):
    """the diagonal is summed up by += with repeated indices, so a vertex of many edges keeps only the last one

    told by: repeat | += | add.at | only the last | several edges | more than one edge | overwrit
    """
    i, j = edges[:, 0], edges[:, 1]
    diagonal = np.zeros(vertex_count)
    diagonal[i] += weights
    diagonal[j] += weights
    every = np.arange(vertex_count)
    return (np.concatenate([i, j, every]), np.concatenate([j, i, every]),
            np.concatenate([-weights, -weights, diagonal]))


def laplacian_entries(edges, weights, vertex_count):
    """only the row of an edge's first vertex gets entries, the second vertex's row is left out

    told by: symmetric | second vertex | other vertex | other end | both ends | both directions | first vertex
    """
    rows, columns, values = [], [], []
    for (start, end), w in zip(edges, weights):
        rows += [start, start]
        columns += [start, end]
        values += [w, -w]
    return np.array(rows, int), np.array(columns, int), np.array(values, float)


def smooth_explicit(x, edges, weights, mass, step):
    """L x is multiplied by the mass instead of divided by it

    told by: multipl & mass | divid & mass | times & mass | m^-1 | inverse & mass
    """
    return x - step * mass[:, None] * (laplacian(edges, weights, len(x)) @ x)


def smooth_explicit(x, edges, weights, mass, step):
    """the step is added: vertices go away from their neighbours, L x already is x minus the neighbours

    told by: sign | added | plus | away from | minus | opposite direction | subtract
    """
    change = np.zeros(x.shape)
    for (i, j), w in zip(edges, weights):
        change[i] += w * (x[i] - x[j])
        change[j] += w * (x[j] - x[i])
    return x + step * per_mass(change, mass)


def smooth_implicit(x, edges, weights, mass, step):
    """the right side is x, and M x is meant: the mass is on one side only

    told by: right side | right-hand | m x | multipl & mass | mass & both sides | one side
    """
    heavy = np.where(mass > 0, mass, 1)
    matrix = scipy.sparse.diags_array(heavy) + step * laplacian(edges, weights, len(x))
    return spsolve(matrix.tocsc(), x).reshape(x.shape)


def smooth_implicit(x, edges, weights, mass, step):
    """the masses are left out on both sides, I stands where M should be

    told by: without & mass | mass & left out | mass & missing | mass & ignored | masses & as 1 | mass & not used | i + s l
    """
    L = laplacian(edges, weights, len(x))
    system = (scipy.sparse.eye_array(len(x)) + step * L).tocsc()
    return np.column_stack([spsolve(system, x[:, c]) for c in range(x.shape[1])])


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """the second step has s = grow without the minus, so that it shrinks once more

    told by: -grow | sign & grow | minus & grow | second step & sign | shrinks & twice | both & shrink | sign of the second
    """
    for _ in range(rounds):
        for s in (shrink, grow):
            x = smooth_explicit(x, edges, weights, mass, s)
    return x


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """x is changed in place: the caller's array is overwritten

    told by: in place | overwrit | caller | input & chang | argument & chang | modif
    """
    for _ in range(rounds):
        for s in (shrink, -grow):
            x -= s * per_mass(laplacian(edges, weights, len(x)) @ x, mass)
    return x


def enclosed_volume_backward(grad_volume, triangles):
    """np.roll goes over the coordinates x, y, z instead of the three corners

    told by: coordinates | axis | x, y, z & corner | roll & x, y, z | roll & corner | not the corners
    """
    following = np.roll(triangles, -1, -1)
    last = np.roll(triangles, -2, -1)
    return grad_volume / 6 * np.cross(following, last)


def enclosed_volume_backward(grad_volume, triangles):
    """the two other corners are exchanged in the cross product, so every gradient has the opposite sign

    told by: sign | exchanged | swapped | order & cross | opposite | mixed up | inward
    """
    result = np.empty(triangles.shape)
    for f, (a, b, c) in enumerate(triangles):
        result[f] = np.cross(c, b), np.cross(a, c), np.cross(b, a)
    return grad_volume * result / 6


def corner_angles(triangles):
    """arcsin of the area over the sides gives an acute angle also at an obtuse corner

    told by: obtuse | arcsin | acute | above pi / 2 | more than pi / 2 | over 90 | larger than pi / 2
    """
    p, q = sides(triangles)
    length = np.linalg.norm(p, axis=-1) * np.linalg.norm(q, axis=-1)
    sine = twice_areas(triangles)[..., None] / np.where(length > 0, length, 1)
    return np.arcsin(np.clip(sine, 0, 1))


def radius_ratio(triangles):
    """the factor 2 of q = 2 r / R is left out: an equilateral triangle has 1/2

    told by: factor & 2 | half | twice | 1/2 | 2 r | factor of two
    """
    a, b, c = np.moveaxis(np.linalg.norm(sides(triangles)[0], axis=-1), -1, 0)
    area = np.linalg.norm(area_vectors(triangles), axis=-1) / 2
    r = 2 * area / (a + b + c)
    R = a * b * c / (4 * area)
    return r / R


def cotangents_backward(grad_cotangents, triangles):
    """only the dot product p . q is differentiated, the area under it is held

    told by: area & held | area & constant | denominator | quotient | only & p . q | area & chang | through the area
    """
    p, q = sides(triangles)
    s = np.linalg.norm(area_vectors(triangles), axis=-1)[..., None, None]
    none = s <= NO_AREA * (p**2).sum(-1).max(-1)[..., None, None]
    g = np.where(none, 0, grad_cotangents[..., None] / np.where(none, 1, s))
    return np.roll(g * q, 1, -2) + np.roll(g * p, 2, -2) - g * (p + q)


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """grad_weights has z_i (x_i - x_j) only: the row of the edge's second vertex is left out

    told by: z_j | second vertex | other end | both ends | other vertex | z_i - z_j | both vertices
    """
    L = laplacian(edges, weights, len(x))
    z = per_mass(L @ x, mass)
    by_weight = np.array([2 * grad_energy * z[i] @ (x[i] - x[j]) for i, j in edges])
    return 2 * grad_energy * (L @ z), by_weight, -grad_energy * (z * z).sum(1)


def large_step(x, grad_x, mean, square, step, rate, spread):
    """Adam gets grad_x instead of grad_u: the gradient is not spread by (I + lambda L)^-1

    told by: grad_u | grad_x instead | gradient & not spread | gradient & precondition | (i + lambda l)^-1 | spread & gradient | inverse & gradient
    """
    edges, weights, amount = spread
    u = x + amount * (laplacian(edges, weights, len(x)) @ x)
    u, mean, square = uniform_adam_step(u, grad_x, mean, square, step, rate)
    return precondition(u, *spread), mean, square


def smooth_explicit(x, edges, weights, mass, step):
    """all is computed in float32, which has seven digits only

    told by: float32 | single precision | seven digits | 32 bit | precision | float64
    """
    y = np.float32(x)
    L = laplacian(edges, weights, len(x)).astype(np.float32)
    return y - np.float32(step) * per_mass(L @ y, mass.astype(np.float32))
