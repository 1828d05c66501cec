"""Mistakes of lab 2; each docstring goes on after "this is what comes out when"."""


def edge_function(p, a, b):
    """the first product has the wrong sign: n_x is a_y - b_y"""
    x,  y  = p[..., 0], p[..., 1]
    x0, y0 = a[..., 0], a[..., 1]
    x1, y1 = b[..., 0], b[..., 1]
    from_x, from_y = np.minimum(x0, x1), np.where(x0 <= x1, y0, y1)
    return -(y0 - y1) * (x - from_x) + (x1 - x0) * (y - from_y)


def edge_function(p, a, b):
    """the sign is flipped: positive means on the right of the line instead of on its left, as with
    a and b swapped, or with y down"""
    x,  y  = p[..., 0], p[..., 1]
    x0, y0 = a[..., 0], a[..., 1]
    x1, y1 = b[..., 0], b[..., 1]
    from_x, from_y = np.minimum(x0, x1), np.where(x0 <= x1, y0, y1)
    return (y1 - y0) * (x - from_x) + (x0 - x1) * (y - from_y)


def edge_function(p, a, b):
    """the edge itself, b - a, is taken for its normal: that dot product says how far along the
    edge p lies, not on which side"""
    return ((b - a) * (p - a)).sum(-1)


def edge_function(p, a, b):
    """n is normalised: e is divided by the length of the edge, and is the distance of p in pixels
    instead of the determinant"""
    n = np.stack([a[..., 1] - b[..., 1], b[..., 0] - a[..., 0]], -1)
    return (n * (p - a)).sum(-1) / np.linalg.norm(n, axis=-1)


def edge_function(p, a, b):
    """e is halved, to the area of the triangle: it is the whole determinant, twice the area"""
    n = np.stack([a[..., 1] - b[..., 1], b[..., 0] - a[..., 0]], -1)
    return (n * (p - a)).sum(-1) / 2


def edge_function(p, a, b):
    """e has lost its sign: it is the absolute value"""
    n = np.stack([a[..., 1] - b[..., 1], b[..., 0] - a[..., 0]], -1)
    return np.abs((n * (p - a)).sum(-1))


def edge_function_backward(grad_e, p, a, b):
    """all three gradients have the wrong sign: the sides are turned by 90 degrees the other way"""
    def turned(side):
        return grad_e[..., None] * np.stack([-side[..., 1], side[..., 0]], -1)
    return turned(a - b), turned(b - p), turned(p - a)


def edge_function_backward(grad_e, p, a, b):
    """the sides are not turned by 90 degrees"""
    def turned(side):
        return grad_e[..., None] * side
    return turned(a - b), turned(b - p), turned(p - a)


def edge_function_backward(grad_e, p, a, b):
    """the gradients of a and b are swapped, exchanged: the right order is p, a, b"""
    def turned(side):
        return grad_e[..., None] * np.stack([side[..., 1], -side[..., 0]], -1)
    return turned(a - b), turned(p - a), turned(b - p)


def edge_function_backward(grad_e, p, a, b):
    """x and y are exchanged in each gradient: the components of the turned side are in the wrong
    order"""
    def turned(side):
        return grad_e[..., None] * np.stack([-side[..., 0], side[..., 1]], -1)
    return turned(a - b), turned(b - p), turned(p - a)


def edge_function_backward(grad_e, p, a, b):
    """grad_a is minus grad_p, as if the normal n were a constant: n depends on a, too"""
    def turned(side):
        return grad_e[..., None] * np.stack([side[..., 1], -side[..., 0]], -1)
    return turned(a - b), turned(b - a), turned(p - a)


def edge_function_backward(grad_e, p, a, b):
    """grad_e is ignored, the upstream gradient: every gradient must be multiplied by it"""
    def turned(side):
        return np.stack([side[..., 1], -side[..., 0]], -1)
    return turned(a - b), turned(b - p), turned(p - a)


def is_inside(p, triangle):
    """clockwise triangles contain nothing, because only positive e count as inside: here either
    winding will do"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES])
    return (e >= 0).all(0)


def is_inside(p, triangle):
    """the border does not count as inside: > 0 for >= 0"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES])
    return (e > 0).all(0) | (e < 0).all(0)


def is_inside(p, triangle):
    """one side is enough, but all three are asked for"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES])
    return (e >= 0).any(0)


def is_inside(p, triangle):
    """counter-clockwise triangles contain nothing, because only negative e count as inside: here
    either winding will do"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES])
    return (e <= 0).all(0)


def is_top_left(n_x, n_y):
    """right and top edges own their samples instead of left and lower ones, as if the normal
    pointed out of the face"""
    return (n_x < 0) | ((n_x == 0) & (n_y < 0))


