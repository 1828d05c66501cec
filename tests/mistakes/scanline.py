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
    """the sign of A is left out: clockwise faces cover nothing"""
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
    """the slopes are not divided by the area"""
    x1, y1, z1 = x[1] - x[0], y[1] - y[0], z[1] - z[0]
    x2, y2, z2 = x[2] - x[0], y[2] - y[0], z[2] - z[0]
    return (z1 * y2 - z2 * y1), (x1 * z2 - x2 * z1)


def first_column(slope, from_x, offset, width):
    """columns are tested at their left border instead of the centre"""
    column = np.floor(from_x - offset / slope)
    column += slope * (column - from_x) + offset < 0
    return np.clip(column, 0, width)


def first_column(slope, from_x, offset, width):
    """the offset has the wrong sign"""
    column = np.floor(from_x + offset / slope)
    column += slope * (column + 0.5 - from_x) + offset < 0
    return np.clip(column, 0, width)


def first_column(slope, from_x, offset, width):
    """a centre exactly on the edge is left out; >= 0 is in"""
    column = np.floor(from_x - offset / slope)
    column += slope * (column + 0.5 - from_x) + offset <= 0
    return np.clip(column, 0, width)


def row_interval(planes, face, y, width):
    """the sign of edges that end the interval is left out"""
    start, end = np.zeros(len(y)), np.full(len(y), float(width))
    for n_x, n_y, from_x, from_y in zip(*planes, strict=True):
        opens = is_top_left(n_x, n_y).astype(float)
        sign = 2 * opens - 1
        slope, from_x = np.where(n_x == 0, TINY, n_x), np.where(n_x == 0, 0, from_x)
        offset = (sign * n_y)[face] * (y - from_y[face])
        column = first_column(slope[face], from_x[face], offset, width)
        opens = opens[face]
        start = np.maximum(start, opens * column)
        end = np.minimum(end, opens * width + column)
    return start, end


def row_interval(planes, face, y, width):
    """the last opening edge decides, instead of the one farthest right"""
    start, end = np.zeros(len(y)), np.full(len(y), float(width))
    for n_x, n_y, from_x, from_y in zip(*planes, strict=True):
        opens = is_top_left(n_x, n_y).astype(float)
        sign = 2 * opens - 1
        slope, from_x = np.where(n_x == 0, TINY, sign * n_x), np.where(n_x == 0, 0, from_x)
        offset = (sign * n_y)[face] * (y - from_y[face])
        column = first_column(slope[face], from_x[face], offset, width)
        opens = opens[face]
        start = opens * column
        end = np.minimum(end, opens * width + column)
    return start, end


def row_interval(planes, face, y, width):
    """end is the last column that is covered; it is the first one that is not"""
    start, end = np.zeros(len(y)), np.full(len(y), float(width))
    for n_x, n_y, from_x, from_y in zip(*planes, strict=True):
        opens = is_top_left(n_x, n_y).astype(float)
        sign = 2 * opens - 1
        slope, from_x = np.where(n_x == 0, TINY, sign * n_x), np.where(n_x == 0, 0, from_x)
        offset = (sign * n_y)[face] * (y - from_y[face])
        column = first_column(slope[face], from_x[face], offset, width)
        opens = opens[face]
        start = np.maximum(start, opens * column)
        end = np.minimum(end, opens * width + column)
    return start, end - 1
