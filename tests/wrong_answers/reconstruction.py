"""Wrong answers to reconstruction, written without a look at the checks."""


def sh_basis(normals):
    """Y_1 to Y_3 are in the order x, y, z and not y, z, x

    told by: x, y, z | y, z, x | order | exchanged | swapped | linear | y_1
    """
    x, y, z = normals[..., 0], normals[..., 1], normals[..., 2]
    return np.stack([C0 * np.ones_like(x), C1 * x, C1 * y, C1 * z, C2 * x * y, C2 * y * z,
                     C3 * (3 * z * z - 1), C2 * x * z, C4 * (x * x - y * y)], axis=-1)


def sh_basis(normals):
    """Y_6 is 3 z^2, without the - 1

    told by: y_6 | - 1 & z^2 | 3 z^2 | 3 * z**2 | minus 1 | -1 & missing
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * y * z,
                     C3 * 3 * z**2, C2 * x * z, C4 * (x**2 - y**2)], -1)


def sh_basis(normals):
    """Y_5 and Y_7 are exchanged: y z and x z

    told by: y_5 | y_7 | y z and x z | x z and y z | x z & y z | exchanged | swapped
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    out = np.empty(normals.shape[:-1] + (9,))
    out[..., 0] = C0
    out[..., 1], out[..., 2], out[..., 3] = C1 * y, C1 * z, C1 * x
    out[..., 4] = C2 * x * y
    out[..., 5] = C2 * x * z
    out[..., 6] = C3 * (3 * z**2 - 1)
    out[..., 7] = C2 * y * z
    out[..., 8] = C4 * (x**2 - y**2)
    return out


def sh_basis(normals):
    """Y_1, Y_3, Y_5 and Y_7 have the other sign, that of the Condon-Shortley phase

    told by: sign | negative | minus | condon | phase
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, -C1 * y, C1 * z, -C1 * x, C2 * x * y, -C2 * y * z,
                     C3 * (3 * z**2 - 1), -C2 * x * z, C4 * (x**2 - y**2)], -1)


def sh_basis(normals):
    """the constant C2 is used for Y_8 in the place of C4

    told by: c4 | c2 & y_8 | constant & y_8 | last & constant | x^2 - y^2 | factor & y_8
    """
    x, y, z = normals.T if normals.ndim == 2 else np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * y * z,
                     C3 * (3 * z**2 - 1), C2 * x * z, C2 * (x**2 - y**2)], -1)


def sh_basis_backward(grad_basis, normals):
    """the derivative of Y_8 by y has the sign +: it is x^2 - y^2

    told by: y_8 | x^2 - y^2 | sign | minus | opposite
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    g = np.moveaxis(grad_basis, -1, 0)
    return np.stack([C1 * g[3] + C2 * (y * g[4] + z * g[7]) + 2 * C4 * x * g[8],
                     C1 * g[1] + C2 * (x * g[4] + z * g[5]) + 2 * C4 * y * g[8],
                     C1 * g[2] + C2 * (y * g[5] + x * g[7]) + 6 * C3 * z * g[6]], -1)


def distant_light(towards, strength):
    """the factors A_k are left out

    told by: a_k | factors a | a[:, none] | cosine lobe | without a
    """
    return sh_basis(towards).T @ strength


def distant_light(towards, strength):
    """the direction is turned round, as that in which the light travels: towards is the direction to the lamp

    told by: sign & direction | -towards | opposite | turned round | from the lamp | travels | minus
    """
    light = np.zeros((9, strength.shape[1]))
    for d, s in zip(towards, strength):
        light += np.outer(A * sh_basis(-d), s)
    return light


def distant_light(towards, strength):
    """the mean of the lamps is taken, not their sum

    told by: mean | average | sum | divided & lamps | number of lamps
    """
    return A[:, None] * (sh_basis(towards).T @ strength) / len(towards)


