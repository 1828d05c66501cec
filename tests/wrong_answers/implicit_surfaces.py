"""Wrong answers to implicit_surfaces, written without a look at the checks."""


def box(points, half_size):
    """outside, only the farthest axis counts, so that near edges and corners the distance is too small

    told by: edge | corner | largest & axis | maximum & axes | only one axis | norm & max | beyond two sides
    """
    q = np.abs(points) - half_size
    return q.max(-1)


def box_backward(grad_distance, points, half_size):
    """inside, the side is chosen by the largest coordinate, not by the one nearest to its half size

    told by: largest coordinate | largest & abs | half_size & inside
    """
    extent = np.abs(points)
    q = extent - half_size
    facing = np.where(points < 0, -1.0, 1.0)
    out = (q > 0).any(-1, keepdims=True)
    one_axis = np.eye(3)[extent.argmax(-1)]
    return grad_distance[..., None] * facing * np.where(out, unit(np.maximum(q, 0)), one_axis)


def torus(points, radius, tube):
    """the ring lies in the plane z = 0, around the z axis, not around the y axis

    told by: z axis | y axis | y = 0 | z = 0 | plane of the ring | y and z & exchanged | y and z & swapped
    """
    x, y, z = points[..., 0], points[..., 1], points[..., 2]
    ring = np.sqrt(x**2 + y**2) - radius
    return np.sqrt(ring**2 + z**2) - tube


def torus_backward(grad_distance, points, radius, tube):
    """x and z get the whole x and z, without the factor (from_axis - radius) / from_axis

    told by: chain rule & axis | radius & forgot | radius & missing | from_axis | hypot(x, z) | away from the origin | nearest point & circle
    """
    x, y, z = np.moveaxis(points, -1, 0)
    from_circle = np.hypot(np.hypot(x, z) - radius, y)
    g = grad_distance / np.where(from_circle > 0, from_circle, 1)
    return g[..., None] * points


def smooth_union(a, b, k):
    """h is not cut off at 0, so that it grows again where |a - b| > k

    told by: max(h | clip | clamp | negative h | cut off | becomes negative | below 0 | not kept at 0
    """
    h = 1 - np.abs(a - b) / k
    return np.minimum(a, b) - 0.25 * k * h * h


def smooth_union(a, b, k):
    """h is k - |a - b|, not divided by k

    told by: divided by k | divide by k | division & by k | k - abs | 1 - abs | units of | k too often
    """
    near = np.maximum(k - np.abs(a - b), 0)
    smaller = np.where(a < b, a, b)
    return smaller - k * near**2 / 4


def smooth_union(a, b, k):
    """the absolute value of a - b is forgotten, so that a and b are not treated alike

    told by: abs | symmetric | a and b & exchang | a and b & swap | sign of a - b | a and b & alike | order of a and b
    """
    h = np.maximum(1 - (a - b) / k, 0)
    return np.minimum(a, b) - k * h**2 / 4


