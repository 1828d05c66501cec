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


def half_planes(x, y, w):
    """the normals are not multiplied by the sign of twice_area, so a clockwise face's half-planes point outward

    told by: clockwise | winding | twice_area | sign & area | outward
    """
    out = np.empty((4, *x.shape))
    for k, (i, j) in enumerate(EDGES):
        near_i = (x[i] < x[j]) | ((x[i] == x[j]) & (y[i] <= y[j]))
        use_i = (abs(w[i]) > abs(w[j])) | ((abs(w[i]) == abs(w[j])) & near_i)
        s = np.sign(w[k])
        out[0, k] = s * (y[i] - y[j])
        out[1, k] = s * (x[j] - x[i])
        out[2, k] = np.where(use_i, x[i], x[j])
        out[3, k] = np.where(use_i, y[i], y[j])
    return tuple(out)


def depth_slopes(x, y, z):
    """the divide is by the area instead of twice the area, so both slopes are doubled

    told by: twice | double | factor & 2 | half | 1/2 | 0.5 | 2a
    """
    ax, ay, az = x[1] - x[0], y[1] - y[0], z[1] - z[0]
    bx, by, bz = x[2] - x[0], y[2] - y[0], z[2] - z[0]
    area = (ax * by - bx * ay) / 2
    return (az * by - bz * ay) / area, (ax * bz - bx * az) / area


def first_column(slope, from_x, offset):
    """the sample is at the left border j of a column instead of its centre j + 0.5

    told by: centre | half a pixel | half a column | 0.5 | 1/2 | left border
    """
    return np.ceil(from_x - offset / slope)


def row_interval(planes, face, y, left, right):
    """every edge with n_x >= 0 opens the interval, so an upper horizontal edge opens it, too, instead of ending it

    told by: horizontal | n_x = 0 | n_x >= 0 | n_x == 0 | upper edge | n_y & top
    """
    first = left[face]
    last = right[face]
    for k in range(3):
        n_x, n_y, fx, fy = (value[k][face] for value in planes)
        opens = n_x >= 0
        sign = np.where(opens, 1, -1)
        slope = np.where(n_x == 0, TINY, sign * n_x)
        fx = np.where(n_x == 0, 0, fx)
        column = first_column(slope, fx, sign * n_y * (y - fy))
        first = np.where(opens, np.maximum(first, column), first)
        last = np.where(opens, last, np.minimum(last, column))
    return first, last


def first_column(slope, from_x, offset):
    """columns to the left of the picture are raised to 0, although j may lie outside

    told by: cut | clip | negative | below 0 | at 0 | outside | to the left
    """
    at = from_x - offset / slope
    return np.maximum(0.0, np.ceil(at - 0.5))


def row_interval(planes, face, y, left, right):
    """left and right bound nothing: the interval is that of the three edges alone

    told by: box | left & right | bound | cut
    """
    first = np.full(len(face), -1e9)
    last = np.full(len(face), 1e9)
    for k in range(3):
        n_x, n_y, fx, fy = (value[k][face] for value in planes)
        opens = is_top_left(n_x, n_y)
        e = np.where(opens, n_y, -n_y) * (y - fy)
        flat = n_x == 0
        column = first_column(np.where(flat, TINY, np.abs(n_x)), np.where(flat, 0, fx), e)
        first = np.where(opens, np.maximum(first, column), first)
        last = np.where(opens, last, np.minimum(last, column))
    return first, last
