"""The examples in the docstrings: a student tries them first."""
import doctest
import importlib

import pytest

from course import exercises


@pytest.mark.parametrize("topic", exercises.topics())
def test_the_examples_are_true(topic):
    """An example that does not give what it shows."""
    module = importlib.import_module(f"reference.{topic}")
    assert doctest.testmod(module).failed == 0


@pytest.mark.parametrize("topic", exercises.topics())
def test_every_function_says_what_it_does(topic):
    """A function without a docstring: the reader must guess shapes."""
    module = importlib.import_module(f"reference.{topic}")
    silent = [name for name, value in vars(module).items() if callable(value) and not value.__doc__]
    assert silent == []
