"""What is given in lab 7: the residual."""
from labkit.checks import assert_close
from tests.labs.test_vertex_gradients import brightness, each_matrix


@each_matrix
def test_residuals_are_cramers(impl, m, rng):
    """The target is added, M is transposed, or its last row is taken for ones."""
    values, a = rng.normal(size=3), rng.normal(size=3)
    assert_close(impl.residual(values, m, a, 0.7), brightness(values, m, a, 0.7))
