"""The reference's backward pass of whole pictures, which lab 7 composes of its exercises."""
from fractions import Fraction

import numpy as np
import pytest

from course.given import arrays
from reference import rasterization, vertex_gradients
from reference import rasterizer_gradients as gradients

FORWARD = np.load("tests/golden/rasterize.npz")
GOLDEN = np.load("tests/golden/rasterize_gradients.npz")
SCENES = sorted({key.split("/")[0] for key in GOLDEN})


def golden(scene):
    """clip, faces, face_index, grad_barycentric (H, W, 3), grad_derivatives (H, W, 3, 2)"""
    clip, faces, face_index = (FORWARD[f"{scene}/{key}"] for key in ("clip", "faces", "face_index"))
    by_uv = GOLDEN[f"{scene}/twice_grad_uv"] / 2
    by_derivatives = GOLDEN[f"{scene}/twice_grad_derivatives"] / 2
    return (clip.astype(float), faces.astype(int), face_index.astype(int),
            np.pad(by_uv, ((0, 0), (0, 0), (0, 1))),
            np.pad(by_derivatives, ((0, 0), (0, 0), (0, 1), (0, 0))))


@pytest.mark.parametrize("scene", SCENES)
def test_gradients_are_those_of_nvdiffrast(scene):
    """Another gradient, or another epsilon, than nvdiffrast's kernels (tests/golden/README.md)."""
    clip, faces, face_index, by_barycentric, by_derivatives = golden(scene)
    for key, by_either in ("grad_clip", None), ("grad_clip_derivatives", by_derivatives):
        got = gradients.rasterize_backward(by_barycentric, by_either, None, face_index, clip, faces,
                                           epsilon=1e-6)
        for expected, tolerance in ((GOLDEN[f"{scene}/{key}"], 1e-9),
                                    (GOLDEN[f"{scene}/{key}_32"], 1e-4)):
            np.testing.assert_allclose(got, expected, 0, tolerance * np.abs(expected).max())


@pytest.fixture
def scene():
    """clip, faces, face_index, width, height: a few faces of all sizes, two vertices behind."""
    rng = np.random.default_rng(3)
    clip = rng.uniform([-2, -2, -1, 0.5], [2, 2, 1, 2.5], (9, 4))
    clip[[2, 7], 3] = -0.7, -0.4
    faces = np.stack([rng.permutation(9)[:3] for _ in range(12)])
    face_index, _ = rasterization.rasterize(clip, faces, 13, 9)
    seen = np.unique(face_index)[1:]
    assert len(seen) >= 3 and (clip[faces[seen], 3] < 0).any()
    return clip, faces, face_index, 13, 9


def test_all_of_it_is_the_sum(scene):
    """A part is left out, or epsilon does not get through."""
    clip, faces, face_index, width, height = scene
    rng = np.random.default_rng(1)
    by_b, by_db, by_z = (rng.normal(size=(height, width, *shape)) for shape in ((3,), (3, 2), ()))
    for epsilon in 0.0, 0.3:
        picture = face_index, clip, faces
        parts = (gradients.barycentrics_backward(by_b, *picture, epsilon),
                 gradients.barycentrics_derivatives_backward(by_db, *picture, epsilon),
                 gradients.depth_backward(by_z, *picture))
        for use_db, use_z in (True, True), (True, False), (False, True), (False, False):
            got = gradients.rasterize_backward(by_b, by_db if use_db else None,
                                               by_z if use_z else None, *picture, epsilon)
            expected = parts[0] + use_db * parts[1] + use_z * parts[2]
            np.testing.assert_allclose(got, expected, rtol=1e-12, atol=1e-12)


def test_the_gradient_of_depths_is_the_matrix_formula_summed_over_the_pixels(scene):
    """Eq. (10) is not (4), an inverse for each pixel."""
    clip, faces, face_index, width, height = scene
    by_z = np.random.default_rng(2).normal(size=(height, width))
    expected = np.zeros(clip.shape)
    for i, j in np.argwhere(face_index >= 0):
        corners = faces[face_index[i, j]]
        m, z = clip[corners][:, [0, 1, 3]].T, clip[corners, 2]
        a = np.array([(2 * j + 1) / width - 1, (2 * i + 1) / height - 1, 1.0])
        grad_z, grad_m, *_ = vertex_gradients.residual_backward(by_z[i, j], z, m, a, 0.0)
        expected[np.ix_(corners, [0, 1, 3])] += grad_m.T
        expected[corners, 2] += grad_z
    got = gradients.depth_backward(by_z, face_index, clip, faces)
    np.testing.assert_allclose(got, expected, rtol=1e-9, atol=1e-9)


