import numpy as np

from labkit.checks import assert_close, exercise


@exercise("2.1")
def test_eight_times(impl):
    """Less."""
    assert_close(impl.eight(np.array([1.0, 2.0])), np.array([8.0, 16.0]))
