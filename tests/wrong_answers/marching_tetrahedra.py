"""Wrong answers to marching_tetrahedra, written without a look at the checks."""


def tetrahedron_triangles(inside):
    """all triangles are clockwise seen from outside: they face inwards

    told by: clockwise | inwards | face in | orientation | winding | turned round | flipped | reversed
    """
    count = inside.sum()
    order = np.argsort(~inside, kind="stable")
    if is_odd(order):
        s = [0, 1] if count > 1 else [2, 3]
        order[s] = order[s[::-1]]
    a, b, c, d = order
    around = {1: [(a, d), (a, c), (a, b)], 2: [(b, c), (b, d), (a, d), (a, c)],
              3: [(c, d), (b, d), (a, d)]}.get(int(count), [])
    fan = [(around[0], around[i], around[i + 1]) for i in range(1, len(around) - 1)]
    return np.array(fan, int).reshape(-1, 3, 2)


def tetrahedron_triangles(inside):
    """with two inside the quadrangle's corners go across: a c, a d, b c, b d is not its order around

    told by: quad | across | two inside | bow tie | cross each other | order & around
    """
    count = inside.sum()
    order = np.argsort(~inside, kind="stable")
    if is_odd(order):
        swapped = [0, 1] if count > 1 else [2, 3]
        order[swapped] = order[swapped[::-1]]
    a, b, c, d = order
    corners = {1: [(a, b), (a, c), (a, d)], 2: [(a, c), (a, d), (b, c), (b, d)],
               3: [(a, d), (b, d), (c, d)]}.get(int(count), [])
    fan = [(corners[0], *pair) for pair in itertools.pairwise(corners[1:])]
    return np.array(fan, int).reshape(-1, 3, 2)


def tetrahedron_triangles(inside):
    """each edge is named with its smaller vertex first, not with the vertex inside first

    told by: smaller | sorted | inside & first | outside & first | order of & edge | vertex & first | ends
    """
    count = inside.sum()
    order = np.argsort(~inside, kind="stable")
    if is_odd(order):
        swapped = [0, 1] if count > 1 else [2, 3]
        order[swapped] = order[swapped[::-1]]
    a, b, c, d = order
    around = {1: [(a, b), (a, c), (a, d)],
              2: [(a, c), (a, d), (b, d), (b, c)],
              3: [(a, d), (b, d), (c, d)]}.get(int(count), [])
    fan = [(around[0], *pair) for pair in itertools.pairwise(around[1:])]
    return np.sort(np.array(fan, int).reshape(-1, 3, 2), axis=-1)


def tetrahedron_triangles(inside):
    """three inside are treated like one inside with the roles exchanged, but the triangle is not turned round, so that it faces inwards

    told by: three inside | three & turned | complement | one outside | three vertices
    """
    def few(flags):
        k = int(np.flatnonzero(flags)[0])
        others = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]][k]
        return k, others
    n = inside.sum()
    if n == 1:
        k, o = few(inside)
        return np.array([[(k, o[0]), (k, o[1]), (k, o[2])]])
    if n == 3:
        k, o = few(~inside)
        return np.array([[(o[0], k), (o[1], k), (o[2], k)]])
    if n == 2:
        order = np.argsort(~inside, kind="stable")
        if is_odd(order):
            order[[0, 1]] = order[[1, 0]]
        a, b, c, d = order
        return np.array([[(a, c), (a, d), (b, d)], [(a, c), (b, d), (b, c)]])
    return np.empty((0, 3, 2), int)


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """both distances' gradients have the wrong sign: the direction is p_a - p_b

    told by: sign | p_a - p_b | minus | negat | opposite
    """
    e = len(s_a)
    ga, gb = np.zeros((e, 3)), np.zeros((e, 3))
    gsa, gsb = np.zeros(e), np.zeros(e)
    for i in range(e):
        span = s_b[i] - s_a[i]
        ga[i] = s_b[i] / span * grad_p[i]
        gb[i] = -s_a[i] / span * grad_p[i]
        along = grad_p[i] @ (p_a[i] - p_b[i])
        gsa[i] = -along * s_b[i] / span**2
        gsb[i] = along * s_a[i] / span**2
    return ga, gb, gsa, gsb


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the derivative of t is divided by s_b - s_a once and not by its square

    told by: square | **2 | ^2 | once | power | divided twice
    """
    t = (s_a / (s_a - s_b))[:, None]
    span = s_b - s_a
    along = (grad_p * (p_b - p_a)).sum(-1)
    return (1 - t) * grad_p, t * grad_p, -along * s_b / span, along * s_a / span


def marching_tetrahedra(points, distance, tetrahedra):
    """vertices are not merged: each triangle has three of its own, so the mesh falls apart

    told by: merge | each once | shared | duplicate | own vertices | several times | unique | more than once
    """
    inside = distance < 0
    case = inside[tetrahedra] @ np.array([1, 2, 4, 8])
    corners = [np.empty((0, 3, 2), int)]
    for number in range(1, 15):
        triangles = tetrahedron_triangles(number >> np.arange(4) & 1 == 1)
        corners.append(tetrahedra[case == number][:, triangles].reshape(-1, 3, 2))
    ends = np.concatenate(corners).reshape(-1, 2)
    a, b = ends.T
    vertices = crossing(points[a], points[b], distance[a], distance[b])
    return vertices, np.arange(len(ends)).reshape(-1, 3), ends


def marching_tetrahedra(points, distance, tetrahedra):
    """the case with the number 14, all inside but the first vertex, is left out: range ends too early

    told by: case 14 | last case | range | one outside | all but one | three inside | holes
    """
    inside = distance < 0
    case = inside[tetrahedra] @ np.array([1, 2, 4, 8])
    corners = [np.empty((0, 3, 2), int)]
    for number in range(1, 14):
        triangles = tetrahedron_triangles(number >> np.arange(4) & 1 == 1)
        corners.append(tetrahedra[case == number][:, triangles].reshape(-1, 3, 2))
    edge = np.concatenate(corners) @ np.array([len(points), 1])
    edge, faces = np.unique(edge, return_inverse=True)
    a, b = np.divmod(edge, len(points))
    vertices = crossing(points[a], points[b], distance[a], distance[b])
    return vertices, faces.reshape(-1, 3), np.stack([a, b], -1)
