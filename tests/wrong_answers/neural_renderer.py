"""Wrong answers to neural_renderer, written without a look at the checks."""


def face_inverse(screen):
    """the edge functions are divided by the area, not by twice the area, so all is twice too large

    told by: area | 2a | twice | factor 2 | factor of 2 | doubled | half
    """
    out = np.zeros(screen.shape[:-1] + (3,))
    area = 0.5 * ((screen[..., 1, 0] - screen[..., 0, 0]) * (screen[..., 2, 1] - screen[..., 0, 1])
                  - (screen[..., 2, 0] - screen[..., 0, 0]) * (screen[..., 1, 1] - screen[..., 0, 1]))
    for k in range(3):
        s, e = screen[..., (k + 1) % 3, :], screen[..., (k + 2) % 3, :]
        out[..., k, 0] = (s[..., 1] - e[..., 1]) / area
        out[..., k, 1] = (e[..., 0] - s[..., 0]) / area
        out[..., k, 2] = (s[..., 0] * e[..., 1] - e[..., 0] * s[..., 1]) / area
    return out


def screen_weights_and_depth(inverse, z, x, y):
    """the weights come back divided by z_k, right in perspective, instead of those on the screen

    told by: weight & perspective | weight & z_k | weight & 1 / z | weight & 1/z | weight & divid & depth | weight & on screen | weight & on the screen
    """
    raw = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    u = np.clip(raw, 0, 1)
    u = u / u.sum(-1, keepdims=True)
    over = u / z
    total = over.sum(-1)
    return over / total[..., None], 1 / total
