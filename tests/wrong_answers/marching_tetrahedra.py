"""Wrong answers to marching_tetrahedra, written without a look at the checks."""


def tetrahedron_triangles(inside):
    """with two inside, the four corners are joined in an order that crosses itself, like a bow tie

    told by: bow tie | bow-tie | crosses itself | cross & quad | around & four | overlap | self-intersect
    """
    ins = [v for v in range(4) if inside[v]]
    outs = [v for v in range(4) if not inside[v]]
    odd = is_odd(np.array(ins + outs))
    if len(ins) == 1:
        if odd:
            outs[0], outs[1] = outs[1], outs[0]
        ring = [(ins[0], o) for o in outs]
    elif len(ins) == 3:
        if odd:
            ins[0], ins[1] = ins[1], ins[0]
        ring = [(i, outs[0]) for i in ins]
    elif len(ins) == 2:
        if odd:
            ins[0], ins[1] = ins[1], ins[0]
        ring = [(i, o) for i in ins for o in outs]
    else:
        ring = []
    fan = [[ring[0], ring[k], ring[k + 1]] for k in range(1, len(ring) - 1)]
    return np.array(fan, int).reshape(-1, 3, 2)


def tetrahedron_triangles(inside):
    """three inside are treated as one inside with its edges turned round, but the winding is not reversed

    told by: three inside | 3 inside | three vertices inside | 3 vertices inside | one outside | one vertex outside | single vertex & outside
    """
    if inside.sum() == 3:
        mirrored = tetrahedron_triangles(~inside)
        return mirrored[:, :, ::-1]
    order = np.argsort(~inside, kind="stable")
    number = inside.sum()
    if is_odd(order):
        i, j = (0, 1) if number > 1 else (2, 3)
        order[i], order[j] = order[j], order[i]
    a, b, c, d = order
    if number == 1:
        fan = [[(a, b), (a, c), (a, d)]]
    elif number == 2:
        fan = [[(a, c), (a, d), (b, d)], [(a, c), (b, d), (b, c)]]
    else:
        fan = []
    return np.array(fan, int).reshape(-1, 3, 2)


def tetrahedron_triangles(inside):
    """an edge names its lower vertex first, not the one inside

    told by: inside first | the one inside & first | lower & first | smaller & first | sorted | outside first | ends & swapped
    """
    count = inside.sum()
    order = np.argsort(~inside, kind="stable")
    if is_odd(order):
        swapped = [0, 1] if count > 1 else [2, 3]
        order[swapped] = order[swapped[::-1]]
    a, b, c, d = order
    rings = {1: [(a, b), (a, c), (a, d)],
             2: [(a, c), (a, d), (b, d), (b, c)],
             3: [(a, d), (b, d), (c, d)]}
    ring = rings.get(count, [])
    found = [(ring[0], ring[i], ring[i + 1]) for i in range(1, len(ring) - 1)]
    return np.sort(np.array(found, int).reshape(-1, 3, 2), axis=-1)


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the distances in the denominator s_b - s_a are held constant

    told by: denominator | quotient rule | s_b - s_a & held | s_b - s_a & constant | numerator | division & also depend | also in & s_b - s_a
    """
    span = s_b - s_a
    to_a = grad_p * (s_b / span)[:, None]
    to_b = grad_p * (-s_a / span)[:, None]
    return to_a, to_b, -(grad_p * p_b).sum(1) / span, (grad_p * p_a).sum(1) / span


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """p_a gets the share t and p_b the share 1 - t: they are exchanged

    told by: p_a & p_b & exchang | p_a & p_b & swap | t and 1 - t | share & exchang | share & swap | share & other end | p_a and p_b & mixed up | weights of both ends are swapped
    """
    edges = len(s_a)
    ga, gb = np.zeros_like(p_a), np.zeros_like(p_b)
    gsa, gsb = np.zeros(edges), np.zeros(edges)
    for e in range(edges):
        span = s_b[e] - s_a[e]
        t = -s_a[e] / span
        ga[e] = t * grad_p[e]
        gb[e] = (1 - t) * grad_p[e]
        g = grad_p[e] @ (p_b[e] - p_a[e])
        gsa[e] = -g * s_b[e] / span**2
        gsb[e] = g * s_a[e] / span**2
    return ga, gb, gsa, gsb


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the gradients of the distances are divided by s_b - s_a once, not by its square

    told by: square | (s_b - s_a)^2 | span**2 | divid & twice | divid & once | second power | divid & s_b - s_a
    """
    t = s_a / (s_a - s_b)
    grad_t = ((p_b - p_a) * grad_p).sum(axis=1)
    slope = grad_t / (s_b - s_a)
    return grad_p * (1 - t)[:, None], grad_p * t[:, None], -slope * s_b, slope * s_a


