"""Wrong answers to cube_maps, written without a look at the checks."""


def on_face(directions):
    """the direction is divided by its length, not by m

    told by: length | / m | by m | divi
    """
    unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    face = (unit @ FRAMES[:, 2].T).argmax(1)
    local = (FRAMES[face] @ unit[..., None])[..., 0]
    return face, (1 + local[:, :2]) / 2


def on_face_backward(grad_uv, directions):
    """m is held constant

    told by: m's part | m changes | quotient | constant | m is in both
    """
    face, _ = on_face(directions)
    frame = FRAMES[face]
    m = (frame[:, 2] * directions).sum(1, keepdims=True)
    return (grad_uv[:, :1] * frame[:, 0] + grad_uv[:, 1:] * frame[:, 1]) / (2 * m)


def across_edge(face, column, row, size):
    """the texture repeats on the same face

    told by: wrap | begins again | same face | repeat
    """
    return face, np.mod(column, size), np.mod(row, size)


def face_footprint(directions, jacobian):
    """only the numerator is differentiated, m stays

    told by: m's change | quotient | second | denominator
    """
    face, _ = on_face(directions)
    m = (FRAMES[face, 2] * directions).sum(1)
    return FRAMES[face, :2] @ jacobian / (2 * m[:, None, None])
