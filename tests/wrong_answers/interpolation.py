"""Wrong answers to interpolation, written without a look at the checks."""


def fraction_in_space(t, w_0, w_1):
    """multiplied by w where one must divide: t w_1 / (t w_1 + (1 - t) w_0), w_0 and w_1 exchanged

    told by: w_0 and w_1 & exchanged | w_0 and w_1 & swapped | w_1 & instead of w_0 | w_0 & instead of w_1 | mixed up & w | w_0 & w_1 & interchanged
    """
    top = t * w_1
    bottom = top + (1 - t) * w_0
    return top / bottom


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """grad_t forgets that t stands in the denominator, too: it is w_0 / v alone

    told by: denominator & t | quotient rule | w_0 / v | grad_t & quotient | grad_t & both
    """
    v = t * w_0 + (1 - t) * w_1
    grad_t = grad_q * w_0 / v
    grad_w_0 = grad_q * (t * v - t * w_0 * t) / v**2
    grad_w_1 = -grad_q * t * w_0 * (1 - t) / v**2
    return grad_t, grad_w_0, grad_w_1


def attribute_on_segment(t, a_0, a_1, w_0, w_1):
    """multiplied by the interpolated w, but only 1 / w is linear on the screen

    told by: 1 / w | 1/w | lerp(w_0 | interpolated w | inverse | reciprocal | w & not linear
    """
    rows = []
    for fraction in t:
        over_w = (1 - fraction) * a_0 / w_0 + fraction * a_1 / w_1
        rows.append(over_w * ((1 - fraction) * w_0 + fraction * w_1))
    return np.array(rows)


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


def weight_rows(faces, face_index, barycentric):
    """start has no leading 0: it begins with the entries up to pixel 0, and row p is slipped by one

    told by: leading 0 | begin & 0 | first & start & 0 | start[0] | one too short | h w + 1 | slipped | one row | one pixel
    """
    flat = face_index.ravel()
    visible = flat >= 0
    counts = np.cumsum(3 * visible)
    begin = np.append(counts, counts[-1])
    return begin, faces[flat[visible]].ravel(), barycentric.reshape(-1, 3)[visible].ravel()


def interpolate(attributes, faces, face_index, barycentric):
    """the pixels are taken as counted column by column instead of row by row

    told by: column by column | row by row | transpos | order of the pixels | reshape | (W, H
    """
    height, width = face_index.shape
    rows = interpolation_matrix(len(attributes), faces, face_index, barycentric) @ attributes
    return rows.reshape(width, height, -1).transpose(1, 0, 2)


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    """+= with an array of repeated vertices: each vertex gets the last of its pixels only

    told by: repeated | += | np.add.at | last pixel | only one pixel | several pixels | not summed | add up | overwrit
    """
    flat = grad_output.reshape(-1, attributes.shape[1])
    b = barycentric.reshape(-1, 3)
    by_vertex = np.zeros(attributes.shape)
    by_weight = np.zeros(b.shape)
    for pixel, corners in seen_corners(face_index, faces):
        for k in range(3):
            by_vertex[corners[k]] += b[pixel, k][:, None] * flat[pixel]
            by_weight[pixel, k] = (flat[pixel] * attributes[corners[k]]).sum(1)
    return by_vertex, by_weight.reshape(barycentric.shape)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """the last two axes are exchanged: (H, W, 2, C) instead of (H, W, C, 2), so J is transposed

    told by: transpos | last two axes | (H, W, 2 | axes & exchanged | axes & swapped | order of the axes | shape
    """
    return np.stack([interpolate(attributes, faces, face_index, derivatives[..., d])
                     for d in range(2)], axis=2)


def interpolate_derivatives_backward(grad_output, attributes, faces, face_index, derivatives):
    """grad_attributes holds only the part of dA/dx, that of dA/dy is not added

    told by: only & dA/dx | only x | dA/dy & missing | dA/dy & forgot | sum of both | both & add | without dA/dy
    """
    grad_derivatives = np.empty_like(derivatives)
    of_x, grad_derivatives[..., 0] = interpolate_backward(
        grad_output[..., 0], attributes, faces, face_index, derivatives[..., 0])
    of_y, grad_derivatives[..., 1] = interpolate_backward(
        grad_output[..., 1], attributes, faces, face_index, derivatives[..., 1])
    return of_x, grad_derivatives
