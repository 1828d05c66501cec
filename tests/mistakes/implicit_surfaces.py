"""Mistakes of lab 15; each docstring goes on after "this is what comes out when"."""


def box(points, half_size):
    """half_size is taken for the whole size"""
    beyond = np.abs(points) - half_size / 2
    return np.linalg.norm(np.maximum(beyond, 0), axis=-1) + np.minimum(beyond.max(-1), 0)


def box(points, half_size):
    """inside it is 0: the negative part is missing"""
    beyond = np.abs(points) - half_size
    return np.linalg.norm(np.maximum(beyond, 0), axis=-1)


def box(points, half_size):
    """axes on which the point lies between the sides count outside, too"""
    beyond = np.abs(points) - half_size
    return np.linalg.norm(beyond, axis=-1) + np.minimum(beyond.max(-1), 0)


def box_backward(grad_distance, points, half_size):
    """in the middle of an axis the sign is 0: of two opposite sides the positive one counts"""
    beyond = np.abs(points) - half_size
    outward = np.sign(points)
    nearest_side = np.arange(3) == beyond.argmax(-1)[..., None]
    is_outside = beyond.max(-1, keepdims=True) > 0
    slope = np.where(is_outside, unit(np.maximum(beyond, 0)), nearest_side)
    return grad_distance[..., None] * outward * slope


def box_backward(grad_distance, points, half_size):
    """negative coordinates get no sign"""
    beyond = np.abs(points) - half_size
    nearest_side = np.arange(3) == beyond.argmax(-1)[..., None]
    is_outside = beyond.max(-1, keepdims=True) > 0
    slope = np.where(is_outside, unit(np.maximum(beyond, 0)), nearest_side)
    return grad_distance[..., None] * slope


def box_backward(grad_distance, points, half_size):
    """outside the gradient's length is not 1"""
    beyond = np.abs(points) - half_size
    outward = np.where(points < 0, -1.0, 1.0)
    nearest_side = np.arange(3) == beyond.argmax(-1)[..., None]
    is_outside = beyond.max(-1, keepdims=True) > 0
    slope = np.where(is_outside, np.maximum(beyond, 0), nearest_side)
    return grad_distance[..., None] * outward * slope


def torus(points, radius, tube):
    """the ring is around the z axis; it is around y"""
    from_axis = np.hypot(points[..., 0], points[..., 1])
    return np.hypot(from_axis - radius, points[..., 1]) - tube


def torus(points, radius, tube):
    """tube is not taken away: it is the distance to the circle"""
    from_axis = np.hypot(points[..., 0], points[..., 2])
    return np.hypot(from_axis - radius, points[..., 1])


def torus(points, radius, tube):
    """radius and tube are swapped"""
    from_axis = np.hypot(points[..., 0], points[..., 2])
    return np.hypot(from_axis - tube, points[..., 1]) - radius


def torus_backward(grad_distance, points, radius, tube):
    """the way from from_axis to x and z is forgotten: its derivative is x / from_axis"""
    x, y, z = np.moveaxis(points, -1, 0)
    from_axis = np.hypot(x, z)
    from_circle = np.hypot(from_axis - radius, y)
    g = grad_distance / np.where(from_circle > 0, from_circle, 1)
    g_axis = g * (from_axis - radius)
    return np.stack([g_axis * x, g * y, g_axis * z], -1)


def torus_backward(grad_distance, points, radius, tube):
    """it is not divided by the distance from the circle"""
    x, y, z = np.moveaxis(points, -1, 0)
    from_axis = np.hypot(x, z)
    g = grad_distance
    g_axis = g * (from_axis - radius) / np.where(from_axis > 0, from_axis, 1)
    return np.stack([g_axis * x, g * y, g_axis * z], -1)


def torus_backward(grad_distance, points, radius, tube):
    """y goes the way of x and z; it is not a part of from_axis"""
    x, y, z = np.moveaxis(points, -1, 0)
    from_axis = np.hypot(x, z)
    from_circle = np.hypot(from_axis - radius, y)
    g = grad_distance / np.where(from_circle > 0, from_circle, 1)
    g_axis = g * (from_axis - radius) / np.where(from_axis > 0, from_axis, 1)
    return np.stack([g_axis * x, g_axis * y, g_axis * z], -1)


def smooth_union(a, b, k):
    """h is not kept at 0: far from the seam it swells, too"""
    h = 1 - np.abs(a - b) / k
    return np.minimum(a, b) - k * h**2 / 4


def smooth_union(a, b, k):
    """h is not squared"""
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return np.minimum(a, b) - k * h / 4


def smooth_union(a, b, k):
    """the seam is dented instead of filled"""
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return np.minimum(a, b) + k * h**2 / 4


def smooth_union_backward(grad_distance, a, b, k):
    """the shares are swapped: the smaller distance is to have the larger one"""
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    share = np.where(a < b, h / 2, 1 - h / 2)
    return grad_distance * share, grad_distance * (1 - share)


