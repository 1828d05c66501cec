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


def screen_weights(p, triangle):
    """weight k is of the edge that starts at vertex k, not of the edge opposite to it

    told by: opposite | order | permut | wrong vertex | another vertex | other vert | starts at
    """
    values = [edge_function(p, triangle[k], triangle[(k + 1) % 3]) for k in range(3)]
    l = np.stack(values, -1)
    return l / l.sum(-1, keepdims=True)


def screen_weights(p, triangle):
    """the edge functions are divided by the area A, not by 2A, so the weights sum to 2

    told by: 2A | sum to 2 | sum is 2 | twice | half | factor & 2 | doubl
    """
    l = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return l / signed_area(triangle)


def screen_weights(p, triangle):
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
                l = screen_weights(centre, triangle)
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
                _, l1, l2 = screen_weights(p, triangle)
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
                    l = screen_weights(p, triangle)
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
    """e is divided by the length of the edge: a distance in pixels instead of twice the area

    told by: length of the edge | edge's length | distance | |b - a| | divided by & length | normali
    """
    side = b - a
    rel = p - a
    return (side[..., 0] * rel[..., 1] - side[..., 1] * rel[..., 0]) / np.hypot(side[..., 0], side[..., 1])


def edge_function(p, a, b):
    """n_x has the wrong sign: b_y - a_y instead of a_y - b_y

    told by: n_x | a_y - b_y | b_y - a_y | sign & x & term | sign & x part | y0 - y1 | y1 - y0 | sum & difference | plus & minus
    """
    n_x = b[..., 1] - a[..., 1]
    n_y = b[..., 0] - a[..., 0]
    return n_x * (p[..., 0] - a[..., 0]) + n_y * (p[..., 1] - a[..., 1])


def edge_function_backward(grad_e, p, a, b):
    """p gets no gradient, as if it were a constant pixel centre

    told by: grad_p & 0 | grad_p & zero | grad_p & no gradient | grad_p & missing | p gets no | p & constant
    """
    def quarter(v):
        return grad_e[..., None] * np.stack([v[..., 1], -v[..., 0]], -1)

    return np.zeros_like(p), quarter(b - p), quarter(p - a)


def edge_function_backward(grad_e, p, a, b):
    """grad_a and grad_b are exchanged

    told by: grad_a and grad_b | grad_a & grad_b & exchanged | grad_a & grad_b & swapped | a and b & exchanged | a and b & swapped | a and b & mixed up | order & outputs
    """
    def quarter(v):
        return grad_e[..., None] * np.stack([v[..., 1], -v[..., 0]], -1)

    return quarter(a - b), quarter(p - a), quarter(b - p)


def is_top_left(n_x, n_y):
    """horizontal edges are owned where the normal points down: the top of the memory taken as the upper edge on screen (y down)

    told by: y down | upper horizontal | points down | n_y < 0 | n_y & sign | lower horizontal | horizontal & instead of the lower | bottom
    """
    left = n_x > 0
    horizontal = n_x == 0
    return left | (horizontal & (n_y < 0))


def is_top_left(n_x, n_y):
    """x and y are exchanged: edges whose normal points up are owned, and of the vertical ones the left

    told by: x and y | n_x and n_y | exchanged | swapped | n_y > 0 | mixed up | vertical & horizontal
    """
    owned = np.zeros(np.shape(n_x), bool)
    for at in np.ndindex(owned.shape):
        owned[at] = n_y[at] > 0 or (n_y[at] == 0 and n_x[at] > 0)
    return owned


def is_covered(p, triangle):
    """all samples on an edge count as covered (e >= 0), without the top-left rule

    told by: top-left | e >= 0 | >= 0 | both neighbours | twice & edge | on an edge & all | border
    """
    inside = True
    for i, j in EDGES:
        inside = inside & (edge_function(p, triangle[i], triangle[j]) >= 0)
    return inside


def is_covered(p, triangle):
    """is_top_left gets the edge's direction b - a instead of its normal

    told by: direction & normal | edge's direction | direction of the edge | instead of & normal | b - a | is_top_left & gets | along the edge | turned by 90
    """
    result = np.ones(p.shape[:-1], bool)
    for first, second in EDGES:
        along = triangle[second] - triangle[first]
        e = edge_function(p, triangle[first], triangle[second])
        result &= (e > 0) | ((e == 0) & is_top_left(along[0], along[1]))
    return result


