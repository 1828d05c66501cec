"""Mistakes of lab 5; each docstring goes on after "this is what comes out when"."""


def fraction_in_space(t, w_0, w_1):
    """t, the fraction on the screen, is returned as it is: the perspective is left out, and
    neither w is used"""
    return t


def fraction_in_space(t, w_0, w_1):
    """w_0 and w_1 are exchanged, which is the way back, from space to the screen. To divide by
    w_0 and w_1 instead of multiplying gives the same"""
    return t * w_1 / lerp(w_0, w_1, t)


def fraction_in_space(t, w_0, w_1):
    """it is measured from the other end: 1 - q came"""
    return 1 - t * w_0 / lerp(w_1, w_0, t)


def fraction_in_space(t, w_0, w_1):
    """the factor t is left out of the numerator, which is t w_0"""
    return w_0 / lerp(w_1, w_0, t)


def fraction_in_space(t, w_0, w_1):
    """w_0 and w_1 are exchanged in the denominator alone: there t goes with w_0, and 1 - t with
    w_1"""
    return t * w_0 / lerp(w_0, w_1, t)


def fraction_in_space(t, w_0, w_1):
    """w_1 stands in the numerator, which is t w_0"""
    return t * w_1 / lerp(w_1, w_0, t)


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """the denominator is taken for constant: the second term of the quotient rule, -u dv, is
    missing"""
    v = lerp(w_1, w_0, t)
    return grad_q * w_0 / v, grad_q * t / v, 0 * v


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """the gradient of w_1 has the wrong sign: it is negative where that of w_0 is positive"""
    v = lerp(w_1, w_0, t)
    grad = grad_q / v**2
    return grad * w_0 * w_1, grad * t * (1 - t) * w_1, grad * t * (1 - t) * w_0


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """all is divided by v once instead of by v^2: the quotient rule has the square of the
    denominator"""
    v = lerp(w_1, w_0, t)
    grad = grad_q / v
    return grad * w_0 * w_1, grad * t * (1 - t) * w_1, -grad * t * (1 - t) * w_0


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """only dt is carried through the quotient rule right: w_0 is in the denominator, too, and
    its second term is missing in the gradients of w_0 and w_1"""
    v = lerp(w_1, w_0, t)
    return grad_q * w_0 * w_1 / v**2, grad_q * t / v, 0 * v


def attribute_on_segment(t, a_0, a_1, w_0, w_1):
    """A / w is interpolated, but not divided by the interpolated 1 / w again: the denominator is
    missing"""
    t = t[:, None]
    return lerp(a_0 / w_0, a_1 / w_1, t)


def attribute_on_segment(t, a_0, a_1, w_0, w_1):
    """the attributes are linear on the screen (affine): the perspective is left out, and neither
    w is used"""
    t = t[:, None]
    return lerp(a_0, a_1, t)


def attribute_on_segment(t, a_0, a_1, w_0, w_1):
    """the attributes are multiplied by w instead of divided, or w_0 and w_1 are exchanged, which
    gives the same"""
    t = t[:, None]
    return lerp(a_0 * w_0, a_1 * w_1, t) / lerp(w_0, w_1, t)


def attribute_on_segment(t, a_0, a_1, w_0, w_1):
    """the attributes in the numerator are not divided by w: A / w is interpolated, not A"""
    t = t[:, None]
    return lerp(a_0, a_1, t) / lerp(1 / w_0, 1 / w_1, t)


def attribute_on_segment(t, a_0, a_1, w_0, w_1):
    """the interpolated A / w is multiplied by the interpolated w. It must be divided by the
    interpolated 1 / w, which is not the same"""
    t = t[:, None]
    return lerp(a_0 / w_0, a_1 / w_1, t) * lerp(w_0, w_1, t)


def barycentric_from_screen(e, w):
    """the weights are multiplied by w instead of divided"""
    n = e * w
    return n / n.sum(-1, keepdims=True)


def barycentric_from_screen(e, w):
    """w makes no difference: the weights on the screen come back without perspective, only divided
    by their sum. e_k must be divided by w_k"""
    n = e
    return n / n.sum(-1, keepdims=True)


def barycentric_from_screen(e, w):
    """the division by the sum s is missing: the weights are not normalised, they do not sum to 1"""
    n = e / w
    return n


def barycentric_from_screen(e, w):
    """e is normalised before the division by w instead of after it. So they do not sum to 1: they
    are divided by the sum of e, not by that of n = e / w"""
    return e / e.sum(-1, keepdims=True) / w


def barycentric_from_screen(e, w):
    """the sum is over all numbers of the whole array, instead of over the three weights of each
    pixel (the last axis)"""
    n = e / w
    return n / n.sum()


