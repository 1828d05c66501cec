"""Differentiable rendering on one page: triangles become a picture, and a picture pulls triangles.

    positions -> screen -> nearest faces -> colours -> blended outlines -> picture -> loss
              <-        <-                  <-      <-                  <-         <-

The arrows back carry the gradient of the loss. `python3 reference/tiny.py` prints one derivative by
them and by a difference, and then pulls a grey ball to the picture of a star: tiny.bmp. The lab in
brackets derives a step, and has what is left out: faces behind the camera, textures, speed, more.
"""
import numpy as np

EDGES = (1, 2), (2, 0), (0, 1)  # edge k lies across from corner k


def screen_points(positions, camera, size):
    """(Lab 1) positions (V, 3), camera (4, 4) -> x, y in pixels, depth, and w: screen (4, V)."""
    X, Y, Z, w = camera[:, :3] @ positions.T + camera[:, 3:]
    return np.stack([(X / w + 1) * size / 2, (Y / w + 1) * size / 2, Z / w, w])


def screen_points_backward(grad_screen, screen, camera, size):
    """(Lab 1) X gets grad_x size / 2w, and w gets -X / w times as much -> grad_positions."""
    grad_XY = grad_screen[:2] * size / 2 / screen[3]
    grad_w = grad_screen[3] - (grad_XY * (2 * screen[:2] / size - 1)).sum(0)
    return np.append(grad_XY, [grad_w], 0).T @ camera[[0, 1, 3], :3]


def edge_functions(x, y):
    """(Lab 2) e_k = x_i y_j - y_i x_j, for a face's corners (3, ...) measured from the pixel."""
    return np.stack([x[i] * y[j] - y[i] * x[j] for i, j in EDGES])


def rasterize(screen, faces, size):
    """(Lab 2) The nearest face at each pixel's centre, -1 for none, and its depth: (size, size)."""
    seen, nearest = np.full((size, size), -1), np.full((size, size), np.inf)
    for face, corner in enumerate(faces):
        x, y, z, _ = screen[:, corner, None, None]
        box = tuple(slice(max(int(p.min()), 0), min(int(p.max()) + 1, size)) for p in (y, x))
        row, column = np.mgrid[box]
        e = edge_functions(x - column - 0.5, y - row - 0.5)
        l = e / np.where(e.sum(0) == 0, np.nan, e.sum(0))  # it covers the pixel where all are >= 0
        depth = (l * z).sum(0)
        nearer = (l >= 0).all(0) & (depth < nearest[box])
        seen[box][nearer], nearest[box][nearer] = face, depth[nearer]
    return seen, nearest


def interpolate(colours, screen, faces, seen):
    """(Lab 5) Pixels in perspective: sum b_k A_k, b_k = c_k / s, c_k = e_k / w_k, s = sum c_k."""
    row, column = np.nonzero(seen >= 0)
    corner = faces[seen[row, column]].T
    x, y = screen[0, corner] - column - 0.5, screen[1, corner] - row - 0.5
    c = edge_functions(x, y) / screen[3, corner]
    b, s = c / c.sum(0), c.sum(0)
    picture = np.zeros((*seen.shape, colours.shape[1]))
    picture[row, column] = (b[..., None] * colours[corner]).sum(0)
    return picture, (row, column, corner, x, y, b, s)


def interpolate_backward(grad_picture, kept, colours, screen):
    """(Lab 7) -> grad_colours (V, C), grad_screen (4, V)."""
    row, column, corner, x, y, b, s = kept
    grad = grad_picture[row, column]
    grad_colours, grad_screen = np.zeros(colours.shape), np.zeros(screen.shape)
    np.add.at(grad_colours, corner, b[..., None] * grad)  # what was gathered is scattered
    grad_b = (grad * colours[corner]).sum(-1)
    grad_c = (grad_b - (b * grad_b).sum(0)) / s           # b = c / sum c
    grad_e = grad_c / screen[3, corner]                   # c = e / w
    np.add.at(grad_screen[3], corner, -grad_e * b * s)
    for k, (i, j) in enumerate(EDGES):                    # e_k = x_i y_j - y_i x_j
        grads = grad_e[k] * [[y[j], -y[i]], [-x[j], x[i]]]
        np.add.at(grad_screen, np.s_[:2, corner[[i, j]]], grads)
    return grad_colours, grad_screen