def smooth_union_backward(grad_distance, a, b, k):
    """the 2 of the slope of h^2 is lost: the larger one gets h / 4, not h / 2

    told by: h / 4 | h/4 | h / 2 | h/2 | h^2 & slope | square & slope | factor 2
    """
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    given = h / 4
    to_a = np.where(a < b, 1 - given, given)
    return grad_distance * to_a, grad_distance * (1 - to_a)


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    """the step is s times lipschitz, not s divided by it

    told by: lipschitz & divid | lipschitz & multipl | lipschitz & times | s / L | s / lipschitz | s * lipschitz | steps & too long
    """
    n = len(origins)
    t, count, hit = np.zeros(n), np.zeros(n, int), np.zeros(n, bool)
    for r in range(n):
        while count[r] < most and t[r] <= far:
            s = signed_distance(origins[r] + t[r] * directions[r], shape)
            count[r] += 1
            if s < epsilon:
                hit[r] = True
                break
            t[r] += s * lipschitz
    t[~hit] = np.inf
    return t, count


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    """each round counts an evaluation for all rays, also for those that have hit or missed before

    told by: evaluations & finished | evaluations & done | evaluations & all rays | count & already | evaluations & still | evaluations & after | evaluations & active | done are counted on
    """
    t = np.zeros(len(origins))
    evaluations = np.zeros(len(origins), int)
    hit = np.zeros(len(origins), bool)
    lost = np.zeros(len(origins), bool)
    for _ in range(most):
        if (hit | lost).all():
            break
        s = signed_distance(origins + t[:, None] * directions, shape)
        evaluations += 1
        going = ~(hit | lost)
        hit |= going & (s < epsilon)
        going &= s >= epsilon
        t = np.where(going, t + s / lipschitz, t)
        lost |= going & (t > far)
    return np.where(hit, t, np.inf), evaluations


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    """far is compared with the distance s of one step, not with t, the way from the start

    told by: t > far | t <= far | beyond far | past far | farther than far | far & ignor | far & compare
    """
    t = np.zeros(len(origins))
    evaluations = np.zeros(len(origins), int)
    hit = np.zeros(len(origins), bool)
    active = np.arange(len(origins))
    for _ in range(most):
        s = signed_distance(origins[active] + t[active, None] * directions[active], shape)
        evaluations[active] += 1
        hit[active[s < epsilon]] = True
        going = (s >= epsilon) & (s <= far)
        active = active[going]
        t[active] += s[going] / lipschitz
    return np.where(hit, t, np.inf), evaluations


def ray_weights(density, spacing):
    """the opacity of a sample is density times spacing, not 1 - exp(-density spacing)

    told by: 1 - exp | opacity | alpha | exponential | linear | expm1 | above 1
    """
    thickness = density * spacing
    reach = np.exp(-np.cumsum(thickness, axis=1))
    before = np.column_stack([np.ones(len(reach)), reach[:, :-1]])
    return before * thickness, reach[:, -1]


def ray_weights(density, spacing):
    """the exponent of T sums the densities alone, without the spacing

    told by: spacing & transmi | spacing & forgot | spacing & missing | spacing & left out | without & spacing | spacing & exponent | delta_j
    """
    rays, n = density.shape
    weights = np.empty((rays, n))
    light = np.ones(rays)
    for i in range(n):
        weights[:, i] = light * (1 - np.exp(-density[:, i] * spacing[:, i]))
        light = light * np.exp(-density[:, i])
    return weights, light


def ray_weights(density, spacing):
    """the light that remains at the end is taken in front of the last sample, not behind it

    told by: T_end & last | remain & last | behind the last | last sample | passes them all | T_end & all samples | remain & all samples
    """
    thickness = density * spacing
    total = np.cumsum(thickness, -1)
    shifted = np.concatenate([np.zeros_like(total[:, :1]), total[:, :-1]], -1)
    before = np.exp(-shifted)
    return before * (1 - np.exp(-thickness)), before[:, -1]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """a sample's own slope has T in front of it, T_i, not behind it, T_(i+1)

    told by: T_(i+1) | behind the sample | own slope | T in front | sample itself | inclusive | own opacity
    """
    weights, remaining = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    seen = np.concatenate([weights * along, (remaining * (grad_output @ background))[:, None]], -1)
    behind = np.cumsum(seen[:, :0:-1], -1)[:, ::-1]
    thickness = density * spacing
    reaching = np.exp(-(np.cumsum(thickness, -1) - thickness))
    return spacing * (reaching * along - behind), weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """grad_density is with respect to density times spacing: the factor spacing is missing

    told by: spacing & factor | spacing & forgot | spacing & missing | times spacing | dtau | chain rule & spacing | spacing & grad_density
    """
    weights, remaining = ray_weights(density, spacing)
    rays, n = density.shape
    grad_tau = np.zeros((rays, n))
    passed = np.exp(-np.cumsum(density * spacing, axis=1))
    hidden = remaining * (grad_output @ background)
    for i in reversed(range(n)):
        own = (colour[:, i] * grad_output).sum(1)
        grad_tau[:, i] = passed[:, i] * own - hidden
        hidden = hidden + weights[:, i] * own
    return grad_tau, weights[:, :, None] * grad_output[:, None, :]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """what is subtracted is the light of the samples in front, not of what lies behind

    told by: behind & front | what lies behind | what is behind | behind it | samples behind | reverse & sum | wrong end
    """
    weights, _ = ray_weights(density, spacing)
    along = (colour * grad_output[:, None]).sum(-1)
    light = weights * along
    front = np.cumsum(light, -1) - light
    passed = np.exp(-np.cumsum(density * spacing, -1))
    return spacing * (passed * along - front), weights[..., None] * grad_output[:, None]


