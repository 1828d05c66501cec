"""Whole pictures of lab 4: what the reference composes of its exercises."""
import numpy as np
import pytest
from screen_scenes import on_screen

from course.given import mesh
from reference import msaa, rasterization, scanline, transforms

PATTERNS = {"regular 4": msaa.regular_grid(2),
            **{f"lattice {count}": msaa.standard_pattern(count) for count in (1, 2, 4, 8, 16)}}
each_pattern = pytest.mark.parametrize("pattern", PATTERNS.values(), ids=PATTERNS.keys())


def flat(colours):
    """A shade that knows the face alone."""
    return lambda px, py, face: colours[face]


def scene(width, height):
    """A torus, seen from the side: clip, faces."""
    vertices, faces = mesh.torus(800)
    view = transforms.translate(np.array([0.0, 0.0, -3.0])) \
        @ transforms.rotate(np.array([1.0, 0.3, 0.0]), 0.7)
    camera = transforms.perspective(1.0, width / height, 1.0, 9.0)
    return transforms.transform(transforms.to_homogeneous(vertices), camera @ view), faces


def half_plane_coverage(slope, height_at_0, width, height):
    """The exact share of each pixel below the line y = slope x + height_at_0, slope not 0."""
    def integral(u):  # of clip(u, 0, 1)
        return np.where(u < 1, np.maximum(u, 0) ** 2 / 2, u - 0.5)

    x, row = np.arange(width + 1), np.arange(height)[:, None]
    return np.diff(integral(slope * x + height_at_0 - row), axis=1) / slope


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
    fine_index, fine_depth = scanline.rasterize(clip, faces, 40 * n, 30 * n)

    def by_sample(picture):
        return picture.reshape(30, n, 40, n).transpose(1, 3, 0, 2).reshape(n * n, 30, 40)

    assert (fine_index >= 0).sum() > 300 * n * n
    np.testing.assert_array_equal(face_index, by_sample(fine_index))
    np.testing.assert_allclose(depth, by_sample(fine_depth), rtol=0, atol=1e-12)


@each_pattern
def test_depth_is_that_of_the_sample(pattern):
    """All samples have the depth of the pixel's centre."""
    corners = np.array([[-40.0, -40], [80, -40], [-40, 80]])
    clip = on_screen(*corners.T, 12, 8, corners @ [0.01, -0.005])
    _, depth = msaa.rasterize_samples(clip, np.array([[0, 1, 2]]), 12, 8, pattern)
    x, y = (np.arange(size) for size in (12, 8))
    for offset, seen in zip(pattern, depth, strict=True):
        expected = 0.01 * (x + offset[0]) - 0.005 * (y[:, None] + offset[1])
        np.testing.assert_allclose(seen, expected, rtol=0, atol=1e-12)


@each_pattern
def test_two_faces_at_an_edge_share_out_the_samples(pattern):
    """A sample at the common edge is lost, or the vertices move by different numbers."""
    rng = np.random.default_rng(4)
    for _ in range(20):
        a, b = rng.uniform(2, 10, (2, 2))
        if rng.random() < 0.5:  # the edge passes through samples
            a, b = np.round(a) + pattern[0], np.round(b) + pattern[0] + [0, 1]
        across = 40 * np.array([a[1] - b[1], b[0] - a[0]])
        clip = on_screen(*np.transpose([a, b, a + across, b - across]), 12, 12)
        one, other = (msaa.rasterize_samples(clip, np.array([face]), 12, 12, pattern)[0] >= 0
                      for face in ([0, 1, 2], [1, 0, 3]))
        both, _ = msaa.rasterize_samples(clip, np.array([[0, 1, 2], [1, 0, 3]]), 12, 12, pattern)
        assert not (one & other).any()
        np.testing.assert_array_equal(one | other, both >= 0)


def test_samples_cut_to_whole_numbers_are_one_sample():
    """Erratum of source S1, insideTriangle(int x, int y): four samples that smooth nothing."""
    pattern = msaa.regular_grid(2)
    assert (np.trunc(pattern) == 0).all()
    cut, right = (msaa.coverage(msaa.rasterize_samples(*BELOW, 12, 8, offsets)[0])
                  for offsets in (np.trunc(pattern), pattern))
    assert set(np.unique(cut)) == {0.0, 1.0}
    assert {0.25, 0.5, 0.75} & set(np.unique(right))


