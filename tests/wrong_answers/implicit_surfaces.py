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


def box(points, half_size):
    """half_size is taken for the whole side: it is halved once more

    told by: whole side | half_size / 2 | half | full size | twice
    """
    d = np.abs(points) - half_size / 2
    return np.linalg.norm(np.maximum(d, 0), axis=-1) + np.minimum(d.max(-1), 0)


def box_backward(grad_distance, points, half_size):
    """the sign of the points is forgotten: on the negative side the gradient points inwards

    told by: sign | negative side | negative coordinate | absolute | abs( | inwards
    """
    beyond = np.abs(points) - half_size
    side = np.arange(3) == beyond.argmax(-1)[..., None]
    out = beyond.max(-1, keepdims=True) > 0
    return grad_distance[..., None] * np.where(out, unit(np.maximum(beyond, 0)), side)


def box_backward(grad_distance, points, half_size):
    """inside there is no gradient: only the outside part was differentiated

    told by: inside | zero within | outside part | interior
    """
    beyond = np.maximum(np.abs(points) - half_size, 0)
    length = np.linalg.norm(beyond, axis=-1, keepdims=True)
    return grad_distance[..., None] * np.sign(points) * beyond / np.where(length > 0, length, 1)


def box_backward(grad_distance, points, half_size):
    """fine print: np.sign is 0 where a coordinate is 0, so the normal there has length 0 instead of the positive side's

    told by: np.sign | sign of 0 | sign(0) | coordinate is 0 | coordinate 0 | positive & opposite | two opposite | middle plane
    """
    beyond = np.abs(points) - half_size
    nearest = np.eye(3)[beyond.argmax(-1)]
    outside = beyond.max(-1)[..., None] > 0
    slope = np.where(outside, unit(np.maximum(beyond, 0)), nearest)
    return grad_distance[..., None] * np.sign(points) * slope


def torus(points, radius, tube):
    """the ring is around the z axis, in the plane z = 0

    told by: z axis | z = 0 | y axis | y = 0 | wrong axis | around the | y and z
    """
    ring = np.hypot(points[..., 0], points[..., 1]) - radius
    return np.hypot(ring, points[..., 2]) - tube


def torus(points, radius, tube):
    """radius and tube are exchanged

    told by: exchanged | swapped | interchanged | tube & place of & radius | mixed up
    """
    ring = np.hypot(points[..., 0], points[..., 2]) - tube
    return np.hypot(ring, points[..., 1]) - radius


def torus_backward(grad_distance, points, radius, tube):
    """fine print: on the y axis and on the circle in the middle of the tube it divides by 0: nan

    told by: nan | divi & by 0 | divides by zero | y axis | middle of the tube
    """
    x, y, z = points[..., 0], points[..., 1], points[..., 2]
    r = np.sqrt(x**2 + z**2)
    u = r - radius
    d = np.sqrt(u**2 + y**2)
    g = np.stack([u / d * x / r, y / d, u / d * z / r], -1)
    return grad_distance[..., None] * g


def smooth_union(a, b, k):
    """h is not clipped at 0: far from the seam the distances are changed too

    told by: clip | negative | max(0 | maximum | far from the seam | below 0 | outside the seam | a - b & larger than k
    """
    h = 1 - np.abs(a - b) / k
    return np.minimum(a, b) - k * h * h / 4


def smooth_union_backward(grad_distance, a, b, k):
    """the larger gets h / 2, but the smaller still gets all: the shares sum to more than grad_distance

    told by: their sum | sum to | more than | smaller & 1 - h | add up | h/2 & smaller
    """
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return (grad_distance * np.where(a < b, 1.0, h / 2),
            grad_distance * np.where(a < b, h / 2, 1.0))


def sphere_trace(origins, directions, shape, far,
                 lipschitz=1.0, epsilon=1e-5, most=200):
    """a ray that is used up after most evaluations counts as a hit where it stands, not as a miss

    told by: `most` | most evaluations | used up | ran out | runs out | limit & evaluations | after & evaluations
    """
    n = len(origins)
    t, evaluations = np.zeros(n), np.zeros(n, int)
    for i in range(n):
        while evaluations[i] < most:
            s = signed_distance(origins[i] + t[i] * directions[i], shape)
            evaluations[i] += 1
            if s < epsilon:
                break
            t[i] += s / lipschitz
            if t[i] > far:
                t[i] = np.inf
                break
    return t, evaluations


