"""Wrong answers to neural_renderer, written without a look at the checks."""


def face_inverse(screen):
    """the corners are put into the rows of m instead of its columns, so the result is transposed

    told by: transpose | rows & columns & M | corners & in the rows | corner & row & instead of & column | M^T | M^-T | row & column & swapped
    """
    ones = np.ones(screen.shape[:-1] + (1,))
    m = np.concatenate([screen, ones], axis=-1)
    return np.linalg.inv(m)


def face_inverse(screen):
    """the rows are divided by the area instead of twice the area

    told by: twice & area | 2A | 2 A | double & area | half & area | factor & 2 | factor & two
    """
    px, py = screen[..., 0], screen[..., 1]
    out = np.empty(screen.shape[:-2] + (3, 3))
    for row in range(3):
        s, e = (row + 1) % 3, (row + 2) % 3
        out[..., row, 0] = py[..., s] - py[..., e]
        out[..., row, 1] = px[..., e] - px[..., s]
        out[..., row, 2] = px[..., s] * py[..., e] - px[..., e] * py[..., s]
    return out / signed_area(screen)[..., None, None]


def face_inverse(screen):
    """row k holds the edge that starts at corner k, not the edge opposite to it

    told by: opposite & corner | starts at & corner | rows & rotat | rows & permut | rows & shifted | rows & order | row & another corner
    """
    px, py = screen[..., 0], screen[..., 1]
    rows = []
    for s, e in ((0, 1), (1, 2), (2, 0)):
        rows.append(np.stack([py[..., s] - py[..., e], px[..., e] - px[..., s],
                              px[..., s] * py[..., e] - px[..., e] * py[..., s]], -1))
    stacked = np.stack(rows, -2)
    return stacked / stacked[..., 2].sum(-1)[..., None, None]


def screen_weights_and_depth(inverse, z, x, y):
    """the depth is the plain weighted mean of the z_k instead of 1 over the weighted mean of 1 / z_k

    told by: perspective | 1 / z | 1/z | reciprocal | harmonic | sum w_k z_k | mean of & z
    """
    point = np.stack([x, y, np.ones_like(x)], -1)
    raw = (inverse * point[..., None, :]).sum(-1)
    held = np.maximum(np.minimum(raw, 1), 0)
    share = held / held.sum(-1, keepdims=True)
    return share, (share * z).sum(-1)


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


def screen_weights_and_depth(inverse, z, x, y):
    """after the clamp the weights are not divided by their sum

    told by: sum & to 1 | sum u | divid & sum | normali | add up to 1 | sum & not 1 | rescal
    """
    w = np.zeros(inverse.shape[:-1])
    for k in range(3):
        w[..., k] = np.clip(inverse[..., k, 0] * x + inverse[..., k, 1] * y + inverse[..., k, 2],
                            0, 1)
    return w, 1 / (w / z).sum(-1)


def screen_weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """grad_depth reaches z alone: the way from depth through the weights to inverse is left out

    told by: depth & through & weight | grad_depth & inverse | depth & missing & weight | depth & grad_inverse | depth & depends on & weight | grad_depth & weight
    """
    point = np.stack([x, y, np.ones_like(x)], -1)
    raw = (inverse * point[..., None, :]).sum(-1)
    weight, depth = screen_weights_and_depth(inverse, z, x, y)
    total = np.clip(raw, 0, 1).sum(-1, keepdims=True)
    grad_z = (grad_depth * depth**2)[..., None] * weight / z**2
    back = (grad_weight - (grad_weight * weight).sum(-1, keepdims=True)) / total
    back = np.where((raw < 0) | (raw > 1), 0, back)
    return back[..., :, None] * point[..., None, :], grad_z


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """pixels are tested at their integer corners (j, i), not at their centres j + 1/2, i + 1/2

    told by: centre | center | half a pixel | 1/2 | 0.5 | pixel's corner
    """
    index = -np.ones((height, width), int)
    weights = np.zeros((height, width, 3))
    deep = np.full((height, width), np.inf)
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        m = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        for row in range(y0, y1):
            for col in range(x0, x1):
                x, y = np.array(float(col)), np.array(float(row))
                if not covers(screen[f], x, y):
                    continue
                w, d = screen_weights_and_depth(m, z[f], x, y)
                if near < d < far and d < deep[row, col]:
                    index[row, col] = f
                    weights[row, col] = w
                    deep[row, col] = d
    return index, weights, deep


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """face_index counts only the drawn faces, so it is not the face's number in corners

    told by: number & drawn | count & drawn | number & front | count & front | place & among | skipped faces | index & drawn
    """
    index = np.full((height, width), -1)
    weights = np.zeros((height, width, 3))
    deep = np.full((height, width), np.inf)
    screen, z = on_screen(corners, width, height), corners[..., 2]
    drawn = front_faces(screen, z)
    screen, z = screen[drawn], z[drawn]
    for f in range(len(screen)):
        m = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        for row in range(y0, y1):
            for col in range(x0, x1):
                x, y = np.array(col + 0.5), np.array(row + 0.5)
                if covers(screen[f], x, y):
                    w, d = screen_weights_and_depth(m, z[f], x, y)
                    if near < d < far and d < deep[row, col]:
                        index[row, col], weights[row, col], deep[row, col] = f, w, d
    return index, weights, deep


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """there is no depth test: the last face that covers a pixel is seen, not the nearest

    told by: depth test | z-buffer | nearest | last & face | nearer | overwrit | compar & depth
    """
    index = np.full((height, width), -1)
    weights = np.zeros((height, width, 3))
    deep = np.full((height, width), np.inf)
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        m = face_inverse(screen[f])
        x0, y0, x1, y1 = pixel_box(screen[f], width, height)
        row, col = np.meshgrid(np.arange(y0, y1), np.arange(x0, x1), indexing="ij")
        inside = covers(screen[f], col + 0.5, row + 0.5)
        row, col = row[inside], col[inside]
        w, d = screen_weights_and_depth(m, z[f], col + 0.5, row + 0.5)
        keep = (d > near) & (d < far)
        row, col = row[keep], col[keep]
        index[row, col] = f
        weights[row, col] = w[keep]
        deep[row, col] = d[keep]
    return index, weights, deep