def is_top_left(n_x, n_y):
    """the horizontal edge above a face owns its samples; here, with row 0 at the bottom, it is the
    one below"""
    return (n_x > 0) | ((n_x == 0) & (n_y < 0))


def is_top_left(n_x, n_y):
    """x and y of the normal are swapped: lower edges own their samples, and only vertical left
    ones"""
    return (n_y > 0) | ((n_y == 0) & (n_x > 0))


def is_top_left(n_x, n_y):
    """n is taken for the direction of the edge instead of its normal"""
    return (n_y < 0) | ((n_y == 0) & (n_x > 0))


def is_top_left(n_x, n_y):
    """horizontal edges are forgotten: only left edges count, and lower ones with n_x = 0 must"""
    return n_x > 0


def is_top_left(n_x, n_y):
    """every edge with n_y > 0 counts, slanted ones too: only a horizontal edge, n_x == 0, is
    decided by n_y"""
    return (n_x > 0) | (n_y > 0)


def is_covered(p, triangle):
    """samples on the border always count (>= 0, without the top-left rule): those on a shared edge
    belong to both neighbours"""
    covered = np.ones(p.shape[:-1], bool)
    for i, j in EDGES:
        a, b = triangle[i], triangle[j]
        e = edge_function(p, a, b)
        covered &= e >= 0
    return covered


def is_covered(p, triangle):
    """samples on the border never count (> 0, without the top-left rule): those on a shared edge
    belong to neither neighbour, and leave holes"""
    covered = np.ones(p.shape[:-1], bool)
    for i, j in EDGES:
        a, b = triangle[i], triangle[j]
        e = edge_function(p, a, b)
        covered &= e > 0
    return covered


def is_covered(p, triangle):
    """right and upper edges own the border instead of left and lower ones: the normal points
    outwards (it is (a_y - b_y, b_x - a_x)), or the answer of is_top_left is negated"""
    covered = np.ones(p.shape[:-1], bool)
    for i, j in EDGES:
        a, b = triangle[i], triangle[j]
        e = edge_function(p, a, b)
        covered &= (e > 0) | ((e == 0) & is_top_left(b[1] - a[1], a[0] - b[0]))
    return covered


def is_covered(p, triangle):
    """is_top_left is given the direction of the edge, b - a, instead of its normal"""
    covered = np.ones(p.shape[:-1], bool)
    for i, j in EDGES:
        a, b = triangle[i], triangle[j]
        e = edge_function(p, a, b)
        covered &= (e > 0) | ((e == 0) & is_top_left(b[0] - a[0], b[1] - a[1]))
    return covered


def is_covered(p, triangle):
    """one edge is enough: all three must say so"""
    covered = np.zeros(p.shape[:-1], bool)
    for i, j in EDGES:
        a, b = triangle[i], triangle[j]
        e = edge_function(p, a, b)
        covered |= (e > 0) | ((e == 0) & is_top_left(a[1] - b[1], b[0] - a[0]))
    return covered


def is_covered(p, triangle):
    """the third edge, the last one, is not tested: only two edges are"""
    covered = np.ones(p.shape[:-1], bool)
    for i, j in ((0, 1), (1, 2)):
        a, b = triangle[i], triangle[j]
        e = edge_function(p, a, b)
        covered &= (e > 0) | ((e == 0) & is_top_left(a[1] - b[1], b[0] - a[0]))
    return covered


def screen_weights(p, triangle):
    """the weights are not divided by 2A, their sum: they must sum to 1"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return e


def screen_weights(p, triangle):
    """each weight belongs to the next corner, as if the edges were (0, 1), (1, 2), (2, 0): weight k
    is of the edge opposite to corner k"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return np.roll(e / e.sum(-1, keepdims=True), 1, -1)


def screen_weights(p, triangle):
    """weights are made positive; outside of the triangle, some are negative"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return np.abs(e) / np.abs(e).sum(-1, keepdims=True)


def screen_weights(p, triangle):
    """they are divided by the area A instead of 2A: the weights are twice as large, and sum to 2"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return 2 * e / e.sum(-1, keepdims=True)


def screen_weights(p, triangle):
    """they are divided by the absolute value of the area: a clockwise triangle, whose area is
    negative, gets weights of the wrong sign"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return e / np.abs(e.sum(-1, keepdims=True))


def screen_weights(p, triangle):
    """each weight belongs to the corner before, the order is rolled the other way: weight k is of
    the edge opposite to corner k, e_0 of the edge from 1 to 2"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return np.roll(e / e.sum(-1, keepdims=True), -1, -1)


def bounding_box(triangle, width, height):
    """half a pixel is forgotten: pixels are tested at their corners instead of at their centres"""
    x0, y0 = np.clip(np.ceil(triangle.min(0) - (MARGIN)), 0, [width, height])
    x1, y1 = np.clip(np.floor(triangle.max(0) + (MARGIN)), 0, [width, height])
    return int(x0), int(y0), int(x1), int(y1)


