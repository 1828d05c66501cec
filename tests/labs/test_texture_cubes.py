"""What the exercises of lab 10's texture cubes and light must do."""
import numpy as np
import pytest

from labkit.checks import Mismatch, assert_close, assert_equal, exercise

# --- texture cubes -----------------------------------------------------------------------------

def some_pixels(rng, count):
    """weight, depth, z of count pixels."""
    weight, z = rng.dirichlet(np.ones(3), count), rng.uniform(1, 4, (count, 3))
    return weight, 1 / (weight / z).sum(1), z


def place(weight, depth, z, size):
    return (size - 1) * weight * depth[:, None] / z


# Two pixels: weight, depth, z of their faces' corners. In a cube of 4^3 texels, t is 3/4, 3/8, 15/8
# and 15/8, 3/4, 3/8.
TWO = (np.array([[8.0, 2.0, 5.0], [5.0, 8.0, 2.0]]) / 15, np.array([15.0, 15.0]) / 8,
       np.array([[4.0, 2.0, 1.0], [1.0, 4.0, 2.0]]))


def two(returned):
    """index, tap of what was returned. Mismatch: these are not two."""
    if not isinstance(returned, tuple) or len(returned) != 2:
        raise Mismatch(("wrong", "two outputs are expected: index, and tap"))
    return returned


@exercise("10.6")
def test_taps_of_two_pixels_on_paper(impl):
    """Output 2, tap: depth / z_k, the perspective, is left out or upside down. T stands for T - 1.
    The lower and the upper weight are swapped. Bit 0 of n belongs to the last axis. t is rounded,
    not cut to its floor.
    """
    _, tap = two(impl.cube_taps(*TWO, 4))
    expected = np.array([[10, 30, 6, 18, 70, 210, 42, 126], [10, 70, 30, 210, 6, 42, 18, 126]])
    assert_close(tap, expected / 512)


@exercise("10.6")
def test_texels_of_two_pixels_on_paper(impl):
    """Output 1, index: texels are counted in another order than (i T + j) T + k, or bit 0 of n
    belongs to the last axis.
    """
    index, _ = two(impl.cube_taps(*TWO, 4))
    assert_close(index, [[1, 17, 5, 21, 2, 18, 6, 22], [16, 32, 20, 36, 17, 33, 21, 37]])


@exercise("10.6")
def test_a_corner_reads_its_own_texel(impl):
    """low is not limited to T - 2: at t = T - 1 the upper texel lies outside of the cube, beyond
    the last one.

    The original stays 1e-4 away from it.
    """
    index, tap = two(impl.cube_taps(np.eye(3), np.array([2.0, 3.0, 5.0]),
                                    np.array([[2.0, 3.0, 5.0]] * 3), 4))
    assert_equal(bool((index >= 0).all() and (index < 64).all()), True)
    assert_close((tap * (index == np.array([[48], [12], [3]]))).sum(1), np.ones(3))


@exercise("10.6")
@pytest.mark.parametrize("size", [2, 3, 6])
def test_eight_taps_give_back_the_place(impl, rng, size):
    """depth / z_k is left out: a texture in perspective bends. Or T stands for T - 1. Or index has
    no integers.
    """
    weight, depth, z = some_pixels(rng, 40)
    index, tap = two(impl.cube_taps(weight, depth, z, size))
    texel = np.stack(np.unravel_index(index, (size,) * 3), -1)
    assert_close((tap[..., None] * texel).sum(1), place(weight, depth, z, size), atol=1e-9)
    assert_close(tap.sum(1), np.ones(40))
    assert_equal(bool((tap > -1e-12).all()), True)
    assert_equal(np.ptp(texel, axis=1), np.ones((40, 3), int))


@exercise("10.6", fine_print=True)
def test_rounding_does_not_lead_out_of_the_cube(impl):
    """A depth that is rounded up gives t = T - 1 + 1e-16, which is not cut off."""
    weight = np.array([[1.0, 0.0, 0.0], [0.0, 0.5, 0.5]])
    index, tap = two(impl.cube_taps(weight, np.array([1 + 1e-15, 1.0]), np.ones((2, 3)), 3))
    assert_equal(bool((index >= 0).all() and (index < 27).all()), True)
    assert_close((tap * (index == 18)).sum(1), [1.0, 0.0])
    assert_equal(bool(((tap >= 0) & (tap <= 1)).all()), True)


def taps(weight, depth, z, size):
    """(N, 8) weights as products, tap by tap."""
    t = place(weight, depth, z, size)
    part = t - np.minimum(np.floor(t), size - 2)
    return np.stack([np.prod([part[:, k] if n >> k & 1 else 1 - part[:, k] for k in range(3)], 0)
                     for n in range(8)], 1)


