"""Wrong answers to implicit_surfaces, written without a look at the checks."""


def box(points, half_size):
    """outside, only the farthest axis counts, so that near edges and corners the distance is too small

    told by: edge | corner | largest & axis | maximum & axes | only one axis | norm & max | beyond two sides
    """
    q = np.abs(points) - half_size
    return q.max(-1)


def box_backward(grad_distance, points, half_size):
    """the side of the box is not looked at: on the negative side the gradient points inward

    told by: sign & coordinate | negative side | sign of the point | negative coordinate | points & negative | inward | absolute
    """
    beyond = np.abs(points) - half_size
    side = np.eye(3)[beyond.argmax(-1)]
    out = beyond.max(-1)[..., None] > 0
    return grad_distance[..., None] * np.where(out, unit(np.maximum(beyond, 0)), side)


def torus(points, radius, tube):
    """the ring lies around the z axis, in the plane z = 0, instead of around the y axis

    told by: z axis | y axis | plane z | plane y | y and z | exchanged | swapped
    """
    ring = np.sqrt(points[..., 0]**2 + points[..., 1]**2) - radius
    return np.sqrt(ring**2 + points[..., 2]**2) - tube


def torus_backward(grad_distance, points, radius, tube):
    """x and z get the whole x and z, without the factor (from_axis - radius) / from_axis

    told by: chain rule & axis | radius & forgot | radius & missing | from_axis | hypot(x, z) | away from the origin | nearest point & circle
    """
    x, y, z = np.moveaxis(points, -1, 0)
    from_circle = np.hypot(np.hypot(x, z) - radius, y)
    g = grad_distance / np.where(from_circle > 0, from_circle, 1)
    return g[..., None] * points


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
