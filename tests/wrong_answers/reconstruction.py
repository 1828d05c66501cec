"""Wrong answers to reconstruction, written without a look at the checks."""


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


def sign_changes(distance, edges):
    """only edges whose first end is inside count: those given outside first are left out

    told by: first end | any order | outside first | either order | inside first | order of the ends | order of the pair
    """
    s_a, s_b = distance[edges[:, 0]], distance[edges[:, 1]]
    crossed = (s_a < 0) & (s_b >= 0)
    return np.logaddexp(0, np.abs([s_a[crossed], s_b[crossed]])).sum()
