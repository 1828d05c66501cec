"""Wrong answers to implicit_surfaces, written without a look at the checks."""


def box(points, half_size):
    """inside the box the distance is 0: only the outside part is there

    told by: inside | negative | is 0 within | outside part
    """
    return np.linalg.norm(np.maximum(np.abs(points) - half_size, 0), axis=-1)


def box(points, half_size):
    """outside, only the largest coordinate counts (Chebyshev distance), as if no edge or corner were nearest

    told by: edge | corner | largest | chebyshev | max norm | euclid
    """
    return np.max(np.abs(points) - half_size, axis=-1)


def box(points, half_size):
    """inside, the farthest side is taken, the smallest of the three, not the nearest one

    told by: farthest | nearest side | smallest | minimum of the three | most distant
    """
    d = np.abs(points) - half_size
    return np.linalg.norm(np.maximum(d, 0), axis=-1) + np.where(d.max(-1) < 0, d.min(-1), 0)


def box_backward(grad_distance, points, half_size):
    """outside, the direction is not divided by its length

    told by: unit & length | length 1 | normalis | normaliz | divided & length | divi & norm
    """
    d = np.abs(points) - half_size
    s = np.where(points < 0, -1.0, 1.0)
    grad = np.zeros(points.shape)
    for i in np.ndindex(points.shape[:-1]):
        if d[i].max() > 0:
            grad[i] = np.maximum(d[i], 0)
        else:
            grad[i][d[i].argmax()] = 1
    return grad_distance[..., None] * s * grad


def torus(points, radius, tube):
    """squares are compared: the root of u^2 + y^2 is missing, and tube is squared instead

    told by: root | square | sqrt
    """
    u = np.sqrt(points[..., 0]**2 + points[..., 2]**2) - radius
    return u**2 + points[..., 1]**2 - tube**2


def torus_backward(grad_distance, points, radius, tube):
    """tube is subtracted from the length by which it is divided: the distance to the surface, not to the circle

    told by: tube | divi & distance | surface & circle | not & unit | length 1
    """
    x, y, z = np.moveaxis(points, -1, 0)
    r = np.hypot(x, z)
    u = r - radius
    d = np.hypot(u, y) - tube
    g = grad_distance / np.where(d != 0, d, 1)
    ga = g * u / np.where(r > 0, r, 1)
    inside = (np.hypot(u, y) > 0)
    return np.stack([ga * x, g * y, ga * z], -1) * inside[..., None]


def torus_backward(grad_distance, points, radius, tube):
    """the inner chain rule is forgotten: x and z are not divided by the distance from the axis

    told by: chain rule | from the axis | from_axis | inner | x / hypot | hypot(x, z)
    """
    x, y, z = np.moveaxis(points, -1, 0)
    u = np.hypot(x, z) - radius
    d = np.hypot(u, y)
    g = grad_distance / np.where(d > 0, d, 1)
    return np.stack([g * u * x, g * y, g * u * z], -1)


def smooth_union(a, b, k):
    """h is not squared

    told by: h is squared | h is not squared | h^2 | h**2 | square | power | quadratic
    """
    h = np.maximum(k - np.abs(a - b), 0) / k
    return np.minimum(a, b) - h * k / 4


def smooth_union(a, b, k):
    """the seam is subtracted from the maximum: that is an intersection, not a union

    told by: maximum | intersection | larger | minimum | max | min(
    """
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return np.maximum(a, b) - k * h**2 / 4


def smooth_union(a, b, k):
    """the seam's term is added and not subtracted: it digs a groove

    told by: added | plus | sign | groove | subtract
    """
    out = np.empty(np.shape(a))
    for i in np.ndindex(out.shape):
        h = max(1 - abs(a[i] - b[i]) / k, 0)
        out[i] = min(a[i], b[i]) + k * h**2 / 4
    return out


def smooth_union(a, b, k):
    """the factor k before h^2 / 4 is missing

    told by: factor k | k is missing | k h^2 | times k | k is forgotten | multiplied by k | without k
    """
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return np.minimum(a, b) - h**2 / 4


def smooth_union(a, b, k):
    """the cubic smooth minimum is used, h^3 / 6, not the quadratic one of eq. (3)

    told by: cubic | h^3 | h**3 | third power | / 6 | 1/6
    """
    h = np.maximum(k - np.abs(a - b), 0) / k
    return np.minimum(a, b) - h**3 * k / 6


def smooth_union_backward(grad_distance, a, b, k):
    """the seam's term is left out: the smaller distance gets all, as in a plain union

    told by: plain union | smaller gets all | seam | all & smaller | minimum | h is & missing | sharp
    """
    return np.where(a <= b, grad_distance, 0), np.where(a <= b, 0, grad_distance)


