"""Mistakes of lab 13; each docstring goes on after "this is what comes out when"."""


def corner_angles(triangles):
    """angles are in degrees; they are radians"""
    p, q = sides(triangles)
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(p, q), axis=-1), (p * q).sum(-1)))


def corner_angles(triangles):
    """it is an arccos: a tiny angle loses half of its digits, and a corner that coincides with
    another has a right angle"""
    p, q = sides(triangles)
    return np.arccos(np.clip((unit(p) * unit(q)).sum(-1), -1, 1))


def corner_angles(triangles):
    """the angle at the next corner, k + 1, stands at corner k"""
    p, q = sides(np.roll(triangles, -1, -2))
    return np.arctan2(np.linalg.norm(np.cross(p, q), axis=-1), (p * q).sum(-1))


def corner_angles(triangles):
    """an arctan of the quotient is taken: it gives an obtuse angle as a negative one, which arctan2
    does not"""
    p, q = sides(triangles)
    with np.errstate(all="ignore"):
        return np.arctan(twice_areas(triangles)[..., None] / (p * q).sum(-1))


def corner_angles(triangles):
    """it is the angle outside, pi minus the one at the corner: the sides go round the triangle, and
    do not both start at the corner"""
    p, q = sides(triangles)
    return np.arctan2(twice_areas(triangles)[..., None], -(p * q).sum(-1))


def radius_ratio(triangles):
    """the factor 2 of q = 2 r / R, or that of r = 2 A / (a + b + c), is missing"""
    p, q = sides(triangles)
    length = np.linalg.norm(p, axis=-1)
    twice_area = np.linalg.norm(np.cross(p, q)[..., 0, :], axis=-1)
    below = length.prod(-1) * length.sum(-1)
    return 2 * twice_area**2 / np.where(below > 0, below, 1)


def radius_ratio(triangles):
    """twice the area is taken for the area: `area_vectors` are as long as twice the area"""
    p, q = sides(triangles)
    length = np.linalg.norm(p, axis=-1)
    twice_area = np.linalg.norm(np.cross(p, q)[..., 0, :], axis=-1)
    below = length.prod(-1) * length.sum(-1)
    return 16 * twice_area**2 / np.where(below > 0, below, 1)


def radius_ratio(triangles):
    """where corners coincide, 0 is divided by 0"""
    p, q = sides(triangles)
    length = np.linalg.norm(p, axis=-1)
    twice_area = np.linalg.norm(np.cross(p, q)[..., 0, :], axis=-1)
    below = length.prod(-1) * length.sum(-1)
    return 4 * twice_area**2 / below


def radius_ratio(triangles):
    """it is turned over: R / r instead of r / R"""
    p, q = sides(triangles)
    length = np.linalg.norm(p, axis=-1)
    twice_area = np.linalg.norm(np.cross(p, q)[..., 0, :], axis=-1)
    with np.errstate(all="ignore"):
        return length.prod(-1) * length.sum(-1) / (4 * twice_area**2)


def cotangents(triangles):
    """it is divided by the area instead of twice the area, the length of the cross product"""
    p, q = sides(triangles)
    twice_area = np.linalg.norm(np.cross(p, q)[..., :1, :], axis=-1)
    flat = twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    return np.where(flat, 0, (p * q).sum(-1) / np.where(flat, 1, twice_area / 2))


def cotangents(triangles):
    """the sign is lost: an obtuse angle has a negative cotangent"""
    p, q = sides(triangles)
    twice_area = np.linalg.norm(np.cross(p, q)[..., :1, :], axis=-1)
    flat = twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    return np.where(flat, 0, np.abs((p * q).sum(-1)) / np.where(flat, 1, twice_area))


def cotangents(triangles):
    """the cotangent at the next corner, k + 1, stands at corner k"""
    p, q = sides(np.roll(triangles, -1, -2))
    twice_area = np.linalg.norm(np.cross(p, q)[..., :1, :], axis=-1)
    flat = twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    return np.where(flat, 0, (p * q).sum(-1) / np.where(flat, 1, twice_area))


