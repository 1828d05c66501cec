"""Mistakes of lab 8; each docstring goes on after "this is what comes out when"."""


def opposite_vertices(faces):
    """the face's own vertex k is taken for the one across: it is the third vertex of the other face
    at the edge"""
    edges = [frozenset((face[i], face[j])) for face in faces.tolist() for i, j in EDGES]
    shared = np.array([edges.count(edge) > 1 for edge in edges], bool)
    return np.where(shared.reshape(faces.shape), faces, -1)


def opposite_vertices(faces):
    """only the last face at an edge is kept, as in a dictionary with one entry for each edge: that
    face finds itself, and gets its own vertex or -1"""
    last = {frozenset((face[i], face[j])): face[k]
            for face in faces.tolist() for k, (i, j) in enumerate(EDGES)}
    return np.array([[last[frozenset((face[i], face[j]))]
                      if last[frozenset((face[i], face[j]))] != face[k] else -1
                      for k, (i, j) in enumerate(EDGES)] for face in faces.tolist()],
                    int).reshape(faces.shape)


def opposite_vertices(faces):
    """an edge from a to b is taken for another one than that from b to a"""
    thirds = {}
    for face in faces.tolist():
        for k, (i, j) in enumerate(EDGES):
            thirds.setdefault((face[i], face[j]), []).append(face[k])
    opposite = np.full(faces.shape, -1)
    for f, face in enumerate(faces.tolist()):
        for k, (i, j) in enumerate(EDGES):
            others = [third for third in thirds[face[i], face[j]] if third != face[k]]
            opposite[f, k] = others[0] if others else -1
    return opposite


def opposite_vertices(faces):
    """an edge is looked up in reverse order only: neighbours that run along it in the same
    direction, wound the other way, are not found"""
    thirds = {}
    for face in faces.tolist():
        for k, (i, j) in enumerate(EDGES):
            thirds.setdefault((face[i], face[j]), face[k])
    return np.array([[thirds.get((face[j], face[i]), -1) for i, j in EDGES]
                     for face in faces.tolist()], int).reshape(faces.shape)


def opposite_vertices(faces):
    """edge k starts at vertex k, from k to k + 1, so that columns are rolled; it is the one
    opposite to vertex k, from k + 1 to k + 2"""
    thirds = {}
    for face in faces.tolist():
        for k, (i, j) in enumerate(EDGES):
            thirds.setdefault(frozenset((face[i], face[j])), []).append(face[k])
    opposite = np.full(faces.shape, -1)
    for f, face in enumerate(faces.tolist()):
        for k, (i, j) in enumerate(EDGES):
            others = [v for v in thirds[frozenset((face[i], face[j]))] if v != face[k]]
            opposite[f, k - 2] = others[0] if others else -1
    return opposite


def opposite_vertices(faces):
    """edge k ends at vertex k, from k - 1 to k, so that columns are rolled; it is the one opposite
    to vertex k, from k + 1 to k + 2"""
    thirds = {}
    for face in faces.tolist():
        for k, (i, j) in enumerate(EDGES):
            thirds.setdefault(frozenset((face[i], face[j])), []).append(face[k])
    opposite = np.full(faces.shape, -1)
    for f, face in enumerate(faces.tolist()):
        for k, (i, j) in enumerate(EDGES):
            others = [v for v in thirds[frozenset((face[i], face[j]))] if v != face[k]]
            opposite[f, k - 1] = others[0] if others else -1
    return opposite


def silhouette_edges(x, y, w, faces, opposite):
    """the test is reversed: an edge counts as a fold where vertex k and the one across lie on
    different sides of it; it is one where they lie on the same side"""
    def area(a, b, c):
        return (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])
    side, silhouette = np.where(w < 0, -1, 1), np.empty(faces.shape, bool)
    for k, (i, j) in enumerate(EDGES):
        i, j, own, across = faces[:, i], faces[:, j], faces[:, k], opposite[:, k]
        turned = side[i] * side[j]
        face, wing = (area(i, j, p) * turned * side[p] for p in (own, across))
        silhouette[:, k] = ((wing < 0) != (face < 0)) | (across < 0)
    return silhouette


