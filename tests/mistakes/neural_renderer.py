"""Mistakes of lab 10; each docstring goes on after "this is what comes out when"."""


def face_inverse(screen):
    """the edge functions are not divided by twice the area, the determinant"""
    x, y = screen[..., 0], screen[..., 1]
    rows = [np.stack([y[..., i] - y[..., j], x[..., j] - x[..., i],
                      x[..., i] * y[..., j] - x[..., j] * y[..., i]], -1) for i, j in EDGES]
    return np.stack(rows, -2) + 0.0


def face_inverse(screen):
    """it is divided by the area; the determinant is twice the area"""
    x, y = screen[..., 0], screen[..., 1]
    rows = [np.stack([y[..., i] - y[..., j], x[..., j] - x[..., i],
                      x[..., i] * y[..., j] - x[..., j] * y[..., i]], -1) for i, j in EDGES]
    double_area = rows[0][..., 2] + rows[1][..., 2] + rows[2][..., 2]
    return (np.stack(rows, -2) + 0.0) / (double_area / 2)[..., None, None]


def face_inverse(screen):
    """the inverse is transposed: M has the corners in its columns, not in rows"""
    x, y = screen[..., 0], screen[..., 1]
    rows = [np.stack([y[..., i] - y[..., j], x[..., j] - x[..., i],
                      x[..., i] * y[..., j] - x[..., j] * y[..., i]], -1) for i, j in EDGES]
    double_area = rows[0][..., 2] + rows[1][..., 2] + rows[2][..., 2]
    return (np.stack(rows, -1) + 0.0) / double_area[..., None, None]


def face_inverse(screen):
    """row k is of the edge that starts at corner k; it is of the edge opposite to corner k"""
    x, y = screen[..., 0], screen[..., 1]
    rows = [np.stack([y[..., i] - y[..., j], x[..., j] - x[..., i],
                      x[..., i] * y[..., j] - x[..., j] * y[..., i]], -1)
            for i, j in ((0, 1), (1, 2), (2, 0))]
    double_area = rows[0][..., 2] + rows[1][..., 2] + rows[2][..., 2]
    return np.stack(rows, -2) / double_area[..., None, None]


def face_inverse(screen):
    """the area is its absolute value: a clockwise face gets minus its inverse"""
    x, y = screen[..., 0], screen[..., 1]
    rows = [np.stack([y[..., i] - y[..., j], x[..., j] - x[..., i],
                      x[..., i] * y[..., j] - x[..., j] * y[..., i]], -1) for i, j in EDGES]
    double_area = np.abs(rows[0][..., 2] + rows[1][..., 2] + rows[2][..., 2])
    return np.stack(rows, -2) / double_area[..., None, None]


def face_inverse(screen):
    """the normals of the edges have the wrong sign: that of x and y, in the first two columns; the
    constant is right"""
    x, y = screen[..., 0], screen[..., 1]
    rows = [np.stack([y[..., j] - y[..., i], x[..., i] - x[..., j],
                      x[..., i] * y[..., j] - x[..., j] * y[..., i]], -1) for i, j in EDGES]
    double_area = rows[0][..., 2] + rows[1][..., 2] + rows[2][..., 2]
    return np.stack(rows, -2) / double_area[..., None, None]


def screen_weights_and_depth(inverse, z, x, y):
    """the weights are not clamped to 0 and 1"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    clamped = c
    weight = clamped / (clamped[..., :1] + clamped[..., 1:2] + clamped[..., 2:])
    part = weight / z
    return weight, 1 / (part[..., 0] + part[..., 1] + part[..., 2])


def screen_weights_and_depth(inverse, z, x, y):
    """the clamped weights are not divided by their sum"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    clamped = np.clip(c, 0, 1)
    weight = clamped
    part = weight / z
    return weight, 1 / (part[..., 0] + part[..., 1] + part[..., 2])


