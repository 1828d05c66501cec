"""Mistakes of lab 15; each docstring goes on after "this is what comes out when"."""


def box(points, half_size):
    """half_size is taken for the whole size: it is halved once more"""
    beyond = np.abs(points) - half_size / 2
    return np.linalg.norm(np.maximum(beyond, 0), axis=-1) + np.minimum(beyond.max(-1), 0)


def box(points, half_size):
    """the distance inside is 0: the negative part of the formula is missing"""
    beyond = np.abs(points) - half_size
    return np.linalg.norm(np.maximum(beyond, 0), axis=-1)


def box(points, half_size):
    """outside, axes on which the point lies between the sides count, too: the maximum with 0 is
    missing
    """
    beyond = np.abs(points) - half_size
    return np.linalg.norm(beyond, axis=-1) + np.minimum(beyond.max(-1), 0)


def box(points, half_size):
    """outside, the largest coordinate alone counts, as if no edge or corner were nearest"""
    return (np.abs(points) - half_size).max(-1)


def box(points, half_size):
    """inside, the farthest side counts: the smallest of the three numbers, not the largest"""
    beyond = np.abs(points) - half_size
    within = np.where(beyond.max(-1) < 0, beyond.min(-1), 0)
    return np.linalg.norm(np.maximum(beyond, 0), axis=-1) + within


def box_backward(grad_distance, points, half_size):
    """in the middle of an axis the sign is 0: of two opposite sides the positive one counts"""
    beyond = np.abs(points) - half_size
    outward = np.sign(points)
    nearest_side = np.arange(3) == beyond.argmax(-1)[..., None]
    is_outside = beyond.max(-1, keepdims=True) > 0
    slope = np.where(is_outside, unit(np.maximum(beyond, 0)), nearest_side)
    return grad_distance[..., None] * outward * slope


def box_backward(grad_distance, points, half_size):
    """negative coordinates get no sign: all gradients point to the positive side"""
    beyond = np.abs(points) - half_size
    nearest_side = np.arange(3) == beyond.argmax(-1)[..., None]
    is_outside = beyond.max(-1, keepdims=True) > 0
    slope = np.where(is_outside, unit(np.maximum(beyond, 0)), nearest_side)
    return grad_distance[..., None] * slope


def box_backward(grad_distance, points, half_size):
    """outside, the gradient is not divided by its length, which is to be 1"""
    beyond = np.abs(points) - half_size
    outward = np.where(points < 0, -1.0, 1.0)
    nearest_side = np.arange(3) == beyond.argmax(-1)[..., None]
    is_outside = beyond.max(-1, keepdims=True) > 0
    slope = np.where(is_outside, np.maximum(beyond, 0), nearest_side)
    return grad_distance[..., None] * outward * slope


def box_backward(grad_distance, points, half_size):
    """grad_distance is left out"""
    beyond = np.abs(points) - half_size
    outward = np.where(points < 0, -1.0, 1.0)
    nearest_side = np.arange(3) == beyond.argmax(-1)[..., None]
    is_outside = beyond.max(-1, keepdims=True) > 0
    return outward * np.where(is_outside, unit(np.maximum(beyond, 0)), nearest_side)


def box_backward(grad_distance, points, half_size):
    """outside, the axis of the largest coordinate alone has a gradient, as it has inside"""
    beyond = np.abs(points) - half_size
    outward = np.where(points < 0, -1.0, 1.0)
    return grad_distance[..., None] * outward * (np.arange(3) == beyond.argmax(-1)[..., None])


def box_backward(grad_distance, points, half_size):
    """inside, the side is chosen by the largest coordinate; the nearest side is that of the largest
    |x| - half_size
    """
    beyond = np.abs(points) - half_size
    outward = np.where(points < 0, -1.0, 1.0)
    side = np.arange(3) == np.abs(points).argmax(-1)[..., None]
    is_outside = beyond.max(-1, keepdims=True) > 0
    slope = np.where(is_outside, unit(np.maximum(beyond, 0)), side)
    return grad_distance[..., None] * outward * slope


def torus(points, radius, tube):
    """the ring is around the z axis; it is around the y axis, in the plane y = 0"""
    from_axis = np.hypot(points[..., 0], points[..., 1])
    return np.hypot(from_axis - radius, points[..., 2]) - tube


def torus(points, radius, tube):
    """tube is not taken away: it is the distance to the circle"""
    from_axis = np.hypot(points[..., 0], points[..., 2])
    return np.hypot(from_axis - radius, points[..., 1])


def torus(points, radius, tube):
    """radius and tube are swapped"""
    from_axis = np.hypot(points[..., 0], points[..., 2])
    return np.hypot(from_axis - tube, points[..., 1]) - radius


def torus(points, radius, tube):
    """squares are compared: the root is missing, and tube is squared"""
    from_axis = np.hypot(points[..., 0], points[..., 2])
    return (from_axis - radius)**2 + points[..., 1]**2 - tube**2