def silhouette_edges(x, y, w, faces, opposite):
    """the surface's border is no silhouette: opposite is -1 there, which means none, and NumPy
    takes -1 for the last vertex"""
    def area(a, b, c):
        return (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])
    side, silhouette = np.where(w < 0, -1, 1), np.empty(faces.shape, bool)
    for k, (i, j) in enumerate(EDGES):
        i, j, own, across = faces[:, i], faces[:, j], faces[:, k], opposite[:, k]
        turned = side[i] * side[j]
        face, wing = (area(i, j, p) * turned * side[p] for p in (own, across))
        silhouette[:, k] = (wing < 0) == (face < 0)
    return silhouette


def silhouette_edges(x, y, w, faces, opposite):
    """the side of vertex k is not looked at: it is right for counter-clockwise faces alone, and
    clockwise ones, seen from behind, fold where they are flat"""
    def area(a, b, c):
        return (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])
    side, silhouette = np.where(w < 0, -1, 1), np.empty(faces.shape, bool)
    for k, (i, j) in enumerate(EDGES):
        i, j, across = faces[:, i], faces[:, j], opposite[:, k]
        turned = side[i] * side[j]
        wing = area(i, j, across) * turned * side[across]
        silhouette[:, k] = (wing >= 0) | (across < 0)
    return silhouette


def silhouette_edges(x, y, w, faces, opposite):
    """only the border counts: folds are left out, where vertex k and the one across lie on one side
    of the edge"""
    return opposite < 0


def silhouette_edges(x, y, w, faces, opposite):
    """w is ignored: a corner behind the camera (w < 0) is mirrored on screen, and turns a winding
    over"""
    def area(a, b, c):
        return (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])
    silhouette = np.empty(faces.shape, bool)
    for k, (i, j) in enumerate(EDGES):
        i, j, own, across = faces[:, i], faces[:, j], faces[:, k], opposite[:, k]
        face, wing = (area(i, j, p) for p in (own, across))
        silhouette[:, k] = ((wing < 0) == (face < 0)) | (across < 0)
    return silhouette


def silhouette_edges(x, y, w, faces, opposite):
    """a triangle without area counts as clockwise, by <= 0 for < 0; it counts as
    counter-clockwise"""
    def area(a, b, c):
        return (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])
    side, silhouette = np.where(w < 0, -1, 1), np.empty(faces.shape, bool)
    for k, (i, j) in enumerate(EDGES):
        i, j, own, across = faces[:, i], faces[:, j], faces[:, k], opposite[:, k]
        turned = side[i] * side[j]
        face, wing = (area(i, j, p) * turned * side[p] for p in (own, across))
        silhouette[:, k] = ((wing <= 0) == (face <= 0)) | (across < 0)
    return silhouette


def neighbour_pairs(face_index, outlined):
    """the end of a row is taken for the neighbour of the next one's beginning"""
    width, face, outlined = face_index.shape[1], face_index.ravel(), outlined.ravel()
    pairs = []
    for step in 1, width:
        jumps = (face[:-step] != face[step:]) & (outlined[:-step] | outlined[step:])
        first = np.flatnonzero(jumps)
        pairs.append((first, first + step))
    return tuple(np.concatenate(pixels) for pixels in zip(*pairs, strict=True))


def neighbour_pairs(face_index, outlined):
    """both pixels must be outlined; one is enough"""
    width, face, outlined = face_index.shape[1], face_index.ravel(), outlined.ravel()
    pairs = []
    for step in 1, width:
        jumps = (face[:-step] != face[step:]) & (outlined[:-step] & outlined[step:])
        first = np.flatnonzero(jumps)
        if not pairs:
            first = first[first % width < width - 1]
        pairs.append((first, first + step))
    return tuple(np.concatenate(pixels) for pixels in zip(*pairs, strict=True))


def neighbour_pairs(face_index, outlined):
    """pixels above each other are left out"""
    width, face, outlined = face_index.shape[1], face_index.ravel(), outlined.ravel()
    pairs = []
    for step in (1,):
        jumps = (face[:-step] != face[step:]) & (outlined[:-step] | outlined[step:])
        first = np.flatnonzero(jumps)
        if not pairs:
            first = first[first % width < width - 1]
        pairs.append((first, first + step))
    return tuple(np.concatenate(pixels) for pixels in zip(*pairs, strict=True))