def screen_weights_and_depth(inverse, z, x, y):
    """depth is the mean of z by the weights; what is linear on screen is 1 / z"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    clamped = np.clip(c, 0, 1)
    weight = clamped / (clamped[..., :1] + clamped[..., 1:2] + clamped[..., 2:])
    return weight, (weight * z).sum(-1)


def screen_weights_and_depth(inverse, z, x, y):
    """1 / depth is returned for depth: the reciprocal of the sum is missing"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    clamped = np.clip(c, 0, 1)
    weight = clamped / clamped.sum(-1, keepdims=True)
    return weight, (weight / z).sum(-1)


def screen_weights_and_depth(inverse, z, x, y):
    """the weights are clamped from below alone; above 1 they are cut off, too"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    clamped = np.maximum(c, 0)
    weight = clamped / clamped.sum(-1, keepdims=True)
    return weight, 1 / (weight / z).sum(-1)


def screen_weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """depth^2 is missing: the derivative of 1 / q is -1 / q^2"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight, _ = screen_weights_and_depth(inverse, z, x, y)
    grad_q = -grad_depth[..., None]
    grad_weight = grad_weight + grad_q / z
    grad_z = -grad_q * weight / z**2
    total = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_c = (grad_weight - (grad_weight * weight).sum(-1, keepdims=True)) / total
    grad_c = np.where((c < 0) | (c > 1), 0, grad_c)
    return grad_c[..., None] * np.stack([x, y, np.ones_like(x)], -1)[..., None, :], grad_z


def screen_weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """depth is not squared: the derivative of 1 / q is -depth^2"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight, depth = screen_weights_and_depth(inverse, z, x, y)
    grad_q = (-grad_depth * depth)[..., None]
    grad_weight = grad_weight + grad_q / z
    grad_z = -grad_q * weight / z**2
    total = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_c = (grad_weight - (grad_weight * weight).sum(-1, keepdims=True)) / total
    grad_c = np.where((c < 0) | (c > 1), 0, grad_c)
    return grad_c[..., None] * np.stack([x, y, np.ones_like(x)], -1)[..., None, :], grad_z


def screen_weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """the sum that the weights are divided by is taken for a constant in the quotient rule"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight, depth = screen_weights_and_depth(inverse, z, x, y)
    grad_q = (-grad_depth * depth**2)[..., None]
    grad_weight = grad_weight + grad_q / z
    grad_z = -grad_q * weight / z**2
    total = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_c = (grad_weight) / total
    grad_c = np.where((c < 0) | (c > 1), 0, grad_c)
    return grad_c[..., None] * np.stack([x, y, np.ones_like(x)], -1)[..., None, :], grad_z


def screen_weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """the way from depth through the weights to the inverse is left out"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight, depth = screen_weights_and_depth(inverse, z, x, y)
    grad_q = (-grad_depth * depth**2)[..., None]
    grad_z = -grad_q * weight / z**2
    total = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_c = (grad_weight - (grad_weight * weight).sum(-1, keepdims=True)) / total
    grad_c = np.where((c < 0) | (c > 1), 0, grad_c)
    return grad_c[..., None] * np.stack([x, y, np.ones_like(x)], -1)[..., None, :], grad_z


def screen_weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """the clamp is forgotten: a c outside of 0 and 1 gets a gradient, too"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight, depth = screen_weights_and_depth(inverse, z, x, y)
    grad_q = (-grad_depth * depth**2)[..., None]
    grad_weight = grad_weight + grad_q / z
    grad_z = -grad_q * weight / z**2
    total = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_c = (grad_weight - (grad_weight * weight).sum(-1, keepdims=True)) / total
    return grad_c[..., None] * np.stack([x, y, np.ones_like(x)], -1)[..., None, :], grad_z


