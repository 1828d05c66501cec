"""Lab 5 once more: Jacobians written out, loops, and one gather for all pixels."""
import numpy as np


def barycentric_from_screen(e, w):
    n = e * np.roll(w, 1, -1) * np.roll(w, 2, -1)
    return n / np.sum(n, -1)[..., None]


def normalize_backward(grad_b, b, s, axis=0):
    # A matrix for each sample: db_k / dn_j = ((j == k) - b_k) / s.
    grad_b, b = np.moveaxis(grad_b, axis, -1), np.moveaxis(b, axis, -1)
    jacobian = np.eye(3) - b[..., None]
    return np.moveaxis(np.einsum("...k,...kj->...j", grad_b, jacobian), -1, axis) / s


def interpolate_loop(attributes, faces, face_index, barycentric):
    height, width = face_index.shape
    rows = []
    for i in range(height):
        for j in range(width):
            face = face_index[i, j]
            rows.append(np.zeros(attributes.shape[1]) if face < 0
                        else barycentric[i, j] @ attributes[faces[face]])
    return np.reshape(rows, (height, width, attributes.shape[1]))


def interpolate_backward_loop(grad_output, attributes, faces, face_index, barycentric):
    grad_attributes, grad_barycentric = np.zeros(attributes.shape), np.zeros(barycentric.shape)
    for i, j in np.argwhere(face_index >= 0):
        corners = faces[face_index[i, j]]
        shares = np.outer(barycentric[i, j], grad_output[i, j])
        grad_attributes += sum(np.outer(np.arange(len(attributes)) == vertex, share)
                               for vertex, share in zip(corners, shares, strict=True))
        grad_barycentric[i, j] = attributes[corners] @ grad_output[i, j]
    return grad_attributes, grad_barycentric


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    height, width = face_index.shape
    footprint = np.zeros((height, width, attributes.shape[1], 2))
    for i, j in np.ndindex(height, width):
        if face_index[i, j] >= 0:
            footprint[i, j] = attributes[faces[face_index[i, j]]].T @ derivatives[i, j]
    return footprint
