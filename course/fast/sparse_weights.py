"""Sparse weights: lab 5's interpolation for whole pictures as a product with one matrix.

    A_pixels = B A_vertices,   grad_A_vertices = B^T grad_A_pixels    (8) of interpolation.py

B has a row for each pixel and a column for each vertex. SciPy multiplies row by row, without
arrays of all corners' attributes in between.
"""
import numpy as np

from course.given.arrays import write_rows

from .interpolation import interpolation_matrix, seen_corners


def interpolate(attributes, faces, face_index, barycentric):
    """Lab 5's `interpolate`."""
    weights = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    return (weights @ attributes).reshape(*face_index.shape, attributes.shape[1])


def interpolate_backward(grad_output, attributes, faces, face_index, barycentric):
    """Lab 5's `interpolate_backward`."""
    weights = interpolation_matrix(len(attributes), faces, face_index, barycentric)
    grad_pixels = grad_output.reshape(-1, attributes.shape[1])
    grad_barycentric = np.zeros((face_index.size, 3))
    channels = attributes.T.copy()  # contiguous rows: faster
    for pixel, corners in seen_corners(face_index, faces):
        grad_seen = grad_pixels.take(pixel, 0).T.copy()
        by_weight = np.einsum("cn,ckn->kn", grad_seen, channels.take(corners, 1))
        write_rows(grad_barycentric, pixel, by_weight)
    return weights.T @ grad_pixels, grad_barycentric.reshape(*face_index.shape, 3)


def trials():
    """{name: lists of arguments}: what is mixed to try whether lab 5's functions are the same."""
    rng = np.random.default_rng(1)
    faces = rng.integers(0, 9, (8, 3), np.intp)
    face_index = rng.integers(-3, 8, (6, 5), np.intp).clip(-1)
    seen = faces, face_index, rng.normal(size=(6, 5, 3))
    attributes, grad_output = rng.normal(size=(9, 4)), rng.normal(size=(6, 5, 4))
    return {"interpolate": [(attributes, *seen)],
            "interpolate_backward": [(grad_output, attributes, *seen)]}