def test_chunks_change_nothing(scene, monkeypatch):
    """A pixel is lost or counted twice where one chunk ends and the next begins."""
    clip, faces, face_index, width, height = scene
    rng = np.random.default_rng(5)
    upstream = [rng.normal(size=(height, width, *shape)) for shape in ((3,), (3, 2), ())]
    whole = gradients.rasterize_backward(*upstream, face_index, clip, faces)
    for size in 1, 7, 50:
        monkeypatch.setattr(arrays, "ROWS", size)
        got = gradients.rasterize_backward(*upstream, face_index, clip, faces)
        np.testing.assert_allclose(got, whole, rtol=1e-10, atol=1e-10)


def test_pixels_without_a_face_and_faces_without_a_pixel_count_for_nothing():
    """nan from a hidden, broken vertex, or from the upstream gradient of the background."""
    clip = np.array([[-0.5, -0.5, 0.1, 1.0], [0.6, -0.5, 0.2, 1.0], [0.0, 0.7, 0.3, 1.0],
                     [np.nan, 0.0, 0.0, 1.0], [0.0, 0.0, 0.9, 0.0]])
    faces = np.array([[0, 1, 3], [0, 1, 2], [4, 4, 1]])
    face_index, _ = rasterization.rasterize(clip[:3], faces[1:2], 8, 6)
    face_index = np.where(face_index == 0, 1, -1)
    rng = np.random.default_rng(0)
    upstream = [np.where((face_index >= 0).reshape(6, 8, *[1] * len(shape)),
                         rng.normal(size=(6, 8, *shape)), np.nan) for shape in ((3,), (3, 2), ())]
    got = gradients.rasterize_backward(*upstream, face_index, clip, faces)
    alone = gradients.rasterize_backward(*upstream, np.minimum(face_index, 0), clip[:3], faces[1:2])
    np.testing.assert_allclose(got, np.concatenate([alone, np.zeros((2, 4))]), rtol=1e-12)
    assert (alone != 0).all()


def test_nothing_seen_and_no_mesh():
    """An error where there is nothing to do."""
    upstream = [np.ones((4, 5, *shape)) for shape in ((3,), (3, 2), ())]
    for vertices, faces in ((3, np.array([[0, 1, 2]])), (0, np.zeros((0, 3), int))):
        clip = np.ones((vertices, 4))
        got = gradients.rasterize_backward(*upstream, np.full((4, 5), -1), clip, faces)
        np.testing.assert_array_equal(got, np.zeros((vertices, 4)))


def exact_gradient(grad_b, clip, a):
    """The gradient of grad_b . b by x, y, w of a face's corners (3, 3), without rounding."""
    q, g = (np.vectorize(Fraction, otypes=[object])(array) for array in (clip, grad_b))
    pairs = (1, 2), (2, 0), (0, 1)
    e = np.array([np.cross(q[i], q[j]) @ a for i, j in pairs])
    grad_e = (g - g @ e / e.sum()) / e.sum()
    gradient = 0 * q
    for grad, (i, j) in zip(grad_e, pairs, strict=True):
        gradient[i] += grad * np.cross(q[j], a)
        gradient[j] += grad * np.cross(a, q[i])
    return gradient.astype(float)


@pytest.mark.parametrize("size", [1.0, 1e-3, 1e-6])
def test_a_small_face_far_out_keeps_its_digits(size):
    """Edges measured from the middle of the picture: a face of 1e-6 pixels has no digit left."""
    width, height, row, column = 1024, 512, 500, 1000
    corners = size * np.array([[-0.4, -0.3], [0.5, -0.2], [0.1, 0.4]])
    w = np.array([1.0, 1.5, 0.75])
    x, y = ((corners + [column + 0.5, row + 0.5]) * [2 / width, 2 / height] - 1).T
    clip = np.stack([x * w, y * w, 0 * w, w], -1)
    face_index = np.full((height, width), -1)
    face_index[row, column] = 0
    grad_b = np.array([0.3, -0.8, 0.4])
    upstream = np.zeros((height, width, 3))
    upstream[row, column] = grad_b
    got = gradients.barycentrics_backward(upstream, face_index, clip, np.array([[0, 1, 2]]))
    a = [Fraction(2 * column + 1, width) - 1, Fraction(2 * row + 1, height) - 1, Fraction(1)]
    expected = exact_gradient(grad_b, clip[:, [0, 1, 3]], a)
    tolerance = (1e-11 if size > 1e-4 else 1e-8) * np.abs(expected).max()
    np.testing.assert_allclose(got[:, [0, 1, 3]], expected, rtol=0, atol=tolerance)


# --- one face ----------------------------------------------------------------------------------

def test_epsilon_makes_the_sum_larger():
    """Added to a negative sum, it makes that smaller; or it is left out, or 0 has no sign."""
    e = np.array([[1.0, -3.0, 1.0, 0.0], [2.0, 0.0, -1.0, 0.0], [4.0, 0.0, 0.0, 0.0]])
    np.testing.assert_array_equal(gradients.padded_sum(e, 1.0), [8.0, -4.0, 1.0, 1.0])
