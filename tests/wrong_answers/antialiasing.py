"""Wrong answers to antialiasing, written without a look at the checks."""


def opposite_vertices(faces):
    """edge k is taken to run from vertex k to the next one, not opposite to vertex k

    told by: edge & opposite | edge k & vertex k | column & shift | edge & start | edge & number | edge & order | rotated | cycl
    """
    around = {}
    for f, face in enumerate(faces):
        for k in range(3):
            a, b, third = face[k], face[(k + 1) % 3], face[(k + 2) % 3]
            around.setdefault(frozenset((a, b)), []).append((f, k, third))
    across = np.full(faces.shape, -1)
    for users in around.values():
        if len(users) == 2:
            (f, k, p), (g, l, q) = users
            if p != q:
                across[f, k], across[g, l] = q, p
    return across


def opposite_vertices(faces):
    """it returns the number of the neighbouring face, not of that face's third vertex

    told by: number & face | index & face | face & instead | face, not | face & neighbour & vertex
    """
    across = np.full(faces.shape, -1)
    known = {}
    for f, face in enumerate(faces):
        for k, (i, j) in enumerate(EDGES):
            pair = tuple(sorted((face[i], face[j])))
            if pair in known:
                g, l = known[pair]
                across[f, k] = g
                across[g, l] = f
            else:
                known[pair] = f, k
    return across


def opposite_vertices(faces):
    """a neighbour is only found if it is wound the same way, so that it walks the edge backwards

    told by: wound | winding | direct & edge | either way | orient | backward & edge | same direction
    """
    third = {}
    for face in faces:
        for k, (i, j) in enumerate(EDGES):
            third.setdefault((face[i], face[j]), face[k])
    across = np.full(faces.shape, -1)
    for f, face in enumerate(faces):
        for k, (i, j) in enumerate(EDGES):
            vertex = third.get((face[j], face[i]), -1)
            if vertex != face[k]:
                across[f, k] = vertex
    return across


def silhouette_edges(x, y, w, faces, opposite):
    """it marks the inner edges where the two vertices lie on different sides, which is where it does not fold

    told by: different sides | invert | flat | same side & fold | one side & fold | do not fold | does not fold | revers | other way round | negat | exactly the others
    """
    at = np.column_stack([x, y])
    side = np.sign(w)
    result = np.zeros(faces.shape, bool)
    for k, (i, j) in enumerate(EDGES):
        a, b, own, far = faces[:, i], faces[:, j], faces[:, k], opposite[:, k]
        mine = edge_function(at[own], at[a], at[b]) * side[own] * side[a] * side[b] < 0
        yours = edge_function(at[far], at[a], at[b]) * side[far] * side[a] * side[b] < 0
        result[:, k] = (mine != yours) | (far == -1)
    return result


def silhouette_edges(x, y, w, faces, opposite):
    """edges without a face across are not marked: -1 is used as the number of the last vertex

    told by: -1 | no face across | border | boundary | surface & end | last vertex | without & neighbour | opposite < 0
    """
    points = np.stack([x, y], 1)
    sides = np.sign(w)

    def turns_right(p, a, b):
        return edge_function(points[p], points[a], points[b]) * sides[p] * sides[a] * sides[b] < 0

    columns = []
    for k in range(3):
        i, j = EDGES[k]
        a, b = faces[:, i], faces[:, j]
        columns.append(turns_right(faces[:, k], a, b) == turns_right(opposite[:, k], a, b))
    return np.stack(columns, 1)


def silhouette_edges(x, y, w, faces, opposite):
    """every face is taken as counter-clockwise: only the side of the vertex across is looked at, not that of vertex k

    told by: clockwise | winding | wound | back face | back-fac | own side | orient | face's side | seen from behind
    """
    points, flip = np.stack([x, y], -1), np.sign(w)
    fold = []
    for k, (i, j) in enumerate(EDGES):
        p, a, b = opposite[:, k], faces[:, i], faces[:, j]
        left = edge_function(points[p], points[a], points[b]) * flip[p] * flip[a] * flip[b] >= 0
        fold.append(left)
    return np.stack(fold, -1) | (opposite < 0)


