"""A loop without an end, in C, that holds the interpreter's lock."""
import itertools


def double(x):
    return sum(itertools.repeat(0))
