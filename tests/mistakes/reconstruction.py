"""Mistakes of lab 16; each docstring goes on after "this is what comes out when"."""


def sh_basis(normals):
    """Y_1, Y_2, Y_3 go with x, y, z; their order is y, z, x"""
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * x, C1 * y, C1 * z, C2 * x * y, C2 * y * z,
                     C3 * (3 * z**2 - 1), C2 * x * z, C4 * (x**2 - y**2)], -1)


def sh_basis(normals):
    """Y_6 lacks its - 1: it is 3 z^2 - 1, and not 3 z^2"""
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * y * z,
                     C3 * 3 * z**2, C2 * x * z, C4 * (x**2 - y**2)], -1)


def sh_basis(normals):
    """Y_8 has the wrong sign: it is x^2 - y^2, and not y^2 - x^2"""
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * y * z,
                     C3 * (3 * z**2 - 1), C2 * x * z, C4 * (y**2 - x**2)], -1)


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


def sh_basis(normals):
    """Y_8 has the constant C2 in the place of C4: it is twice as large"""
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * y * z,
                     C3 * (3 * z**2 - 1), C2 * x * z, C2 * (x**2 - y**2)], -1)


def sh_basis_backward(grad_basis, normals):
    """the factor 2 is missing in the slope of z^2, which is 2 z: Y_6 has 6 z, and not 3 z"""
    x, y, z = np.moveaxis(normals, -1, 0)
    g = np.moveaxis(grad_basis, -1, 0)
    return np.stack([C1 * g[3] + C2 * (y * g[4] + z * g[7]) + 2 * C4 * x * g[8],
                     C1 * g[1] + C2 * (x * g[4] + z * g[5]) - 2 * C4 * y * g[8],
                     C1 * g[2] + C2 * (y * g[5] + x * g[7]) + 3 * C3 * z * g[6]], -1)


def sh_basis_backward(grad_basis, normals):
    """the slope of y^2 has the wrong sign: Y_8 has x^2 - y^2, so y counts with a minus"""
    x, y, z = np.moveaxis(normals, -1, 0)
    g = np.moveaxis(grad_basis, -1, 0)
    return np.stack([C1 * g[3] + C2 * (y * g[4] + z * g[7]) + 2 * C4 * x * g[8],
                     C1 * g[1] + C2 * (x * g[4] + z * g[5]) + 2 * C4 * y * g[8],
                     C1 * g[2] + C2 * (y * g[5] + x * g[7]) + 6 * C3 * z * g[6]], -1)


def sh_basis_backward(grad_basis, normals):
    """gradients of Y_1, Y_2, Y_3 go to x, y, z in this order; they belong to y, z, x"""
    x, y, z = np.moveaxis(normals, -1, 0)
    g = np.moveaxis(grad_basis, -1, 0)[[0, 2, 3, 1, 4, 5, 6, 7, 8]]
    return np.stack([C1 * g[3] + C2 * (y * g[4] + z * g[7]) + 2 * C4 * x * g[8],
                     C1 * g[1] + C2 * (x * g[4] + z * g[5]) - 2 * C4 * y * g[8],
                     C1 * g[2] + C2 * (y * g[5] + x * g[7]) + 6 * C3 * z * g[6]], -1)


def distant_light(towards, strength):
    """the factors A_k are left out: these are the lamps as they are seen, without the cosine lobe,
    and not what a surface gets from them
    """
    return sh_basis(towards).T @ strength


def distant_light(towards, strength):
    """the mean of the lamps is taken, and not their sum: they are averaged, and are to add up"""
    return A[:, None] * (sh_basis(towards).T @ strength / len(towards))


def distant_light(towards, strength):
    """the directions are turned round, as from the lamp to the surface; towards goes to the lamp,
    so the sign is wrong
    """
    return A[:, None] * (sh_basis(-towards).T @ strength)


def distant_light(towards, strength):
    """Y_4 has the A of the linear harmonics, 2/3 pi, which are Y_1 to Y_3; that of Y_4 is pi / 4"""
    factors = np.pi * np.array([1, *[2 / 3] * 4, *[1 / 4] * 4])
    return factors[:, None] * (sh_basis(towards).T @ strength)


def distant_light(towards, strength):
    """the factors A_k lack their pi, as where light is divided by pi"""
    return A[:, None] / np.pi * (sh_basis(towards).T @ strength)


