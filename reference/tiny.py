"""Differentiable rendering on one page: triangles become a picture, and a picture pulls triangles.

    positions -> screen -> seen faces -> plain picture -> blended picture -> loss
              <-        <---------------               <-                 <-       inside of faces
                        <---------------------------------                         at outlines

A closed mesh has V points with a colour each, and F faces, its triangles: the numbers of three
points, counter-clockwise seen from outside. A picture has size x size pixels, row 0 at the bottom.
The loss says how far it is from another one. grad_x is the gradient of the loss with respect to x:
how fast the loss grows with each number of x. f_backward takes this of what f returned, and returns
it of what f took. (Lab n) derives a step. Left out: speed, and faces behind the camera.

Which face a pixel sees has no gradient: it jumps. So two neighbouring pixels are blended by where
an outline crosses between them. This place has a gradient.

`python3 reference/tiny.py` checks one derivative, and pulls a ball until it looks like a star.
tiny.ppm, a file that most viewers open, shows the ball, what became of it, and the star.
"""
import numpy as np

EDGES = [(1, 2), (2, 0), (0, 1)]  # edge k of a face joins the two corners other than corner k


def screen_points(positions, camera, size):
    """(Lab 1) Points (V, 3) -> x, y in pixels, depth, w (V,).

    The camera is a matrix (4, 4). It makes w the distance from itself. What is twice as far away
    looks half as large: so X and Y are divided by w. The picture reaches from -1 to 1 in both.
    """
    X, Y, Z, w = camera[:, :3] @ positions.T + camera[:, 3:]
    return (X / w + 1) * size / 2, (Y / w + 1) * size / 2, Z / w, w


def screen_points_backward(grad_x, grad_y, grad_w, x, y, w, camera, size):
    """x = (X / w + 1) size / 2, so dx/dX = size / 2w, and dx/dw = -X / w dx/dX. So with y."""
    grad_X = grad_x * size / (2 * w)
    grad_Y = grad_y * size / (2 * w)
    grad_w = grad_w - (2 * x / size - 1) * grad_X - (2 * y / size - 1) * grad_Y  # X / w, Y / w
    return np.stack([grad_X, grad_Y, grad_w], 1) @ camera[[0, 1, 3], :3]  # what made X, Y and w


def edge_functions(x, y):
    """(Lab 2) e_k: twice the area of the triangle between a place and edge k of a face.

    x, y (3, ...) lead from the place to the face's corners. Counter-clockwise triangles have an
    area > 0, so all e_k > 0 mean: it lies inside. Their sum is twice the area of the face.
    """
    return np.stack([x[i] * y[j] - y[i] * x[j] for i, j in EDGES])


def face_areas(x, y, faces):
    """Twice the area of each face on the screen (F,), negative where its back is seen."""
    return edge_functions(x[faces.T], y[faces.T]).sum(0)


def rasterize(x, y, depth, faces, size):
    """(Lab 2) Which face is nearest at each pixel's centre, -1 for none, and its depth there."""
    seen = np.full((size, size), -1)
    nearest = np.full((size, size), np.inf)
    row, column = np.mgrid[:size, :size]  # of each pixel, with its centre half a pixel further
    area = face_areas(x, y, faces)
    for face in np.flatnonzero(area > 0):
        corner = faces[face].reshape(3, 1, 1)
        share = edge_functions(x[corner] - column - 0.5, y[corner] - row - 0.5) / area[face]
        face_depth = (share * depth[corner]).sum(0)  # a mean, as the shares add up to 1
        nearer = (share >= 0).all(0) & (face_depth < nearest)
        seen[nearer] = face
        nearest[nearer] = face_depth[nearer]
    return seen, nearest


def interpolate(colours, x, y, w, faces, seen):
    """(Lab 5) The plain picture: pixels get a mean of their face's corners, sum b_k colour_k.

    b_k = c_k / s, where c_k = e_k / w_k, and s is their sum. Without w_k, what is in the middle on
    the screen would be taken from the middle of the face. But its far half looks smaller.
    """
    row, column = np.nonzero(seen >= 0)
    corner = faces[seen[row, column]].T  # (3, N), for N pixels
    to_x = x[corner] - column - 0.5
    to_y = y[corner] - row - 0.5
    c = edge_functions(to_x, to_y) / w[corner]
    s = c.sum(0)
    b = c / s
    picture = np.zeros((*seen.shape, colours.shape[1]))
    picture[row, column] = (b[..., None] * colours[corner]).sum(0)
    return picture, (row, column, corner, to_x, to_y, b, s)


