"""Two small labs and their checks, to be graded in tests."""
LAB = '''\
"""Made up."""
import os
import sys

import numpy as np


def double(x):  # exercise 1.1 (1 point)
    """2 x."""
    return 2 * x


def quadruple(x):  # exercise 1.2 (2 points)
    """4 x."""
    return double(double(x))


def split(x):  # exercise 1.3 (4 points)
    """x / 2, and whether x is positive."""
    return x / 2, x > 0


def parts(x):
    """Yields the numbers of x. It is given, so it runs where it is called: no generator is sent."""
    yield from x
'''
CHECKS = '''\
import numpy as np

from course.checks import assert_close, exercise


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
'''
SECOND = '''\
"""Made up."""
import numpy as np

from . import transforms


def eight(x):  # exercise 2.1 (3 points)
    """8 x."""
    return np.array([transforms.quadruple(part) for part in transforms.parts(2 * x)])
'''
SECOND_CHECKS = '''\
import numpy as np

from course.checks import assert_close, exercise


@exercise("2.1")
def test_eight_times(impl):
    """Less."""
    assert_close(impl.eight(np.array([1.0, 2.0])), np.array([8.0, 16.0]))
'''


def first_lab(lab=LAB, checks=CHECKS):
    """The first lab as a course has it."""
    return {"reference/transforms.py": lab, "labs/transforms.py": LAB,
            "tests/labs/test_transforms.py": checks}


def hand_in(folder, **texts):
    """Put submissions into folder/in: ada=LAB is her first lab."""
    (folder / "in").mkdir()
    for student, text in texts.items():
        (folder / "in" / f"{student}_transforms.py").write_text(text, encoding="utf-8")