def shade(albedo, normals, light):
    """the albedo is left out: this is E, the light that arrives"""
    return sh_basis(normals) @ light


def shade(albedo, normals, light):
    """the albedo is divided by pi; eq. (3) has no pi"""
    return albedo / np.pi * (sh_basis(normals) @ light)


def shade(albedo, normals, light):
    """light below 0 is cut off, clipped at 0; eq. (1) keeps negative numbers"""
    return albedo * np.maximum(sh_basis(normals) @ light, 0)


def shade(albedo, normals, light):
    """the factors A_k of eq. (2) are applied again, though the light holds them already"""
    return albedo * ((sh_basis(normals) * A) @ light)


def shade(albedo, normals, light):
    """the colours of the light are summed: each colour of the surface gets the light of all colours
    """
    return albedo * (sh_basis(normals) @ light).sum(1, keepdims=True)


def shade(albedo, normals, light):
    """the first, constant number of the light alone counts: normals play no role"""
    return albedo * (C0 * light[0])


def shade_backward(grad_colour, albedo, normals, light):
    """the albedo is left out of the gradient with respect to the normals"""
    basis, grad_irradiance = sh_basis(normals), grad_colour * albedo
    return (grad_colour * (basis @ light), sh_basis_backward(grad_colour @ light.T, normals),
            basis.T @ grad_irradiance)


def shade_backward(grad_colour, albedo, normals, light):
    """the albedo is left out of the gradient with respect to the light"""
    basis, grad_irradiance = sh_basis(normals), grad_colour * albedo
    return (grad_colour * (basis @ light), sh_basis_backward(grad_irradiance @ light.T, normals),
            basis.T @ grad_colour)


def shade_backward(grad_colour, albedo, normals, light):
    """the light's gradient is the mean over the vertices instead of the sum"""
    basis, grad_irradiance = sh_basis(normals), grad_colour * albedo
    return (grad_colour * (basis @ light), sh_basis_backward(grad_irradiance @ light.T, normals),
            basis.T @ grad_irradiance / len(normals))


def shade_backward(grad_colour, albedo, normals, light):
    """the albedo is left out of the gradients with respect to the normals and the light:
    grad_colour goes on without it
    """
    basis = sh_basis(normals)
    return (grad_colour * (basis @ light), sh_basis_backward(grad_colour @ light.T, normals),
            basis.T @ grad_colour)


def shade_backward(grad_colour, albedo, normals, light):
    """grad_albedo is multiplied by the albedo, too; the product's other factor is E alone"""
    basis, grad = sh_basis(normals), grad_colour * albedo
    return grad * (basis @ light), sh_basis_backward(grad @ light.T, normals), basis.T @ grad


def shade_backward(grad_colour, albedo, normals, light):
    """the first colour alone reaches the normals: those of the other colours are not added"""
    basis, grad_irradiance = sh_basis(normals), grad_colour * albedo
    grad_basis = grad_irradiance[:, :1] * light[:, 0]
    return (grad_colour * (basis @ light), sh_basis_backward(grad_basis, normals),
            basis.T @ grad_irradiance)


def vertex_normals_backward(grad_normals, vertices, faces):
    """the part of the gradient along the normal n is not taken away; it only makes m longer, which
    the normalised n does not feel
    """
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    length = np.where(length > 0, length, np.inf)
    grad_m = (grad_normals) / length
    g = grad_m[faces].sum(1)
    corners = np.stack([np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)], 1)
    return scatter(corners, faces, len(vertices))


def vertex_normals_backward(grad_normals, vertices, faces):
    """the gradient is not divided by |m|, the length of m"""
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    length = np.where(length > 0, length, np.inf)
    n = m / length
    grad_m = grad_normals - (grad_normals * n).sum(1, keepdims=True) * n
    g = grad_m[faces].sum(1)
    corners = np.stack([np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)], 1)
    return scatter(corners, faces, len(vertices))


def vertex_normals_backward(grad_normals, vertices, faces):
    """a vertex in several faces keeps what its last face gives; the faces' shares add up, as with
    `scatter`
    """
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    length = np.where(length > 0, length, np.inf)
    n = m / length
    grad_m = (grad_normals - (grad_normals * n).sum(1, keepdims=True) * n) / length
    g = grad_m[faces].sum(1)
    corners = np.stack([np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)], 1)
    grad_vertices = np.zeros(vertices.shape)
    grad_vertices[faces] = corners
    return grad_vertices


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


