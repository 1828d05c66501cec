"""Mistakes of lab 3; each docstring goes on after "this is what comes out when"."""


def convolve(picture, kernel):
    """a kernel larger than the picture is placed in it once, so that what falls on the same pixel
    is overwritten: it goes round more than once, and is added up
    """
    (height, width), (h, w) = picture.shape, kernel.shape
    placed = np.zeros(picture.shape)
    placed[np.ix_((np.arange(h) - h // 2) % height, (np.arange(w) - w // 2) % width)] = kernel
    return picture_of(spectrum_of(picture) * spectrum_of(placed))


def clip_polygon(polygon, a, b, c):
    """the walk starts with the edge from the last vertex to the first, so that the order of the
    points starts elsewhere: it starts with the first vertex
    """
    kept = []
    for p, q in zip(np.roll(polygon, 1, axis=0), polygon, strict=True):
        at_p, at_q = a * p[0] + b * p[1] + c, a * q[0] + b * q[1] + c
        if (at_p >= 0) != (at_q >= 0):
            kept.append(p + (q - p) * (at_p / (at_p - at_q)))
        if at_q >= 0:
            kept.append(q)
    return np.array(kept).reshape(-1, 2)