@exercise("10.7")
def test_a_sum_of_all_taps_cannot_change(impl, rng):
    """The sign of the lower texels is forgotten, whose weight 1 - (t - low) falls where t grows. Or
    they are left out. A tap keeps its own factor, where the product of the two others counts.
    """
    weight, depth, z = some_pixels(rng, 6)
    got = impl.cube_taps_backward(np.ones((6, 8)), weight, depth, z, 4)
    assert_close(got, (np.zeros((6, 3)), np.zeros(6), np.zeros((6, 3))), atol=1e-12)


@exercise("10.7")
def test_places_pull_on_paper(impl):
    """The factor T - 1 is left out. Output 3, grad_z, has a plus: t_k falls as z_k grows. depth,
    weight or z is left out, or z is not squared in grad_z. Two axes are swapped.
    """
    bits = np.arange(8)[:, None] >> np.arange(3) & 1
    grad_tap = (bits * [32.0, -16.0, 24.0]).T  # the sum of all upper taps along axis k is t_k - low
    weight, depth, z = (np.tile(array[:1], (3, 1)[:array.ndim]) for array in TWO)
    got = impl.cube_taps_backward(grad_tap, weight, depth, z, 4)
    grad_weight, grad_z = np.diag([45.0, -45.0, 135.0]), np.diag([-6.0, 3.0, -45.0])
    assert_close(got, (grad_weight, [12.8, -3.2, 24.0], grad_z))


@exercise("10.7")
@pytest.mark.parametrize("size", [2, 5])
def test_gradients_of_the_taps_are_central_differences(impl, rng, size, gradcheck):
    """The product rule lacks a factor, or a sign. Or T stands for T - 1."""
    gradcheck(taps, impl.cube_taps_backward, (*some_pixels(rng, 8), size),
              decisions=lambda *given: np.floor(place(*given)), name="taps")


@exercise("10.7")
def test_at_a_corner_the_last_cell_counts(impl):
    """low is not limited to T - 2: at t = T - 1 it is the derivative of the cell beyond, which is
    not there.
    """
    grad_tap = np.zeros((1, 8))
    grad_tap[0, [0, 1]] = -3.0, 5.0
    got = impl.cube_taps_backward(grad_tap, np.array([[1.0, 0.0, 0.0]]), np.array([2.0]),
                                  np.array([[2.0, 1.0, 4.0]]), 3)
    grad_weight, grad_z = np.array([[16.0, -20.0, -5.0]]), np.array([[-8.0, 0.0, 0.0]])
    assert_close(got, (grad_weight, [8.0], grad_z))


# --- light -------------------------------------------------------------------------------------

LYING = np.array([[[0.0, 0.0, 0.0], [0.0, 0.0, 3.0], [2.0, 0.0, 0.0]]])  # looks up, n = (0, 1, 0)
RED, BLUE = np.array([1.0, 0.0, 0.25]), np.array([0.0, 2.0, 1.0])


TILTED = np.array([[[1.0, 1.0, 1.0], [-2.0, 3.0, 1.0], [-2.0, 1.0, 2.0]]])  # N = (2, 3, 6)
ABOVE = np.array([1.0, 4.0, 0.0])


@exercise("10.10")
def test_light_on_paper(impl):
    """The other side of a face is lit. N is of corners, not of sides. N is not divided by its
    length, or by that of all faces together. max(0, ...) is left out, holds ambient too, or is an
    absolute value. towards is divided by its length.
    """
    corners = np.concatenate([LYING, TILTED, LYING[:, ::-1], TILTED[:, ::-1]])
    cosine = np.array([[4.0], [2.0], [0.0], [0.0]])  # n = (0, 1, 0), (2, 3, 6) / 7, and minus these
    assert_close(impl.face_light(corners, RED, BLUE, ABOVE), RED + cosine * BLUE)


@exercise("10.10")
def test_light_from_above_shines_on_what_looks_up(impl):
    """The other side is lit: the cross product is in the order of the original, whose space is
    left-handed.
    """
    both = np.concatenate([LYING, LYING[:, ::-1]])
    got = impl.face_light(both, RED, BLUE, np.array([0.0, 1.0, 0.0]))
    assert_close(got, [[1.0, 2.0, 1.25], [1.0, 0.0, 0.25]])


@exercise("10.10")
def test_light_falls_off_with_the_cosine(impl):
    """A large face is brighter: N is not divided by its length. Or towards is made a unit vector.
    """
    got = impl.face_light(5 * LYING, RED, BLUE, np.array([0.0, 0.5, -7.0]))
    assert_close(got, [[1.0, 1.0, 0.75]])