def vertex_normals_backward(grad_normals, vertices, faces):
    """corner a gets no gradient: b and c of (b - a) x (c - a) alone are differentiated"""
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    length = np.where(length > 0, length, np.inf)
    n = m / length
    grad_m = (grad_normals - (grad_normals * n).sum(1, keepdims=True) * n) / length
    g = grad_m[faces].sum(1)
    corners = np.stack([0 * g, np.cross(c - a, g), np.cross(a - b, g)], 1)
    return scatter(corners, faces, len(vertices))


def picture_loss_backward(grad_loss, picture, target, weight):
    """the colours lack 1/3: their mean is over three numbers for each pixel, and not over pixels"""
    shares = np.array([1, 1, 1, weight])
    return 2 * grad_loss * shares * (picture - target) / picture[..., 0].size


def picture_loss_backward(grad_loss, picture, target, weight):
    """the sign is wrong: target - picture gives the gradient with respect to the target"""
    shares = np.array([1 / 3, 1 / 3, 1 / 3, weight])
    return 2 * grad_loss * shares * (target - picture) / picture[..., 0].size


def picture_loss_backward(grad_loss, picture, target, weight):
    """the weight of the coverage is left out"""
    shares = np.array([1 / 3, 1 / 3, 1 / 3, 1])
    return 2 * grad_loss * shares * (picture - target) / picture[..., 0].size


def picture_loss_backward(grad_loss, picture, target, weight):
    """one mean goes over all four numbers: everything is divided by 4 times the number of pixels,
    and each mean is to be over its own numbers
    """
    shares = np.array([1, 1, 1, weight])
    return 2 * grad_loss * shares * (picture - target) / picture.size


def picture_loss_backward(grad_loss, picture, target, weight):
    """the weight multiplies the colours and not the coverage"""
    shares = np.array([weight / 3, weight / 3, weight / 3, 1])
    return 2 * grad_loss * shares * (picture - target) / picture[..., 0].size


def picture_loss_backward(grad_loss, picture, target, weight):
    """the number of pixels is that of one picture, H W, though several are given: the mean is over
    all pictures
    """
    shares = np.array([1 / 3, 1 / 3, 1 / 3, weight])
    return 2 * grad_loss * shares * (picture - target) / np.prod(picture.shape[-3:-1])


def level_backward(grad_level, ends, distance):
    """the shares of the two ends are swapped: the nearer end is to get more"""
    s_a, s_b = distance[ends.T]
    t = s_a / (s_a - s_b)
    shares = np.stack([t * grad_level, (1 - t) * grad_level], -1)
    return np.bincount(ends.ravel(), shares.ravel(), len(distance))


def level_backward(grad_level, ends, distance):
    """t has the wrong sign; it is from 0 to 1"""
    s_a, s_b = distance[ends.T]
    t = s_a / (s_b - s_a)
    shares = np.stack([(1 - t) * grad_level, t * grad_level], -1)
    return np.bincount(ends.ravel(), shares.ravel(), len(distance))


def level_backward(grad_level, ends, distance):
    """a point that is an end of several vertices keeps the last one's share; they are to add up"""
    s_a, s_b = distance[ends.T]
    t = s_a / (s_a - s_b)
    shares = np.stack([(1 - t) * grad_level, t * grad_level], -1)
    grad_distance = np.zeros(len(distance))
    grad_distance[ends] = shares
    return grad_distance


def level_backward(grad_level, ends, distance):
    """t is differentiated, too: then s is always 0 at a vertex, and so is its gradient; t is to be
    held
    """
    return np.zeros(len(distance))


def level_backward(grad_level, ends, distance):
    """each end gets a half, as if t were 1/2: all vertices in the middle of their edges"""
    shares = np.stack([grad_level / 2, grad_level / 2], -1)
    return np.bincount(ends.ravel(), shares.ravel(), len(distance))


def sign_changes(distance, edges):
    """a distance of 0 has a sign of its own; it counts as +"""
    s_a, s_b = distance[edges.T]
    crossed = np.sign(s_a) != np.sign(s_b)
    return np.logaddexp(0, np.abs([s_a[crossed], s_b[crossed]])).sum()