def smooth_union_backward(grad_distance, a, b, k):
    """the shares of a and b are exchanged: the larger distance gets the larger share

    told by: exchanged | swapped | larger | other way | mixed up
    """
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    grad_a, grad_b = np.zeros(a.shape), np.zeros(b.shape)
    for i in np.ndindex(a.shape):
        s = h[i] / 2 if a[i] < b[i] else 1 - h[i] / 2
        grad_a[i] = grad_distance[i] * s
        grad_b[i] = grad_distance[i] * (1 - s)
    return grad_a, grad_b


def sphere_trace(origins, directions, shape, far,
                 lipschitz=1.0, epsilon=1e-5, most=200):
    """the steps are not divided by the Lipschitz constant

    told by: lipschitz | constant l | s / l | step & too long | divided by l | overshoot
    """
    t, count = np.zeros(len(origins)), np.zeros(len(origins), int)
    hit = np.zeros(len(origins), bool)
    on = np.arange(len(origins))
    for _ in range(most):
        s = signed_distance(origins[on] + t[on][:, None] * directions[on], shape)
        count[on] += 1
        hit[on[s < epsilon]] = True
        on, s = on[s >= epsilon], s[s >= epsilon]
        t[on] += s
        on = on[t[on] <= far]
    return np.where(hit, t, np.inf), count


def sphere_trace(origins, directions, shape, far,
                 lipschitz=1.0, epsilon=1e-5, most=200):
    """all rays are counted for as long as any of them is on its way: those that hit or missed are evaluated again

    told by: count & finished | count & every | count & all rays | evaluat & hit | evaluat & after | still active | as long as any
    """
    n = len(origins)
    t, count = np.zeros(n), np.zeros(n, int)
    hit, miss = np.zeros(n, bool), np.zeros(n, bool)
    for _ in range(most):
        if (hit | miss).all():
            break
        s = signed_distance(origins + t[:, None] * directions, shape)
        count += 1
        hit |= (s < epsilon) & ~miss
        t = np.where(hit | miss, t, t + s / lipschitz)
        miss |= t > far
    return np.where(hit, t, np.inf), count


def ray_weights(density, spacing):
    """the transmittance includes the sample itself: the sum runs to j <= i, not to j < i

    told by: j <= i | j < i | itself | its own | inclusive | exclusive | off by one | one too many | behind & sample
    """
    tau = density * spacing
    T = np.exp(-np.cumsum(tau, axis=1))
    return T * (1 - np.exp(-tau)), T[:, -1]


def ray_weights(density, spacing):
    """the light that remains is that before the last sample: the last one's own absorption is missing

    told by: last sample | t_end | remaining & last | remaining & before | last & absor
    """
    tau = density * spacing
    T = np.exp(-np.concatenate([np.zeros((len(tau), 1)), np.cumsum(tau[:, :-1], axis=1)], axis=1))
    return T * -np.expm1(-tau), T[:, -1]


def ray_weights(density, spacing):
    """the opacity is taken for density * spacing, the first order of 1 - exp(-density * spacing)

    told by: first order | linear | 1 - exp | exp & missing | approximat | opacity
    """
    alpha = np.clip(density * spacing, 0, 1)
    weights = np.zeros(density.shape)
    passed = np.ones(len(density))
    for i in range(density.shape[1]):
        weights[:, i] = passed * alpha[:, i]
        passed = passed * (1 - alpha[:, i])
    return weights, passed


def ray_weights(density, spacing):
    """the transmittance is summed from the wrong end: the last sample is taken to be the first

    told by: wrong end | behind | reverse | from the back | backwards | far end | other end | last sample first
    """
    tau = density * spacing
    after = np.cumsum(tau[:, ::-1], axis=1)[:, ::-1]
    T = np.exp(-np.concatenate([after[:, 1:], np.zeros_like(after[:, :1])], axis=1))
    return T * -np.expm1(-tau), np.exp(-tau.sum(1))


def ray_weights(density, spacing):
    """the weights are normalised so that each ray's sum is 1

    told by: normalis | normaliz | sum is 1 | sum to 1 | add up to 1 | divided by & sum
    """
    tau = density * spacing
    T = np.exp(-np.cumsum(tau, -1))
    before = np.concatenate([np.ones_like(T[:, :1]), T[:, :-1]], -1)
    w = before * -np.expm1(-tau)
    return w / w.sum(-1, keepdims=True), T[:, -1]


