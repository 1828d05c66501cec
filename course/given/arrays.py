"""Arrays: what every lab does with rows of numbers, whatever the numbers are.

    gather    x[index]                        each place takes a row
    scatter   sum[index[n]] += values[n]      each place gives a row: the gather's transpose
    expand    ranges, one after the other     a face's rows, a row's columns
    chunks    a part at a time                what is in flight stays in the cache

faces (F, 3) are three vertices each. EDGES says which of their edges is edge k.
"""
import math

import numpy as np

EDGES = (1, 2), (2, 0), (0, 1)  # edge k runs from the first to the second, opposite to vertex k
ROWS = 1 << 14   # at most so many at a time, `in_chunks`
CHUNK = 1 << 15  # at most so many elements of ranges at a time, `chunks`


def scatter(values, index, count):
    """The transpose of the gather x[index]: row index[n] of the result sums the values[n].

    values (*index.shape, ...), index of integers below count -> (count, ...).

    >>> scatter(np.array([1.0, 10.0, 100.0]), np.array([2, 0, 2]), 3)
    array([ 10.,   0., 101.])
    """
    shape = values.shape[index.ndim:]
    columns = values.reshape(index.size, math.prod(shape)).T
    sums = [np.bincount(index.ravel(), column, count) for column in columns]
    return np.stack(sums, -1, dtype=float).reshape(count, *shape)  # floats, also of no index


def scatter_first(values, index, count):
    """Each place keeps the first value that comes to it, -1 where none comes.

    values, index (...) integers, index below count -> (count,).

    >>> scatter_first(np.array([7, 8, 9]), np.array([2, 0, 2]), 4)
    array([ 8, -1,  7, -1])
    """
    first = np.full(count, -1)
    first[index.ravel()[::-1]] = values.ravel()[::-1]  # the last one that is written stays
    return first


def masked_scatter(rows, mask):
    """The transpose of the gather x[mask]: rows (N, ...) at the N places where mask (...) is true,
    0 elsewhere.

    >>> masked_scatter(np.array([5.0, 7.0]), np.array([True, False, True]))
    array([5., 0., 7.])
    """
    values = np.zeros((*mask.shape, *rows.shape[1:]))
    values[mask] = rows
    return values


def largest(rows):
    """The largest number of each row: rows (..., 3) -> (...), as rows.max(-1), but much faster.

    >>> largest(np.array([[1.0, 3.0, 2.0], [-1.0, -3.0, -2.0]]))
    array([ 3., -1.])
    """
    return np.maximum(np.maximum(rows[..., 0], rows[..., 1]), rows[..., 2])


def write_rows(array, rows, columns):
    """array[rows] = columns.T, for array (P, K), rows (N,), columns (K, N), in half the time."""
    for destination, column in zip(array.T, columns, strict=True):
        destination[rows] = column


def expand(start, count):
    """Ranges, one after the other: range r counts from start[r], and has count[r] elements.

    start, count (R,) -> owner, number (N,): the range of each element, and the element.

    >>> expand(np.array([7, 0, 4]), np.array([2, 0, 3]))
    (array([0, 0, 2, 2, 2]), array([7, 8, 4, 5, 6]))
    """
    owner = np.repeat(np.arange(len(count)), count)
    return owner, np.arange(len(owner)) + (start - (np.cumsum(count) - count)).take(owner)


def in_chunks(items):
    """The items, at most ROWS of them at a time."""
    for start in range(0, len(items), ROWS):
        yield items[start:start + ROWS]


def chunks(count):
    """Slices of count, each with a sum of at most CHUNK, or of one element that is larger.

    >>> count = np.array([CHUNK - 1, 1, 1])
    >>> [count[part].tolist() for part in chunks(count)]
    [[32767, 1], [1]]
    """
    total = np.cumsum(count, dtype=np.int64)
    start = 0
    while start < len(count):
        done = total[start - 1] if start else 0
        end = max(start + 1, np.searchsorted(total, done + CHUNK, "right"))
        yield slice(start, end)
        start = end