def sign_changes(distance, edges):
    """all edges count, also those that are not crossed"""
    s_a, s_b = distance[edges.T]
    crossed = np.ones(len(s_a), bool)
    return np.logaddexp(0, np.abs([s_a[crossed], s_b[crossed]])).sum()


def sign_changes(distance, edges):
    """it is a mean over the edges instead of the sum"""
    s_a, s_b = distance[edges.T]
    crossed = (s_a < 0) != (s_b < 0)
    return np.logaddexp(0, np.abs([s_a[crossed], s_b[crossed]])).sum() / len(edges)


def sign_changes(distance, edges):
    """each end is compared with its own sign, and not with the other's: log(1 + exp(-|s|)), with a
    minus in the exponent
    """
    s_a, s_b = distance[edges.T]
    crossed = (s_a < 0) != (s_b < 0)
    return np.logaddexp(0, -np.abs([s_a[crossed], s_b[crossed]])).sum()


def sign_changes(distance, edges):
    """the first end alone of each crossed edge counts; eq. (7) has two terms, one for each end"""
    s_a, s_b = distance[edges.T]
    crossed = (s_a < 0) != (s_b < 0)
    return np.logaddexp(0, np.abs(s_a[crossed])).sum()


def sign_changes(distance, edges):
    """edges whose first end is outside are left out: the pairs come in any order, and not only with
    the end inside first
    """
    s_a, s_b = distance[edges.T]
    crossed = (s_a < 0) & (s_b >= 0)
    return np.logaddexp(0, np.abs([s_a[crossed], s_b[crossed]])).sum()


def sign_changes_backward(grad_changes, distance, edges):
    """the sign is wrong: it says that the loss falls where |s| grows"""
    a, b = edges[(distance[edges] < 0).sum(1) == 1].T
    sign = np.where(distance < 0, 1, -1)
    slope = sign / (1 + np.exp(-np.abs(distance)))
    return grad_changes * slope * np.bincount(np.concatenate([a, b]), minlength=len(distance))


def sign_changes_backward(grad_changes, distance, edges):
    """all edges count, also those that are not crossed"""
    a, b = edges.T
    sign = np.where(distance < 0, -1, 1)
    slope = sign / (1 + np.exp(-np.abs(distance)))
    return grad_changes * slope * np.bincount(np.concatenate([a, b]), minlength=len(distance))


def sign_changes_backward(grad_changes, distance, edges):
    """a point that is an end of several crossed edges gets one edge's share, and not the sum"""
    a, b = edges[(distance[edges] < 0).sum(1) == 1].T
    sign = np.where(distance < 0, -1, 1)
    slope = sign / (1 + np.exp(-np.abs(distance)))
    return grad_changes * slope * np.isin(np.arange(len(distance)), [*a, *b])


def sign_changes_backward(grad_changes, distance, edges):
    """the slope is that of log(1 + exp(-|s|)), with exp(-|s|) in the numerator: each end is
    compared with its own sign and not the other's
    """
    a, b = edges[(distance[edges] < 0).sum(1) == 1].T
    sign = np.where(distance < 0, -1, 1)
    slope = sign / (1 + np.exp(np.abs(distance)))
    return grad_changes * slope * np.bincount(np.concatenate([a, b]), minlength=len(distance))


def spread(x, amount):
    """the cosine has 2 pi k / m, as where the grid wraps around; here it has pi k / m"""
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(2 * np.pi * np.arange(m) / m)
    factor = 1 + amount * (k[:, None, None] + k[:, None] + k)
    coefficients = scipy.fft.dctn(x.reshape(m, m, m, -1), axes=(0, 1, 2), norm="ortho")
    coefficients /= factor[..., None]
    return scipy.fft.idctn(coefficients, axes=(0, 1, 2), norm="ortho").reshape(x.shape)


def spread(x, amount):
    """the grid is a ring, with 2 pi k / m, as if opposite sides were neighbours: it wraps around,
    as with a Fourier transform
    """
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(2 * np.pi * np.arange(m) / m)
    factor = 1 + amount * (k[:, None, None] + k[:, None] + k)
    coefficients = scipy.fft.fftn(x.reshape(m, m, m, -1), axes=(0, 1, 2)) / factor[..., None]
    return scipy.fft.ifftn(coefficients, axes=(0, 1, 2)).real.reshape(x.shape)