def distant_light(towards, strength):
    """A is 2 pi / 3 for four numbers and pi / 4 for the last four: Y_4 is counted with the linear ones, of which there are three

    told by: band | a_4 | y_4 | fifth | 2/3 | l_4
    """
    a = np.pi * np.array([1] + [2 / 3] * 4 + [1 / 4] * 4)
    return a[:, None] * (sh_basis(towards).T @ strength)


def shade(albedo, normals, light):
    """the irradiance is clipped at 0, which eq. (1) does not do

    told by: clip | negative | max( | maximum | clamp | below 0
    """
    return albedo * np.maximum(sh_basis(normals) @ light, 0)


def shade(albedo, normals, light):
    """the albedo is left out: this is the light that arrives

    told by: albedo & missing | albedo & left out | albedo & forg | without & albedo | light that arrives | irradiance alone | times albedo | multipl & albedo
    """
    return sh_basis(normals) @ light


def shade(albedo, normals, light):
    """A_k is applied again, although the light l_k holds it already

    told by: a_k | a_k & again | a_k & twice | eq. (2) | cosine lobe | factors a
    """
    basis = sh_basis(normals) * A
    return albedo * (basis @ light)


def shade(albedo, normals, light):
    """the albedo is divided by pi, as in the BRDF of a diffuse surface; eq. (3) has no pi

    told by: / pi | by pi | 1/pi | brdf | pi & albedo
    """
    colours = np.zeros(albedo.shape)
    for v in range(len(normals)):
        e = sh_basis(normals[v]) @ light
        colours[v] = albedo[v] / np.pi * e
    return colours


def shade(albedo, normals, light):
    """the colours of the light are summed: each colour of the surface gets the light of all

    told by: sum & colour | channel | each colour & own | all colours | grey | mixed
    """
    e = (sh_basis(normals) @ light).sum(1, keepdims=True)
    return albedo * e


def shade_backward(grad_colour, albedo, normals, light):
    """the albedo is forgotten on the way to the normals and the light: grad_colour goes on without it

    told by: albedo | grad_irradiance | times albedo
    """
    basis = sh_basis(normals)
    grad_albedo = grad_colour * (basis @ light)
    grad_normals = sh_basis_backward(grad_colour @ light.T, normals)
    return grad_albedo, grad_normals, basis.T @ grad_colour


def shade_backward(grad_colour, albedo, normals, light):
    """grad_albedo is multiplied by the albedo too, though the product's other factor is E alone

    told by: grad_albedo & albedo | e alone | product rule | multiplied by & albedo | only by e | irradiance
    """
    basis = sh_basis(normals)
    g = grad_colour * albedo
    return g * (basis @ light), sh_basis_backward(g @ light.T, normals), basis.T @ g


def shade_backward(grad_colour, albedo, normals, light):
    """grad_light is the mean over the vertices and not the sum

    told by: mean | average | sum | number of vertices | divided
    """
    basis = sh_basis(normals)
    g = grad_colour * albedo
    grad_normals = sh_basis_backward(g @ light.T, normals)
    return grad_colour * (basis @ light), grad_normals, basis.T @ g / len(normals)


def shade_backward(grad_colour, albedo, normals, light):
    """only the first colour reaches the normals: the others' gradients are not added

    told by: first colour | one colour | sum over & colours | other colours | all colours | colour & added | channel
    """
    basis = sh_basis(normals)
    g = grad_colour * albedo
    grad_normals = sh_basis_backward(g[:, :1] * light[:, 0], normals)
    return grad_colour * (basis @ light), grad_normals, basis.T @ g


def shade_backward(grad_colour, albedo, normals, light):
    """the gradient of the normals is that on the unit sphere: the part along n is taken away here, though eq. (4) does that later

    told by: along n | along the normal | project | tangent | unit sphere | along itself
    """
    basis = np.array([sh_basis(n) for n in normals])
    g = grad_colour * albedo
    gn = sh_basis_backward(g @ light.T, normals)
    gn = gn - normals * (gn * normals).sum(-1)[:, None]
    return grad_colour * (basis @ light), gn, np.einsum("vk,vc->kc", basis, g)


