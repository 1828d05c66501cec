"""What is done with arrays of any numbers."""
import numpy as np
import pytest

from course.given import arrays


@pytest.mark.parametrize(("index", "columns"), [((7,), ()), ((4, 3), ()), ((4, 3), (2,)),
                                                ((0, 3), (2,)), ((5,), (2, 4))])
def test_a_scatter_is_the_transpose_of_a_gather(rng, index, columns):
    """A row that several values go to keeps the last one alone; or of no values, integers come."""
    index = rng.integers(0, 6, index)
    values, x = (rng.normal(size=(*rows, *columns)) for rows in (index.shape, (6,)))
    total = arrays.scatter(values, index, 6)
    assert total.shape == x.shape and total.dtype == float
    np.testing.assert_allclose((values * x[index]).sum(), (total * x).sum(), rtol=1e-12, atol=1e-12)