def cotangents(triangles):
    """all signs are wrong: the sides go round the triangle, so it is the angle outside; both sides
    must start at the corner"""
    p, q = sides(triangles)
    twice_area = np.linalg.norm(np.cross(p, q)[..., :1, :], axis=-1)
    flat = twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    return np.where(flat, 0, -(p * q).sum(-1) / np.where(flat, 1, twice_area))


def cotangents(triangles):
    """it is the cosine: p . q is divided by both lengths instead of by |p x q|"""
    p, q = sides(triangles)
    length = np.linalg.norm(p, axis=-1) * np.linalg.norm(q, axis=-1)
    twice_area = np.linalg.norm(np.cross(p, q)[..., :1, :], axis=-1)
    flat = twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    return np.where(flat, 0, (p * q).sum(-1) / np.where(flat, 1, length))


def cotangents(triangles):
    """it is the tangent, 1 over the cotangent: |p x q| is divided by p . q"""
    p, q = sides(triangles)
    twice_area = np.linalg.norm(np.cross(p, q)[..., :1, :], axis=-1)
    flat = twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    with np.errstate(all="ignore"):
        return np.where(flat, 0, twice_area / (p * q).sum(-1))


def cotangents_backward(grad_cotangents, triangles):
    """the area's part has the wrong sign: a positive cotangent falls where the area grows"""
    p, q = sides(triangles)
    area_vector = np.cross(p, q)[..., :1, :]
    s = np.linalg.norm(area_vector, axis=-1, keepdims=True)
    flat = s <= NO_AREA * (p**2).sum(-1).max(-1)[..., None, None]
    s = np.where(flat, 1, s)
    by_dot = np.where(flat, 0, grad_cotangents[..., None] / s)
    by_p, by_q = by_dot * q, by_dot * p
    by_s = (by_dot * (p * q).sum(-1, keepdims=True)).sum(-2, keepdims=True) / s
    return (np.roll(by_p, 1, -2) + np.roll(by_q, 2, -2) - by_p - by_q
            + by_s * np.cross(area_vector / s, q - p))


def cotangents_backward(grad_cotangents, triangles):
    """the corner itself, where both sides start, gets nothing: -by_p - by_q is missing"""
    p, q = sides(triangles)
    area_vector = np.cross(p, q)[..., :1, :]
    s = np.linalg.norm(area_vector, axis=-1, keepdims=True)
    flat = s <= NO_AREA * (p**2).sum(-1).max(-1)[..., None, None]
    s = np.where(flat, 1, s)
    by_dot = np.where(flat, 0, grad_cotangents[..., None] / s)
    by_p, by_q = by_dot * q, by_dot * p
    by_s = -(by_dot * (p * q).sum(-1, keepdims=True)).sum(-2, keepdims=True) / s
    return (np.roll(by_p, 1, -2) + np.roll(by_q, 2, -2)
            + by_s * np.cross(area_vector / s, q - p))


def cotangents_backward(grad_cotangents, triangles):
    """by_p and by_q are exchanged: the derivative of p . q by p is q, and p ends at the next
    corner, k + 1"""
    p, q = sides(triangles)
    area_vector = np.cross(p, q)[..., :1, :]
    s = np.linalg.norm(area_vector, axis=-1, keepdims=True)
    flat = s <= NO_AREA * (p**2).sum(-1).max(-1)[..., None, None]
    s = np.where(flat, 1, s)
    by_dot = np.where(flat, 0, grad_cotangents[..., None] / s)
    by_p, by_q = by_dot * p, by_dot * q
    by_s = -(by_dot * (p * q).sum(-1, keepdims=True)).sum(-2, keepdims=True) / s
    return (np.roll(by_p, 1, -2) + np.roll(by_q, 2, -2) - by_p - by_q
            + by_s * np.cross(area_vector / s, q - p))


