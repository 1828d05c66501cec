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
    rows = [np.zeros(attributes.shape[1]) if face < 0 else weights @ attributes[faces[face]]
            for face, weights in zip(face_index.ravel(), barycentric.reshape(-1, 3), strict=True)]
    return np.reshape(rows, (*face_index.shape, attributes.shape[1]))


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    # Unit attributes show what a pixel has of each vertex, unit weights what a corner has.
    shares = interpolate(np.eye(len(attributes)), faces, face_index, barycentric)
    corners = [interpolate(attributes, faces, face_index, np.broadcast_to(unit, barycentric.shape))
               for unit in np.eye(3)]
    return (np.einsum("ijv,ijc->vc", shares, grad_output),
            np.einsum("kijc,ijc->ijk", corners, grad_output))
