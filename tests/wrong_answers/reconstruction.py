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
    """up is taken to be y: Y_6 has y^2 and Y_8 has x^2 - z^2, as in graphics with y up

    told by: y up | up is y | y^2 & z^2 | y_6 & y_8 | up axis | y and z | for z & y^2 | y_6 & another axis, such as y
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([C0 + 0 * x, C1 * y, C1 * z, C1 * x, C2 * x * y, C2 * y * z,
                     C3 * (3 * y**2 - 1), C2 * x * z, C4 * (x**2 - z**2)], -1)


def sh_basis_backward(grad_basis, normals):
    """the part along the normal is projected away: but n may move along itself

    told by: along itself | along the normal | along n | project | tangent | unit length
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    g = np.moveaxis(grad_basis, -1, 0)
    grad = np.stack([C1 * g[3] + C2 * (y * g[4] + z * g[7]) + 2 * C4 * x * g[8],
                     C1 * g[1] + C2 * (x * g[4] + z * g[5]) - 2 * C4 * y * g[8],
                     C1 * g[2] + C2 * (y * g[5] + x * g[7]) + 6 * C3 * z * g[6]], -1)
    return grad - (grad * normals).sum(-1, keepdims=True) * normals


def sh_basis_backward(grad_basis, normals):
    """the product x y hands a gradient to x only; y, of each product the second, gets none

    told by: both factors | second factor | product & only | each factor | two factors | product rule
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    g = np.moveaxis(grad_basis, -1, 0)
    gx = C1 * g[3] + C2 * y * g[4] + C2 * z * g[7] + 2 * C4 * x * g[8]
    gy = C1 * g[1] + C2 * z * g[5] - 2 * C4 * y * g[8]
    gz = C1 * g[2] + 6 * C3 * z * g[6]
    return np.stack([gx, gy, gz], -1)


def sh_basis_backward(grad_basis, normals):
    """the derivative of 3 z^2 is taken for 3 z, without the factor 2

    told by: 6 z | 3 z | factor 2 | 3 z^2 | y_6 | factor of 2 | half | twice
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    g = np.moveaxis(grad_basis, -1, 0)
    return np.stack([C1 * g[3] + C2 * (y * g[4] + z * g[7]) + 2 * C4 * x * g[8],
                     C1 * g[1] + C2 * (x * g[4] + z * g[5]) - 2 * C4 * y * g[8],
                     C1 * g[2] + C2 * (y * g[5] + x * g[7]) + 3 * C3 * z * g[6]], -1)


def shade(albedo, normals, light):
    """only the first four numbers of the light are used: the quadratic ones are missing

    told by: first four | quadratic | second order | last five | only four | nine
    """
    return albedo * (sh_basis(normals)[:, :4] @ light[:4])


def shade_backward(grad_colour, albedo, normals, light):
    """grad_normals and grad_albedo are returned in each other's place

    told by: order | exchanged | swapped | in each other's place | mixed up | grad_normals & grad_albedo
    """
    basis = sh_basis(normals)
    g = grad_colour * albedo
    return sh_basis_backward(g @ light.T, normals), grad_colour * (basis @ light), basis.T @ g


def picture_loss_backward(grad_loss, picture, target, weight):
    """the mean of the colours counts pixels and not numbers: the 1/3 is missing

    told by: 1/3 | 1 / 3 | three | third | 3 times | number of colours
    """
    pixels = picture[..., 0].size
    return 2 * grad_loss * np.array([1, 1, 1, weight]) * (picture - target) / pixels


def level_backward(grad_level, ends, distance):
    """the shares of the two ends are exchanged: a gets t and b gets 1 - t

    told by: shares | exchanged | swapped | 1 - t | mixed up
    """
    s_a, s_b = distance[ends[:, 0]], distance[ends[:, 1]]
    t = s_a / (s_a - s_b)
    grad = np.zeros(len(distance))
    for v, (a, b) in enumerate(ends):
        grad[a] += t[v] * grad_level[v]
        grad[b] += (1 - t[v]) * grad_level[v]
    return grad


