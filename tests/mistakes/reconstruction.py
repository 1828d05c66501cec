"""Mistakes of lab 16; each docstring goes on after "this is what comes out when"."""


def sh_basis(normals):
    """Y_1, Y_2, Y_3 go with x, y, z; their order is y, z, x"""
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * x, C1 * y, C1 * z, C2 * x * y, C2 * y * z,
                     C3 * (3 * z**2 - 1), C2 * x * z, C4 * (x**2 - y**2)], -1)


def sh_basis(normals):
    """Y_5 and Y_7 are exchanged: y z comes first, then x z"""
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * x * z,
                     C3 * (3 * z**2 - 1), C2 * y * z, C4 * (x**2 - y**2)], -1)


def sh_basis(normals):
    """Y_1, Y_3, Y_5 and Y_7 have a minus sign, that of the Condon-Shortley phase; eq. (1) has none
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, -C1 * y, C1 * z, -C1 * x, C2 * x * y, -C2 * y * z,
                     C3 * (3 * z**2 - 1), -C2 * x * z, C4 * (x**2 - y**2)], -1)


def distant_light(towards, strength):
    """Y_4 has the A of the linear harmonics, 2/3 pi, which are Y_1 to Y_3; that of Y_4 is pi / 4"""
    factors = np.pi * np.array([1, *[2 / 3] * 4, *[1 / 4] * 4])
    return factors[:, None] * (sh_basis(towards).T @ strength)


def shade_backward(grad_colour, albedo, normals, light):
    """the albedo is left out of the gradients with respect to the normals and the light:
    grad_colour goes on without it
    """
    basis = sh_basis(normals)
    return (grad_colour * (basis @ light), sh_basis_backward(grad_colour @ light.T, normals),
            basis.T @ grad_colour)


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


def vertex_normals_backward(grad_normals, vertices, faces):
    """m is a sum of unit normals: faces are not weighted by their area, as they are in eq. (4)"""
    a, b, c = vertices[faces.T]
    m = np.cross(b - a, c - a)
    m = m / np.linalg.norm(m, axis=1, keepdims=True)
    m = scatter(np.repeat(m[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    length = np.where(length > 0, length, np.inf)
    n = m / length
    grad_m = (grad_normals - (grad_normals * n).sum(1, keepdims=True) * n) / length
    g = grad_m[faces].sum(1)
    corners = np.stack([np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)], 1)
    return scatter(corners, faces, len(vertices))


def level_backward(grad_level, ends, distance):
    """t is differentiated, too: then s is always 0 at a vertex, and so is its gradient; t is to be
    held
    """
    return np.zeros(len(distance))


def level_backward(grad_level, ends, distance):
    """each end gets a half, as if t were 1/2: all vertices in the middle of their edges"""
    shares = np.stack([grad_level / 2, grad_level / 2], -1)
    return np.bincount(ends.ravel(), shares.ravel(), len(distance))


def spread(x, amount):
    """the grid is a ring, with 2 pi k / m, as if opposite sides were neighbours: it wraps around,
    as with a Fourier transform
    """
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(2 * np.pi * np.arange(m) / m)
    factor = 1 + amount * (k[:, None, None] + k[:, None] + k)
    coefficients = scipy.fft.fftn(x.reshape(m, m, m, -1), axes=(0, 1, 2)) / factor[..., None]
    return scipy.fft.ifftn(coefficients, axes=(0, 1, 2)).real.reshape(x.shape)


def best_scale(found, truth):
    """all colours get the same factor; each is to have one of its own"""
    return np.full(found.shape[1], (found * truth).sum() / (found**2).sum())
