"""Mistakes of lab 5; each docstring goes on after "this is what comes out when"."""


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
