"""Wrong answers to reconstruction, written without a look at the checks."""


def sh_basis(normals):
    """the three linear ones are in the order x, y, z, not y, z, x

    told by: x, y, z | y, z, x | order & linear | order & Y_1 | Y_1 & Y_3 | order of the & basis | linear & swapped
    """
    x, y, z = normals[..., 0], normals[..., 1], normals[..., 2]
    return np.stack([np.full_like(x, C0), C1 * x, C1 * y, C1 * z, C2 * x * y, C2 * y * z,
                     C3 * (3 * z**2 - 1), C2 * x * z, C4 * (x**2 - y**2)], axis=-1)


def sh_basis(normals):
    """the odd ones have a minus, which another convention (Condon-Shortley) gives them

    told by: convention | condon | minus sign | sign & odd | sign & Y_1 | sign & Y_3 | signs of the
    """
    sign = np.array([1, -1, 1, -1, 1, -1, 1, -1, 1])
    x, y, z = normals[..., 0], normals[..., 1], normals[..., 2]
    basis = np.empty(normals.shape[:-1] + (9,))
    for k, term in enumerate([C0 + 0 * x, C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * y * z,
                              C3 * (3 * z * z - 1), C2 * x * z, C4 * (x * x - y * y)]):
        basis[..., k] = sign[k] * term
    return basis


