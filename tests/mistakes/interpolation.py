"""Mistakes of lab 5; each docstring goes on after "this is what comes out when"."""


def fraction_in_space(t, w_0, w_1):
    """the fraction on the screen is taken for that in space"""
    return t


def fraction_in_space(t, w_0, w_1):
    """w_0 and w_1 are swapped"""
    return t * w_1 / lerp(w_0, w_1, t)


def fraction_in_space(t, w_0, w_1):
    """it is measured from the other end"""
    return 1 - t * w_0 / lerp(w_1, w_0, t)


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """the denominator is taken for a constant"""
    v = lerp(w_1, w_0, t)
    grad = grad_q / v**2
    return grad_q * w_0 / v, grad * t * (1 - t) * w_1, -grad * t * (1 - t) * w_0


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """the gradient by w_1 has the wrong sign"""
    v = lerp(w_1, w_0, t)
    grad = grad_q / v**2
    return grad * w_0 * w_1, grad * t * (1 - t) * w_1, grad * t * (1 - t) * w_0


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    """it is divided by v once instead of by v^2"""
    v = lerp(w_1, w_0, t)
    grad = grad_q / v
    return grad * w_0 * w_1, grad * t * (1 - t) * w_1, -grad * t * (1 - t) * w_0


def attribute_on_segment(t, a_0, a_1, w_0, w_1):
    """A / w is not divided by 1 / w again"""
    t = t[:, None]
    return lerp(a_0 / w_0, a_1 / w_1, t)


def attribute_on_segment(t, a_0, a_1, w_0, w_1):
    """the attributes are mixed as they look on the screen: that is not in perspective"""
    t = t[:, None]
    return lerp(a_0, a_1, t)


def attribute_on_segment(t, a_0, a_1, w_0, w_1):
    """the ends are multiplied by w instead of divided"""
    t = t[:, None]
    return lerp(a_0 * w_0, a_1 * w_1, t) / lerp(w_0, w_1, t)


def corrected_barycentrics(e, w):
    """the weights are multiplied by w instead of divided"""
    n = e * w
    return n / n.sum(-1, keepdims=True)


def corrected_barycentrics(e, w):
    """the weights on the screen are taken: 1 / w is missing"""
    n = e
    return n / n.sum(-1, keepdims=True)


def corrected_barycentrics(e, w):
    """the sum is not made 1"""
    n = e / w
    return n


def normalize_backward(grad_b, b, s, axis=0):
    """the sum s is taken for a constant"""
    return grad_b / s


def normalize_backward(grad_b, b, s, axis=0):
    """the share of the sum has the wrong sign"""
    return (grad_b + (grad_b * b).sum(axis, keepdims=True)) / s


def normalize_backward(grad_b, b, s, axis=0):
    """it is the rule of the derivative; here each corner feels what all three weights want"""
    return (grad_b - b * grad_b.sum(axis, keepdims=True)) / s


def interpolate_loop(attributes, faces, face_index, barycentric):
    """the weights go to the corners in reverse order"""
    output = np.zeros((*face_index.shape, attributes.shape[1]))
    for i, j in np.argwhere(face_index >= 0):
        for vertex, b in zip(faces[face_index[i, j]], barycentric[i, j, ::-1], strict=True):
            output[i, j] += b * attributes[vertex]
    return output


def interpolate_loop(attributes, faces, face_index, barycentric):
    """face 0 is taken for no face"""
    output = np.zeros((*face_index.shape, attributes.shape[1]))
    for i, j in np.argwhere(face_index > 0):
        for vertex, b in zip(faces[face_index[i, j]], barycentric[i, j], strict=True):
            output[i, j] += b * attributes[vertex]
    return output


def interpolate_loop(attributes, faces, face_index, barycentric):
    """only the last corner counts"""
    output = np.zeros((*face_index.shape, attributes.shape[1]))
    for i, j in np.argwhere(face_index >= 0):
        for vertex, b in zip(faces[face_index[i, j]], barycentric[i, j], strict=True):
            output[i, j] = b * attributes[vertex]
    return output


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """a vertex keeps the gradient of its last pixel alone; they add up"""
    grad_attributes, grad_barycentric = np.zeros(attributes.shape), np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        for k, vertex in enumerate(faces[face_index[i, j]]):
            grad_attributes[vertex] = barycentric[i, j, k] * grad_output[i, j]
            grad_barycentric[i, j, k] = grad_output[i, j] @ attributes[vertex]
    return grad_attributes, grad_barycentric


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """grad_output is left out of the weights' gradient"""
    grad_attributes, grad_barycentric = np.zeros(attributes.shape), np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        for k, vertex in enumerate(faces[face_index[i, j]]):
            grad_attributes[vertex] += barycentric[i, j, k] * grad_output[i, j]
            grad_barycentric[i, j, k] = attributes[vertex].sum()
    return grad_attributes, grad_barycentric


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    """face 0 is taken for no face"""
    grad_attributes, grad_barycentric = np.zeros(attributes.shape), np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index > 0):
        for k, vertex in enumerate(faces[face_index[i, j]]):
            grad_attributes[vertex] += barycentric[i, j, k] * grad_output[i, j]
            grad_barycentric[i, j, k] = grad_output[i, j] @ attributes[vertex]
    return grad_attributes, grad_barycentric


