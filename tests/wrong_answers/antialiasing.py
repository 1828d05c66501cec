"""Wrong answers to antialiasing, written without a look at the checks."""


def opposite_vertices(faces):
    """the face's own vertex k is returned, not the third vertex of the face across the edge

    told by: own vertex | own third | itself | own face | other face | same face
    """
    owner_of = {}
    for f, face in enumerate(faces):
        for k in range(3):
            key = tuple(sorted((face[(k + 1) % 3], face[(k + 2) % 3])))
            owner_of.setdefault(key, []).append((f, face[k]))
    opposite = np.full(faces.shape, -1)
    for f, face in enumerate(faces):
        for k in range(3):
            key = tuple(sorted((face[(k + 1) % 3], face[(k + 2) % 3])))
            if len(owner_of[key]) > 1:
                opposite[f, k] = face[k]
    return opposite


def opposite_vertices(faces):
    """edge k is taken to start at vertex k, joining k and k + 1, instead of lying across from it

    told by: starts at | edge k & k + 1 | wrong column | cyclic | opposite to vertex k | rolled
    """
    third_of = {}
    for face in faces.tolist():
        for k in range(3):
            key = frozenset((face[k], face[(k + 1) % 3]))
            third_of.setdefault(key, []).append(face[(k + 2) % 3])
    opposite = np.full(faces.shape, -1)
    for f, face in enumerate(faces.tolist()):
        for k in range(3):
            key = frozenset((face[k], face[(k + 1) % 3]))
            for v in third_of[key]:
                if v != face[(k + 2) % 3]:
                    opposite[f, k] = v
                    break
    return opposite


def opposite_vertices(faces):
    """only neighbours that wind the same way are found: the edge is looked up in reverse order only

    told by: wind | wound | either way | reverse | orient | direction & edge
    """
    across = {}
    for a, b, c in faces.tolist():
        if a == b or b == c or c == a:
            continue
        across.setdefault((b, c), a)
        across.setdefault((c, a), b)
        across.setdefault((a, b), c)
    result = []
    for a, b, c in faces.tolist():
        if a == b or b == c or c == a:
            result.append([-1, -1, -1])
        else:
            result.append([across.get((c, b), -1), across.get((a, c), -1), across.get((b, a), -1)])
    return np.array(result).reshape(faces.shape)


def silhouette_edges(x, y, w, faces, opposite):
    """the test is reversed: an edge counts as a fold where the two vertices lie on different sides of it

    told by: revers | different sides | inverted | negat | other way round | opposite sides
    """
    result = opposite < 0
    for f, face in enumerate(faces):
        for k in range(3):
            v = opposite[f, k]
            if v < 0:
                continue
            a, b = face[(k + 1) % 3], face[(k + 2) % 3]

            def area(p):
                e = (x[b] - x[a]) * (y[p] - y[a]) - (y[b] - y[a]) * (x[p] - x[a])
                return e * np.sign(w[a] * w[b] * w[p])

            result[f, k] = (area(v) < 0) != (area(face[k]) < 0)
    return result


def silhouette_edges(x, y, w, faces, opposite):
    """corners behind the camera are not taken as mirrored: w is ignored (fine print)

    told by: behind the camera | w < 0 | mirror | w is ignored | negative w | sign of w
    """
    def side(i, j, p):
        return (x[j] - x[i]) * (y[p] - y[i]) - (y[j] - y[i]) * (x[p] - x[i])

    result = opposite < 0
    for k, (i, j) in enumerate(EDGES):
        a, b = faces[:, i], faces[:, j]
        result[:, k] |= (side(a, b, faces[:, k]) < 0) == (side(a, b, opposite[:, k]) < 0)
    return result


def neighbour_pairs(face_index, outlined):
    """the last pixel of a row is paired with the first of the next row

    told by: end of a row | next row | last column | wrap | row's end | end of the row
    """
    width = face_index.shape[1]
    f, o = face_index.ravel(), outlined.ravel()
    pairs = []
    for step in (1, width):
        first = np.flatnonzero((f[:-step] != f[step:]) & (o[:-step] | o[step:]))
        pairs.append((first, first + step))
    return np.concatenate([p[0] for p in pairs]), np.concatenate([p[1] for p in pairs])


def neighbour_pairs(face_index, outlined):
    """pairs with the background are left out, where one pixel sees no face

    told by: background | no face | sees nothing | face_index >= 0 | -1 & left out
    """
    h, width = face_index.shape
    horizontal, vertical = [], []
    for i in range(h):
        for j in range(width):
            for pairs, di, dj in ((horizontal, 0, 1), (vertical, 1, 0)):
                if i + di < h and j + dj < width:
                    a, b = face_index[i, j], face_index[i + di, j + dj]
                    if a != b and a >= 0 and b >= 0 and (outlined[i, j] or outlined[i + di, j + dj]):
                        pairs.append((i * width + j, (i + di) * width + j + dj))
    first, second = np.array(horizontal + vertical, int).reshape(-1, 2).T
    return first, second