def marching_tetrahedra(points, distance, tetrahedra):
    """each triangle has its own three vertices: those of the same edge are not merged

    told by: merge | each once | more than once | duplicate | shared | unique | own vertices
    """
    inside = distance < 0
    code = inside[tetrahedra] @ np.array([1, 2, 4, 8])
    corners = [np.zeros((0, 3, 2), int)]
    for number in range(16):
        pattern = np.array([number & 1, number & 2, number & 4, number & 8]) > 0
        triangles = tetrahedron_triangles(pattern)
        corners.append(tetrahedra[code == number][:, triangles].reshape(-1, 3, 2))
    ends = np.concatenate(corners).reshape(-1, 2)
    order = np.lexsort((ends[:, 1], ends[:, 0]))
    rank = np.empty(len(order), int)
    rank[order] = np.arange(len(order))
    ends = ends[order]
    a, b = ends.T
    return crossing(points[a], points[b], distance[a], distance[b]), rank.reshape(-1, 3), ends


def tetrahedron_triangles(inside):
    """an order of the four that is odd mirrors the tetrahedron, and two are not exchanged for it: some triangles are clockwise

    told by: is_odd | odd order | some & clockwise | mirror | orient & some | winding & some | parity | swap
    """
    order = np.argsort(~inside, kind="stable")
    a, b, c, d = order
    n = inside.sum()
    if n == 1:
        tri = [[(a, b), (a, c), (a, d)]]
    elif n == 2:
        tri = [[(a, c), (a, d), (b, d)], [(a, c), (b, d), (b, c)]]
    elif n == 3:
        tri = [[(a, d), (b, d), (c, d)]]
    else:
        tri = []
    return np.array(tri, dtype=int).reshape(-1, 3, 2)


def tetrahedron_triangles(inside):
    """with two inside there is one triangle only: half of the quadrangle is missing

    told by: one triangle | quad | two inside | second triangle | two triangles | half of
    """
    count = inside.sum()
    order = np.argsort(~inside, kind="stable")
    if is_odd(order):
        swapped = [0, 1] if count > 1 else [2, 3]
        order[swapped] = order[swapped[::-1]]
    a, b, c, d = order
    if count == 1:
        return np.array([[(a, b), (a, c), (a, d)]], int)
    if count == 2:
        return np.array([[(a, c), (a, d), (b, d)]], int)
    if count == 3:
        return np.array([[(a, d), (b, d), (c, d)]], int)
    return np.zeros((0, 3, 2), int)


def tetrahedron_triangles(inside):
    """fine print: without a surface the array is (0,) and not (0, 3, 2)

    told by: (0, 3, 2) | shape | without a surface | no surface | empty
    """
    count = inside.sum()
    order = np.argsort(~inside, kind="stable")
    if is_odd(order):
        swapped = [0, 1] if count > 1 else [2, 3]
        order[swapped] = order[swapped[::-1]]
    a, b, c, d = order
    triangles = []
    if count == 1:
        triangles.append([[a, b], [a, c], [a, d]])
    elif count == 2:
        triangles.append([[a, c], [a, d], [b, d]])
        triangles.append([[a, c], [b, d], [b, c]])
    elif count == 3:
        triangles.append([[a, d], [b, d], [c, d]])
    return np.array(triangles)


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the shares of the two ends are exchanged: t belongs to b, 1 - t to a

    told by: shares | exchanged | swapped | 1 - t | mixed up
    """
    t = s_a / (s_a - s_b)
    g = (grad_p * (p_b - p_a)).sum(1)
    span2 = (s_b - s_a)**2
    return t[:, None] * grad_p, (1 - t)[:, None] * grad_p, -g * s_b / span2, g * s_a / span2


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the quotient rule is cut short: the denominator s_b - s_a is held

    told by: denominator | quotient | s_b - s_a & held | s_b - s_a & constant | numerator
    """
    span = s_b - s_a
    grad_p_a = grad_p * (s_b / span)[:, None]
    grad_p_b = -grad_p * (s_a / span)[:, None]
    grad_s_a = -(grad_p * p_b).sum(1) / span
    grad_s_b = (grad_p * p_a).sum(1) / span
    return grad_p_a, grad_p_b, grad_s_a, grad_s_b


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the gradients of s_a and s_b are exchanged: the slope by s_a has s_b in it, and the other way round

    told by: exchanged | swapped | mixed up | other way round | interchanged | s_a's and s_b's
    """
    t = (s_a / (s_a - s_b))[:, None]
    span = s_b - s_a
    along = ((p_b - p_a) * grad_p).sum(-1)
    return (1 - t) * grad_p, t * grad_p, along * s_a / span**2, -along * s_b / span**2


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the two distances get opposite gradients, as if t depended on their difference only

    told by: opposite | difference | same size | equal and | t itself & missing
    """
    span = s_b - s_a
    t = -s_a / span
    along = (grad_p * (p_b - p_a)).sum(-1)
    g = along / span
    return (1 - t)[:, None] * grad_p, t[:, None] * grad_p, -g, g


