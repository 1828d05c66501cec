"""Wrong answers to reconstruction, written without a look at the checks."""


def sh_basis(normals):
    """Y_1, Y_2, Y_3 are in the order x, y, z instead of y, z, x

    told by: order | x, y, z | y, z, x | exchanged | swapped | permut | y_1
    """
    x, y, z = normals[..., 0], normals[..., 1], normals[..., 2]
    one = np.full(x.shape, C0)
    return np.stack([one, C1 * x, C1 * y, C1 * z, C2 * x * y, C2 * y * z,
                     C3 * (3 * z**2 - 1), C2 * x * z, C4 * (x**2 - y**2)], axis=-1)


def sh_basis_backward(grad_basis, normals):
    """the minus of y^2 in Y_8 is lost

    told by: y^2 | y**2 | Y_8 | y * y | last basis | minus & C4 | sign & C4
    """
    x, y, z = normals[..., 0], normals[..., 1], normals[..., 2]
    g = np.moveaxis(grad_basis, -1, 0)
    out = np.zeros(normals.shape)
    out[..., 0] = C1 * g[3] + C2 * y * g[4] + C2 * z * g[7] + 2 * C4 * x * g[8]
    out[..., 1] = C1 * g[1] + C2 * x * g[4] + C2 * z * g[5] + 2 * C4 * y * g[8]
    out[..., 2] = C1 * g[2] + C2 * y * g[5] + C2 * x * g[7] + 6 * C3 * z * g[6]
    return out


def distant_light(towards, strength):
    """the factors A_k are left out

    told by: a_k | factor a | factors a | without a_ | multipl & a_ | times a
    """
    light = np.zeros((9, strength.shape[1]))
    for d, s in zip(towards, strength):
        light += np.outer(sh_basis(d), s)
    return light


def shade(albedo, normals, light):
    """the colour is divided by pi, which eq. (3) does not do

    told by: by pi | / pi | np.pi | factor pi | 3.14 | 1/pi
    """
    irradiance = sh_basis(normals) @ light
    return albedo / np.pi * irradiance


def shade_backward(grad_colour, albedo, normals, light):
    """grad_light is the mean over the vertices instead of the sum

    told by: mean | average | divided & vertices | number of vertices | sum over & vertices
    """
    Y = sh_basis(normals)
    g = albedo * grad_colour
    return ((Y @ light) * grad_colour, sh_basis_backward(g @ light.T, normals),
            (Y[:, :, None] * g[:, None]).mean(0))


def vertex_normals_backward(grad_normals, vertices, faces):
    """the gradient of m is not divided by the length |m|

    told by: length of m | divid & length | norm of m | length & forgot | length & missing | without & length | / length
    """
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    n = mesh.unit(m)
    g_m = grad_normals - n * (n * grad_normals).sum(1, keepdims=True)
    g = g_m[faces].sum(1)
    parts = np.stack([np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)], 1)
    return scatter(parts, faces, len(vertices))


def picture_loss_backward(grad_loss, picture, target, weight):
    """the sign is turned round: it is target - picture

    told by: sign | target - picture | picture - target | minus | opposite | turned round | wrong way
    """
    pixels = picture[..., 0].size
    grad = 2 * grad_loss * (target - picture) / pixels
    return grad * np.array([1 / 3, 1 / 3, 1 / 3, weight])


def level_backward(grad_level, ends, distance):
    """the shares t and 1 - t of the two ends are exchanged

    told by: exchang | swap | mixed up | 1 - t | shares | other end
    """
    inner, outer = distance[ends[:, 0]], distance[ends[:, 1]]
    t = inner / (inner - outer)
    grad = np.zeros(len(distance))
    np.add.at(grad, ends[:, 0], t * grad_level)
    np.add.at(grad, ends[:, 1], (1 - t) * grad_level)
    return grad


def sign_changes(distance, edges):
    """only edges whose first end is inside count: those given outside first are left out

    told by: first end | any order | outside first | either order | inside first | order of the ends | order of the pair
    """
    s_a, s_b = distance[edges[:, 0]], distance[edges[:, 1]]
    crossed = (s_a < 0) & (s_b >= 0)
    return np.logaddexp(0, np.abs([s_a[crossed], s_b[crossed]])).sum()


def sign_changes_backward(grad_changes, distance, edges):
    """a grid point at which several crossed edges meet counts once only

    told by: several edges | share & point | overwrit | add.at | counts once | more than one edge | number of crossed edges
    """
    grad = np.zeros(len(distance))
    crossed = edges[(distance[edges] < 0).sum(1) == 1]
    s = distance[crossed]
    grad[crossed] += grad_changes * np.where(s < 0, -1, 1) / (1 + np.exp(-np.abs(s)))
    return grad


def spread(x, amount):
    """the coefficients have 2 - 2 cos(2 pi k / m), as of a periodic grid, instead of cos(pi k / m)

    told by: 2 pi | pi k | periodic | wrap | frequenc | cos(
    """
    m = int(round(len(x)**(1 / 3)))
    k = 2 - 2 * np.cos(2 * np.pi * np.arange(m) / m)
    below = 1 + amount * (k[:, None, None] + k[:, None] + k)
    c = scipy.fft.dctn(x.reshape(m, m, m, -1), axes=(0, 1, 2), norm="ortho")
    return scipy.fft.idctn(c / below[..., None], axes=(0, 1, 2), norm="ortho").reshape(x.shape)


def genus(faces):
    """the genus is computed as 1 - (V - E + F) / 2, as if there were one piece only

    told by: one piece | single piece | several pieces | two pieces | number of pieces | more than one piece | each piece
    """
    named, inverse = np.unique(faces, return_inverse=True)
    triangles = inverse.reshape(-1, 3)
    pieces, _ = scipy.sparse.csgraph.connected_components(mesh.adjacency(triangles, len(named)))
    euler = len(named) - len(triangles) * 3 // 2 + len(triangles)
    return int(pieces), int(1 - euler // 2)


def best_scale(found, truth):
    """found and truth are exchanged: this is the factor from truth to found, over truth^2

    told by: exchang | swap | mixed up | truth^2 | truth to found | squares of truth | reverse
    """
    return (found * truth).sum(0) / (truth * truth).sum(0)
