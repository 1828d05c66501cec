"""Wrong answers to texture_cubes, written without a look at the checks."""


def cube_taps(weight, depth, z, size):
    """the place in the cube is (T - 1) w_k, without the z / z_k that makes it right in perspective

    told by: perspective | z / z_k | z/z_k | depth / z | divid & z_k | depth & not used | depth & ignored
    """
    place = np.minimum((size - 1) * weight, size - 1)
    first = np.minimum(np.floor(place), size - 2).astype(int)
    part = place - first
    index = np.empty((len(weight), 8), int)
    tap = np.empty((len(weight), 8))
    for n in range(8):
        step = [n // 2**k % 2 for k in range(3)]
        i, j, k = (first[:, axis] + step[axis] for axis in range(3))
        index[:, n] = (i * size + j) * size + k
        tap[:, n] = np.prod([part[:, q] if step[q] else 1 - part[:, q] for q in range(3)], axis=0)
    return index, tap


def cube_taps_backward(grad_tap, weight, depth, z, size):
    """grad_z has one factor 1 / z_k too few: the derivative of 1 / z_k is -1 / z_k^2

    told by: z_k^2 | z^2 | z**2 | z_k**2 | squar & z | grad_z & once more | grad_z & factor & z
    """
    t = (size - 1) * weight * depth[:, None] / z
    f = t - np.minimum(np.floor(t), size - 2)
    back = np.zeros_like(t)
    for n in range(8):
        bits = [(n >> k) & 1 for k in range(3)]
        a = [f[:, k] if bits[k] else 1 - f[:, k] for k in range(3)]
        for k in range(3):
            rest = a[(k + 1) % 3] * a[(k + 2) % 3] * grad_tap[:, n]
            back[:, k] += rest if bits[k] else -rest
    back = back * (size - 1)
    grad_weight = back * depth[:, None] / z
    grad_depth = (back * weight / z).sum(1)
    grad_z = -back * weight * depth[:, None] / z
    return grad_weight, grad_depth, grad_z


def face_light(corners, ambient, directional, towards):
    """the direction l is divided by its length, but it is to be used as it is

    told by: towards & length | l & divided & length | towards & normali | l & normali | l & as it is | towards & unit
    """
    e1, e2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    n = np.cross(e1, e2)
    size = np.linalg.norm(n, axis=1, keepdims=True)
    n = n / np.where(size > 0, size, 1)
    direction = towards / np.linalg.norm(towards)
    return ambient + np.maximum(n @ direction, 0)[:, None] * directional


def face_light_backward(grad_light, corners, ambient, directional, towards):
    """back through n = N / |N| it only divides by |N| and keeps the part along n, which has no effect

    told by: along n | along the normal | unit & normal | normaliz | normalis | project | length & normal
    """
    p, q, r = corners.swapaxes(0, 1)
    big = np.cross(q - p, r - p)
    size = np.linalg.norm(big, axis=1, keepdims=True)
    size = np.where(size == 0, 1, size)
    n = big / size
    cos = n @ towards
    lit = cos > 0
    back = np.where(lit, grad_light @ directional, 0)
    grad_big = back[:, None] * towards / size
    to_q = np.cross(r - p, grad_big)
    to_r = np.cross(grad_big, q - p)
    return (np.stack([-(to_q + to_r), to_q, to_r], 1), grad_light.sum(0),
            (grad_light * np.where(lit, cos, 0)[:, None]).sum(0), back @ n)
