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
    """the angles are those of the next corner"""
    p, q = sides(np.roll(triangles, -1, -2))
    return np.arctan2(np.linalg.norm(np.cross(p, q), axis=-1), (p * q).sum(-1))


def radius_ratio(triangles):
    """the factor 2 of q = 2 r / R is missing"""
    p, q = sides(triangles)
    length = np.linalg.norm(p, axis=-1)
    twice_area = np.linalg.norm(np.cross(p, q)[..., 0, :], axis=-1)
    below = length.prod(-1) * length.sum(-1)
    return 2 * twice_area**2 / np.where(below > 0, below, 1)


def radius_ratio(triangles):
    """twice the area is taken for the area"""
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


def cotangents(triangles):
    """it is divided by the area; the cross product is twice that"""
    p, q = sides(triangles)
    twice_area = np.linalg.norm(np.cross(p, q)[..., :1, :], axis=-1)
    flat = twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    return np.where(flat, 0, (p * q).sum(-1) / np.where(flat, 1, twice_area / 2))


def cotangents(triangles):
    """the sign is lost: of an obtuse angle it is negative"""
    p, q = sides(triangles)
    twice_area = np.linalg.norm(np.cross(p, q)[..., :1, :], axis=-1)
    flat = twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    return np.where(flat, 0, np.abs((p * q).sum(-1)) / np.where(flat, 1, twice_area))


def cotangents(triangles):
    """the angles are those of the next corner"""
    p, q = sides(np.roll(triangles, -1, -2))
    twice_area = np.linalg.norm(np.cross(p, q)[..., :1, :], axis=-1)
    flat = twice_area <= NO_AREA * (p**2).sum(-1).max(-1, keepdims=True)
    return np.where(flat, 0, (p * q).sum(-1) / np.where(flat, 1, twice_area))


def cotangents_backward(grad_cotangents, triangles):
    """the area's part has the wrong sign: a cotangent falls where the area grows"""
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
    """the corner itself has no part in its two sides"""
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
    """the derivative of p . q by p is q, not p"""
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


def laplacian_entries(edges, weights, vertex_count):
    """it is -L: the diagonal is positive"""
    i, j = edges.T
    rows, columns = np.concatenate([i, j, i, j]), np.concatenate([j, i, i, j])
    return rows, columns, np.concatenate([weights, weights, -weights, -weights])


def laplacian_entries(edges, weights, vertex_count):
    """the diagonal is missing: rows must add up to 0"""
    i, j = edges.T
    rows, columns = np.concatenate([i, j, i, j]), np.concatenate([j, i, i, j])
    return rows, columns, np.concatenate([-weights, -weights, 0 * weights, 0 * weights])


def laplacian_entries(edges, weights, vertex_count):
    """the edge from j to i is missing: L is symmetric"""
    i, j = edges.T
    rows, columns = np.concatenate([i, j, i, j]), np.concatenate([j, i, i, j])
    return rows, columns, np.concatenate([-weights, 0 * weights, weights, weights])


def laplacian_energy(x, edges, weights, mass):
    """the mass is left out"""
    y = laplacian(edges, weights, len(x)) @ x
    return (y * y).sum()


def laplacian_energy(x, edges, weights, mass):
    """it is the mean over vertices and channels instead of the sum"""
    y = laplacian(edges, weights, len(x)) @ x
    return (y * per_mass(y, mass)).mean()


def laplacian_energy(x, edges, weights, mass):
    """it is multiplied by the mass instead of divided"""
    y = laplacian(edges, weights, len(x)) @ x
    return (y**2 * mass[:, None]).sum()


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """L is applied once; the gradient goes through it again"""
    L, (i, j) = laplacian(edges, weights, len(x)), edges.T
    z = per_mass(L @ x, mass)
    grad_y = 2 * grad_energy * z
    grad_weights = ((grad_y[i] - grad_y[j]) * (x[i] - x[j])).sum(1)
    return grad_y, grad_weights, -grad_energy * (z**2).sum(1)


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """the 2 of the square is missing"""
    L, (i, j) = laplacian(edges, weights, len(x)), edges.T
    z = per_mass(L @ x, mass)
    grad_y = grad_energy * z
    grad_weights = ((grad_y[i] - grad_y[j]) * (x[i] - x[j])).sum(1)
    return L @ grad_y, grad_weights, -grad_energy * (z**2).sum(1)