def ray_weights(density, spacing):
    """the spacing is left out: the densities are used as they are

    told by: spacing | delta | length of the sample | sample's length
    """
    T = np.exp(-np.cumsum(density, -1))
    before = np.concatenate([np.ones_like(T[:, :1]), T[:, :-1]], -1)
    return before * -np.expm1(-density), T[:, -1]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """the background behind the samples is forgotten: a denser sample hides it, too

    told by: background | t_end | what is behind all
    """
    weights, remaining = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    seen = weights * along
    behind = np.cumsum(seen[:, ::-1], -1)[:, ::-1] - seen
    T = np.exp(-np.cumsum(density * spacing, -1))
    return spacing * (T * along - behind), weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """only the sample's own colour counts: what lies behind and is hidden by it is left out

    told by: behind | hide | hidden | occlu | own colour | shadow | later samples
    """
    weights, remaining = ray_weights(density, spacing)
    along = (colour * grad_output[:, None]).sum(-1)
    T = np.exp(-np.cumsum(density * spacing, -1))
    return spacing * T * along, weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """the chain rule's factor spacing is missing: it is the gradient with respect to tau

    told by: spacing | tau | delta
    """
    weights, remaining = ray_weights(density, spacing)
    n = density.shape[1]
    T = np.exp(-np.cumsum(density * spacing, -1))
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    behind = remaining * (grad_output @ background)
    grad_density = np.zeros_like(density)
    for i in reversed(range(n)):
        grad_density[:, i] = T[:, i] * along[:, i] - behind
        behind = behind + weights[:, i] * along[:, i]
    return grad_density, weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """fine print: it divides by 1 - alpha, which is 0 in a wall

    told by: divides by | divided by 0 | divi & wall | nan | 1 - alpha | opaque
    """
    weights, remaining = ray_weights(density, spacing)
    alpha = 1 - np.exp(-density * spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    seen = np.concatenate([weights * along, (remaining * (grad_output @ background))[:, None]], -1)
    behind = np.cumsum(seen[:, :0:-1], -1)[:, ::-1]
    before = np.concatenate([np.ones((len(alpha), 1)), np.cumprod(1 - alpha, 1)[:, :-1]], 1)
    grad_alpha = before * along - behind / (1 - alpha)
    return grad_alpha * (1 - alpha) * spacing, weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """what is behind counts the sample itself too: the sum begins at i, not at i + 1

    told by: itself | i + 1 | its own | inclusive | one too many | begins | off by one
    """
    weights, remaining = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    behind = np.cumsum((weights * along)[:, ::-1], -1)[:, ::-1] + (remaining * (grad_output @ background))[:, None]
    T = np.exp(-np.cumsum(density * spacing, -1))
    return spacing * (T * along - behind), weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """the gradient of the colours is grad_output for every sample: the weights are missing

    told by: weight | w_i | grad_colour & missing
    """
    weights, remaining = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    seen = np.concatenate([weights * along, (remaining * (grad_output @ background))[:, None]], -1)
    behind = np.cumsum(seen[:, :0:-1], -1)[:, ::-1]
    T = np.exp(-np.cumsum(density * spacing, -1))
    grad_colour = np.repeat(grad_output[:, None], density.shape[1], 1)
    return spacing * (T * along - behind), grad_colour


def sphere_trace(origins, directions, shape, far,
                 lipschitz=1.0, epsilon=1e-5, most=200):
    """the input is changed in place: the origins themselves walk along the rays

    told by: in place | input & change | origins & change | overwrit | caller | copy | move & origins
    """
    n = len(origins)
    t, evaluations = np.zeros(n), np.zeros(n, int)
    out = np.full(n, np.inf)
    active = np.arange(n)
    for _ in range(most):
        s = signed_distance(origins[active], shape)
        evaluations[active] += 1
        out[active[s < epsilon]] = t[active[s < epsilon]]
        active, s = active[s >= epsilon], s[s >= epsilon]
        t[active] += s / lipschitz
        origins[active] += (s / lipschitz)[:, None] * directions[active]
        active = active[t[active] <= far]
    return out, evaluations


def sphere_trace(origins, directions, shape, far,
                 lipschitz=1.0, epsilon=1e-5, most=200):
    """the last evaluation, the one that finds the hit, is not counted

    told by: last evaluation | off by one | one too few | not counted | final evaluation | evaluation & hit
    """
    n = len(origins)
    t, steps = np.zeros(n), np.zeros(n, int)
    hit = np.zeros(n, bool)
    active = np.arange(n)
    for _ in range(most):
        s = signed_distance(origins[active] + t[active, None] * directions[active], shape)
        hit[active[s < epsilon]] = True
        active, s = active[s >= epsilon], s[s >= epsilon]
        steps[active] += 1
        t[active] += s / lipschitz
        active = active[t[active] <= far]
    return np.where(hit, t, np.inf), steps


def ray_weights(density, spacing):
    """only the weights are returned: T_end is missing

    told by: t_end | only the weights | second output | two outputs | two results | one output | returns & weights | tuple
    """
    tau = density * spacing
    T = np.exp(-np.cumsum(tau, -1))
    before = np.concatenate([np.ones_like(T[:, :1]), T[:, :-1]], -1)
    return before * -np.expm1(-tau)


def ray_weights(density, spacing):
    """the sum runs over the rays and not along them: cumsum has the wrong axis

    told by: axis | over the rays | along the ray | across | other rays | rows & columns
    """
    tau = density * spacing
    before = np.zeros_like(tau)
    for r in range(1, len(tau)):
        before[r] = before[r - 1] + tau[r - 1]
    return np.exp(-before) * -np.expm1(-tau), np.exp(-tau.sum(1))