def bounding_box(triangle, width, height):
    """the order is x0, x1, y0, y1 instead of x0, y0, x1, y1"""
    x0, y0 = np.clip(np.ceil(triangle.min(0) - (0.5 + MARGIN)), 0, [width, height])
    x1, y1 = np.clip(np.floor(triangle.max(0) + (0.5 + MARGIN)), 0, [width, height])
    return int(x0), int(x1), int(y0), int(y1)


def bounding_box(triangle, width, height):
    """x1 and y1 are the last pixel itself: they are one past it, so the last column and row of the
    box are lost"""
    x0, y0 = np.clip(np.ceil(triangle.min(0) - (0.5 + MARGIN)), 0, [width, height])
    x1, y1 = np.clip(np.floor(triangle.max(0) + (0.5 + MARGIN)) - 1, 0, [width - 1, height - 1])
    return int(x0), int(y0), int(x1), int(y1)


def bounding_box(triangle, width, height):
    """MARGIN is missing: the box must be wider than the triangle by it, on each side"""
    x0, y0 = np.clip(np.ceil(triangle.min(0) - 0.5), 0, [width, height])
    x1, y1 = np.clip(np.floor(triangle.max(0) + 0.5), 0, [width, height])
    return int(x0), int(y0), int(x1), int(y1)


def cull_back_faces(x, y, w, faces):
    """front faces are thrown away, and back faces, clockwise on screen, stay"""
    area = signed_area(np.stack([x[faces], y[faces]], -1))
    return faces[area * np.sign(w[faces]).prod(-1) < 0]


def cull_back_faces(x, y, w, faces):
    """w is ignored, and the winding on screen alone decides: each vertex behind the camera turns it
    over"""
    area = signed_area(np.stack([x[faces], y[faces]], -1))
    return faces[area > 0]


def cull_back_faces(x, y, w, faces):
    """faces without area stay"""
    area = signed_area(np.stack([x[faces], y[faces]], -1))
    return faces[area * np.sign(w[faces]).prod(-1) >= 0]


def cull_back_faces(x, y, w, faces):
    """faces with a vertex behind the camera are thrown away: such a vertex only turns the winding
    over"""
    area = signed_area(np.stack([x[faces], y[faces]], -1))
    return faces[(area > 0) & (w[faces] > 0).all(-1)]


def rasterize_loop(clip, faces, width, height):
    """rows are counted from the top, and the picture is upside down: row 0 is at the bottom"""
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, w = screen_points(clip, width, height)
    points = np.stack([x, y], -1)
    for f, corners in enumerate(faces):
        if signed_area(points[corners]) < 0:
            corners = corners[::-1]
        triangle = points[corners]
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            p = np.array([j + 0.5, i + 0.5])
            if is_covered(p, triangle):
                z0, z1, z2 = clip[corners, 2] / w[corners]
                _, l1, l2 = screen_weights(p, triangle)
                z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                if -1 <= z <= 1 and z < depth[i, j]:
                    face_index[i, j], depth[i, j] = f, z
    return face_index[::-1], depth[::-1]


def rasterize_loop(clip, faces, width, height):
    """there is no z-buffer, and the last face wins: the least depth must be kept"""
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, w = screen_points(clip, width, height)
    points = np.stack([x, y], -1)
    for f, corners in enumerate(faces):
        if signed_area(points[corners]) < 0:
            corners = corners[::-1]
        triangle = points[corners]
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            p = np.array([j + 0.5, i + 0.5])
            if is_covered(p, triangle):
                z0, z1, z2 = clip[corners, 2] / w[corners]
                _, l1, l2 = screen_weights(p, triangle)
                z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                if -1 <= z <= 1:
                    face_index[i, j], depth[i, j] = f, z
    return face_index, depth


def rasterize_loop(clip, faces, width, height):
    """clockwise faces are not turned round, so that faces seen from behind (back faces) are
    missing"""
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, w = screen_points(clip, width, height)
    points = np.stack([x, y], -1)
    for f, corners in enumerate(faces):
        triangle = points[corners]
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            p = np.array([j + 0.5, i + 0.5])
            if is_covered(p, triangle):
                z0, z1, z2 = clip[corners, 2] / w[corners]
                _, l1, l2 = screen_weights(p, triangle)
                z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                if -1 <= z <= 1 and z < depth[i, j]:
                    face_index[i, j], depth[i, j] = f, z
    return face_index, depth