def barycentric_from_screen(e, w):
    """the weights are divided by their Euclidean length (the norm) instead of by their sum"""
    n = e / w
    return n / np.linalg.norm(n, axis=-1, keepdims=True)


def normalize_backward(grad_b, b, s, axis=0):
    """the sum s is taken for constant: s depends on n, and the second term of the quotient rule
    is left out"""
    return grad_b / s


def normalize_backward(grad_b, b, s, axis=0):
    """the second term, the share of the sum, has the wrong sign: it is added instead of
    subtracted"""
    return (grad_b + (grad_b * b).sum(axis, keepdims=True)) / s


def normalize_backward(grad_b, b, s, axis=0):
    """it is the derivative forward, eq. (4), and not its transpose: b must stand inside of the
    sum. Each corner feels what all three weights want"""
    return (grad_b - b * grad_b.sum(axis, keepdims=True)) / s


def normalize_backward(grad_b, b, s, axis=0):
    """only the diagonal of the derivative is used: a weight's influence on the other two weights
    is left out, as the sum over the axis is missing"""
    return grad_b * (1 - b) / s


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


def interpolate_loop(attributes, faces, face_index, barycentric):
    """face 0 is taken for no face: only -1 is none"""
    output = np.zeros((*face_index.shape, attributes.shape[1]))
    for i, j in np.argwhere(face_index > 0):
        for vertex, b in zip(faces[face_index[i, j]], barycentric[i, j], strict=True):
            output[i, j] += b * attributes[vertex]
    return output


def interpolate_loop(attributes, faces, face_index, barycentric):
    """only corner 2, the last corner, is left: each corner's term overwrites the one before
    instead of being added (+=)"""
    output = np.zeros((*face_index.shape, attributes.shape[1]))
    for i, j in np.argwhere(face_index >= 0):
        for vertex, b in zip(faces[face_index[i, j]], barycentric[i, j], strict=True):
            output[i, j] = b * attributes[vertex]
    return output


def interpolate_loop(attributes, faces, face_index, barycentric):
    """the weights are left out: barycentric is not used, and the corners are averaged"""
    output = np.zeros((*face_index.shape, attributes.shape[1]))
    for i, j in np.argwhere(face_index >= 0):
        output[i, j] = attributes[faces[face_index[i, j]]].mean(0)
    return output


def interpolate_loop(attributes, faces, face_index, barycentric):
    """the number of the face is used as the number of a vertex: faces says which three vertices
    a face has"""
    output = np.zeros((*face_index.shape, attributes.shape[1]))
    for i, j in np.argwhere(face_index >= 0):
        output[i, j] = barycentric[i, j].sum() * attributes[face_index[i, j]]
    return output


def interpolate_loop(attributes, faces, face_index, barycentric):
    """the weights, or the corners, are in reverse order: corner 2 has the weight of corner 0"""
    output = np.zeros((*face_index.shape, attributes.shape[1]))
    for i, j in np.argwhere(face_index >= 0):
        for vertex, b in zip(faces[face_index[i, j]], barycentric[i, j, ::-1], strict=True):
            output[i, j] += b * attributes[vertex]
    return output


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """a vertex keeps the gradient of its last pixel alone, as = overwrites it; the gradients of
    all pixels that see it add up (+=)"""
    grad_attributes, grad_barycentric = np.zeros(attributes.shape), np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        for k, vertex in enumerate(faces[face_index[i, j]]):
            grad_attributes[vertex] = barycentric[i, j, k] * grad_output[i, j]
            grad_barycentric[i, j, k] = grad_output[i, j] @ attributes[vertex]
    return grad_attributes, grad_barycentric


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """grad_output is left out of grad_barycentric, which is grad_output . A of the corner"""
    grad_attributes, grad_barycentric = np.zeros(attributes.shape), np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        for k, vertex in enumerate(faces[face_index[i, j]]):
            grad_attributes[vertex] += barycentric[i, j, k] * grad_output[i, j]
            grad_barycentric[i, j, k] = attributes[vertex].sum()
    return grad_attributes, grad_barycentric


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """face 0 is taken for no face: only -1 is none"""
    grad_attributes, grad_barycentric = np.zeros(attributes.shape), np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index > 0):
        for k, vertex in enumerate(faces[face_index[i, j]]):
            grad_attributes[vertex] += barycentric[i, j, k] * grad_output[i, j]
            grad_barycentric[i, j, k] = grad_output[i, j] @ attributes[vertex]
    return grad_attributes, grad_barycentric


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """the weights are left out of grad_attributes: every corner gets the whole gradient of the
    pixel, instead of its share b_k"""
    grad_attributes, grad_barycentric = np.zeros(attributes.shape), np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        for k, vertex in enumerate(faces[face_index[i, j]]):
            grad_attributes[vertex] += grad_output[i, j]
            grad_barycentric[i, j, k] = grad_output[i, j] @ attributes[vertex]
    return grad_attributes, grad_barycentric


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """only the first channel goes into grad_barycentric, instead of the sum over all C channels"""
    grad_attributes, grad_barycentric = np.zeros(attributes.shape), np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        for k, vertex in enumerate(faces[face_index[i, j]]):
            grad_attributes[vertex] += barycentric[i, j, k] * grad_output[i, j]
            grad_barycentric[i, j, k] = grad_output[i, j, 0] * attributes[vertex, 0]
    return grad_attributes, grad_barycentric


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """grad_barycentric is the mean over the channels instead of their sum"""
    grad_attributes, grad_barycentric = np.zeros(attributes.shape), np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        for k, vertex in enumerate(faces[face_index[i, j]]):
            grad_attributes[vertex] += barycentric[i, j, k] * grad_output[i, j]
            grad_barycentric[i, j, k] = (grad_output[i, j] * attributes[vertex]).mean()
    return grad_attributes, grad_barycentric