def interpolate_backward(grad_picture, kept, colours, w):
    """(Lab 7) -> grad_colours (V, C), grad_x, grad_y, grad_w (V,).

    A point is a corner for many pixels: np.add.at adds up what comes back from all of them.
    """
    row, column, corner, to_x, to_y, b, s = kept
    grad_colours = np.zeros(colours.shape)
    grad_x, grad_y, grad_w = np.zeros((3, len(colours)))
    grad = grad_picture[row, column]
    np.add.at(grad_colours, corner, b[..., None] * grad)  # each corner gave b of its colour
    grad_b = (grad * colours[corner]).sum(-1)  # over the channels
    grad_c = (grad_b - (b * grad_b).sum(0)) / s  # b_k = c_k / s, and each c_k is a part of s
    grad_e = grad_c / w[corner]
    np.add.at(grad_w, corner, -grad_e * b * s)  # dc/dw = -c / w, and c = b s
    # e is the cross product of x and y, so a gradient g of e gives x y cross g, and y g cross x.
    np.add.at(grad_x, corner, edge_functions(to_y, grad_e))
    np.add.at(grad_y, corner, edge_functions(grad_e, to_x))
    return grad_colours, grad_x, grad_y, grad_w


def outlines(x, y, faces):
    """(Lab 8) Is edge k of a face an outline, between a face's front and another's back? (F, 3)"""
    face_at = {(face[i], face[j]): number for number, face in enumerate(faces) for i, j in EDGES}
    beyond = np.array([[face_at[face[j], face[i]] for i, j in EDGES] for face in faces])
    area = face_areas(x, y, faces)
    return area[:, None] * area[beyond] <= 0


def row_pairs(x, y, faces, seen, nearest, number):
    """(Lab 8) Neighbours in a row that see different faces, with an outline between their centres.

    It is an outline of the nearer face. The line y = row + 0.5 runs through both centres. On the
    way from the nearer face's pixel it leaves that face by the last edge that it meets.
    """
    row, column = np.nonzero(seen[:, :-1] != seen[:, 1:])  # of the left pixel
    is_left = nearest[row, column] < nearest[row, column + 1]  # is the left face the nearer one?
    face = seen[row, np.where(is_left, column, column + 1)]
    start = faces[face][:, [1, 2, 0]].T  # (3, N), the points where edges 0, 1 and 2 start
    end = faces[face][:, [2, 0, 1]].T
    meets = (y[start] < row + 0.5) != (y[end] < row + 0.5)  # one end below the line, one above
    rise = np.where(meets, y[end] - y[start], np.inf)  # never divide by 0
    slope = (x[end] - x[start]) / rise
    share = (row + 0.5 - y[start]) / rise  # how far from start to end the edge meets the line
    crossing = x[start] + share * (x[end] - x[start])
    last = np.where(meets, np.where(is_left, crossing, -crossing), -np.inf).argmax(0)
    start, end, meets, slope, share, crossing = (
        np.choose(last, part) for part in (start, end, meets, slope, share, crossing))
    alpha = column + 1 - crossing  # how far left of the border between the two pixels
    # Flatter outlines are left to the pairs in columns.
    kept = outlines(x, y, faces)[face, last] & meets & (abs(slope) <= 1) & (abs(alpha) <= 0.5)
    pairs = (number[row, column], number[row, column + 1], alpha,
             np.stack([start, end]), np.stack([1 - share, share]), slope)
    return [part[..., kept] for part in pairs]


def blend(picture, pairs):
    """(Lab 8) Let the colour change at the outline, and not at the border between two pixels.

    If it crosses in the first pixel, the part alpha of that one gets the second one's colour. Else
    alpha <= 0, and the part -alpha of the second one gets the first one's.
    """
    flat = picture.reshape(-1, picture.shape[2])
    blended = flat.copy()
    for first, second, alpha, *_ in pairs:
        crossed = np.where(alpha > 0, first, second)
        np.add.at(blended, crossed, alpha[:, None] * (flat[second] - flat[first]))
    return blended.reshape(picture.shape)


def blend_backward(grad_blended, picture, pairs, count):
    """(Lab 8) -> grad_picture, and for count points grad_x, grad_y.

    alpha falls as the crossing grows, and that is (1 - share) x_start + share x_end in a row. An
    end that moves up by dy moves the crossing as much as one that moves left by slope dy.
    """
    flat = picture.reshape(-1, picture.shape[2])
    grad_flat = grad_blended.reshape(flat.shape)
    grad_picture = grad_flat.copy()
    grad_x, grad_y = np.zeros((2, count))
    in_rows, in_columns = pairs
    for grad_along, grad_across, kept in (grad_x, grad_y, in_rows), (grad_y, grad_x, in_columns):
        first, second, alpha, ends, shares, slope = kept
        grad_crossed = grad_flat[np.where(alpha > 0, first, second)]
        np.add.at(grad_picture, second, alpha[:, None] * grad_crossed)
        np.add.at(grad_picture, first, -alpha[:, None] * grad_crossed)
        grad_alpha = (grad_crossed * (flat[second] - flat[first])).sum(1)
        np.add.at(grad_along, ends, -grad_alpha * shares)
        np.add.at(grad_across, ends, grad_alpha * shares * slope)
    return grad_picture.reshape(picture.shape), grad_x, grad_y


