"""Wrong answers to neural_renderer, written without a look at the checks."""


def face_inverse(screen):
    """the matrix is built with the corners in rows, so the inverse comes out transposed

    told by: transpos | rows & columns | corners & in rows | rows instead of columns
    """
    ones = np.ones(screen.shape[:-1] + (1,))
    matrix = np.concatenate([screen, ones], axis=-1)
    return np.linalg.inv(matrix)


def face_inverse(screen):
    """the rows are divided by the area instead of twice the area

    told by: twice & area | 2A | double & area | half & area | twice too large | factor of 2
    """
    x = screen[..., 0]
    y = screen[..., 1]
    area = signed_area(screen)
    result = np.zeros(screen.shape[:-2] + (3, 3))
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        result[..., k, 0] = (y[..., i] - y[..., j]) / area
        result[..., k, 1] = (x[..., j] - x[..., i]) / area
        result[..., k, 2] = (x[..., i] * y[..., j] - x[..., j] * y[..., i]) / area
    return result


def face_inverse(screen):
    """row k belongs to the edge that starts at corner k, not to the edge opposite to it

    told by: opposite | cyclic | shifted & row | rows & order | starts at & corner | wrong edge
    """
    x, y = screen[..., 0], screen[..., 1]
    rows = []
    for i, j in ((0, 1), (1, 2), (2, 0)):
        rows.append(np.stack([y[..., i] - y[..., j], x[..., j] - x[..., i],
                              x[..., i] * y[..., j] - x[..., j] * y[..., i]], -1))
    double_area = sum(row[..., 2] for row in rows)
    return np.stack(rows, -2) / double_area[..., None, None]


def face_inverse(screen):
    """the edge functions are returned as they are, without the division by twice the area

    told by: not divided | division & area | divide & area | adjugate | determinant | normali
    """
    x, y = np.moveaxis(screen, -1, 0)
    xn, xp = np.roll(x, -1, -1), np.roll(x, -2, -1)
    yn, yp = np.roll(y, -1, -1), np.roll(y, -2, -1)
    return np.stack([yn - yp, xp - xn, xn * yp - xp * yn], axis=-1)


def face_inverse(screen):
    """the area is its absolute value, so a clockwise face gets the negative of its inverse

    told by: absolute | abs( | clockwise | orientation | winding
    """
    x, y = screen[..., 0], screen[..., 1]
    rows = np.stack([np.stack([y[..., i] - y[..., j], x[..., j] - x[..., i],
                               x[..., i] * y[..., j] - x[..., j] * y[..., i]], -1)
                     for i, j in EDGES], -2)
    double_area = 2 * np.abs(signed_area(screen))
    return rows / double_area[..., None, None]


def weights_and_depth(inverse, z, x, y):
    """the clamped weights are not divided by their sum

    told by: not normali | sum & 1 | divided by & sum | division by & sum | renormali | divide & sum
    """
    p = np.stack([x, y, np.ones_like(x)], -1)
    weight = np.clip((inverse @ p[..., None])[..., 0], 0, 1)
    return weight, 1 / (weight / z).sum(-1)


def weights_and_depth(inverse, z, x, y):
    """the weights are not clamped to 0 .. 1

    told by: clamp | clip | negative & weight | below 0 | above 1
    """
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight = c / c.sum(-1, keepdims=True)
    return weight, 1 / (weight / z).sum(-1)


def weights_and_depth(inverse, z, x, y):
    """the sum of w_k / z_k is returned without taking its reciprocal, so it is 1 / depth

    told by: reciprocal | 1 / depth | 1 / z | 1/z | inverse depth | inverted
    """
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    clamped = np.clip(c, 0, 1)
    weight = clamped / clamped.sum(-1, keepdims=True)
    depth = np.zeros(weight.shape[:-1])
    for k in range(3):
        depth = depth + weight[..., k] / z[..., k]
    return weight, depth


def weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """the way from depth to the inverse, through the weights, is left out

    told by: through & weight | depth & weight & left out | depth & inverse | grad_depth & grad_weight | through weight
    """
    p = np.stack([x, y, np.ones_like(x)], -1)
    c = (inverse @ p[..., None])[..., 0]
    weight, depth = weights_and_depth(inverse, z, x, y)
    s = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_u = interpolation.normalize_backward(grad_weight, weight, s, axis=-1)
    grad_c = grad_u * ((c >= 0) & (c <= 1))
    grad_z = (grad_depth * depth**2)[..., None] * weight / z**2
    return grad_c[..., None] * p[..., None, :], grad_z


def weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """the clamp is forgotten: a clamped c_k gets a gradient too

    told by: clamp | clip | outside & 0 and 1 | outside & face | c < 0 | above 1
    """
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight, depth = weights_and_depth(inverse, z, x, y)
    grad_q = (-grad_depth * depth**2)[..., None]
    grad_weight = grad_weight + grad_q / z
    grad_z = -grad_q * weight / z**2
    s = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_c = interpolation.normalize_backward(grad_weight, weight, s, axis=-1)
    p = np.stack([x, y, np.ones_like(x)], -1)
    return grad_c[..., None] * p[..., None, :], grad_z


def weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """the sum of the weights is treated as a constant: the quotient rule has only its first term

    told by: quotient | normali | constant & sum | sum & constant | division & sum | second term
    """
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight, depth = weights_and_depth(inverse, z, x, y)
    grad_q = (-grad_depth * depth**2)[..., None]
    total = grad_weight + grad_q / z
    s = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_c = np.where((c < 0) | (c > 1), 0, total / s)
    p = np.stack([x, y, np.ones_like(x)], -1)
    return grad_c[..., None] * p[..., None, :], -grad_q * weight / z**2


def weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """the gradient of z is not divided by z squared but by z

    told by: squared | z**2 | z^2 | square & z | power & z
    """
    c = inverse[..., 0] * x[..., None] + inverse[..., 1] * y[..., None] + inverse[..., 2]
    weight, depth = weights_and_depth(inverse, z, x, y)
    grad_q = (-grad_depth * depth**2)[..., None]
    grad_z = -grad_q * weight / z
    s = np.clip(c, 0, 1).sum(-1, keepdims=True)
    grad_u = interpolation.normalize_backward(grad_weight + grad_q / z, weight, s, axis=-1)
    grad_c = np.where((c < 0) | (c > 1), 0, grad_u)
    p = np.stack([x, y, np.ones_like(x)], -1)
    return grad_c[..., None] * p[..., None, :], grad_z


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """the farthest face is kept: the depth is compared the other way

    told by: farthest | furthest | behind & wins | comparison & depth | depth & compared | depth test & revers
    """
    face_index = np.full((height, width), -1)
    weight = np.zeros((height, width, 3))
    depth = np.full((height, width), np.inf)
    screen, z = on_screen(corners, width, height), corners[..., 2]
    drawn = front_faces(screen, z)
    for f in range(len(corners)):
        if not drawn[f]:
            continue
        inverse = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        for i in range(y0, y1):
            for j in range(x0, x1):
                x, y = np.array(j + 0.5), np.array(i + 0.5)
                if not covers(screen[f], x, y):
                    continue
                w, d = weights_and_depth(inverse, z[f], x, y)
                if near < d < far and (face_index[i, j] == -1 or d > depth[i, j]):
                    face_index[i, j] = f
                    weight[i, j] = w
                    depth[i, j] = d
    return face_index, weight, depth


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """pixels are sampled at their lower left corner j, i instead of their centre

    told by: centre | center | half a pixel | 1/2 | 0.5 | pixel's corner
    """
    face_index = np.full((height, width), -1)
    weight = np.zeros((height, width, 3))
    depth = np.full((height, width), np.inf)
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        inverse = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            x, y = np.array(float(j)), np.array(float(i))
            if covers(screen[f], x, y):
                w, d = weights_and_depth(inverse, z[f], x, y)
                if near < d < far and d < depth[i, j]:
                    face_index[i, j], weight[i, j], depth[i, j] = f, w, d
    return face_index, weight, depth


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """back faces and faces behind the camera are not left out: front_faces is not asked

    told by: back fac | front_faces | clockwise | behind the camera | front fac | culling
    """
    face_index = np.full((height, width), -1)
    weight = np.zeros((height, width, 3))
    depth = np.full((height, width), np.inf)
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in range(len(corners)):
        tri, deep = screen[f], z[f]
        if signed_area(tri) == 0:
            continue
        if signed_area(tri) < 0:
            tri = tri[[0, 2, 1]]
            deep = deep[[0, 2, 1]]
        inverse = face_inverse(tri)
        x0, y0, x1, y1 = pixel_box(tri, width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            x, y = np.array(j + 0.5), np.array(i + 0.5)
            if covers(tri, x, y):
                w, d = weights_and_depth(inverse, deep, x, y)
                if near < d < far and d < depth[i, j]:
                    if signed_area(screen[f]) < 0:
                        w = w[[0, 2, 1]]
                    face_index[i, j], weight[i, j], depth[i, j] = f, w, d
    return face_index, weight, depth


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """row 0 is taken for the top of the picture, so the maps are upside down

    told by: upside down | flip | y up | y down | from the bottom | the top
    """
    face_index = np.full((height, width), -1)
    weight = np.zeros((height, width, 3))
    depth = np.full((height, width), np.inf)
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        inverse = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        for row in range(y0, y1):
            for col in range(x0, x1):
                x, y = np.array(col + 0.5), np.array(row + 0.5)
                if covers(screen[f], x, y):
                    w, d = weights_and_depth(inverse, z[f], x, y)
                    i = height - 1 - row
                    if near < d < far and d < depth[i, col]:
                        face_index[i, col], weight[i, col], depth[i, col] = f, w, d
    return face_index, weight, depth


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """fine print: of two equally deep faces the last is seen, because of <= in the depth test

    told by: equally deep | equal depth | same depth | <= | a tie | as deep
    """
    face_index = np.full((height, width), -1)
    weight = np.zeros((height, width, 3))
    depth = np.full((height, width), np.inf)
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        M = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        for i, j in itertools.product(range(y0, y1), range(x0, x1)):
            x, y = np.array(j + 0.5), np.array(i + 0.5)
            if covers(screen[f], x, y):
                w, d = weights_and_depth(M, z[f], x, y)
                if near < d < far and d <= depth[i, j]:
                    face_index[i, j], weight[i, j], depth[i, j] = f, w, d
    return face_index, weight, depth
