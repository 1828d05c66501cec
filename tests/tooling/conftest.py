"""What a run of all tests does first and says at its end, and what tests of drawings share."""
from collections import Counter
from itertools import chain

import matplotlib as mpl
import matplotlib.pyplot as plt
import pytest

from course.given import plot

LONGEST = {"test_examine.py", "test_mistakes.py", "test_handout.py", "test_hostile.py"}


def pytest_collection_modifyitems(items):
    """The longest files first, so that in the end no core waits for one test."""
    items.sort(key=lambda item: item.path.name not in LONGEST)


def pytest_terminal_summary(terminalreporter):
    """The ten files that took longest."""
    seconds = Counter()
    for report in chain.from_iterable(terminalreporter.stats.values()):
        seconds[report.nodeid.partition("::")[0]] += getattr(report, "duration", 0)
    for file, taken in seconds.most_common(10):
        terminalreporter.write_line(f"{taken:6.1f} s  {file}")


@pytest.fixture
def style():
    """Figures in the course's style, drawn without a screen, and closed afterwards."""
    mpl.use("Agg")
    plot.style()
    yield
    plt.close("all")
    mpl.rcdefaults()