def render(positions, colours, faces, camera, size):
    """(Lab 9) A mesh with colours (V, C) -> picture (size, size, C), and what is kept."""
    x, y, depth, w = screen_points(positions, camera, size)
    seen, nearest = rasterize(x, y, depth, faces, size)
    plain, inside = interpolate(colours, x, y, w, faces, seen)
    number = np.arange(size * size).reshape(size, size)  # of each pixel
    pairs = (row_pairs(x, y, faces, seen, nearest, number),
             row_pairs(y, x, faces, seen.T, nearest.T, number.T))  # columns become rows
    return blend(plain, pairs), (x, y, w, plain, inside, pairs)


def render_backward(grad_picture, kept, colours, camera):
    """(Lab 9) -> grad_positions (V, 3), grad_colours (V, C)."""
    x, y, w, plain, inside, pairs = kept
    grad_plain, outline_x, outline_y = blend_backward(grad_picture, plain, pairs, len(x))
    grad_colours, grad_x, grad_y, grad_w = interpolate_backward(grad_plain, inside, colours, w)
    grad_positions = screen_points_backward(
        grad_x + outline_x, grad_y + outline_y, grad_w, x, y, w, camera, len(plain))
    return grad_positions, grad_colours


def loss_and_gradients(positions, colours, faces, camera, target):
    """(Lab 9) The mean squared error of a picture -> loss, grad_positions, grad_colours."""
    picture, kept = render(positions, colours, faces, camera, len(target))
    error = picture - target
    return (error**2).mean(), *render_backward(2 * error / error.size, kept, colours, camera)


def descend(positions, colours, faces, camera, target, steps=400):
    """(Labs 9, 13) Go against the gradient, step by step.

    It pulls single points, at outlines. smooth spreads that over their neighbours, and velocity
    keeps what steps have in common.
    """
    joined = np.zeros((len(positions), len(positions)))
    for i, j in EDGES:
        joined[faces[:, i], faces[:, j]] = 1  # each edge is in two faces, once from either end
    laplacian = np.diag(joined.sum(0)) - joined  # a point's neighbours times it, less all of them
    smooth = np.linalg.inv(np.eye(len(positions)) + laplacian)
    velocity = 0
    for step in range(steps):
        _, grad_x, grad_colours = loss_and_gradients(positions, colours, faces, camera, target)
        velocity = 0.8 * velocity + smooth @ grad_x
        positions = positions - 0.03 * 0.995**step * velocity / np.abs(velocity).max()
        colours = colours - 60 * grad_colours * [1, 1, 1, 0]  # the fourth says where a face is
    return positions, colours


def ball(steps):
    """(Lab 11) An octahedron, each face cut in four, steps times -> points (V, 3), faces (F, 3)."""
    right, up, front = np.eye(3)
    around = [right, up, -right, -up]
    triangles = np.array([[front, around[k - 1], around[k]] for k in range(4)]
                         + [[-front, around[k], around[k - 1]] for k in range(4)])
    for _ in range(steps):
        a, b, c = triangles.transpose(1, 0, 2)
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        quarters = [a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]
        triangles = np.concatenate([np.stack(quarter, 1) for quarter in quarters])
    points, faces = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    return points / np.linalg.norm(points, axis=1, keepdims=True), faces.reshape(-1, 3)


def main(size=64):
    """Pull a grey ball to the picture of a painted star."""
    camera = np.array([[3, 0, 0, 0], [0, 3, 0, 0], [0, 0, -1, 3], [0, 0, -1, 4]])
    positions, faces = ball(2)
    angle = np.arctan2(positions[:, :1], positions[:, 1:2])
    star = positions * (0.78 + 0.25 * np.cos(5 * angle))
    paint = np.insert(0.5 + 0.5 * np.sin(3 * positions + np.arange(3)), 3, 1, axis=1)
    grey = np.full(paint.shape, [0.5, 0.5, 0.5, 1])  # red, green, blue, and 1 where a face is
    target, _ = render(star, paint, faces, camera, size)
    start, _ = render(positions, grey, faces, camera, size)
    before, grad_x, _ = loss_and_gradients(positions, grey, faces, camera, target)
    bump = np.zeros(positions.shape)
    bump.flat[grad_x.argmax()] = 1e-6  # one coordinate of one point
    up, *_ = loss_and_gradients(positions + bump, grey, faces, camera, target)
    down, *_ = loss_and_gradients(positions - bump, grey, faces, camera, target)
    print(f"one derivative, backward {grad_x.max():.9f}, by a difference {(up - down) / 2e-6:.9f}")
    found, _ = render(*descend(positions, grey, faces, camera, target), faces, camera, size)
    print("loss before, after:", before.round(4), ((found - target)**2).mean().round(4))
    shown = np.hstack([start, found, target])[..., :3].clip(0, 1)**(1 / 2.2)  # as displays want it
    large = np.uint8(255 * shown[::-1]).repeat(4, 0).repeat(4, 1)  # a file begins at the top
    with open("tiny.ppm", "wb") as file:
        file.write(f"P6 {large.shape[1]} {large.shape[0]} 255\n".encode() + large.tobytes())


if __name__ == "__main__":
    main()
