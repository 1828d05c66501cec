"""What the exercises of lab 10's texture cubes must do."""
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


@exercise("10.4")
def test_taps_of_two_pixels_on_paper(impl):
    """Output 2, tap: depth / z_k, the perspective, is left out or upside down. T stands for T - 1.
    The lower and the upper weight are swapped. Bit 0 of n belongs to the last axis. t is rounded,
    not cut to its floor.
    """
    _, tap = two(impl.cube_taps(*TWO, 4))
    expected = np.array([[10, 30, 6, 18, 70, 210, 42, 126], [10, 70, 30, 210, 6, 42, 18, 126]])
    assert_close(tap, expected / 512)


@exercise("10.4")
def test_texels_of_two_pixels_on_paper(impl):
    """Output 1, index: texels are counted in another order than (i T + j) T + k, or bit 0 of n
    belongs to the last axis.
    """
    index, _ = two(impl.cube_taps(*TWO, 4))
    assert_close(index, [[1, 17, 5, 21, 2, 18, 6, 22], [16, 32, 20, 36, 17, 33, 21, 37]])


@exercise("10.4")
def test_a_corner_reads_its_own_texel(impl):
    """low is not limited to T - 2: at t = T - 1 the upper texel lies outside of the cube, beyond
    the last one.

    The original stays 1e-4 away from it.
    """
    index, tap = two(impl.cube_taps(np.eye(3), np.array([2.0, 3.0, 5.0]),
                                    np.array([[2.0, 3.0, 5.0]] * 3), 4))
    assert_equal(bool((index >= 0).all() and (index < 64).all()), True)
    assert_close((tap * (index == np.array([[48], [12], [3]]))).sum(1), np.ones(3))


@exercise("10.4")
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


@exercise("10.4", fine_print=True)
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


@exercise("10.5")
def test_a_sum_of_all_taps_cannot_change(impl, rng):
    """The sign of the lower texels is forgotten, whose weight 1 - (t - low) falls where t grows. Or
    they are left out. A tap keeps its own factor, where the product of the two others counts.
    """
    weight, depth, z = some_pixels(rng, 6)
    got = impl.cube_taps_backward(np.ones((6, 8)), weight, depth, z, 4)
    assert_close(got, (np.zeros((6, 3)), np.zeros(6), np.zeros((6, 3))), atol=1e-12)


@exercise("10.5")
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


@exercise("10.5")
@pytest.mark.parametrize("size", [2, 5])
def test_gradients_of_the_taps_are_central_differences(impl, rng, size, gradcheck):
    """The product rule lacks a factor, or a sign. Or T stands for T - 1."""
    gradcheck(taps, impl.cube_taps_backward, (*some_pixels(rng, 8), size),
              decisions=lambda *given: np.floor(place(*given)), name="taps")


@exercise("10.5")
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