def torus_backward(grad_distance, points, radius, tube):
    """the chain rule stops at the distance from the axis: x and z are not divided by it, though its
    derivatives are x / from_axis and z / from_axis
    """
    x, y, z = np.moveaxis(points, -1, 0)
    from_axis = np.hypot(x, z)
    from_circle = np.hypot(from_axis - radius, y)
    g = grad_distance / np.where(from_circle > 0, from_circle, 1)
    g_axis = g * (from_axis - radius)
    return np.stack([g_axis * x, g * y, g_axis * z], -1)


def torus_backward(grad_distance, points, radius, tube):
    """it is not divided by the distance from the circle: its length is not 1"""
    x, y, z = np.moveaxis(points, -1, 0)
    from_axis = np.hypot(x, z)
    g = grad_distance
    g_axis = g * (from_axis - radius) / np.where(from_axis > 0, from_axis, 1)
    return np.stack([g_axis * x, g * y, g_axis * z], -1)


def torus_backward(grad_distance, points, radius, tube):
    """y goes the way of x and z, through the distance from the axis, of which it is no part"""
    x, y, z = np.moveaxis(points, -1, 0)
    from_axis = np.hypot(x, z)
    from_circle = np.hypot(from_axis - radius, y)
    g = grad_distance / np.where(from_circle > 0, from_circle, 1)
    g_axis = g * (from_axis - radius) / np.where(from_axis > 0, from_axis, 1)
    return np.stack([g_axis * x, g_axis * y, g_axis * z], -1)


def torus_backward(grad_distance, points, radius, tube):
    """tube is taken away before the division: it is divided by the distance from the surface, and
    not by that from the circle
    """
    x, y, z = np.moveaxis(points, -1, 0)
    from_axis = np.hypot(x, z)
    from_surface = np.hypot(from_axis - radius, y) - tube
    g = grad_distance / from_surface
    g_axis = g * (from_axis - radius) / np.where(from_axis > 0, from_axis, 1)
    return np.stack([g_axis * x, g * y, g_axis * z], -1)


def smooth_union(a, b, k):
    """h is not kept at 0 where it is negative, so that it swells far from the seam, too"""
    h = 1 - np.abs(a - b) / k
    return np.minimum(a, b) - k * h**2 / 4


def smooth_union(a, b, k):
    """h is not squared"""
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return np.minimum(a, b) - k * h / 4


def smooth_union(a, b, k):
    """the term k h^2 / 4 is added to the minimum, and not subtracted: the sign is wrong, the seam
    becomes a groove
    """
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return np.minimum(a, b) + k * h**2 / 4


def smooth_union(a, b, k):
    """the maximum takes the minimum's place: the larger distance is that of the intersection"""
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return np.maximum(a, b) - k * h**2 / 4


def smooth_union(a, b, k):
    """the factor k is missing: it is k h^2 / 4, and not h^2 / 4"""
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return np.minimum(a, b) - h**2 / 4


def smooth_union(a, b, k):
    """the 4 is missing: it is k h^2 / 4, and not k h^2"""
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return np.minimum(a, b) - k * h**2


def smooth_union_backward(grad_distance, a, b, k):
    """the shares are swapped: the smaller distance is to have the larger share"""
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


def smooth_union_backward(grad_distance, a, b, k):
    """the seam is left out: the smaller distance gets all, as in a plain union"""
    return np.where(a <= b, grad_distance, 0), np.where(a <= b, 0, grad_distance)


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    """steps are not divided by the Lipschitz constant L"""
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
    """all rays are counted as long as any is on its way, those that hit or missed, too: each has
    the number of the slowest
    """
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
    """a miss keeps the t where it ended; its t is to be np.inf"""
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


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    """the last evaluation is not counted, the one that finds the hit"""
    t, evaluations = np.zeros(len(origins)), np.zeros(len(origins), int)
    hit, active = np.zeros(len(origins), bool), np.arange(len(origins))
    for _ in range(most):
        s = signed_distance(origins[active] + t[active, None] * directions[active], shape)
        hit[active[s < epsilon]] = True
        active, s = active[s >= epsilon], s[s >= epsilon]
        evaluations[active] += 1
        t[active] += s / lipschitz
        active = active[t[active] <= far]
    return np.where(hit, t, np.inf), evaluations


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    """the absolute value of s is compared with epsilon: a ray that is inside has hit, too"""
    t, evaluations = np.zeros(len(origins)), np.zeros(len(origins), int)
    hit, active = np.zeros(len(origins), bool), np.arange(len(origins))
    for _ in range(most):
        s = signed_distance(origins[active] + t[active, None] * directions[active], shape)
        evaluations[active] += 1
        hit[active[np.abs(s) < epsilon]] = True
        active, s = active[np.abs(s) >= epsilon], s[np.abs(s) >= epsilon]
        t[active] += s / lipschitz
        active = active[t[active] <= far]
    return np.where(hit, t, np.inf), evaluations


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    """t moves on before s is compared with epsilon: a hit lies one step behind its t"""
    t, evaluations = np.zeros(len(origins)), np.zeros(len(origins), int)
    hit, active = np.zeros(len(origins), bool), np.arange(len(origins))
    for _ in range(most):
        s = signed_distance(origins[active] + t[active, None] * directions[active], shape)
        evaluations[active] += 1
        t[active] += s / lipschitz
        hit[active[s < epsilon]] = True
        active = active[(s >= epsilon) & (t[active] <= far)]
    return np.where(hit, t, np.inf), evaluations


