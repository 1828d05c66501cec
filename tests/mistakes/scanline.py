"""Mistakes of lab 2; each docstring goes on after "this is what comes out when"."""


def half_planes(x, y, w):
    """the sign of w is left out: faces that cross the camera plane come out where they are not"""
    n_x, n_y, from_x, from_y = np.empty((4, *x.shape))
    winding = np.sign((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]))
    for k, (i, j) in enumerate(EDGES):
        w_i, w_j = np.abs(w[i]), np.abs(w[j])
        before = (x[i] < x[j]) | ((x[i] == x[j]) & (y[i] <= y[j]))
        at_i = (w_i > w_j) | ((w_i == w_j) & before)
        from_x[k], from_y[k] = np.where(at_i, x[i], x[j]), np.where(at_i, y[i], y[j])
        sign = winding
        n_x[k], n_y[k] = sign * (y[i] - y[j]), sign * (x[j] - x[i])
    return n_x, n_y, from_x, from_y


def half_planes(x, y, w):
    """the sign of A, the winding, is left out: clockwise faces cover nothing"""
    n_x, n_y, from_x, from_y = np.empty((4, *x.shape))
    for k, (i, j) in enumerate(EDGES):
        w_i, w_j = np.abs(w[i]), np.abs(w[j])
        before = (x[i] < x[j]) | ((x[i] == x[j]) & (y[i] <= y[j]))
        at_i = (w_i > w_j) | ((w_i == w_j) & before)
        from_x[k], from_y[k] = np.where(at_i, x[i], x[j]), np.where(at_i, y[i], y[j])
        sign = np.sign(w[k])
        n_x[k], n_y[k] = sign * (y[i] - y[j]), sign * (x[j] - x[i])
    return n_x, n_y, from_x, from_y


def half_planes(x, y, w):
    """n_x and n_y are swapped"""
    n_x, n_y, from_x, from_y = np.empty((4, *x.shape))
    winding = np.sign((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]))
    for k, (i, j) in enumerate(EDGES):
        w_i, w_j = np.abs(w[i]), np.abs(w[j])
        before = (x[i] < x[j]) | ((x[i] == x[j]) & (y[i] <= y[j]))
        at_i = (w_i > w_j) | ((w_i == w_j) & before)
        from_x[k], from_y[k] = np.where(at_i, x[i], x[j]), np.where(at_i, y[i], y[j])
        sign = winding * np.sign(w[k])
        n_x[k], n_y[k] = sign * (x[j] - x[i]), sign * (y[i] - y[j])
    return n_x, n_y, from_x, from_y


def half_planes(x, y, w):
    """all normals have the wrong sign, and point out of the face"""
    n_x, n_y, from_x, from_y = np.empty((4, *x.shape))
    for k, (i, j) in enumerate(EDGES):
        w_i, w_j = np.abs(w[i]), np.abs(w[j])
        before = (x[i] < x[j]) | ((x[i] == x[j]) & (y[i] <= y[j]))
        at_i = (w_i > w_j) | ((w_i == w_j) & before)
        from_x[k], from_y[k] = np.where(at_i, x[i], x[j]), np.where(at_i, y[i], y[j])
        sign = -np.sign(w[k] * ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])))
        n_x[k], n_y[k] = sign * (y[i] - y[j]), sign * (x[j] - x[i])
    return n_x, n_y, from_x, from_y


def depth_slopes(x, y, z):
    """the slope by y has the wrong sign"""
    x1, y1, z1 = x[1] - x[0], y[1] - y[0], z[1] - z[0]
    x2, y2, z2 = x[2] - x[0], y[2] - y[0], z[2] - z[0]
    area = x1 * y2 - x2 * y1
    return (z1 * y2 - z2 * y1) / area, (x2 * z1 - x1 * z2) / area


def depth_slopes(x, y, z):
    """the slopes by x and by y are swapped"""
    x1, y1, z1 = x[1] - x[0], y[1] - y[0], z[1] - z[0]
    x2, y2, z2 = x[2] - x[0], y[2] - y[0], z[2] - z[0]
    area = x1 * y2 - x2 * y1
    return (x1 * z2 - x2 * z1) / area, (z1 * y2 - z2 * y1) / area


def depth_slopes(x, y, z):
    """the slopes are not divided by the determinant, twice the area"""
    x1, y1, z1 = x[1] - x[0], y[1] - y[0], z[1] - z[0]
    x2, y2, z2 = x[2] - x[0], y[2] - y[0], z[2] - z[0]
    return (z1 * y2 - z2 * y1), (x1 * z2 - x2 * z1)


def depth_slopes(x, y, z):
    """both slopes have the wrong sign: they are those of the plane's normal, n_x / n_z, without the
    minus"""
    x1, y1, z1 = x[1] - x[0], y[1] - y[0], z[1] - z[0]
    x2, y2, z2 = x[2] - x[0], y[2] - y[0], z[2] - z[0]
    area = x1 * y2 - x2 * y1
    return (z2 * y1 - z1 * y2) / area, (x2 * z1 - x1 * z2) / area


def depth_slopes(x, y, z):
    """they are divided by the absolute value of the determinant: its sign is lost, and clockwise
    faces slope the wrong way"""
    x1, y1, z1 = x[1] - x[0], y[1] - y[0], z[1] - z[0]
    x2, y2, z2 = x[2] - x[0], y[2] - y[0], z[2] - z[0]
    area = x1 * y2 - x2 * y1
    return (z1 * y2 - z2 * y1) / abs(area), (x1 * z2 - x2 * z1) / abs(area)


