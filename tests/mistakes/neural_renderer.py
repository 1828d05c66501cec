"""Mistakes of lab 10; each docstring goes on after "this is what comes out when"."""


def front_faces(screen, z):
    """clockwise faces are drawn, and the others are not"""
    side, other = screen[:, 1] - screen[:, 0], screen[:, 2] - screen[:, 0]
    return (side[:, 0] * other[:, 1] - other[:, 0] * side[:, 1] < 0) & (z > 0).all(1)


def front_faces(screen, z):
    """faces of either winding are drawn"""
    side, other = screen[:, 1] - screen[:, 0], screen[:, 2] - screen[:, 0]
    return (np.abs(side[:, 0] * other[:, 1] - other[:, 0] * side[:, 1]) > 0) & (z > 0).all(1)


def front_faces(screen, z):
    """faces behind the camera are drawn: z is not looked at"""
    side, other = screen[:, 1] - screen[:, 0], screen[:, 2] - screen[:, 0]
    return side[:, 0] * other[:, 1] - other[:, 0] * side[:, 1] > 0


def face_inverse(screen):
    """nothing is divided by twice the area"""
    x, y = screen[..., 0], screen[..., 1]
    rows = [np.stack([y[..., i] - y[..., j], x[..., j] - x[..., i],
                      x[..., i] * y[..., j] - x[..., j] * y[..., i]], -1) for i, j in EDGES]
    return np.stack(rows, -2) + 0.0


def face_inverse(screen):
    """it is divided by the area; the determinant is twice that"""
    x, y = screen[..., 0], screen[..., 1]
    rows = [np.stack([y[..., i] - y[..., j], x[..., j] - x[..., i],
                      x[..., i] * y[..., j] - x[..., j] * y[..., i]], -1) for i, j in EDGES]
    double_area = rows[0][..., 2] + rows[1][..., 2] + rows[2][..., 2]
    return (np.stack(rows, -2) + 0.0) / (double_area / 2)[..., None, None]


def face_inverse(screen):
    """the inverse is transposed: row k belongs to corner k"""
    x, y = screen[..., 0], screen[..., 1]
    rows = [np.stack([y[..., i] - y[..., j], x[..., j] - x[..., i],
                      x[..., i] * y[..., j] - x[..., j] * y[..., i]], -1) for i, j in EDGES]
    double_area = rows[0][..., 2] + rows[1][..., 2] + rows[2][..., 2]
    return (np.stack(rows, -1) + 0.0) / double_area[..., None, None]


def weights_and_depth(inverse, z, x, y):
    """nothing is clamped"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    clamped = c
    weight = clamped / (clamped[..., :1] + clamped[..., 1:2] + clamped[..., 2:])
    part = weight / z
    return weight, 1 / (part[..., 0] + part[..., 1] + part[..., 2])


def weights_and_depth(inverse, z, x, y):
    """the clamped weights are not divided by their sum"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    clamped = np.clip(c, 0, 1)
    weight = clamped
    part = weight / z
    return weight, 1 / (part[..., 0] + part[..., 1] + part[..., 2])


def weights_and_depth(inverse, z, x, y):
    """depth is the mean of z by the weights; what is linear on screen is 1 / z"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    clamped = np.clip(c, 0, 1)
    weight = clamped / (clamped[..., :1] + clamped[..., 1:2] + clamped[..., 2:])
    return weight, (weight * z).sum(-1)


def weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """depth^2 is missing: the derivative of 1 / q is -1 / q^2"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight, _ = weights_and_depth(inverse, z, x, y)
    grad_q = -grad_depth[..., None]
    grad_weight = grad_weight + grad_q / z
    grad_z = -grad_q * weight / z**2
    total = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_c = (grad_weight - (grad_weight * weight).sum(-1, keepdims=True)) / total
    grad_c = np.where((c < 0) | (c > 1), 0, grad_c)
    return grad_c[..., None] * np.stack([x, y, np.ones_like(x)], -1)[..., None, :], grad_z


def weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """the derivative of 1 / q has the wrong sign"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight, depth = weights_and_depth(inverse, z, x, y)
    grad_q = (grad_depth * depth**2)[..., None]
    grad_weight = grad_weight + grad_q / z
    grad_z = -grad_q * weight / z**2
    total = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_c = (grad_weight - (grad_weight * weight).sum(-1, keepdims=True)) / total
    grad_c = np.where((c < 0) | (c > 1), 0, grad_c)
    return grad_c[..., None] * np.stack([x, y, np.ones_like(x)], -1)[..., None, :], grad_z


def weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """the sum that the weights are divided by is taken for a constant"""
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight, depth = weights_and_depth(inverse, z, x, y)
    grad_q = (-grad_depth * depth**2)[..., None]
    grad_weight = grad_weight + grad_q / z
    grad_z = -grad_q * weight / z**2
    total = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_c = (grad_weight) / total
    grad_c = np.where((c < 0) | (c > 1), 0, grad_c)
    return grad_c[..., None] * np.stack([x, y, np.ones_like(x)], -1)[..., None, :], grad_z


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """rows are counted from the top; row 0 is at the bottom"""
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
                    w, d = weights_and_depth(inverse, z[f], x, y)
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
                    w, d = weights_and_depth(inverse, z[f], x, y)
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
                    w, d = weights_and_depth(inverse, z[f], x, y)
                    if near < d < far:
                        face_index[i, j], weight[i, j], depth[i, j] = f, w, d
    return face_index, weight, depth


def cube_taps(weight, depth, z, size):
    """z / z_k is missing: the texture bends in perspective"""
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
    """the weights of the lower and the upper texel are swapped"""
    t = np.minimum((size - 1) * weight * depth[:, None] / z, size - 1)
    low = np.minimum(np.floor(t), size - 2).astype(int)
    index, tap = np.zeros((len(t), 8), int), np.ones((len(t), 8))
    for n in range(8):
        for k in range(3):
            upper = n >> k & 1
            index[:, n] = index[:, n] * size + low[:, k] + upper
            tap[:, n] *= 1 - (t[:, k] - low[:, k]) if upper else t[:, k] - low[:, k]
    return index, tap


def cube_taps_backward(grad_tap, weight, depth, z, size):
    """a lower texel's weight falls where t grows: its sign is missing"""
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
    """the factor T - 1 is missing"""
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
    """the gradient by z has the wrong sign"""
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


def sample_cubes(textures, face, index, tap):
    """all pixels read the cube of face 0"""
    texels = textures.reshape(-1, textures.shape[-1])
    return sum(tap[:, n, None] * texels[index[:, n]] for n in range(8))


def sample_cubes(textures, face, index, tap):
    """a cube is taken to have T^2 texels; it has T^3"""
    texels, first = textures.reshape(-1, textures.shape[-1]), face * textures.shape[1]**2
    return sum(tap[:, n, None] * texels[first + index[:, n]] for n in range(8))


def sample_cubes(textures, face, index, tap):
    """the taps' weights are left out"""
    texels, first = textures.reshape(-1, textures.shape[-1]), face * textures.shape[1]**3
    return sum(texels[first + index[:, n]] for n in range(8))


def sample_cubes_backward(grad_colour, textures, face, index, tap):
    """the taps' weights are left out of the texels' gradient"""
    texels, first = textures.reshape(-1, textures.shape[-1]), face * textures.shape[1]**3
    cell = first[:, None] + index
    grad_textures = [np.bincount(cell.ravel(), grad.repeat(8), len(texels))
                     for grad in grad_colour.T]
    grad_tap = [(texels[cell[:, n]] * grad_colour).sum(1) for n in range(8)]
    return np.stack(grad_textures, -1).reshape(textures.shape), np.stack(grad_tap, 1)


def sample_cubes_backward(grad_colour, textures, face, index, tap):
    """a texel that is read several times keeps its last gradient; they add up"""
    texels, first = textures.reshape(-1, textures.shape[-1]), face * textures.shape[1]**3
    cell = first[:, None] + index
    grad_textures = np.zeros(texels.T.shape)
    for own, grad in zip(grad_textures, grad_colour.T, strict=True):
        own[cell] = tap * grad[:, None]
    grad_tap = [(texels[cell[:, n]] * grad_colour).sum(1) for n in range(8)]
    return np.stack(grad_textures, -1).reshape(textures.shape), np.stack(grad_tap, 1)


def sample_cubes_backward(grad_colour, textures, face, index, tap):
    """grad_tap is the mean over the channels instead of the sum"""
    texels, first = textures.reshape(-1, textures.shape[-1]), face * textures.shape[1]**3
    cell = first[:, None] + index
    grad_textures = [np.bincount(cell.ravel(), (tap * grad[:, None]).ravel(), len(texels))
                     for grad in grad_colour.T]
    grad_tap = [(texels[cell[:, n]] * grad_colour).mean(1) for n in range(8)]
    return np.stack(grad_textures, -1).reshape(textures.shape), np.stack(grad_tap, 1)