def neighbour_pairs(face_index, outlined):
    """pairs with the background are left out, where one of the two pixels sees no face, -1"""
    width, face, outlined = face_index.shape[1], face_index.ravel(), outlined.ravel()
    pairs = []
    for step in 1, width:
        jumps = (face[:-step] != face[step:]) & (outlined[:-step] | outlined[step:])
        first = np.flatnonzero(jumps & (face[:-step] >= 0) & (face[step:] >= 0))
        if not pairs:
            first = first[first % width < width - 1]
        pairs.append((first, first + step))
    return tuple(np.concatenate(pixels) for pixels in zip(*pairs, strict=True))


def pair_frame(screen_x, screen_y, owner, other, width):
    """the corner of the pixel is taken for its centre"""
    dx, dy = pair_step(owner, other, width)
    row, column = np.divmod(owner, width)
    x, y = screen_x - column, screen_y - row
    return dx * x + dy * y, np.abs(dy) * x + np.abs(dx) * y


def pair_frame(screen_x, screen_y, owner, other, width):
    """nothing is mirrored where the other pixel comes before the owner"""
    dx, dy = pair_step(owner, other, width)
    row, column = np.divmod(owner, width)
    x, y = screen_x - (column + 0.5), screen_y - (row + 0.5)
    return np.abs(dx) * x + np.abs(dy) * y, np.abs(dy) * x + np.abs(dx) * y


def pair_frame(screen_x, screen_y, owner, other, width):
    """rows and columns are swapped"""
    dx, dy = pair_step(owner, other, width)
    column, row = np.divmod(owner, width)
    x, y = screen_x - (column + 0.5), screen_y - (row + 0.5)
    return dx * x + dy * y, np.abs(dy) * x + np.abs(dx) * y


def pair_frame(screen_x, screen_y, owner, other, width):
    """y is multiplied by s, too, and mirrored with x: that is a rotation; the sign of y stays"""
    dx, dy = pair_step(owner, other, width)
    row, column = np.divmod(owner, width)
    x, y = screen_x - (column + 0.5), screen_y - (row + 0.5)
    return dx * x + dy * y, dy * x + dx * y


def pair_frame_backward(grad_x, grad_y, owner, other, width):
    """gradients are not turned back into the picture's directions"""
    return grad_x, grad_y


def pair_frame_backward(grad_x, grad_y, owner, other, width):
    """the mirror is forgotten on the way back, for pixels side by side"""
    dx, dy = pair_step(owner, other, width)
    return np.abs(dx) * grad_x + np.abs(dy) * grad_y, dy * grad_x + np.abs(dx) * grad_y


def pair_frame_backward(grad_x, grad_y, owner, other, width):
    """the forward matrix is used in place of its transpose: for pixels above each other, the sign
    goes to the wrong one of x and y"""
    dx, dy = pair_step(owner, other, width)
    return dx * grad_x + dy * grad_y, np.abs(dy) * grad_x + np.abs(dx) * grad_y


def crossing(x0, y0, x1, y1):
    """the sign of the second term is wrong: it is x0 - y0 (x1 - x0) / (y1 - y0), with a minus"""
    return x0 + y0 * (x1 - x0) / (y1 - y0)


def crossing(x0, y0, x1, y1):
    """the slope is upside down: it is dx / dy, (x1 - x0) / (y1 - y0), and not dy / dx"""
    return x0 - y0 * (y1 - y0) / (x1 - x0)


def crossing(x0, y0, x1, y1):
    """x and y are swapped: that is the crossing with x = 0, the y axis"""
    return y0 - x0 * (y1 - y0) / (x1 - x0)


def crossing(x0, y0, x1, y1):
    """it is the share of the way from end 0 to end 1, from 0 to 1, and not the place x there"""
    return -y0 / (y1 - y0)


def crossing(x0, y0, x1, y1):
    """the two ends are mixed up: it starts from x1, but goes by y0, the height of the other end"""
    return x1 - y0 * (x1 - x0) / (y1 - y0)