def laplacian_energy_backward(grad_energy, x, edges, weights, mass):
    """the gradient by the mass has the wrong sign"""
    L, (i, j) = laplacian(edges, weights, len(x)), edges.T
    z = per_mass(L @ x, mass)
    grad_y = 2 * grad_energy * z
    grad_weights = ((grad_y[i] - grad_y[j]) * (x[i] - x[j])).sum(1)
    return L @ grad_y, grad_weights, grad_energy * (z**2).sum(1)


def smooth_explicit(x, edges, weights, mass, step):
    """the sign is wrong: the surface gets rougher"""
    return x + step * per_mass(laplacian(edges, weights, len(x)) @ x, mass)


def smooth_explicit(x, edges, weights, mass, step):
    """it is not divided by the mass"""
    return x - step * laplacian(edges, weights, len(x)) @ x


def smooth_explicit(x, edges, weights, mass, step):
    """the step is left out"""
    return x - per_mass(laplacian(edges, weights, len(x)) @ x, mass)


def smooth_implicit(x, edges, weights, mass, step):
    """x is not multiplied by the mass on the right"""
    mass = np.where(mass > 0, mass, 1)
    system = scipy.sparse.diags_array(mass) + step * laplacian(edges, weights, len(x))
    return spsolve(system.tocsc(), x).reshape(x.shape)


def smooth_implicit(x, edges, weights, mass, step):
    """the sign of L is wrong: the surface gets rougher"""
    mass = np.where(mass > 0, mass, 1)
    system = scipy.sparse.diags_array(mass) - step * laplacian(edges, weights, len(x))
    return spsolve(system.tocsc(), mass[:, None] * x).reshape(x.shape)


def smooth_implicit(x, edges, weights, mass, step):
    """the step is left out"""
    mass = np.where(mass > 0, mass, 1)
    system = scipy.sparse.diags_array(mass) + laplacian(edges, weights, len(x))
    return spsolve(system.tocsc(), mass[:, None] * x).reshape(x.shape)


def smooth_taubin(x, edges, weights, mass, shrink, grow, rounds):
    """both steps shrink; the second goes the other way"""
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
    """nothing grows again: the step back is missing"""
    for _ in range(rounds):
        x = smooth_explicit(x, edges, weights, mass, shrink)
    return x


def enclosed_volume_backward(grad_volume, triangles):
    """the cross product is turned round"""
    return grad_volume * np.cross(np.roll(triangles, -2, 1), np.roll(triangles, -1, 1)) / 6


def enclosed_volume_backward(grad_volume, triangles):
    """the sixth is missing"""
    return grad_volume * np.cross(np.roll(triangles, -1, 1), np.roll(triangles, -2, 1))


def enclosed_volume_backward(grad_volume, triangles):
    """grad_volume is left out"""
    return np.cross(np.roll(triangles, -1, 1), np.roll(triangles, -2, 1)) / 6


def large_step(x, grad_x, mean, square, step, rate, spread):
    """x itself is smoothed: x is taken for u, and then for x again"""
    edges, weights, amount = spread
    u = x
    grad_u = precondition(grad_x, edges, weights, amount)
    u, mean, square = uniform_adam_step(u, grad_u, mean, square, step, rate)
    return precondition(u, edges, weights, amount), mean, square


def large_step(x, grad_x, mean, square, step, rate, spread):
    """the gradient is not spread out: it is the one by x"""
    edges, weights, amount = spread
    u = x + amount * laplacian(edges, weights, len(x)) @ x
    grad_u = grad_x
    u, mean, square = uniform_adam_step(u, grad_u, mean, square, step, rate)
    return precondition(u, edges, weights, amount), mean, square


def large_step(x, grad_x, mean, square, step, rate, spread):
    """u is returned instead of x"""
    edges, weights, amount = spread
    u = x + amount * laplacian(edges, weights, len(x)) @ x
    grad_u = precondition(grad_x, edges, weights, amount)
    u, mean, square = uniform_adam_step(u, grad_u, mean, square, step, rate)
    return u, mean, square
