"""Mistakes of lab 10; each docstring goes on after "this is what comes out when"."""


def edge_lines(a, b, height):
    """the first row is not counted from centres: pixel j's centre is at j + 1/2"""
    low, high = min(a[1], b[1]), max(a[1], b[1])
    row = np.arange(max(np.ceil(low), 0), min(np.floor(high + 0.5), height)).astype(int)
    if a[1] == b[1]:
        row = row[:0]
    toward_b = (row + 0.5 - a[1]) / (b[1] - a[1])
    return row, a[0] + toward_b * (b[0] - a[0]), np.stack([1 - toward_b, toward_b], -1)


def edge_lines(a, b, height):
    """an edge that goes down crosses nothing"""
    low, high = a[1], b[1]
    row = np.arange(max(np.ceil(low - 0.5), 0), min(np.floor(high + 0.5), height)).astype(int)
    if a[1] == b[1]:
        row = row[:0]
    toward_b = (row + 0.5 - a[1]) / (b[1] - a[1])
    return row, a[0] + toward_b * (b[0] - a[0]), np.stack([1 - toward_b, toward_b], -1)


def edge_lines(a, b, height):
    """the shares of a and b are swapped"""
    low, high = min(a[1], b[1]), max(a[1], b[1])
    row = np.arange(max(np.ceil(low - 0.5), 0), min(np.floor(high + 0.5), height)).astype(int)
    if a[1] == b[1]:
        row = row[:0]
    toward_b = (row + 0.5 - a[1]) / (b[1] - a[1])
    return row, a[0] + toward_b * (b[0] - a[0]), np.stack([toward_b, 1 - toward_b], -1)


def pull_on_edge(grad_colour, colour, beyond, way, share, eps):
    """the sign is wrong: descent goes away from the pixel that pulls"""
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))
    return np.array([(pull / (way / s + eps)).sum() if s > 0 else 0.0 for s in share])


def pull_on_edge(grad_colour, colour, beyond, way, share, eps):
    """max(0, ...) is missing: a change that raises the loss counts, too"""
    pull = ((colour - beyond) * grad_colour).sum(1)
    return np.array([-(pull / (way / s + eps)).sum() if s > 0 else 0.0 for s in share])


def pull_on_edge(grad_colour, colour, beyond, way, share, eps):
    """the way is multiplied by the share; an end of a small share must go farther"""
    pull = np.maximum(0, ((colour - beyond) * grad_colour).sum(1))
    return np.array([-(pull / (way * s + eps)).sum() if s > 0 else 0.0 for s in share])
