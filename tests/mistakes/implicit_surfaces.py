"""Mistakes of lab 15; each docstring goes on after "this is what comes out when"."""


def box(points, half_size):
    """outside, the largest coordinate alone counts, as if no edge or corner were nearest"""
    return (np.abs(points) - half_size).max(-1)


def box(points, half_size):
    """inside, the farthest side counts: the smallest of the three numbers, not the largest"""
    beyond = np.abs(points) - half_size
    within = np.where(beyond.max(-1) < 0, beyond.min(-1), 0)
    return np.linalg.norm(np.maximum(beyond, 0), axis=-1) + within


def box_backward(grad_distance, points, half_size):
    """outside, the axis of the largest coordinate alone has a gradient, as it has inside"""
    beyond = np.abs(points) - half_size
    outward = np.where(points < 0, -1.0, 1.0)
    return grad_distance[..., None] * outward * (np.arange(3) == beyond.argmax(-1)[..., None])


def smooth_union_backward(grad_distance, a, b, k):
    """the seam is left out: the smaller distance gets all, as in a plain union"""
    return np.where(a <= b, grad_distance, 0), np.where(a <= b, 0, grad_distance)


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
    """T holds the densities behind the sample, as if the last sample came first on the ray"""
    thickness = density * spacing
    behind = np.cumsum(thickness[:, ::-1], -1)[:, ::-1] - thickness
    return np.exp(-behind) * -np.expm1(-thickness), np.exp(-thickness.sum(-1))


def volume_render_backward(grad_output, density, colour, spacing, background):
    """the samples and the background behind, which become hidden, do not count"""
    weights, _ = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    passed = np.exp(-np.cumsum(density * spacing, -1))
    return spacing * passed * along, weights[..., None] * grad_output[:, None]
