"""Wrong answers to cube_maps, written without a look at the checks."""


def on_face(directions):
    """the largest coordinate is taken without its sign: always the positive one of two faces

    told by: sign | negative | absolute | abs | positive
    """
    axis = np.abs(directions).argmax(1)
    face = 2 * axis
    local = (FRAMES[face] @ directions[..., None])[..., 0]
    return face, 0.5 + 0.5 * local[:, :2] / local[:, 2:]


def on_face(directions):
    """the direction is divided by its length, not by m

    told by: length | / m | by m | divi
    """
    unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    face = (unit @ FRAMES[:, 2].T).argmax(1)
    local = (FRAMES[face] @ unit[..., None])[..., 0]
    return face, (1 + local[:, :2]) / 2


def on_face(directions):
    """(u, v) from -1 to 1, the half and the one are forgotten

    told by: -1 | 1/2 | half | between
    """
    face = (directions @ FRAMES[:, 2].T).argmax(1)
    local = (FRAMES[face] @ directions[..., None])[..., 0]
    return face, local[:, :2] / local[:, 2:]


def on_face_backward(grad_uv, directions):
    """m is held constant

    told by: m's part | m changes | quotient | constant | m is in both
    """
    face, _ = on_face(directions)
    frame = FRAMES[face]
    m = (frame[:, 2] * directions).sum(1, keepdims=True)
    return (grad_uv[:, :1] * frame[:, 0] + grad_uv[:, 1:] * frame[:, 1]) / (2 * m)


def on_face_backward(grad_uv, directions):
    """the factor 1/2 of (u, v) is forgotten

    told by: 2 times | twice | factor 2 | 1/2 | half | 2 or 1/m
    """
    face, uv = on_face(directions)
    frame = FRAMES[face]
    m = (frame[:, 2] * directions).sum(1, keepdims=True)
    p = 2 * uv - 1
    grad = np.zeros(directions.shape)
    for k in 0, 1:
        grad += grad_uv[:, k, None] * (frame[:, k] - p[:, k, None] * frame[:, 2]) / m
    return grad


def across_edge(face, column, row, size):
    """the texture repeats on the same face

    told by: wrap | begins again | same face | repeat
    """
    return face, np.mod(column, size), np.mod(row, size)


def across_edge(face, column, row, size):
    """the nearest texel of the same face stands for it

    told by: clamp | border | own | same face
    """
    column = np.minimum(np.maximum(column, 0), size - 1)
    row = np.minimum(np.maximum(row, 0), size - 1)
    return face, column, row


def across_edge(face, column, row, size):
    """the half is missing: direction to the corner of the texel and not to its centre

    told by: half | centre | corner
    """
    u, v = column / size, row / size
    face, uv = on_face(direction_to(face, np.stack([u, v], 1)))
    return face, nearest_texel(uv[:, 0], size), nearest_texel(uv[:, 1], size)


def face_footprint(directions, jacobian):
    """only the numerator is differentiated, m stays

    told by: m's change | quotient | second | denominator
    """
    face, _ = on_face(directions)
    m = (FRAMES[face, 2] * directions).sum(1)
    return FRAMES[face, :2] @ jacobian / (2 * m[:, None, None])


def face_footprint(directions, jacobian):
    """the factor 2 in the denominator is forgotten

    told by: 2 m | twice | 2 times | half | factor 2
    """
    face, uv = on_face(directions)
    m = (FRAMES[face, 2] * directions).sum(1)[:, None, None]
    change = FRAMES[face] @ jacobian
    return (change[:, :2] - (2 * uv - 1)[:, :, None] * change[:, 2:]) / m
