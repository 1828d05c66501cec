"""Mistakes of lab 13; each docstring goes on after "this is what comes out when"."""


def corner_angles(triangles):
    """an arctan of the quotient is taken: it gives an obtuse angle as a negative one, which arctan2
    does not"""
    p, q = sides(triangles)
    with np.errstate(all="ignore"):
        return np.arctan(twice_areas(triangles)[..., None] / (p * q).sum(-1))


def laplacian_entries(edges, weights, vertex_count):
    """+= adds only one edge where an index is repeated, as in diagonal[i] += weights; np.add.at
    adds each time"""
    i, j = edges.T
    diagonal, every = np.zeros(vertex_count), np.arange(vertex_count)
    diagonal[i] += weights
    diagonal[j] += weights
    return (np.concatenate([i, j, every]), np.concatenate([j, i, every]),
            np.concatenate([-weights, -weights, diagonal]))


def laplacian_energy(x, edges, weights, mass):
    """the mass is squared: M^-1 L x is squared, and divided by the mass twice"""
    return (per_mass(laplacian(edges, weights, len(x)) @ x, mass)**2).sum()


def laplacian_energy(x, edges, weights, mass):
    """it is x . L x, the weighted squares of the differences along the edges (the Dirichlet
    energy): L x itself is not squared"""
    return (x * (laplacian(edges, weights, len(x)) @ x)).sum()


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
    """the mass is ignored on both sides: it is I + s L, as in (10), instead of M + s L"""
    system = scipy.sparse.eye_array(len(x)) + step * laplacian(edges, weights, len(x))
    return spsolve(system.tocsc(), x).reshape(x.shape)


def smooth_implicit(x, edges, weights, mass, step):
    """it is an explicit step, equation (5): no system is solved"""
    return x - step * per_mass(laplacian(edges, weights, len(x)) @ x, mass)


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
    """the step is made in x with the smoothed gradient grad_u, and not in u, and so the smoothing
    by `precondition` that leads back from u to x is missing"""
    grad_u = precondition(grad_x, *spread)
    return uniform_adam_step(x, grad_u, mean, square, step, rate)