def weight_rows(faces, face_index, barycentric):
    """the leading 0 of start is missing: it has one number too few, H W instead of H W + 1, and
    begins with the end of the first row"""
    face = face_index.reshape(-1)
    start = np.cumsum(3 * (face >= 0))
    seen = np.flatnonzero(face >= 0)
    vertex = faces.take(face[seen], 0)
    weight = barycentric.reshape(-1, 3).take(seen, 0)
    return start, vertex.reshape(-1), weight.reshape(-1)


def weight_rows(faces, face_index, barycentric):
    """start counts one entry for each seen pixel; a row has three entries"""
    face = face_index.reshape(-1)
    start = np.append(0, np.cumsum(face >= 0))
    seen = np.flatnonzero(face >= 0)
    vertex = faces.take(face[seen], 0)
    weight = barycentric.reshape(-1, 3).take(seen, 0)
    return start, vertex.reshape(-1), weight.reshape(-1)


def weight_rows(faces, face_index, barycentric):
    """face 0 is taken for no face: only -1 is none"""
    face = face_index.reshape(-1)
    start = np.append(0, np.cumsum(3 * (face > 0)))
    seen = np.flatnonzero(face > 0)
    vertex = faces.take(face[seen], 0)
    weight = barycentric.reshape(-1, 3).take(seen, 0)
    return start, vertex.reshape(-1), weight.reshape(-1)


def weight_rows(faces, face_index, barycentric):
    """the entries come corner by corner, all corners 0 first, instead of pixel by pixel"""
    face = face_index.reshape(-1)
    start = np.append(0, np.cumsum(3 * (face >= 0)))
    seen = np.flatnonzero(face >= 0)
    vertex = faces.take(face[seen], 0)
    weight = barycentric.reshape(-1, 3).take(seen, 0)
    return start, vertex.T.reshape(-1), weight.T.reshape(-1)


def weight_rows(faces, face_index, barycentric):
    """pixels that see no face have entries, too: -1 is used as an index, of the last face. Their
    rows are empty"""
    start = np.arange(0, 3 * face_index.size + 1, 3)
    return start, faces[face_index].reshape(-1), barycentric.reshape(-1)


def interpolate(attributes, faces, face_index, barycentric):
    """-1 is used as an index: pixels that see no face, the background, get the attributes of the
    last face"""
    return np.einsum("hwk,hwkc->hwc", barycentric, attributes[faces[face_index]])


def interpolate(attributes, faces, face_index, barycentric):
    """pixels are counted column by column; they go row by row, as width is the inner number"""
    weights = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    return (
        (weights @ attributes).reshape(*face_index.shape[::-1], attributes.shape[1]).swapaxes(0, 1)
    )


def interpolate(attributes, faces, face_index, barycentric):
    """the reshape to (H, W, C) is missing: the pixels are not put back into the rows of the
    picture"""
    weights = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    return weights @ attributes


