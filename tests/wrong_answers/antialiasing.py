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


def opposite_vertices(faces):
    """edges have a direction: the other face is found only if it runs along the edge the same way round, not backwards

    told by: direction | directed | same way | orient | wound | sorted | winding | backwards | reverse | from b to a
    """
    third = {}
    for f, face in enumerate(faces):
        for k, (i, j) in enumerate(EDGES):
            third.setdefault((face[i], face[j]), []).append((f, face[k]))
    answer = np.full(faces.shape, -1)
    for f, face in enumerate(faces):
        for k, (i, j) in enumerate(EDGES):
            for g, vertex in third[face[i], face[j]]:
                if g != f:
                    answer[f, k] = vertex
                    break
    return answer


def opposite_vertices(faces):
    """the number of the neighbouring face is returned, not its third vertex

    told by: number of the & face | face & instead of & vertex | face's number | faces, not | index of the & face | face & not its | neighbouring face
    """
    found = {}
    for f, face in enumerate(faces.tolist()):
        for i, j in EDGES:
            found.setdefault(frozenset((face[i], face[j])), []).append(f)
    answer = np.full(faces.shape, -1)
    for f, face in enumerate(faces.tolist()):
        for k, (i, j) in enumerate(EDGES):
            others = [g for g in found[frozenset((face[i], face[j]))] if g != f]
            if others:
                answer[f, k] = others[0]
    return answer


def silhouette_edges(x, y, w, faces, opposite):
    """an edge without a face across is no silhouette: -1 reads the last vertex

    told by: -1 | last vertex | no face across | border | boundary | open edge | surface ends | without a face
    """
    p = np.stack([x, y], 1)
    out = np.zeros(faces.shape, bool)
    for k, (i, j) in enumerate(EDGES):
        a, b = p[faces[:, i]], p[faces[:, j]]
        mine = edge_function(p[faces[:, k]], a, b) * np.prod(np.sign(w[faces]), 1)
        turned = np.sign(w[faces[:, i]] * w[faces[:, j]] * w[opposite[:, k]])
        theirs = edge_function(p[opposite[:, k]], a, b) * turned
        out[:, k] = (mine < 0) == (theirs < 0)
    return out


def silhouette_edges(x, y, w, faces, opposite):
    """the comparison is turned round: an edge folds if the vertices lie on different sides

    told by: turned round | different sides | other side | both sides | opposite sides | inverted | negated | reversed
    """
    p = np.stack([x, y], 1)
    out = opposite < 0
    mirrored = np.sign(w)
    for k, (i, j) in enumerate(EDGES):
        a, b = p[faces[:, i]], p[faces[:, j]]
        pair = mirrored[faces[:, i]] * mirrored[faces[:, j]]
        mine = edge_function(p[faces[:, k]], a, b) * pair * mirrored[faces[:, k]] < 0
        theirs = edge_function(p[opposite[:, k]], a, b) * pair * mirrored[opposite[:, k]] < 0
        out[:, k] |= mine != theirs
    return out


def neighbour_pairs(face_index, outlined):
    """pixels at the end of a row are paired with the first ones of the next row

    told by: end of a row | next row | row end | ends of rows | last column | last pixel of | across the row | first pixel | right border | wrap | end of the row
    """
    w = face_index.shape[1]
    face, line = face_index.ravel(), outlined.ravel()
    first, second = [], []
    for step in (1, w):
        for n in range(face.size - step):
            if face[n] != face[n + step] and (line[n] or line[n + step]):
                first.append(n)
                second.append(n + step)
    return np.array(first, int), np.array(second, int)


def pair_frame_backward(grad_x, grad_y, owner, other, width):
    """the sign s is left out: grad_x keeps its sign where the other pixel comes before the owner

    told by: sign | s = -1 | before the owner | minus | direction | negative | s & left out | s & missing
    """
    dx, _ = pair_step(owner, other, width)
    beside = dx != 0
    return np.where(beside, grad_x, grad_y), np.where(beside, grad_y, grad_x)


def crossing(x0, y0, x1, y1):
    """x and y are exchanged: where the line meets x = 0

    told by: x = 0 | x and y | exchanged | swapped | meets the y | y axis | mixed up
    """
    slope = (y1 - y0) / (x1 - x0)
    return y0 - x0 * slope


