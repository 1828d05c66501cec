"""Lab 10's maps as printed: what one types who has read the questions and the equations."""


def face_inverse(screen):
    x, y = screen[..., 0], screen[..., 1]
    return np.linalg.inv(np.stack([x, y, np.ones(x.shape)], -2))


def screen_weights_and_depth(inverse, z, x, y):
    c = np.einsum("...ij,...j->...i", inverse, np.stack([x, y, np.ones(x.shape)], -1))
    u = np.clip(c, 0, 1)
    w = u / u.sum(-1, keepdims=True)
    return w, 1 / (w / z).sum(-1)


def screen_weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    w, depth = screen_weights_and_depth(inverse, z, x, y)
    p = np.stack([x, y, np.ones(x.shape)], -1)
    c = np.einsum("...ij,...j->...i", inverse, p)
    grad_q = -grad_depth[..., None] * depth[..., None]**2
    grad_w = grad_weight + grad_q / z
    s = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_u = (grad_w - (grad_w * w).sum(-1, keepdims=True)) / s
    grad_c = grad_u * ((c > 0) & (c < 1))
    return grad_c[..., :, None] * p[..., None, :], -grad_q * w / z**2
