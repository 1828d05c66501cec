"""Mistakes of lab 10; each docstring goes on after "this is what comes out when"."""


def cube_taps(weight, depth, z, size):
    """depth / z_k is missing, the factor of the perspective: the weights on screen are taken"""
    t = np.minimum((size - 1) * weight, size - 1)
    low = np.minimum(np.floor(t), size - 2).astype(int)
    index, tap = np.zeros((len(t), 8), int), np.ones((len(t), 8))
    for n in range(8):
        for k in range(3):
            upper = n >> k & 1
            index[:, n] = index[:, n] * size + low[:, k] + upper
            tap[:, n] *= t[:, k] - low[:, k] if upper else 1 - (t[:, k] - low[:, k])
    return index, tap


def cube_taps(weight, depth, z, size):
    """the cube is T long; from the first texel to the last it is T - 1"""
    t = np.minimum(size * weight * depth[:, None] / z, size - 1)
    low = np.minimum(np.floor(t), size - 2).astype(int)
    index, tap = np.zeros((len(t), 8), int), np.ones((len(t), 8))
    for n in range(8):
        for k in range(3):
            upper = n >> k & 1
            index[:, n] = index[:, n] * size + low[:, k] + upper
            tap[:, n] *= t[:, k] - low[:, k] if upper else 1 - (t[:, k] - low[:, k])
    return index, tap


def cube_taps(weight, depth, z, size):
    """the weights of the lower and the upper texel are swapped in tap"""
    t = np.minimum((size - 1) * weight * depth[:, None] / z, size - 1)
    low = np.minimum(np.floor(t), size - 2).astype(int)
    index, tap = np.zeros((len(t), 8), int), np.ones((len(t), 8))
    for n in range(8):
        for k in range(3):
            upper = n >> k & 1
            index[:, n] = index[:, n] * size + low[:, k] + upper
            tap[:, n] *= 1 - (t[:, k] - low[:, k]) if upper else t[:, k] - low[:, k]
    return index, tap


def cube_taps(weight, depth, z, size):
    """the axes are in another order: bit 0 of a tap's number belongs to the last axis"""
    t = np.minimum((size - 1) * weight * depth[:, None] / z, size - 1)
    low = np.minimum(np.floor(t), size - 2).astype(int)
    index, tap = np.zeros((len(t), 8), int), np.ones((len(t), 8))
    for n in range(8):
        for k in range(3):
            upper = n >> (2 - k) & 1
            index[:, n] = index[:, n] * size + low[:, k] + upper
            tap[:, n] *= t[:, k] - low[:, k] if upper else 1 - (t[:, k] - low[:, k])
    return index, tap


def cube_taps_backward(grad_tap, weight, depth, z, size):
    """the sign of lower texels is forgotten: their tap has 1 - (t - low), which falls"""
    scale = (size - 1) / z
    t = scale * weight * depth[:, None]
    part = t - np.minimum(np.floor(t), size - 2)
    grad_t = np.zeros(t.shape)
    for n in range(8):
        factor = [part[:, k] if n >> k & 1 else 1 - part[:, k] for k in range(3)]
        for k, (i, j) in enumerate(EDGES):
            sign = 1
            grad_t[:, k] += sign * grad_tap[:, n] * factor[i] * factor[j]
    grad_weight = grad_t * scale * depth[:, None]
    return grad_weight, (grad_t * scale * weight).sum(1), -grad_weight * weight / z


def cube_taps_backward(grad_tap, weight, depth, z, size):
    """the factor T - 1, size - 1, is missing"""
    scale = 1 / z
    t = scale * weight * depth[:, None]
    part = t - np.minimum(np.floor(t), size - 2)
    grad_t = np.zeros(t.shape)
    for n in range(8):
        factor = [part[:, k] if n >> k & 1 else 1 - part[:, k] for k in range(3)]
        for k, (i, j) in enumerate(EDGES):
            sign = 1 if n >> k & 1 else -1
            grad_t[:, k] += sign * grad_tap[:, n] * factor[i] * factor[j]
    grad_weight = grad_t * scale * depth[:, None]
    return grad_weight, (grad_t * scale * weight).sum(1), -grad_weight * weight / z


def cube_taps_backward(grad_tap, weight, depth, z, size):
    """grad_z has the wrong sign, a plus: t_k falls as z_k grows"""
    scale = (size - 1) / z
    t = scale * weight * depth[:, None]
    part = t - np.minimum(np.floor(t), size - 2)
    grad_t = np.zeros(t.shape)
    for n in range(8):
        factor = [part[:, k] if n >> k & 1 else 1 - part[:, k] for k in range(3)]
        for k, (i, j) in enumerate(EDGES):
            sign = 1 if n >> k & 1 else -1
            grad_t[:, k] += sign * grad_tap[:, n] * factor[i] * factor[j]
    grad_weight = grad_t * scale * depth[:, None]
    return grad_weight, (grad_t * scale * weight).sum(1), grad_weight * weight / z


