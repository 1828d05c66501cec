"""Lab 15's tetrahedra as printed."""


def tetrahedron_triangles(inside):
    for order in itertools.permutations(range(4)):
        if is_odd(order):
            continue
        a, b, c, d = order
        signs = [bool(inside[v]) for v in order]
        if signs == [True, False, False, False]:
            return np.array([[(a, b), (a, c), (a, d)]])
        if signs == [True, True, False, False]:
            return np.array([[(a, c), (a, d), (b, d)], [(a, c), (b, d), (b, c)]])
        if signs == [True, True, True, False]:
            return np.array([[(a, d), (b, d), (c, d)]])
    return np.array([])


def zero_crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    along = (grad_p * (p_a - p_b)).sum(1)
    span = s_b - s_a
    return (grad_p * (s_b / span)[:, None], grad_p * (-s_a / span)[:, None],
            s_b / span**2 * along, -s_a / span**2 * along)
