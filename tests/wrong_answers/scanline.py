"""Wrong answers to scanline, written without a look at the checks."""


def depth_slopes(x, y, z):
    """both slopes have the wrong sign: those of the plane's normal, without the minus

    told by: sign | minus | negated | negative | wrong way | uphill
    """
    ux, uy, uz = x[1] - x[0], y[1] - y[0], z[1] - z[0]
    vx, vy, vz = x[2] - x[0], y[2] - y[0], z[2] - z[0]
    nx = uy * vz - uz * vy
    ny = uz * vx - ux * vz
    nz = ux * vy - uy * vx
    return nx / nz, ny / nz


def depth_slopes(x, y, z):
    """divides by the absolute value of the area, so clockwise faces slope the wrong way

    told by: clockwise | winding | absolute | sign of the area | sign of the determinant | orientation
    """
    F = x.shape[1]
    dz_dx, dz_dy = np.empty(F), np.empty(F)
    for f in range(F):
        x1, y1, z1 = x[1, f] - x[0, f], y[1, f] - y[0, f], z[1, f] - z[0, f]
        x2, y2, z2 = x[2, f] - x[0, f], y[2, f] - y[0, f], z[2, f] - z[0, f]
        area = abs(x1 * y2 - x2 * y1)
        dz_dx[f] = (z1 * y2 - z2 * y1) / area
        dz_dy[f] = (x1 * z2 - x2 * z1) / area
    return dz_dx, dz_dy


def first_column(slope, from_x, offset, width):
    """the half pixel of the centre is forgotten: the column of j and not of j + 0.5 is asked

    told by: half a pixel | half pixel | 0.5 | centre | center
    """
    column = np.ceil(from_x - offset / slope)
    return np.clip(column, 0, width)


def first_column(slope, from_x, offset, width):
    """the column is cut to width - 1, so an edge that opens beyond the right border still covers the last column

    told by: width - 1 | last column | from 0 to width | right border | cut to | clip
    """
    column = np.floor(from_x - offset / slope)
    column = column + (slope * (column + 0.5 - from_x) + offset < 0)
    return np.clip(column, 0, width - 1)


def row_interval(planes, face, y, width):
    """start and end are combined the wrong way: the leftmost opening and the rightmost closing edge are kept, the union

    told by: minimum | maximum | min and max | union | leftmost | rightmost
    """
    start = np.full(len(y), float(width))
    end = np.zeros(len(y))
    for n_x, n_y, from_x, from_y in zip(*planes, strict=True):
        opens = is_top_left(n_x, n_y)
        sign = np.where(opens, 1, -1)
        slope = np.where(n_x == 0, TINY, sign * n_x)
        from_x = np.where(n_x == 0, 0, from_x)
        offset = (sign * n_y)[face] * (y - from_y[face])
        column = first_column(slope[face], from_x[face], offset, width)
        o = opens[face]
        start = np.where(o, np.minimum(start, column), start)
        end = np.where(o, end, np.maximum(end, column))
    return start, end


def row_interval(planes, face, y, width):
    """horizontal edges are skipped: the rows above and below the face are not excluded (fine print)

    told by: horizontal | n_x = 0 | n_x == 0 | slope of 0 | rows above | rows below
    """
    start, end = np.zeros(len(y)), np.full(len(y), float(width))
    for k in range(3):
        n_x, n_y, from_x, from_y = (values[k][face] for values in planes)
        opens = n_x > 0
        closes = n_x < 0
        safe = np.where(n_x == 0, 1.0, np.abs(n_x))
        offset = np.where(opens, n_y, -n_y) * (y - from_y)
        column = first_column(safe, from_x, offset, width)
        start = np.where(opens, np.maximum(start, column), start)
        end = np.where(closes, np.minimum(end, column), end)
    return start, end