def rasterize_loop(clip, faces, width, height):
    """the depth test is the wrong way round: the greatest depth is kept, the farthest face, instead
    of the least"""
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, w = screen_points(clip, width, height)
    points = np.stack([x, y], -1)
    for f, corners in enumerate(faces):
        if signed_area(points[corners]) < 0:
            corners = corners[::-1]
        triangle = points[corners]
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            p = np.array([j + 0.5, i + 0.5])
            if is_covered(p, triangle):
                z0, z1, z2 = clip[corners, 2] / w[corners]
                _, l1, l2 = screen_weights(p, triangle)
                z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                if -1 <= z <= 1 and (face_index[i, j] < 0 or z > depth[i, j]):
                    face_index[i, j], depth[i, j] = f, z
    return face_index, depth


def rasterize_loop(clip, faces, width, height):
    """pixels are sampled at their corner (j, i) instead of at their centre, half a pixel farther"""
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, w = screen_points(clip, width, height)
    points = np.stack([x, y], -1)
    for f, corners in enumerate(faces):
        if signed_area(points[corners]) < 0:
            corners = corners[::-1]
        triangle = points[corners]
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            p = np.array([float(j), float(i)])
            if is_covered(p, triangle):
                z0, z1, z2 = clip[corners, 2] / w[corners]
                _, l1, l2 = screen_weights(p, triangle)
                z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                if -1 <= z <= 1 and z < depth[i, j]:
                    face_index[i, j], depth[i, j] = f, z
    return face_index, depth


def rasterize_loop(clip, faces, width, height):
    """z is not divided by w: what is linear on the screen is z/w of the corners"""
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, _ = screen_points(clip, width, height)
    points = np.stack([x, y], -1)
    for f, corners in enumerate(faces):
        if signed_area(points[corners]) < 0:
            corners = corners[::-1]
        triangle = points[corners]
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            p = np.array([j + 0.5, i + 0.5])
            if is_covered(p, triangle):
                z0, z1, z2 = clip[corners, 2]
                _, l1, l2 = screen_weights(p, triangle)
                z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                if -1 <= z <= 1 and z < depth[i, j]:
                    face_index[i, j], depth[i, j] = f, z
    return face_index, depth


def barycentric_on_face(px, py, x, y, w):
    """nothing is divided by w: these are the weights in the picture, eq. (3), without
    perspective"""
    x, y = x - px, y - py
    c = np.stack([(x[i] * y[j] - x[j] * y[i]) for k, (i, j) in enumerate(EDGES)])
    return c / c.sum(0)


def barycentric_on_face(px, py, x, y, w):
    """it is multiplied by w instead of divided: c_k is e_k / w_k"""
    x, y = x - px, y - py
    c = np.stack([(x[i] * y[j] - x[j] * y[i]) * w[k] for k, (i, j) in enumerate(EDGES)])
    return c / c.sum(0)


def barycentric_on_face(px, py, x, y, w):
    """the weights are not divided by their sum s: they must sum to 1"""
    x, y = x - px, y - py
    c = np.stack([(x[i] * y[j] - x[j] * y[i]) / w[k] for k, (i, j) in enumerate(EDGES)])
    return c


def barycentric_on_face(px, py, x, y, w):
    """the sum s is over the samples instead of over the three corners"""
    x, y = x - px, y - py
    c = np.stack([(x[i] * y[j] - x[j] * y[i]) / w[k] for k, (i, j) in enumerate(EDGES)])
    return c / c.sum(-1, keepdims=True)


def barycentric_on_face(px, py, x, y, w):
    """e_k is divided by w of the next corner, where its edge begins: c_k is e_k / w_k"""
    x, y = x - px, y - py
    c = np.stack([(x[i] * y[j] - x[j] * y[i]) / w[i] for i, j in EDGES])
    return c / c.sum(0)


def barycentric_on_face(px, py, x, y, w):
    """e_k is divided by w of the corner before, where its edge ends: c_k is e_k / w_k"""
    x, y = x - px, y - py
    c = np.stack([(x[i] * y[j] - x[j] * y[i]) / w[j] for i, j in EDGES])
    return c / c.sum(0)


def normalize_derivative(dc, b, s, axis=0):
    """the term - b ds is missing, as if the sum s were a constant: s changes, too"""
    return dc / s


def normalize_derivative(dc, b, s, axis=0):
    """the sign of b ds is flipped, it is added instead of subtracted: d(c / s) is (dc - b ds) /
    s"""
    ds = dc.sum(axis, keepdims=True)
    return (dc + b * ds) / s


def normalize_derivative(dc, b, s, axis=0):
    """b ds is divided by s^2 instead of s, as if c stood in the place of b: it is (dc - b ds) /
    s"""
    ds = dc.sum(axis, keepdims=True)
    return (dc * s - b * ds) / s**2


def normalize_derivative(dc, b, s, axis=0):
    """it is not divided by s: db is (dc - b ds) / s"""
    ds = dc.sum(axis, keepdims=True)
    return dc - b * ds
