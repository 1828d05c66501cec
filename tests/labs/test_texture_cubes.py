"""What the exercises of lab 10's texture cubes must do."""
import numpy as np
import pytest

from labkit.checks import assert_close, assert_equal, exercise, parts

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
    return parts(returned, "index", "tap")


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
