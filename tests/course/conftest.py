"""Figures in the course's style."""
import matplotlib as mpl
import matplotlib.pyplot as plt
import pytest

from course.given import plot


@pytest.fixture
def style():
    """Figures in the course's style, drawn without a screen, and closed afterwards."""
    mpl.use("Agg")
    plot.style()
    yield
    plt.close("all")
    mpl.rcdefaults()
