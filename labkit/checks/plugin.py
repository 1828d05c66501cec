"""The pytest plugin, loaded by conftest.py. It gives checks the code under test, and reports.

The report of a failed check is short and shows the last call to the code under test. --tb=long
gives pytest's own instead.
"""
import functools
import zlib

import numpy as np
import pytest

from . import alarm, loader, report


def pytest_addoption(parser):
    group = parser.getgroup("course")
    group.addoption("--impl", default="reference", metavar="labs|reference|FOLDER",
                    help="whose code to check; a folder holds files like those in labs/")
    group.addoption("--seed", default=0, type=int, metavar="N",
                    help="other random numbers in the checks")


def pytest_configure(config):
    config.addinivalue_line("markers", "exercise(number, fine_print=False): this test is a check "
                            "of that exercise's question, or of its fine print")
    try:
        loader.folder(config.option.impl)
    except ValueError as error:
        raise pytest.UsageError(error) from None


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_makereport(item, call):
    """The report of a check holds its Check, as a dict. A failed one has a text for students."""
    mark = item.get_closest_marker("exercise")
    if mark and item.config.option.tbstyle == "auto":
        item.repr_failure = str  # pytest's own text takes 0.2 s, and would be replaced
    made = yield
    if mark and (made.when == "call" or not made.passed):
        try:
            with alarm.at_most(alarm.OURS, TimeoutError(), of_processor=True):
                report.judge(item, call.excinfo and call.excinfo.value, made, mark)
        except Exception as error:  # of one check, and not the end of all
            report.without_report(item, error, made, mark)
    return made


@pytest.fixture(scope="session")
def find_function(pytestconfig):
    """(topic, name) -> what has that name in the code under test, see loader.finder."""
    if loader.FIND in pytestconfig.stash:
        yield pytestconfig.stash[loader.FIND]
        return
    code = loader.folder(pytestconfig.option.impl)
    with loader.package(code):
        yield loader.finder(code)


@pytest.fixture
def impl(request, find_function):
    """The functions of the topic that the test's file is named after, see Implementation."""
    topic = request.path.stem.removeprefix("test_")
    return loader.Implementation(functools.partial(find_function, topic), request.node.stash)


class Generator(np.random.Generator):
    """Its integers may be indices: in a browser these have 32 bits, and NumPy refuses others."""

    def integers(self, *args, **options):
        """The same numbers everywhere, of the type of NumPy's own indices."""
        return super().integers(*args, **options).astype(np.intp)


@pytest.fixture
def rng(request):
    """This check's own random numbers, made from --seed, its file's name and its own."""
    name = zlib.crc32(f"{request.path.name}::{request.node.name}".encode())
    return Generator(np.random.PCG64([request.config.option.seed, name]))
