"""Asks the reference for the exercise that it should solve itself."""


def quadruple(x):
    return double.func("transforms", "quadruple", x)
