"""Compiled: loops that numba turns into machine code, where it is installed, and all cores.

    @kernel            a function of loops over arrays: compiled by numba, else plain Python
    @has_kernels(name) a function of NumPy that a module's compiled function of its name may replace
    each_band          bands of a picture's rows, on all cores, their results in order

numba is never needed. With it, what is drawn is the same to the bit, and sooner. Only the reference
is replaced: labs/ runs what a student wrote, and what is checked or graded is plain Python, where a
wrong index is an error. Compiled code reads on in memory.

numba keeps machine code beside a module, in __pycache__, until that one file changes. So a kernel
calls kernels of its own file only. What Python hands to a kernel in NamedTuples has its type found
in 1 us, unless two of them have the same name and types: then it takes 50 us, at each call.
"""
import collections
import concurrent.futures
import functools
import importlib.util
import itertools
import os
from pathlib import Path

from labkit.contract import UNFINISHED

CHECKED = "implementation"  # the package of the code under test


def kernel(function):
    """The function, compiled when it is first called, for the types that it is called with.

    It takes and returns arrays, numbers, and NamedTuples of these. No other thread waits for it,
    and a division by 0 gives inf or nan as in NumPy. A kernel that calls it has its code within.
    Otherwise each call would count the arrays' owners, which for short runs of pixels takes longer
    than the sums: 2.2 times the time of a way back at 512^2, measured.
    """
    is_written = not any(UNFINISHED.fullmatch(text) for text in function.__code__.co_consts
                         if isinstance(text, str))
    if not (is_written and is_installed()) or function.__module__.split(".")[0] == CHECKED:
        return function
    import numba
    compiled = functools.partial(numba.njit, nogil=True, error_model="numpy", forceinline=True)
    try:
        kept = compiled(cache=True)(function)
    except RuntimeError:  # there is no folder that may be written to
        return compiled()(function)
    forget_older(kept.stats.cache_path, function)
    return kept


def forget_older(folder, function):
    """Remove what numba kept of a kernel before its file changed.

    numba would read it before it looks how old it is, and fail at a NamedTuple that is gone.
    """
    path = Path(function.__code__.co_filename)
    for kept in Path(folder).glob(f"{path.stem}.{function.__name__}-*.nbi"):
        if kept.stat().st_mtime < path.stat().st_mtime:
            kept.unlink(missing_ok=True)


def has_kernels(module):
    """A decorator for functions of the reference: where numba is installed, the function of the
    same name in course/fast/MODULE.py takes their place, unless that was not handed out.
    """
    def decorate(function):
        package, _, _ = function.__module__.partition(".")
        if package != "reference" or not is_installed() or not importlib.util.find_spec(
                f"{package}.{module}"):
            return function

        @functools.wraps(function)
        def compiled(*args, **kwargs):
            kernels = importlib.import_module(f"{package}.{module}")  # numba's import takes a while
            return getattr(kernels, function.__name__)(*args, **kwargs)

        return compiled
    return decorate


def without_kernels(function):
    """The function of NumPy that `has_kernels` decorates."""
    return getattr(function, "__wrapped__", function)


@functools.cache
def is_installed():
    return importlib.util.find_spec("numba") is not None


def cores():
    """How many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@functools.cache
def pool(threads):
    return concurrent.futures.ThreadPoolExecutor(threads)


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=pool.cache_clear)  # a fork has none of its parent's threads


def each_band(function, bands, threads=None):
    """function(*band) for each of the bands, an iterator in their order, by so many threads: None
    for one a core.

    Two bands must not write to one place. Kernels run at the same time, Python does not.
    """
    if len(bands) <= 1 or (threads or cores()) == 1:
        return itertools.starmap(function, bands)
    return in_threads(function, bands, threads or cores())


def in_threads(function, bands, threads):
    """`each_band`, begun only a little ahead, so that few results are in memory at a time."""
    begun = collections.deque()
    for band in bands:
        begun.append((pool(threads - 1).submit(function, *band), band))
        if len(begun) > 2 * threads:
            yield first_of(function, begun)
    while begun:
        yield first_of(function, begun)


def first_of(function, begun):
    """The result of the first of the bands. If no other thread is at it, this one does it, or else
    later ones meanwhile: it waits only where there is nothing to do.
    """
    future, band = begun.popleft()
    if future.cancel():
        return function(*band)
    for k in reversed(range(len(begun))):
        if future.done():
            break
        if begun[k][0].cancel():
            ahead = concurrent.futures.Future()
            ahead.set_result(function(*begun[k][1]))
            begun[k] = ahead, None
    return future.result()