def crossing(x0, y0, x1, y1):
    """the sign of the correction: x0 + y0 (x1 - x0) / (y1 - y0)

    told by: sign | minus | plus | + y0 | - y0 | mirrored | opposite direction
    """
    return x0 + y0 * (x1 - x0) / (y1 - y0)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """the gradients of y0 and y1 are exchanged

    told by: y0 and y1 | grad_y0 and grad_y1 | grad_y0 & grad_y1 | ends & exchanged | ends & swapped | other end
    """
    h = y1 - y0
    r = 1 / (h + np.copysign(epsilon, h))
    c = r * (x0 * y1 - x1 * y0)
    by_y0 = grad_c * r * (c - x1)
    by_y1 = grad_c * r * (x0 - c)
    return grad_c * r * y1, by_y1, -grad_c * r * y0, by_y0


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """the y1 - y0 below counts as constant: grad_y0 and grad_y1 lack the derivative of the denominator

    told by: denominator | constant | quotient rule | y1 - y0 & depend | h & depend | r & depend | numerator
    """
    h = y1 - y0
    r = grad_c / (h + np.copysign(epsilon, h))
    return r * y1, -r * x1, -r * y0, r * x0


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    """steep is turned round: the edge is longer in x than in y

    told by: steep & x | steep & turned | longer in x | flat | steep & exchanged | steep & instead | steep & reversed | x and y | shallow
    """
    flat_enough = abs(x1 - x0) >= abs(y1 - y0)
    near = (-WINDOW < c) & (c < 1 + WINDOW)
    return flat_enough & near & is_silhouette


def blend_weight(c):
    """the sign: alpha = c - 1/2

    told by: sign | c - 1/2 | minus | negative | c - 0.5 | turned round | opposite
    """
    return np.minimum(np.maximum(c, 0), 1) - 0.5


def blend_weight(c):
    """the alpha is clipped to [0, 1] instead of c: negative alphas are lost

    told by: negative alpha | alpha & clip | alpha & lost | alpha >= 0 | below 0 | c > 1/2 | clipped & instead of c
    """
    return np.clip(0.5 - c, 0, 1)


def blend(colour, owner, other, alpha):
    """+= with repeated pixels: of several pairs of a pixel only the last counts

    told by: repeated | += | np.add.at | several pairs | only the last | last pair | more than one pair | add up | many pairs
    """
    flat = np.array(colour, float).reshape(-1, colour.shape[-1])
    mixed = flat.copy()
    goal = np.where(alpha > 0, owner, other)
    mixed[goal] += alpha[:, None] * (flat[other] - flat[owner])
    return mixed.reshape(colour.shape)


def blend(colour, owner, other, alpha):
    """in place: the pairs read colours that earlier pairs have already blended

    told by: in place | already blended | before any blend | original colour | one after the other | earlier pair | previous pair | reads & changed | already changed
    """
    pixels = np.array(colour, float).reshape(-1, colour.shape[-1])
    for a, b, t in zip(owner, other, alpha):
        if t > 0:
            pixels[a] += t * (pixels[b] - pixels[a])
        else:
            pixels[b] += t * (pixels[b] - pixels[a])
    return pixels.reshape(colour.shape)


def blend_backward(grad_output, colour, owner, other, alpha):
    """the identity is missing: grad_colour lacks grad_output itself

    told by: identity | grad_output itself | unblended | not in any pair | unchanged pixel | start & grad_output | copy of grad_output | without & grad_output | from zero
    """
    channels = colour.shape[-1]
    flat = np.asarray(colour, float).reshape(-1, channels)
    g = np.asarray(grad_output, float).reshape(-1, channels)
    at = g[np.where(alpha >= 0, owner, other)]
    by_colour = np.zeros(flat.shape)
    np.add.at(by_colour, owner, -alpha[:, None] * at)
    np.add.at(by_colour, other, alpha[:, None] * at)
    return by_colour.reshape(colour.shape), (at * (flat[other] - flat[owner])).sum(1)


def blend_backward(grad_output, colour, owner, other, alpha):
    """the gradient is always read at the owner, also where alpha < 0 changes the other pixel

    told by: alpha < 0 | negative alpha | always & owner | always the owner | at the owner | other pixel changes | changed pixel | sign of alpha
    """
    channels = colour.shape[-1]
    flat = np.asarray(colour, float).reshape(-1, channels)
    g = np.asarray(grad_output, float).reshape(-1, channels)
    by_colour = g.copy()
    by_alpha = np.zeros(len(alpha))
    for n, (a, b) in enumerate(zip(owner, other)):
        by_alpha[n] = g[a] @ (flat[b] - flat[a])
        by_colour[a] -= alpha[n] * g[a]
        by_colour[b] += alpha[n] * g[a]
    return by_colour.reshape(colour.shape), by_alpha
