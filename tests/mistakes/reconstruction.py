"""Mistakes of lab 16: what the reference says, what somebody wrote instead, what a student reads.

Each sentence goes on after "this is what comes out when".
"""
G = "g = np.moveaxis(grad_basis, -1, 0)"
STACK = """np.stack([C1 * g[3] + C2 * (y * g[4] + z * g[7]) + 2 * C4 * x * g[8],
                     C1 * g[1] + C2 * (x * g[4] + z * g[5]) - 2 * C4 * y * g[8],
                     C1 * g[2] + C2 * (y * g[5] + x * g[7]) + 6 * C3 * z * g[6]], -1)"""
FREE = "the part along the normal is taken away; x, y and z count as free"
E_N = "(sh_basis(normals) @ light)"
BY_NORMALS = "sh_basis_backward(grad_irradiance @ light.T, normals)"
BY_AREA = """m = to_vertices(np.repeat(np.cross(b - a, c - a)[:, None], 3, 1), faces, len(vertices))
    length = np.linalg.norm(m, axis=1, keepdims=True)
    length = np.where(length > 0, length, np.inf)
    n = m / length
    grad_m = (grad_normals - (grad_normals * n).sum(1, keepdims=True) * n) / length
    # (b - a) x (c - a) = b x c + c x a + a x b, so g . that is a . (b x g - c x g) + ...
    g = grad_m[faces].sum(1)
"""
BY_NUMBER = f"""size = np.linalg.norm(np.cross(b - a, c - a), axis=1, keepdims=True)
    unit = np.cross(b - a, c - a) / size
    {BY_AREA.replace("np.cross(b - a, c - a)", "unit")}\
    g = (g - (g * unit).sum(1, keepdims=True) * unit) / size
"""
RIGHT_ANGLE = "grad_normals - (grad_normals * n).sum(1, keepdims=True) * n"
LENGTH = "length = np.where(length > 0, length, np.inf)"
CORNERS = "[np.cross(b - c, g), np.cross(c - a, g), np.cross(a - b, g)]"
SUM_FACES = "return to_vertices(corners, faces, len(vertices))"
COLOUR = "square[..., :3].mean()"
SUM = "sums are taken for means: larger pictures have larger losses"
SHARES = "(1 - t) * grad_level, t * grad_level"
SUM_LEVELS = "return np.bincount(ends.ravel(), shares.ravel(), len(distance))"
CROSSED = "(s_a < 0) != (s_b < 0)"
LOSSES = "np.logaddexp(0, np.abs([s_a[crossed], s_b[crossed]]))"
SLOPE = "sign / (1 + np.exp(-np.abs(distance)))"
COUNTS = "np.bincount(np.concatenate([a, b]), minlength=len(distance))"
OWN_SIGN = "an end is compared with its own sign; it is to be the other end's"
K_CUBED = "(k[:, None, None] + k[:, None] + k)"
DIVIDED = "coefficients /= factor[..., None]"
EULER = "len(named) - len(faces) // 2"
GENUS = f"int(pieces - ({EULER}) // 2)"
QUOTIENT = "(found * truth).sum(0) / (found**2).sum(0)"

