"""Lab 5 as printed: what one types who has read the questions and the equations."""


def fraction_in_space(t, w_0, w_1):
    return t * w_0 / (t * w_0 + (1 - t) * w_1)


def barycentric_from_screen(e, w):
    n = e / w
    s = n[..., 0] + n[..., 1] + n[..., 2]
    return n / s[..., None]


def normalize_backward(grad_b, b, s, axis=0):
    return (grad_b - np.sum(grad_b * b, axis=axis, keepdims=True)) / s


def interpolate_loop(attributes, faces, face_index, barycentric):
    height, width = face_index.shape
    picture = np.zeros((height, width, attributes.shape[1]))
    for i in range(height):
        for j in range(width):
            if face_index[i, j] != -1:
                A_0, A_1, A_2 = attributes[faces[face_index[i, j]]]
                b_0, b_1, b_2 = barycentric[i, j]
                picture[i, j] = b_0 * A_0 + b_1 * A_1 + b_2 * A_2
    return picture


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    grad_attributes = np.zeros(attributes.shape)
    grad_barycentric = np.zeros(barycentric.shape)
    height, width = face_index.shape
    for i in range(height):
        for j in range(width):
            if face_index[i, j] != -1:
                for k in range(3):
                    vertex = faces[face_index[i, j], k]
                    grad_attributes[vertex] += barycentric[i, j, k] * grad_output[i, j]
                    grad_barycentric[i, j, k] = np.dot(grad_output[i, j], attributes[vertex])
    return grad_attributes, grad_barycentric


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    return np.stack([interpolate(attributes, faces, face_index, derivatives[..., 0]),
                     interpolate(attributes, faces, face_index, derivatives[..., 1])], -1)