def neighbour_pairs(face_index, outlined):
    """both pixels of a pair must be outlined, although one is enough

    told by: both & outlined | one & outlined | either & outlined | at least one
    """
    height, width = face_index.shape
    number = np.arange(height * width).reshape(height, width)
    right = (face_index[:, :-1] != face_index[:, 1:]) & outlined[:, :-1] & outlined[:, 1:]
    above = (face_index[:-1] != face_index[1:]) & outlined[:-1] & outlined[1:]
    first = np.concatenate([number[:, :-1][right], number[:-1][above]])
    second = np.concatenate([number[:, 1:][right], number[1:][above]])
    return first, second


def pair_frame(screen_x, screen_y, owner, other, width):
    """it measures from the pixel's corner, not from its centre: the half pixel is missing

    told by: centre | 0.5 | half | 1/2 | corner & pixel
    """
    dx, dy = pair_step(owner, other, width)
    u = screen_x - owner % width
    v = screen_y - owner // width
    along = np.where(dx != 0, dx * u, dy * v)
    beside = np.where(dx != 0, v, u)
    return along, beside


def pair_frame_backward(grad_x, grad_y, owner, other, width):
    """it applies the forward matrix instead of its transpose, which differs where the other pixel is below

    told by: transpos | forward | below | dy = -1 | dy & negative | vertical & sign | above each other
    """
    dx, dy = pair_step(owner, other, width)
    return dx * grad_x + dy * grad_y, abs(dy) * grad_x + abs(dx) * grad_y


def crossing(x0, y0, x1, y1):
    """it starts from x1 but goes by y0: the two ends are mixed up

    told by: two ends | ends & mixed | ends & swap | wrong end | end 1 & end 0 | x1 & y0 | x1 & x0 & instead | other end | start & end | x1 for x0
    """
    return x1 - y0 * (x1 - x0) / (y1 - y0)


def crossing(x0, y0, x1, y1):
    """the slope is upside down: (y1 - y0) / (x1 - x0)

    told by: upside down | invert | recipro | slope & dy / dx | flipped | numerator & denominator | (y1 - y0) / (x1 - x0)
    """
    slope = (y1 - y0) / (x1 - x0)
    return x0 - slope * y0


def crossing(x0, y0, x1, y1):
    """it is where the line meets x = 0, not y = 0

    told by: x = 0 | x and y | y-axis | y axis | axes
    """
    t = x0 / (x0 - x1)
    return y0 + t * (y1 - y0)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """grad_y0 leaves out that y0 is also in the denominator y1 - y0

    told by: denominator | divisor | quotient | y0 & twice | y1 - y0 & y0 | height & constant | second place
    """
    h = y1 - y0
    r = 1 / (h + np.copysign(epsilon, h))
    c = (x0 * y1 - x1 * y0) * r
    by_x0 = grad_c * y1 * r
    by_x1 = -grad_c * y0 * r
    by_y0 = -grad_c * (x1 - x0) * r
    by_y1 = grad_c * (x0 - c) * r
    return by_x0, by_y0, by_x1, by_y1


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """the results come in the order x0, x1, y0, y1 instead of x0, y0, x1, y1

    told by: order | swap | exchang | mixed up | permut | second & third | x0, x1, y0, y1
    """
    h = y1 - y0
    r = 1 / (h + np.copysign(epsilon, h))
    c = r * (x0 * y1 - x1 * y0)
    grad_x0, grad_x1 = grad_c * r * y1, grad_c * -r * y0
    grad_y0, grad_y1 = grad_c * r * (c - x1), grad_c * -r * (c - x0)
    return grad_x0, grad_x1, grad_y0, grad_y1


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """grad_x1 has the wrong sign: r was not turned into -r for this end

    told by: grad_x1 & sign | grad_x1 & minus | grad_x1 & negat | x1 & -r | r becomes -r | grad_x1 & opposite | x1 & sign
    """
    h = y1 - y0
    k = grad_c / (h + np.copysign(epsilon, h))
    c = (x0 * y1 - x1 * y0) / (h + np.copysign(epsilon, h))
    return k * y1, k * (c - x1), k * y0, -k * (c - x0)


