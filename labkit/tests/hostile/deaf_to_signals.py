"""Ignores every signal that can be ignored, then goes on for ever."""
import signal


def double(x):
    for number in set(signal.Signals) - {signal.SIGKILL, signal.SIGSTOP}:
        signal.signal(number, signal.SIG_IGN)
    while True:
        pass
