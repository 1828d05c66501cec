"""Kills the process that it came from."""
import signal


def double(x):
    os.kill(os.getppid(), signal.SIGKILL)
    return 2 * x