def last_crossing(x, y, w):
    """it takes the first crossing, the one with the least c, not the last

    told by: least c | least & greatest | smallest | first crossing | argmin | minimum | greatest | enters | nearest & owner
    """
    up = y * w
    where = np.full(x.shape, np.inf)
    for k, (i, j) in enumerate(EDGES):
        hit = (up[i] < 0) ^ (up[j] < 0)
        hit &= w[i] * abs(up[j]) + w[j] * abs(up[i]) > 0
        where[k, hit] = crossing(x[i, hit], y[i, hit], x[j, hit], y[j, hit])
    edge = np.argmin(where, 0)
    c = where.min(0)
    return edge, np.where(np.isinf(c), -np.inf, c)


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    """the comparison is the wrong way round: it keeps the flat edges, not the steep ones

    told by: flat | steep | longer in x | as long in y | shallow | comparison
    """
    wide, high = abs(x1 - x0), abs(y1 - y0)
    return is_silhouette & (wide >= high) & (-WINDOW < c) & (c < 1 + WINDOW)


def blend_weight(c):
    """the sign is wrong: c - 1/2 instead of 1/2 - c

    told by: sign | minus | negat | c - 1/2 | c - 0.5 | opposite
    """
    return np.clip(c, 0, 1) - 0.5


def blend_weight(c):
    """negative weights are clipped to 0, so only the owner is ever blended

    told by: negative | below 0 | 0 & c > | clip & alpha | never & other | c & above & half | less than 0
    """
    return np.clip(0.5 - c, 0, 0.5)


def blend_weight(c):
    """fine print: c is not clipped to [0, 1]

    told by: clip | outside | clamp | more than half | limit | [0, 1] | beyond
    """
    return 0.5 - c


def blend(colour, owner, other, alpha):
    """a pixel in several pairs keeps only one change, as output[changed] += adds only once for each index

    told by: several pairs | only one & change | add.at | repeated | add up | last & pair | more than one pair | accumul | overwrit
    """
    flat = colour.reshape(-1, colour.shape[-1]).astype(float)
    result = flat.copy()
    changed = np.where(alpha > 0, owner, other)
    result[changed] += alpha[:, None] * (flat[other] - flat[owner])
    return result.reshape(colour.shape)


def blend(colour, owner, other, alpha):
    """later pairs read colours that earlier pairs have already blended

    told by: already | before any | read & output | in place | one after | earlier | sequen | reads & blended
    """
    result = colour.reshape(-1, colour.shape[-1]).astype(float)
    for p, q, t in zip(owner, other, alpha):
        step = t * (result[q] - result[p])
        if t > 0:
            result[p] += step
        else:
            result[q] += step
    return result.reshape(colour.shape)


def blend(colour, owner, other, alpha):
    """where alpha <= 0 the other pixel gets alpha (owner - other), which moves its colour away from the owner's

    told by: owner - other | away | alpha & sign | negative & sign | opposite direction | other & sign | negative alpha & minus
    """
    flat = np.array(colour, dtype=float).reshape(-1, colour.shape[-1])
    change = np.zeros_like(flat)
    for n in range(len(alpha)):
        p, q = owner[n], other[n]
        if alpha[n] > 0:
            change[p] += alpha[n] * (flat[q] - flat[p])
        else:
            change[q] += alpha[n] * (flat[p] - flat[q])
    return (flat + change).reshape(colour.shape)


