"""Wrong answers to rasterization, written without a look at the checks."""


def edge_function(p, a, b):
    """this is the dot product of b - a and p - a, the edge itself is used instead of its normal

    told by: dot product | normal | perpendicular | along the edge | determinant | cross product | inner product
    """
    ex, ey = b[..., 0] - a[..., 0], b[..., 1] - a[..., 1]
    return ex * (p[..., 0] - a[..., 0]) + ey * (p[..., 1] - a[..., 1])


def edge_function(p, a, b):
    """the normal is made a unit vector, so the result is the distance to the line

    told by: distance | unit | normali | length & edge | divi & length | divi & norm
    """
    along = b - a
    e = along[..., 0] * (p - a)[..., 1] - along[..., 1] * (p - a)[..., 0]
    return e / np.hypot(along[..., 0], along[..., 1])


def edge_function(p, a, b):
    """x and y are taken from the first axis (p[0], p[1]) instead of the last, so it works for single points only

    told by: first axis | last axis | ..., 0 | single point | many points | broadcast | p[0]
    """
    n_x, n_y = a[1] - b[1], b[0] - a[0]
    return n_x * (p[0] - a[0]) + n_y * (p[1] - a[1])


def edge_function_backward(grad_e, p, a, b):
    """grad_a is only -grad_p: it is forgotten that the normal depends on a, too

    told by: -grad_p | normal & depends | grad_a & normal | a & also in n | n & contains a | a & twice | only through p - a
    """
    normal = np.stack([a[..., 1] - b[..., 1], b[..., 0] - a[..., 0]], -1)
    d_p = grad_e[..., None] * normal
    d_b = grad_e[..., None] * np.stack([p[..., 1] - a[..., 1], a[..., 0] - p[..., 0]], -1)
    return d_p, -d_p, d_b


def edge_function_backward(grad_e, p, a, b):
    """grad_a and grad_b are exchanged

    told by: exchang & grad_b | swap & grad_b | grad_a & grad_b & order | mixed up | a and b | interchang | grad_b & place of
    """
    (px, py), (ax, ay), (bx, by) = (np.moveaxis(v, -1, 0) for v in (p, a, b))
    d_p = np.stack([ay - by, bx - ax], -1)
    d_a = np.stack([by - py, px - bx], -1)
    d_b = np.stack([py - ay, ax - px], -1)
    g = grad_e[..., None]
    return g * d_p, g * d_b, g * d_a


def edge_function_backward(grad_e, p, a, b):
    """the incoming grad_e is not multiplied in: these are only the derivatives

    told by: grad_e & ignore | grad_e & multipl | grad_e & not used | incoming | upstream | chain rule | grad_e & factor
    """
    def quarter_turn(v):
        return np.stack([v[..., 1], -v[..., 0]], -1)

    return quarter_turn(a - b), quarter_turn(b - p), quarter_turn(p - a)


def is_inside(p, triangle):
    """only counter-clockwise triangles are considered, in a clockwise one every e is negative

    told by: clockwise | winding | either way | whichever way | wound | e <= 0 | orientation
    """
    result = np.ones(p.shape[:-1], bool)
    for k in range(3):
        result &= edge_function(p, triangle[k], triangle[(k + 1) % 3]) >= 0
    return result


def is_top_left(n_x, n_y):
    """of the horizontal edges the upper one is taken (n points down), not the lower one

    told by: upper & horizontal | n_y & sign | points down | points up | upside down | top & bottom | lower & horizontal | below & horizontal | horizontal edge above
    """
    left = n_x > 0
    flat = n_x == 0
    return left | (flat & (n_y < 0))


def is_top_left(n_x, n_y):
    """horizontal edges are forgotten: only left edges are taken

    told by: horizontal | n_x == 0 | n_x = 0 | n_x is 0 | only left
    """
    return np.asarray(n_x) > 0


def is_top_left(n_x, n_y):
    """it is not asked whether the edge is horizontal (n_x = 0): every normal that points up counts

    told by: horizontal | n_x == 0 | n_x = 0 | n_x is 0 | points up | any n_y | slanted
    """
    return (n_x > 0) | (n_y > 0)


