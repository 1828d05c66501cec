"""Wrong answers to rasterization, written without a look at the checks."""


def edge_function(p, a, b):
    """positive on the right of the line: the sign is flipped, as with y down

    told by: sign | right side | clockwise | y down | flipped | negated
    """
    d = b - a
    q = p - a
    return d[..., 1] * q[..., 0] - d[..., 0] * q[..., 1]


def edge_function(p, a, b):
    """always measured from a, so the two directions of one edge are rounded differently (fine print)

    told by: from a | same end | rounding | rounded | last bit | smaller x
    """
    return (a[..., 1] - b[..., 1]) * (p[..., 0] - a[..., 0]) + (b[..., 0] - a[..., 0]) * (p[..., 1] - a[..., 1])


def edge_function(p, a, b):
    """divided by the length of the edge: a distance in pixels instead of the determinant

    told by: normali | length of the edge | edge's length | distance | unit | divided by & length
    """
    n_x = a[..., 1] - b[..., 1]
    n_y = b[..., 0] - a[..., 0]
    length = np.hypot(n_x, n_y)
    return (n_x * (p[..., 0] - a[..., 0]) + n_y * (p[..., 1] - a[..., 1])) / length


def edge_function_backward(grad_e, p, a, b):
    """the dependence of the normal on a is left out: grad_a is just minus grad_p

    told by: grad_a & -grad_p | grad_a & minus | normal & constant | normal depends | depends on a | n as a constant
    """
    n = np.stack([a[..., 1] - b[..., 1], b[..., 0] - a[..., 0]], -1)
    g = grad_e[..., None]
    grad_b = g * np.stack([p[..., 1] - a[..., 1], a[..., 0] - p[..., 0]], -1)
    return g * n, -g * n, grad_b


def edge_function_backward(grad_e, p, a, b):
    """x and y are exchanged in each gradient

    told by: x and y | components & exchanged | components & swapped | components & order | coordinates & swapped | coordinates & exchanged
    """
    def part(u, v):
        return grad_e[..., None] * np.stack([v[..., 0] - u[..., 0], u[..., 1] - v[..., 1]], -1)

    return part(a, b), part(b, p), part(p, a)


def edge_function_backward(grad_e, p, a, b):
    """all three gradients have the wrong sign: the sides are turned by 90 degrees the other way

    told by: sign | negated | minus | turned the other way | opposite direction | all three & flipped
    """
    g = grad_e
    grad_p = np.stack([g * (b[..., 1] - a[..., 1]), g * (a[..., 0] - b[..., 0])], -1)
    grad_a = np.stack([g * (p[..., 1] - b[..., 1]), g * (b[..., 0] - p[..., 0])], -1)
    grad_b = np.stack([g * (a[..., 1] - p[..., 1]), g * (p[..., 0] - a[..., 0])], -1)
    return grad_p, grad_a, grad_b


def is_inside(p, triangle):
    """points inside a clockwise triangle are outside: only positive edge functions count

    told by: clockwise | winding | either way | negative | wound | orientation
    """
    result = np.ones(p.shape[:-1], bool)
    for i, j in EDGES:
        result &= edge_function(p, triangle[i], triangle[j]) >= 0
    return result


def is_top_left(n_x, n_y):
    """takes n as the direction of the edge instead of its normal

    told by: direction of the edge | edge direction | edge's direction | tangent | x and y | n_x and n_y
    """
    return (n_y < 0) | ((n_y == 0) & (n_x > 0))


def is_top_left(n_x, n_y):
    """horizontal edges are forgotten: only left edges count

    told by: horizontal | only left | n_x = 0 | n_x == 0 | n_y is ignored | lower edge
    """
    return n_x > 0


def is_top_left(n_x, n_y):
    """right edges instead of left ones: the normal is taken to point out of the face

    told by: right edge | out of the face | outward | points left | n_x < 0 | opposite
    """
    flat = (n_x == 0) & (n_y < 0)
    return flat | (n_x < 0)


def is_top_left(n_x, n_y):
    """the top test does not ask that the edge is horizontal: every normal with n_y > 0 counts

    told by: n_x == 0 | n_x = 0 | horizontal | slanted | every & n_y > 0 | n_y > 0 & alone
    """
    left = n_x > 0
    top = n_y > 0
    return left | top


def is_covered(p, triangle):
    """every sample on an edge counts as covered: >= 0 without the top-left rule

    told by: top-left | border | on an edge | on the edge | both neighbours | >= 0
    """
    inside = True
    for i, j in EDGES:
        inside = inside & (edge_function(p, triangle[i], triangle[j]) >= 0)
    return inside


def is_covered(p, triangle):
    """no sample on an edge counts as covered: > 0 without the top-left rule

    told by: top-left | border | on an edge | on the edge | neither neighbour | holes
    """
    e0, e1, e2 = [edge_function(p, triangle[i], triangle[j]) for i, j in EDGES]
    return (e0 > 0) & (e1 > 0) & (e2 > 0)


def barycentric_coordinates(p, triangle):
    """the edge functions are divided by the area A, not by 2A, so that the weights add up to 2

    told by: 2a | twice | sum to 2 | add up to 2 | sum 2 | factor 2
    """
    area = signed_area(triangle)
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return e / area


def barycentric_coordinates(p, triangle):
    """divides by the absolute value of the area, so that a clockwise triangle has negative weights

    told by: clockwise | winding | absolute | sign of the area | negative weights | orientation
    """
    double = abs(2 * signed_area(triangle))
    weights = [edge_function(p, triangle[i], triangle[j]) / double for i, j in EDGES]
    return np.stack(weights, -1)