def weight_rows(faces, face_index, barycentric):
    """start begins with the end of the first row; it begins with 0"""
    face = face_index.reshape(-1)
    start = np.append(np.cumsum(3 * (face >= 0)), 0)
    seen = np.flatnonzero(face >= 0)
    vertex = faces.take(face[seen], 0)
    weight = barycentric.reshape(-1, 3).take(seen, 0)
    return start, vertex.reshape(-1), weight.reshape(-1)


def weight_rows(faces, face_index, barycentric):
    """a row is counted as one entry; it has three"""
    face = face_index.reshape(-1)
    start = np.append(0, np.cumsum(face >= 0))
    seen = np.flatnonzero(face >= 0)
    vertex = faces.take(face[seen], 0)
    weight = barycentric.reshape(-1, 3).take(seen, 0)
    return start, vertex.reshape(-1), weight.reshape(-1)


def weight_rows(faces, face_index, barycentric):
    """face 0 is taken for no face"""
    face = face_index.reshape(-1)
    start = np.append(0, np.cumsum(3 * (face > 0)))
    seen = np.flatnonzero(face > 0)
    vertex = faces.take(face[seen], 0)
    weight = barycentric.reshape(-1, 3).take(seen, 0)
    return start, vertex.reshape(-1), weight.reshape(-1)


def interpolate(attributes, faces, face_index, barycentric):
    """pixels are counted column by column; they go row by row"""
    weights = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    return (
        (weights @ attributes).reshape(*face_index.shape[::-1], attributes.shape[1]).swapaxes(0, 1)
    )


def interpolate(attributes, faces, face_index, barycentric):
    """the pixels are not put back into the rows of the picture"""
    weights = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    return weights @ attributes


def interpolate(attributes, faces, face_index, barycentric):
    """the weights are in reverse order"""
    weights = interpolation_matrix(len(attributes), faces, face_index, barycentric[..., ::-1])
    return (weights @ attributes).reshape(*face_index.shape, attributes.shape[1])


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    """every corner gets the whole gradient, without its weight"""
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
    """the weights' gradient is the mean over the channels instead of the sum"""
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
    """the weights' gradients are in reverse order"""
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
    """the derivatives by x and by y are swapped"""
    by_x, by_y = (interpolate(attributes, faces, face_index, derivatives[..., axis])
                  for axis in (1, 0))
    return np.stack([by_x, by_y], -1)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """the derivatives stand before the channels; they are the last axis"""
    by_x, by_y = (interpolate(attributes, faces, face_index, derivatives[..., axis])
                  for axis in (0, 1))
    return np.stack([by_x, by_y], -2)


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    """y points down"""
    by_x, by_y = (interpolate(attributes, faces, face_index, derivatives[..., axis])
                  for axis in (0, 1))
    return np.stack([by_x, -by_y], -1)


def interpolate_derivatives_backward(grad_output, attributes, faces, face_index, derivatives):
    """only the derivatives by x reach the attributes"""
    by_x, by_y = (interpolate_backward(grad_output[..., axis], attributes, faces, face_index,
                                       derivatives[..., axis]) for axis in (0, 1))
    return by_x[0], np.stack([by_x[1], by_y[1]], -1)


def interpolate_derivatives_backward(grad_output, attributes, faces, face_index, derivatives):
    """the derivatives by x and by y are swapped"""
    by_x, by_y = (interpolate_backward(grad_output[..., axis], attributes, faces, face_index,
                                       derivatives[..., axis]) for axis in (0, 1))
    return by_x[0] + by_y[0], np.stack([by_y[1], by_x[1]], -1)


def interpolate_derivatives_backward(grad_output, attributes, faces, face_index, derivatives):
    """the derivatives stand before the corners; they are the last axis"""
    by_x, by_y = (interpolate_backward(grad_output[..., axis], attributes, faces, face_index,
                                       derivatives[..., axis]) for axis in (0, 1))
    return by_x[0] + by_y[0], np.stack([by_x[1], by_y[1]], -2)