def blend_backward(grad_output, colour, owner, other, alpha):
    """grad_colour lacks grad_output itself: each pixel also keeps its own colour in the output

    told by: grad_output itself | identity | own colour | starts from 0 | starts at 0 | unblended | in no pair | not blended | without pairs | lacks grad_output | grad_output & miss
    """
    c = colour.shape[-1]
    flat = np.array(colour, float).reshape(-1, c)
    g = np.array(grad_output, float).reshape(-1, c)
    at_changed = g[np.where(alpha >= 0, owner, other)]
    grad_alpha = np.einsum("nc,nc->n", at_changed, flat[other] - flat[owner])
    grad_colour = np.zeros_like(flat)
    np.add.at(grad_colour, owner, -alpha[:, None] * at_changed)
    np.add.at(grad_colour, other, alpha[:, None] * at_changed)
    return grad_colour.reshape(colour.shape), grad_alpha


def blend_backward(grad_output, colour, owner, other, alpha):
    """it always takes the gradient at the owner, although the other pixel changes where alpha is negative

    told by: always & owner | alpha & negative | other pixel changes | alpha < 0 | changed & owner | sign of alpha | other & instead
    """
    pixels = np.asarray(colour, float).reshape(-1, colour.shape[-1])
    grads = np.asarray(grad_output, float).reshape(pixels.shape)
    grad_pixels = grads.copy()
    grad_alpha = np.zeros(len(alpha))
    for n, (p, q, t) in enumerate(zip(owner, other, alpha)):
        g = grads[p]
        grad_alpha[n] = g @ (pixels[q] - pixels[p])
        grad_pixels[p] -= t * g
        grad_pixels[q] += t * g
    return grad_pixels.reshape(colour.shape), grad_alpha


def blend_backward(grad_output, colour, owner, other, alpha):
    """grad_alpha is the mean over the channels, not the sum

    told by: mean | average | channel | number of colours | divi & C
    """
    c = colour.shape[-1]
    flat = np.array(colour, float).reshape(-1, c)
    g = np.array(grad_output, float).reshape(-1, c)
    at_changed = g[np.where(alpha >= 0, owner, other)]
    moved = alpha[:, None] * at_changed
    result = g.copy()
    np.subtract.at(result, owner, moved)
    np.add.at(result, other, moved)
    return result.reshape(colour.shape), ((flat[other] - flat[owner]) * at_changed).mean(-1)


def opposite_vertices(faces):
    """the number of the neighbouring face is returned, not that face's third vertex

    told by: number of the face | face's number | faces, not vertices | face index | neighbouring face | index of the face
    """
    lists = {}
    for f, face in enumerate(faces.tolist()):
        for k in range(3):
            lists.setdefault(frozenset(face[:k] + face[k + 1:]), []).append(f)
    opposite = np.full(faces.shape, -1)
    for f, face in enumerate(faces.tolist()):
        for k in range(3):
            for g in lists[frozenset(face[:k] + face[k + 1:])]:
                if g != f:
                    opposite[f, k] = g
    return opposite


def opposite_vertices(faces):
    """edges without a neighbour get 0 instead of -1, which is a vertex

    told by: 0 instead of -1 | 0, not -1 | 0 & border | border & -1 | -1 & without | boundary & -1
    """
    third_at = {}
    for a, b, c in faces:
        for p, q, t in ((b, c, a), (c, a, b), (a, b, c)):
            third_at.setdefault((min(p, q), max(p, q)), []).append(t)
    out = np.zeros_like(faces)
    for n, (a, b, c) in enumerate(faces):
        for k, (p, q, t) in enumerate(((b, c, a), (c, a, b), (a, b, c))):
            others = [v for v in third_at[min(p, q), max(p, q)] if v != t]
            if others:
                out[n, k] = others[0]
    return out