def barycentric_coordinates(p, triangle):
    """l_1 and l_2 are exchanged

    told by: l_1 and l_2 | last two | second and third | 1 and 2 | l1 and l2 | exchanged
    """
    a, b, c = triangle
    double = edge_function(c, a, b)
    l1 = edge_function(p, a, b) / double
    l2 = edge_function(p, c, a) / double
    return np.stack([1 - l1 - l2, l1, l2], -1)


def bounding_box(triangle, width, height):
    """the pixel's centre, half a pixel, is forgotten: the corners of the box are rounded to whole pixels outwards

    told by: half a pixel | half pixel | 0.5 | centre | center
    """
    x0, y0 = np.clip(np.floor(triangle.min(0) - MARGIN), 0, [width, height])
    x1, y1 = np.clip(np.ceil(triangle.max(0) + MARGIN), 0, [width, height])
    return int(x0), int(y0), int(x1), int(y1)


def bounding_box(triangle, width, height):
    """x1 and y1 are the last pixel itself, not one beyond it, so the last column and row are lost

    told by: last column | last row | off by one | one too small | one too few | inclusive
    """
    x0, y0 = np.clip(np.ceil(triangle.min(0) - (0.5 + MARGIN)), 0, [width, height])
    x1, y1 = np.clip(np.floor(triangle.max(0) + (0.5 + MARGIN)) - 1, 0, [width - 1, height - 1])
    return int(x0), int(y0), int(x1), int(y1)


def cull_back_faces(x, y, w, faces):
    """keeps the back faces: clockwise ones on screen are kept and the front ones go

    told by: clockwise | back faces | wrong way | opposite | sign of the area | y down
    """
    tri = np.stack([x[faces], y[faces]], -1)
    facing = signed_area(tri) * np.sign(w[faces]).prod(-1)
    return faces[facing < 0]


def rasterize_loop(clip, faces, width, height):
    """the depth test is the wrong way round: the greatest depth is kept

    told by: greatest depth | farthest | deepest | depth test | least depth
    """
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, w = screen_points(clip, width, height)
    points = np.stack([x, y], -1)
    for f, corners in enumerate(faces):
        if signed_area(points[corners]) < 0:
            corners = corners[::-1]
        triangle = points[corners]
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        for i in range(y0, y1):
            for j in range(x0, x1):
                p = np.array([j + 0.5, i + 0.5])
                if is_covered(p, triangle):
                    z0, z1, z2 = clip[corners, 2] / w[corners]
                    _, l1, l2 = barycentric_coordinates(p, triangle)
                    z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                    if -1 <= z <= 1 and (face_index[i, j] < 0 or z > depth[i, j]):
                        face_index[i, j], depth[i, j] = f, z
    return face_index, depth


def rasterize_loop(clip, faces, width, height):
    """pixels are sampled at their corner (j, i), not at their centre

    told by: half a pixel | half pixel | 0.5 | centre | center | corner (j
    """
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, w = screen_points(clip, width, height)
    points = np.stack([x, y], -1)
    for f, corners in enumerate(faces):
        if signed_area(points[corners]) < 0:
            corners = corners[::-1]
        triangle = points[corners]
        z0, z1, z2 = clip[corners, 2] / w[corners]
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            p = np.array([float(j), float(i)])
            if is_covered(p, triangle):
                _, l1, l2 = barycentric_coordinates(p, triangle)
                z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                if -1 <= z <= 1 and z < depth[i, j]:
                    face_index[i, j] = f
                    depth[i, j] = z
    return face_index, depth


def rasterize_loop(clip, faces, width, height):
    """clockwise faces are not turned round, so they are not drawn

    told by: clockwise | turned round | turn round | back face | winding | turned over
    """
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, w = screen_points(clip, width, height)
    points = np.stack([x, y], -1)
    for f, corners in enumerate(faces):
        triangle = points[corners]
        z0, z1, z2 = clip[corners, 2] / w[corners]
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            p = np.array([j + 0.5, i + 0.5])
            if is_covered(p, triangle):
                _, l1, l2 = barycentric_coordinates(p, triangle)
                z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                if -1 <= z <= 1 and z < depth[i, j]:
                    face_index[i, j], depth[i, j] = f, z
    return face_index, depth


def rasterize_loop(clip, faces, width, height):
    """z is not divided by w before it is interpolated

    told by: divided by w | divide by w | z / w | z/w | divide z | clip z
    """
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, w = screen_points(clip, width, height)
    points = np.stack([x, y], -1)
    for f in range(len(faces)):
        corners = faces[f]
        if signed_area(points[corners]) < 0:
            corners = corners[[0, 2, 1]]
        triangle = points[corners]
        z0, z1, z2 = clip[corners, 2]
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            p = np.array([j + 0.5, i + 0.5])
            if not is_covered(p, triangle):
                continue
            l0, l1, l2 = barycentric_coordinates(p, triangle)
            z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
            if -1 <= z <= 1 and z < depth[i, j]:
                face_index[i, j], depth[i, j] = f, z
    return face_index, depth


def barycentric_on_face(px, py, x, y, w):
    """the weights of the picture, eq. (3): nothing is divided by w

    told by: w is ignored | divided by w | eq. (3) | picture's weights | perspective | 1/w
    """
    e = edge_functions_at(px, py, x, y)
    return e / e.sum(0)


def normalize_derivative(dc, b, s, axis=0):
    """the sign of the term with ds is wrong: it is added instead of subtracted

    told by: sign | is added | plus | subtract | minus
    """
    return (dc + b * dc.sum(axis, keepdims=True)) / s
