"""Mistakes of lab 8; each docstring goes on after "this is what comes out when"."""


def opposite_vertices(faces):
    """an edge from a to b is taken for another one than that from b to a"""
    faces = faces.astype(np.int64)
    ends = faces[:, [1, 2, 0]], faces[:, [2, 0, 1]]
    low, high = ends
    sound = (low != high).all(1)
    own = faces[sound].ravel()
    _, edge = np.unique((low * (faces.max(initial=0) + 1) + high)[sound], return_inverse=True)
    edge = edge.ravel()
    first, second = np.full((2, len(own)), -1)
    first[edge[::-1]] = own[::-1]
    others = np.flatnonzero(own != first[edge])[::-1]
    second[edge[others]] = own[others]
    first, second = first[edge], second[edge]
    opposite = np.full(faces.shape, -1)
    opposite[sound] = np.select([own == first, own == second], [second, first], -1).reshape(-1, 3)
    return opposite


def opposite_vertices(faces):
    """a face's own vertex is taken for the one across"""
    faces = faces.astype(np.int64)
    ends = faces[:, [1, 2, 0]], faces[:, [2, 0, 1]]
    low, high = np.minimum(*ends), np.maximum(*ends)
    sound = (low != high).all(1)
    own = faces[sound].ravel()
    _, edge = np.unique((low * (faces.max(initial=0) + 1) + high)[sound], return_inverse=True)
    edge = edge.ravel()
    first, second = np.full((2, len(own)), -1)
    first[edge[::-1]] = own[::-1]
    others = np.flatnonzero(own != first[edge])[::-1]
    second[edge[others]] = own[others]
    first, second = first[edge], second[edge]
    opposite = np.full(faces.shape, -1)
    opposite[sound] = np.select([own == first, own == second], [first, first], -1).reshape(-1, 3)
    return opposite


def opposite_vertices(faces):
    """a boundary gives vertex 0 instead of -1"""
    faces = faces.astype(np.int64)
    ends = faces[:, [1, 2, 0]], faces[:, [2, 0, 1]]
    low, high = np.minimum(*ends), np.maximum(*ends)
    sound = (low != high).all(1)
    own = faces[sound].ravel()
    _, edge = np.unique((low * (faces.max(initial=0) + 1) + high)[sound], return_inverse=True)
    edge = edge.ravel()
    first, second = np.full((2, len(own)), -1)
    first[edge[::-1]] = own[::-1]
    others = np.flatnonzero(own != first[edge])[::-1]
    second[edge[others]] = own[others]
    first, second = first[edge], second[edge]
    opposite = np.full(faces.shape, -1)
    opposite[sound] = np.select([own == first, own == second], [second, first], 0).reshape(-1, 3)
    return opposite


