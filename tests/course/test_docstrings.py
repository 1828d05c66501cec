"""The examples in the docstrings: a student tries them first."""
import doctest
import importlib

import pytest

from labkit import exercises

MODULES = [f"reference.{topic}" for topic in exercises.topics()]


@pytest.mark.parametrize("module", [*MODULES, "course.given.ray_casting"])
def test_the_examples_are_true(module):
    """An example that does not give what it shows."""
    assert doctest.testmod(importlib.import_module(module)).failed == 0


@pytest.mark.parametrize("module", MODULES)
def test_every_function_says_what_it_does(module):
    """A function without a docstring: the reader must guess shapes."""
    there = vars(importlib.import_module(module)).items()
    assert [name for name, value in there if callable(value) and not value.__doc__] == []