def is_covered(p, triangle):
    """a sample exactly on any edge counts as covered: the top-left rule is missing

    told by: top-left | top left | tie | on an edge | on its edge | >= 0 | border
    """
    inside = np.full(p.shape[:-1], True)
    for start, end in EDGES:
        inside = inside & (edge_function(p, triangle[start], triangle[end]) >= 0)
    return inside


def is_covered(p, triangle):
    """is_top_left is given the direction of the edge, b - a, instead of its normal

    told by: direction | normal | b - a | along the edge | is_top_left & n | turned & 90 | perpendicular
    """
    covered = True
    for k in range(3):
        a, b = triangle[k], triangle[(k + 1) % 3]
        e = edge_function(p, a, b)
        along = b - a
        covered = covered & ((e > 0) | ((e == 0) & is_top_left(along[0], along[1])))
    return covered


def is_covered(p, triangle):
    """the closing edge, from the last corner to the first, is not tested

    told by: closing edge | last edge | third edge | all three edges | two edges | only two | one edge
    """
    inside = np.ones(p.shape[:-1], dtype=bool)
    for a, b in zip(triangle[:-1], triangle[1:]):
        value = edge_function(p, a, b)
        own = is_top_left(a[1] - b[1], b[0] - a[0])
        inside &= np.where(own, value >= 0, value > 0)
    return inside


def barycentric_coordinates(p, triangle):
    """weight k is of the edge that starts at vertex k, not of the edge opposite to it

    told by: opposite | order | permut | wrong vertex | another vertex | other vert | starts at
    """
    values = [edge_function(p, triangle[k], triangle[(k + 1) % 3]) for k in range(3)]
    l = np.stack(values, -1)
    return l / l.sum(-1, keepdims=True)


def barycentric_coordinates(p, triangle):
    """the edge functions are divided by the area A, not by 2A, so the weights sum to 2

    told by: 2A | sum to 2 | sum is 2 | twice | half | factor & 2 | doubl
    """
    l = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return l / signed_area(triangle)


def barycentric_coordinates(p, triangle):
    """2A is taken without its sign, so all weights of a clockwise triangle are negative

    told by: clockwise | winding | sum to -1 | sum is -1 | absolute | abs & area | signed
    """
    weights = np.empty(p.shape[:-1] + (3,))
    twice = 2 * np.abs(signed_area(triangle))
    for k, (i, j) in enumerate(EDGES):
        weights[..., k] = edge_function(p, triangle[i], triangle[j]) / twice
    return weights


def bounding_box(triangle, width, height):
    """x1 and y1 are the last column and row inside, not one past them

    told by: one past | last column | exclusive | inclusive | one too | + 1 | off by one
    """
    lower = np.ceil(triangle.min(0) - 0.5 - MARGIN)
    upper = np.floor(triangle.max(0) - 0.5 + MARGIN)
    size = np.array([width, height])
    lower, upper = np.clip(lower, 0, size), np.clip(upper, 0, size)
    return int(lower[0]), int(lower[1]), int(upper[0]), int(upper[1])


def cull_back_faces(x, y, w, faces):
    """vertices behind the camera do not turn the winding over: the signs of w are ignored

    told by: behind & camera | sign & w | w < 0 | negative w | turn & over | w & ignored | w & not used
    """
    keep = []
    for face in faces:
        corners = np.stack([x[face], y[face]], -1)
        keep.append(signed_area(corners) > 0)
    return faces[np.array(keep, bool)]


def rasterize_loop(clip, faces, width, height):
    """the depths are z of clip space, not divided by w

    told by: divid & w | z / w | z/w | clip z | clip & depth | undivided
    """
    index = np.full((height, width), -1)
    nearest = np.full((height, width), np.inf)
    sx, sy, _ = screen_points(clip, width, height)
    screen = np.stack([sx, sy], -1)
    for number, face in enumerate(faces):
        order = face if signed_area(screen[face]) > 0 else face[[0, 2, 1]]
        triangle = screen[order]
        left, low, right, high = bounding_box(triangle, width, height)
        for row in range(low, high):
            for column in range(left, right):
                centre = np.array([column + 0.5, row + 0.5])
                if not is_covered(centre, triangle):
                    continue
                l = barycentric_coordinates(centre, triangle)
                za, zb, zc = clip[order, 2]
                z = za + l[1] * (zb - za) + l[2] * (zc - za)
                if abs(z) <= 1 and z < nearest[row, column]:
                    index[row, column], nearest[row, column] = number, z
    return index, nearest