def neighbour_pairs(seen, nearest):
    """(Lab 8) Neighbours that see different faces: owner, which sees the nearer one, and other."""
    pixel, seen, nearest = np.arange(seen.size).reshape(seen.shape), seen.ravel(), nearest.ravel()
    pairs = np.stack([np.append(pixel[:, :-1], pixel[:-1]), np.append(pixel[:, 1:], pixel[1:])])
    first, second = pairs[:, seen[pairs[0]] != seen[pairs[1]]]
    return np.where(nearest[first] < nearest[second], [first, second], [second, first])


def blended_pairs(screen, faces, seen, nearest):
    """(Lab 8) Pairs that an outline parts, at c on the way from owner (u = 0) to other (u = 1)."""
    number = np.unique(np.sort(faces[:, EDGES], -1).reshape(-1, 2), axis=0, return_inverse=True)[1]
    both = np.bincount(number.ravel(), faces.ravel())  # an edge has a corner on either side: a sum
    owner, other = neighbour_pairs(seen, nearest)
    size, face, n = len(seen), seen.ravel()[owner], np.arange(len(owner))
    dx, dy, corner = other % size - owner % size, other // size - owner // size, faces[face].T
    x, y = screen[0, corner] - owner % size - 0.5, screen[1, corner] - owner // size - 0.5
    u, v = dx * x + dy * y, abs(dy) * x + abs(dx) * y
    with np.errstate(all="ignore"):  # an edge from one side of v = 0 to the other crosses it at c
        c = np.stack([np.where((v[i] < 0) != (v[j] < 0), u[i] - v[i] * (u[j] - u[i])
                               / (v[j] - v[i]), -np.inf) for i, j in EDGES])
    k = c.argmax(0)
    ends, own = corner[np.array(EDGES)[k].T, n], corner[k, n]
    across = both.astype(int)[number.reshape(-1, 3)[face, k]] - own
    area, beside = (edge_functions(*screen[:2, [*ends, p]]).sum(0) for p in (own, across))
    (u, v), c = (part[np.array(EDGES)[k].T, n] for part in (u, v)), c[k, n]
    kept = (area * beside > 0) & (abs(v[1] - v[0]) >= abs(u[1] - u[0])) & (abs(c - 0.5) < 9 / 16)
    return [part[..., kept] for part in (owner, other, ends, u, v, dx, dy, c)]


def blend(picture, pairs):
    """(Lab 8) changed += alpha (other - owner), alpha = 1/2 - c, in the pixel that has the edge."""
    owner, other, *_, c = pairs
    alpha, flat = 0.5 - c.clip(0, 1)[:, None], picture.reshape(-1, picture.shape[2])
    blended = flat.copy()
    np.add.at(blended, np.where(c < 0.5, owner, other), alpha * (flat[other] - flat[owner]))
    return blended.reshape(picture.shape)


def blend_backward(grad_blended, picture, pairs, screen):
    """(Lab 8) An outline that moves changes colours -> grad_picture, grad_screen (4, V)."""
    owner, other, ends, u, v, dx, dy, c = pairs
    alpha, flat = 0.5 - c.clip(0, 1)[:, None], picture.reshape(-1, picture.shape[2])
    grad_picture, grad_screen = grad_blended.reshape(flat.shape).copy(), np.zeros(screen.shape)
    grad_changed = grad_picture[np.where(c < 0.5, owner, other)]
    np.add.at(grad_picture, other, alpha * grad_changed)
    np.add.at(grad_picture, owner, -alpha * grad_changed)
    grad_c = np.where(abs(c - 0.5) < 0.5, (grad_changed * (flat[owner] - flat[other])).sum(1), 0)
    slope = grad_c / (v[1] - v[0])  # c = (u_0 v_1 - u_1 v_0) / (v_1 - v_0)
    grad_u, grad_v = slope * np.stack([v[1], -v[0]]), slope * np.stack([c - u[1], u[0] - c])
    np.add.at(grad_screen[0], ends, dx * grad_u + abs(dy) * grad_v)
    np.add.at(grad_screen[1], ends, dy * grad_u + abs(dx) * grad_v)
    return grad_picture.reshape(picture.shape), grad_screen