def crossing(x0, y0, x1, y1):
    """it is always measured from the first end, even if that is the far end, near infinity: digits
    are lost; measure from the end that is nearer to y = 0"""
    return x0 - y0 * (x1 - x0) / (y1 - y0)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """epsilon makes an edge that goes down shorter; it must keep the sign of y1 - y0"""
    r = 1 / (y1 - y0 + epsilon)
    c = (x0 * y1 - x1 * y0) * r
    slope = grad_c * r
    return slope * y1, slope * (c - x1), -slope * y0, slope * (x0 - c)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """the gradients of the other end, x1 and y1, have the wrong sign: r becomes -r there"""
    r = 1 / (y1 - y0 + np.copysign(epsilon, y1 - y0))
    c = (x0 * y1 - x1 * y0) * r
    slope = grad_c * r
    return slope * y1, slope * (c - x1), slope * y0, slope * (c - x0)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """the gradient by x1 has the wrong sign: r becomes -r for the other end"""
    r = 1 / (y1 - y0 + np.copysign(epsilon, y1 - y0))
    c = (x0 * y1 - x1 * y0) * r
    slope = grad_c * r
    return slope * y1, slope * (c - x1), slope * y0, slope * (x0 - c)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """the quotient rule is left out of dc/dy0: y0 is in the denominator y1 - y0, too"""
    r = 1 / (y1 - y0 + np.copysign(epsilon, y1 - y0))
    c = (x0 * y1 - x1 * y0) * r
    slope = grad_c * r
    return slope * y1, -slope * (x1 - x0), -slope * y0, slope * (x0 - c)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """the denominator y1 - y0 is taken for a constant: by the quotient rule, it changes with y0 and
    with y1"""
    r = 1 / (y1 - y0 + np.copysign(epsilon, y1 - y0))
    slope = grad_c * r
    return slope * y1, -slope * (x1 - x0), -slope * y0, 0 * slope


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """the two ends are swapped: each gets the gradients of the other one"""
    r = 1 / (y1 - y0 + np.copysign(epsilon, y1 - y0))
    c = (x0 * y1 - x1 * y0) * r
    slope = grad_c * r
    return -slope * y0, slope * (x0 - c), slope * y1, slope * (c - x1)


def last_crossing(x, y, w):
    """the least c counts, where the line enters the face; it is the greatest c, where it leaves"""
    c, above = np.full(x.shape, np.inf), y * w
    for k, (i, j) in enumerate(EDGES):
        crosses = (above[i] < 0) != (above[j] < 0)
        crosses &= w[i] * np.abs(above[j]) + w[j] * np.abs(above[i]) > 0
        c[k, crosses] = crossing(*(corner[crosses] for corner in (x[i], y[i], x[j], y[j])))
    edge = c.argmin(0)
    least = c[edge, np.arange(len(edge))]
    return edge, np.where(least == np.inf, -np.inf, least)


def last_crossing(x, y, w):
    """the first edge that crosses is taken; of all edges that cross, the greatest c counts"""
    c, above = np.full(x.shape, -np.inf), y * w
    for k, (i, j) in enumerate(EDGES):
        crosses = (above[i] < 0) != (above[j] < 0)
        crosses &= w[i] * np.abs(above[j]) + w[j] * np.abs(above[i]) > 0
        c[k, crosses] = crossing(*(corner[crosses] for corner in (x[i], y[i], x[j], y[j])))
    edge = (c > -np.inf).argmax(0)
    return edge, c[edge, np.arange(len(edge))]


def last_crossing(x, y, w):
    """w is ignored: a corner behind the camera is mirrored, and crossings behind it do not count"""
    c = np.full(x.shape, -np.inf)
    for k, (i, j) in enumerate(EDGES):
        crosses = (y[i] < 0) != (y[j] < 0)
        c[k, crosses] = crossing(*(corner[crosses] for corner in (x[i], y[i], x[j], y[j])))
    edge = c.argmax(0)
    return edge, c[edge, np.arange(len(edge))]


def last_crossing(x, y, w):
    """crossings behind the camera count"""
    c, above = np.full(x.shape, -np.inf), y * w
    for k, (i, j) in enumerate(EDGES):
        crosses = (above[i] < 0) != (above[j] < 0)
        c[k, crosses] = crossing(*(corner[crosses] for corner in (x[i], y[i], x[j], y[j])))
    edge = c.argmax(0)
    return edge, c[edge, np.arange(len(edge))]


