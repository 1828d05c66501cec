"""Mistakes of lab 2; each docstring goes on after "this is what comes out when"."""


def edge_function(p, a, b):
    """the first product has the wrong sign"""
    x,  y  = p[..., 0], p[..., 1]
    x0, y0 = a[..., 0], a[..., 1]
    x1, y1 = b[..., 0], b[..., 1]
    from_x, from_y = np.minimum(x0, x1), np.where(x0 <= x1, y0, y1)
    return -(y0 - y1) * (x - from_x) + (x1 - x0) * (y - from_y)


def edge_function(p, a, b):
    """the sign is flipped: positive means on the right of the line instead of on its left"""
    x,  y  = p[..., 0], p[..., 1]
    x0, y0 = a[..., 0], a[..., 1]
    x1, y1 = b[..., 0], b[..., 1]
    from_x, from_y = np.minimum(x0, x1), np.where(x0 <= x1, y0, y1)
    return (y1 - y0) * (x - from_x) + (x0 - x1) * (y - from_y)


def edge_function(p, a, b):
    """x and y of the edge are swapped: it is how far along the edge p lies"""
    x,  y  = p[..., 0], p[..., 1]
    x0, y0 = a[..., 0], a[..., 1]
    x1, y1 = b[..., 0], b[..., 1]
    from_x, from_y = np.minimum(x0, x1), np.where(x0 <= x1, y0, y1)
    return (x0 - x1) * (x - from_x) + (y1 - y0) * (y - from_y)


def edge_function_backward(grad_e, p, a, b):
    """all gradients are turned the wrong way"""
    def turned(side):
        return grad_e[..., None] * np.stack([-side[..., 1], side[..., 0]], -1)
    return turned(a - b), turned(b - p), turned(p - a)


def edge_function_backward(grad_e, p, a, b):
    """the sides are not turned by 90 degrees"""
    def turned(side):
        return grad_e[..., None] * side
    return turned(a - b), turned(b - p), turned(p - a)


def edge_function_backward(grad_e, p, a, b):
    """the gradients of a and b are swapped"""
    def turned(side):
        return grad_e[..., None] * np.stack([side[..., 1], -side[..., 0]], -1)
    return turned(a - b), turned(p - a), turned(b - p)


def is_inside(p, triangle):
    """clockwise triangles contain nothing; here either winding will do"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES])
    return (e >= 0).all(0)


def is_inside(p, triangle):
    """the border does not count as inside"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES])
    return (e > 0).all(0) | (e < 0).all(0)


def is_inside(p, triangle):
    """one side is enough, but all three are asked for"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES])
    return (e >= 0).any(0)


def is_top_left(n_x, n_y):
    """right and top edges own their samples instead of left and lower ones"""
    return (n_x < 0) | ((n_x == 0) & (n_y < 0))


def is_top_left(n_x, n_y):
    """the horizontal edge above a face owns its samples; here, with row 0 at the bottom, it is the
    one below"""
    return (n_x > 0) | ((n_x == 0) & (n_y < 0))


def is_top_left(n_x, n_y):
    """x and y of the normal are swapped"""
    return (n_y > 0) | ((n_y == 0) & (n_x > 0))


def is_covered(p, triangle):
    """samples on the border always count: those of a shared edge belong to both faces"""
    covered = np.ones(p.shape[:-1], bool)
    for i, j in EDGES:
        a, b = triangle[i], triangle[j]
        e = edge_function(p, a, b)
        covered &= e >= 0
    return covered


def is_covered(p, triangle):
    """samples on the border never count: those of a shared edge are lost"""
    covered = np.ones(p.shape[:-1], bool)
    for i, j in EDGES:
        a, b = triangle[i], triangle[j]
        e = edge_function(p, a, b)
        covered &= e > 0
    return covered


def is_covered(p, triangle):
    """the normal points outwards, so right and upper edges own the border"""
    covered = np.ones(p.shape[:-1], bool)
    for i, j in EDGES:
        a, b = triangle[i], triangle[j]
        e = edge_function(p, a, b)
        covered &= (e > 0) | ((e == 0) & is_top_left(b[1] - a[1], a[0] - b[0]))
    return covered


def barycentric_coordinates(p, triangle):
    """the weights are not divided by their sum"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return e