def cotangents_backward(grad_cotangents, triangles):
    """the area is held fixed: it grows, too, when a corner moves, and the cotangents are divided
    by it"""
    p, q = sides(triangles)
    s = np.linalg.norm(np.cross(p, q)[..., :1, :], axis=-1, keepdims=True)
    flat = s <= NO_AREA * (p**2).sum(-1).max(-1)[..., None, None]
    by_dot = np.where(flat, 0, grad_cotangents[..., None] / np.where(flat, 1, s))
    by_p, by_q = by_dot * q, by_dot * p
    return np.roll(by_p, 1, -2) + np.roll(by_q, 2, -2) - by_p - by_q


def laplacian_entries(edges, weights, vertex_count):
    """all signs are wrong: this is -L; in L the diagonal is positive"""
    i, j = edges.T
    rows, columns = np.concatenate([i, j, i, j]), np.concatenate([j, i, i, j])
    return rows, columns, np.concatenate([weights, weights, -weights, -weights])


def laplacian_entries(edges, weights, vertex_count):
    """the diagonal is left out: rows must add up to 0"""
    i, j = edges.T
    rows, columns = np.concatenate([i, j, i, j]), np.concatenate([j, i, i, j])
    return rows, columns, np.concatenate([-weights, -weights, 0 * weights, 0 * weights])


def laplacian_entries(edges, weights, vertex_count):
    """each edge is entered in one direction only: the entry from j to i is missing, and L must be
    symmetric"""
    i, j = edges.T
    rows, columns = np.concatenate([i, j, i, j]), np.concatenate([j, i, i, j])
    return rows, columns, np.concatenate([-weights, 0 * weights, weights, weights])


def laplacian_entries(edges, weights, vertex_count):
    """the diagonal is the valence, the number of edges, instead of the sum of the weights"""
    i, j = edges.T
    rows, columns = np.concatenate([i, j, i, j]), np.concatenate([j, i, i, j])
    ones = np.ones(len(edges))
    return rows, columns, np.concatenate([-weights, -weights, ones, ones])


def laplacian_entries(edges, weights, vertex_count):
    """+= adds only one edge where an index is repeated, as in diagonal[i] += weights; np.add.at
    adds each time"""
    i, j = edges.T
    diagonal, every = np.zeros(vertex_count), np.arange(vertex_count)
    diagonal[i] += weights
    diagonal[j] += weights
    return (np.concatenate([i, j, every]), np.concatenate([j, i, every]),
            np.concatenate([-weights, -weights, diagonal]))


def laplacian_entries(edges, weights, vertex_count):
    """rows are divided by their diagonal, the sum of the weights: it is M^-1 L, which is not
    symmetric, and not L"""
    i, j = edges.T
    total = np.bincount(edges.ravel(), np.repeat(weights, 2), vertex_count)
    rows, columns = np.concatenate([i, j, i, j]), np.concatenate([j, i, i, j])
    return rows, columns, np.concatenate([-weights, -weights, weights, weights]) / total[rows]


def laplacian_energy(x, edges, weights, mass):
    """the mass is left out: |L x|^2 is not divided by it"""
    y = laplacian(edges, weights, len(x)) @ x
    return (y * y).sum()


def laplacian_energy(x, edges, weights, mass):
    """the mass is squared: M^-1 L x is squared, and divided by the mass twice"""
    return (per_mass(laplacian(edges, weights, len(x)) @ x, mass)**2).sum()


def laplacian_energy(x, edges, weights, mass):
    """it is the mean over vertices and channels instead of the sum"""
    y = laplacian(edges, weights, len(x)) @ x
    return (y * per_mass(y, mass)).mean()


def laplacian_energy(x, edges, weights, mass):
    """|L x|^2 is multiplied by the mass instead of divided by it"""
    y = laplacian(edges, weights, len(x)) @ x
    return (y**2 * mass[:, None]).sum()


