"""Lab 2 as printed: what one types who has read the questions and the equations."""


def edge_function(p, a, b):
    n = np.stack([a[..., 1] - b[..., 1], b[..., 0] - a[..., 0]], -1)
    return (n * (p - a)).sum(-1)


def edge_function_backward(grad_e, p, a, b):
    def turn(v):
        return grad_e[..., None] * np.stack([v[..., 1], -v[..., 0]], -1)

    return turn(a - b), turn(b - p), turn(p - a)


def is_top_left(n_x, n_y):
    return (n_x > 0) | ((n_x == 0) & (n_y > 0))


def is_covered(p, triangle):
    covered = True
    for i, j in EDGES:
        a, b = triangle[i], triangle[j]
        e = edge_function(p, a, b)
        covered = covered & ((e > 0) | ((e == 0) & is_top_left(a[1] - b[1], b[0] - a[0])))
    return covered


def screen_weights(p, triangle):
    e = np.stack([edge_function(p, triangle[i], triangle[j]) for i, j in EDGES], -1)
    return e / (e[..., 0] + e[..., 1] + e[..., 2])[..., None]


def rasterize_loop(clip, faces, width, height):
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    x, y, _ = screen_points(clip, width, height)
    z = clip[:, 2] / clip[:, 3]
    for f, face in enumerate(faces):
        if signed_area(np.stack([x[face], y[face]], -1)) < 0:
            face = face[[0, 2, 1]]
        triangle = np.stack([x[face], y[face]], -1)
        x0, y0, x1, y1 = bounding_box(triangle, width, height)
        for i in range(y0, y1):
            for j in range(x0, x1):
                p = np.array([j + 0.5, i + 0.5])
                if is_covered(p, triangle):
                    _, l1, l2 = screen_weights(p, triangle)
                    d = z[face[0]] + l1 * (z[face[1]] - z[face[0]]) + l2 * (z[face[2]] - z[face[0]])
                    if -1 <= d <= 1 and d < depth[i, j]:
                        face_index[i, j] = f
                        depth[i, j] = d
    return face_index, depth
