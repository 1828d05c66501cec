"""Whole pictures of lab 4: what the reference composes of its exercises."""
import numpy as np
import pytest
from screen_scenes import on_screen

from course.given import mesh
from reference import interpolation, msaa, pipeline, rasterization, transforms


def flat(colours):
    """A shade that knows the face alone."""
    return lambda px, py, face: colours[face]


def scene(width, height):
    """A torus, seen from the side: clip, faces."""
    vertices, faces = mesh.torus(800)
    view = transforms.translate(np.array([0.0, 0.0, -3.0])) \
        @ transforms.rotate(np.array([1.0, 0.3, 0.0]), 0.7)
    camera = transforms.perspective(1.0, width / height, 1.0, 9.0)
    return pipeline.to_clip(vertices, camera @ view), faces


def below_line(slope, height_at_0, width, height):
    """A triangle that covers in the picture what is below the line: clip positions."""
    far = 4 * (width + height)
    left, right = -far, width + far
    return on_screen([left, width / 2, right], [slope * left + height_at_0, -3 * far,
                                                slope * right + height_at_0], width, height)


BELOW = below_line(0.3, 2.2, 12, 8), np.array([[0, 1, 2]])  # clip and faces, for 12 x 8 pixels


# --- samples -----------------------------------------------------------------------------------

@pytest.mark.parametrize("count", [2, 4, 8, 16])
def test_standard_patterns_spread_their_samples(count):
    """A step that shares a divisor with count + 1, or one that makes a diagonal."""
    pattern = msaa.standard_pattern(count)
    assert [len(np.unique(side)) for side in pattern.T] == [count, count]
    i, j = np.triu_indices(count, 1)
    assert np.linalg.norm(pattern[i] - pattern[j], axis=1).min() > 0.75 / np.sqrt(count)


@pytest.mark.parametrize("count", [0, 3, 32])
def test_a_count_without_a_standard_pattern_is_told(count):
    """A bare KeyError that names a number and no way out."""
    with pytest.raises(ValueError, match=f"1, 2, 4, 8 or 16 samples, got {count}: give one of"):
        msaa.standard_pattern(count)


def test_a_picture_needs_a_sample():
    """NumPy's error about a shape, or a division by 0, that does not say what is missing."""
    shade, background = flat(np.ones((1, 3))), np.zeros(3)
    with pytest.raises(ValueError, match="at least one sample, got none: give regular_grid"):
        msaa.msaa(*BELOW, 12, 8, np.zeros((0, 2)), shade, background)
    for n in (0, -1):
        with pytest.raises(ValueError, match=f"n of 1 or more, got n = {n}"):
            msaa.supersample(*BELOW, 12, 8, n, shade, background)


@pytest.mark.parametrize(("width", "height"), [(0, 0), (12, 0), (0, 8)])
def test_a_picture_without_pixels_is_empty(width, height):
    """One pixel of a picture 0 wide is 2 / 0 of ndc, or NumPy cannot guess the channels."""
    shade, background = flat(np.ones((1, 3))), np.zeros(3)
    with np.errstate(all="raise"):
        few = msaa.msaa(*BELOW, width, height, msaa.regular_grid(2), shade, background)
        many = msaa.supersample(*BELOW, width, height, 2, shade, background)
    assert few.shape == many.shape == (height, width, 3)


@pytest.mark.parametrize("n", [1, 2, 3, 4])
def test_a_regular_grid_is_a_finer_picture(n):
    """The samples are those of another place, are not 1 / n apart, or in another order."""
    clip, faces = scene(40, 30)
    face_index, depth = msaa.rasterize_samples(clip, faces, 40, 30, msaa.regular_grid(n))
    fine_index, fine_depth = rasterization.rasterize(clip, faces, 40 * n, 30 * n)

    def by_sample(picture):
        return picture.reshape(30, n, 40, n).transpose(1, 3, 0, 2).reshape(n * n, 30, 40)

    assert (fine_index >= 0).sum() > 300 * n * n
    np.testing.assert_array_equal(face_index, by_sample(fine_index))
    np.testing.assert_allclose(depth, by_sample(fine_depth), rtol=0, atol=1e-12)


def test_coverage_is_the_share_of_samples_that_see_a_face():
    """Face 0 counts as no face, or -1 as one."""
    face_index = np.random.default_rng(2).integers(-1, 3, (5, 3, 4))
    np.testing.assert_array_equal(msaa.coverage(face_index), sum(face_index > -1) / 5)


# --- shades ------------------------------------------------------------------------------------

def test_each_face_in_a_pixel_is_shaded_once_at_the_centre():
    """Every sample is shaded, or at its own place."""
    clip, faces = scene(40, 30)
    asked = []

    def shade(px, py, face):
        asked.append(np.stack([px, py, face], -1))
        return np.zeros((len(px), 1))

    pattern = msaa.standard_pattern(8)
    face_index, _ = msaa.rasterize_samples(clip, faces, 40, 30, pattern)
    msaa.msaa(clip, faces, 40, 30, pattern, shade, np.zeros(1))
    samples, shades, memory = msaa.cost(face_index, 8)
    (requests,) = asked
    sample, row, column = np.nonzero(face_index >= 0)
    expected = np.stack([column + 0.5, row + 0.5, face_index[sample, row, column]], -1)
    np.testing.assert_array_equal(np.unique(requests, axis=0), np.unique(expected, axis=0))
    assert len(requests) == len(np.unique(requests, axis=0)) == shades < (face_index >= 0).sum() / 2
    assert (samples, memory) == (8 * 40 * 30, 64 * 40 * 30)


def test_with_flat_colours_msaa_is_supersampling():
    """A sample gets the shade of another face or pixel."""
    clip, faces = scene(40, 30)
    colours = np.random.default_rng(1).random((len(faces), 3))
    background = np.array([0.2, 0.3, 0.9])
    for n in (1, 2, 4):
        few = msaa.msaa(clip, faces, 40, 30, msaa.regular_grid(n), flat(colours), background)
        many = msaa.supersample(clip, faces, 40, 30, n, flat(colours), background)
        np.testing.assert_allclose(few, many, rtol=0, atol=1e-12)


def test_barycentrics_at_a_centre_are_those_of_lab_5():
    """Corners, faces or pixels are mixed up."""
    clip, faces = scene(40, 30)
    face_index, _ = rasterization.rasterize(clip, faces, 40, 30)
    row, column = np.nonzero(face_index >= 0)
    got = msaa.barycentric_at(column + 0.5, row + 0.5, face_index[row, column], clip, faces, 40, 30)
    expected = interpolation.barycentrics(face_index, clip, faces)[row, column]
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-12)