def sphere_trace(origins, directions, shape, far,
                 lipschitz=1.0, epsilon=1e-5, most=200):
    """a miss keeps the t where it left, and does not get np.inf

    told by: np.inf | misses & inf | missed & inf | beyond far | a miss
    """
    n = len(origins)
    t = np.zeros(n)
    evaluations = np.zeros(n, dtype=int)
    active = np.ones(n, bool)
    for _ in range(most):
        k = np.flatnonzero(active)
        if len(k) == 0:
            break
        s = signed_distance(origins[k] + t[k, None] * directions[k], shape)
        evaluations[k] += 1
        go_on = s >= epsilon
        t[k[go_on]] += s[go_on] / lipschitz
        active[k] = go_on & (t[k] <= far)
    return t, evaluations


def sphere_trace(origins, directions, shape, far,
                 lipschitz=1.0, epsilon=1e-5, most=200):
    """a hit is where |s| < epsilon: a ray that begins inside is not stopped and walks backwards

    told by: abs( | absolute | inside | negative | backwards | begins within
    """
    n = len(origins)
    t, evaluations = np.zeros(n), np.zeros(n, int)
    hit = np.zeros(n, bool)
    active = np.arange(n)
    for _ in range(most):
        s = signed_distance(origins[active] + t[active, None] * directions[active], shape)
        evaluations[active] += 1
        close = np.abs(s) < epsilon
        hit[active[close]] = True
        active, s = active[~close], s[~close]
        t[active] += s / lipschitz
        active = active[t[active] <= far]
    return np.where(hit, t, np.inf), evaluations


def sphere_trace(origins, directions, shape, far,
                 lipschitz=1.0, epsilon=1e-5, most=200):
    """t is replaced by the last step instead of adding it up

    told by: add & step | adding | sum of the steps | replaced | accumulat | t + s | from the origin
    """
    n = len(origins)
    t, evaluations = np.zeros(n), np.zeros(n, int)
    result = np.full(n, np.inf)
    for i in range(n):
        for _ in range(most):
            s = signed_distance(origins[i] + t[i] * directions[i], shape)
            evaluations[i] += 1
            if s < epsilon:
                result[i] = t[i]
                break
            t[i] = s / lipschitz
            if t[i] > far:
                break
    return result, evaluations


def ray_weights(density, spacing):
    """fine print: the sum before a sample is the whole sum less the last term, which cancels behind a dense wall

    told by: cancel | less & last | minus & term | wall | subtract | difference of | rounding | precision
    """
    tau = density * spacing
    before = np.cumsum(tau, axis=-1) - tau
    weights = np.exp(-before) * (1 - np.exp(-tau))
    return weights, np.exp(-tau.sum(-1))


def volume_render_backward(grad_output, density, colour, spacing, background):
    """the own share is T before the sample times the colour, not T behind it: exp(-tau) is missing

    told by: before & sample | behind & sample | t_i | t_(i+1) | exp(-tau) | exp(- | in front of | off by one | transmittance
    """
    weights, remaining = ray_weights(density, spacing)
    along = np.einsum("rnc,rc->rn", colour, grad_output)
    seen = np.concatenate([weights * along, (remaining * (grad_output @ background))[:, None]], -1)
    behind = np.cumsum(seen[:, :0:-1], -1)[:, ::-1]
    T = np.exp(-np.cumsum(density * spacing, -1))
    before = np.concatenate([np.ones((len(T), 1)), T[:, :-1]], 1)
    return spacing * (before * along - behind), weights[..., None] * grad_output[:, None]


def smooth_union(a, b, k):
    """a is taken for the smaller distance: a - k h^2 / 4 and not min(a, b) - k h^2 / 4

    told by: min(a, b) | smaller | minimum | nearer | always a | only a
    """
    h = np.maximum(1 - np.abs(a - b) / k, 0)
    return a - k * h**2 / 4
