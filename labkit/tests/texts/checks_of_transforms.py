import numpy as np

from labkit.checks import assert_close, exercise


@exercise("1.1")
def test_twice(impl, rng):
    """Once."""
    x = rng.normal(size=3)
    expected = x + x
    assert_close(impl.double(x), expected)
    assert_close(impl.double(x[:1] + 1), expected[:1] + 2)


@exercise("1.2")
def test_four_times(impl, rng):
    """Twice."""
    x = rng.normal(size=3)
    expected = x + x + x + x
    assert_close(impl.quadruple(x), expected)


@exercise("1.3")
def test_half_and_sign(impl):
    """The whole."""
    x = np.array([1.0, -2.0])
    assert_close(impl.split(x), (np.array([0.5, -1.0]), np.array([True, False])))
