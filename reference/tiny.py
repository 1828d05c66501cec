"""Differentiable rendering on one page: triangles become a picture, and a picture pulls triangles.

    positions -> screen -> seen faces -> plain picture -> blended picture -> loss
              <-        <---------------               <-                 <-       inside of faces
                        <---------------------------------                         at outlines

Which face a pixel sees has no gradient: it jumps. So two pixels are blended by where an outline
crosses between them. `python3 reference/tiny.py` needs NumPy, checks a derivative, and pulls a ball
to a star's picture: tiny.bmp. (Lab n) derives a step. Left out: speed, faces behind the camera.
"""
import numpy as np

EDGES = np.array([(1, 2), (2, 0), (0, 1)])  # edge k lies across from corner k


def screen_points(positions, camera, size):
    """(Lab 1) positions (V, 3), camera (4, 4) -> x, y in pixels, depth, and w: screen (4, V)."""
    X, Y, Z, w = camera[:, :3] @ positions.T + camera[:, 3:]
    return np.stack([(X / w + 1) * size / 2, (Y / w + 1) * size / 2, Z / w, w])


def screen_points_backward(grad_screen, screen, camera, size):
    """x = (X / w + 1) size / 2: dx/dX = size / 2w, dx/dw = -X / w times that. So with y."""
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
        box = tuple(slice(*np.clip([p.min(), p.max() + 1], 0, size).astype(int)) for p in (y, x))
        row, column = np.mgrid[box]
        e = edge_functions(x - column - 0.5, y - row - 0.5)
        l = e / np.where(e.sum(0) == 0, np.nan, e.sum(0))  # it covers the pixel where all are >= 0
        depth = (l * z).sum(0)
        nearer = (l >= 0).all(0) & (depth < nearest[box])
        seen[box][nearer], nearest[box][nearer] = face, depth[nearer]
    return seen, nearest


def interpolate(colours, screen, faces, seen):
    """(Lab 5) Colours in perspective: sum b_k A_k, b_k = c_k / s, c_k = e_k / w_k, s = sum c_k."""
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
    grad_e = (grad_b - (b * grad_b).sum(0)) / s / screen[3, corner]  # b = c / s, c = e / w
    np.add.at(grad_screen[3], corner, -grad_e * b * s)
    np.add.at(grad_screen[0], corner, edge_functions(y, grad_e))  # e = x cross y, and so
    np.add.at(grad_screen[1], corner, edge_functions(grad_e, x))  # g.(x cross y) = x.(y cross g)
    return grad_colours, grad_screen


def neighbour_pairs(seen, nearest):
    """(Lab 8) Neighbours that see different faces: owner, which sees the nearer one, and other."""
    pixel, seen, nearest = np.arange(seen.size).reshape(seen.shape), seen.ravel(), nearest.ravel()
    pairs = np.stack([np.append(pixel[:, :-1], pixel[:-1]), np.append(pixel[:, 1:], pixel[1:])])
    first, second = pairs[:, seen[pairs[0]] != seen[pairs[1]]]
    return np.where(nearest[first] < nearest[second], [first, second], [second, first])


def corners_across(faces):
    """(Lab 8) The corner beyond each edge, in the face on its other side: (F, 3). Closed meshes."""
    ends = np.sort(faces[:, EDGES], -1).reshape(-1, 2)
    edge = np.unique(ends, axis=0, return_inverse=True)[1].reshape(-1, 3)
    return np.bincount(edge.ravel(), faces.ravel())[edge].astype(int) - faces  # two, less one


def blended_pairs(screen, faces, seen, nearest):
    """(Lab 8) Pairs with an outline between them, at c: 0 at owner's centre, 1 at other's."""
    owner, other = neighbour_pairs(seen, nearest)
    size, face, n, (i, j) = len(seen), seen.ravel()[owner], np.arange(len(owner)), EDGES.T
    dx, dy, corner = other % size - owner % size, other // size - owner // size, faces[face].T
    x, y = screen[0, corner] - owner % size - 0.5, screen[1, corner] - owner // size - 0.5
    u, v = dx * x + dy * y, abs(dy) * x + abs(dx) * y
    crosses = (v[i] < 0) != (v[j] < 0)  # the edge from i to j meets the line v = 0, at c
    c = np.where(crosses, edge_functions(u, v) / np.where(crosses, v[j] - v[i], 1), -np.inf)
    k = c.argmax(0)  # the last: there the line leaves the face
    at, own, across = (EDGES[k].T, n), corner[k, n], corners_across(faces)[face, k]
    ends, u, v, c = corner[at], u[at], v[at], c[k, n]
    side, beyond = (edge_functions(*screen[:2, [*ends, p]]).sum(0) for p in (own, across))
    kept = (side * beyond >= 0) & (abs(v[1] - v[0]) >= abs(u[1] - u[0])) & (0 <= c) & (c <= 1)
    return [part[..., kept] for part in (owner, other, ends, u, v, dx, dy, c)]


