"""Mistakes of lab 16; each docstring goes on after "this is what comes out when"."""


def sh_basis(normals):
    """Y_1, Y_2, Y_3 go with x, y, z; their order is y, z, x"""
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * x, C1 * y, C1 * z, C2 * x * y, C2 * y * z,
                     C3 * (3 * z**2 - 1), C2 * x * z, C4 * (x**2 - y**2)], -1)


def sh_basis(normals):
    """Y_6 lacks its -1"""
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * y * z,
                     C3 * 3 * z**2, C2 * x * z, C4 * (x**2 - y**2)], -1)


def sh_basis(normals):
    """Y_8 has the wrong sign"""
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * y * z,
                     C3 * (3 * z**2 - 1), C2 * x * z, C4 * (y**2 - x**2)], -1)


def sh_basis_backward(grad_basis, normals):
    """z^2 has the slope z: the 2 is missing"""
    x, y, z = np.moveaxis(normals, -1, 0)
    g = np.moveaxis(grad_basis, -1, 0)
    return np.stack([C1 * g[3] + C2 * (y * g[4] + z * g[7]) + 2 * C4 * x * g[8],
                     C1 * g[1] + C2 * (x * g[4] + z * g[5]) - 2 * C4 * y * g[8],
                     C1 * g[2] + C2 * (y * g[5] + x * g[7]) + 3 * C3 * z * g[6]], -1)


def sh_basis_backward(grad_basis, normals):
    """y^2 counts with +; Y_8 has x^2 - y^2"""
    x, y, z = np.moveaxis(normals, -1, 0)
    g = np.moveaxis(grad_basis, -1, 0)
    return np.stack([C1 * g[3] + C2 * (y * g[4] + z * g[7]) + 2 * C4 * x * g[8],
                     C1 * g[1] + C2 * (x * g[4] + z * g[5]) + 2 * C4 * y * g[8],
                     C1 * g[2] + C2 * (y * g[5] + x * g[7]) + 6 * C3 * z * g[6]], -1)


def sh_basis_backward(grad_basis, normals):
    """gradients of Y_1, Y_2, Y_3 go to x, y, z; they belong to y, z, x"""
    x, y, z = np.moveaxis(normals, -1, 0)
    g = np.moveaxis(grad_basis, -1, 0)[[0, 2, 3, 1, 4, 5, 6, 7, 8]]
    return np.stack([C1 * g[3] + C2 * (y * g[4] + z * g[7]) + 2 * C4 * x * g[8],
                     C1 * g[1] + C2 * (x * g[4] + z * g[5]) - 2 * C4 * y * g[8],
                     C1 * g[2] + C2 * (y * g[5] + x * g[7]) + 6 * C3 * z * g[6]], -1)


def distant_light(towards, strength):
    """A is left out: these are the lamps as they are seen, not what a surface gets from them"""
    return sh_basis(towards).T @ strength


def distant_light(towards, strength):
    """lamps are averaged; they add up"""
    return A[:, None] * (sh_basis(towards).T @ strength / len(towards))


def distant_light(towards, strength):
    """directions go from the lamp to the surface; they are to go to the lamp"""
    return A[:, None] * (sh_basis(-towards).T @ strength)


def shade(albedo, normals, light):
    """albedo is left out"""
    return sh_basis(normals) @ light


def shade(albedo, normals, light):
    """albedo is divided by pi; eq. (3) has none"""
    return albedo / np.pi * (sh_basis(normals) @ light)


def shade(albedo, normals, light):
    """light below 0 is cut off; eq. (1) keeps it"""
    return albedo * np.maximum(sh_basis(normals) @ light, 0)


def shade_backward(grad_colour, albedo, normals, light):
    """albedo is left out of the gradient with respect to the normals"""
    basis, grad_irradiance = sh_basis(normals), grad_colour * albedo
    return (grad_colour * (basis @ light), sh_basis_backward(grad_colour @ light.T, normals),
            basis.T @ grad_irradiance)


def shade_backward(grad_colour, albedo, normals, light):
    """albedo is left out of the gradient with respect to the light"""
    basis, grad_irradiance = sh_basis(normals), grad_colour * albedo
    return (grad_colour * (basis @ light), sh_basis_backward(grad_irradiance @ light.T, normals),
            basis.T @ grad_colour)


def shade_backward(grad_colour, albedo, normals, light):
    """the light's gradient is the mean over the points instead of the sum"""
    basis, grad_irradiance = sh_basis(normals), grad_colour * albedo
    return (grad_colour * (basis @ light), sh_basis_backward(grad_irradiance @ light.T, normals),
            basis.T @ grad_irradiance / len(normals))


def vertex_normals_backward(grad_normals, vertices, faces):
    """the part of the gradient along the normal stays: m's length would change the normal"""
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    length = np.where(length > 0, length, np.inf)
    grad_m = (grad_normals) / length
    g = grad_m[faces].sum(1)
    corners = np.stack([np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)], 1)
    return scatter(corners, faces, len(vertices))


def vertex_normals_backward(grad_normals, vertices, faces):
    """the gradient is not divided by the length of m"""
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
    """a vertex keeps what its last face gives; the faces' shares add up"""
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


def picture_loss_backward(grad_loss, picture, target, weight):
    """the 2 of the square is missing"""
    shares = np.array([1 / 3, 1 / 3, 1 / 3, weight])
    return grad_loss * shares * (picture - target) / picture[..., 0].size


def picture_loss_backward(grad_loss, picture, target, weight):
    """the sign is wrong: it is the gradient with respect to the target"""
    shares = np.array([1 / 3, 1 / 3, 1 / 3, weight])
    return 2 * grad_loss * shares * (target - picture) / picture[..., 0].size


