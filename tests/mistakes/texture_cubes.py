"""Mistakes of lab 10; each docstring goes on after "this is what comes out when"."""


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