@exercise("10.10")
def test_lights_of_many_faces(impl, rng):
    """Normals of neighbouring faces are mixed, or have one length for all of them."""
    corners, towards = rng.normal(size=(6, 3, 3)), rng.normal(size=3)
    expected = []
    for a, b, c in corners:
        e, f = b - a, c - a
        n = np.array([e[i] * f[j] - e[j] * f[i] for i, j in ((1, 2), (2, 0), (0, 1))])
        expected.append(RED + max((n @ towards) / np.sqrt(n @ n), 0) * BLUE)
    assert_close(impl.face_light(corners, RED, BLUE, towards), np.array(expected))


@exercise("10.10", fine_print=True)
def test_a_face_without_area_has_ambient_light_alone(impl):
    """0 is divided by 0: the light of a face without area is NaN."""
    got = impl.face_light(np.ones((2, 3, 3)), RED, BLUE, np.array([1.0, 1.0, 1.0]))
    assert_close(got, np.stack([RED, RED]))


def light(corners, ambient, directional, towards):
    a, b, c = np.moveaxis(corners, 1, 0)
    normal = np.cross(b - a, c - a)
    normal = normal / np.sqrt((normal**2).sum(1, keepdims=True))
    return ambient + np.maximum((normal * towards).sum(1), 0)[:, None] * directional


@exercise("10.11")
def test_the_gradient_of_the_colours_is_a_sum_over_faces(impl):
    """grad_ambient or grad_directional is a mean, or that of one face. grad_directional lacks the
    cosine, or counts faces that look away. grad_towards lacks D.
    """
    corners = np.concatenate([LYING, 2 * LYING, LYING[:, ::-1]])
    grad_light = np.array([[1.0, 2.0], [10.0, 20.0], [100.0, 200.0]])
    _, *got = impl.face_light_backward(grad_light, corners, np.ones(2), np.array([3.0, 4.0]),
                                       np.array([0.0, 0.5, 0.0]))
    assert_close(tuple(got), ([111.0, 222.0], [5.5, 11.0], [0.0, 121.0, 0.0]))


@exercise("10.11")
def test_corners_pull_on_paper(impl):
    """Output 1, grad_corners: the length of N is taken for a constant, so that the part along n is
    not taken away. A cross product is turned round. Corner a has no gradient. Faces that look away
    have one: max(0, ...) is forgotten.
    """
    corners = np.concatenate([LYING, LYING[:, ::-1], 2 * LYING])
    grad_light = np.array([[7.0, 5.0, 2.0]] * 3)  # with D = BLUE, 12 for the cosine
    got, *_ = impl.face_light_backward(grad_light, corners, RED, BLUE, np.array([1.0, 4.0, 2.0]))
    # 12 (l - 4 n) / 6 = (2, 0, 4) for N, and its cross products with b - a and c - a.
    one = np.array([[0.0, 14.0, 0.0], [0.0, -8.0, 0.0], [0.0, -6.0, 0.0]])
    assert_close(got, np.stack([one, 0 * one, one / 2]))


@exercise("10.11")
def test_gradients_of_light_are_central_differences(impl, rng, gradcheck):
    """A term is left out: of a corner, of the length of N, or of faces that look away."""
    inputs = (rng.normal(size=(9, 3, 3)), *rng.random((2, 2)), rng.normal(size=3))

    def lit(corners, ambient, directional, towards):
        return light(corners, 0 * ambient, 1 + 0 * directional, towards) > 0

    gradcheck(light, impl.face_light_backward, inputs, decisions=lit, name="light")


@exercise("10.11", fine_print=True)
def test_what_looks_away_is_constant(impl):
    """Light from below has a gradient on what looks up, or grazing light has one, where n . l = 0.
    """
    for towards in ([1.0, -1.0, 0.0], [1.0, 0.0, 0.0]):
        got = impl.face_light_backward(np.ones((1, 3)), LYING, RED, BLUE, np.array(towards))
        assert_close(got, (np.zeros((1, 3, 3)), np.ones(3), np.zeros(3), np.zeros(3)))


@exercise("10.11", fine_print=True)
def test_a_face_without_area_has_no_gradient(impl):
    """0 is divided by 0: NaN for a face without area, which the sum over vertices spreads."""
    corners = np.concatenate([np.ones((1, 3, 3)), LYING])
    got = impl.face_light_backward(np.ones((2, 3)), corners, RED, BLUE, np.array([0.0, 2.0, 0.0]))
    towards = [0.0, BLUE.sum(), 0.0]
    assert_close(got, (np.zeros((2, 3, 3)), np.full(3, 2.0), np.full(3, 2.0), towards))
