"""Lab 5 once more: Jacobians written out, linear systems for the rays, loops over the pixels."""
import numpy as np

from reference.rasterization import screen_points


def matrices(face_index, clip, faces):
    """Yield i, j, the inverse of M = w (x, y, 1), a column for each corner."""
    x, y, w = screen_points(clip, *face_index.shape[::-1])
    for i, j in np.argwhere(face_index >= 0):
        corners = faces[face_index[i, j]]
        m = w[corners] * np.stack([x[corners] - j - 0.5, y[corners] - i - 0.5, np.ones(3)])
        yield i, j, np.linalg.inv(m)  # measured from the pixel, which is at 0, 0


def barycentrics(face_index, clip, faces):
    barycentric = np.zeros((*face_index.shape, 3))
    for i, j, inverse in matrices(face_index, clip, faces):
        barycentric[i, j] = inverse[:, 2] / inverse[:, 2].sum()
    return barycentric


def barycentrics_derivatives(face_index, clip, faces):
    derivatives = np.zeros((*face_index.shape, 3, 2))
    for i, j, inverse in matrices(face_index, clip, faces):
        c, dc = inverse[:, 2], inverse[:, :2]
        derivatives[i, j] = (dc * c.sum() - np.outer(c, dc.sum(0))) / c.sum()**2
    return derivatives


def interpolate(attributes, faces, face_index, barycentric):
    height, width = face_index.shape
    rows = []
    for i in range(height):
        for j in range(width):
            face = face_index[i, j]
            rows.append(np.zeros(attributes.shape[1]) if face < 0
                        else barycentric[i, j] @ attributes[faces[face]])
    return np.reshape(rows, (height, width, attributes.shape[1]))


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    grad_attributes, grad_barycentric = np.zeros(attributes.shape), np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        corners = faces[face_index[i, j]]
        shares = np.outer(barycentric[i, j], grad_output[i, j])
        grad_attributes += sum(np.outer(np.arange(len(attributes)) == vertex, share)
                               for vertex, share in zip(corners, shares, strict=True))
        grad_barycentric[i, j] = attributes[corners] @ grad_output[i, j]
    return grad_attributes, grad_barycentric