def laplacian_energy(x, edges, weights, mass):
    """it is x . L x, the weighted squares of the differences along the edges (the Dirichlet
    energy): L x itself is not squared"""
    return (x * (laplacian(edges, weights, len(x)) @ x)).sum()


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """L is applied once in grad_x: the gradient must go back through L, too"""
    L, (i, j) = laplacian(edges, weights, len(x)), edges.T
    z = per_mass(L @ x, mass)
    grad_y = 2 * grad_energy * z
    grad_weights = ((grad_y[i] - grad_y[j]) * (x[i] - x[j])).sum(1)
    return grad_y, grad_weights, -grad_energy * (z**2).sum(1)


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """the factor 2, the derivative of the square, is missing in grad_x and grad_weights"""
    L, (i, j) = laplacian(edges, weights, len(x)), edges.T
    z = per_mass(L @ x, mass)
    grad_y = grad_energy * z
    grad_weights = ((grad_y[i] - grad_y[j]) * (x[i] - x[j])).sum(1)
    return L @ grad_y, grad_weights, -grad_energy * (z**2).sum(1)


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """grad_mass has the wrong sign: more mass makes the energy smaller"""
    L, (i, j) = laplacian(edges, weights, len(x)), edges.T
    z = per_mass(L @ x, mass)
    grad_y = 2 * grad_energy * z
    grad_weights = ((grad_y[i] - grad_y[j]) * (x[i] - x[j])).sum(1)
    return L @ grad_y, grad_weights, grad_energy * (z**2).sum(1)


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """grad_energy is left out"""
    L, (i, j) = laplacian(edges, weights, len(x)), edges.T
    z = per_mass(L @ x, mass)
    grad_y = 2 * z
    grad_weights = ((grad_y[i] - grad_y[j]) * (x[i] - x[j])).sum(1)
    return L @ grad_y, grad_weights, -(z**2).sum(1)


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """grad_weights has the part of one end of each edge only, z_i: that of the other end, -z_j, is
    missing"""
    L, (i, j) = laplacian(edges, weights, len(x)), edges.T
    z = per_mass(L @ x, mass)
    grad_y = 2 * grad_energy * z
    grad_weights = (grad_y[i] * (x[i] - x[j])).sum(1)
    return L @ grad_y, grad_weights, -grad_energy * (z**2).sum(1)


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """grad_mass is divided by the mass once only; the derivative of 1 / m is -1 / m^2"""
    L, (i, j) = laplacian(edges, weights, len(x)), edges.T
    y = L @ x
    z = per_mass(y, mass)
    grad_y = 2 * grad_energy * z
    grad_weights = ((grad_y[i] - grad_y[j]) * (x[i] - x[j])).sum(1)
    return L @ grad_y, grad_weights, -grad_energy * (y * z).sum(1)


def smooth_explicit(x, edges, weights, mass, step):
    """the sign is wrong: L x is added instead of subtracted, which moves x away from its
    neighbours"""
    return x + step * per_mass(laplacian(edges, weights, len(x)) @ x, mass)


def smooth_explicit(x, edges, weights, mass, step):
    """the mass is left out: L x is not divided by it"""
    return x - step * laplacian(edges, weights, len(x)) @ x


def smooth_explicit(x, edges, weights, mass, step):
    """the step s is left out"""
    return x - per_mass(laplacian(edges, weights, len(x)) @ x, mass)


def smooth_explicit(x, edges, weights, mass, step):
    """L x is multiplied by the mass instead of divided by it"""
    return x - step * mass[:, None] * (laplacian(edges, weights, len(x)) @ x)


def smooth_explicit(x, edges, weights, mass, step):
    """only the move is returned: x is left out"""
    return -step * per_mass(laplacian(edges, weights, len(x)) @ x, mass)


