"""Differentiable rendering on one page: triangles become a picture, and a picture pulls triangles.

    positions -> screen -> seen faces -> plain picture -> blended picture -> loss
              <-        <---------------               <-                 <-       inside of faces
                        <---------------------------------                         at outlines

A closed mesh in front of the camera has V points with a colour each, and F faces: the numbers of
three points, counter-clockwise seen from outside. The loss says how far a picture is from another.
grad_x is how fast the loss grows with x. f_backward takes this of what f returned, and returns it
of what f took. (Lab n) derives a step.

Which face a pixel sees has no gradient: it jumps. So two neighbouring pixels are blended by where
an outline crosses between them. This place has a gradient.

`python3 reference/tiny.py` checks one derivative, and pulls a ball to a star, seen in tiny.ppm.
"""
import numpy as np

EDGES = [(1, 2), (2, 0), (0, 1)]  # edge k of a face joins the two corners other than corner k


def screen_points(positions, camera, size):
    """(Lab 1) Points (V, 3) -> x, y in pixels, depth, w (V,).

    The camera is a matrix (4, 4). It makes w how far in front of it a point lies. What is twice as
    far looks half as large: so X and Y are divided by w. The picture reaches from -1 to 1 in both.
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


def rasterize(x, y, depth, faces, area, size):
    """(Lab 2) Which face is nearest at each pixel's centre, -1 for none, and its depth there."""
    row, column = np.mgrid[:size, :size]  # of each pixel, with its centre half a pixel further
    front = np.flatnonzero(area > 0)  # the other faces turn their backs
    corner = faces[front].T[..., None, None]
    e = edge_functions(x[corner] - column - 0.5, y[corner] - row - 0.5)
    share = e / e.sum(0)
    face_depth = np.where((share >= 0).all(0), (share * depth[corner]).sum(0), np.inf)
    nearest = face_depth.min(0)
    return np.where(nearest < np.inf, front[face_depth.argmin(0)], -1), nearest


def interpolate(colours, x, y, w, faces, seen):
    """(Lab 5) The plain picture, a pixel a row: the mean of its face's corners, sum b_k colour_k.

    b_k = c_k / s, where c_k = e_k / w_k, and s is their sum. Without w_k, what is in the middle on
    the screen would be taken from the middle of the face. But its far half looks smaller.
    """
    pixel = np.flatnonzero(seen >= 0)
    row, column = np.divmod(pixel, len(seen))
    corner = faces[seen[row, column]].T  # (3, N), for N pixels
    to_x = x[corner] - column - 0.5
    to_y = y[corner] - row - 0.5
    c = edge_functions(to_x, to_y) / w[corner]
    s = c.sum(0)
    b = c / s
    picture = np.zeros((seen.size, colours.shape[1]))
    picture[pixel] = (b[..., None] * colours[corner]).sum(0)
    return picture, (pixel, corner, to_x, to_y, b, s)


def interpolate_backward(grad_picture, kept, colours, w):
    """(Lab 7) -> grad_colours (V, C), grad_x, grad_y, grad_w (V,)."""
    pixel, corner, to_x, to_y, b, s = kept
    grad_colours = np.zeros(colours.shape)
    grad_x, grad_y, grad_w = np.zeros((3, len(colours)))
    grad = grad_picture[pixel]
    np.add.at(grad_colours, corner, b[..., None] * grad)  # adds up what many pixels want of a point
    grad_b = (grad * colours[corner]).sum(-1)  # over the channels
    grad_c = (grad_b - (b * grad_b).sum(0)) / s  # b_k = c_k / s, and each c_k is a part of s
    grad_e = grad_c / w[corner]
    np.add.at(grad_w, corner, -grad_e * b * s)  # dc/dw = -c / w, and c = b s
    # e is the cross product of x and y, so a gradient g of e gives x y cross g, and y g cross x.
    np.add.at(grad_x, corner, edge_functions(to_y, grad_e))
    np.add.at(grad_y, corner, edge_functions(grad_e, to_x))
    return grad_colours, grad_x, grad_y, grad_w


def outlines(faces, area):
    """(Lab 8) Is edge k of a face an outline, between a face's front and another's back? (F, 3)"""
    face_at = {(face[i], face[j]): number for number, face in enumerate(faces) for i, j in EDGES}
    beyond = np.array([[face_at[face[j], face[i]] for i, j in EDGES] for face in faces])
    return area[:, None] * area[beyond] <= 0


