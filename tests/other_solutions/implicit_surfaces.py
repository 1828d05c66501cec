"""Lab 15 once more: nearest points, and volumes ray by ray."""
import math

import numpy as np

from reference.implicit_surfaces import signed_distance


def box(points, half_size):
    # Outside, the way to the nearest point; inside, the shortest of six ways out.
    nearest = np.clip(points, -half_size, half_size)
    ways = np.concatenate([half_size - points, half_size + points], -1)
    outside = np.sqrt(((points - nearest)**2).sum(-1))
    return np.where(ways.min(-1) < 0, outside, -ways.min(-1))


def box_backward(grad_distance, points, half_size):
    grad_points = np.zeros(np.shape(points))
    for at in np.ndindex(np.shape(grad_distance)):
        p = points[at]
        away = p - np.clip(p, -half_size, half_size)
        if away.any():
            direction = away / math.hypot(*away)
        else:
            axis = int(np.argmin(half_size - np.abs(p)))
            direction = np.zeros(3)
            direction[axis] = 1 if p[axis] >= 0 else -1
        grad_points[at] = grad_distance[at] * direction
    return grad_points


def ring(points, radius):
    """From the nearest point of the circle to each point: along the radius, and along y."""
    along = np.linalg.norm(points[..., [0, 2]], axis=-1)
    return along, along - radius, points[..., 1]


def torus(points, radius, tube):
    _, out, up = ring(points, radius)
    return np.sqrt(out**2 + up**2) - tube


def torus_backward(grad_distance, points, radius, tube):
    grad_points = np.zeros(np.shape(points))
    along, out, up = ring(points, radius)
    for at in np.ndindex(np.shape(grad_distance)):
        length = math.hypot(out[at], up[at])
        if length:
            x, _, z = points[at] / along[at] if along[at] else np.zeros(3)
            grad_points[at] = np.array([x * out[at], up[at], z * out[at]]) / length
            grad_points[at] *= grad_distance[at]
    return grad_points


def share_of_first(a, b, k):
    return np.clip(0.5 + (np.asarray(b) - a) / (2 * k), 0, 1)


def smooth_union(a, b, k):
    # A blend of the two, and less than that in between.
    h = share_of_first(a, b, k)
    return h * a + (1 - h) * b - k * h * (1 - h)


def smooth_union_backward(grad_distance, a, b, k):
    h = share_of_first(a, b, k)
    return grad_distance * h, grad_distance * (1 - h)


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    reached, counts = [], []
    for origin, direction in zip(origins, directions, strict=True):
        t, hit, count = 0.0, False, 0
        while count < most and t <= far and not hit:
            s = float(signed_distance((origin + t * direction)[None], shape)[0])
            count, hit = count + 1, s < epsilon
            t += 0 if hit else s / lipschitz
        reached.append(t if hit else math.inf)
        counts.append(count)
    return np.array(reached, float), np.array(counts, int)


def ray_weights(density, spacing):
    through = np.exp(-np.cumsum(density * spacing, axis=1))
    before = np.hstack([np.ones((len(density), 1)), through[:, :-1]])
    return -np.expm1(-density * spacing) * before, np.exp(-(density * spacing).sum(1))


def volume_render_backward(grad_output, density, colour, spacing, background):
    grad_density, grad_colour = np.zeros(np.shape(density)), np.zeros(np.shape(colour))
    rays, samples = np.shape(density)
    for r in range(rays):
        kept = [math.exp(-sigma * delta) for sigma, delta in zip(density[r], spacing[r],
                                                                 strict=True)]
        before = np.cumprod([1.0, *kept])
        behind = np.array(background, float)  # the colour that arrives from there
        for i in reversed(range(samples)):
            gain = before[i] * kept[i] * (colour[r, i] - behind)
            grad_density[r, i] = spacing[r, i] * grad_output[r] @ gain
            grad_colour[r, i] = before[i] * (1 - kept[i]) * grad_output[r]
            behind = kept[i] * behind + (1 - kept[i]) * colour[r, i]
    return grad_density, grad_colour