def silhouette_edges(x, y, w, faces, opposite):
    """folds and flat places are swapped: same winding means a fold"""
    def area(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
    corners, across = (np.stack([x[index.T], y[index.T]], 1) for index in (faces, opposite))
    side = np.where(w < 0, -1, 1)
    own, silhouette = area(*corners) * side[faces].prod(1), np.empty(faces.shape, bool)
    for k, (i, j) in enumerate(EDGES):
        turned = side[opposite[:, k]] * side[faces[:, i]] * side[faces[:, j]]
        wing = area(across[k], corners[i], corners[j]) * turned
        silhouette[:, k] = ((wing < 0) != (own < 0)) | (opposite[:, k] < 0)
    return silhouette


def silhouette_edges(x, y, w, faces, opposite):
    """the surface's border is no silhouette"""
    def area(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
    corners, across = (np.stack([x[index.T], y[index.T]], 1) for index in (faces, opposite))
    side = np.where(w < 0, -1, 1)
    own, silhouette = area(*corners) * side[faces].prod(1), np.empty(faces.shape, bool)
    for k, (i, j) in enumerate(EDGES):
        turned = side[opposite[:, k]] * side[faces[:, i]] * side[faces[:, j]]
        wing = area(across[k], corners[i], corners[j]) * turned
        silhouette[:, k] = (wing < 0) == (own < 0)
    return silhouette


def silhouette_edges(x, y, w, faces, opposite):
    """w of the face's corners is not looked at: each corner behind the camera turns the winding
    over"""
    def area(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
    corners, across = (np.stack([x[index.T], y[index.T]], 1) for index in (faces, opposite))
    side = np.where(w < 0, -1, 1)
    own, silhouette = area(*corners), np.empty(faces.shape, bool)
    for k, (i, j) in enumerate(EDGES):
        turned = side[opposite[:, k]] * side[faces[:, i]] * side[faces[:, j]]
        wing = area(across[k], corners[i], corners[j]) * turned
        silhouette[:, k] = ((wing < 0) == (own < 0)) | (opposite[:, k] < 0)
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


def pair_frame_backward(grad_x, grad_y, owner, other, width):
    """gradients are not turned back into the picture's directions"""
    return grad_x, grad_y


def pair_frame_backward(grad_x, grad_y, owner, other, width):
    """the mirror is forgotten on the way back, for pixels side by side"""
    dx, dy = pair_step(owner, other, width)
    return np.abs(dx) * grad_x + np.abs(dy) * grad_y, dy * grad_x + np.abs(dx) * grad_y


def pair_frame_backward(grad_x, grad_y, owner, other, width):
    """the forward's formula is used: the way back is its transpose"""
    dx, dy = pair_step(owner, other, width)
    return dx * grad_x + dy * grad_y, np.abs(dy) * grad_x + np.abs(dx) * grad_y


def crossing(x0, y0, x1, y1):
    """the sign of the step along the edge is wrong"""
    nearer = np.abs(y1) < np.abs(y0)
    x, y = np.where(nearer, x1, x0), np.where(nearer, y1, y0)
    return x + y * (x1 - x0) / (y1 - y0)


def crossing(x0, y0, x1, y1):
    """the slope is upside down"""
    nearer = np.abs(y1) < np.abs(y0)
    x, y = np.where(nearer, x1, x0), np.where(nearer, y1, y0)
    return x - y * (y1 - y0) / (x1 - x0)


def crossing(x0, y0, x1, y1):
    """it is always measured from the first end, even if that is near infinity"""
    nearer = np.zeros(np.shape(y0), bool)
    x, y = np.where(nearer, x1, x0), np.where(nearer, y1, y0)
    return x - y * (x1 - x0) / (y1 - y0)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """epsilon makes an edge that goes down shorter; it must keep the sign of y1 - y0"""
    r = 1 / (y1 - y0 + epsilon)
    c = (x0 * y1 - x1 * y0) * r
    slope = grad_c * r
    return slope * y1, slope * (c - x1), -slope * y0, slope * (x0 - c)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """the gradient by x1 has the wrong sign"""
    r = 1 / (y1 - y0 + np.copysign(epsilon, y1 - y0))
    c = (x0 * y1 - x1 * y0) * r
    slope = grad_c * r
    return slope * y1, slope * (c - x1), slope * y0, slope * (x0 - c)


def crossing_backward(grad_c, x0, y0, x1, y1, epsilon=0.0):
    """the gradients by x0 and x1 are swapped"""
    r = 1 / (y1 - y0 + np.copysign(epsilon, y1 - y0))
    c = (x0 * y1 - x1 * y0) * r
    slope = grad_c * r
    return -slope * y0, slope * (c - x1), slope * y1, slope * (x0 - c)


def last_crossing(x, y, w):
    """the first crossing is taken; it is the last"""
    c, above = np.full(x.shape, -np.inf), y * w
    for k, (i, j) in enumerate(EDGES):
        crosses = (above[i] < 0) != (above[j] < 0)
        crosses &= w[i] * np.abs(above[j]) + w[j] * np.abs(above[i]) > 0
        c[k, crosses] = crossing(*(corner[crosses] for corner in (x[i], y[i], x[j], y[j])))
    edge = c.argmin(0)
    return edge, c[edge, np.arange(len(edge))]


def last_crossing(x, y, w):
    """the sign of w is left out: a corner behind the camera is mirrored"""
    c, above = np.full(x.shape, -np.inf), y
    for k, (i, j) in enumerate(EDGES):
        crosses = (above[i] < 0) != (above[j] < 0)
        crosses &= w[i] * np.abs(above[j]) + w[j] * np.abs(above[i]) > 0
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


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    """every edge is taken for a silhouette"""
    is_steep = np.abs(y1 - y0) >= np.abs(x1 - x0)
    return is_steep & (c > -WINDOW) & (c < 1 + WINDOW)


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    """flat edges are taken instead of steep ones"""
    is_steep = np.abs(y1 - y0) <= np.abs(x1 - x0)
    return is_silhouette & is_steep & (c > -WINDOW) & (c < 1 + WINDOW)


def is_blended(c, is_silhouette, x0, y0, x1, y1):
    """crossings anywhere count; they must lie between the centres"""
    is_steep = np.abs(y1 - y0) >= np.abs(x1 - x0)
    return is_silhouette & is_steep


def blend_weight(c):
    """alpha has the wrong sign"""
    return np.clip(c, 0, 1) - 0.5


def blend_weight(c):
    """a c outside of [0, 1] is not brought back"""
    return 0.5 - c


def blend_weight(c):
    """1/2 is missing: alpha is 0 where the edge is in the middle"""
    return 1 - np.clip(c, 0, 1)


def blend(colour, owner, other, alpha):
    """a pixel of several pairs keeps only one of its changes; they add up"""
    pixels = colour.reshape(-1, colour.shape[-1]).astype(float)
    output = pixels.copy()
    changed = np.where(alpha > 0, owner, other)
    output[changed] += alpha[:, None] * (pixels[other] - pixels[owner])
    return output.reshape(colour.shape)


def blend(colour, owner, other, alpha):
    """the wrong one of the two pixels changes"""
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


def blend_backward(grad_output, colour, owner, other, alpha):
    """a pixel of several pairs keeps only one of its gradients; they add up"""
    pixels, grad_pixels = (p.reshape(-1, colour.shape[-1]).astype(float)
                           for p in (colour, grad_output))
    grad_changed = grad_pixels[np.where(alpha >= 0, owner, other)]
    grad_alpha = (grad_changed * (pixels[other] - pixels[owner])).sum(1)
    grad_colour = grad_pixels.copy()
    grad_colour[owner] += -alpha[:, None] * grad_changed
    np.add.at(grad_colour, other, alpha[:, None] * grad_changed)
    return grad_colour.reshape(colour.shape), grad_alpha


def blend_backward(grad_output, colour, owner, other, alpha):
    """the owner's gradient has the wrong sign"""
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
