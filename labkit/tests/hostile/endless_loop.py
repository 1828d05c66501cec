"""A loop without an end, in Python."""


def double(x):
    while True:
        pass