# --- seams -------------------------------------------------------------------------------------

QUAD = np.array([[0, 1, 2], [0, 2, 3]])  # two faces that share the edge from 0 to 2


def quad(width, height):
    """A quadrilateral that fills the picture. Its diagonal runs through it."""
    return on_screen([-3, width + 5, width + 2, -4], [-2, -1, height + 3, height + 2],
                     width, height)


@each_pattern
@pytest.mark.parametrize("background", [0.0, 0.37, 1.0, 1e9])
def test_faces_of_one_colour_leave_no_seam(pattern, background):
    """The background shines through at a shared edge, or the mean is rounded."""
    colour = np.array([0.1, 0.7, 1 / 3])
    picture = msaa.msaa(quad(23, 17), QUAD, 23, 17, pattern, flat(np.stack([colour, colour])),
                        np.full(3, background))
    assert np.abs(picture - colour).max() == 0


def test_the_shortcut_of_one_depth_for_a_pixel_leaves_a_dark_seam():
    """The known mistake is shown as it is: along the diagonal, and nowhere else, it is dark."""
    clip, pattern = quad(23, 17), msaa.regular_grid(2)
    face_index, _ = msaa.rasterize_samples(clip, QUAD, 23, 17, pattern)
    shared = (face_index != face_index[0]).any(0)
    colours = np.ones((2, 3))
    for background in (np.zeros(3), np.ones(3)):
        picture = msaa.rate_times_colour(clip, QUAD, colours, 23, 17, pattern, background)
        np.testing.assert_array_equal(picture[~shared], 1.0)
        first = (face_index == 0).mean(0)  # the face that comes second, as deep, is lost
        np.testing.assert_array_equal(picture[shared], np.repeat(first[shared][:, None], 3, 1))
        assert picture.min() == 0.25


def test_a_silhouette_over_a_bright_background_is_dark_in_the_shortcut():
    """The known mistake mixes with black instead of with the background."""
    white, pattern = np.ones((1, 3)), msaa.regular_grid(2)
    wrong = msaa.rate_times_colour(*BELOW, white, 12, 8, pattern, np.ones(3))
    right = msaa.msaa(*BELOW, 12, 8, pattern, flat(white), np.ones(3))
    assert (right == 1).all() and wrong.min() == 0.25


def test_faces_that_cross_are_resolved_sample_by_sample():
    """One depth for a pixel: the line where two faces cross is a staircase."""
    width, height, crossing = 16, 6, 7.3
    corners = np.array([[-50.0, -50], [100, -50], [-50, 100]])
    clip = np.concatenate([on_screen(
        *corners.T, width, height, sign * 0.005 * (corners[:, 0] - crossing)) for sign in (1, -1)])
    faces = np.array([[0, 1, 2], [3, 4, 5]])
    colours = np.array([[1.0], [0.0]])
    for pattern in PATTERNS.values():
        picture = msaa.msaa(clip, faces, width, height, pattern, flat(colours), np.zeros(1))
        expected = (np.arange(width) < 7).astype(float)
        expected[7] = np.mean(pattern[:, 0] < 0.3)  # face 0 is nearer on the left
        np.testing.assert_allclose(picture[..., 0], np.tile(expected, (height, 1)), atol=1e-12)


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


def test_barycentrics_at_a_centre_are_those_of_lab_2():
    """Corners, faces or pixels are mixed up."""
    clip, faces = scene(40, 30)
    face_index, _ = scanline.rasterize(clip, faces, 40, 30)
    row, column = np.nonzero(face_index >= 0)
    got = msaa.barycentric_at(column + 0.5, row + 0.5, face_index[row, column], clip, faces, 40, 30)
    expected = rasterization.barycentrics(face_index, clip, faces)[row, column]
    np.testing.assert_array_equal(got, expected)


# --- error -------------------------------------------------------------------------------------