def ray_weights(density, spacing):
    """T holds the sample's own density: the sum goes over j < i, those before it, and the sample
    itself is one too many
    """
    thickness = density * spacing
    passed = np.exp(-np.cumsum(thickness, -1))
    return passed * -np.expm1(-thickness), passed[:, -1]


def ray_weights(density, spacing):
    """T is left out: the weights are the opacities alone, and nothing hides what is behind"""
    thickness = density * spacing
    passed = np.exp(-np.cumsum(thickness, -1))
    return -np.expm1(-thickness), passed[:, -1]


def ray_weights(density, spacing):
    """the opacity 1 - exp(-sigma delta) is taken for sigma delta, its first order"""
    thickness = density * spacing
    passed = np.exp(-np.cumsum(thickness, -1))
    before = np.concatenate([np.ones_like(passed[:, :1]), passed[:, :-1]], -1)
    return before * thickness, passed[:, -1]


def ray_weights(density, spacing):
    """T holds the densities behind the sample, as if the last sample came first on the ray"""
    thickness = density * spacing
    behind = np.cumsum(thickness[:, ::-1], -1)[:, ::-1] - thickness
    return np.exp(-behind) * -np.expm1(-thickness), np.exp(-thickness.sum(-1))


def ray_weights(density, spacing):
    """T_end is the light before the last sample: what the last sample absorbs is missing"""
    thickness = density * spacing
    passed = np.exp(-np.cumsum(thickness, -1))
    before = np.concatenate([np.ones_like(passed[:, :1]), passed[:, :-1]], -1)
    return before * -np.expm1(-thickness), before[:, -1]


def ray_weights(density, spacing):
    """spacing is left out: sigma stands alone in the place of sigma delta"""
    passed = np.exp(-np.cumsum(density, -1))
    before = np.concatenate([np.ones_like(passed[:, :1]), passed[:, :-1]], -1)
    return before * -np.expm1(-density), passed[:, -1]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """the samples and the background behind, which become hidden, do not count"""
    weights, _ = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    passed = np.exp(-np.cumsum(density * spacing, -1))
    return spacing * passed * along, weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """the factor spacing is missing in grad_density: this is the gradient with respect to tau"""
    weights, remaining = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    seen = np.concatenate([weights * along, (remaining * (grad_output @ background))[:, None]], -1)
    behind = np.cumsum(seen[:, :0:-1], -1)[:, ::-1]
    passed = np.exp(-np.cumsum(density * spacing, -1))
    return passed * along - behind, weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """what becomes hidden is added; it is lost: its sign is a minus"""
    weights, remaining = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    seen = np.concatenate([weights * along, (remaining * (grad_output @ background))[:, None]], -1)
    behind = np.cumsum(seen[:, :0:-1], -1)[:, ::-1]
    passed = np.exp(-np.cumsum(density * spacing, -1))
    return spacing * (passed * along + behind), weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """the background is left out of what is behind and becomes hidden"""
    weights, _ = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    seen = weights * along
    behind = np.cumsum(seen[:, ::-1], -1)[:, ::-1] - seen
    passed = np.exp(-np.cumsum(density * spacing, -1))
    return spacing * (passed * along - behind), weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """what is behind counts the sample itself, too: the sum begins with the sample behind it"""
    weights, remaining = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    beyond = remaining * (grad_output @ background)
    behind = np.cumsum((weights * along)[:, ::-1], -1)[:, ::-1] + beyond[:, None]
    passed = np.exp(-np.cumsum(density * spacing, -1))
    return spacing * (passed * along - behind), weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """the sample's own colour has T before the sample, T_i; it is T_(i+1), that behind it"""
    weights, remaining = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    seen = np.concatenate([weights * along, (remaining * (grad_output @ background))[:, None]], -1)
    behind = np.cumsum(seen[:, :0:-1], -1)[:, ::-1]
    thickness = density * spacing
    before = np.exp(thickness - np.cumsum(thickness, -1))
    return spacing * (before * along - behind), weights[..., None] * grad_output[:, None]
