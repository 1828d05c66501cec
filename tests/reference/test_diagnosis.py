"""What lab 8 says of zero gradients, and of pixels with too many edges."""
import numpy as np
import pytest
from screen_scenes import drawn, on_screen, soup

from reference import antialiasing, diagnosis, intersections


@pytest.mark.parametrize("seed", [0, 1, 2, 4])
def test_why_zero_names_exactly_what_has_no_gradient(seed):
    """A vertex or pixel with a gradient is said to have none, or the other way round."""
    rng = np.random.default_rng(seed)
    arguments, _ = drawn(*soup(rng, behind=True), 30, 22)
    face_index, colour = arguments[0], rng.normal(size=(22, 30, 2))
    pixel, vertex = diagnosis.why_zero(*arguments)
    grad_output = rng.normal(size=colour.shape)
    pairs = intersections.all_pairs(*arguments)
    _, grad_clip = intersections.all_pairs_backward(grad_output, colour, pairs, *arguments[2:4])
    np.testing.assert_array_equal(grad_clip.any(1), vertex == 6)
    owner, other, c, *_ = pairs
    live = (c > 0) & (c < 1)
    expected = np.zeros(face_index.size, bool)
    expected[owner[live]] = expected[other[live]] = True
    np.testing.assert_array_equal(pixel == 6, expected.reshape(face_index.shape))
    assert len(set(vertex)) > 2 and len(set(pixel.ravel())) >= 4


def test_why_zero_tells_the_reasons_apart():
    """Another reason than the true one, in scenes made for one reason each."""
    def reasons(clip, faces, width=8, height=6):
        pixel, vertex = diagnosis.why_zero(*drawn(clip, faces, width, height)[0])
        names = diagnosis.REASONS
        return [names[r] for r in vertex], {names[r] for r in pixel.flat}

    face, two = np.array([[0, 1, 2]]), np.array([[0, 1, 2], [3, 4, 5]])
    whole = on_screen([-9, 30, -9], [-9, -9, 30], 8, 6)
    assert reasons(whole, face) == (["no pair"] * 3, {"no pair"})
    small = on_screen([2.1, 3.2, 2.2], [2.1, 2.3, 3.3], 8, 6, -0.5)
    hidden = "not seen: hidden or outside"
    assert reasons(np.concatenate([whole, small + [0, 0, 0.9, 0]]), two)[0][3:] == [hidden] * 3
    assert reasons(small + [100, 0, 0, 0], face) == ([hidden] * 3, {hidden})
    behind = small * [-1, -1, -1, -1]
    assert reasons(behind, face)[0] == ["behind the camera"] * 3
    assert reasons(small, face)[0].count("has a gradient") >= 2
    square = on_screen([-9, 4.3, 4.3, -9], [-9, -9, 30, 30], 8, 6)
    # The strip to the right of the square is thinner than a pixel. Its right edge is the outline.
    strip = np.concatenate([square, on_screen([4.4, 4.4], [-9, 30], 8, 6)])
    faces = np.array([[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]])
    vertex, _ = reasons(strip, faces)
    assert vertex[4:] == ["has a gradient"] * 2 and "has a gradient" not in vertex[:4]
    wide = on_screen([-9, 30, 30, -9], [-9, -9, 30, 30], 8, 6)
    assert reasons(wide, faces[:2])[1] == {"no pair", "the surface goes on"}
    column = on_screen([-30, 1.7, -0.7], [3, -9, 15], 1, 6)  # only pairs above each other
    assert "outline not steep" in reasons(column, face, 1)[1]
    snapped = on_screen([-9, 4.5, 4.5], [-9, -9, 30], 8, 6)  # an edge on the centres of pixels
    assert "alpha saturated, or 0" in reasons(snapped, face)[0]


def test_too_many_edges_in_one_pixel_are_found():
    """A pixel between four edges goes beyond white, and nobody tells."""
    # Four white strips end just before the centre of one black pixel, each to another side of it.
    x0, y0 = np.array([0.0, 2.6, 2.1, 2.1]), np.array([2.1, 2.1, 0.0, 2.6])
    x1, y1 = np.array([2.4, 5.0, 2.9, 2.9]), np.array([2.9, 2.9, 2.4, 5.0])
    corners = np.stack([np.stack([x0, x1, x1, x0], 1), np.stack([y0, y0, y1, y1], 1)], -1)
    clip = on_screen(*corners.reshape(-1, 2).T, 5, 6)
    faces = (4 * np.arange(4)[:, None, None] + np.array([[0, 1, 2], [0, 2, 3]])).reshape(-1, 3)
    rest, colour = drawn(clip, faces, 5, 6)
    output = antialiasing.blend_pairs(colour, intersections.all_pairs(*rest))[..., 0]
    beyond = diagnosis.overblended(colour, *rest)
    np.testing.assert_array_equal(beyond, (output > 1 + 1e-9) | (output < -1e-9))
    np.testing.assert_array_equal(np.argwhere(beyond), [[2, 2]])
    np.testing.assert_allclose(output[2, 2], 4 * 0.4)
    assert not diagnosis.overblended(0 * colour + 0.3, *rest).any()