def cube_taps_backward(grad_tap, weight, depth, z, size):
    """z is not squared in grad_z: the derivative of 1 / z is -1 / z^2"""
    scale = (size - 1) / z
    t = scale * weight * depth[:, None]
    part = t - np.minimum(np.floor(t), size - 2)
    grad_t = np.zeros(t.shape)
    for n in range(8):
        factor = [part[:, k] if n >> k & 1 else 1 - part[:, k] for k in range(3)]
        for k, (i, j) in enumerate(EDGES):
            sign = 1 if n >> k & 1 else -1
            grad_t[:, k] += sign * grad_tap[:, n] * factor[i] * factor[j]
    grad_weight = grad_t * scale * depth[:, None]
    return grad_weight, (grad_t * scale * weight).sum(1), -grad_weight * weight


def face_light(corners, ambient, directional, towards):
    """the cross product is turned round: normals point to the other side"""
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(c - a, b - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    cosine = (area / np.where(length > 0, length, 1)) @ towards
    return ambient + np.maximum(cosine, 0)[:, None] * directional


def face_light(corners, ambient, directional, towards):
    """the normal is not divided by its length"""
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    cosine = area @ towards
    return ambient + np.maximum(cosine, 0)[:, None] * directional


def face_light(corners, ambient, directional, towards):
    """max(0, ...) is missing: faces that look away from the light are darkened"""
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    cosine = (area / np.where(length > 0, length, 1)) @ towards
    return ambient + cosine[:, None] * directional


def face_light(corners, ambient, directional, towards):
    """the absolute value of the cosine is taken: faces are lit from both sides"""
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    cosine = (area / np.where(length > 0, length, 1)) @ towards
    return ambient + np.abs(cosine)[:, None] * directional


def face_light(corners, ambient, directional, towards):
    """the length is that of all faces' normals at once, without an axis: each has its own"""
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    cosine = area / np.linalg.norm(area) @ towards
    return ambient + np.maximum(cosine, 0)[:, None] * directional


def face_light(corners, ambient, directional, towards):
    """towards is divided by its length; it is taken as it is"""
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    cosine = (area / np.where(length > 0, length, 1)) @ (towards / np.linalg.norm(towards))
    return ambient + np.maximum(cosine, 0)[:, None] * directional


def face_light_backward(grad_light, corners, ambient, directional, towards):
    """faces turned away from the light have a gradient: max(0, ...) is forgotten"""
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    length[length == 0] = 1
    normal = area / length
    cosine = (normal @ towards)[:, None]
    grad_cosine = (grad_light * directional).sum(1, keepdims=True)
    grad_area = grad_cosine * (towards - cosine * normal) / length
    grad_b, grad_c = np.cross(c - a, grad_area), np.cross(grad_area, b - a)
    return (np.stack([-grad_b - grad_c, grad_b, grad_c], 1), grad_light.sum(0),
            (grad_light * np.maximum(cosine, 0)).sum(0), (grad_cosine * normal).sum(0))


def face_light_backward(grad_light, corners, ambient, directional, towards):
    """the length of N is taken for a constant: the part along the normal is not taken away"""
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    length[length == 0] = 1
    normal = area / length
    cosine = (normal @ towards)[:, None]
    grad_cosine = np.where(cosine > 0, (grad_light * directional).sum(1, keepdims=True), 0)
    grad_area = grad_cosine * (towards) / length
    grad_b, grad_c = np.cross(c - a, grad_area), np.cross(grad_area, b - a)
    return (np.stack([-grad_b - grad_c, grad_b, grad_c], 1), grad_light.sum(0),
            (grad_light * np.maximum(cosine, 0)).sum(0), (grad_cosine * normal).sum(0))


def face_light_backward(grad_light, corners, ambient, directional, towards):
    """the corners' gradients have the wrong sign: a cross product is turned round"""
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    length[length == 0] = 1
    normal = area / length
    cosine = (normal @ towards)[:, None]
    grad_cosine = np.where(cosine > 0, (grad_light * directional).sum(1, keepdims=True), 0)
    grad_area = grad_cosine * (towards - cosine * normal) / length
    grad_b, grad_c = np.cross(grad_area, c - a), np.cross(b - a, grad_area)
    return (np.stack([-grad_b - grad_c, grad_b, grad_c], 1), grad_light.sum(0),
            (grad_light * np.maximum(cosine, 0)).sum(0), (grad_cosine * normal).sum(0))


def face_light_backward(grad_light, corners, ambient, directional, towards):
    """corner a has no gradient; both edge vectors start at it"""
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    length[length == 0] = 1
    normal = area / length
    cosine = (normal @ towards)[:, None]
    grad_cosine = np.where(cosine > 0, (grad_light * directional).sum(1, keepdims=True), 0)
    grad_area = grad_cosine * (towards - cosine * normal) / length
    grad_b, grad_c = np.cross(c - a, grad_area), np.cross(grad_area, b - a)
    return (np.stack([0 * grad_b, grad_b, grad_c], 1), grad_light.sum(0),
            (grad_light * np.maximum(cosine, 0)).sum(0), (grad_cosine * normal).sum(0))
