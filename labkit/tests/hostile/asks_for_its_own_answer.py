"""Asks the reference for the exercise that it should solve itself."""


def double(x):
    return x


def quadruple(x):
    return double.func("transforms", "quadruple", None, x)