def first_column(slope, from_x, offset):
    """the centre's half pixel is forgotten: columns are tested at their left border, j, instead of
    at j + 0.5"""
    column = np.floor(from_x - offset / slope)
    column += slope * (column - from_x) + offset < 0
    return column


def first_column(slope, from_x, offset):
    """the offset has the wrong sign"""
    column = np.floor(from_x + offset / slope)
    column += slope * (column + 0.5 - from_x) + offset < 0
    return column


def first_column(slope, from_x, offset):
    """a centre exactly on the edge is left out: > 0 for >= 0"""
    column = np.floor(from_x - offset / slope)
    column += slope * (column + 0.5 - from_x) + offset <= 0
    return column


def first_column(slope, from_x, offset):
    """the column is cut at 0: it may also lie to the left of the picture"""
    column = np.floor(from_x - offset / slope)
    column += slope * (column + 0.5 - from_x) + offset < 0
    return np.maximum(column, 0)


def row_interval(planes, face, y, left, right):
    """the slope of edges that end the interval is not negated, only their offset is: -e, not e,
    grows from left to right there"""
    start, end = left[face], right[face]
    for n_x, n_y, from_x, from_y in zip(*planes, strict=True):
        opens = is_top_left(n_x, n_y)
        sign = np.where(opens, 1, -1)
        slope, from_x = np.where(n_x == 0, TINY, n_x), np.where(n_x == 0, 0, from_x)
        offset = (sign * n_y)[face] * (y - from_y[face])
        column = first_column(slope[face], from_x[face], offset)
        start = np.where(opens[face], np.maximum(start, column), start)
        end = np.where(opens[face], end, np.minimum(end, column))
    return start, end


def row_interval(planes, face, y, left, right):
    """only the slope of edges that end the interval is negated, and their offset, n_y (y - from_y),
    is not: -e has the opposite sign in both"""
    start, end = left[face], right[face]
    for n_x, n_y, from_x, from_y in zip(*planes, strict=True):
        opens = is_top_left(n_x, n_y)
        slope = np.where(n_x == 0, TINY, np.where(opens, n_x, -n_x))
        from_x = np.where(n_x == 0, 0, from_x)
        column = first_column(slope[face], from_x[face], n_y[face] * (y - from_y[face]))
        start = np.where(opens[face], np.maximum(start, column), start)
        end = np.where(opens[face], end, np.minimum(end, column))
    return start, end


def row_interval(planes, face, y, left, right):
    """the last opening edge decides, instead of the one farthest right: the maximum"""
    start, end = left[face], right[face]
    for n_x, n_y, from_x, from_y in zip(*planes, strict=True):
        opens = is_top_left(n_x, n_y)
        sign = np.where(opens, 1, -1)
        slope, from_x = np.where(n_x == 0, TINY, sign * n_x), np.where(n_x == 0, 0, from_x)
        offset = (sign * n_y)[face] * (y - from_y[face])
        column = first_column(slope[face], from_x[face], offset)
        start = np.where(opens[face], column, start)
        end = np.where(opens[face], end, np.minimum(end, column))
    return start, end


def row_interval(planes, face, y, left, right):
    """end is the last column that is covered; it is one past it, the first one that is not"""
    start, end = left[face], right[face]
    for n_x, n_y, from_x, from_y in zip(*planes, strict=True):
        opens = is_top_left(n_x, n_y)
        sign = np.where(opens, 1, -1)
        slope, from_x = np.where(n_x == 0, TINY, sign * n_x), np.where(n_x == 0, 0, from_x)
        offset = (sign * n_y)[face] * (y - from_y[face])
        column = first_column(slope[face], from_x[face], offset)
        start = np.where(opens[face], np.maximum(start, column), start)
        end = np.where(opens[face], end, np.minimum(end, column))
    return start, end - 1


def row_interval(planes, face, y, left, right):
    """min and max are exchanged, which makes the union: the opening edge farthest right and the
    closing one farthest left must count, not the leftmost and the rightmost"""
    start, end = right[face], left[face]
    for n_x, n_y, from_x, from_y in zip(*planes, strict=True):
        opens = is_top_left(n_x, n_y)
        sign = np.where(opens, 1, -1)
        slope, from_x = np.where(n_x == 0, TINY, sign * n_x), np.where(n_x == 0, 0, from_x)
        offset = (sign * n_y)[face] * (y - from_y[face])
        column = first_column(slope[face], from_x[face], offset)
        start = np.where(opens[face], np.minimum(start, column), start)
        end = np.where(opens[face], end, np.maximum(end, column))
    return start, end


def row_interval(planes, face, y, left, right):
    """the face's box is left out: start is at least left, and end at most right, those of its
    face"""
    start, end = np.full(len(y), -np.inf), np.full(len(y), np.inf)
    for n_x, n_y, from_x, from_y in zip(*planes, strict=True):
        opens = is_top_left(n_x, n_y)
        sign = np.where(opens, 1, -1)
        slope, from_x = np.where(n_x == 0, TINY, sign * n_x), np.where(n_x == 0, 0, from_x)
        offset = (sign * n_y)[face] * (y - from_y[face])
        column = first_column(slope[face], from_x[face], offset)
        start = np.where(opens[face], np.maximum(start, column), start)
        end = np.where(opens[face], end, np.minimum(end, column))
    return start, end
