"""The reference's whole pictures of lab 8: antialias and its gradient."""
import numpy as np
import pytest
from screen_scenes import drawn, on_screen

from reference import antialiasing, outlines, sampling

GOLDEN = np.load("tests/golden/antialias.npz")
SCENES = sorted({key.split("/")[0] for key in GOLDEN})


def golden(scene, *keys):
    arrays = [GOLDEN[f"{scene}/{key}"] for key in keys]
    return [a.astype(float if a.dtype.kind == "f" else int) for a in arrays]


def golden_inputs(scene):
    *pictures, clip, faces = golden(scene, "colour", "face_index", "depth", "clip", "faces")
    return *pictures, clip, faces, antialiasing.opposite_corners(faces)


@pytest.mark.parametrize("scene", SCENES)
def test_pairs_and_pictures_are_those_of_nvdiffrast(scene):
    """Another edge, weight or colour than nvdiffrast's kernels give (tests/golden/README.md)."""
    inputs = golden_inputs(scene)
    expected, expected_alpha, output = golden(scene, "pairs", "alpha", "output")
    owner, other, c, ends, *_ = outlines.blended_pairs(*inputs[1:])
    corners = inputs[4][inputs[1].ravel()[owner]]
    edge = (~(corners[:, :, None] == ends.T[:, None]).any(2)).argmax(1)
    got = np.stack([owner, other, edge], 1)
    order, expected_order = (np.lexsort(pairs.T) for pairs in (got, expected))
    np.testing.assert_array_equal(got[order], expected[expected_order])
    alpha = 0.5 - np.clip(c, 0, 1)
    np.testing.assert_allclose(alpha[order], expected_alpha[expected_order], rtol=0, atol=1e-5)
    np.testing.assert_allclose(outlines.antialias(*inputs), output, rtol=0, atol=1e-5)


@pytest.mark.parametrize("scene", SCENES)
def test_gradients_are_those_of_nvdiffrast(scene):
    """A gradient to another pixel or vertex, or with another epsilon."""
    grad_output, grad_colour, grad_clip = golden(scene, "grad_output", "grad_colour", "grad_clip")
    got = outlines.antialias_backward(grad_output, *golden_inputs(scene), epsilon=1e-3)
    np.testing.assert_allclose(got[0], grad_colour, rtol=0, atol=1.5e-5)
    np.testing.assert_allclose(got[1], grad_clip, rtol=0, atol=1e-9 * np.abs(grad_clip).max())


# --- pictures ----------------------------------------------------------------------------------

def test_pictures_without_faces_or_with_hostile_vertices():
    """A crash or NaN where nothing is seen, or from vertices that no seen face has."""
    empty = np.full((4, 5), -1), np.full((4, 5), np.inf), np.zeros((0, 4)), np.zeros((0, 3), int)
    colour, no_faces = np.ones((4, 5, 3)), np.zeros((0, 3), int)
    np.testing.assert_array_equal(outlines.antialias(colour, *empty, no_faces), colour)
    grad_colour, grad_clip = outlines.antialias_backward(colour, colour, *empty, no_faces)
    np.testing.assert_array_equal(grad_colour, colour)
    assert grad_clip.shape == (0, 4)

    rng, faces = np.random.default_rng(0), np.array([[0, 1, 2], [3, 4, 5], [1, 2, 6]])
    clip = np.concatenate([on_screen([1.1, 8.3, 2.2], [1.3, 2.4, 7.1], 9, 8),
                           [[np.nan, 0, 0, 1], [0, np.inf, 0, 1], [0, 0, 0, 0], [0, 0, np.nan, 1]]])
    seen, _ = drawn(clip, faces, 9, 8)
    colour = rng.normal(size=(8, 9, 2))
    with np.errstate(all="raise"):
        grad_colour, grad_clip = outlines.antialias_backward(colour, colour, *seen)
    assert np.isfinite(grad_colour).all() and np.isfinite(grad_clip).all()
    assert grad_clip[:3, [0, 1, 3]].all() and not grad_clip[3:].any()


def test_a_seen_vertex_in_the_camera_plane_has_a_gradient():
    """The backward pass divides by another w than the forward pass: infinity and NaN."""
    clip = np.array([[-0.3, -0.8, 0, 1], [0.2, -0.7, 0, 1], [0.4, 0.9, 0, 0]])

    def gradient(w):
        clip[2, 3] = w
        seen, white = drawn(clip, np.arange(3)[None], 16, 12)
        grad_output = np.arange(192.0).reshape(12, 16, 1) % 7
        return outlines.antialias_backward(grad_output, white, *seen)[1]

    np.testing.assert_allclose(gradient(0.0)[:2], gradient(1e-7)[:2], rtol=1e-4)
    assert np.isfinite(gradient(0.0)).all() and gradient(0.0)[2].any()


# --- the truth ---------------------------------------------------------------------------------

def one_triangle(triangle, width, height):
    """-> its antialiased coverage (height, width), and backward(grad) -> grad_triangle (3, 2)."""
    clip = on_screen(*triangle.T, width, height)
    seen, white = drawn(clip, np.arange(3)[None], width, height)

    def backward(grad):
        grad_clip = outlines.antialias_backward(grad[..., None], white, *seen)[1]
        return grad_clip[:, :2] * 2 / [width, height]

    return outlines.antialias(white, *seen)[..., 0], backward


def test_coverage_and_its_gradient_are_near_the_exact_ones():
    """A bias, of colours or of gradients, that central differences of the blend cannot see."""
    rng = np.random.default_rng(4)
    errors, angles, lengths = [], [], []
    y, x = np.indices((60, 70)) / 10
    smooth = np.sin(x) + np.cos(1.3 * y)  # an upstream gradient without noise
    for _ in range(20):
        angle = np.sort(rng.uniform(0, 2 * np.pi) + np.arange(3) * 2.1)
        triangle = [35, 30] + 25 * np.stack([np.cos(angle), np.sin(angle)], 1)
        got, backward = one_triangle(triangle, 70, 60)
        errors.append(np.abs(got - sampling.pixel_coverage(triangle, 70, 60)).max())
        gradient, exact = backward(smooth), sampling.pixel_coverage_backward(smooth, triangle)
        angles.append(np.vdot(gradient, exact) / np.linalg.norm(gradient) / np.linalg.norm(exact))
        lengths.append(np.linalg.norm(gradient) / np.linalg.norm(exact))
    assert max(errors) < 0.5  # at corners
    assert min(angles) > 0.999
    assert 0.95 < min(lengths) and max(lengths) < 1.02
