"""A limit on what a block may take in this process. There is none in another thread than the main
one, and none on Windows.
"""
import contextlib
import signal
import threading

OURS = 20.0  # seconds of processor time that comparing and reporting what was returned may take


@contextlib.contextmanager
def at_most(seconds, error, of_processor=False):
    """The block, in which the error is raised after these seconds, on the clock or of processor
    time: at the next step of Python's own. `or_ended` does not wait for that.
    """
    def stop(*_):
        raise error

    if not hasattr(signal, "setitimer") or (
            threading.current_thread() is not threading.main_thread()):
        yield
        return
    timer, number = ((signal.ITIMER_PROF, signal.SIGPROF) if of_processor else
                     (signal.ITIMER_REAL, signal.SIGALRM))
    before = signal.signal(number, stop)
    signal.setitimer(timer, seconds)
    try:
        yield
    finally:
        signal.setitimer(timer, 0)
        signal.signal(number, before)


@contextlib.contextmanager
def or_ended(seconds):
    """The block, in which the system ends this process after these seconds of processor time."""
    has_timer = hasattr(signal, "setitimer")
    if has_timer:
        signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        if has_timer:
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)
