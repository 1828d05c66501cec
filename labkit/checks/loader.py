"""The code under test: its folder, its modules, and what every call to it must keep to."""
import contextlib
import copy
import functools
import importlib
import sys
import traceback
import types
from pathlib import Path

import numpy as np
import pytest

from .. import contract, exercises, places
from ..table import COMMAND, COMPLETE, FAST
from .alarm import at_most
from .assertions import Mismatch
from .showing import PACKAGE, arguments, error_text

CALL_SECONDS = 20.0  # that a call may take
LAST_CALL = pytest.StashKey()    # of a check, to the code under test: function, args, kwargs
LAST_RETURN = pytest.StashKey()  # what that call returned; None if it did not
CALLS = pytest.StashKey()        # of a check: [(such a call, what it returned)]
WARNED = pytest.StashKey()       # of a check: what NumPy warned of first, and the frames there
FIND = pytest.StashKey()         # of the run: finds functions that run in another process


class Implementation:
    """The code under test: impl.edge_function(p, a, b) calls the function of that name.

    impl.Buffers is its NamedTuple of that name, and impl.outlines.Pairs that of another topic.

    Every call keeps to labkit/contract.py. So a check gets arrays and numbers in their
    standard form, whatever the function returned them as, and no warning reaches it: the first is
    kept for the report. A call fails that returns None or changes its inputs.

    find(name) -> the function, or what stands for it where it runs in another process: all that
    is done with it is to call it. Or a class, or a module for its classes. stash keeps all calls,
    and the last one, for the report.
    """

    def __init__(self, find, stash):
        self._find = find
        self._stash = stash
        stash[CALLS] = []

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        function = self._find(name)
        if isinstance(function, type):
            return function
        if isinstance(function, types.ModuleType):
            return classes(function)

        @functools.wraps(function)
        def call(*args, **kwargs):
            given = copy.deepcopy((args, kwargs))  # what it changes is not the check's
            self._stash[LAST_CALL] = function, args, kwargs
            self._stash[LAST_RETURN] = None
            returned = self._stash[LAST_RETURN] = contract.called(
                noted, self._stash, function, *given[0], **given[1])
            self._stash[CALLS].append((self._stash[LAST_CALL], returned))
            require_returned(name, returned)
            require_unchanged(function, (args, kwargs), given)
            return returned

        vars(self)[name] = call
        return call


def noted(stash, function, /, *args, **kwargs):
    """What the function returns. NumPy's first warning there is kept in the stash."""
    def keep(kind, _):
        if WARNED not in stash:
            frames = traceback.walk_stack(None)
            stash[WARNED] = kind, traceback.StackSummary.extract(frames, limit=20)

    with np.errstate(divide="call", invalid="call", over="call", call=keep):
        return function(*args, **kwargs)


def classes(module):
    """A module's classes alone: what it does is checked in its own topic."""
    return types.SimpleNamespace(**{name: found for name, found in vars(module).items()
                                    if isinstance(found, type)})


def require_returned(name, returned):
    if returned is None:
        raise Mismatch(("wrong", f"{name} returned None: is a return missing?"))
    for number, output in enumerate(returned if isinstance(returned, tuple) else (), 1):
        if output is None:
            raise Mismatch(("wrong", f"{name} returned None as output {number} of {len(returned)}"))


def require_unchanged(function, before, after):
    """before, after: (args, kwargs) of a call to the function."""
    if contract.unchanged(before, after):
        return
    pairs = zip(arguments(function, *before), arguments(function, *after), strict=True)
    changed = next(name for (name, old), (_, new) in pairs if not contract.unchanged(old, new))
    raise Mismatch(("wrong", f"{function.__name__} changed its input {changed}: "
                             "let it work on a copy"))


def folder(implementation: str) -> Path:
    """labs, reference or a path -> the folder of the code under test. ValueError: there is none."""
    named = implementation in ("labs", "reference")
    path = places.ROOT / implementation if named else Path(implementation).resolve()
    if not path.is_dir():
        raise ValueError(f"there is no folder {implementation} to check; give labs, reference, or "
                         "the path of a folder with files like those in labs/")
    return path


def load_topic(path):
    """Import FOLDER/<topic>.py. Mismatch: it cannot be imported.

    No bytecode is written. Python takes it for up to date when a source was edited within the same
    second and kept its length, as with a + made a -.
    """
    if not (path.exists() or exercises.complete(path.stem).exists()):
        raise Mismatch(("wrong", f"there is no {places.shown_path(path)}; take it "
                                 f"from the hand-out, or run {COMMAND} skeleton"))
    writes, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    try:
        return importlib.import_module(f"{PACKAGE}.{path.stem}")
    except (Exception, SystemExit) as error:
        raise Mismatch(("wrong", f"{places.shown_path(path)} cannot be imported: "
                                 f"{error_text(error, path.parent)}")) from None
    finally:
        sys.dont_write_bytecode = writes


@contextlib.contextmanager
def package(code):
    """A package of the code under test, so that `from . import x` works there.

    Afterwards, it is again that of the run in which this one takes place.
    """
    before = taken_out()
    sys.modules[PACKAGE] = types.ModuleType(PACKAGE)
    sys.modules[PACKAGE].__path__ = [str(code), *(str(places.ROOT / folder)  # as in grading
                                                  for folder in (COMPLETE, FAST))]
    yield
    taken_out()
    sys.modules.update(before)


def taken_out():
    """{name: module} of the package of the code under test, which is known no longer."""
    return {name: sys.modules.pop(name) for name in list(sys.modules)
            if name.split(".")[0] in (PACKAGE, "labs")}  # as what they import calls itself


def finder(code):
    """(topic, name) -> the function, class or module of that name in the code under test.

    Mismatch: there is none.
    """
    @functools.cache
    def module_or_mismatch(topic):
        try:
            return load_topic(code / f"{topic}.py")
        except Mismatch as mismatch:
            return mismatch

    def find(topic, name):
        module = module_or_mismatch(topic)
        if isinstance(module, Mismatch):
            raise Mismatch(*module.rows)
        found = getattr(module, name, None)
        found = getattr(found, "written", found)  # without what may stand in
        if isinstance(found, type | types.ModuleType):
            return found
        if not callable(found):
            path = places.shown_path(module.__file__)
            raise Mismatch(("wrong", f"{path} has no function {name}; "
                                     "keep the names that the skeleton gives"))
        return limited(found)

    return find


class Stopped(TimeoutError):
    """A call took longer than CALL_SECONDS."""


def limited(function):
    """The function, whose calls are stopped after a while: Stopped, where they are just then."""
    @functools.wraps(function)
    def call(*args, **kwargs):
        with at_most(CALL_SECONDS, Stopped(f"after {CALL_SECONDS:g} s; does a loop never end, or "
                                           "go over far too much?")):
            return function(*args, **kwargs)

    return call