def smooth_union_backward(grad_distance, a, b, k):
    """the half is missing: h^2 / 4 has the derivative h / 2"""
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    share = np.where(a < b, 1 - h, h)
    return grad_distance * share, grad_distance * (1 - share)


def smooth_union_backward(grad_distance, a, b, k):
    """both get the share of a"""
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    share = np.where(a < b, 1 - h / 2, h / 2)
    return grad_distance * share, grad_distance * share


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    """steps are not divided by L"""
    t, evaluations = np.zeros(len(origins)), np.zeros(len(origins), int)
    hit, active = np.zeros(len(origins), bool), np.arange(len(origins))
    for _ in range(most):
        s = signed_distance(origins[active] + t[active, None] * directions[active], shape)
        evaluations[active] += 1
        hit[active[s < epsilon]] = True
        active, s = active[s >= epsilon], s[s >= epsilon]
        t[active] += s
        active = active[t[active] <= far]
    return np.where(hit, t, np.inf), evaluations


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    """rays that are done are counted on: all have the number of the slowest"""
    t, evaluations = np.zeros(len(origins)), np.zeros(len(origins), int)
    hit, active = np.zeros(len(origins), bool), np.arange(len(origins))
    for _ in range(most):
        s = signed_distance(origins[active] + t[active, None] * directions[active], shape)
        evaluations += 1
        hit[active[s < epsilon]] = True
        active, s = active[s >= epsilon], s[s >= epsilon]
        t[active] += s / lipschitz
        active = active[t[active] <= far]
    return np.where(hit, t, np.inf), evaluations


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    """a miss keeps the t where it ended; it is infinite"""
    t, evaluations = np.zeros(len(origins)), np.zeros(len(origins), int)
    hit, active = np.zeros(len(origins), bool), np.arange(len(origins))
    for _ in range(most):
        s = signed_distance(origins[active] + t[active, None] * directions[active], shape)
        evaluations[active] += 1
        hit[active[s < epsilon]] = True
        active, s = active[s >= epsilon], s[s >= epsilon]
        t[active] += s / lipschitz
        active = active[t[active] <= far]
    return t, evaluations


def ray_weights(density, spacing):
    """T holds the sample's own density; it is that of those before it"""
    thickness = density * spacing
    passed = np.exp(-np.cumsum(thickness, -1))
    return passed * -np.expm1(-thickness), passed[:, -1]


def ray_weights(density, spacing):
    """nothing hides what is behind: T is left out"""
    thickness = density * spacing
    passed = np.exp(-np.cumsum(thickness, -1))
    return -np.expm1(-thickness), passed[:, -1]


def ray_weights(density, spacing):
    """sigma delta is taken for 1 - exp(-sigma delta)"""
    thickness = density * spacing
    passed = np.exp(-np.cumsum(thickness, -1))
    before = np.concatenate([np.ones_like(passed[:, :1]), passed[:, :-1]], -1)
    return before * thickness, passed[:, -1]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """what becomes hidden does not count"""
    weights, _ = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    passed = np.exp(-np.cumsum(density * spacing, -1))
    return spacing * passed * along, weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """the factor delta is missing"""
    weights, remaining = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    seen = np.concatenate([weights * along, (remaining * (grad_output @ background))[:, None]], -1)
    behind = np.cumsum(seen[:, :0:-1], -1)[:, ::-1]
    passed = np.exp(-np.cumsum(density * spacing, -1))
    return passed * along - behind, weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """what is hidden is added; it is lost"""
    weights, remaining = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    seen = np.concatenate([weights * along, (remaining * (grad_output @ background))[:, None]], -1)
    behind = np.cumsum(seen[:, :0:-1], -1)[:, ::-1]
    passed = np.exp(-np.cumsum(density * spacing, -1))
    return spacing * (passed * along + behind), weights[..., None] * grad_output[:, None]


def tetrahedron_triangles(inside):
    """odd permutations are taken for turns: these cases are wound the wrong way"""
    count, order = inside.sum(), np.argsort(~inside, kind="stable")
    a, b, c, d = order
    around = {1: [(a, b), (a, c), (a, d)],
              2: [(a, c), (a, d), (b, d), (b, c)],
              3: [(a, d), (b, d), (c, d)]}.get(count, [])
    fan = [(around[0], *pair) for pair in itertools.pairwise(around[1:])]
    return np.array(fan, int).reshape(-1, 3, 2)


def tetrahedron_triangles(inside):
    """four corners are not in their order around: the two triangles cross as a bow tie"""
    count, order = inside.sum(), np.argsort(~inside, kind="stable")
    if is_odd(order):
        swapped = [0, 1] if count > 1 else [2, 3]
        order[swapped] = order[swapped[::-1]]
    a, b, c, d = order
    around = {1: [(a, b), (a, c), (a, d)],
              2: [(a, c), (a, d), (b, c), (b, d)],
              3: [(a, d), (b, d), (c, d)]}.get(count, [])
    fan = [(around[0], *pair) for pair in itertools.pairwise(around[1:])]
    return np.array(fan, int).reshape(-1, 3, 2)