def interpolate(attributes, faces, face_index, barycentric):
    """the weights are in reverse order: corner 2 has that of corner 0"""
    weights = interpolation_matrix(len(attributes), faces, face_index, barycentric[..., ::-1])
    return (weights @ attributes).reshape(*face_index.shape, attributes.shape[1])


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    """the weights are left out of grad_attributes: every corner gets the whole gradient of the
    pixel, instead of its share b_k"""
    weights = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    grad_pixels = grad_output.reshape(-1, attributes.shape[1])
    grad_barycentric = np.zeros((face_index.size, 3))
    for pixel, corners in seen_corners(face_index, faces):
        grad_seen = grad_pixels.take(pixel, 0)
        for k, vertex in enumerate(corners):
            at_corner = attributes.take(vertex, 0)
            grad_barycentric[pixel, k] = np.einsum("nc,nc->n", grad_seen, at_corner)
    return (weights != 0).T @ grad_pixels, grad_barycentric.reshape(barycentric.shape)


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    """grad_barycentric is the mean over the channels instead of their sum"""
    weights = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    grad_pixels = grad_output.reshape(-1, attributes.shape[1])
    grad_barycentric = np.zeros((face_index.size, 3))
    for pixel, corners in seen_corners(face_index, faces):
        grad_seen = grad_pixels.take(pixel, 0)
        for k, vertex in enumerate(corners):
            at_corner = attributes.take(vertex, 0)
            grad_barycentric[pixel, k] = (grad_seen * at_corner).mean(1)
    return weights.T @ grad_pixels, grad_barycentric.reshape(barycentric.shape)


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


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    """the corners' gradients in grad_barycentric are in reverse order"""
    weights = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    grad_pixels = grad_output.reshape(-1, attributes.shape[1])
    grad_barycentric = np.zeros((face_index.size, 3))
    for pixel, corners in seen_corners(face_index, faces):
        grad_seen = grad_pixels.take(pixel, 0)
        for k, vertex in enumerate(corners[::-1]):
            at_corner = attributes.take(vertex, 0)
            grad_barycentric[pixel, k] = np.einsum("nc,nc->n", grad_seen, at_corner)
    return weights.T @ grad_pixels, grad_barycentric.reshape(barycentric.shape)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """dA/dx and dA/dy are exchanged: x is first, y second"""
    by_x, by_y = (interpolate(attributes, faces, face_index, derivatives[..., axis])
                  for axis in (1, 0))
    return np.stack([by_x, by_y], -1)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """x and y are stacked before the channels, (H, W, 2, C): J is transposed. They are the last
    axis"""
    by_x, by_y = (interpolate(attributes, faces, face_index, derivatives[..., axis])
                  for axis in (0, 1))
    return np.stack([by_x, by_y], -2)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """dA/dy has the wrong sign: it is negated, as if y pointed down"""
    by_x, by_y = (interpolate(attributes, faces, face_index, derivatives[..., axis])
                  for axis in (0, 1))
    return np.stack([by_x, -by_y], -1)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """x, y and the channels are mixed up by a reshape: dA/dx and dA/dy are put side by side
    (concatenated), then cut into pairs"""
    by_x, by_y = (interpolate(attributes, faces, face_index, derivatives[..., axis])
                  for axis in (0, 1))
    return np.concatenate([by_x, by_y], -1).reshape(*by_x.shape, 2)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """-1 is used as an index: pixels that see no face, the background, get the derivatives of
    the last face"""
    return np.einsum("hwkd,hwkc->hwcd", derivatives, attributes[faces[face_index]])


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """both derivatives are those by x: derivatives[..., 1] is not used"""
    by_x = interpolate(attributes, faces, face_index, derivatives[..., 0])
    return np.stack([by_x, by_x], -1)


def interpolate_derivatives_backward(grad_output, attributes, faces, face_index, derivatives):
    """grad_attributes has only the part of x, that of y is left out: it is the sum of both"""
    by_x, by_y = (interpolate_backward(grad_output[..., axis], attributes, faces, face_index,
                                       derivatives[..., axis]) for axis in (0, 1))
    return by_x[0], np.stack([by_x[1], by_y[1]], -1)


def interpolate_derivatives_backward(grad_output, attributes, faces, face_index, derivatives):
    """x and y are exchanged in grad_derivatives: x is first, y second"""
    by_x, by_y = (interpolate_backward(grad_output[..., axis], attributes, faces, face_index,
                                       derivatives[..., axis]) for axis in (0, 1))
    return by_x[0] + by_y[0], np.stack([by_y[1], by_x[1]], -1)


def interpolate_derivatives_backward(grad_output, attributes, faces, face_index, derivatives):
    """x and y are stacked before the corners in grad_derivatives; they are the last axis"""
    by_x, by_y = (interpolate_backward(grad_output[..., axis], attributes, faces, face_index,
                                       derivatives[..., axis]) for axis in (0, 1))
    return by_x[0] + by_y[0], np.stack([by_x[1], by_y[1]], -2)


def interpolate_derivatives_backward(grad_output, attributes, faces, face_index, derivatives):
    """grad_attributes is the mean of the parts of x and y instead of the sum of both"""
    by_x, by_y = (interpolate_backward(grad_output[..., axis], attributes, faces, face_index,
                                       derivatives[..., axis]) for axis in (0, 1))
    return (by_x[0] + by_y[0]) / 2, np.stack([by_x[1], by_y[1]], -1)
