"""Mistakes of lab 6's cube maps; each docstring goes on after "this is what comes out when"."""


def on_face(directions):
    """the sign of the largest coordinate is left out: -x, -y and -z have faces of their own"""
    face = 2 * np.argmax(np.abs(directions), 1)
    right, down, m = in_frame(directions, face).T
    return face, (1 + np.stack([right / m, down / m], -1)) / 2


def on_face(directions):
    """u and v stay between -1 and 1: 1/2 (1 + ...) is left out"""
    face = np.argmax(directions @ FRAMES[:, 2].T, 1)
    right, down, m = in_frame(directions, face).T
    return face, np.stack([right / m, down / m], -1)


def on_face(directions):
    """the division by m is left out: the place depends on the direction's length"""
    face = np.argmax(directions @ FRAMES[:, 2].T, 1)
    right, down, _ = in_frame(directions, face).T
    return face, (1 + np.stack([right, down], -1)) / 2


def on_face_backward(grad_uv, directions):
    """m's part is left out: m is in both quotients, and changes with the direction"""
    face, _ = on_face(directions)
    m = in_frame(directions, face)[:, 2:]
    return np.einsum("nij,ni->nj", FRAMES[face, :2], grad_uv / (2 * m))


def on_face_backward(grad_uv, directions):
    """m's part has the wrong sign: the quotient's derivative is (da - (a/m) dm) / m"""
    face, uv = on_face(directions)
    m = in_frame(directions, face)[:, 2:]
    grad_m = (grad_uv * (2 * uv - 1)).sum(1, keepdims=True)
    return np.einsum("nij,ni->nj", FRAMES[face], np.concatenate([grad_uv, grad_m], 1) / (2 * m))


def on_face_backward(grad_uv, directions):
    """the gradient stays in the face's own axes, right, down and out"""
    face, uv = on_face(directions)
    m = in_frame(directions, face)[:, 2:]
    grad_m = -(grad_uv * (2 * uv - 1)).sum(1, keepdims=True)
    return np.concatenate([grad_uv, grad_m], 1) / (2 * m)


def across_edge(face, column, row, size):
    """the face begins again beyond its edge, as with wrap: another face lies there"""
    return face, column % size, row % size


def across_edge(face, column, row, size):
    """the face's own border goes on, as with clamp: another face lies there"""
    return face, np.clip(column, 0, size - 1), np.clip(row, 0, size - 1)


def across_edge(face, column, row, size):
    """the direction goes to the texel's corner: its centre is half a texel further"""
    uv = np.stack([column, row], -1) / size[:, None]
    face, uv = on_face(direction_to(face, uv))
    column, row = nearest_texel(uv.T, size)
    return face, column, row


def face_footprint(directions, jacobian):
    """m's change is left out: the second term of the quotient rule"""
    face, _ = on_face(directions)
    m = in_frame(directions, face)[:, 2, None, None]
    return in_frame(jacobian, face)[:, :2] / (2 * m)


def face_footprint(directions, jacobian):
    """the factor of the second term is u, v instead of 2u - 1, 2v - 1"""
    face, uv = on_face(directions)
    m = in_frame(directions, face)[:, 2, None, None]
    change = in_frame(jacobian, face)
    return (change[:, :2] - uv[..., None] * change[:, 2:]) / (2 * m)


def face_footprint(directions, jacobian):
    """the division is by m instead of 2 m: u grows by 1/2 where right . d / m grows by 1"""
    face, uv = on_face(directions)
    m = in_frame(directions, face)[:, 2, None, None]
    change = in_frame(jacobian, face)
    return (change[:, :2] - (2 * uv - 1)[..., None] * change[:, 2:]) / m