def spread(x, amount):
    """the three axes are solved one after another: the factor is a product of three, and is to be
    1 plus amount times the sum
    """
    m = round(len(x)**(1 / 3))
    k = 1 + amount * (2 - 2 * np.cos(np.pi * np.arange(m) / m))
    factor = k[:, None, None] * k[:, None] * k
    coefficients = scipy.fft.dctn(x.reshape(m, m, m, -1), axes=(0, 1, 2), norm="ortho")
    coefficients /= factor[..., None]
    return scipy.fft.idctn(coefficients, axes=(0, 1, 2), norm="ortho").reshape(x.shape)


def spread(x, amount):
    """the Laplacian has the wrong sign: it divides by 1 - amount times the factor"""
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(np.pi * np.arange(m) / m)
    factor = 1 - amount * (k[:, None, None] + k[:, None] + k)
    coefficients = scipy.fft.dctn(x.reshape(m, m, m, -1), axes=(0, 1, 2), norm="ortho")
    coefficients /= factor[..., None]
    return scipy.fft.idctn(coefficients, axes=(0, 1, 2), norm="ortho").reshape(x.shape)


def spread(x, amount):
    """it multiplies by I + amount * Laplacian, which sharpens; the inverse is asked for, so it is
    to divide by the factor
    """
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(np.pi * np.arange(m) / m)
    factor = 1 + amount * (k[:, None, None] + k[:, None] + k)
    coefficients = scipy.fft.dctn(x.reshape(m, m, m, -1), axes=(0, 1, 2), norm="ortho")
    coefficients *= factor[..., None]
    return scipy.fft.idctn(coefficients, axes=(0, 1, 2), norm="ortho").reshape(x.shape)


def spread(x, amount):
    """it is one explicit step, x - amount * Laplacian(x), and not the solution of eq. (8)"""
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(np.pi * np.arange(m) / m)
    factor = 1 - amount * (k[:, None, None] + k[:, None] + k)
    coefficients = scipy.fft.dctn(x.reshape(m, m, m, -1), axes=(0, 1, 2), norm="ortho")
    coefficients *= factor[..., None]
    return scipy.fft.idctn(coefficients, axes=(0, 1, 2), norm="ortho").reshape(x.shape)


def genus(faces):
    """numbers that no face names count as vertices: V is taken for the greatest number"""
    named, faces = np.unique(faces, return_inverse=True)
    faces = faces.reshape(-1, 3)
    pieces, _ = scipy.sparse.csgraph.connected_components(mesh.adjacency(faces, len(named)))
    return int(pieces), int(pieces - (named.max() + 1 - len(faces) // 2) // 2)


def genus(faces):
    """each edge counts twice, once for either face"""
    named, faces = np.unique(faces, return_inverse=True)
    faces = faces.reshape(-1, 3)
    pieces, _ = scipy.sparse.csgraph.connected_components(mesh.adjacency(faces, len(named)))
    return int(pieces), int(pieces - (len(named) - 2 * len(faces)) // 2)


def genus(faces):
    """V - E + F is not halved: twice the genus comes out"""
    named, faces = np.unique(faces, return_inverse=True)
    faces = faces.reshape(-1, 3)
    pieces, _ = scipy.sparse.csgraph.connected_components(mesh.adjacency(faces, len(named)))
    return int(pieces), int(2 * pieces - (len(named) - len(faces) // 2))


def best_scale(found, truth):
    """found and truth are exchanged: the squares are those of the truth, and the factor takes truth
    to found
    """
    return (found * truth).sum(0) / (truth**2).sum(0)


def best_scale(found, truth):
    """all colours get the same factor; each is to have one of its own"""
    return np.full(found.shape[1], (found * truth).sum() / (found**2).sum())


def best_scale(found, truth):
    """sums go over the colours instead of the vertices"""
    return (found * truth).sum(1) / (found**2).sum(1)


def best_scale(found, truth):
    """it is the ratio of the means, or of the sums, which is not that of the least squares"""
    return truth.mean(0) / found.mean(0)


def best_scale(found, truth):
    """it is the mean of the ratios truth / found, which is not that of the least squares"""
    return (truth / found).mean(0)