def smooth_explicit(x, edges, weights, mass, step):
    """vertices move one after another, and see neighbours that have moved already; all must move at
    the same time, from the old places"""
    new, L = x.astype(float), laplacian(edges, weights, len(x)).toarray()
    for i in range(len(new)):
        if mass[i] > 0:
            new[i] -= step * (L[i] @ new) / mass[i]
    return new


def smooth_implicit(x, edges, weights, mass, step):
    """the mass is missing on the right: (M + s L) x' = x instead of M x"""
    mass = np.where(mass > 0, mass, 1)
    system = scipy.sparse.diags_array(mass) + step * laplacian(edges, weights, len(x))
    return spsolve(system.tocsc(), x).reshape(x.shape)


def smooth_implicit(x, edges, weights, mass, step):
    """the sign of L is wrong: it is M - s L instead of M + s L"""
    mass = np.where(mass > 0, mass, 1)
    system = scipy.sparse.diags_array(mass) - step * laplacian(edges, weights, len(x))
    return spsolve(system.tocsc(), mass[:, None] * x).reshape(x.shape)


def smooth_implicit(x, edges, weights, mass, step):
    """the step s is left out: it is M + L"""
    mass = np.where(mass > 0, mass, 1)
    system = scipy.sparse.diags_array(mass) + laplacian(edges, weights, len(x))
    return spsolve(system.tocsc(), mass[:, None] * x).reshape(x.shape)


def smooth_implicit(x, edges, weights, mass, step):
    """the mass is ignored on both sides: it is I + s L, as in (10), instead of M + s L"""
    system = scipy.sparse.eye_array(len(x)) + step * laplacian(edges, weights, len(x))
    return spsolve(system.tocsc(), x).reshape(x.shape)


def smooth_implicit(x, edges, weights, mass, step):
    """it is an explicit step, equation (5): no system is solved"""
    return x - step * per_mass(laplacian(edges, weights, len(x)) @ x, mass)


def smooth_implicit(x, edges, weights, mass, step):
    """the mass is missing on the left: it is I + s L instead of M + s L, and M x on the right"""
    mass = np.where(mass > 0, mass, 1)
    system = scipy.sparse.eye_array(len(x)) + step * laplacian(edges, weights, len(x))
    return spsolve(system.tocsc(), mass[:, None] * x).reshape(x.shape)


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """both steps shrink: the minus sign of the second step, s = -grow, is missing"""
    for _ in range(rounds):
        x = smooth_explicit(x, edges, weights, mass, shrink)
        x = smooth_explicit(x, edges, weights, mass, grow)
    return x


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """shrink and grow are swapped"""
    for _ in range(rounds):
        x = smooth_explicit(x, edges, weights, mass, grow)
        x = smooth_explicit(x, edges, weights, mass, -shrink)
    return x


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """the second step, with s = -grow, is missing: the surface only shrinks"""
    for _ in range(rounds):
        x = smooth_explicit(x, edges, weights, mass, shrink)
    return x


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """both steps start from the same x, which makes one step of shrink - grow: the second one must
    see the result of the first"""
    for _ in range(rounds):
        smoothed = smooth_explicit(x, edges, weights, mass, shrink)
        x = x + (smoothed - x) + (smooth_explicit(x, edges, weights, mass, -grow) - x)
    return x


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """only one round is made: return stands inside the loop, rounds is ignored, or each round
    starts from the first x again"""
    for _ in range(min(rounds, 1)):
        x = smooth_explicit(x, edges, weights, mass, shrink)
        x = smooth_explicit(x, edges, weights, mass, -grow)
    return x


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """grow is added to shrink: the second step is s = -(shrink + grow) instead of -grow"""
    for _ in range(rounds):
        x = smooth_explicit(x, edges, weights, mass, shrink)
        x = smooth_explicit(x, edges, weights, mass, -(shrink + grow))
    return x


def enclosed_volume_backward(grad_volume, triangles):
    """the factors of the cross products are exchanged, so all signs are flipped"""
    return grad_volume * np.cross(np.roll(triangles, -2, 1), np.roll(triangles, -1, 1)) / 6


