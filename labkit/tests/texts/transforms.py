"""Made up: a lab of the small course."""


def double(x):  # exercise 1.1 (1 point)
    """2 x."""
    return 2 * x


def quadruple(x):  # exercise 1.2 (2 points)
    """4 x."""
    return double(double(x))


def split(x):  # exercise 1.3 (4 points)
    """x / 2, and whether x is positive."""
    return x / 2, x > 0


def parts(x):
    """Yields the numbers of x. It is given, so it runs where it is called: no generator is sent."""
    yield from x