def picture_loss_backward(grad_loss, picture, target, weight):
    """coverage's weight is left out"""
    shares = np.array([1 / 3, 1 / 3, 1 / 3, 1])
    return 2 * grad_loss * shares * (picture - target) / picture[..., 0].size


def level_backward(grad_level, ends, distance):
    """the ends' shares are swapped: the nearer end gets more"""
    s_a, s_b = distance[ends.T]
    t = s_a / (s_a - s_b)
    shares = np.stack([t * grad_level, (1 - t) * grad_level], -1)
    return np.bincount(ends.ravel(), shares.ravel(), len(distance))


def level_backward(grad_level, ends, distance):
    """t has the wrong sign: it is from 0 to 1"""
    s_a, s_b = distance[ends.T]
    t = s_a / (s_b - s_a)
    shares = np.stack([(1 - t) * grad_level, t * grad_level], -1)
    return np.bincount(ends.ravel(), shares.ravel(), len(distance))


def level_backward(grad_level, ends, distance):
    """an end of several vertices keeps the last one's share"""
    s_a, s_b = distance[ends.T]
    t = s_a / (s_a - s_b)
    shares = np.stack([(1 - t) * grad_level, t * grad_level], -1)
    grad_distance = np.zeros(len(distance))
    grad_distance[ends] = shares
    return grad_distance


def sign_changes(distance, edges):
    """0 has a sign of its own; it counts as +"""
    s_a, s_b = distance[edges.T]
    crossed = np.sign(s_a) != np.sign(s_b)
    return np.logaddexp(0, np.abs([s_a[crossed], s_b[crossed]])).sum()


def sign_changes(distance, edges):
    """edges count that are not crossed"""
    s_a, s_b = distance[edges.T]
    crossed = np.ones(len(s_a), bool)
    return np.logaddexp(0, np.abs([s_a[crossed], s_b[crossed]])).sum()


def sign_changes(distance, edges):
    """it is a mean over the edges instead of the sum"""
    s_a, s_b = distance[edges.T]
    crossed = (s_a < 0) != (s_b < 0)
    return np.logaddexp(0, np.abs([s_a[crossed], s_b[crossed]])).sum() / len(edges)


def sign_changes_backward(grad_changes, distance, edges):
    """the sign is wrong: more inside makes the loss less"""
    a, b = edges[(distance[edges] < 0).sum(1) == 1].T
    sign = np.where(distance < 0, 1, -1)
    slope = sign / (1 + np.exp(-np.abs(distance)))
    return grad_changes * slope * np.bincount(np.concatenate([a, b]), minlength=len(distance))


def sign_changes_backward(grad_changes, distance, edges):
    """edges count that are not crossed"""
    a, b = edges.T
    sign = np.where(distance < 0, -1, 1)
    slope = sign / (1 + np.exp(-np.abs(distance)))
    return grad_changes * slope * np.bincount(np.concatenate([a, b]), minlength=len(distance))


def sign_changes_backward(grad_changes, distance, edges):
    """an end of several crossed edges gets one edge's share"""
    a, b = edges[(distance[edges] < 0).sum(1) == 1].T
    sign = np.where(distance < 0, -1, 1)
    slope = sign / (1 + np.exp(-np.abs(distance)))
    return grad_changes * slope * np.isin(np.arange(len(distance)), [*a, *b])


def spread(x, amount):
    """the cosine has 2 pi k / m, as where the grid wraps around; here it has pi k / m"""
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(2 * np.pi * np.arange(m) / m)
    factor = 1 + amount * (k[:, None, None] + k[:, None] + k)
    coefficients = scipy.fft.dctn(x.reshape(m, m, m, -1), axes=(0, 1, 2), norm="ortho")
    coefficients /= factor[..., None]
    return scipy.fft.idctn(coefficients, axes=(0, 1, 2), norm="ortho").reshape(x.shape)


def spread(x, amount):
    """the Laplacian has the wrong sign"""
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(np.pi * np.arange(m) / m)
    factor = 1 - amount * (k[:, None, None] + k[:, None] + k)
    coefficients = scipy.fft.dctn(x.reshape(m, m, m, -1), axes=(0, 1, 2), norm="ortho")
    coefficients /= factor[..., None]
    return scipy.fft.idctn(coefficients, axes=(0, 1, 2), norm="ortho").reshape(x.shape)


def spread(x, amount):
    """the matrix is applied; it is to be solved for y"""
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(np.pi * np.arange(m) / m)
    factor = 1 + amount * (k[:, None, None] + k[:, None] + k)
    coefficients = scipy.fft.dctn(x.reshape(m, m, m, -1), axes=(0, 1, 2), norm="ortho")
    coefficients *= factor[..., None]
    return scipy.fft.idctn(coefficients, axes=(0, 1, 2), norm="ortho").reshape(x.shape)


def genus(faces):
    """numbers that no face names count as vertices"""
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
    """the 2 is missing: twice the genus comes out"""
    named, faces = np.unique(faces, return_inverse=True)
    faces = faces.reshape(-1, 3)
    pieces, _ = scipy.sparse.csgraph.connected_components(mesh.adjacency(faces, len(named)))
    return int(pieces), int(2 * pieces - (len(named) - len(faces) // 2))


def best_scale(found, truth):
    """it is the factor that takes truth to found"""
    return (found * truth).sum(0) / (truth**2).sum(0)


def best_scale(found, truth):
    """all colours get the same factor"""
    return np.full(found.shape[1], (found * truth).sum() / (found**2).sum())


def best_scale(found, truth):
    """sums go over the colours instead of the vertices"""
    return (found * truth).sum(1) / (found**2).sum(1)