def vertex_normals_backward(grad_normals, vertices, faces):
    """the normalisation is not differentiated: the part along n is not taken away

    told by: along n | project | normalis | normaliz | length 1 | along the normal | m longer | tangent
    """
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    grad_m = grad_normals / np.where(length > 0, length, np.inf)
    g = grad_m[faces].sum(1)
    corners = np.stack([np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)], 1)
    return scatter(corners, faces, len(vertices))


def vertex_normals_backward(grad_normals, vertices, faces):
    """the division by |m| is left out

    told by: divi & length | division by | divided by m | length of m | divi & norm of m | too large by
    """
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    n = m / np.where(length > 0, length, 1)
    grad_m = (grad_normals - (grad_normals * n).sum(1, keepdims=True) * n) * (length > 0)
    g = grad_m[faces].sum(1)
    corners = np.stack([np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)], 1)
    return scatter(corners, faces, len(vertices))


def vertex_normals_backward(grad_normals, vertices, faces):
    """grad[faces] += counts a vertex once only, though it is in several faces

    told by: several faces | += | once | more than one face | overwrit | last face | twice | add.at | scatter
    """
    a, b, c = vertices[faces.T]
    m = np.zeros(vertices.shape)
    for corner in range(3):
        np.add.at(m, faces[:, corner], np.cross(b - a, c - a))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    length[length == 0] = np.inf
    n = m / length
    grad_m = (grad_normals - (grad_normals * n).sum(1, keepdims=True) * n) / length
    g = grad_m[faces].sum(1)
    grad = np.zeros(vertices.shape)
    grad[faces[:, 0]] += np.cross(b - c, g)
    grad[faces[:, 1]] += np.cross(c - a, g)
    grad[faces[:, 2]] += np.cross(a - b, g)
    return grad


def vertex_normals_backward(grad_normals, vertices, faces):
    """the cross products are in the other order, so the gradient has the wrong sign

    told by: sign | cross & order | opposite | minus | negat
    """
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    length = np.where(length > 0, length, np.inf)
    n = m / length
    grad_m = (grad_normals - (grad_normals * n).sum(1, keepdims=True) * n) / length
    g = grad_m[faces].sum(1)
    corners = np.stack([np.cross(g, b - c), np.cross(g, c - a), np.cross(g, a - b)], 1)
    return scatter(corners, faces, len(vertices))


def vertex_normals_backward(grad_normals, vertices, faces):
    """fine print: where the faces around a vertex cancel, m is 0 and it divides by 0: nan

    told by: nan | m = 0 | m is 0 | cancel | divi & by 0 | divi & zero
    """
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    n = m / length
    grad_m = (grad_normals - (grad_normals * n).sum(1, keepdims=True) * n) / length
    g = grad_m[faces].sum(1)
    corners = np.stack([np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)], 1)
    grad = np.zeros(vertices.shape)
    np.add.at(grad, faces, corners)
    return grad


def vertex_normals_backward(grad_normals, vertices, faces):
    """the corner a gets no gradient: only b and c of (b - a) x (c - a) were differentiated

    told by: first corner | corner a | vertex a | a gets | only b and c | translat | sum to 0
    """
    grad_m = np.zeros(vertices.shape)
    m = np.zeros(vertices.shape)
    for f in faces:
        a, b, c = vertices[f]
        for v in f:
            m[v] += np.cross(b - a, c - a)
    for v in range(len(vertices)):
        size = np.sqrt(m[v] @ m[v])
        if size > 0:
            n = m[v] / size
            grad_m[v] = (grad_normals[v] - n * (n @ grad_normals[v])) / size
    grad = np.zeros(vertices.shape)
    for f in faces:
        a, b, c = vertices[f]
        g = grad_m[f].sum(0)
        grad[f[1]] += np.cross(c - a, g)
        grad[f[2]] += np.cross(g, b - a)
    return grad


