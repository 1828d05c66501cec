"""Reads where no memory is: the process dies of it."""
import ctypes


def double(x):
    ctypes.string_at(0)