def render(positions, colours, faces, camera, size):
    """(Lab 9) A closed mesh with colours (V, C) -> picture (size, size, C), and what is kept."""
    screen = screen_points(positions, camera, size)
    seen, nearest = rasterize(screen, faces, size)
    plain, inside = interpolate(colours, screen, faces, seen)
    pairs = blended_pairs(screen, faces, seen, nearest)
    return blend(plain, pairs), (screen, plain, inside, pairs)


def render_backward(grad_picture, kept, colours, camera):
    """(Lab 9) -> grad_positions (V, 3), grad_colours (V, C)."""
    screen, plain, inside, pairs = kept
    grad_plain, grad_outline = blend_backward(grad_picture, plain, pairs, screen)
    grad_colours, grad_inside = interpolate_backward(grad_plain, inside, colours, screen)
    return screen_points_backward(grad_outline + grad_inside, screen, camera,
                                  len(grad_picture)), grad_colours


def ball(steps):
    """(Lab 11) An octahedron, each face cut in four, steps times: vertices (V, 3), faces (F, 3)."""
    soup = (2 * np.array([*np.ndindex(2, 2, 2)]) - 1)[:, :, None] * np.eye(3)
    for _ in range(steps):
        middle = (soup + np.roll(soup, -1, 1)) / 2
        corners = [np.stack([soup[:, k], middle[:, k], middle[:, k - 1]], 1) for k in range(3)]
        soup = np.concatenate([middle, *corners])
    vertices, faces = np.unique(soup.reshape(-1, 3), axis=0, return_inverse=True)
    return vertices / np.linalg.norm(vertices, axis=1, keepdims=True), faces.reshape(-1, 3)


def loss_and_gradients(x, colours, faces, camera, target):
    """(Lab 9) The mean squared error of a picture -> loss, grad_positions, grad_colours."""
    picture, kept = render(x, colours, faces, camera, len(target))
    grads = render_backward(2 * (picture - target) / picture.size, kept, colours, camera)
    return ((picture - target)**2).mean(), *grads


def descend(x, colours, faces, camera, target, steps=400):
    """(Lab 13) Downhill. (1 + Laplacian)^-1 makes each step smooth, so that the mesh stays one."""
    near, following, mean = np.zeros((len(x), len(x))), np.roll(faces, 1, 1), 0
    near[faces, following] = near[following, faces] = 1
    smooth = np.linalg.inv(np.eye(len(x)) + np.diag(near.sum(0)) - near)
    for step in range(steps):
        _, grad_x, grad_colours = loss_and_gradients(x, colours, faces, camera, target)
        mean = 0.8 * mean + smooth @ grad_x
        x = x - 0.03 * 0.995**step * mean / np.abs(mean).max()
        colours = colours - 60 * grad_colours * [1, 1, 1, 0]
    return x, colours


def main(size=64):
    camera = np.array([[3, 0, 0, 0], [0, 3, 0, 0], [0, 0, -1, 3], [0, 0, -1, 4]])
    x, faces = ball(2)
    star = x * (0.78 + 0.25 * np.cos(5 * np.arctan2(x[:, :1], x[:, 1:2])))
    paint = np.insert(0.5 + 0.5 * np.sin(3 * x + np.arange(3)), 3, 1, 1)  # 1: the mesh is there
    scene = np.full(paint.shape, [0.5, 0.5, 0.5, 1]), faces, camera
    target, start = render(star, paint, faces, camera, size)[0], render(x, *scene, size)[0]
    grad_x = loss_and_gradients(x, *scene, target)[1]
    bump = 1e-6 * (grad_x == grad_x.max())  # one coordinate of one vertex
    up, down = (loss_and_gradients(x + d, *scene, target)[0] for d in (bump, -bump))
    print(f"one derivative, backward {grad_x.max():.9f}, by a difference {(up - down) / 2e-6:.9f}")
    found = render(*descend(x, *scene, target), faces, camera, size)[0]
    print("loss before, after:", *(((one - target)**2).mean().round(4) for one in (start, found)))
    shown = np.hstack([start, found, target])[..., 2::-1].repeat(4, 0).repeat(4, 1)  # blue first
    head = [54 + shown.size, 0, 54, 40, *shown.shape[1::-1], 1 | 24 << 16, 0, 0, 0, 0, 0, 0]
    shown, head = np.uint8(255 * shown.clip(0, 1)**(1 / 2.2)), np.array(head, "<u4")
    with open("tiny.bmp", "wb") as file:
        file.write(b"BM" + head.tobytes() + shown.tobytes())


if __name__ == "__main__":
    main()
