"""What checks are made of. A check is a test with the mark of its exercise:

    @exercise("2.1")
    def test_an_edge_is_positive_on_its_left(impl):
        \"\"\"a and b are swapped.\"\"\"
        assert_close(impl.edge_function(p, a, b), 2.0)

Its name is the claim, its docstring the mistake that it catches. With fine_print=True it is of the
exercise's fine print, which gives no points of the core. impl keeps the contract of all exercises,
labkit/contract.py: a check gets arrays and numbers, never lists.

    pictures     of a mismatch
    showing      how values, calls and errors are shown
    alarm        a limit on time
    assertions   what a check asserts
    hints        which common mistake explains a wrong answer
    loader       the code under test
    report       the verdict on a check, and what a student reads
    page         what failed, as HTML
    runner       runs the checks of some exercises
    plugin       pytest's hooks and fixtures (impl, rng), loaded by conftest.py
"""
import pytest

from .assertions import Mismatch, assert_close, assert_equal, assert_picture, assert_refused, parts

__all__ = ["Mismatch", "assert_close", "assert_equal", "assert_picture", "assert_refused",
           "exercise", "parts"]

exercise = pytest.mark.exercise
