"""Mistakes of lab 5; each docstring goes on after "this is what comes out when"."""


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """the denominator is taken for constant: the second term of the quotient rule, -u dv, is
    missing"""
    v = lerp(w_1, w_0, t)
    return grad_q * w_0 / v, grad_q * t / v, 0 * v


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """only dt is carried through the quotient rule right: w_0 is in the denominator, too, and
    its second term is missing in the gradients of w_0 and w_1"""
    v = lerp(w_1, w_0, t)
    return grad_q * w_0 * w_1 / v**2, grad_q * t / v, 0 * v


def barycentric_from_screen(e, w):
    """e is normalised before the division by w instead of after it. So they do not sum to 1: they
    are divided by the sum of e, not by that of n = e / w"""
    return e / e.sum(-1, keepdims=True) / w


def normalize_backward(grad_b, b, s, axis=0):
    """the second term, the share of the sum, has the wrong sign: it is added instead of
    subtracted"""
    return (grad_b + (grad_b * b).sum(axis, keepdims=True)) / s


def normalize_backward(grad_b, b, s, axis=0):
    """the division by s is left out, the factor 1/s is missing"""
    return grad_b - (grad_b * b).sum(axis, keepdims=True)


def normalize_backward(grad_b, b, s, axis=0):
    """it is multiplied by b once more, as for softmax. Here the factor is 1/s"""
    return b * (grad_b - (grad_b * b).sum(axis, keepdims=True))


def interpolate_loop(attributes, faces, face_index, barycentric):
    """-1 is used as an index: pixels that see no face, the background, get the attributes of the
    last face"""
    return np.einsum("hwk,hwkc->hwc", barycentric, attributes[faces[face_index]])


def weight_rows(faces, face_index, barycentric):
    """pixels that see no face have entries, too: -1 is used as an index, of the last face. Their
    rows are empty"""
    start = np.arange(0, 3 * face_index.size + 1, 3)
    return start, faces[face_index].reshape(-1), barycentric.reshape(-1)


def interpolate(attributes, faces, face_index, barycentric):
    """-1 is used as an index: pixels that see no face, the background, get the attributes of the
    last face"""
    return np.einsum("hwk,hwkc->hwc", barycentric, attributes[faces[face_index]])


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    """grad[vertex] += ... adds only once for a vertex that several pixels see; np.add.at or B^T
    adds all"""
    grad_attributes = np.zeros(attributes.shape)
    grad_barycentric = np.zeros((face_index.size, 3))
    grad_pixels = grad_output.reshape(-1, attributes.shape[1])
    for pixel, corners in seen_corners(face_index, faces):
        for k, vertex in enumerate(corners):
            share = barycentric.reshape(-1, 3)[pixel, k, None]
            grad_attributes[vertex] += share * grad_pixels[pixel]
            grad_barycentric[pixel, k] = (grad_pixels[pixel] * attributes[vertex]).sum(-1)
    return grad_attributes, grad_barycentric.reshape(barycentric.shape)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """-1 is used as an index: pixels that see no face, the background, get the derivatives of
    the last face"""
    return np.einsum("hwkd,hwkc->hwcd", derivatives, attributes[faces[face_index]])


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """both derivatives are those by x: derivatives[..., 1] is not used"""
    by_x = interpolate(attributes, faces, face_index, derivatives[..., 0])
    return np.stack([by_x, by_x], -1)
