"""Lab 7's whole meshes once more: pixel by pixel, edge by edge."""
import numpy as np

from course.given.arrays import EDGES


def barycentrics_backward(grad_barycentric, face_index, clip, faces, epsilon=0.0):
    # Pixel by pixel, not measured from there but with a = (X, Y, 1).
    grad_clip, (height, width) = np.zeros(np.shape(clip)), np.shape(face_index)
    for row, column in np.argwhere(np.asarray(face_index) >= 0):
        corners = np.asarray(faces)[face_index[row][column]]
        q = np.asarray(clip)[corners][:, [0, 1, 3]]
        a = [(2 * column + 1) / width - 1, (2 * row + 1) / height - 1, 1]
        e = np.array([np.cross(q[i], q[j]) @ a for i, j in EDGES])
        d = e.sum() + (epsilon if e.sum() >= 0 else -epsilon)
        for k, (i, j) in enumerate(EDGES):
            by_e = np.dot(grad_barycentric[row][column], d * np.eye(3)[k] - e) / d**2
            grad_clip[corners[i], [0, 1, 3]] += by_e * np.cross(q[j], a)
            grad_clip[corners[j], [0, 1, 3]] += by_e * np.cross(a, q[i])
    return grad_clip