MISTAKES = {
    "16.1": [
        ("C1 * y, C1 * z, C1 * x", "C1 * x, C1 * y, C1 * z",
         "Y_1, Y_2, Y_3 go with x, y, z; their order is y, z, x"),
        ("(3 * z**2 - 1)", "3 * z**2", "Y_6 lacks its -1"),
        ("(3 * z**2 - 1)", "(2 * z**2 - x**2 - y**2)",
         "Y_6 is the polynomial that agrees for unit normals alone"),
        ("(x**2 - y**2)", "(y**2 - x**2)", "Y_8 has the wrong sign"),
        ("C4 * ", "C2 * ", "Y_8 has the factor C2; its own is half of that"),
        ("normals, -1, 0)",
         "normals / np.linalg.norm(normals, axis=-1, keepdims=True), -1, 0)",
         "normals are made unit first; the polynomials are meant for any length"),
        ("C2 * y * z,\n", "C2 * x * z,\n", "x z comes twice, and y z is missing"),
    ],
    "16.2": [
        ("6 * C3 * z", "3 * C3 * z", "z^2 has the slope z: the 2 is missing"),
        ("- 2 * C4 * y", "+ 2 * C4 * y", "y^2 counts with +; Y_8 has x^2 - y^2"),
        ("2 * C4 * ", "C4 * ", "x^2 and y^2 have the slopes x and y: the 2 is missing"),
        (G, f"{G}[[0, 2, 3, 1, 4, 5, 6, 7, 8]]",
         "gradients of Y_1, Y_2, Y_3 go to x, y, z; they belong to y, z, x"),
        (G, f"{G}[[0, 1, 2, 3, 4, 7, 6, 5, 8]]", "Y_5 is taken for x z, and Y_7 for y z"),
        (f"return {STACK}", f"grad = {STACK}\n    length = (normals**2).sum(-1, keepdims=True)\n"
         "    return grad - (grad * normals).sum(-1, keepdims=True) * normals / length", FREE),
    ],
    "16.3": [
        ("A[:, None] * ", "", "A is left out: these are the lamps as they are seen, not what a "
         "surface gets from them"),
        ("A[:, None]", "A[:, None] / np.pi", "pi is divided out of A"),
        ("@ strength)", "@ strength / len(towards))", "lamps are averaged; they add up"),
        ("sh_basis(towards)", "sh_basis(-towards)", "directions go from the lamp to the surface; "
         "they are to go to the lamp"),
        ("sh_basis(towards).T @ strength", "sh_basis(towards).sum(0)[:, None] * strength.sum(0)",
         "every lamp's strength comes from all directions"),
        ("sh_basis(towards).T @ strength", "sh_basis(towards.mean(0))[:, None] * strength.sum(0)",
         "all lamps are put into their mean direction"),
    ],
    "16.4": [
        (f"albedo * {E_N}", E_N, "albedo is left out"),
        ("albedo * ", "albedo / np.pi * ", "albedo is divided by pi; eq. (3) has none"),
        (E_N, "np.maximum(sh_basis(normals) @ light, 0)", "light below 0 is cut off; eq. (1) keeps "
         "it"),
        (E_N, f"{E_N}.mean(1, keepdims=True)", "all colours get the mean light; each has its own"),
        ("@ light", "@ (A[:, None] * light)", "A is multiplied in once more; the light has it"),
    ],
    "16.5": [
        ("grad_irradiance @ light.T", "grad_colour @ light.T",
         "albedo is left out of the gradient by the normals"),
        ("basis.T @ grad_irradiance", "basis.T @ grad_colour",
         "albedo is left out of the gradient by the light"),
        ("basis.T @ grad_irradiance", "basis.T @ grad_irradiance / len(normals)",
         "the light's gradient is the mean over the points instead of the sum"),
        ("(grad_colour * (", "(grad_irradiance * (", "albedo is a factor of its own gradient"),
        ("grad_irradiance @ light.T", "grad_irradiance @ light.T / light.shape[1]",
         "the normals' gradient is the mean over the colours instead of the sum"),
        (f"return (grad_colour * (basis @ light), {BY_NORMALS}",
         f"grad = {BY_NORMALS}\n    return (grad_colour * (basis @ light), "
         "grad - (grad * normals).sum(1, keepdims=True) * normals", FREE),
    ],
    "16.6": [
        (RIGHT_ANGLE, "grad_normals", "the part of the gradient along the normal stays: m's length "
         "would change the normal"),
        (") / length\n", ")\n", "the gradient is not divided by the length of m"),
        (LENGTH, "length = np.where(length > 0, length, 1)",
         "a vertex whose m is 0 hands its gradient back to its faces"),
        (LENGTH, "", "0 is divided by 0 where m is 0"),
        (CORNERS, "[np.cross(g, b - c), np.cross(g, c - a), np.cross(g, a - b)]",
         "the cross product's sides are swapped: all has the wrong sign"),
        ("grad_m[faces].sum(1)", "grad_m[faces[:, 0]]",
         "a face turns the normal of its first corner alone"),
        (BY_AREA, BY_NUMBER, "all faces count alike in m; each counts by its area"),
        (SUM_FACES, "grad_vertices = np.zeros(vertices.shape)\n"
         "    grad_vertices[faces] = corners\n    return grad_vertices",
         "a vertex keeps what its last face gives; the faces' shares add up"),
        (CORNERS, "[0 * g, np.cross(c - a, g), np.cross(a - b, g)]",
         "a face's first corner gets nothing; both of its sides begin there"),
    ],
    "16.7": [
        (".mean()", ".sum()", SUM),
        (COLOUR, "square.mean()", "coverage counts among the colours, too"),
        ("(picture - target)**2", "np.abs(picture - target)", "differences are not squared"),
        (COLOUR, "square[..., :3].sum(-1).mean()",
         "colour is a mean over the pixels, not over all 3 H W numbers"),
        (f"{COLOUR} + weight * ", f"weight * {COLOUR} + ", "the weight is the colours', not the "
         "coverage's"),
    ],
    "16.8": [
        ("2 * grad_loss", "grad_loss", "the 2 of the square is missing"),
        ("(picture - target)", "(target - picture)", "the sign is wrong: it is the gradient by the "
         "target"),
        ("[1 / 3, 1 / 3, 1 / 3, weight]", "[1, 1, 1, weight]",
         "colours are divided by H W instead of 3 H W"),
        ("[1 / 3, 1 / 3, 1 / 3, weight]", "[3 / 4, 3 / 4, 3 / 4, 3 / 4 * weight] / np.array(3)",
         "all is divided by 4 H W; colour and coverage have means of their own"),
        ("1 / 3, weight]", "1 / 3, 1]", "coverage's weight is left out"),
        (" / picture[..., 0].size", "", SUM),
        ("2 * grad_loss", "2", "grad_loss is left out"),
    ],
    "16.9": [
        (SHARES, "t * grad_level, (1 - t) * grad_level", "the ends' shares are swapped: the nearer "
         "end gets more"),
        ("(s_a - s_b)", "(s_b - s_a)", "t has the wrong sign: it is from 0 to 1"),
        (SUM_LEVELS, "grad_distance = np.zeros(len(distance))\n    grad_distance[ends] = shares\n"
         "    return grad_distance", "an end of several vertices keeps the last one's share"),
        (SHARES, "0 * grad_level, 0 * grad_level", "the vertex moves along: s stays 0 there, and "
         "nothing has a gradient"),
        (SHARES, "grad_level / 2, grad_level / 2", "both ends get one half"),
    ],
    "16.10": [
        (CROSSED, "np.sign(s_a) != np.sign(s_b)", "0 has a sign of its own; it counts as +"),
        (CROSSED, "s_a * s_b < 0", "an edge from inside to 0 is not crossed; 0 has the sign +"),
        (CROSSED, "np.ones(len(s_a), bool)", "edges count that are not crossed"),
        (LOSSES, "np.log(1 + np.exp(np.abs([s_a[crossed], s_b[crossed]])))",
         "exp overflows for large numbers"),
        (LOSSES, "np.logaddexp(0, -np.abs([s_a[crossed], s_b[crossed]]))", OWN_SIGN),
        ("[s_a[crossed], s_b[crossed]]", "s_a[crossed]", "an edge counts at one end alone"),
        (".sum()", ".sum() / len(edges)", "it is a mean over the edges instead of the sum"),
        (".sum()", ".sum() / np.log(2)", "the logarithm is to the base 2"),
    ],
    "16.11": [
        ("-1, 1)", "1, -1)", "the sign is wrong: more inside makes the loss less"),
        ("np.exp(-np.abs(distance))", "np.exp(np.abs(distance))", OWN_SIGN),
        ("np.where(distance < 0, -1, 1)", "np.sign(distance)",
         "a distance of 0 has no slope; it changes as a small positive one would"),
        ("edges[(distance[edges] < 0).sum(1) == 1].T", "edges.T", "edges count that are not "
         "crossed"),
        (COUNTS, "np.isin(np.arange(len(distance)), [*a, *b])",
         "an end of several crossed edges gets one edge's share"),
        ("np.concatenate([a, b])", "a", "each edge's second end gets nothing"),
        ("grad_changes * ", "", "the gradient that comes in is left out"),
        (SLOPE, "sign * np.exp(np.abs(distance)) / (1 + np.exp(np.abs(distance)))",
         "exp overflows: far away it is inf / inf"),
        (SLOPE, "sign / (1 + np.exp(-np.abs(distance))) / len(edges)",
         "it is the gradient of a mean over the edges"),
    ],
    "16.12": [
        ("np.pi * np.arange(m)", "2 * np.pi * np.arange(m)",
         "the cosine has 2 pi k / m, as where the grid wraps around; here it has pi k / m"),
        ("1 + amount", "1 - amount", "the Laplacian has the wrong sign"),
        (K_CUBED, "k[:, None, None] * k[:, None] * k",
         "the three axes' factors are multiplied; the Laplacian is their sum"),
        (DIVIDED, DIVIDED.replace("/", "*"), "the matrix is applied; it is to be solved for y"),
        (DIVIDED, "coefficients *= 2 - factor[..., None]",
         "one step, x - amount * Laplacian(x), is taken instead of solving for y"),
        ("(x.reshape(m, m, m, -1), axes=(0, 1, 2), norm=\"ortho\")",
         "(x.reshape(m, m, m, -1), axes=(0, 1, 2))", "dctn and idctn have different norms"),
        ("axes=(0, 1, 2)", "axes=(0, 1)", "one of the three axes is not transformed"),
        ("2 - 2 * np.cos", "1 - np.cos", "k's factor lacks its 2"),
    ],
    "16.13": [
        (EULER, "named.max() + 1 - len(faces) // 2", "numbers that no face names count as "
         "vertices"),
        (EULER, "len(named) - 2 * len(faces)", "each edge counts twice, once for either face"),
        ("int(pieces - (", "int(1 - (", "there is taken to be one piece"),
        (GENUS, f"int(2 * pieces - ({EULER}))", "the 2 is missing: twice the genus comes out"),
        (f"int(pieces), {GENUS}", f"{GENUS}, int(pieces)", "pieces and genus are swapped"),
        (GENUS, f"int({EULER})", "V - E + F is taken for the genus"),
    ],
    "16.14": [
        ("(found**2)", "(truth**2)", "it is the factor that takes truth to found"),
        (QUOTIENT, "np.full(found.shape[1], (found * truth).sum() / (found**2).sum())",
         "all colours get the same factor"),
        (QUOTIENT, "truth.sum(0) / found.sum(0)", "it is the quotient of the means; least squares "
         "weighs by found"),
        (QUOTIENT, "(truth / np.where(found == 0, 1, found)).mean(0)",
         "it is the mean of the quotients; least squares weighs by found"),
        (QUOTIENT, "np.sqrt((truth**2).sum(0) / (found**2).sum(0))",
         "found gets truth's length; that is not nearest to truth"),
        (".sum(0)", ".sum(1)", "sums go over the colours instead of the vertices"),
    ],
}
