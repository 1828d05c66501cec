"""Mistakes of lab 15; each docstring goes on after "this is what comes out when"."""


def tetrahedron_triangles(inside):
    """odd orders of the four vertices are taken for turns, though they mirror space: in these cases
    the triangles are wound the wrong way
    """
    count, order = inside.sum(), np.argsort(~inside, kind="stable")
    a, b, c, d = order
    around = {1: [(a, b), (a, c), (a, d)],
              2: [(a, c), (a, d), (b, d), (b, c)],
              3: [(a, d), (b, d), (c, d)]}.get(count, [])
    fan = [(around[0], *pair) for pair in itertools.pairwise(around[1:])]
    return np.array(fan, int).reshape(-1, 3, 2)


def tetrahedron_triangles(inside):
    """all triangles are clockwise seen from outside: the winding is flipped, they face inward"""
    count, order = inside.sum(), np.argsort(~inside, kind="stable")
    if is_odd(order):
        swapped = [0, 1] if count > 1 else [2, 3]
        order[swapped] = order[swapped[::-1]]
    a, b, c, d = order
    around = {1: [(a, d), (a, c), (a, b)],
              2: [(b, c), (b, d), (a, d), (a, c)],
              3: [(c, d), (b, d), (a, d)]}.get(count, [])
    fan = [(around[0], *pair) for pair in itertools.pairwise(around[1:])]
    return np.array(fan, int).reshape(-1, 3, 2)


def tetrahedron_triangles(inside):
    """each corner has the vertex outside first; the vertex inside is to be first"""
    count, order = inside.sum(), np.argsort(~inside, kind="stable")
    if is_odd(order):
        swapped = [0, 1] if count > 1 else [2, 3]
        order[swapped] = order[swapped[::-1]]
    a, b, c, d = order
    around = {1: [(b, a), (c, a), (d, a)],
              2: [(c, a), (d, a), (d, b), (c, b)],
              3: [(d, a), (d, b), (d, c)]}.get(count, [])
    fan = [(around[0], *pair) for pair in itertools.pairwise(around[1:])]
    return np.array(fan, int).reshape(-1, 3, 2)


def zero_crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the distances get no gradient, as if they did not move the crossing: t depends on them"""
    t = (s_a / (s_a - s_b))[:, None]
    return (1 - t) * grad_p, t * grad_p, np.zeros(len(s_a)), np.zeros(len(s_b))


def marching_tetrahedra(points, distance, tetrahedra):
    """vertices are not merged: each triangle has three vertices of its own, shared with none"""
    inside = distance < 0
    case = inside[tetrahedra] @ np.array([1, 2, 4, 8], np.uint8)
    corners = [np.empty((0, 3, 2), int)]
    for number in range(1, 15):
        triangles = tetrahedron_triangles(number >> np.arange(4) & 1 == 1)
        corners.append(tetrahedra[case == number][:, triangles].reshape(-1, 3, 2))
    ends = np.concatenate(corners).reshape(-1, 2)
    a, b = ends.T
    vertices = zero_crossing(points[a], points[b], distance[a], distance[b])
    return vertices, np.arange(len(ends)).reshape(-1, 3), ends