def face_inverse(screen):
    """M is built with a corner in each row, not in each column, so its inverse is transposed

    told by: transpos | row & column | corner in each row | columns of m | swapaxes | rows & columns
    """
    M = np.ones(screen.shape[:-1] + (3,))
    M[..., :2] = screen
    return np.linalg.inv(M)


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
    """the depth is interpolated linearly, sum w z: it is not right in perspective

    told by: perspective | 1 / z | linear | reciprocal | harmonic | w z | 1/z | w_k z_k
    """
    p = np.stack([x, y, np.ones_like(x)], -1)
    c = np.clip((inverse @ p[..., None])[..., 0], 0, 1)
    w = c / c.sum(-1, keepdims=True)
    return w, (w * z).sum(-1)


def screen_weights_and_depth(inverse, z, x, y):
    """half a pixel is added to x and y, but they are points of the screen already

    told by: half a pixel | 1/2 | 0.5 | pixel centre | half & pixel | shift | already & centre
    """
    p = np.stack([x + 0.5, y + 0.5, np.ones_like(x)], -1)
    c = np.clip((inverse @ p[..., None])[..., 0], 0, 1)
    w = c / c.sum(-1, keepdims=True)
    return w, 1 / (w / z).sum(-1)


def screen_weights_and_depth_backward(grad_weight, grad_depth, inverse, z, x, y):
    """the depth's gradient goes to z only: its path through the weights is left out

    told by: through the weight | through weight | depth & weight | grad_depth & inverse | depth & inverse | second path | both paths | depth & indirect
    """
    p = np.stack([x, y, np.ones_like(x)], -1)
    c = (inverse @ p[..., None])[..., 0]
    u = np.clip(c, 0, 1)
    total = u.sum(-1, keepdims=True)
    w = u / total
    depth = 1 / (w / z).sum(-1)
    grad_z = grad_depth[..., None] * depth[..., None]**2 * w / z**2
    grad_u = (grad_weight - (grad_weight * w).sum(-1, keepdims=True)) / total
    grad_c = grad_u * ((c >= 0) & (c <= 1))
    return grad_c[..., :, None] * p[..., None, :], grad_z


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """pixels are asked at their corner (j, i), not at their centre: half a pixel is missing

    told by: half a pixel | centre | 1/2 | 0.5 | half & pixel | shift
    """
    index = np.full((height, width), -1)
    weights = np.zeros((height, width, 3))
    zbuffer = np.full((height, width), np.inf)
    screen, z = on_screen(corners, width, height), corners[..., 2]
    front = front_faces(screen, z)
    for f in range(len(corners)):
        if not front[f]:
            continue
        inv = face_inverse(screen[f])
        for i in range(height):
            for j in range(width):
                x, y = np.array(float(j)), np.array(float(i))
                if covers(screen[f], x, y):
                    w, d = screen_weights_and_depth(inv, z[f], x, y)
                    if near < d < far and d < zbuffer[i, j]:
                        index[i, j], weights[i, j], zbuffer[i, j] = f, w, d
    return index, weights, zbuffer


def rasterize_loop(corners, width, height, near=0.1, far=100.0):
    """the depth is not compared with what the pixel has: the last face drawn is seen, not the nearest

    told by: nearest | last face | z-buffer | depth test | compar & depth | nearer | hidden | overwrit | farther | order of the faces
    """
    index = np.full((height, width), -1)
    weights = np.zeros((height, width, 3))
    zbuffer = np.full((height, width), np.inf)
    screen, z = on_screen(corners, width, height), corners[..., 2]
    for f in np.flatnonzero(front_faces(screen, z)):
        inv = face_inverse(screen[f])
        left, low, right, high = pixel_box(screen[f], width, height)
        for i in range(low, high):
            for j in range(left, right):
                x, y = np.array(j + 0.5), np.array(i + 0.5)
                if not covers(screen[f], x, y):
                    continue
                w, d = screen_weights_and_depth(inv, z[f], x, y)
                if d > near and d < far:
                    index[i, j], weights[i, j], zbuffer[i, j] = f, w, d
    return index, weights, zbuffer