def pair_frame(screen_x, screen_y, owner, other, width):
    """y is multiplied by s, too: the frame is rotated rather than mirrored

    told by: sign of y | y by s | y is negat | y is mirror | rotat | y is flipped
    """
    dx, dy = pair_step(owner, other, width)
    row, column = np.divmod(owner, width)
    x, y = screen_x - (column + 0.5), screen_y - (row + 0.5)
    return dx * x + dy * y, dy * x + dx * y


def pair_frame_backward(grad_x, grad_y, owner, other, width):
    """the forward matrix instead of its transpose: for pixels above each other the sign goes to the wrong one of x and y

    told by: transpos | forward matrix | above each other | sign & vertical | swapped | exchanged
    """
    dx, dy = pair_step(owner, other, width)
    return dx * grad_x + dy * grad_y, np.abs(dy) * grad_x + np.abs(dx) * grad_y


def crossing(x0, y0, x1, y1):
    """the crossing with x = 0 is computed: x and y are exchanged

    told by: x = 0 | x and y | x and y & exchanged | x and y & swapped | y axis | y-axis
    """
    return y0 - x0 * (y1 - y0) / (x1 - x0)


def crossing(x0, y0, x1, y1):
    """the sign of the second term: + y0 instead of - y0

    told by: sign | plus | minus | + y0 | added | negated
    """
    t = y0 / (y1 - y0)
    return x0 + t * (x1 - x0)


def crossing(x0, y0, x1, y1):
    """the slope is upside down: dy / dx instead of dx / dy

    told by: slope | upside down | inverted | reciprocal | dy / dx
    """
    slope = (y1 - y0) / (x1 - x0)
    return x0 - y0 * slope


def crossing(x0, y0, x1, y1):
    """the crossing is clipped to the edge's extent, though the line through both ends is meant

    told by: clip | extent | line through | beyond | segment | between the ends
    """
    c = x0 - y0 * (x1 - x0) / (y1 - y0)
    return np.clip(c, np.minimum(x0, x1), np.maximum(x0, x1))


def crossing(x0, y0, x1, y1):
    """always measured from end 0, even where end 1 is nearer to y = 0, so that digits are lost (fine print)

    told by: nearer | digits | far end | infinity | precision | cancel
    """
    return x0 + (0 - y0) / (y1 - y0) * (x1 - x0)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """dc/dy0 leaves out that y0 is in the denominator, too: the quotient rule is not applied

    told by: quotient | denominator | product rule | depends on y0 | y1 - y0
    """
    h = y1 - y0
    r = 1 / (h + np.copysign(epsilon, h))
    slope = (x1 - x0) * r
    return (grad_c * y1 * r, -grad_c * slope, -grad_c * y0 * r,
            grad_c * y0 * slope * r)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """the gradients of the other end have the wrong sign: r does not become -r

    told by: become -r | sign & end | sign & x1 | sign & y1 | r becomes -r
    """
    h = y1 - y0
    r = 1 / (h + np.copysign(epsilon, h))
    c = (x0 * y1 - x1 * y0) * r
    k = grad_c * r
    return k * y1, k * (c - x1), k * y0, k * (c - x0)


def last_crossing(x, y, w):
    """the least c counts instead of the greatest: the line enters there

    told by: least | smallest | enters | greatest | minimum | first crossing
    """
    above = y * w
    best_edge = np.zeros(x.shape[1], int)
    best = np.full(x.shape[1], -np.inf)
    for n in range(x.shape[1]):
        for k, (i, j) in enumerate(EDGES):
            if (above[i, n] < 0) == (above[j, n] < 0):
                continue
            if w[i, n] * abs(above[j, n]) + w[j, n] * abs(above[i, n]) <= 0:
                continue
            c = crossing(x[i, n], y[i, n], x[j, n], y[j, n])
            if best[n] == -np.inf or c < best[n]:
                best[n], best_edge[n] = c, k
    return best_edge, best


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    """steep is taken the wrong way: edges at least as long in x as in y

    told by: steep | long in x | x and y | flat | slope
    """
    flat = np.abs(x1 - x0) >= np.abs(y1 - y0)
    return is_silhouette & flat & (c > -WINDOW) & (c < 1 + WINDOW)


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    """the WINDOW is left out: c must lie between 0 and 1

    told by: WINDOW | tolerance | slightly outside | 1/16 | margin | just outside
    """
    steep = np.abs(y1 - y0) >= np.abs(x1 - x0)
    between = (c >= 0) & (c <= 1)
    return is_silhouette & steep & between