def sh_basis(normals):
    """the nine numbers are along the first axis, not along the last one

    told by: first axis | last axis | axis 0 | axis=0 | axis -1 | transpos | (9,
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * y * z,
                     C3 * (3 * z**2 - 1), C2 * x * z, C4 * (x**2 - y**2)])


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
    """the lamps are averaged, not summed

    told by: mean | average | sum & lamps | summed | number of lamps | add up
    """
    each = sh_basis(towards)[:, :, None] * strength[:, None, :]
    return A[:, None] * each.mean(axis=0)


def shade(albedo, normals, light):
    """the factors A of eq. (2) are multiplied in again, though light contains them

    told by: A_k | eq. (2) | factors A | twice | already & light | light & contain | lobe
    """
    return albedo * ((sh_basis(normals) * A) @ light)


def shade(albedo, normals, light):
    """light below 0 is cut off at 0

    told by: clip | clamp | negative | below 0 | cut off | maximum | < 0
    """
    colours = np.empty_like(albedo)
    for v in range(len(albedo)):
        colours[v] = albedo[v] * np.maximum(sh_basis(normals[v]) @ light, 0)
    return colours


def shade(albedo, normals, light):
    """the colour is divided by pi, though eq. (3) has no such factor

    told by: by pi | / pi | factor pi | factor of pi | np.pi | 3.14 | lambert
    """
    irradiance = np.einsum("vk,kc->vc", sh_basis(normals), light)
    return albedo / np.pi * irradiance


def shade_backward(grad_colour, albedo, normals, light):
    """grad_normals lacks the factor albedo

    told by: grad_normals & albedo | normals & without & albedo | albedo & factor | albedo & forgot | albedo & missing | albedo & times | albedo & left out
    """
    Y = sh_basis(normals)
    to_normals = sh_basis_backward(grad_colour @ light.T, normals)
    return grad_colour * (Y @ light), to_normals, Y.T @ (albedo * grad_colour)


def shade_backward(grad_colour, albedo, normals, light):
    """grad_light is the mean over the vertices, not their sum

    told by: grad_light & mean | grad_light & average | mean over & vert | light & sum & vert | number of vertices | light & summed | mean & sum
    """
    Y = sh_basis(normals)
    g = grad_colour * albedo
    to_light = np.zeros(light.shape)
    for v in range(len(Y)):
        to_light += Y[v][:, None] * g[v] / len(Y)
    return grad_colour * (Y @ light), sh_basis_backward(g @ light.T, normals), to_light


def shade_backward(grad_colour, albedo, normals, light):
    """the part of grad_normals along the normal is taken away, as if n could only turn

    told by: along the normal | along n | along itself | tangent | project | perpendicular | all three directions
    """
    basis = sh_basis(normals)
    g = grad_colour * albedo
    to_normals = sh_basis_backward(g @ light.T, normals)
    to_normals = to_normals - (to_normals * normals).sum(1, keepdims=True) * normals
    return grad_colour * (basis @ light), to_normals, basis.T @ g


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


def vertex_normals_backward(grad_normals, vertices, faces):
    """faces that share a vertex overwrite each other's gradient instead of adding to it

    told by: overwrit | add.at | share a vertex | shared vert | several faces | only the last face | accumulat
    """
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    size = np.linalg.norm(m, axis=1, keepdims=True)
    size[size == 0] = np.inf
    n = m / size
    g_m = (grad_normals - n * (n * grad_normals).sum(1, keepdims=True)) / size
    g = g_m[faces].sum(1)
    out = np.zeros_like(vertices)
    out[faces[:, 0]] += np.cross(b - c, g)
    out[faces[:, 1]] += np.cross(c - a, g)
    out[faces[:, 2]] += np.cross(a - b, g)
    return out


def vertex_normals_backward(grad_normals, vertices, faces):
    """corner a gets nothing, though both edges b - a and c - a begin there

    told by: corner a | first corner | vertex a | a gets nothing | minus the sum | both edges | first vertex
    """
    grad = np.zeros(vertices.shape)
    m = np.zeros(vertices.shape)
    for i, j, k in faces:
        normal = np.cross(vertices[j] - vertices[i], vertices[k] - vertices[i])
        for v in (i, j, k):
            m[v] += normal
    length = np.sqrt((m**2).sum(1))[:, None]
    length = np.where(length > 0, length, np.inf)
    n = m / length
    g_m = (grad_normals - n * (n * grad_normals).sum(1, keepdims=True)) / length
    for i, j, k in faces:
        g = g_m[i] + g_m[j] + g_m[k]
        grad[j] += np.cross(vertices[k] - vertices[i], g)
        grad[k] += np.cross(g, vertices[j] - vertices[i])
    return grad


def picture_loss_backward(grad_loss, picture, target, weight):
    """the sign is turned round: it is target - picture

    told by: sign | target - picture | picture - target | minus | opposite | turned round | wrong way
    """
    pixels = picture[..., 0].size
    grad = 2 * grad_loss * (target - picture) / pixels
    return grad * np.array([1 / 3, 1 / 3, 1 / 3, weight])


def picture_loss_backward(grad_loss, picture, target, weight):
    """it divides by the pixels of one picture, not of all pictures

    told by: one picture | several pictures | all pictures | number of pictures | single picture | leading ax | more than one picture
    """
    height, width = picture.shape[-3:-1]
    difference = picture - target
    grad = np.empty(picture.shape)
    for c in range(4):
        share = weight if c == 3 else 1 / 3
        grad[..., c] = 2 * share * grad_loss * difference[..., c] / (height * width)
    return grad


def picture_loss_backward(grad_loss, picture, target, weight):
    """weight multiplies the colours, not the coverage

    told by: weight & colour | weight & coverage | weight & exchanged | weight & swapped | weight & fourth | weight & last channel | weight & red
    """
    pixels = picture.size // 4
    slope = 2 * (picture - target) * grad_loss
    return np.concatenate([weight * slope[..., :3] / (3 * pixels), slope[..., 3:] / pixels], -1)


def level_backward(grad_level, ends, distance):
    """a gets the share t and b the share 1 - t: they are exchanged

    told by: t and 1 - t | exchang | swap | other end | a and b & mixed | nearer end | 1 - t and t
    """
    grad = np.zeros(len(distance))
    for (a, b), g in zip(ends, grad_level):
        t = distance[a] / (distance[a] - distance[b])
        grad[a] += t * g
        grad[b] += (1 - t) * g
    return grad


def sign_changes(distance, edges):
    """only edges whose first end is inside count: those given outside first are left out

    told by: first end | any order | outside first | either order | inside first | order of the ends | order of the pair
    """
    s_a, s_b = distance[edges[:, 0]], distance[edges[:, 1]]
    crossed = (s_a < 0) & (s_b >= 0)
    return np.logaddexp(0, np.abs([s_a[crossed], s_b[crossed]])).sum()


def sign_changes(distance, edges):
    """it sums log(1 + e^-|s|): the sign of the exponent is turned round

    told by: exponent & sign | sign of the exponent | grow | sign(other) | falls & far | far from 0 | exp(-abs
    """
    total = 0.0
    for a, b in edges:
        if (distance[a] < 0) != (distance[b] < 0):
            total += np.log1p(np.exp(-abs(distance[a]))) + np.log1p(np.exp(-abs(distance[b])))
    return total


def sign_changes(distance, edges):
    """only the first end of a crossed edge costs, not both

    told by: both ends | each end | one end | second end | H(s_b, s_a) | two terms | two ends
    """
    s = distance[edges]
    crossed = (s < 0).sum(1) == 1
    return np.logaddexp(0, np.abs(s[crossed, 0])).sum()


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
    """the factors of the three axes are multiplied, (1 + amount k_x) (1 + amount k_y) (1 + amount k_z), not their k added

    told by: axes & product | axes & multipl | axes & added | axes & sum | each axis & own | separab | axis by axis
    """
    m = round(len(x)**(1 / 3))
    row = 1 + amount * (2 - 2 * np.cos(np.pi * np.arange(m) / m))
    y = x.reshape(m, m, m, -1)
    for axis in range(3):
        along = [1, 1, 1, 1]
        along[axis] = m
        coefficients = scipy.fft.dct(y, axis=axis, norm="ortho") / row.reshape(along)
        y = scipy.fft.idct(coefficients, axis=axis, norm="ortho")
    return y.reshape(x.shape)


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
    """it is the ratio of the sums (or means), not the factor of the least squares

    told by: ratio | least squares | means | sum of truth | averages | brightness | found * truth | mean of quotients, or of sums
    """
    return truth.sum(0) / found.sum(0)


def sh_basis(normals):
    """Y_1, Y_2, Y_3 are in the order x, y, z instead of y, z, x

    told by: order | x, y, z | y, z, x | exchanged | swapped | permut | y_1
    """
    x, y, z = normals[..., 0], normals[..., 1], normals[..., 2]
    one = np.full(x.shape, C0)
    return np.stack([one, C1 * x, C1 * y, C1 * z, C2 * x * y, C2 * y * z,
                     C3 * (3 * z**2 - 1), C2 * x * z, C4 * (x**2 - y**2)], axis=-1)


def sh_basis(normals):
    """the nine numbers are on the first axis of the result, which is transposed

    told by: transpos | axis | shape | first axis | last axis
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.array([C0 * np.ones_like(x), C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * y * z,
                     C3 * (3 * z * z - 1), C2 * x * z, C4 * (x * x - y * y)])


def sh_basis(normals):
    """the - 1 of Y_6 = C3 (3 z^2 - 1) is left out

    told by: - 1 of | minus 1 | y_6 | 3 z^2 | the - 1 | seventh
    """
    out = np.empty((*normals.shape[:-1], 9))
    for k in np.ndindex(*normals.shape[:-1]):
        x, y, z = normals[k]
        out[k] = (C0, C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * y * z,
                  C3 * 3 * z**2, C2 * x * z, C4 * (x**2 - y**2))
    return out


def shade(albedo, normals, light):
    """the colour is divided by pi, which eq. (3) does not do

    told by: by pi | / pi | np.pi | factor pi | 3.14 | 1/pi
    """
    irradiance = sh_basis(normals) @ light
    return albedo / np.pi * irradiance


def shade(albedo, normals, light):
    """negative light is cut off at 0, eq. (3) has no maximum

    told by: negative | cut off | clip | maximum | max( | below 0 | clamp
    """
    colours = np.zeros(albedo.shape)
    for v, n in enumerate(normals):
        colours[v] = albedo[v] * np.maximum(sh_basis(n) @ light, 0)
    return colours


def shade_backward(grad_colour, albedo, normals, light):
    """the albedo is left out of the normals' gradient

    told by: albedo & normal | without & albedo | albedo & missing | albedo & left out | factor & albedo | multipl & albedo | times & albedo
    """
    Y = sh_basis(normals)
    grad_n = sh_basis_backward(grad_colour @ light.T, normals)
    return grad_colour * (Y @ light), grad_n, Y.T @ (grad_colour * albedo)


def shade_backward(grad_colour, albedo, normals, light):
    """grad_light is the mean over the vertices instead of the sum

    told by: mean | average | divided & vertices | number of vertices | sum over & vertices
    """
    Y = sh_basis(normals)
    g = albedo * grad_colour
    return ((Y @ light) * grad_colour, sh_basis_backward(g @ light.T, normals),
            (Y[:, :, None] * g[:, None]).mean(0))


def vertex_normals_backward(grad_normals, vertices, faces):
    """the normalisation is held as a factor: the part of the gradient along the normal is not taken away

    told by: along n | along the normal | project | normalis | normaliz | only makes m longer | length & held
    """
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    grad_m = grad_normals / np.where(length > 0, length, np.inf)
    g = grad_m[faces].sum(1)
    return scatter(np.stack([np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)], 1),
                   faces, len(vertices))


