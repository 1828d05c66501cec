"""What most tests of `reconstruct` begin with."""
import pytest
import ring_captures as ring


@pytest.fixture
def folder(tmp_path):
    """Six pictures with alpha, 48 x 32 pixels, of a ring at (1, 2, 3), and their cameras."""
    return ring.nerf(ring.photograph(tmp_path))
