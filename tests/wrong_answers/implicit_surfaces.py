"""Wrong answers to implicit_surfaces, written without a look at the checks."""


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