def barycentric_coordinates(p, triangle):
    """each weight belongs to the next corner: weight k is of the edge opposite to corner k"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return np.roll(e / e.sum(-1, keepdims=True), 1, -1)


def barycentric_coordinates(p, triangle):
    """weights are made positive; outside of the triangle, some are negative"""
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return np.abs(e) / np.abs(e).sum(-1, keepdims=True)


def bounding_box(triangle, width, height):
    """pixels are tested at their corners instead of at their centres"""
    x0, y0 = np.clip(np.ceil(triangle.min(0) - (MARGIN)), 0, [width, height])
    x1, y1 = np.clip(np.floor(triangle.max(0) + (MARGIN)), 0, [width, height])
    return int(x0), int(y0), int(x1), int(y1)


def bounding_box(triangle, width, height):
    """width and height are swapped"""
    x0, y0 = np.clip(np.ceil(triangle.min(0) - (0.5 + MARGIN)), 0, [height, width])
    x1, y1 = np.clip(np.floor(triangle.max(0) + (0.5 + MARGIN)), 0, [height, width])
    return int(x0), int(y0), int(x1), int(y1)


def bounding_box(triangle, width, height):
    """the order is x0, x1, y0, y1 instead of x0, y0, x1, y1"""
    x0, y0 = np.clip(np.ceil(triangle.min(0) - (0.5 + MARGIN)), 0, [width, height])
    x1, y1 = np.clip(np.floor(triangle.max(0) + (0.5 + MARGIN)), 0, [width, height])
    return int(x0), int(x1), int(y0), int(y1)


def cull_back_faces(x, y, w, faces):
    """front faces are thrown away, and back faces stay"""
    area = signed_area(np.stack([x[faces], y[faces]], -1))
    return faces[area * np.sign(w[faces]).prod(-1) < 0]


def cull_back_faces(x, y, w, faces):
    """w is not looked at: a vertex behind the camera turns the winding over"""
    area = signed_area(np.stack([x[faces], y[faces]], -1))
    return faces[area > 0]


def cull_back_faces(x, y, w, faces):
    """faces without area stay"""
    area = signed_area(np.stack([x[faces], y[faces]], -1))
    return faces[area * np.sign(w[faces]).prod(-1) >= 0]


def rasterize_loop(clip, faces, width, height):
    """rows are counted from the top; row 0 is at the bottom"""
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
                _, l1, l2 = barycentric_coordinates(p, triangle)
                z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                if -1 <= z <= 1 and z < depth[i, j]:
                    face_index[i, j], depth[i, j] = f, z
    return face_index[::-1], depth[::-1]


def rasterize_loop(clip, faces, width, height):
    """there is no z-buffer: the last face wins"""
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
                _, l1, l2 = barycentric_coordinates(p, triangle)
                z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                if -1 <= z <= 1:
                    face_index[i, j], depth[i, j] = f, z
    return face_index, depth


def rasterize_loop(clip, faces, width, height):
    """clockwise faces are not turned round, so that faces seen from behind are missing"""
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
                _, l1, l2 = barycentric_coordinates(p, triangle)
                z = z0 + l1 * (z1 - z0) + l2 * (z2 - z0)
                if -1 <= z <= 1 and z < depth[i, j]:
                    face_index[i, j], depth[i, j] = f, z
    return face_index, depth


def barycentric_on_face(px, py, x, y, w):
    """w is left out: these are the weights in the picture"""
    x, y = x - px, y - py
    c = np.stack([(x[i] * y[j] - x[j] * y[i]) for k, (i, j) in enumerate(EDGES)])
    return c / c.sum(0)


def barycentric_on_face(px, py, x, y, w):
    """it is multiplied by w instead of divided"""
    x, y = x - px, y - py
    c = np.stack([(x[i] * y[j] - x[j] * y[i]) * w[k] for k, (i, j) in enumerate(EDGES)])
    return c / c.sum(0)


def barycentric_on_face(px, py, x, y, w):
    """the weights are not divided by their sum"""
    x, y = x - px, y - py
    c = np.stack([(x[i] * y[j] - x[j] * y[i]) / w[k] for k, (i, j) in enumerate(EDGES)])
    return c


def normalize_derivative(dc, b, s, axis=0):
    """the sum s is taken for a constant"""
    return dc / s


def normalize_derivative(dc, b, s, axis=0):
    """the sign of b ds is flipped: d(c / s) is (dc - b ds) / s"""
    ds = dc.sum(axis, keepdims=True)
    return (dc + b * ds) / s


def normalize_derivative(dc, b, s, axis=0):
    """it is divided by s^2, as if c stood in the place of b"""
    ds = dc.sum(axis, keepdims=True)
    return (dc * s - b * ds) / s**2