def blend_weight(c):
    """c is not clipped to [0, 1] (fine print)

    told by: clip | clamp | outside | saturat | beyond | more than half
    """
    return 0.5 - c


def blend_weight(c):
    """the sign is flipped: c - 1/2

    told by: sign | minus | c - 1/2 | negat | c - 0.5
    """
    return np.clip(c, 0.0, 1.0) - 0.5


def blend_weight(c):
    """the constant is 1, not 1/2: alpha = 1 - c

    told by: 1 - c | 1/2 | 0.5 | half | constant
    """
    return 1 - np.clip(c, 0, 1)


def blend_weight(c):
    """the absolute value is returned: |1/2 - c|

    told by: absolute | abs( | sign | negative | positive
    """
    clipped = np.minimum(np.maximum(c, 0), 1)
    return np.abs(0.5 - clipped)


def blend(colour, owner, other, alpha):
    """+= with an index array: a pixel in several pairs keeps only one change

    told by: several pairs | twice | np.add.at | more than once | repeated | several times
    """
    pixels = np.asarray(colour, float).reshape(-1, colour.shape[-1])
    out = pixels.copy()
    target = np.where(alpha > 0, owner, other)
    out[target] += alpha[:, None] * (pixels[other] - pixels[owner])
    return out.reshape(colour.shape)


def blend(colour, owner, other, alpha):
    """only the owner is ever changed, whatever the sign of alpha

    told by: only the owner | always the owner | alpha <= 0 | negative alpha | alpha < 0 | other & never
    """
    flat = np.asarray(colour, float).reshape(-1, colour.shape[-1])
    result = flat.copy()
    np.add.at(result, owner, alpha[:, None] * (flat[other] - flat[owner]))
    return result.reshape(colour.shape)


def blend(colour, owner, other, alpha):
    """the result is written into the input colour

    told by: input | in place | in-place | argument | changes colour | copy
    """
    pixels = colour.reshape(-1, colour.shape[-1])
    before = pixels.copy()
    changed = np.where(alpha > 0, owner, other)
    np.add.at(pixels, changed, alpha[:, None] * (before[other] - before[owner]))
    return colour


def blend_backward(grad_output, colour, owner, other, alpha):
    """at alpha = 0 the other pixel's side of the kink is taken instead of the owner's (fine print)

    told by: alpha = 0 | kink | alpha >= 0 | alpha is 0 | > for >= | alpha == 0
    """
    flat = np.asarray(colour, float).reshape(-1, colour.shape[-1])
    g = np.asarray(grad_output, float).reshape(flat.shape)
    grad_colour = g.copy()
    grad_alpha = np.zeros(len(alpha))
    for n, (p, q, a) in enumerate(zip(owner, other, alpha)):
        up = g[p] if a > 0 else g[q]
        grad_alpha[n] = up @ (flat[q] - flat[p])
        grad_colour[p] -= a * up
        grad_colour[q] += a * up
    return grad_colour.reshape(colour.shape), grad_alpha


def blend_backward(grad_output, colour, owner, other, alpha):
    """the owner's gradient is always used, even where alpha < 0 and the other pixel is the one that changes

    told by: only the owner | always the owner | always used | alpha < 0 | negative alpha | pixel that changes
    """
    flat = np.asarray(colour, float).reshape(-1, colour.shape[-1])
    g = np.asarray(grad_output, float).reshape(flat.shape)
    up = g[owner]
    grad_alpha = np.einsum("nc,nc->n", up, flat[other] - flat[owner])
    grad = g.copy()
    np.add.at(grad, owner, -alpha[:, None] * up)
    np.add.at(grad, other, alpha[:, None] * up)
    return grad.reshape(colour.shape), grad_alpha


def blend_backward(grad_output, colour, owner, other, alpha):
    """the share of the neighbour is left out: alpha grad is taken from the changed pixel, but not given to the other one

    told by: share of the neighbour | given to the other | not passed to | only the changed | other & missing | other & left out
    """
    flat = np.asarray(colour, float).reshape(-1, colour.shape[-1])
    g = np.asarray(grad_output, float).reshape(flat.shape)
    up = g[np.where(alpha >= 0, owner, other)]
    grad_alpha = (up * (flat[other] - flat[owner])).sum(1)
    grad = g.copy()
    changed = np.where(alpha >= 0, owner, other)
    np.add.at(grad, changed, -np.abs(alpha)[:, None] * up)
    return grad.reshape(colour.shape), grad_alpha