def vertex_normals_backward(grad_normals, vertices, faces):
    """+= with repeated indices: a vertex of several faces keeps the gradient of the last one only

    told by: repeat | += | add.at | several faces | last face | overwrit | more than one face
    """
    a, b, c = vertices[faces.T]
    m = np.zeros(vertices.shape)
    for k in range(3):
        np.add.at(m, faces[:, k], np.cross(b - a, c - a))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    length[length == 0] = np.inf
    n = m / length
    g = ((grad_normals - n * (n * grad_normals).sum(1, keepdims=True)) / length)[faces].sum(1)
    out = np.zeros(vertices.shape)
    out[faces[:, 0]] += np.cross(b - c, g)
    out[faces[:, 1]] += np.cross(c - a, g)
    out[faces[:, 2]] += np.cross(a - b, g)
    return out


def vertex_normals_backward(grad_normals, vertices, faces):
    """the gradient is not divided by the length of m

    told by: length of m | divid & length | by the length | by its length | length & left out
    """
    m = np.zeros(vertices.shape)
    for f in faces:
        a, b, c = vertices[f]
        m[f] += np.cross(b - a, c - a)
    size = np.linalg.norm(m, axis=1)
    result = np.zeros(vertices.shape)
    grad_m = np.zeros(vertices.shape)
    for v in np.flatnonzero(size):
        n = m[v] / size[v]
        grad_m[v] = grad_normals[v] - (grad_normals[v] @ n) * n
    for f in faces:
        a, b, c = vertices[f]
        g = grad_m[f].sum(0)
        result[f] += [np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)]
    return result