def tetrahedron_triangles(inside):
    """inside and outside are swapped"""
    count, order = (~inside).sum(), np.argsort(inside, kind="stable")
    if is_odd(order):
        swapped = [0, 1] if count > 1 else [2, 3]
        order[swapped] = order[swapped[::-1]]
    a, b, c, d = order
    around = {1: [(a, b), (a, c), (a, d)],
              2: [(a, c), (a, d), (b, d), (b, c)],
              3: [(a, d), (b, d), (c, d)]}.get(count, [])
    fan = [(around[0], *pair) for pair in itertools.pairwise(around[1:])]
    return np.array(fan, int).reshape(-1, 3, 2)


def crossing(p_a, p_b, s_a, s_b):
    """each point is weighted with its own distance; it is that of the other one"""
    return (p_a * s_a[:, None] - p_b * s_b[:, None]) / (s_b - s_a)[:, None]


def crossing(p_a, p_b, s_a, s_b):
    """it is not divided by s_b - s_a"""
    return p_a * s_b[:, None] - p_b * s_a[:, None]


def crossing(p_a, p_b, s_a, s_b):
    """it is divided by the sum; s_a is negative"""
    return (p_a * s_b[:, None] - p_b * s_a[:, None]) / (s_b + s_a)[:, None]


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the weights of both ends are swapped"""
    t, span = (s_a / (s_a - s_b))[:, None], s_b - s_a
    grad_t = (grad_p * (p_b - p_a)).sum(-1)
    return t * grad_p, (1 - t) * grad_p, -grad_t * s_b / span**2, grad_t * s_a / span**2


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """the gradients by the distances have the wrong sign"""
    t, span = (s_a / (s_a - s_b))[:, None], s_b - s_a
    grad_t = (grad_p * (p_b - p_a)).sum(-1)
    return (1 - t) * grad_p, t * grad_p, grad_t * s_b / span**2, -grad_t * s_a / span**2


def crossing_backward(grad_p, p_a, p_b, s_a, s_b):
    """it is divided by s_b - s_a once; the derivative of the quotient has its square"""
    t, span = (s_a / (s_a - s_b))[:, None], s_b - s_a
    grad_t = (grad_p * (p_b - p_a)).sum(-1)
    return (1 - t) * grad_p, t * grad_p, -grad_t * s_b / span, grad_t * s_a / span


def marching_tetrahedra(points, distance, tetrahedra):
    """0 counts as inside; it is outside"""
    inside = distance <= 0
    case = inside[tetrahedra] @ np.array([1, 2, 4, 8], np.uint8)
    crossed = (0 < case) & (case < 15)
    tetrahedra, case = tetrahedra[crossed], case[crossed]
    corners = [np.empty((0, 3, 2), int)]
    for number in range(1, 15):
        triangles = tetrahedron_triangles(number >> np.arange(4) & 1 == 1)
        corners.append(tetrahedra[case == number][:, triangles].reshape(-1, 3, 2))
    edge = np.concatenate(corners) @ np.array([len(points), 1])
    edge, faces = np.unique(edge, return_inverse=True)
    a, b = ends = np.divmod(edge, len(points))
    vertices = crossing(points[a], points[b], distance[a], distance[b])
    return vertices, faces.reshape(-1, 3), np.stack(ends, -1)


def marching_tetrahedra(points, distance, tetrahedra):
    """the bits of a case are read in reverse"""
    inside = distance < 0
    case = inside[tetrahedra] @ np.array([8, 4, 2, 1], np.uint8)
    crossed = (0 < case) & (case < 15)
    tetrahedra, case = tetrahedra[crossed], case[crossed]
    corners = [np.empty((0, 3, 2), int)]
    for number in range(1, 15):
        triangles = tetrahedron_triangles(number >> np.arange(4) & 1 == 1)
        corners.append(tetrahedra[case == number][:, triangles].reshape(-1, 3, 2))
    edge = np.concatenate(corners) @ np.array([len(points), 1])
    edge, faces = np.unique(edge, return_inverse=True)
    a, b = ends = np.divmod(edge, len(points))
    vertices = crossing(points[a], points[b], distance[a], distance[b])
    return vertices, faces.reshape(-1, 3), np.stack(ends, -1)


def marching_tetrahedra(points, distance, tetrahedra):
    """the distances of both ends are swapped"""
    inside = distance < 0
    case = inside[tetrahedra] @ np.array([1, 2, 4, 8], np.uint8)
    crossed = (0 < case) & (case < 15)
    tetrahedra, case = tetrahedra[crossed], case[crossed]
    corners = [np.empty((0, 3, 2), int)]
    for number in range(1, 15):
        triangles = tetrahedron_triangles(number >> np.arange(4) & 1 == 1)
        corners.append(tetrahedra[case == number][:, triangles].reshape(-1, 3, 2))
    edge = np.concatenate(corners) @ np.array([len(points), 1])
    edge, faces = np.unique(edge, return_inverse=True)
    a, b = ends = np.divmod(edge, len(points))
    vertices = crossing(points[a], points[b], -distance[b], -distance[a])
    return vertices, faces.reshape(-1, 3), np.stack(ends, -1)