def opposite_vertices(faces):
    """where three faces meet at an edge the last other one counts, not the first (fine print)

    told by: three faces | more than two | non-manifold | third face | several faces
    """
    sound = [len(set(face)) == 3 for face in faces.tolist()]
    thirds = {}
    for ok, face in zip(sound, faces.tolist()):
        if ok:
            for k in range(3):
                thirds.setdefault(frozenset(face) - {face[k]}, []).append(face[k])
    opposite = np.full(faces.shape, -1)
    for f, face in enumerate(faces.tolist()):
        for k in range(3):
            if sound[f]:
                for v in thirds[frozenset(face) - {face[k]}]:
                    if v != face[k]:
                        opposite[f, k] = v
    return opposite


def silhouette_edges(x, y, w, faces, opposite):
    """edges without a face across are no silhouettes: -1 is used as an index of the last vertex

    told by: -1 & index | last vertex | border | boundary | no face across | surface ends
    """
    s = np.sign(w)

    def clockwise(a, b, c):
        e = (x[b] - x[a]) * (y[c] - y[a]) - (y[b] - y[a]) * (x[c] - x[a])
        return e * s[a] * s[b] * s[c] < 0

    own = clockwise(*faces.T)
    columns = []
    for k, (i, j) in enumerate(EDGES):
        columns.append(clockwise(faces[:, i], faces[:, j], opposite[:, k]) == own)
    return np.stack(columns, 1)


def silhouette_edges(x, y, w, faces, opposite):
    """only edges where the surface ends count, the folds are left out

    told by: fold | only & border | only & boundary | only & surface ends | only & no face
    """
    result = np.zeros(faces.shape, bool)
    for f in range(len(faces)):
        for k in range(3):
            result[f, k] = opposite[f, k] == -1
    return result


def silhouette_edges(x, y, w, faces, opposite):
    """only counter-clockwise faces get silhouettes, the edges of clockwise ones are left out

    told by: counter-clockwise & only | front | back-facing | back face | clockwise faces | facing
    """
    s = np.sign(w)
    p = np.stack([x, y], -1)

    def ccw(a, b, c):
        return edge_function(p[a], p[b], p[c]) * s[a] * s[b] * s[c] >= 0

    own = ccw(*faces.T)
    result = np.zeros(faces.shape, bool)
    for k, (i, j) in enumerate(EDGES):
        turned = ccw(opposite[:, k], faces[:, i], faces[:, j])
        result[:, k] = own & (turned | (opposite[:, k] < 0))
    return result


def silhouette_edges(x, y, w, faces, opposite):
    """edge k is taken to join vertices k and k + 1, so that the answers stand in the wrong column

    told by: wrong column | edge k & k + 1 | starts at | cyclic | opposite to vertex k | which edge
    """
    sgn = np.sign(w)
    points = np.column_stack([x, y])

    def turns_right(a, b, c):
        return edge_function(points[a], points[b], points[c]) * sgn[a] * sgn[b] * sgn[c] < 0

    result = opposite < 0
    own = turns_right(faces[:, 0], faces[:, 1], faces[:, 2])
    for k in range(3):
        start, end = faces[:, k], faces[:, (k + 1) % 3]
        result[:, k] |= turns_right(start, end, opposite[:, k]) == own
    return result


def neighbour_pairs(face_index, outlined):
    """both pixels of a pair must be outlined, where one is enough

    told by: both | one is enough | at least one | and & or | either
    """
    h, width = face_index.shape
    number = np.arange(h * width).reshape(h, width)
    lr = (face_index[:, :-1] != face_index[:, 1:]) & outlined[:, :-1] & outlined[:, 1:]
    ud = (face_index[:-1] != face_index[1:]) & outlined[:-1] & outlined[1:]
    first = np.concatenate([number[:, :-1][lr], number[:-1][ud]])
    second = np.concatenate([number[:, 1:][lr], number[1:][ud]])
    return first, second


def pair_frame(screen_x, screen_y, owner, other, width):
    """pixel centres are taken at whole numbers: the half pixel is missing

    told by: half | 0.5 | centre | center | 1/2
    """
    dx, dy = pair_step(owner, other, width)
    x = screen_x - owner % width
    y = screen_y - owner // width
    return dx * x + dy * y, np.abs(dy) * x + np.abs(dx) * y


