"""Wrong answers to scanline, written without a look at the checks."""


def half_planes(x, y, w):
    """every normal has the sign of the product of all three w, not of the w of its own opposite corner

    told by: product & w | all three w | w_k | opposite & w | own w | sign & each w | corner & sign & w
    """
    n_x, n_y = np.empty_like(x), np.empty_like(x)
    from_x, from_y = np.empty_like(x), np.empty_like(x)
    side = np.sign(twice_area(x, y)) * np.sign(w).prod(0)
    size = np.abs(w)
    for k, (i, j) in enumerate(EDGES):
        first = (size[i] > size[j]) | ((size[i] == size[j]) & (
            (x[i] < x[j]) | ((x[i] == x[j]) & (y[i] <= y[j]))))
        from_x[k] = np.where(first, x[i], x[j])
        from_y[k] = np.where(first, y[i], y[j])
        n_x[k] = side * (y[i] - y[j])
        n_y[k] = side * (x[j] - x[i])
    return n_x, n_y, from_x, from_y


def depth_slopes(x, y, z):
    """the slope along y has the opposite sign

    told by: dz_dy & sign | along y & sign | opposite sign | minus | negated | dz_dy & negative | y & sign
    """
    ux, uy, uz = (v[1] - v[0] for v in (x, y, z))
    vx, vy, vz = (v[2] - v[0] for v in (x, y, z))
    d = ux * vy - vx * uy
    return (uz * vy - vz * uy) / d, (vx * uz - ux * vz) / d


def first_column(slope, from_x, offset):
    """the column is tested at its left side j instead of at its centre j + 0.5

    told by: centre | center | 0.5 | half | left side | 1/2 | left border
    """
    return np.ceil(from_x - offset / slope)


def row_interval(planes, face, y, left, right):
    """for the edges that end the interval only the slope is negated, the offset along y is not

    told by: offset & sign | n_y & sign | -e | offset & negat | closing & negat | n_y & negat | slope & not & offset
    """
    nx, ny, fx, fy = planes
    begin, end = left[face].astype(float), right[face].astype(float)
    for k in range(3):
        a, b = nx[k][face], ny[k][face]
        opening = is_top_left(a, b)
        steep = np.where(a == 0, TINY, np.where(opening, a, -a))
        origin = np.where(a == 0, 0, fx[k][face])
        column = first_column(steep, origin, b * (y - fy[k][face]))
        begin = np.where(opening, np.maximum(begin, column), begin)
        end = np.where(opening, end, np.minimum(end, column))
    return begin, end
