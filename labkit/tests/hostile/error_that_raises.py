"""Raises an error whose text can't be had."""


class Bad(Exception):
    def __str__(self):
        os._exit(0)


def double(x):
    raise Bad