def pair_frame(screen_x, screen_y, owner, other, width):
    """x is always along screen x: for pixels above each other x and y do not change places

    told by: above each other | change places | vertical | exchanged | upper | swapped
    """
    dx, dy = pair_step(owner, other, width)
    s = np.where(owner < other, 1, -1)
    centre_x, centre_y = owner % width + 0.5, owner // width + 0.5
    return s * (screen_x - centre_x), screen_y - centre_y


def pair_frame_backward(grad_x, grad_y, owner, other, width):
    """the sign s is left out, so that pairs whose other pixel comes first have the wrong sign

    told by: sign | sign s | s = -1 | comes before | comes first | negat
    """
    dx, dy = pair_step(owner, other, width)
    beside = np.abs(dx) > 0
    return np.where(beside, grad_x, grad_y), np.where(beside, grad_y, grad_x)


def crossing(x0, y0, x1, y1):
    """the fraction along the edge is returned, not the x where it crosses

    told by: fraction | along the edge | parameter | not the x | from 0 to 1
    """
    return y0 / (y0 - y1)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """the order of the outputs: both x, then both y, instead of x0, y0, x1, y1

    told by: order & output | order & results | grad_x0, grad_x1 | exchanged | swapped | order & gradients
    """
    h = y1 - y0
    r = 1 / (h + np.copysign(epsilon, h))
    c = (x0 * y1 - x1 * y0) * r
    g = grad_c * r
    return g * y1, -g * y0, g * (c - x1), g * (x0 - c)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """epsilon is added without h's sign, so that with h < 0 it makes 1 / h larger (fine print)

    told by: epsilon & sign | copysign | h < 0 | epsilon & negative | sign of h | h's sign
    """
    r = 1 / (y1 - y0 + epsilon)
    c = (x0 * y1 - x1 * y0) * r
    return grad_c * r * y1, grad_c * r * (c - x1), -grad_c * r * y0, grad_c * r * (x0 - c)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """grad_c is forgotten in the gradients of the ys

    told by: grad_c | chain rule | incoming | upstream | times grad | grad_y0 & multiplied
    """
    h = y1 - y0
    r = 1 / (h + np.copysign(epsilon, h))
    c = (x0 * y1 - x1 * y0) * r
    return grad_c * r * y1, r * (c - x1), -grad_c * r * y0, r * (x0 - c)


def last_crossing(x, y, w):
    """w is ignored: corners behind the camera are not taken as mirrored (fine print)

    told by: behind the camera | w < 0 | mirror | w is ignored | negative w | y w
    """
    c = np.full(x.shape, -np.inf)
    for k, (i, j) in enumerate(EDGES):
        crosses = (y[i] < 0) != (y[j] < 0)
        c[k, crosses] = crossing(x[i, crosses], y[i, crosses], x[j, crosses], y[j, crosses])
    edge = np.argmax(c, axis=0)
    return edge, c.max(0)


def last_crossing(x, y, w):
    """the edge is numbered by its first corner: edge k joins corners k and k + 1 instead of lying opposite to corner k

    told by: numbered | opposite to corner | first corner | k + 1 | edge number | which edge
    """
    above = y * w
    c = np.full(x.shape, -np.inf)
    for k in range(3):
        i, j = k, (k + 1) % 3
        crosses = (above[i] < 0) != (above[j] < 0)
        crosses &= w[i] * np.abs(above[j]) + w[j] * np.abs(above[i]) > 0
        c[k, crosses] = crossing(x[i][crosses], y[i][crosses], x[j][crosses], y[j][crosses])
    edge = c.argmax(0)
    return edge, c[edge, np.arange(len(edge))]


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    """no absolute values: only edges that run upwards are steep

    told by: absolute | abs( | upward | downward | direction | run up | without abs
    """
    steep = (y1 - y0) >= (x1 - x0)
    return is_silhouette & steep & (-WINDOW < c) & (c < 1 + WINDOW)


