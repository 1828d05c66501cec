"""Leaves a process behind that nobody waits for, in a session of its own."""
import time


def double(x):
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            try:
                os.execv(sys.executable, [sys.executable, "-c", "import time; time.sleep(LONG)"])
            finally:
                time.sleep(LONG)
        os._exit(0)
    return 2 * x
