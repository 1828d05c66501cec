"""Lab 5 once more: Jacobians written out, loops, and one gather for all pixels."""
import numpy as np


def fraction_in_space(t, w_0, w_1):
    return t / (t + (1 - t) * (w_1 / w_0))


def fraction_in_space_backward(grad_q, t, w_0, w_1):
    # q as a quotient of A = t w_0 by A + B, B = (1 - t) w_1.
    A, B = t * w_0, (1 - t) * w_1
    grad_A, grad_B = grad_q * B / (A + B)**2, -grad_q * A / (A + B)**2
    return [grad_A * w_0 - grad_B * w_1, grad_A * t, grad_B * (1 - t)]


def attribute_on_segment(t, a_0, a_1, w_0, w_1):
    weights = np.stack([(1 - t) * w_1, t * w_0])
    return (weights / weights.sum(0)).T @ np.stack([a_0, a_1])


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


def weight_rows(faces, face_index, barycentric):
    start, vertex, weight = [0], [], []
    for face, weights in zip(face_index.ravel(), barycentric.reshape(-1, 3), strict=True):
        if face >= 0:
            vertex += list(faces[face])
            weight += list(weights)
        start.append(len(vertex))
    return np.array(start), np.array(vertex, int), np.array(weight, float)


def interpolate(attributes, faces, face_index, barycentric):
    seen = face_index[..., None] >= 0
    corners = np.where(seen, faces[face_index], 0) if len(faces) else np.zeros(
        barycentric.shape, int)
    mixed = np.einsum("...k,...kc->...c", np.where(seen, barycentric, 0), attributes[corners])
    return np.where(seen, mixed, 0)


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    seen = face_index >= 0
    corners, weights, grad = faces[face_index[seen]], barycentric[seen], grad_output[seen]
    grad_attributes = np.zeros(np.shape(attributes), order="F")
    np.add.at(grad_attributes, corners, weights[..., None] * grad[:, None])
    grad_barycentric = np.zeros(np.shape(barycentric))
    grad_barycentric[seen] = (attributes[corners] * grad[:, None]).sum(-1)
    return grad_attributes, grad_barycentric


def interpolate_derivatives(attributes, faces, face_index, derivatives):
    height, width = face_index.shape
    footprint = np.zeros((height, width, attributes.shape[1], 2))
    for i, j in np.ndindex(height, width):
        if face_index[i, j] >= 0:
            footprint[i, j] = attributes[faces[face_index[i, j]]].T @ derivatives[i, j]
    return footprint


def interpolate_derivatives_backward(grad_output, attributes, faces, face_index, derivatives):
    grad_attributes, grad_derivatives = np.zeros(attributes.shape), np.zeros(derivatives.shape)
    for i, j in np.argwhere(face_index >= 0):
        for k, vertex in enumerate(faces[face_index[i, j]]):
            for d in range(2):
                grad_attributes[vertex] += derivatives[i, j, k, d] * grad_output[i, j, :, d]
                grad_derivatives[i, j, k, d] = grad_output[i, j, :, d] @ attributes[vertex]
    return grad_attributes, grad_derivatives