def rasterize_loop(clip, faces, width, height):
    """for a clockwise face only the corners' places are turned round, their depths keep the old order

    told by: clockwise & depth | reversed & z | turned & depth | turn & z | order & depth | corners & z | swapped & z
    """
    index = np.full((height, width), -1)
    nearest = np.full((height, width), np.inf)
    sx, sy, w = screen_points(clip, width, height)
    screen = np.stack([sx, sy], -1)
    for f in range(len(faces)):
        triangle = screen[faces[f]]
        if signed_area(triangle) < 0:
            triangle = triangle[::-1]
        z0, z1, z2 = clip[faces[f], 2] / w[faces[f]]
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            p = np.array([j + 0.5, i + 0.5])
            if is_covered(p, triangle):
                _, l1, l2 = barycentric_coordinates(p, triangle)
                z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                if -1 <= z <= 1 and z < nearest[i, j]:
                    index[i, j] = f
                    nearest[i, j] = z
    return index, nearest


def rasterize_loop(clip, faces, width, height):
    """pixels are sampled at their corner (j, i), not at their centre

    told by: centre | center | 0.5 | half a pixel | half pixel | corner & pixel | 1/2
    """
    index = np.full((height, width), -1)
    nearest = np.full((height, width), np.inf)
    sx, sy, w = screen_points(clip, width, height)
    screen, ndc_z = np.stack([sx, sy], -1), clip[:, 2] / w
    for f, corners in enumerate(faces):
        if signed_area(screen[corners]) < 0:
            corners = corners[[1, 0, 2]]
        triangle = screen[corners]
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        z0, z1, z2 = ndc_z[corners]
        for i in range(y0, y1):
            for j in range(x0, x1):
                p = np.array([float(j), float(i)])
                if is_covered(p, triangle):
                    l = barycentric_coordinates(p, triangle)
                    z = z0 + l[1] * (z1 - z0) + l[2] * (z2 - z0)
                    if -1 <= z <= 1 and z < nearest[i, j]:
                        index[i, j], nearest[i, j] = f, z
    return index, nearest


def barycentric_on_face(px, py, x, y, w):
    """the edge functions are multiplied by w instead of divided by it

    told by: multipl & w | divid & w | e_k / w | times w | 1 / w | inverse & w | e * w
    """
    weighted = edge_functions_at(px, py, x, y) * w
    return weighted / weighted.sum(0)


def normalize_derivative(dc, b, s, axis=0):
    """the result is divided by s squared: b is normalised already, so s is in it once

    told by: s squared | s^2 | s**2 | s twice | once & s | divi & by s | factor & s
    """
    change = dc.sum(axis, keepdims=True)
    return (dc - b * change) / (s * s)


def edge_function(p, a, b):
    """half the determinant: the area of the triangle instead of twice the area

    told by: half | / 2 | 1/2 | 0.5 | area of the triangle | factor 2
    """
    ax, ay = a[..., 0], a[..., 1]
    bx, by = b[..., 0], b[..., 1]
    return 0.5 * ((ay - by) * (p[..., 0] - ax) + (bx - ax) * (p[..., 1] - ay))


def edge_function(p, a, b):
    """the dot product with b - a instead of with the normal: it measures along the edge, not across it

    told by: dot product | along the edge | along the line | cross product | the normal | its normal
    """
    return ((p - a) * (b - a)).sum(-1)


def edge_function_backward(grad_e, p, a, b):
    """the gradients of a and b are exchanged

    told by: grad_a and grad_b & exchanged | grad_a and grad_b & swapped | a and b & exchanged | a and b & swapped | a and b & mixed up | wrong order
    """
    px, py, ax, ay, bx, by = *np.moveaxis(p, -1, 0), *np.moveaxis(a, -1, 0), *np.moveaxis(b, -1, 0)
    dp = np.stack([ay - by, bx - ax], -1)
    da = np.stack([by - py, px - bx], -1)
    db = np.stack([py - ay, ax - px], -1)
    g = grad_e[..., None]
    return g * dp, g * db, g * da