def picture_loss_backward(grad_loss, picture, target, weight):
    """all gradients are divided by the number of all four channels' numbers, instead of each mean by its own

    told by: four channels | all numbers | own numbers | picture.size | number of numbers | each mean | both means
    """
    weights = np.array([1.0, 1.0, 1.0, weight])
    return grad_loss * 2 * weights * (picture - target) / picture.size


def picture_loss_backward(grad_loss, picture, target, weight):
    """the weight is left out of the coverage's gradient

    told by: weight | coverage & factor | fourth & factor | coverage & times | fourth number
    """
    grad = 2 * (picture - target)
    grad[..., :3] /= grad[..., :3].size
    grad[..., 3] /= grad[..., 3].size
    return grad_loss * grad


def picture_loss_backward(grad_loss, picture, target, weight):
    """the colours' mean is over the pixels: the division by 3 colours is left out

    told by: by 3 | three times | factor & 3 | three colours | 1 / 3 | factor of three | 3 times | lack 1/3
    """
    pixels = picture[..., 0].size
    scale = np.array([1, 1, 1, weight]) / pixels
    return 2 * grad_loss * (picture - target) * scale


def sign_changes(distance, edges):
    """the sign is that of the end itself, not of the other one: each end costs log(1 + e^-|s|)

    told by: sign & other | other end | e^- | own sign | opposite | minus | sign & exponent
    """
    total = 0.0
    for a, b in edges:
        s, r = distance[a], distance[b]
        if (s < 0) != (r < 0):
            total += np.logaddexp(0, -abs(s)) + np.logaddexp(0, -abs(r))
    return total


