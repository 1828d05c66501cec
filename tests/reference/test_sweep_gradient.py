"""The reference's gradients of whole outlines, by Kato's sweep."""
import itertools

import numpy as np
import pytest
from loose_faces import some_corners

from course.given import arrays
from labkit.checks import assert_close, assert_equal
from reference import neural_renderer, sweep_gradient

WIDTH, HEIGHT = 23, 17
INSIDE = [[0.8, 0.8, 1.0], [-0.5, -0.8, 1.0], [0.8, -0.8, 1.0]]


def sweep_of_one_pixel(corners, row_from_top, column, gradient):
    """A white triangle on black, 64 x 64. The loss asks one pixel alone."""
    corners, grad_colour = np.array([corners]), np.zeros((64, 64, 3))
    face_index, *_ = neural_renderer.rasterize(corners, 64, 64)
    colour = np.repeat((face_index >= 0)[..., None] * 1.0, 3, -1)
    grad_colour[63 - row_from_top, column] = gradient / 3
    return sweep_gradient.sweep_backward(grad_colour, colour, face_index, corners)[0]


def test_a_pixel_inside_by_hand_and_as_in_the_original():
    """Row 40 from the top, column 50. All three edges could leave it behind."""
    got = sweep_of_one_pixel(INSIDE, 40, 50, 1.0)
    # On screen (57.6, 57.6), (16, 6.4), (57.6, 6.4). The pixel's centre is (50.5, 23.5).
    # By x: edge 0-1 at u of its height, and the upright edge 2-0. By y: edge 0-1 at v of its width,
    # and the flat edge 1-2.
    u, v = 17.1 / 51.2, 34.5 / 41.6
    left, right = (50.5 - 16 - 41.6 * u) / 32, 7.1 / 32
    above, below = (6.4 + 51.2 * v - 23.5) / 32, 17.1 / 32
    expected = [[1 / (right / u + 1e-4) - 1 / (left / u + 1e-4), 1 / (above / v + 1e-4), 0],
                [-1 / (left / (1 - u) + 1e-4),
                 1 / (above / (1 - v) + 1e-4) - 1 / (below / (1 - v) + 1e-4), 0],
                [1 / (right / (1 - u) + 1e-4), -1 / (below / v + 1e-4), 0]]
    np.testing.assert_allclose(got, expected, rtol=1e-9)
    original = [[0.98646867, 1.04628897, 0], [-1.03415668, -0.10403691, 0],
                [3.00094461, -1.55173182, 0]]
    np.testing.assert_allclose(got, original, rtol=1e-4)


def line_by_line(grad_colour, colour, face_index, corners, eps):
    """`sweep_backward`, edge by edge and line by line."""
    grads, screen = np.zeros(corners.shape), (corners[..., :2] + 1) * [WIDTH / 2, HEIGHT / 2]
    for axis, turn in (0, 1), (1, -1):
        lines = [np.moveaxis(array, axis, 0) for array in (grad_colour, colour, face_index)]
        for f, ends in itertools.product(np.unique(face_index[face_index >= 0]), arrays.EDGES):
            a, b = screen[f, ends][:, [axis, 1 - axis]]
            for y, (*line, index) in enumerate(zip(*lines, strict=True)):
                up = (y + 0.5 - a[1]) / (b[1] - a[1])
                if 0 <= up <= 1:
                    given = (*line, index == f, a[0] + up * (b[0] - a[0]),
                             turn * int(np.sign(b[1] - a[1])), [1 - up, up])
                    grads[f, ends, axis] += sweep_gradient.sweep_lines(
                        *(np.array([part]) for part in given), eps)[0]
    return grads


@pytest.mark.parametrize("eps", [0.0, 1e-4, 0.1])
def test_the_sweep_of_whole_meshes_is_that_of_the_loop(rng, eps):
    """A line, an end or a chunk that is lost, the sign of columns, width for height."""
    corners = some_corners(rng)
    face_index, *_ = neural_renderer.rasterize(corners, WIDTH, HEIGHT)
    colour, grad_colour = rng.random((HEIGHT, WIDTH, 2)), rng.normal(size=(HEIGHT, WIDTH, 2))
    scene = grad_colour, colour, face_index, corners, eps
    got = sweep_gradient.sweep_backward(*scene)
    expected = line_by_line(*scene)
    np.testing.assert_allclose(got, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


def test_the_sweep_of_many_chunks_is_that_of_the_loop(rng, monkeypatch):
    """A chunk of lines that begins anew."""
    monkeypatch.setattr(arrays, "CHUNK", 64)
    test_the_sweep_of_whole_meshes_is_that_of_the_loop(rng, 1e-4)


def test_a_row_counts_if_its_centre_is_at_an_end(impl):
    """An edge that ends on a centre does not count there."""
    _, row, crossing, share = impl.edge_lines(np.array([[2.0, 0.5]]), np.array([[10.0, 4.5]]), 9)
    assert_equal(row, np.arange(5))
    assert_close(crossing, [2.0, 4.0, 6.0, 8.0, 10.0])
    assert_close(share, np.array([[4, 0], [3, 1], [2, 2], [1, 3], [0, 4]]) / 4)


def test_an_edge_along_a_row_crosses_none(impl):
    """0 / 0, or a whole row."""
    flat = np.array([[1.0, 2.0], [1.0, 2.5]]), np.array([[6.0, 2.0], [6.0, 2.5]])
    assert [part.shape for part in impl.edge_lines(*flat, 5)] == [(0,)] * 3 + [(0, 2)]
