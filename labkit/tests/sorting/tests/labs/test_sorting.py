import numpy as np

from labkit.checks import assert_equal, exercise


@exercise("1.1")
def test_both_are_there(impl):
    """One of them is lost."""
    got = impl.merged(np.array([1, 4]), np.array([2, 3, 5]))
    assert_equal(got, np.array([1, 2, 3, 4, 5]))


@exercise("1.2")
def test_all_numbers_are_sorted(impl, rng):
    """Numbers that are equal come once."""
    x = rng.integers(0, 9, 12)
    assert_equal(impl.merge_sort(x), np.array(sorted(x)))
