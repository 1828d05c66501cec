"""What the tests of lab 13 share: a graph, its Laplacian as a full matrix, and angles."""
import itertools

import numpy as np


def angle(corner, b, c):
    """The angle at a corner between two other points, by the law of cosines."""
    p, q, r = np.linalg.norm(b - corner), np.linalg.norm(c - corner), np.linalg.norm(b - c)
    return np.arccos((p**2 + q**2 - r**2) / (2 * p * q))


def graph(rng, vertex_count=7):
    """Edges (E, 2), each once, weights (E,); the last vertex alone has no edge."""
    pairs = np.array(list(itertools.combinations(range(vertex_count - 1), 2)))
    edges = pairs[:0]
    while len(np.unique(edges)) < vertex_count - 1:
        edges = rng.permutation(pairs)[:2 * vertex_count - 4]
    return edges, rng.uniform(0.5, 2.0, len(edges))


def dense(edges, weights, vertex_count):
    """Eq. (2) as a full matrix, edge by edge."""
    L = np.zeros((vertex_count, vertex_count))
    for (i, j), weight in zip(edges, weights, strict=True):
        L[[i, j], [i, j]] += weight
        L[[i, j], [j, i]] -= weight
    return L
