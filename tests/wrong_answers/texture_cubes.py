"""Wrong answers to texture_cubes, written without a look at the checks."""


def cube_taps(weight, depth, z, size):
    """the weights on screen are taken as they are: the factor depth / z_k of the perspective is missing

    told by: perspective | z / z_k | depth / z | depth & factor | weights on screen | on screen & weight
    """
    t = (size - 1) * weight
    low = np.minimum(np.floor(t), size - 2).astype(int)
    part = t - low
    index = np.zeros((len(t), 8), int)
    tap = np.ones((len(t), 8))
    for n in range(8):
        for k in range(3):
            bit = (n // 2**k) % 2
            index[:, n] += (low[:, k] + bit) * size**(2 - k)
            tap[:, n] *= part[:, k] if bit else 1 - part[:, k]
    return index, tap


def cube_taps(weight, depth, z, size):
    """the last axis takes bit 0 of the tap's number, so the taps are in the order of the texels

    told by: order & tap | bit & axis | reversed & bit | order & axes | axis & exchanged | n // 2
    """
    t = np.minimum((size - 1) * weight * depth[:, None] / z, size - 1)
    low = np.minimum(np.floor(t), size - 2).astype(int)
    part = t - low
    index, tap = np.zeros((len(t), 8), int), np.zeros((len(t), 8))
    n = 0
    for i in (0, 1):
        for j in (0, 1):
            for k in (0, 1):
                p, q, r = (low + [i, j, k]).T
                index[:, n] = (p * size + q) * size + r
                tap[:, n] = np.prod(np.where([i, j, k], part, 1 - part), axis=1)
                n += 1
    return index, tap


def cube_taps(weight, depth, z, size):
    """the lower texel is not limited to T - 2, so at t_k = T - 1 the upper one lies outside of the cube

    told by: T - 2 | size - 2 | last texel | outside & cube | beyond & cube | t_k = T - 1
    """
    t = np.minimum((size - 1) * weight * depth[:, None] / z, size - 1)
    low = np.floor(t).astype(int)
    index, tap = np.zeros((len(t), 8), int), np.ones((len(t), 8))
    for n in range(8):
        for k in range(3):
            upper = n >> k & 1
            index[:, n] = index[:, n] * size + low[:, k] + upper
            tap[:, n] *= t[:, k] - low[:, k] if upper else 1 - (t[:, k] - low[:, k])
    return index, tap


def cube_taps_backward(grad_tap, weight, depth, z, size):
    """the sign is forgotten: a lower texel's weight 1 - part falls as t grows

    told by: sign & tap | minus & tap | 1 - part | lower texel | - 1 & tap | 1 - (t
    """
    scale = (size - 1) / z
    t = scale * weight * depth[:, None]
    part = t - np.minimum(np.floor(t), size - 2)
    grad_t = np.zeros(t.shape)
    for n in range(8):
        f = [part[:, k] if n >> k & 1 else 1 - part[:, k] for k in range(3)]
        grad_t[:, 0] += grad_tap[:, n] * f[1] * f[2]
        grad_t[:, 1] += grad_tap[:, n] * f[0] * f[2]
        grad_t[:, 2] += grad_tap[:, n] * f[0] * f[1]
    grad_weight = grad_t * scale * depth[:, None]
    return grad_weight, (grad_t * scale * weight).sum(1), -grad_weight * weight / z


def cube_taps_backward(grad_tap, weight, depth, z, size):
    """the factor T - 1 of the places is forgotten in the chain rule

    told by: T - 1 | size - 1 | cube's size | factor & size | chain rule & size
    """
    t = (size - 1) * weight * depth[:, None] / z
    part = t - np.minimum(np.floor(t), size - 2)
    grad_t = np.zeros(t.shape)
    for n in range(8):
        bits = [(n >> k) & 1 for k in range(3)]
        a = [part[:, k] if bits[k] else 1 - part[:, k] for k in range(3)]
        for k, (i, j) in enumerate(EDGES):
            grad_t[:, k] += (2 * bits[k] - 1) * grad_tap[:, n] * a[i] * a[j]
    grad_weight = grad_t * depth[:, None] / z
    grad_depth = (grad_t * weight / z).sum(1)
    grad_z = -grad_t * weight * depth[:, None] / z**2
    return grad_weight, grad_depth, grad_z


def cube_taps_backward(grad_tap, weight, depth, z, size):
    """grad_z has a plus: t_k falls as z_k grows

    told by: grad_z & sign | grad_z & minus | grad_z & negative | z_k & sign | z_k & minus | falls & z_k
    """
    scale = (size - 1) / z
    t = scale * weight * depth[:, None]
    part = t - np.minimum(np.floor(t), size - 2)
    grad_t = np.zeros(t.shape)
    for n in range(8):
        a = [part[:, k] if n >> k & 1 else 1 - part[:, k] for k in range(3)]
        for k, (i, j) in enumerate(EDGES):
            grad_t[:, k] += (1 if n >> k & 1 else -1) * grad_tap[:, n] * a[i] * a[j]
    grad_weight = grad_t * scale * depth[:, None]
    return grad_weight, (grad_t * scale * weight).sum(1), grad_t * t / z


def face_light(corners, ambient, directional, towards):
    """the normal is not divided by its length

    told by: normali | unit normal | length & normal | unit length | divided by & length
    """
    v0, v1, v2 = corners[:, 0], corners[:, 1], corners[:, 2]
    n = np.cross(v1 - v0, v2 - v0)
    return ambient + np.maximum(n @ towards, 0)[:, None] * directional


def face_light(corners, ambient, directional, towards):
    """the cosine is not cut off at 0, so faces that look away from the light are darkened

    told by: max(0 | cut off | clamp | negative & light | turned away | look away
    """
    light = np.zeros((len(corners), len(ambient)))
    for f, (a, b, c) in enumerate(corners):
        n = np.cross(b - a, c - a)
        length = np.linalg.norm(n)
        if length > 0:
            n = n / length
        light[f] = ambient + directional * (n @ towards)
    return light


def face_light(corners, ambient, directional, towards):
    """the light is lit from both sides: the absolute value of the cosine is taken

    told by: absolute | both sides | abs( | two-sided | back side | from behind
    """
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    cosine = (area / np.where(length > 0, length, 1)) @ towards
    return ambient + np.abs(cosine)[:, None] * directional


def face_light(corners, ambient, directional, towards):
    """fine print: a face without area divides 0 by 0 and its light is nan

    told by: nan | without area | degenerate | 0 / 0 | divi & 0 | no normal
    """
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    n = np.cross(b - a, c - a)
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    return ambient[None] + np.clip(n @ towards, 0, None)[:, None] * directional[None]


def face_light(corners, ambient, directional, towards):
    """the length of the normals is taken over all faces at once, without an axis

    told by: axis | all faces & length | each face & length | whole array | norm & once
    """
    a, b, c = corners.swapaxes(0, 1)
    normal = np.cross(b - a, c - a)
    normal = normal / np.linalg.norm(normal)
    return ambient + np.maximum(normal @ towards, 0)[:, None] * directional


def face_light_backward(grad_light, corners, ambient, directional, towards):
    """the normal's division by its length is treated as a constant in grad_corners

    told by: division & length | normali | length & constant | length & depends | tangent | project
    """
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    length[length == 0] = 1
    normal = area / length
    cosine = (normal @ towards)[:, None]
    grad_cosine = np.where(cosine > 0, (grad_light * directional).sum(1, keepdims=True), 0)
    grad_area = grad_cosine * towards / length
    grad_b, grad_c = np.cross(c - a, grad_area), np.cross(grad_area, b - a)
    grad_corners = np.stack([-grad_b - grad_c, grad_b, grad_c], 1)
    grad_directional = (grad_light * np.maximum(cosine, 0)).sum(0)
    return grad_corners, grad_light.sum(0), grad_directional, (grad_cosine * normal).sum(0)


def face_light_backward(grad_light, corners, ambient, directional, towards):
    """faces turned away from the light get gradients as well: the max(0, .) is forgotten in grad_cosine

    told by: max(0 | turned away | n . l <= 0 | away from the light | cut off | clamp
    """
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    length[length == 0] = 1
    n = area / length
    cosine = (n * towards).sum(1, keepdims=True)
    grad_cosine = (grad_light * directional).sum(1, keepdims=True)
    grad_area = grad_cosine * (towards - cosine * n) / length
    grad_b, grad_c = np.cross(c - a, grad_area), np.cross(grad_area, b - a)
    grad_corners = np.stack([-grad_b - grad_c, grad_b, grad_c], 1)
    grad_directional = (grad_light * np.maximum(cosine, 0)).sum(0)
    return grad_corners, grad_light.sum(0), grad_directional, (grad_cosine * n).sum(0)


def face_light_backward(grad_light, corners, ambient, directional, towards):
    """corner a has no gradient, although both edge vectors start at it

    told by: corner a | first corner | both edge | corner 0 | starts at
    """
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    length[length == 0] = 1
    normal = area / length
    cosine = (normal @ towards)[:, None]
    grad_cosine = np.where(cosine > 0, (grad_light * directional).sum(1, keepdims=True), 0)
    grad_area = grad_cosine * (towards - cosine * normal) / length
    grad_corners = np.zeros_like(corners)
    grad_corners[:, 1] = np.cross(c - a, grad_area)
    grad_corners[:, 2] = np.cross(grad_area, b - a)
    grad_directional = (grad_light * np.maximum(cosine, 0)).sum(0)
    return grad_corners, grad_light.sum(0), grad_directional, (grad_cosine * normal).sum(0)
