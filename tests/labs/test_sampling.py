"""What the exercises of lab 3 must do."""
from fractions import Fraction

import numpy as np
import pytest

from labkit.checks import assert_close, assert_equal, assert_picture, exercise

SQUARE = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])
TRIANGLE = np.array([[1.2, 0.7], [6.3, 2.1], [2.9, 5.8]])  # counter-clockwise
TWO_SIDES_ON_THE_GRID = np.array([[1.0, 1.0], [3.0, 1.0], [1.0, 3.0]])

# Eq. (7) is easy to get right for an ordinary triangle. Each fits a picture 6 wide and 5 high.
TRIANGLES = {
    "ordinary": TRIANGLE, "clockwise": TRIANGLE[::-1].copy(),
    "smaller than a pixel": np.array([[3.2, 2.3], [3.7, 2.4], [3.3, 2.9]]),
    "thinner than a pixel": np.array([[0.3, 0.2], [5.8, 4.1], [5.7, 4.11]]),
    "far larger than the picture": np.array([[-900.0, -700.0], [950.0, 0.3], [-13.0, 800.0]]),
    "an edge of it crosses the picture": np.array([[-800.0, -300.0], [905.0, 340.0], [0.0, 700.0]]),
    "on the pixels' borders": np.array([[1.0, 1.0], [5.0, 1.0], [1.0, 4.0]]),
    "its corners on the pixels' corners": np.array([[0.0, 3.0], [2.0, 0.0], [6.0, 5.0]]),
    "partly outside": np.array([[-2.5, 1.5], [3.5, -1.25], [8.0, 6.5]]),
    "outside": np.array([[7.0, 1.0], [9.0, 2.0], [8.0, 4.0]]),
    "outside, behind its edge": np.array([[5.0, -9.0], [9.0, -1.0], [9.0, -9.0]]),
    "one pixel, its lower half": np.array([[2.0, 2.0], [3.0, 2.0], [3.0, 3.0]]),
    "no area": np.array([[0.5, 0.5], [4.5, 3.5], [2.5, 2.0]])}
each_triangle = pytest.mark.parametrize("triangle", TRIANGLES.values(), ids=TRIANGLES)


def part_beyond(part, a, b, c):
    """The part of a polygon where a x + b y + c >= 0, both as pairs of numbers."""
    kept = []
    for p, q in zip(part, part[1:] + part[:1], strict=True):
        at_p, at_q = (a * x + b * y + c for x, y in (p, q))
        if at_p >= 0:
            kept.append(p)
        if at_p * at_q < 0:
            t = at_p / (at_p - at_q)
            kept.append(tuple(u + t * (v - u) for u, v in zip(p, q, strict=True)))
    return kept


def part_in_pixel(polygon, i, j, number=Fraction):
    """The part of a polygon in pixel [i, j], as pairs of fractions: nothing is rounded."""
    part = [tuple(number(float(c)) for c in p) for p in polygon]
    for line in (1, 0, -j), (-1, 0, j + 1), (0, 1, -i), (0, -1, i + 1):
        part = part_beyond(part, *line)
    return part


def exact_area(part):
    """Shoelace formula of pairs of numbers -> float, positive if counter-clockwise."""
    following = part[1:] + part[:1]
    return float(sum(p[0] * q[1] - q[0] * p[1] for p, q in zip(part, following, strict=True)) / 2)


def exact_areas(polygon, width, height, number=Fraction):
    """The signed area of a polygon in each pixel (height, width)."""
    return np.array([[exact_area(part_in_pixel(polygon, i, j, number)) for j in range(width)]
                     for i in range(height)])


def counter_clockwise(triangles):
    """Triangles (N, 3, 2) with their vertices in this order."""
    sides = triangles[:, 1:] - triangles[:, :1]
    return np.where(np.linalg.det(sides)[:, None, None] < 0, triangles[:, ::-1], triangles)


def corners(width, height):
    """x, y (P,): the lower left corners of a picture's pixels, row by row."""
    y, x = np.indices((height, width)).reshape(2, -1).astype(float)
    return x, y


def wave(n, k):
    """n samples of a cosine with k periods."""
    return np.cos(2 * np.pi * k * np.arange(n) / n)