def screen_weights(p, triangle):
    """the weights are one place on: e of edge (0, 1) is given to vertex 0, though it belongs to the opposite vertex 2

    told by: opposite | cyclic | one place | order of the & vert | order of the & weight | vertex & exchanged | vertices & exchanged | vertex & swapped | rotated | permut | shifted | next vertex
    """
    e = []
    for k in range(3):
        e.append(edge_function(p, triangle[k], triangle[(k + 1) % 3]))
    e = np.stack(e, -1)
    return e / e.sum(-1, keepdims=True)


def screen_weights(p, triangle):
    """e is divided by the positive area, so a clockwise triangle gets negative weights

    told by: clockwise | winding | absolute | abs | negative & weight | positive area | sign of the area
    """
    total = 2 * abs(signed_area(triangle))
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return e / total


def bounding_box(triangle, width, height):
    """floor and ceil of the corners: all pixels that the box touches instead of those whose centres lie in it

    told by: centre | touch | half a pixel | 0.5 | 1/2 | floor & ceil | squares
    """
    x0 = int(np.clip(np.floor(triangle[:, 0].min() - MARGIN), 0, width))
    y0 = int(np.clip(np.floor(triangle[:, 1].min() - MARGIN), 0, height))
    x1 = int(np.clip(np.ceil(triangle[:, 0].max() + MARGIN), 0, width))
    y1 = int(np.clip(np.ceil(triangle[:, 1].max() + MARGIN), 0, height))
    return x0, y0, x1, y1


def cull_back_faces(x, y, w, faces):
    """one sign of w turns the face over if any vertex is behind the camera, instead of once for each such vertex

    told by: each vertex | for each & vert | any vertex | two vertices | all three & behind | even number | odd | product | several vertices | how many | not for three
    """
    keep = []
    for n, face in enumerate(faces):
        area = signed_area(np.stack([x[face], y[face]], -1))
        if (w[face] < 0).any():
            area = -area
        if area > 0:
            keep.append(n)
    return faces[keep]


def rasterize_loop(clip, faces, width, height):
    """a clockwise face is turned round for coverage and weights, but the depths are read from the unturned corners

    told by: unturned | turned & depth | clockwise & depth | clockwise & z | weights & other order | corners & order | reversed & z | exchanged & corner | swapped & corner
    """
    index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, w = screen_points(clip, width, height)
    z = clip[:, 2] / w
    for f, face in enumerate(faces):
        tri = np.stack([x[face], y[face]], -1)
        if signed_area(tri) < 0:
            tri = tri[::-1]
        x0, y0, x1, y1 = bounding_box(tri, width, height)
        for i in range(y0, y1):
            for j in range(x0, x1):
                p = np.array([j + 0.5, i + 0.5])
                if not is_covered(p, tri):
                    continue
                l = screen_weights(p, tri)
                d = z[face[0]] + l[1] * (z[face[1]] - z[face[0]]) + l[2] * (z[face[2]] - z[face[0]])
                if abs(d) <= 1 and d < depth[i, j]:
                    index[i, j] = f
                    depth[i, j] = d
    return index, depth


def rasterize_loop(clip, faces, width, height):
    """depths beyond -1 ... 1 are clipped to the range and drawn, instead of not being drawn

    told by: -1 to 1 | from -1 | near & far | beyond & drawn | beyond 1 | range & depth | clamp | clipped to | outside & drawn
    """
    index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, w = screen_points(clip, width, height)
    z = clip[:, 2] / w
    for f, face in enumerate(faces):
        tri = np.stack([x[face], y[face]], -1)
        zs = z[face]
        if signed_area(tri) < 0:
            tri, zs = tri[::-1], zs[::-1]
        x0, y0, x1, y1 = bounding_box(tri, width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            p = np.array([j + 0.5, i + 0.5])
            if is_covered(p, tri):
                l = screen_weights(p, tri)
                d = np.clip(zs[0] + l[1] * (zs[1] - zs[0]) + l[2] * (zs[2] - zs[0]), -1, 1)
                if d < depth[i, j]:
                    index[i, j], depth[i, j] = f, d
    return index, depth


def barycentric_on_face(px, py, x, y, w):
    """w of the next corner: e_k is divided by w_(k+1) instead of the w_k of its own corner

    told by: next corner | w_(k+1) | another corner | other corner | own corner | cyclic | w & shifted | w & order | w & corners & exchanged | w of the next | w of another | w of vertex
    """
    e = edge_functions_at(px, py, x, y)
    c = np.empty_like(e)
    for k in range(3):
        c[k] = e[k] / w[(k + 1) % 3]
    return c / c.sum(0)