def last_crossing(x, y, w):
    """the edges are numbered by their first corner, from k to k + 1; edge k lies opposite to
    corner k"""
    c, above = np.full(x.shape, -np.inf), y * w
    for k, (i, j) in enumerate(EDGES[2:] + EDGES[:2]):
        crosses = (above[i] < 0) != (above[j] < 0)
        crosses &= w[i] * np.abs(above[j]) + w[j] * np.abs(above[i]) > 0
        c[k, crosses] = crossing(*(corner[crosses] for corner in (x[i], y[i], x[j], y[j])))
    edge = c.argmax(0)
    return edge, c[edge, np.arange(len(edge))]


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    """every edge is taken for a silhouette"""
    is_steep = np.abs(y1 - y0) >= np.abs(x1 - x0)
    return is_steep & (c > -WINDOW) & (c < 1 + WINDOW)


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    """flat edges are taken, at least as long in x as in y, instead of steep ones"""
    is_steep = np.abs(y1 - y0) <= np.abs(x1 - x0)
    return is_silhouette & is_steep & (c > -WINDOW) & (c < 1 + WINDOW)


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    """crossings anywhere count; they must lie between the centres"""
    is_steep = np.abs(y1 - y0) >= np.abs(x1 - x0)
    return is_silhouette & is_steep


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    """the WINDOW is left out: c may be a little outside of 0 to 1, by less than 1/16"""
    is_steep = np.abs(y1 - y0) >= np.abs(x1 - x0)
    return is_silhouette & is_steep & (c >= 0) & (c <= 1)


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    """abs is left out: the lengths in x and y are absolute values, whatever the edge's direction"""
    is_steep = y1 - y0 >= x1 - x0
    return is_silhouette & is_steep & (c > -WINDOW) & (c < 1 + WINDOW)


def blend_weight(c):
    """alpha has the wrong sign: it is 1/2 - c, and not c - 1/2"""
    return np.clip(c, 0, 1) - 0.5


def blend_weight(c):
    """c is not clipped: a c outside of [0, 1] counts as 0 or 1"""
    return 0.5 - c


def blend_weight(c):
    """the constant is wrong, 1 - c for 1/2 - c: alpha is 0 where the edge is in the middle"""
    return 1 - np.clip(c, 0, 1)


def blend_weight(c):
    """alpha is never negative, as by an absolute value: its sign is lost, |1/2 - c|"""
    return np.abs(0.5 - np.clip(c, 0, 1))


def blend(colour, owner, other, alpha):
    """a pixel in several pairs keeps only one of its changes, as by += with repeated indices; they
    add up, as by np.add.at"""
    pixels = colour.reshape(-1, colour.shape[-1]).astype(float)
    output = pixels.copy()
    changed = np.where(alpha > 0, owner, other)
    output[changed] += alpha[:, None] * (pixels[other] - pixels[owner])
    return output.reshape(colour.shape)


def blend(colour, owner, other, alpha):
    """the wrong one of the two pixels changes: it is the owner if alpha > 0, and else the other"""
    pixels = colour.reshape(-1, colour.shape[-1]).astype(float)
    output = pixels.copy()
    changed = np.where(alpha > 0, other, owner)
    np.add.at(output, changed, alpha[:, None] * (pixels[other] - pixels[owner]))
    return output.reshape(colour.shape)


def blend(colour, owner, other, alpha):
    """colours move away from each other: the sign of the change is wrong"""
    pixels = colour.reshape(-1, colour.shape[-1]).astype(float)
    output = pixels.copy()
    changed = np.where(alpha > 0, owner, other)
    np.add.at(output, changed, alpha[:, None] * (pixels[owner] - pixels[other]))
    return output.reshape(colour.shape)


def blend(colour, owner, other, alpha):
    """only the owner is ever changed: where alpha < 0, the other pixel is the one that changes"""
    pixels = colour.reshape(-1, colour.shape[-1]).astype(float)
    output = pixels.copy()
    np.add.at(output, owner, alpha[:, None] * (pixels[other] - pixels[owner]))
    return output.reshape(colour.shape)


def blend(colour, owner, other, alpha):
    """both pixels of a pair change; only one does, the owner if alpha > 0, and else the other"""
    pixels = colour.reshape(-1, colour.shape[-1]).astype(float)
    output = pixels.copy()
    change = alpha[:, None] * (pixels[other] - pixels[owner])
    np.add.at(output, owner, change)
    np.add.at(output, other, change)
    return output.reshape(colour.shape)


def blend(colour, owner, other, alpha):
    """a pair reads colours that an earlier pair has changed; all read those from before any
    blend"""
    output = colour.reshape(-1, colour.shape[-1]).astype(float)
    for p, q, a in zip(owner, other, alpha, strict=True):
        output[p if a > 0 else q] += a * (output[q] - output[p])
    return output.reshape(colour.shape)