def enclosed_volume_backward(grad_volume, triangles):
    """the 1/6 is missing"""
    return grad_volume * np.cross(np.roll(triangles, -1, 1), np.roll(triangles, -2, 1))


def enclosed_volume_backward(grad_volume, triangles):
    """grad_volume is not multiplied in"""
    return np.cross(np.roll(triangles, -1, 1), np.roll(triangles, -2, 1)) / 6


def enclosed_volume_backward(grad_volume, triangles):
    """the sign at the middle corner is wrong: it has x_2 x x_0, and not x_0 x x_2"""
    x0, x1, x2 = triangles.swapaxes(0, 1)
    return grad_volume * np.stack([np.cross(x1, x2), np.cross(x0, x2), np.cross(x0, x1)], 1) / 6


def enclosed_volume_backward(grad_volume, triangles):
    """each corner has a third of the face's area vector, the cross product of sides and not of
    corners: so it is for whole closed surfaces, and not for the corners of a triangle"""
    return grad_volume * np.repeat(area_vectors(triangles)[:, None], 3, 1) / 6


def enclosed_volume_backward(grad_volume, triangles):
    """a corner has the gradient of another one; that of x_0 is x_1 x x_2, and so on around"""
    return grad_volume * np.cross(triangles, np.roll(triangles, -1, 1)) / 6


def large_step(x, grad_x, mean, square, step, rate, spread):
    """x is taken for u, so x itself is smoothed: u is (I + lambda L) x"""
    edges, weights, amount = spread
    u = x
    grad_u = precondition(grad_x, edges, weights, amount)
    u, mean, square = uniform_adam_step(u, grad_u, mean, square, step, rate)
    return precondition(u, edges, weights, amount), mean, square


def large_step(x, grad_x, mean, square, step, rate, spread):
    """the gradient is not spread out: grad_x goes into the step as it is, instead of grad_u"""
    edges, weights, amount = spread
    u = x + amount * laplacian(edges, weights, len(x)) @ x
    grad_u = grad_x
    u, mean, square = uniform_adam_step(u, grad_u, mean, square, step, rate)
    return precondition(u, edges, weights, amount), mean, square


def large_step(x, grad_x, mean, square, step, rate, spread):
    """u is returned instead of x: `precondition` is missing at the end"""
    edges, weights, amount = spread
    u = x + amount * laplacian(edges, weights, len(x)) @ x
    grad_u = precondition(grad_x, edges, weights, amount)
    u, mean, square = uniform_adam_step(u, grad_u, mean, square, step, rate)
    return u, mean, square


def large_step(x, grad_x, mean, square, step, rate, spread):
    """grad_x is multiplied by I + lambda L; grad_u is its product with the inverse, which
    `precondition` gives"""
    edges, weights, amount = spread
    u = x + amount * laplacian(edges, weights, len(x)) @ x
    grad_u = grad_x + amount * laplacian(edges, weights, len(x)) @ grad_x
    u, mean, square = uniform_adam_step(u, grad_u, mean, square, step, rate)
    return precondition(u, edges, weights, amount), mean, square


def large_step(x, grad_x, mean, square, step, rate, spread):
    """the step is made in x with the smoothed gradient grad_u, and not in u, and so the smoothing
    by `precondition` that leads back from u to x is missing"""
    grad_u = precondition(grad_x, *spread)
    return uniform_adam_step(x, grad_u, mean, square, step, rate)


def large_step(x, grad_x, mean, square, step, rate, spread):
    """lambda is left out of u: it is (I + L) x"""
    edges, weights, amount = spread
    u = x + laplacian(edges, weights, len(x)) @ x
    grad_u = precondition(grad_x, edges, weights, amount)
    u, mean, square = uniform_adam_step(u, grad_u, mean, square, step, rate)
    return precondition(u, edges, weights, amount), mean, square