def screen_weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """grad_z is divided by z, not by its square z^2"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight, depth = screen_weights_and_depth(inverse, z, x, y)
    grad_q = (-grad_depth * depth**2)[..., None]
    grad_weight = grad_weight + grad_q / z
    grad_z = -grad_q * weight / z
    total = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_c = (grad_weight - (grad_weight * weight).sum(-1, keepdims=True)) / total
    grad_c = np.where((c < 0) | (c > 1), 0, grad_c)
    return grad_c[..., None] * np.stack([x, y, np.ones_like(x)], -1)[..., None, :], grad_z


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """the maps are upside down: rows are counted from the top; row 0 is at the bottom"""
    face_index, depth = np.full((height, width), -1), np.full((height, width), np.inf)
    weight = np.zeros((height, width, 3))
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        inverse = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        for i in range(y0, y1):
            for j in range(x0, x1):
                x, y = np.array(j + 0.5), np.array(i + 0.5)
                if covers(screen[f], x, y):
                    w, d = screen_weights_and_depth(inverse, z[f], x, y)
                    if near < d < far and d < depth[i, j]:
                        face_index[-1 - i, j], weight[-1 - i, j], depth[i, j] = f, w, d
    return face_index, weight, depth


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """pixels are sampled at their lower left corners instead of at their centres"""
    face_index, depth = np.full((height, width), -1), np.full((height, width), np.inf)
    weight = np.zeros((height, width, 3))
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        inverse = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        for i in range(y0, y1):
            for j in range(x0, x1):
                x, y = np.array(float(j)), np.array(float(i))
                if covers(screen[f], x, y):
                    w, d = screen_weights_and_depth(inverse, z[f], x, y)
                    if near < d < far and d < depth[i, j]:
                        face_index[i, j], weight[i, j], depth[i, j] = f, w, d
    return face_index, weight, depth


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """there is no z-buffer: the last face wins"""
    face_index, depth = np.full((height, width), -1), np.full((height, width), np.inf)
    weight = np.zeros((height, width, 3))
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        inverse = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        for i in range(y0, y1):
            for j in range(x0, x1):
                x, y = np.array(j + 0.5), np.array(i + 0.5)
                if covers(screen[f], x, y):
                    w, d = screen_weights_and_depth(inverse, z[f], x, y)
                    if near < d < far:
                        face_index[i, j], weight[i, j], depth[i, j] = f, w, d
    return face_index, weight, depth


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """the farthest face is seen: depths are compared the other way"""
    face_index, depth = np.full((height, width), -1), np.full((height, width), np.inf)
    weight = np.zeros((height, width, 3))
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        inverse = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        for i in range(y0, y1):
            for j in range(x0, x1):
                x, y = np.array(j + 0.5), np.array(i + 0.5)
                if covers(screen[f], x, y):
                    w, d = screen_weights_and_depth(inverse, z[f], x, y)
                    if near < d < far and (face_index[i, j] < 0 or d > depth[i, j]):
                        face_index[i, j], weight[i, j], depth[i, j] = f, w, d
    return face_index, weight, depth


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """near and far are not asked: faces of any depth are seen"""
    face_index, depth = np.full((height, width), -1), np.full((height, width), np.inf)
    weight = np.zeros((height, width, 3))
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        inverse = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        for i in range(y0, y1):
            for j in range(x0, x1):
                x, y = np.array(j + 0.5), np.array(i + 0.5)
                if covers(screen[f], x, y):
                    w, d = screen_weights_and_depth(inverse, z[f], x, y)
                    if d < depth[i, j]:
                        face_index[i, j], weight[i, j], depth[i, j] = f, w, d
    return face_index, weight, depth


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """of equally deep faces the last is seen, by <= in the depth test"""
    face_index, depth = np.full((height, width), -1), np.full((height, width), np.inf)
    weight = np.zeros((height, width, 3))
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        inverse = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        for i in range(y0, y1):
            for j in range(x0, x1):
                x, y = np.array(j + 0.5), np.array(i + 0.5)
                if covers(screen[f], x, y):
                    w, d = screen_weights_and_depth(inverse, z[f], x, y)
                    if near < d < far and d <= depth[i, j]:
                        face_index[i, j], weight[i, j], depth[i, j] = f, w, d
    return face_index, weight, depth
