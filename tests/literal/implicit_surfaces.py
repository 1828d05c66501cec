"""Lab 15 as printed: what one types who has read the questions and the equations."""


def sphere_trace(origins, directions, shape, far, lipschitz=1.0, epsilon=1e-5, most=200):
    hits, evaluations = np.full(len(origins), np.inf), np.zeros(len(origins), int)
    for r in range(len(origins)):
        t = 0.0
        while t <= far and evaluations[r] < most:
            s = signed_distance(origins[r] + t * directions[r], shape)
            evaluations[r] += 1
            if s < epsilon:
                hits[r] = t
                break
            t += s / lipschitz
    return hits, evaluations


def ray_weights(density, spacing):
    tau = density * spacing
    through = np.cumsum(tau, 1)
    T = np.exp(-(through - tau))
    return T * (1 - np.exp(-tau)), np.exp(-through[:, -1])


def volume_render_backward(grad_output, density, colour, spacing, background):
    weights, remaining = ray_weights(density, spacing)
    after = np.exp(-np.cumsum(density * spacing, 1))
    grad_density = np.zeros(density.shape)
    for i in range(density.shape[1]):
        behind = remaining[:, None] * background
        for j in range(i + 1, density.shape[1]):
            behind = behind + weights[:, j, None] * colour[:, j]
        slope = after[:, i, None] * colour[:, i] - behind
        grad_density[:, i] = spacing[:, i] * (slope * grad_output).sum(1)
    return grad_density, weights[:, :, None] * grad_output[:, None, :]