def face_light(corners, ambient, directional, towards):
    """normals point to the side that sees the corners clockwise, or l away from the light"""
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(c - a, b - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    cosine = (area / np.where(length > 0, length, 1)) @ towards
    return ambient + np.maximum(cosine, 0)[:, None] * directional


def face_light(corners, ambient, directional, towards):
    """the normal is not brought to length 1"""
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    cosine = area @ towards
    return ambient + np.maximum(cosine, 0)[:, None] * directional


def face_light(corners, ambient, directional, towards):
    """light from behind takes brightness away: max(0, ...) is missing"""
    a, b, c = corners.swapaxes(0, 1)
    area = np.cross(b - a, c - a)
    length = np.linalg.norm(area, axis=1, keepdims=True)
    cosine = (area / np.where(length > 0, length, 1)) @ towards
    return ambient + cosine[:, None] * directional


def face_light_backward(grad_light, corners, ambient, directional, towards):
    """faces that look away from the light have a gradient"""
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
    """the length of N is taken for a constant: the part along n is not taken away"""
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


def edge_lines(a, b, height):
    """the first row is not counted from centres: pixel j's centre is at j + 1/2"""
    low, high = min(a[1], b[1]), max(a[1], b[1])
    row = np.arange(max(np.ceil(low), 0), min(np.floor(high + 0.5), height)).astype(int)
    if a[1] == b[1]:
        row = row[:0]
    toward_b = (row + 0.5 - a[1]) / (b[1] - a[1])
    return row, a[0] + toward_b * (b[0] - a[0]), np.stack([1 - toward_b, toward_b], -1)


def edge_lines(a, b, height):
    """an edge that goes down crosses nothing"""
    low, high = a[1], b[1]
    row = np.arange(max(np.ceil(low - 0.5), 0), min(np.floor(high + 0.5), height)).astype(int)
    if a[1] == b[1]:
        row = row[:0]
    toward_b = (row + 0.5 - a[1]) / (b[1] - a[1])
    return row, a[0] + toward_b * (b[0] - a[0]), np.stack([1 - toward_b, toward_b], -1)


def edge_lines(a, b, height):
    """the shares of a and b are swapped"""
    low, high = min(a[1], b[1]), max(a[1], b[1])
    row = np.arange(max(np.ceil(low - 0.5), 0), min(np.floor(high + 0.5), height)).astype(int)
    if a[1] == b[1]:
        row = row[:0]
    toward_b = (row + 0.5 - a[1]) / (b[1] - a[1])
    return row, a[0] + toward_b * (b[0] - a[0]), np.stack([toward_b, 1 - toward_b], -1)


def sweep_line(grad_colour, colour, sees, crossing, side, share, eps=1e-4):
    """the gradient has the wrong sign: descent goes away from the pixel that asks"""
    inner = int(np.floor(crossing - 0.5) if side > 0 else np.ceil(crossing - 0.5))
    outer, pixel = inner + side, np.arange(len(colour))
    if not (0 <= min(inner, outer) and max(inner, outer) < len(colour)):
        return np.zeros(2)
    is_out = (pixel - inner) * side > 0
    beyond = np.where(is_out[:, None], colour[inner], colour[outer])
    pull = ((colour - beyond) * grad_colour).sum(1)
    asked = (pull > 0) & np.where(is_out, sees[inner], sees)
    way = np.where(is_out, side, -side)[asked] * eps
    distance = 2 / len(colour) * (pixel[asked] + 0.5 - crossing)
    return np.array([(pull[asked] / (distance / s + way)).sum() if s > 0 else 0.0 for s in share])


def sweep_line(grad_colour, colour, sees, crossing, side, share, eps=1e-4):
    """max(0, ...) is missing: a change that raises the loss counts, too"""
    inner = int(np.floor(crossing - 0.5) if side > 0 else np.ceil(crossing - 0.5))
    outer, pixel = inner + side, np.arange(len(colour))
    if not (0 <= min(inner, outer) and max(inner, outer) < len(colour)):
        return np.zeros(2)
    is_out = (pixel - inner) * side > 0
    beyond = np.where(is_out[:, None], colour[inner], colour[outer])
    pull = ((colour - beyond) * grad_colour).sum(1)
    asked = (pull != 0) & np.where(is_out, sees[inner], sees)
    way = np.where(is_out, side, -side)[asked] * eps
    distance = 2 / len(colour) * (pixel[asked] + 0.5 - crossing)
    return np.array([-(pull[asked] / (distance / s + way)).sum() if s > 0 else 0.0 for s in share])


def sweep_line(grad_colour, colour, sees, crossing, side, share, eps=1e-4):
    """d is in pixels; it is in ndc, where the line has length 2"""
    inner = int(np.floor(crossing - 0.5) if side > 0 else np.ceil(crossing - 0.5))
    outer, pixel = inner + side, np.arange(len(colour))
    if not (0 <= min(inner, outer) and max(inner, outer) < len(colour)):
        return np.zeros(2)
    is_out = (pixel - inner) * side > 0
    beyond = np.where(is_out[:, None], colour[inner], colour[outer])
    pull = ((colour - beyond) * grad_colour).sum(1)
    asked = (pull > 0) & np.where(is_out, sees[inner], sees)
    way = np.where(is_out, side, -side)[asked] * eps
    distance = pixel[asked] + 0.5 - crossing
    return np.array([-(pull[asked] / (distance / s + way)).sum() if s > 0 else 0.0 for s in share])
