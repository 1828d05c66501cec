"""Memory: freed arrays stay with the process, where the C library is glibc.

It would give the pages of each large array back, and take and clear them again for the next one.
For pictures of 512 x 512 pixels that costs next to nothing on one machine, a third of the time on
another.
"""
import contextlib
import ctypes

M_TRIM_THRESHOLD, M_MMAP_THRESHOLD = -1, -3  # of malloc.h
BYTES = 1 << 30


def hold():
    """Keep up to 1 GiB of freed memory. Only a program's start calls this, never a library."""
    with contextlib.suppress(OSError, AttributeError, TypeError):  # not glibc: nothing changes
        mallopt = ctypes.CDLL(None).mallopt
        mallopt(M_MMAP_THRESHOLD, BYTES)
        mallopt(M_TRIM_THRESHOLD, BYTES)
