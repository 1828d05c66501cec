"""Wrong answers to interpolation, written without a look at the checks."""


def fraction_in_space(t, w_0, w_1):
    """multiplied by w where one must divide: t w_1 / (t w_1 + (1 - t) w_0), w_0 and w_1 exchanged

    told by: w_0 and w_1 & exchanged | w_0 and w_1 & swapped | w_1 & instead of w_0 | w_0 & instead of w_1 | mixed up & w | w_0 & w_1 & interchanged
    """
    top = t * w_1
    bottom = top + (1 - t) * w_0
    return top / bottom


def barycentric_from_screen(e, w):
    """the weights are multiplied by w instead of divided

    told by: multipl & w | times w | e w & instead | divide & w & instead | e * w | multipl & instead
    """
    product = e * w
    return product / np.sum(product, axis=-1, keepdims=True)


def normalize_backward(grad_b, b, s, axis=0):
    """the sum is always over the last axis, the argument axis is ignored

    told by: axis | axes | along the wrong | last dimension | dimension
    """
    dot = np.sum(grad_b * b, axis=-1, keepdims=True)
    return (grad_b - dot) / s


def interpolate_loop(attributes, faces, face_index, barycentric):
    """= instead of +=: only the last corner's term remains

    told by: last corner | corner 2 | third corner | only one corner | += | overwr | add up
    """
    height, width = face_index.shape
    picture = np.zeros((height, width, attributes.shape[1]))
    for i in range(height):
        for j in range(width):
            f = face_index[i, j]
            if f < 0:
                continue
            for k in range(3):
                picture[i, j] = barycentric[i, j, k] * attributes[faces[f, k]]
    return picture


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """grad_attributes is overwritten at each pixel, not summed: = for +=

    told by: overwrit | += | last pixel | not summed | not added | add up | sum over the pixels | sum & pixels
    """
    to_vertices = np.zeros(attributes.shape)
    to_weights = np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        corners = faces[face_index[i, j]]
        to_vertices[corners] = np.outer(barycentric[i, j], grad_output[i, j])
        to_weights[i, j] = attributes[corners] @ grad_output[i, j]
    return to_vertices, to_weights


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """the last two axes are exchanged: (H, W, 2, C) instead of (H, W, C, 2), so J is transposed

    told by: transpos | last two axes | (H, W, 2 | axes & exchanged | axes & swapped | order of the axes | shape
    """
    return np.stack([interpolate(attributes, faces, face_index, derivatives[..., d])
                     for d in range(2)], axis=2)