def smooth_union(a, b, k):
    """the factor k is left out of k h^2 / 4

    told by: factor & k | k h | times k | without k | k is left out | missing & k | multipl & k
    """
    h = np.clip(1 - np.abs(a - b) / k, 0, None)
    return np.minimum(a, b) - h * h / 4


def smooth_union(a, b, k):
    """h is not kept at 0 or more: far from the seam its square grows again

    told by: max( | maximum | clip | negative | below 0 | far from the seam | at least 0
    """
    h = 1 - np.abs(a - b) / k
    return np.where(a < b, a, b) - k * h**2 / 4


def smooth_union(a, b, k):
    """k h^2 / 4 is added instead of subtracted, so that the seam is cut out, not filled

    told by: sign | added | plus | subtract | minus | not filled
    """
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return np.minimum(a, b) + k * h**2 / 4


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    """rays that have hit or missed are counted on: every ray gets the number of rounds

    told by: finished | evaluations & same | all rays | rays & done | number of rounds | already | stop & count
    """
    t = np.zeros(len(origins))
    hit, missed = np.zeros(len(origins), bool), np.zeros(len(origins), bool)
    rounds = 0
    while rounds < most and not (hit | missed).all():
        s = signed_distance(origins + t[:, None] * directions, shape)
        rounds += 1
        going = ~(hit | missed)
        hit |= going & (s < epsilon)
        going &= ~hit
        t[going] += s[going] / lipschitz
        missed |= going & (t > far)
    return np.where(hit, t, np.inf), np.full(len(origins), rounds)


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    """the step is the whole distance, not divided by the Lipschitz number

    told by: lipschitz | s / l | divided by l | step & too long | too far & step | overshoot
    """
    t, count = np.full(len(origins), np.inf), np.zeros(len(origins), int)
    for ray, (o, d) in enumerate(zip(origins, directions)):
        at = 0.0
        while count[ray] < most and at <= far:
            s = signed_distance(o + at * d, shape)
            count[ray] += 1
            if s < epsilon:
                t[ray] = at
                break
            at += s
    return t, count


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    """a ray that misses gets the t at which it stopped instead of np.inf

    told by: np.inf | miss & stopped | misses | no hit | not hit
    """
    t, evaluations = np.zeros(len(origins)), np.zeros(len(origins), int)
    active = np.arange(len(origins))
    for _ in range(most):
        s = signed_distance(origins[active] + t[active, None] * directions[active], shape)
        evaluations[active] += 1
        on = s >= epsilon
        active = active[on]
        t[active] += s[on] / lipschitz
        active = active[t[active] <= far]
    return t, evaluations


def ray_weights(density, spacing):
    """T_i includes the sample itself, the sum should end before i

    told by: itself | j < i | own density | one too far | inclusive | shifted by one | up to and
    """
    thickness = density * spacing
    T = np.exp(-np.cumsum(thickness, axis=1))
    return T * (1 - np.exp(-thickness)), T[:, -1]


