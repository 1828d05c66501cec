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


def zero_crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the distances in the denominator s_b - s_a are held constant

    told by: denominator | quotient rule | s_b - s_a & held | s_b - s_a & constant | numerator | division & also depend | also in & s_b - s_a
    """
    span = s_b - s_a
    to_a = grad_p * (s_b / span)[:, None]
    to_b = grad_p * (-s_a / span)[:, None]
    return to_a, to_b, -(grad_p * p_b).sum(1) / span, (grad_p * p_a).sum(1) / span


def zero_crossing_backward(grad_p, p_a, p_b, s_a, s_b):
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


def zero_crossing_backward(grad_p, p_a, p_b, s_a, s_b):
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
    return zero_crossing(points[a], points[b], distance[a], distance[b]), rank.reshape(-1, 3), ends


def tetrahedron_triangles(inside):
    """the winding is not looked after: an odd order of the vertices gives clockwise triangles

    told by: wind | clockwise | orient | odd | mirror | turned over | inside out
    """
    a = [v for v in range(4) if inside[v]]
    b = [v for v in range(4) if not inside[v]]
    if len(a) == 1:
        faces = [[(a[0], v) for v in b]]
    elif len(a) == 3:
        faces = [[(v, b[0]) for v in a]]
    elif len(a) == 2:
        ring = [(a[0], b[0]), (a[0], b[1]), (a[1], b[1]), (a[1], b[0])]
        faces = [[ring[0], ring[1], ring[2]], [ring[0], ring[2], ring[3]]]
    else:
        faces = []
    return np.array(faces, int).reshape(-1, 3, 2)


def tetrahedron_triangles(inside):
    """with two vertices inside, the four corners do not go round the quadrilateral: the two triangles overlap

    told by: quad | two & inside | overlap | diagonal | four corners | go round | two triangles
    """
    count = inside.sum()
    order = np.argsort(~inside, kind="stable")
    if is_odd(order):
        pair = [0, 1] if count > 1 else [2, 3]
        order[pair] = order[pair[::-1]]
    a, b, c, d = order
    corners = {1: [(a, b), (a, c), (a, d)],
               2: [(a, c), (a, d), (b, c), (b, d)],
               3: [(a, d), (b, d), (c, d)]}.get(count, [])
    fan = [(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1)]
    return np.array(fan, int).reshape(-1, 3, 2)


def tetrahedron_triangles(inside):
    """with three vertices inside, each corner names the outside vertex first

    told by: outside & first | inside & first | order of the two | three & inside | ends & exchanged | ends & swapped
    """
    count = inside.sum()
    order = np.argsort(~inside, kind="stable")
    if is_odd(order):
        pair = [0, 1] if count > 1 else [2, 3]
        order[pair] = order[pair[::-1]]
    a, b, c, d = order
    if count == 1:
        found = [[(a, b), (a, c), (a, d)]]
    elif count == 2:
        found = [[(a, c), (a, d), (b, d)], [(a, c), (b, d), (b, c)]]
    elif count == 3:
        found = [[(d, a), (d, b), (d, c)]]
    else:
        found = []
    return np.array(found, int).reshape(-1, 3, 2)


def zero_crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the shares of p_a and p_b are exchanged

    told by: exchang | swap | mixed up | 1 - t | other end | shares
    """
    t = s_a / (s_a - s_b)
    slope = ((p_b - p_a) * grad_p).sum(1) / (s_b - s_a)**2
    return t[:, None] * grad_p, (1 - t)[:, None] * grad_p, -slope * s_b, slope * s_a


def zero_crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the gradients of the distances are divided by s_b - s_a once instead of by its square

    told by: squar | ^2 | **2 | denominator | twice & divid | s_b - s_a once
    """
    span = (s_b - s_a)[:, None]
    along = np.einsum("ec,ec->e", grad_p, p_b - p_a)
    return (grad_p * s_b[:, None] / span, -grad_p * s_a[:, None] / span,
            -along * s_b / span[:, 0], along * s_a / span[:, 0])


def zero_crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """grad_s_b has the opposite sign: s_b moves the point towards p_a as well

    told by: sign | minus | opposite | negative | plus
    """
    grads = [np.zeros_like(grad_p), np.zeros_like(grad_p), np.zeros(len(s_a)), np.zeros(len(s_a))]
    for e in range(len(s_a)):
        d = s_b[e] - s_a[e]
        grads[0][e] = s_b[e] / d * grad_p[e]
        grads[1][e] = -s_a[e] / d * grad_p[e]
        turn = grad_p[e] @ (p_b[e] - p_a[e]) / d**2
        grads[2][e] = -turn * s_b[e]
        grads[3][e] = -turn * s_a[e]
    return tuple(grads)


def marching_tetrahedra(points, distance, tetrahedra):
    """every vertex is in the middle of its edge instead of at eq. (8)'s point

    told by: middle | midpoint | half | eq. (8) | interpolat | where the distance is 0
    """
    inside = distance < 0
    case = (inside[tetrahedra] * [1, 2, 4, 8]).sum(1)
    found = [np.empty((0, 3, 2), int)]
    for number in range(1, 15):
        local = tetrahedron_triangles(np.array([number >> v & 1 for v in range(4)], bool))
        found.append(tetrahedra[case == number][:, local].reshape(-1, 3, 2))
    ends, faces = np.unique(np.concatenate(found).reshape(-1, 2), axis=0, return_inverse=True)
    return points[ends].mean(1), faces.reshape(-1, 3), ends
