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