def row_pairs(x, y, faces, outline, seen, nearest, number):
    """(Lab 8) Neighbours in a row that see different faces, with an outline between their centres.

    The line y = row + 0.5 through both centres leaves the nearer face by the last edge that it
    meets: the outline. -> both pixels, alpha (P,), its ends, their shares (2, P), its slope (P,).
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
    alpha = column + 1 - x[start] - share * (x[end] - x[start])  # and how far left of the border
    last = np.where(meets, np.where(is_left, -alpha, alpha), -np.inf).argmax(0) == [[0], [1], [2]]
    # Flatter outlines are left to the pairs in columns.
    kept = last & meets & outline[face].T & (abs(slope) <= 1) & (abs(alpha) <= 0.5)
    pair = np.nonzero(kept)[1]
    return (number[row, column][pair], number[row, column + 1][pair], alpha[kept],
            np.stack([start, end])[:, kept], np.stack([1 - share, share])[:, kept], slope[kept])


def blend(plain, pairs):
    """(Lab 8) Let the colour change at the outline, and not at the border between two pixels."""
    picture = plain.copy()
    for first, second, alpha, *_ in pairs:
        # alpha of the first pixel gets the second's colour, or -alpha of the second the first's.
        crossed = np.where(alpha > 0, first, second)
        np.add.at(picture, crossed, alpha[:, None] * (plain[second] - plain[first]))
    return picture


def blend_backward(grad_picture, plain, pairs, count):
    """(Lab 8) -> grad_plain, and for count points grad_x, grad_y."""
    grad_plain = grad_picture.copy()
    grad_x, grad_y = np.zeros((2, count))
    for kept, along, across in zip(pairs, [grad_x, grad_y], [grad_y, grad_x], strict=True):
        first, second, alpha, ends, shares, slope = kept
        grad = grad_picture[np.where(alpha > 0, first, second)]
        np.add.at(grad_plain, second, alpha[:, None] * grad)
        np.add.at(grad_plain, first, -alpha[:, None] * grad)
        grad_alpha = (grad * (plain[second] - plain[first])).sum(1)
        # alpha falls as the crossing grows: in a row (1 - share) x_start + share x_end. An end that
        # moves up by dy moves it as much as one that moves left by slope dy.
        np.add.at(along, ends, -grad_alpha * shares)
        np.add.at(across, ends, grad_alpha * shares * slope)
    return grad_plain, grad_x, grad_y


def render(positions, colours, faces, camera, size):
    """(Lab 9) A mesh -> picture (size, size, C), row 0 at the bottom, and what is kept."""
    x, y, depth, w = screen_points(positions, camera, size)
    area = edge_functions(x[faces.T], y[faces.T]).sum(0)  # twice, and < 0 where its back is seen
    seen, nearest = rasterize(x, y, depth, faces, area, size)
    plain, inside = interpolate(colours, x, y, w, faces, seen)
    outline = outlines(faces, area)
    number = np.arange(size * size).reshape(size, size)  # of each pixel
    pairs = (row_pairs(x, y, faces, outline, seen, nearest, number),
             row_pairs(y, x, faces, outline, seen.T, nearest.T, number.T))  # columns become rows
    return blend(plain, pairs).reshape(size, size, -1), (x, y, w, plain, inside, pairs)


def render_backward(grad_picture, kept, colours, camera):
    """(Lab 9) -> grad_positions (V, 3), grad_colours (V, C)."""
    x, y, w, plain, inside, pairs = kept
    grad_plain, outline_x, outline_y = blend_backward(
        grad_picture.reshape(plain.shape), plain, pairs, len(x))
    grad_colours, grad_x, grad_y, grad_w = interpolate_backward(grad_plain, inside, colours, w)
    grad_positions = screen_points_backward(
        grad_x + outline_x, grad_y + outline_y, grad_w, x, y, w, camera, len(grad_picture))
    return grad_positions, grad_colours


def descend(positions, colours, faces, camera, target, steps=300):
    """(Labs 9, 13) Go against the gradient of the loss, sum (picture - target)^2, step by step."""
    near = np.exp(-2 * np.linalg.norm(positions[:, None] - positions, axis=2))
    velocity = 0
    for step in range(steps):
        picture, kept = render(positions, colours, faces, camera, len(target))
        grad_x, grad_colours = render_backward(2 * (picture - target), kept, colours, camera)
        velocity = 0.8 * velocity + near @ grad_x  # what steps and neighbours have in common
        positions = positions - 0.03 * 0.994**step * velocity / np.abs(velocity).max()
        colours = colours - 0.004 * grad_colours * [1, 1, 1, 0]  # the fourth: where a face is
    return positions, colours


def ball(steps):
    """(Lab 11) An octahedron, each face cut in four, steps times -> points (V, 3), faces (F, 3)."""
    right, up, front = np.eye(3)
    sides = [(right, up), (up, -right), (-right, -up), (-up, right)]
    triangles = [(a, b, front) for a, b in sides] + [(b, a, -front) for a, b in sides]
    for _ in range(steps):  # each time all is twice as large
        triangles = [quarter for a, b, c in triangles for quarter in [
            (a + a, a + b, a + c), (b + a, b + b, b + c), (c + a, c + b, c + c),
            (a + b, b + c, c + a)]]
    points, faces = np.unique(np.reshape(triangles, (-1, 3)), axis=0, return_inverse=True)
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
    start, kept = render(positions, grey, faces, camera, size)
    grad_x, _ = render_backward(2 * (start - target), kept, grey, camera)
    move = np.array([0, 0, 1e-6])  # the whole ball, towards the camera
    closer, _ = render(positions + move, grey, faces, camera, size)
    farther, _ = render(positions - move, grey, faces, camera, size)
    difference = ((closer - target)**2 - (farther - target)**2).sum() / 2e-6
    print(f"one derivative, backward {grad_x[:, 2].sum():.7f}, by a difference {difference:.7f}")
    found, _ = render(*descend(positions, grey, faces, camera, target), faces, camera, size)
    print("loss:", ((start - target)**2).sum().round(1), ((found - target)**2).sum().round(1))
    shown = np.hstack([start, found, target])[..., :3].clip(0, 1)**(1 / 2.2)  # as displays want it
    large = np.uint8(255 * shown[::-1]).repeat(4, 0).repeat(4, 1)  # a file begins at the top
    with open("tiny.ppm", "wb") as file:
        file.write(f"P6 {large.shape[1]} {large.shape[0]} 255\n".encode() + large.tobytes())


if __name__ == "__main__":
    main()