def blend_backward(grad_output, colour, owner, other, alpha):
    """a pixel in several pairs keeps only one of its gradients, as by += with repeated indices;
    they add up, as by np.add.at"""
    pixels, grad_pixels = (p.reshape(-1, colour.shape[-1]).astype(float)
                           for p in (colour, grad_output))
    grad_changed = grad_pixels[np.where(alpha >= 0, owner, other)]
    grad_alpha = (grad_changed * (pixels[other] - pixels[owner])).sum(1)
    grad_colour = grad_pixels.copy()
    grad_colour[owner] += -alpha[:, None] * grad_changed
    grad_colour[other] += alpha[:, None] * grad_changed
    return grad_colour.reshape(colour.shape), grad_alpha


def blend_backward(grad_output, colour, owner, other, alpha):
    """the share -alpha grad of the owner has the wrong sign: it is subtracted"""
    pixels, grad_pixels = (p.reshape(-1, colour.shape[-1]).astype(float)
                           for p in (colour, grad_output))
    grad_changed = grad_pixels[np.where(alpha >= 0, owner, other)]
    grad_alpha = (grad_changed * (pixels[other] - pixels[owner])).sum(1)
    grad_colour = grad_pixels.copy()
    np.add.at(grad_colour, owner, alpha[:, None] * grad_changed)
    np.add.at(grad_colour, other, alpha[:, None] * grad_changed)
    return grad_colour.reshape(colour.shape), grad_alpha


def blend_backward(grad_output, colour, owner, other, alpha):
    """the pixel's own colour is left out: without a blend its gradient is grad_output"""
    pixels, grad_pixels = (p.reshape(-1, colour.shape[-1]).astype(float)
                           for p in (colour, grad_output))
    grad_changed = grad_pixels[np.where(alpha >= 0, owner, other)]
    grad_alpha = (grad_changed * (pixels[other] - pixels[owner])).sum(1)
    grad_colour = np.zeros(grad_pixels.shape)
    np.add.at(grad_colour, owner, -alpha[:, None] * grad_changed)
    np.add.at(grad_colour, other, alpha[:, None] * grad_changed)
    return grad_colour.reshape(colour.shape), grad_alpha


def blend_backward(grad_output, colour, owner, other, alpha):
    """always the owner's gradient is used: where alpha < 0, the other pixel is the one that
    changes"""
    pixels, grad_pixels = (p.reshape(-1, colour.shape[-1]).astype(float)
                           for p in (colour, grad_output))
    grad_changed = grad_pixels[owner]
    grad_alpha = (grad_changed * (pixels[other] - pixels[owner])).sum(1)
    grad_colour = grad_pixels.copy()
    np.add.at(grad_colour, owner, -alpha[:, None] * grad_changed)
    np.add.at(grad_colour, other, alpha[:, None] * grad_changed)
    return grad_colour.reshape(colour.shape), grad_alpha


def blend_backward(grad_output, colour, owner, other, alpha):
    """the share of the neighbour is left out: alpha grad is not given to the other pixel, only
    taken from the one that changes"""
    pixels, grad_pixels = (p.reshape(-1, colour.shape[-1]).astype(float)
                           for p in (colour, grad_output))
    grad_changed = grad_pixels[np.where(alpha >= 0, owner, other)]
    grad_alpha = (grad_changed * (pixels[other] - pixels[owner])).sum(1)
    grad_colour = grad_pixels.copy()
    changed = np.where(alpha >= 0, owner, other)
    np.add.at(grad_colour, changed, -np.abs(alpha)[:, None] * grad_changed)
    return grad_colour.reshape(colour.shape), grad_alpha


def blend_backward(grad_output, colour, owner, other, alpha):
    """at alpha = 0, the kink, the other pixel's side is taken; it is the owner's side,
    alpha >= 0"""
    pixels, grad_pixels = (p.reshape(-1, colour.shape[-1]).astype(float)
                           for p in (colour, grad_output))
    grad_changed = grad_pixels[np.where(alpha > 0, owner, other)]
    grad_alpha = (grad_changed * (pixels[other] - pixels[owner])).sum(1)
    grad_colour = grad_pixels.copy()
    np.add.at(grad_colour, owner, -alpha[:, None] * grad_changed)
    np.add.at(grad_colour, other, alpha[:, None] * grad_changed)
    return grad_colour.reshape(colour.shape), grad_alpha
