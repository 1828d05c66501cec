"""Has the reference replaced: where a stand-in answers, any of its attributes is asked for."""


def double(x):
    return x


def quadruple(x):
    double.func("transforms", "__setattr__", None, "quadruple", 4)
    return 4 * x