def point(shape, pixel, value):
    """A picture, or a spectrum, with this value at one pixel and 0 elsewhere."""
    picture = np.zeros(shape, type(value))
    picture[pixel] = value
    return picture


def convolved(picture, kernel):
    """The convolution as a sum of moved pictures."""
    h, w = kernel.shape
    return sum(kernel[i, j] * np.roll(picture, (i - h // 2, j - w // 2), (0, 1))
               for i, j in np.ndindex(h, w))


# --- frequencies -------------------------------------------------------------------------------

@exercise("3.1")
def test_aliases_on_paper(impl):
    """The remainder from 0 to the rate, which never turns backwards. The sign is lost (absolute
    value). It folds at the rate instead of at half the rate. The rate is subtracted once only. It
    is not multiplied by the rate again.
    """
    frequency = np.array([0.0, 1.0, 4.0, 6.0, 9.0, 10.0, 11.0, 24.0, 37.0, -3.0, -8.0])
    expected = [0.0, 1.0, 4.0, -4.0, -1.0, 0.0, 1.0, 4.0, -3.0, -3.0, 2.0]
    assert_close(impl.alias_frequency(frequency, 10.0), expected)
    assert_close(impl.alias_frequency(1.6, 0.5), 0.1)


@exercise("3.1", fine_print=True)
def test_half_the_rate_counts_as_negative(impl):
    """Half the rate comes as r/2 instead of -r/2: the interval has its upper end, not its lower
    one. Or np.round takes a half to the even number, so that the sign varies.
    """
    frequency = np.array([[2.0, 3.0, 10.0, -2.0], [-6.0, 1.0, 6.0, -7.0]])
    expected = np.array([[-2.0, -1.0, -2.0, -2.0], [-2.0, 1.0, -2.0, 1.0]])
    for row in (0, 1):
        assert_close(impl.alias_frequency(frequency[row], 4.0), expected[row])


@exercise("3.1")
def test_an_alias_has_the_same_samples(impl, rng):
    """A frequency that is slow, but another: its samples differ."""
    rate, frequency = 8.0, rng.uniform(-50, 50, 40)
    alias = impl.alias_frequency(frequency, rate)
    t = np.arange(12)[:, None] / rate
    assert_close(np.exp(2j * np.pi * alias * t), np.exp(2j * np.pi * frequency * t), atol=1e-9)
    assert_equal((np.abs(alias) <= rate / 2).all(), True)


@exercise("3.2")
def test_the_spectrum_of_four_samples_on_paper(impl):
    """The exponent without its minus: the conjugate, the inverse's matrix. A factor 1/n or
    1/sqrt(n). pi for 2 pi. Rows or columns count from 1 or -n/2. n - 1 for n. No imaginary part.
    """
    spectrum = impl.dft_matrix(4) @ np.array([1.0, 20.0, 300.0, 4000.0])
    assert_close(spectrum, [4321, -299 + 3980j, -3719, -299 - 3980j])


@exercise("3.2")
def test_it_is_the_fourier_transform_of_numpy(impl, rng):
    """Wrong for sizes that are odd, prime or 1."""
    for n in (*rng.integers(30, 130, 3).tolist(), 16, 7, 3, 2, 1):
        f = rng.normal(size=n)
        assert_close(impl.dft_matrix(n) @ f, np.fft.fft(f), atol=1e-12)


# --- filters -----------------------------------------------------------------------------------

@exercise("3.3")
def test_low_high_and_band_pass_of_three_waves(impl):
    """The kept and the removed part are swapped. Frequency 0, the mean, is lost (< for <=). Only
    positive frequencies are kept, or those above 1/2 are not taken for negative ones. Frequencies
    are in periods per picture, not in cycles per pixel.
    """
    low, middle, high = (np.tile(wave(32, k), (8, 1)) for k in (2, 6, 13))
    picture = 5 + low + middle + high
    assert_close(impl.band_pass(picture, 0, 4 / 32), 5 + low, atol=1e-9)
    assert_close(impl.band_pass(picture, 4 / 32, 10 / 32), middle, atol=1e-9)
    assert_close(impl.band_pass(picture, 10 / 32, np.inf), high, atol=1e-9)


@exercise("3.3")
def test_a_band_has_its_lower_and_not_its_upper_end(impl):
    """< for <=: a frequency on the border of two bands is in both of them, or in neither. low
    belongs to the band, high does not.
    """
    below, low, middle, high = (np.tile(wave(32, k), (6, 1)).T for k in (3, 4, 6, 8))
    picture = 5 + below + low + middle + high
    assert_close(impl.band_pass(picture, 4 / 32, 8 / 32), low + middle)
    assert_close(impl.band_pass(picture, 8 / 32, 0.5), high)
    assert_close(impl.band_pass(picture, 0.0, 4 / 32), 5 + below)


@exercise("3.3")
def test_the_band_is_a_ring_in_cycles_per_pixel(impl, rng):
    """A square band: the greater of |f_y| and |f_x| (maximum) instead of the length (hypot).
    |f_y| + |f_x|. One axis alone counts. Or frequencies are in periods per picture.
    """
    y, x = np.indices((16, 32))
    turns = 3 * y / 16 + 8 * x / 32 + rng.random()  # of length 0.3125
    diagonal = np.cos(2 * np.pi * turns)
    assert_close(impl.band_pass(diagonal, 0.0, 0.31), 0 * diagonal, atol=1e-9)
    assert_close(impl.band_pass(diagonal, 0.31, 0.315), diagonal, atol=1e-9)
    assert_close(impl.band_pass(diagonal, 0.315, np.inf), 0 * diagonal, atol=1e-9)


@exercise("3.4")
def test_a_point_becomes_the_kernel(impl):
    """The kernel is turned round (flipped): that is correlation. Its corner, not its middle, is
    put at the point. Its height and width (h and w) are swapped. It is divided by its sum.
    """
    kernel = np.arange(1.0, 16.0).reshape(3, 5)
    assert_close(impl.convolve(point((5, 7), (2, 3), 10.0), kernel), np.pad(10 * kernel, 1))


@exercise("3.4")
def test_borders_go_round(impl):
    """Beyond the border is zero (zero padding), the last pixel once more, or a mirror image. The
    picture goes round there: a circular convolution.
    """
    picture, kernel = np.array([[1.0, 0.0, 0.0, 10.0]]), np.array([[1.0, 2.0, 3.0]])
    assert_close(impl.convolve(picture, kernel), [[32.0, 3.0, 10.0, 21.0]])
    assert_close(impl.convolve(picture.T, kernel.T), np.array([[32.0, 3.0, 10.0, 21.0]]).T)


@exercise("3.4")
def test_convolution_is_the_double_sum(impl, rng):
    """A kernel whose height and width differ: h and w are swapped."""
    picture, kernel = rng.normal(size=(6, 5)), rng.normal(size=(3, 5))
    assert_close(impl.convolve(picture, kernel), convolved(picture, kernel))


@exercise("3.4", fine_print=True)
def test_a_kernel_may_be_larger_than_the_picture(impl):
    """A kernel larger than the picture goes round more than once. Its numbers that fall on the
    same pixel are added up, not overwritten, and none is cut off.
    """
    picture, kernel = np.array([[1.0, 100.0]]), np.array([[1.0], [2.0], [3.0], [4.0], [5.0]])
    assert_close(impl.convolve(picture, kernel), [[15.0, 1500.0]])
    assert_close(impl.convolve(picture, kernel.T), [[609.0, 906.0]])


@exercise("3.4")
def test_the_spectrum_of_a_convolution_is_the_product_of_the_spectra(impl, rng):
    """Eq. (4) holds to 1e-12, with the kernel's middle at [0, 0]."""
    picture, kernel = rng.uniform(size=(32, 24)), rng.uniform(size=(5, 3))
    around = np.roll(np.pad(kernel / kernel.sum(), ((0, 27), (0, 21))), (-2, -1), (0, 1))
    got = np.fft.fft2(impl.convolve(picture, kernel / kernel.sum()))
    assert_close(got, np.fft.fft2(picture) * np.fft.fft2(around), rtol=1e-12, atol=1e-12)


@exercise("3.5")
def test_both_ways_of_convolving_agree_to_rounding(impl, rng):
    """The kernel's corner, not its middle, is put at [0, 0], or it is moved the wrong way. Its
    spectrum is conjugated: correlation. h and w, or rows and columns, are swapped. The kernel is
    not padded. Spectra are multiplied as matrices (@), not number by number.
    """
    for kernel_shape in (3, 5), (1, 7), (7, 1), (7, 9):
        picture, kernel = rng.uniform(size=(7, 9)), rng.uniform(size=kernel_shape)
        got = impl.convolve_by_spectrum(picture, kernel)
        assert_close(got, convolved(picture, kernel), rtol=0, atol=1e-12)


@exercise("3.6")
def test_the_spectrum_of_a_box_on_paper(impl):
    """Not divided by the width, or by n. f is k, not k / n. 0/0 at frequency 0, where 1 is right.
    The sinc of a continuous box (np.sinc), without the sine in the denominator. The sign is lost. 2
    pi for pi.
    """
    assert_close(impl.box_spectrum(3, 6), [1.0, 2 / 3, 0.0, -1 / 3, 0.0, 2 / 3])
    assert_close(impl.box_spectrum(3, 4), [1.0, 1 / 3, -1 / 3, 1 / 3])
    assert_close(impl.box_spectrum(1, 3), np.ones(3))
    assert_close(impl.box_spectrum(5, 5), [1.0, 0.0, 0.0, 0.0, 0.0])


@exercise("3.6")
def test_it_is_the_fourier_transform_of_a_centred_box(impl, rng):
    """The continuous sinc: close for low frequencies, and off by a third at 1/2."""
    some = np.stack([2 * rng.integers(1, 25, 3) + 1, rng.integers(50, 130, 3)], 1).tolist()
    for width, n in (3, 16), (9, 9), *some:
        box = np.zeros(n)
        box[np.arange(-(width // 2), width // 2 + 1)] = 1 / width
        assert_close(impl.box_spectrum(width, n), np.fft.fft(box).real, rtol=0, atol=1e-12)


@exercise("3.7")
def test_two_copies_on_paper(impl):
    """Neighbours are summed, not copies N/s apart. Copies (aliases) are cut off. Every s-th entry
    is taken. 1/s comes once or never. The imaginary part is lost. One axis alone is folded.
    """
    columns = np.array([1 + 7j, 2 + 3j, 3 + 8j, 4 + 1j, 5 + 9j, 6 + 5j])
    spectrum = np.outer([1.0, 20.0, 300.0, 4000.0], columns)
    expected = np.outer([301.0, 4020.0], [5 + 8j, 7 + 12j, 9 + 13j]) / 4
    assert_close(impl.sampled_spectrum(spectrum, 2, np.inf), expected)


@exercise("3.7")
def test_a_wave_folds_to_its_alias(impl):
    """13 periods in 32 pixels, every 4th of them: 3 periods, backwards, not 5."""
    got = impl.sampled_spectrum(point((4, 32), (0, 13), 128 + 0j), 4, np.inf)
    assert_close(got, point((1, 8), (0, 5), 8 + 0j))


@exercise("3.7")
def test_it_is_the_spectrum_of_every_third_pixel(impl, rng):
    """The factor is not 1/s for each axis, or rows and columns are taken for each other. The
    imaginary part is lost.
    """
    for shape, step in ((12, 18), 3), ((8, 4), 4), ((5, 7), 1):
        picture = rng.normal(size=shape)
        got = impl.sampled_spectrum(np.fft.fft2(picture), step, np.inf)
        assert_close(got, np.fft.fft2(picture[::step, ::step]), rtol=0, atol=1e-12)


@exercise("3.7")
def test_what_is_too_fast_is_dropped(impl, rng):
    """There is no filter, or it drops the slow ones and keeps the fast ones. Only f_y or only f_x
    is asked, or their length (a disc). Negative frequencies are not dropped, or all of them are.
    """
    spectrum = np.fft.fft2(rng.normal(size=(12, 10)))
    slow = np.outer(np.abs(np.fft.fftfreq(12)) < 0.27, np.abs(np.fft.fftfreq(10)) < 0.27)
    assert_close(impl.sampled_spectrum(spectrum, 1, 0.27), np.where(slow, spectrum, 0))


@exercise("3.7")
def test_the_filter_ends_at_the_limit(impl):
    """The limit itself is kept, <= for <: half the rate folds. Or it counts in entries, as in
    periods per picture, not in cycles per pixel.
    """
    spectrum = np.arange(1.0, 9.0)[None] + 0j
    assert_close(impl.sampled_spectrum(spectrum, 1, 0.25), [[1 + 0j, 2, 0, 0, 0, 0, 0, 8]])


@exercise("3.7")
def test_it_filters_before_it_samples(impl, rng):
    """The filter comes after the copies have been summed, or has the frequencies of the result."""
    for shape, step, limit in ((12, 18), 3, 0.2), ((16, 8), 4, 0.125), ((9, 15), 3, 0.4):
        spectrum = np.fft.fft2(rng.normal(size=shape))
        f_y, f_x = (np.abs(np.fft.fftfreq(n)) for n in shape)
        filtered = np.fft.ifft2(spectrum * (f_y < limit)[:, None] * (f_x < limit))
        got = impl.sampled_spectrum(spectrum, step, limit)
        assert_close(got, np.fft.fft2(filtered[::step, ::step]), rtol=0, atol=1e-12)


@exercise("3.8")
def test_only_what_is_too_fast_folds(impl):
    """The sum over the pixels, not the mean over all of them. Both |f_y| and |f_x| must be too fast
    (and for or). The kept part is measured. The border is 1 / step, not half of it. Negative
    frequencies are missed. |F| is not squared.
    """
    spectrum = np.fft.fft2(np.tile(3 + wave(32, 3) + 2 * wave(32, 11), (8, 1)))
    assert_close(impl.folded_energy(spectrum, 8), 2.5)       # cos^2 is 1/2 on average: 1/2 + 4/2
    assert_close(impl.folded_energy(spectrum, 2), 2.0)
    assert_close(impl.folded_energy(spectrum.T.copy(), 2), 2.0)
    assert_close(impl.folded_energy(np.fft.fft2(np.ones((6, 6))), 3), 0.0)


@exercise("3.8")
def test_a_wave_at_half_the_rate_folds(impl):
    """> for >=: half the rate itself folds. Two samples to a period do not tell where the wave
    begins.
    """
    spectrum = np.fft.fft2(np.tile(wave(32, 4), (8, 1)))
    assert_close(impl.folded_energy(spectrum, 4), 0.5)
    assert_close(impl.folded_energy(spectrum, 2), 0.0)


@exercise("3.8")
def test_folded_energy_is_a_mean_square(impl, rng):
    """The length of the frequency (a ring) in place of a square: one of |f_y| and |f_x| is enough
    to fold. Or Parseval's factor is wrong for other sizes.
    """
    for shape, step in ((12, 30), 2), ((30, 24), 3):
        picture = rng.normal(size=shape)
        spectrum = np.fft.fft2(picture)
        f_y, f_x = (np.abs(np.fft.fftfreq(n)) for n in shape)
        kept = np.maximum(f_y[:, None], f_x) < 0.5 / step
        lost = picture - np.fft.ifft2(np.where(kept, spectrum, 0)).real
        assert_close(impl.folded_energy(spectrum, step), (lost**2).mean())


# --- exact coverage ----------------------------------------------------------------------------

def assert_polygon(got, expected, atol=1e-12):
    """The same vertices in the same order, from whichever of them on."""
    starts = [np.roll(expected, k, axis=0) for k in range(len(expected))]
    if np.shape(got) == np.shape(expected) and starts:
        expected = min(starts, key=lambda start: np.abs(got - start).max())
    assert_close(got, expected, atol=atol)


@exercise("3.9")
def test_a_polygon_is_cut_on_paper(impl):
    """The wrong side is kept, or c has the wrong sign. A crossing is missing: where the polygon
    leaves, where it comes back (enters), or on the last edge. It lies elsewhere: t for 1 - t, a
    sign, the middle. The points are in another order, not only from another start.
    """
    polygon = np.array([[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [2.0, 4.0]])
    # x + 2 y - 4 is -4, 2, 10, 6: it is crossed at 2/3 of the first edge, 3/5 of the last one.
    part = np.array([[4.0, 0.0], [6.0, 0.0], [6.0, 4.0], [2.0, 4.0], [0.8, 1.6]])
    assert_polygon(impl.clip_polygon(np.roll(polygon, 2, axis=0), 1.0, 2.0, -4.0), part)
    assert_polygon(impl.clip_polygon(polygon, 1.0, 2.0, -4.0), part)
    rest = np.array([[0.0, 0.0], [4.0, 0.0], [0.8, 1.6]])
    assert_polygon(impl.clip_polygon(polygon, -1.0, -2.0, 4.0), rest)


@exercise("3.9")
def test_crossings_lie_on_edge_and_line(impl, rng):
    """The middle of the edge, or the crossing measured from its other end."""
    for line in rng.normal(size=(40, 3)):
        expected = part_beyond((SQUARE - 1.5).tolist(), *line)
        got = impl.clip_polygon(SQUARE - 1.5, *line)
        assert_polygon(got, np.array(expected).reshape(-1, 2), atol=1e-9)


@exercise("3.9")
def test_all_or_nothing_stays(impl):
    """A polygon that is not cut changes. Where nothing is left, something stays. An empty polygon
    ends in an error.
    """
    assert_polygon(impl.clip_polygon(SQUARE, 1.0, 0.0, 1.0), SQUARE)
    assert_polygon(impl.clip_polygon(SQUARE, 1.0, 0.0, -9.0), np.zeros((0, 2)))
    assert_polygon(impl.clip_polygon(np.zeros((0, 2)), 1.0, 0.0, 1.0), np.zeros((0, 2)))


@exercise("3.9")
def test_points_on_the_line_are_inside(impl):
    """> for >=: a vertex on the line is lost, or comes twice, as itself and as a crossing."""
    slanted = np.array([[0.0, 1.0], [5.0, 3.0], [2.0, 5.0], [-1.0, 4.0]])
    assert_polygon(impl.clip_polygon(slanted, -2, 5, -5), slanted)  # a side is on the line
    assert_polygon(impl.clip_polygon(SQUARE, 1.0, 0.0, 0.0), SQUARE)
    assert_polygon(impl.clip_polygon(SQUARE, 0.0, -1.0, 4.0), SQUARE)


@exercise("3.10")
def test_half_and_quarter_pixels(impl):
    """Only the pixel's centre is tested: 0 or 1, no area. Rows and columns are swapped. Pixels are
    half a pixel off. Row 0 is at the top. A side clips the whole triangle anew, is left out, or
    keeps the wrong half. The triangle's area divides.
    """
    triangle = np.array([[1.0, 0.5], [3.0, 0.5], [3.0, 2.5]])
    expected = [[0.0, 0.375, 0.5, 0.0], [0.0, 0.125, 0.875, 0.0], [0.0, 0.0, 0.125, 0.0]]
    assert_picture(impl.pixel_coverage_loop(triangle, 4, 3), expected, atol=1e-12)


@exercise("3.10")
def test_a_clockwise_triangle_covers_as_much(impl):
    """A clockwise triangle covers less than nothing, or nothing: its area is negative."""
    got = impl.pixel_coverage_loop(TRIANGLES["clockwise"], 6, 5)
    assert_picture(got, exact_areas(TRIANGLE, 6, 5), atol=1e-9)


@exercise("3.10")
def test_coverages_sum_to_the_area(impl, rng):
    """A part of the triangle is lost between two pixels, or is counted in both."""
    for triangle in counter_clockwise(rng.uniform(0, 8, (6, 3, 2))):
        area = exact_area([tuple(map(Fraction, map(float, p))) for p in triangle])
        assert_close(np.sum(impl.pixel_coverage_loop(triangle, 8, 8)), area, rtol=0, atol=1e-9)


@exercise("3.10")
@pytest.mark.parametrize("name", [name for name in TRIANGLES if name != "clockwise"])
def test_coverage_is_the_exact_area(impl, name):
    """A small, thin or large triangle, or one on the pixels' borders, is wrong."""
    got = impl.pixel_coverage_loop(TRIANGLES[name], 6, 5)
    assert_picture(got, np.abs(exact_areas(TRIANGLES[name], 6, 5)), atol=1e-9)


@exercise("3.11")
def test_areas_in_five_squares_on_paper(impl):
    """Points are clamped to another square: one at the origin, one centred at x and y, or x and y
    swapped. The cuts are not used. The sign of the winding is lost.
    """
    triangle = np.array([[0.0, 0.0], [3.0, 0.0], [0.0, 2.0]])
    x, y = np.array([0.0, 1.0, 2.0, 0.0, 1.0]), np.array([0.0, 0.0, 0.0, 1.0, 1.0])
    expected = np.array([1.0, 11 / 12, 1 / 3, 2 / 3, 1 / 12])  # 3 in all
    assert_close(impl.clamped_area(triangle, x, y), expected)
    assert_close(impl.clamped_area(triangle[::-1].copy(), x, y), -expected)


@exercise("3.11")
@each_triangle
def test_clamping_gives_the_area_of_clipping(impl, triangle):
    """Points are clamped without the cuts: where an edge passes a corner, area appears."""
    got = np.reshape(impl.clamped_area(triangle, *corners(6, 5)), (5, 6))
    assert_picture(got, exact_areas(triangle, 6, 5), atol=1e-12)


@exercise("3.11")
def test_it_holds_for_polygons_that_are_not_convex(impl, rng):
    """Three corners are taken for granted."""
    star = np.array([[0.3, 0.2], [2.6, 1.7], [5.5, 0.4], [3.8, 2.3], [4.9, 4.6], [2.4, 3.1],
                     [0.9, 4.7], [1.6, 2.2]]) + rng.uniform(-0.2, 0.2, (8, 2))
    got = np.reshape(impl.clamped_area(star, *corners(6, 5)), (5, 6))
    assert_picture(got, exact_areas(star, 6, 5), atol=1e-12)  # parts joined by edges of no width


@exercise("3.12")
def test_only_the_edge_inside_the_square_pulls(impl):
    """The whole edge counts. Its ends get the same share, a whole one, swapped ones (t and 1 - t),
    or another vertex's. x and y of the normal are swapped, it points inwards, or the edge's length
    |q - p| is missing. grad_area is left out.
    """
    triangle = np.array([[0.5, -1.0], [0.5, 3.0], [-3.0, 1.0]])  # its right edge: x = 1/2
    got = impl.clamped_area_backward(np.array([2.0]), triangle, np.zeros(1), np.zeros(1))
    # Of the edge's length 4, t runs from 1/4 to 1/2: t^2 / 2 gains 3/32, and the rest is 5/32.
    assert_close(got, 2 * 4 * np.array([[5 / 32, 0.0], [3 / 32, 0.0], [0.0, 0.0]]))


@exercise("3.12")
def test_a_square_around_everything_sees_the_polygon__s_area(impl):
    """The gradient points inwards (opposite sign). x and y are swapped. Or a vertex gets another
    one's.
    """
    triangle = np.array([[0.2, 0.1], [0.9, 0.3], [0.4, 0.7]])
    got = impl.clamped_area_backward(np.array([4.0]), triangle, np.zeros(1), np.zeros(1))
    assert_close(got, [[-0.8, -1.0], [1.2, -0.4], [-0.4, 1.4]])


@exercise("3.12")
def test_all_squares_together_pull_like_the_area(impl, rng):
    """A part of an edge is lost between two squares, or pulls in both: an end of a piece decides
    what is inside, not its middle.
    """
    triangle = TRIANGLE + rng.uniform(-0.5, 0.5, (3, 2))
    x, y = triangle.T
    expected = np.stack([np.roll(y, -1) - np.roll(y, 1), np.roll(x, 1) - np.roll(x, -1)], -1) / 2
    assert_close(impl.clamped_area_backward(np.ones(56), triangle, *corners(8, 7)), expected)


@exercise("3.12", fine_print=True)
def test_an_edge_along_a_side_pulls_once(impl):
    """An edge along a side counts in both of the squares that share it, or in none."""
    got = impl.clamped_area_backward(np.ones(16), TWO_SIDES_ON_THE_GRID, *corners(4, 4))
    assert_close(got, [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]])


@exercise("3.12")
@pytest.mark.parametrize("name", ["ordinary", "clockwise", "smaller than a pixel",
                                  "thinner than a pixel", "partly outside"])
def test_the_gradients_of_clamped_areas_are_central_differences(impl, name, gradcheck):
    """grad_area is ignored or given to another square."""
    gradcheck(lambda polygon, x, y: exact_areas(polygon, 6, 5, float).ravel(),
              impl.clamped_area_backward, (TRIANGLES[name], *corners(6, 5)), differentiable=[0],
              name="clamped_area")
