"""Sorting."""


def merged(a, b):  # exercise 1.1 (2 points)
    """Two sorted arrays -> one."""
    both = [*a, *b]
    return sorted(both)


def merge_sort(x):  # exercise 1.2 (1 point)
    """An array -> it, sorted."""
    if len(x) < 2:
        return x
    return merged(merge_sort(x[::2]), merge_sort(x[1::2]))