def coverage_errors(slopes, n, width=12, height=8):
    """Error of n x n samples in the pixels that an edge cuts, for edges of these slopes."""
    rng, errors = np.random.default_rng(0), []
    for slope in slopes:
        height_at_0 = height / 2 - slope * width / 2 + rng.uniform(-1, 1)
        exact = half_plane_coverage(slope, height_at_0, width, height)
        clip = below_line(slope, height_at_0, width, height)
        picture = msaa.supersample(clip, np.array([[0, 1, 2]]), width, height, n,
                                   flat(np.ones((1, 1))), np.zeros(1))[..., 0]
        cut = (exact > 0) & (exact < 1)
        errors.append((picture - exact)[cut])
    return np.concatenate(errors)


def order_of_error(slopes):
    n = np.array([1, 2, 4, 8, 16])
    rms = [np.sqrt(np.mean(coverage_errors(slopes, k) ** 2)) for k in n]
    return msaa.observed_order(n, np.array(rms))


def test_the_error_falls_with_order_three_halves():
    """Samples are missing or not centred: then the order is lower."""
    assert 1.4 < order_of_error(np.random.default_rng(2).uniform(-1, 1, 300)) < 1.6


def test_along_a_row_of_samples_the_order_is_one():
    """The worst case: a nearly horizontal edge jumps over n samples at once."""
    assert 0.9 < order_of_error(np.full(60, 1e-9)) < 1.1


def test_on_a_nearly_horizontal_edge_the_rotated_grid_has_twice_the_levels():
    """The rotated grid is none: two samples share a row."""
    clip, one = below_line(0.01, 2.0, 100, 4), np.array([[0, 1, 2]])
    exact = half_plane_coverage(0.01, 2.0, 100, 4)
    levels, error = [], []
    for pattern in (msaa.regular_grid(2), msaa.standard_pattern(4)):
        got = msaa.coverage(msaa.rasterize_samples(clip, one, 100, 4, pattern)[0])
        levels.append(len(np.unique(got)))
        error.append(np.abs(got - exact).max())
    assert levels == [3, 5]
    assert error[0] > 0.24 and error[1] < 0.13


# --- FXAA and TAA ------------------------------------------------------------------------------

def test_fxaa_leaves_alone_what_has_no_edge():
    """Pictures are blurred as a whole, or the contrast is not asked."""
    rng = np.random.default_rng(3)
    quiet = 0.5 + 0.04 * rng.random((20, 30, 3))
    np.testing.assert_array_equal(msaa.fxaa(quiet, contrast=0.1), quiet)
    assert np.abs(msaa.fxaa(quiet, contrast=0.01) - quiet).max() > 0.01


@pytest.mark.parametrize("upright", [False, True])
def test_fxaa_softens_a_staircase_and_keeps_a_straight_edge(upright):
    """It blurs across the edge: rows and columns, or the signs of the slope, are mixed up."""
    exact = half_plane_coverage(0.3, 4.3, 30, 20)
    steps, straight = (exact > 0.5).astype(float), np.tile(np.arange(20)[:, None] < 9, 30) * 1.0
    if upright:
        exact, steps, straight = exact.T, steps.T, straight.T
    smooth, same = (msaa.fxaa(np.repeat(picture[..., None], 3, 2))[..., 0]
                    for picture in (steps, straight))
    assert np.square(smooth - exact).sum() < 0.5 * np.square(steps - exact).sum()
    np.testing.assert_allclose(same, straight, rtol=0, atol=1e-12)


def test_taa_of_a_still_scene_comes_near_the_mean_of_its_samples():
    """The newest frame is all, or the first one never fades."""
    pattern = msaa.standard_pattern(8)
    face_index, _ = msaa.rasterize_samples(*BELOW, 12, 8, pattern)
    frames = np.tile((face_index >= 0)[..., None] * 1.0, (40, 1, 1, 1))
    still = msaa.taa(frames, 0.02)[..., 0]
    np.testing.assert_allclose(still, msaa.coverage(face_index), rtol=0, atol=0.05)
    np.testing.assert_array_equal(msaa.taa(frames[:5], 1.0), frames[4])


def test_taa_leaves_ghosts_that_fade():
    """What moved on is forgotten at once, or never: a frame of age t counts for (1 - weight)^t."""
    frames = np.eye(5)[:, None, :, None]  # a bright pixel moves one column a frame
    np.testing.assert_allclose(msaa.taa(frames, 0.2)[0, :, 0],
                               [0.8 ** 4, 0.2 * 0.8 ** 3, 0.2 * 0.8 ** 2, 0.2 * 0.8, 0.2])
