"""What tests have: labkit's fixtures for checks, this course's gradient check, and processes."""
import functools

import pytest

from course.given.gradcheck import gradcheck

pytest_plugins = ["labkit.checks.plugin"]


@pytest.fixture(name="gradcheck")
def seeded_gradcheck(rng):
    """The gradient check of course/given, with this check's own random upstream gradient."""
    return functools.partial(gradcheck, seed=int(rng.spawn(1)[0].integers(1 << 31)))


@pytest.fixture(scope="session")
def run_module():
    """What afresh.run_module does: it is not there where a copy of this course has only checks."""
    import afresh
    return afresh.run_module


@pytest.fixture(scope="session")
def house(tmp_path_factory):
    """house({"labs/transforms.py": text, ...}) -> the root of a course with these files alone."""
    import afresh
    return lambda files: afresh.make_house(tmp_path_factory.mktemp("house"), files)