def ray_weights(density, spacing):
    """T_end lacks the last sample: it is the light that arrives at the last one, not what passes all

    told by: last sample | t_end | remaining & last | all samples | passes them all | behind the last
    """
    rays, n = density.shape
    weights, T = np.zeros((rays, n)), np.ones(rays)
    for i in range(n):
        arrives = T
        tau = density[:, i] * spacing[:, i]
        weights[:, i] = arrives * (1 - np.exp(-tau))
        T = arrives * np.exp(-tau)
    return weights, arrives


def ray_weights(density, spacing):
    """the sum runs over the rays instead of along each ray

    told by: axis | over the rays | other rays | along & ray | different rays | across
    """
    tau = density * spacing
    through = np.exp(-np.cumsum(tau, 0))
    front = np.vstack([np.ones((1, tau.shape[1])), through[:-1]])
    return front * -np.expm1(-tau), np.exp(-tau.sum(1))


def volume_render_backward(grad_output, density, colour, spacing, background):
    """the background is left out of what lies behind a sample

    told by: background | t_end | passes all samples | passes them all
    """
    weights, _ = ray_weights(density, spacing)
    along = (colour * grad_output[:, None]).sum(-1)
    seen = weights * along
    behind = np.cumsum(seen[:, ::-1], 1)[:, ::-1] - seen
    passed = np.exp(-np.cumsum(density * spacing, 1))
    return spacing * (passed * along - behind), weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """grad_density lacks the factor spacing: this is the gradient of tau

    told by: spacing | tau | delta | chain rule | length of
    """
    weights, rest = ray_weights(density, spacing)
    rays, n = density.shape
    grad = np.zeros((rays, n))
    for r in range(rays):
        behind = rest[r] * (grad_output[r] @ background)
        for i in range(n - 1, -1, -1):
            value = colour[r, i] @ grad_output[r]
            passed = np.exp(-(density[r, :i + 1] * spacing[r, :i + 1]).sum())
            grad[r, i] = passed * value - behind
            behind += weights[r, i] * value
    return grad, weights[..., None] * grad_output[:, None]


def volume_render_backward(grad_output, density, colour, spacing, background):
    """a sample's own weight changes by T_i, the light before it, instead of by T_(i+1) behind it

    told by: t_(i+1) | own weight | before & sample | behind the sample | arrives | passed
    """
    weights, rest = ray_weights(density, spacing)
    thickness = density * spacing
    before = np.exp(thickness - np.cumsum(thickness, 1))
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    everything = np.column_stack([weights * along, rest * (grad_output @ background)])
    behind = np.cumsum(everything[:, ::-1], 1)[:, ::-1][:, 1:]
    return spacing * (before * along - behind), weights[..., None] * grad_output[:, None]


def box(points, half_size):
    """inside the distance is 0: the negative part is left out

    told by: inside & 0 | inside & negative | inside the box | below 0 | nearest side
    """
    return np.sqrt((np.maximum(np.abs(points) - half_size, 0)**2).sum(-1))


def torus(points, radius, tube):
    """the ring lies around the z axis, in the plane z = 0, instead of around the y axis

    told by: z axis | y axis | plane z | plane y | y and z | exchanged | swapped
    """
    ring = np.sqrt(points[..., 0]**2 + points[..., 1]**2) - radius
    return np.sqrt(ring**2 + points[..., 2]**2) - tube


def smooth_union_backward(grad_distance, a, b, k):
    """the shares of a and b are exchanged: the larger distance gets the larger share

    told by: exchang | swap | mixed up | larger distance | smaller & gets | nearer
    """
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    to_a = np.where(a > b, 1 - h / 2, h / 2)
    return to_a * grad_distance, (1 - to_a) * grad_distance


def box_backward(grad_distance, points, half_size):
    """the side of the box is not looked at: on the negative side the gradient points inward

    told by: sign & coordinate | negative side | sign of the point | negative coordinate | points & negative | inward | absolute
    """
    beyond = np.abs(points) - half_size
    side = np.eye(3)[beyond.argmax(-1)]
    out = beyond.max(-1)[..., None] > 0
    return grad_distance[..., None] * np.where(out, unit(np.maximum(beyond, 0)), side)