def vertex_normals_backward(grad_normals, vertices, faces):
    """m is the sum of unit normals: faces are not weighted by their area as in eq. (4)

    told by: area | unit normals | weight | each face alike | face normals & unit
    """
    a, b, c = vertices[faces.T]
    cross = np.cross(b - a, c - a)
    cross = cross / np.linalg.norm(cross, axis=1, keepdims=True)
    m = scatter(np.repeat(cross[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    length = np.where(length > 0, length, np.inf)
    n = m / length
    grad_m = (grad_normals - (grad_normals * n).sum(1, keepdims=True) * n) / length
    g = grad_m[faces].sum(1)
    corners = np.stack([np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)], 1)
    return scatter(corners, faces, len(vertices))


def picture_loss_backward(grad_loss, picture, target, weight):
    """one mean over all four numbers: everything is divided by 4 times the number of pixels

    told by: four | picture.size | 4 times | each mean | one mean | quarter | own numbers
    """
    shares = np.array([1, 1, 1, weight])
    return 2 * grad_loss * shares * (picture - target) / picture.size


def picture_loss_backward(grad_loss, picture, target, weight):
    """the factor 2 of the square is missing

    told by: factor 2 | 2 x | half | twice | square | factor of 2
    """
    grad = np.empty(picture.shape)
    grad[..., :3] = grad_loss * (picture - target)[..., :3] / picture[..., :3].size
    grad[..., 3] = grad_loss * weight * (picture - target)[..., 3] / picture[..., 3].size
    return grad


def picture_loss_backward(grad_loss, picture, target, weight):
    """target - picture: the sign is that of the target's gradient

    told by: sign | target - picture | opposite | minus | negat
    """
    d = target - picture
    n = picture[..., 0].size
    return grad_loss * np.concatenate([2 * d[..., :3] / (3 * n), 2 * weight * d[..., 3:] / n], -1)


def picture_loss_backward(grad_loss, picture, target, weight):
    """the weight multiplies the colours and not the coverage

    told by: weight & colour | weight & coverage | weight & exchanged | weight & wrong
    """
    n = picture[..., 0].size
    grad = 2 * grad_loss * (picture - target) / n
    grad[..., :3] *= weight / 3
    return grad


def picture_loss_backward(grad_loss, picture, target, weight):
    """the number of pixels is that of one picture, H W, though several are given

    told by: several pictures | one picture | number of pictures | k pictures | all pictures | first axis
    """
    height, width = picture.shape[-3:-1]
    shares = np.array([1 / 3, 1 / 3, 1 / 3, weight])
    return 2 * grad_loss * shares * (picture - target) / (height * width)


def picture_loss_backward(grad_loss, picture, target, weight):
    """grad_loss is not multiplied on

    told by: grad_loss | incoming | upstream | chain rule
    """
    shares = np.array([1 / 3, 1 / 3, 1 / 3, weight])
    return 2 * shares * (picture - target) / picture[..., 0].size


def level_backward(grad_level, ends, distance):
    """grad[a] += counts a grid point once only, though several vertices share it

    told by: several | share | once | += | add.at | scatter | overwrit | twice | last vertex
    """
    a, b = ends[:, 0], ends[:, 1]
    t = distance[a] / (distance[a] - distance[b])
    grad = np.zeros(distance.shape)
    grad[a] += (1 - t) * grad_level
    grad[b] += t * grad_level
    return grad


def level_backward(grad_level, ends, distance):
    """t is differentiated as well, and then s at a vertex is 0 and stays so: t is to be held

    told by: t is to be held | t held | t is held | hold t | through t | derivative of t | t is a constant | always 0 | everywhere 0
    """
    s_a, s_b = distance[ends.T]
    t = s_a / (s_a - s_b)
    slope_a = (1 - t) + (s_b - s_a) * -s_b / (s_a - s_b)**2
    slope_b = t + (s_b - s_a) * s_a / (s_a - s_b)**2
    return scatter(np.stack([slope_a * grad_level, slope_b * grad_level], -1), ends, len(distance))


def sign_changes(distance, edges):
    """the sign of each end is its own and not the other one's: log(1 + exp(-|s|))

    told by: other & sign | own sign | exp(- | e^- | minus & exponent | sign & exponent
    """
    a, b = distance[edges.T]
    crossed = (a < 0) != (b < 0)
    return (np.log1p(np.exp(-np.abs(a[crossed]))) + np.log1p(np.exp(-np.abs(b[crossed])))).sum()


def sign_changes(distance, edges):
    """all edges are counted, also those that are not crossed

    told by: all edges | not crossed | every edge | uncrossed | only & crossed | same sign
    """
    a, b = distance[edges.T]
    h = np.logaddexp(0, np.abs(a)) + np.logaddexp(0, np.abs(b))
    return h.sum()


def sign_changes(distance, edges):
    """fine print: large distances overflow: log(1 + exp(|s|)) is inf

    told by: overflow | is inf | infinite | large | 1000 | logaddexp
    """
    total = 0.0
    for i, j in edges:
        if (distance[i] < 0) != (distance[j] < 0):
            total += np.log(1 + np.exp(abs(distance[i]))) + np.log(1 + np.exp(abs(distance[j])))
    return total


def sign_changes(distance, edges):
    """only the first end of each crossed edge is counted: one of eq. (7)'s two terms is missing

    told by: both ends | one end | two terms | second term | only & first | first end | other end | half
    """
    a, b = distance[edges.T]
    crossed = (a < 0) != (b < 0)
    return np.logaddexp(0, np.abs(a[crossed])).sum()


def sign_changes_backward(grad_changes, distance, edges):
    """grad[i] += counts a point once only, though it is an end of several crossed edges

    told by: several | once | more than one | += | add.at | number of & edges | overwrit | how many
    """
    s = distance[edges]
    e = edges[(s[:, 0] < 0) != (s[:, 1] < 0)]
    sign = np.where(distance < 0, -1.0, 1.0)
    slope = grad_changes * sign / (1 + np.exp(-np.abs(distance)))
    grad = np.zeros(len(distance))
    grad[e[:, 0]] += slope[e[:, 0]]
    grad[e[:, 1]] += slope[e[:, 1]]
    return grad


def sign_changes_backward(grad_changes, distance, edges):
    """fine print: np.sign gives a distance of 0 the slope 0 and not that of a small positive one

    told by: distance of 0 | np.sign | sign of 0 | sign(0) | zero | small positive
    """
    a, b = edges[(distance[edges] < 0).sum(1) == 1].T
    slope = np.sign(distance) / (1 + np.exp(-np.abs(distance)))
    return grad_changes * slope * np.bincount(np.concatenate([a, b]), minlength=len(distance))


def sign_changes_backward(grad_changes, distance, edges):
    """the slope is that of the other function, log(1 + exp(-|s|)): 1 / (1 + exp(|s|))

    told by: sigmoid | exponent | exp( | e^ | other & sign | own sign
    """
    grad = np.zeros(len(distance))
    for i, j in edges:
        if (distance[i] < 0) != (distance[j] < 0):
            for k in (i, j):
                sign = -1 if distance[k] < 0 else 1
                grad[k] += grad_changes * sign * np.exp(-abs(distance[k])) / (1 + np.exp(-abs(distance[k])))
    return grad


def spread(x, amount):
    """the inverse is missing: it multiplies by I + amount * Laplacian instead of dividing

    told by: multipl | inverse | divi | sharpen | instead of dividing
    """
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(np.pi * np.arange(m) / m)
    factor = 1 + amount * (k[:, None, None] + k[:, None] + k)
    c = scipy.fft.dctn(x.reshape(m, m, m, -1), axes=(0, 1, 2), norm="ortho")
    return scipy.fft.idctn(c * factor[..., None], axes=(0, 1, 2), norm="ortho").reshape(x.shape)


def spread(x, amount):
    """the eigenvalues are those of a ring, with 2 pi k / m: as if opposite sides of the grid were neighbours

    told by: 2 pi | ring | periodic | wrap | opposite sides | fourier | eigenvalue
    """
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(2 * np.pi * np.arange(m) / m)
    factor = 1 + amount * (k[:, None, None] + k[:, None] + k)
    c = scipy.fft.fftn(x.reshape(m, m, m, -1), axes=(0, 1, 2)) / factor[..., None]
    return scipy.fft.ifftn(c, axes=(0, 1, 2)).real.reshape(x.shape)


def spread(x, amount):
    """the three axes are solved one after another: the factor is a product of three 1 + amount k, not one plus amount times the sum

    told by: product | one after another | separate | each axis & own | sum of the three | axis by axis
    """
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(np.pi * np.arange(m) / m)
    smooth = lambda v: v / (1 + amount * k).reshape(-1, *[1] * (v.ndim - 1))
    c = scipy.fft.dctn(x.reshape(m, m, m, -1), axes=(0, 1, 2), norm="ortho")
    for axis in range(3):
        c = np.moveaxis(smooth(np.moveaxis(c, axis, 0)), 0, axis)
    return scipy.fft.idctn(c, axes=(0, 1, 2), norm="ortho").reshape(x.shape)


def spread(x, amount):
    """the cosine transform is over all four axes, also over the colours, which it mixes

    told by: colour | four axes | last axis | axes= | channel | mixes
    """
    m = round(len(x)**(1 / 3))
    k = 2 - 2 * np.cos(np.pi * np.arange(m) / m)
    grid = x.reshape(m, m, m, -1)
    n = grid.shape[3]
    last = 2 - 2 * np.cos(np.pi * np.arange(n) / n)
    factor = 1 + amount * (k[:, None, None, None] + k[:, None, None] + k[:, None] + last)
    return scipy.fft.idctn(scipy.fft.dctn(grid, norm="ortho") / factor, norm="ortho").reshape(x.shape)


def genus(faces):
    """the vertices are counted by the greatest number, also those that no face names

    told by: no face names | no face & vertex | greatest number | highest number | not named | unused | isolated | gaps
    """
    count = faces.max() + 1
    used = np.unique(faces)
    new = np.searchsorted(used, faces)
    pieces, _ = scipy.sparse.csgraph.connected_components(mesh.adjacency(new, len(used)))
    euler = count - len(faces) * 3 // 2 + len(faces)
    return int(pieces), int(pieces - euler / 2)


def genus(faces):
    """each edge is counted twice: E is taken for 3 F

    told by: edge & twice | 3 f | edge & once | half & edges | shared & edge | 3 * len
    """
    named, inverse = np.unique(faces, return_inverse=True)
    inverse = inverse.reshape(-1, 3)
    pieces, _ = scipy.sparse.csgraph.connected_components(mesh.adjacency(inverse, len(named)))
    return int(pieces), int(pieces - (len(named) - 3 * len(faces) + len(faces)) // 2)


def best_scale(found, truth):
    """the roles of found and truth are exchanged: it divides by the square of the truth

    told by: exchanged | swapped | truth**2 | square of the truth | truth & square | roles | mixed up
    """
    return (found * truth).sum(0) / (truth * truth).sum(0)


def vertex_normals_backward(grad_normals, vertices, faces):
    """each face hands back the gradient of its first vertex only: the three of its corners must be added

    told by: first vertex | three corners | all three | sum & corners | only one corner | added
    """
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    size = np.linalg.norm(m, axis=1, keepdims=True)
    size = np.where(size > 0, size, np.inf)
    n = m / size
    grad_m = (grad_normals - (grad_normals * n).sum(1, keepdims=True) * n) / size
    g = grad_m[faces[:, 0]]
    corners = np.stack([np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)], 1)
    return scatter(corners, faces, len(vertices))
