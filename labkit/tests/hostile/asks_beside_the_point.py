"""Asks the reference for an exercise that this one does not need."""


def double(x):
    return x


def split(x):
    return x / 2, double(x) == 2 * x
