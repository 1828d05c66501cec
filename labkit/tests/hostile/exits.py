"""Ends the process in good order in a call."""


def double(x):
    sys.exit(0)