def sign_changes(distance, edges):
    """all edges are summed, also those that are not crossed

    told by: not crossed | all edges | crossed edges | every edge | uncrossed | same sign | no sign change
    """
    s_a, s_b = distance[edges[:, 0]], distance[edges[:, 1]]
    sign = np.where(distance < 0, -1, 1)[edges]
    return (np.logaddexp(0, -s_a * sign[:, 1]) + np.logaddexp(0, -s_b * sign[:, 0])).sum()


def sign_changes(distance, edges):
    """the mean over the crossed edges is returned instead of their sum

    told by: mean | average | divided & edges | number of & edges | not the sum | per edge
    """
    s = distance[edges]
    s = s[(s < 0).sum(1) == 1]
    cost = np.logaddexp(0, np.abs(s)).sum(1)
    return cost.mean() if len(cost) else 0.0


def sh_basis_backward(grad_basis, normals):
    """Y_7 = C2 x z gives its gradient to x only, and z gets none

    told by: y_7 | x z | eighth | product rule | both factors | z gets
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    g = np.moveaxis(grad_basis, -1, 0)
    out = np.zeros(normals.shape)
    out[..., 0] = C1 * g[3] + C2 * y * g[4] + C2 * z * g[7] + 2 * C4 * x * g[8]
    out[..., 1] = C1 * g[1] + C2 * x * g[4] + C2 * z * g[5] - 2 * C4 * y * g[8]
    out[..., 2] = C1 * g[2] + C2 * y * g[5] + 6 * C3 * z * g[6]
    return out


def distant_light(towards, strength):
    """the factors A_k are left out

    told by: a_k | factor a | factors a | without a_ | multipl & a_ | times a
    """
    light = np.zeros((9, strength.shape[1]))
    for d, s in zip(towards, strength):
        light += np.outer(sh_basis(d), s)
    return light


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


def sign_changes_backward(grad_changes, distance, edges):
    """the slope's sign is left out: a negative distance gets a positive gradient, too

    told by: sign | negative distance | inside & positive | always positive | absolute
    """
    grad = np.zeros(len(distance))
    for a, b in edges:
        if (distance[a] < 0) != (distance[b] < 0):
            for end in (a, b):
                grad[end] += grad_changes / (1 + np.exp(-abs(distance[end])))
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
    """(V - E + F) is not halved in eq. (9)

    told by: half | halv | / 2 | by 2 | twice
    """
    names, numbered = np.unique(faces, return_inverse=True)
    numbered = numbered.reshape(-1, 3)
    pieces, _ = scipy.sparse.csgraph.connected_components(mesh.adjacency(numbered, len(names)))
    edges, _ = mesh.edges(numbered)
    return int(pieces), int(pieces - (len(names) - len(edges) + len(faces)))


def best_scale(found, truth):
    """found and truth are exchanged: this is the factor from truth to found, over truth^2

    told by: exchang | swap | mixed up | truth^2 | truth to found | squares of truth | reverse
    """
    return (found * truth).sum(0) / (truth * truth).sum(0)


def vertex_normals_backward(grad_normals, vertices, faces):
    """the corners' gradients are cyclically exchanged: each goes to the next corner

    told by: cyclic | next corner | exchanged | wrong corner | swapped | mixed up | shifted | moved on by one
    """
    a, b, c = vertices[faces.T]
    m = scatter(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    size = np.linalg.norm(m, axis=1, keepdims=True)
    size = np.where(size > 0, size, np.inf)
    unit_m = m / size
    g = (grad_normals - (grad_normals * unit_m).sum(1, keepdims=True) * unit_m) / size
    g = g[faces].sum(1)
    parts = [np.cross(a - b, g), np.cross(b - c, g), np.cross(c - a, g)]
    return scatter(np.stack(parts, 1), faces, len(vertices))