def level_backward(grad_level, ends, distance):
    """each end gets one half, as if t were 1/2

    told by: half | 1/2 | 0.5 | midpoint | equal shares | alike
    """
    grad = np.zeros(len(distance))
    np.add.at(grad, ends[:, 0], grad_level / 2)
    np.add.at(grad, ends[:, 1], grad_level / 2)
    return grad


def sign_changes(distance, edges):
    """fine print: a distance of 0 belongs to no side: an edge is crossed only where the product is negative

    told by: distance of 0 | distance is 0 | exactly 0 | zero | sign of 0 | s = 0
    """
    a, b = distance[edges[:, 0]], distance[edges[:, 1]]
    crossed = a * b < 0
    return np.logaddexp(0, np.abs([a[crossed], b[crossed]])).sum()


def sign_changes(distance, edges):
    """the mean over the crossed edges and not the sum

    told by: mean | average | sum | divided & number | number of edges
    """
    a, b = distance[edges.T]
    crossed = (a < 0) != (b < 0)
    h = np.logaddexp(0, np.abs(a[crossed])) + np.logaddexp(0, np.abs(b[crossed]))
    return h.mean() if len(h) else 0.0


def sign_changes_backward(grad_changes, distance, edges):
    """the slope lacks the sign of the distance: all gradients are positive

    told by: sign | all positive | negative distance | minus | always positive
    """
    a, b = edges[(distance[edges] < 0).sum(1) == 1].T
    slope = 1 / (1 + np.exp(-np.abs(distance)))
    return grad_changes * slope * np.bincount(np.concatenate([a, b]), minlength=len(distance))


def spread(x, amount):
    """only one explicit step, x - amount * Laplacian(x), not the solution of the equation

    told by: explicit | one step | not solve | solution | x - amount | implicit
    """
    m = round(len(x)**(1 / 3))
    g = x.reshape(m, m, m, -1)
    p = np.pad(g, [(1, 1), (1, 1), (1, 1), (0, 0)], mode="edge")
    around = (p[2:, 1:-1, 1:-1] + p[:-2, 1:-1, 1:-1] + p[1:-1, 2:, 1:-1] + p[1:-1, :-2, 1:-1]
              + p[1:-1, 1:-1, 2:] + p[1:-1, 1:-1, :-2])
    return (g - amount * (6 * g - around)).reshape(x.shape)


def genus(faces):
    """it is assumed that there is one piece: genus = 1 - (V - E + F) / 2

    told by: one piece | several pieces | pieces & counted | connected | number of pieces | more than one piece
    """
    v = len(np.unique(faces))
    edges = set()
    for a, b, c in faces:
        for i, j in ((a, b), (b, c), (c, a)):
            edges.add((min(i, j), max(i, j)))
    return 1, int(1 - (v - len(edges) + len(faces)) / 2)


def best_scale(found, truth):
    """the ratio of the means, which is not the least squares

    told by: ratio of & mean | ratio of & sum | least squares | mean & ratio | sums & divided
    """
    return truth.mean(0) / found.mean(0)


def best_scale(found, truth):
    """one factor for all colours together, not one for each

    told by: each colour | one factor | all colours | channel | one number | same factor
    """
    s = np.sum(found * truth) / np.sum(found**2)
    return np.full(found.shape[1], s)


def best_scale(found, truth):
    """the mean of the ratios truth / found of all vertices, which is not the least squares

    told by: mean of & ratio | ratios | least squares | truth / found | averag
    """
    return np.array([np.mean(truth[:, c] / found[:, c]) for c in range(found.shape[1])])


def sh_basis(normals):
    """the constants are left out: these are the bare polynomials

    told by: constant | c0 | c1 | bare | normalis | normaliz | factor
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    return np.stack([np.ones_like(x), y, z, x, x * y, y * z, 3 * z**2 - 1, x * z, x**2 - y**2], -1)


def shade(albedo, normals, light):
    """only the first, constant number of the light counts: the normal plays no role

    told by: constant | ambient | normal & no | first number | light[0] | flat
    """
    ambient = C0 * light[0]
    return albedo * ambient
