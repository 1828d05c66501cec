"""Wrong answers to rasterization, written without a look at the checks."""


def edge_function(p, a, b):
    """e is divided by the length of the edge: a distance in pixels instead of twice the area

    told by: length of the edge | edge's length | distance | |b - a| | divided by & length | normali
    """
    side = b - a
    rel = p - a
    return (side[..., 0] * rel[..., 1] - side[..., 1] * rel[..., 0]) / np.hypot(side[..., 0], side[..., 1])


def edge_function_backward(grad_e, p, a, b):
    """grad_a and grad_b are exchanged

    told by: exchang & grad_b | swap & grad_b | grad_a & grad_b & order | mixed up | a and b | interchang | grad_b & place of
    """
    (px, py), (ax, ay), (bx, by) = (np.moveaxis(v, -1, 0) for v in (p, a, b))
    d_p = np.stack([ay - by, bx - ax], -1)
    d_a = np.stack([by - py, px - bx], -1)
    d_b = np.stack([py - ay, ax - px], -1)
    g = grad_e[..., None]
    return g * d_p, g * d_b, g * d_a


def is_top_left(n_x, n_y):
    """horizontal edges are forgotten: only left edges are taken

    told by: horizontal | n_x == 0 | n_x = 0 | n_x is 0 | only left
    """
    return np.asarray(n_x) > 0


def is_covered(p, triangle):
    """the closing edge, from the last corner to the first, is not tested

    told by: closing edge | last edge | third edge | all three edges | two edges | only two | one edge
    """
    inside = np.ones(p.shape[:-1], dtype=bool)
    for a, b in zip(triangle[:-1], triangle[1:]):
        value = edge_function(p, a, b)
        own = is_top_left(a[1] - b[1], b[0] - a[0])
        inside &= np.where(own, value >= 0, value > 0)
    return inside


def screen_weights(p, triangle):
    """2A is taken without its sign, so all weights of a clockwise triangle are negative

    told by: clockwise | winding | sum to -1 | sum is -1 | absolute | abs & area | signed
    """
    weights = np.empty(p.shape[:-1] + (3,))
    twice = 2 * np.abs(signed_area(triangle))
    for k, (i, j) in enumerate(EDGES):
        weights[..., k] = edge_function(p, triangle[i], triangle[j]) / twice
    return weights


def rasterize_loop(clip, faces, width, height):
    """pixels are sampled at their corner (j, i), not at their centre

    told by: centre | center | 0.5 | half a pixel | half pixel | corner & pixel | 1/2
    """
    index = np.full((height, width), -1)
    nearest = np.full((height, width), np.inf)
    sx, sy, w = screen_points(clip, width, height)
    screen, ndc_z = np.stack([sx, sy], -1), clip[:, 2] / w
    for f, corners in enumerate(faces):
        if signed_area(screen[corners]) < 0:
            corners = corners[[1, 0, 2]]
        triangle = screen[corners]
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        z0, z1, z2 = ndc_z[corners]
        for i in range(y0, y1):
            for j in range(x0, x1):
                p = np.array([float(j), float(i)])
                if is_covered(p, triangle):
                    l = screen_weights(p, triangle)
                    z = z0 + l[1] * (z1 - z0) + l[2] * (z2 - z0)
                    if -1 <= z <= 1 and z < nearest[i, j]:
                        index[i, j], nearest[i, j] = f, z
    return index, nearest