def edge_function_backward(grad_e, p, a, b):
    """grad_e is not multiplied in: the bare derivative is returned

    told by: grad_e | upstream | incoming gradient | chain rule | bare derivative | multiplied by the gradient
    """
    def turned(side):
        return np.stack([side[..., 1], -side[..., 0]], -1)

    return turned(a - b), turned(b - p), turned(p - a)


def is_inside(p, triangle):
    """points on the border are left out: > where >= is asked

    told by: border | on an edge | on the edge | strict | >= | boundary
    """
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES])
    return (e > 0).all(0) | (e < 0).all(0)


def is_top_left(n_x, n_y):
    """the horizontal edge is the wrong one: n pointing down counts, the upper edge on a screen with y up

    told by: horizontal | points down | upper edge | n_y < 0 | y up | y down
    """
    return (n_x > 0) | ((n_x == 0) & (n_y < 0))


def is_covered(p, triangle):
    """the third edge is not tested

    told by: third edge | only two | last edge | all edges
    """
    ok = np.ones(p.shape[:-1], bool)
    for k in range(2):
        a, b = triangle[k], triangle[k + 1]
        e = edge_function(p, a, b)
        ok &= (e > 0) | ((e == 0) & is_top_left(a[1] - b[1], b[0] - a[0]))
    return ok


def is_covered(p, triangle):
    """one positive edge function is enough: or where and is needed

    told by: any edge | every edge | all edges | one edge is enough | or instead of and | or where and
    """
    covered = np.zeros(p.shape[:-1], bool)
    for i, j in EDGES:
        a, b = triangle[i], triangle[j]
        e = edge_function(p, a, b)
        covered |= (e > 0) | ((e == 0) & is_top_left(a[1] - b[1], b[0] - a[0]))
    return covered


def is_covered(p, triangle):
    """the top-left rule gets the edge's normal with the wrong sign, so it owns the right and upper edges

    told by: normal & sign | normal & outward | normal & opposite | right edges | bottom-right | wrong edges own
    """
    covered = np.ones(p.shape[:-1], bool)
    for i, j in EDGES:
        a, b = triangle[i], triangle[j]
        e = edge_function(p, a, b)
        covered = covered & ((e > 0) | ((e == 0) & is_top_left(b[1] - a[1], a[0] - b[0])))
    return covered


def barycentric_coordinates(p, triangle):
    """the weights are in the wrong order: e of edge (k, k + 1) is given to vertex k, not to the vertex opposite

    told by: order of | wrong order | opposite | cyclic | shifted | permut
    """
    e = []
    for k in range(3):
        e.append(edge_function(p, triangle[k], triangle[(k + 1) % 3]))
    e = np.stack(e, -1)
    return e / e.sum(-1, keepdims=True)


def barycentric_coordinates(p, triangle):
    """the edge functions are not divided by anything

    told by: normali | divide | sum to 1 | add up to 1 | sum 1 | sum is not 1
    """
    return np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)


def cull_back_faces(x, y, w, faces):
    """the sign of w is ignored: a vertex behind the camera does not turn the face over

    told by: behind | w < 0 | sign of w | w is ignored | negative w | signs of w
    """
    keep = [f for f in faces if signed_area(np.stack([x[f], y[f]], -1)) > 0]
    return np.array(keep, dtype=faces.dtype).reshape(-1, 3)


def rasterize_loop(clip, faces, width, height):
    """the last of two equally deep faces is seen: <= in the depth test (fine print)

    told by: equally deep | equal depth | same depth | <= instead of < | the last of | first of two
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
            p = np.array([j + 0.5, i + 0.5])
            if is_covered(p, triangle):
                _, l1, l2 = barycentric_coordinates(p, triangle)
                z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                if -1 <= z <= 1 and z <= depth[i, j]:
                    face_index[i, j], depth[i, j] = f, z
    return face_index, depth


def barycentric_on_face(px, py, x, y, w):
    """multiplied by w instead of divided by it

    told by: multipli | times w | instead of divid | * w | inverse of w | 1/w
    """
    c = edge_functions_at(px, py, x, y) * w
    total = c[0] + c[1] + c[2]
    return c / total


def normalize_derivative(dc, b, s, axis=0):
    """the derivative of s is left out: s is taken as a constant

    told by: b ds | s as a constant | s is constant | s were constant | derivative of s | quotient rule
    """
    return dc / s
