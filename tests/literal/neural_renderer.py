"""Lab 10's maps as printed: what one types who has read the questions and the equations."""


def face_inverse(screen):
    x, y = screen[..., 0], screen[..., 1]
    return np.linalg.inv(np.stack([x, y, np.ones(x.shape)], -2))


def screen_weights_and_depth(inverse, z, x, y):
    c = np.einsum("...ij,...j->...i", inverse, np.stack([x, y, np.ones(x.shape)], -1))
    u = np.clip(c, 0, 1)
    w = u / u.sum(-1, keepdims=True)
    return w, 1 / (w / z).sum(-1)