def marching_tetrahedra(points, distance, tetrahedra):
    """fine print: a distance of 0 counts as inside

    told by: distance of 0 | <= | zero | is 0 | exactly 0 | 0 is inside
    """
    inside = distance <= 0
    case = inside[tetrahedra] @ np.array([1, 2, 4, 8])
    corners = [np.empty((0, 3, 2), int)]
    for number in range(1, 15):
        triangles = tetrahedron_triangles(number >> np.arange(4) & 1 == 1)
        corners.append(tetrahedra[case == number][:, triangles].reshape(-1, 3, 2))
    edge = np.concatenate(corners) @ np.array([len(points), 1])
    edge, faces = np.unique(edge, return_inverse=True)
    a, b = np.divmod(edge, len(points))
    vertices = crossing(points[a], points[b], distance[a], distance[b])
    return vertices, faces.reshape(-1, 3), np.stack([a, b], -1)


def marching_tetrahedra(points, distance, tetrahedra):
    """the vertices are the middles of the edges, not the places where the distance is 0

    told by: middle | midpoint | half way | halfway | eq. (8) | interpolat
    """
    inside = distance < 0
    case = inside[tetrahedra] @ np.array([1, 2, 4, 8])
    corners = [np.empty((0, 3, 2), int)]
    for number in range(1, 15):
        triangles = tetrahedron_triangles(number >> np.arange(4) & 1 == 1)
        corners.append(tetrahedra[case == number][:, triangles].reshape(-1, 3, 2))
    edge = np.concatenate(corners) @ np.array([len(points), 1])
    edge, faces = np.unique(edge, return_inverse=True)
    a, b = np.divmod(edge, len(points))
    return (points[a] + points[b]) / 2, faces.reshape(-1, 3), np.stack([a, b], -1)


def marching_tetrahedra(points, distance, tetrahedra):
    """the bits of the case are numbered from the other end: vertex 0 is taken for the highest bit

    told by: bits | bit of | case & vertex | reversed | other end | 8, 4, 2, 1 | order of the vertices
    """
    inside = distance < 0
    case = inside[tetrahedra] @ np.array([8, 4, 2, 1])
    corners = [np.empty((0, 3, 2), int)]
    for number in range(1, 15):
        triangles = tetrahedron_triangles(number >> np.arange(4) & 1 == 1)
        corners.append(tetrahedra[case == number][:, triangles].reshape(-1, 3, 2))
    edge = np.concatenate(corners) @ np.array([len(points), 1])
    edge, faces = np.unique(edge, return_inverse=True)
    a, b = np.divmod(edge, len(points))
    vertices = crossing(points[a], points[b], distance[a], distance[b])
    return vertices, faces.reshape(-1, 3), np.stack([a, b], -1)


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the absolute values of the distances are used: the gradient of s_a has the wrong sign

    told by: absolute | abs( | sign of grad_s_a | sign of s_a | sign & s_a | output 3 & sign
    """
    u, v = np.abs(s_a), np.abs(s_b)
    t = u / (u + v)
    along = (grad_p * (p_b - p_a)).sum(-1)
    return (1 - t)[:, None] * grad_p, t[:, None] * grad_p, along * v / (u + v)**2, -along * u / (u + v)**2


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the gradients of the distances are left as vectors (E, 3): the sum over x, y and z is missing

    told by: (e, 3) | shape | sum over x | summed | dot product | sum over the
    """
    t = (s_a / (s_a - s_b))[:, None]
    span = (s_b - s_a)[:, None]
    g = grad_p * (p_b - p_a)
    return (1 - t) * grad_p, t * grad_p, -g * s_b[:, None] / span**2, g * s_a[:, None] / span**2