def blend(picture, pairs):
    """(Lab 8) The pixel with the edge (c < 1/2: owner) gets (1/2 - c) (other - owner)."""
    owner, other, *_, c = pairs
    flat = picture.reshape(-1, picture.shape[2])
    blended, jump = flat.copy(), flat[other] - flat[owner]
    np.add.at(blended, np.where(c < 0.5, owner, other), (0.5 - c[:, None]) * jump)
    return blended.reshape(picture.shape)


def blend_backward(grad_blended, picture, pairs, screen):
    """(Lab 8) An outline that moves changes colours -> grad_picture, grad_screen (4, V)."""
    owner, other, ends, u, v, dx, dy, c = pairs
    alpha, flat = 0.5 - c[:, None], picture.reshape(-1, picture.shape[2])
    grad_picture, grad_screen = grad_blended.reshape(flat.shape).copy(), np.zeros(screen.shape)
    grad_changed = grad_picture[np.where(c < 0.5, owner, other)]
    np.add.at(grad_picture, other, alpha * grad_changed)
    np.add.at(grad_picture, owner, -alpha * grad_changed)
    slope = (grad_changed * (flat[owner] - flat[other])).sum(1) / (v[1] - v[0])
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
    grad = grad_inside + grad_outline  # both move the corners on the screen
    return screen_points_backward(grad, screen, camera, len(grad_picture)), grad_colours


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
    """(As in lab 13) (1 + Laplacian)^-1 makes a step smooth: the mesh moves as a whole."""
    near, following, velocity = np.zeros((len(x), len(x))), np.roll(faces, 1, 1), 0
    near[faces, following] = near[following, faces] = 1
    smooth = np.linalg.inv(np.eye(len(x)) + np.diag(near.sum(0)) - near)
    for step in range(steps):
        _, grad_x, grad_colours = loss_and_gradients(x, colours, faces, camera, target)
        velocity = 0.8 * velocity + smooth @ grad_x
        x = x - 0.03 * 0.995**step * velocity / max(np.abs(velocity).max(), 1e-30)
        colours = colours - 60 * grad_colours * [1, 1, 1, 0]
    return x, colours


def main(size=64):
    camera = np.array([[3, 0, 0, 0], [0, 3, 0, 0], [0, 0, -1, 3], [0, 0, -1, 4]])
    x, faces = ball(2)
    star = x * (0.78 + 0.25 * np.cos(5 * np.arctan2(x[:, :1], x[:, 1:2])))
    paint = np.insert(0.5 + 0.5 * np.sin(3 * x + np.arange(3)), 3, 1, 1)  # 1: coverage
    scene = np.full(paint.shape, [0.5, 0.5, 0.5, 1]), faces, camera
    target, start = render(star, paint, faces, camera, size)[0], render(x, *scene, size)[0]
    grad_x = loss_and_gradients(x, *scene, target)[1]
    bump = 1e-6 * (grad_x == grad_x.max())  # one coordinate of one vertex
    up, down = (loss_and_gradients(x + d, *scene, target)[0] for d in (bump, -bump))
    print(f"one derivative, backward {grad_x.max():.9f}, by a difference {(up - down) / 2e-6:.9f}")
    found = render(*descend(x, *scene, target), faces, camera, size)[0]
    print("loss before, after:", *(((one - target)**2).mean().round(4) for one in (start, found)))
    shown = np.hstack([start, found, target])[..., 2::-1].repeat(4, 0).repeat(4, 1)  # blue first
    head = np.array([54 + shown.size, 0, 54, 40, *shown.shape[1::-1], 24 << 16 | 1, *6 * [0]], "u4")
    with open("tiny.bmp", "wb") as file:
        file.write(b"BM" + head.tobytes() + np.uint8(255 * shown.clip(0, 1)**(1 / 2.2)).tobytes())


if __name__ == "__main__":
    main()
