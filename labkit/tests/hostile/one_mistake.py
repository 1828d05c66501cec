"""A mistake in an exercise that a later one calls: it costs its own points alone."""


def double(x):
    return 3 * x