def blend_weight(c):
    """alpha instead of c is clipped to [0, 1], so that it never becomes negative

    told by: clip & alpha | becomes negative | never negative | instead of c | clamp & alpha | c > 1/2
    """
    return np.clip(0.5 - c, 0, 1)


def blend(colour, owner, other, alpha):
    """the blends are done one after another and read colours that are already blended

    told by: already blended | one after another | before any blend | already changed | sequential | from before
    """
    out = np.array(colour, float).reshape(-1, colour.shape[-1])
    for p, q, a in zip(owner, other, alpha):
        change = a * (out[q] - out[p])
        if a > 0:
            out[p] += change
        else:
            out[q] += change
    return out.reshape(colour.shape)


def blend(colour, owner, other, alpha):
    """the wrong pixel is changed: other where alpha > 0, owner otherwise

    told by: wrong pixel | exchanged | swapped | other way round | which pixel | owner & other & changed | wrong one of the two
    """
    pixels = np.asarray(colour, float).reshape(-1, colour.shape[-1])
    out = pixels.copy()
    changed = np.where(alpha > 0, other, owner)
    np.add.at(out, changed, alpha[:, None] * (pixels[other] - pixels[owner]))
    return out.reshape(colour.shape)


def blend(colour, owner, other, alpha):
    """for alpha <= 0 the difference is turned round, owner - other, though the minus is in alpha already

    told by: difference | owner - other | away from | alpha <= 0 & sign | alpha < 0 & sign | negative alpha
    """
    pixels = np.asarray(colour, float).reshape(-1, colour.shape[-1])
    out = pixels.copy()
    for n in range(len(alpha)):
        p, q = owner[n], other[n]
        if alpha[n] > 0:
            out[p] += alpha[n] * (pixels[q] - pixels[p])
        else:
            out[q] += alpha[n] * (pixels[p] - pixels[q])
    return out.reshape(colour.shape)


def blend_backward(grad_output, colour, owner, other, alpha):
    """grad_colour lacks the identity: the picture's own gradient is not passed through

    told by: identity | own gradient | passed through | starts from 0 | starts with | grad_output & missing | own colour & left out
    """
    flat = colour.reshape(-1, colour.shape[-1]).astype(float)
    g = grad_output.reshape(flat.shape)
    changed = g[np.where(alpha >= 0, owner, other)]
    grad_colour = np.zeros(flat.shape)
    np.add.at(grad_colour, owner, -alpha[:, None] * changed)
    np.add.at(grad_colour, other, alpha[:, None] * changed)
    return grad_colour.reshape(colour.shape), (changed * (flat[other] - flat[owner])).sum(1)


def blend_backward(grad_output, colour, owner, other, alpha):
    """a pixel in several pairs gets the gradient of one only, for += with an index array

    told by: several pairs | twice | np.add.at | more than once | repeated | several times
    """
    flat = colour.reshape(-1, colour.shape[-1]).astype(float)
    g = grad_output.reshape(flat.shape)
    changed = g[np.where(alpha >= 0, owner, other)]
    grad_colour = g.astype(float)
    grad_colour[owner] -= alpha[:, None] * changed
    grad_colour[other] += alpha[:, None] * changed
    return grad_colour.reshape(colour.shape), np.sum(changed * (flat[other] - flat[owner]), axis=1)


def blend_backward(grad_output, colour, owner, other, alpha):
    """grad_alpha is the mean over the channels, not the sum

    told by: mean | channels | averag | not the sum
    """
    flat = np.asarray(colour, float).reshape(-1, colour.shape[-1])
    g = np.asarray(grad_output, float).reshape(flat.shape)
    changed = g[np.where(alpha >= 0, owner, other)]
    grad_colour = g.copy()
    np.add.at(grad_colour, owner, -alpha[:, None] * changed)
    np.add.at(grad_colour, other, alpha[:, None] * changed)
    return grad_colour.reshape(colour.shape), (changed * (flat[other] - flat[owner])).mean(-1)
