"""Loop once more: dictionaries and loops over vertices, edges and faces."""
from collections import defaultdict

import numpy as np

from .subdivision import as_entries, incidence, rings, sides


def loop_slow(vertices, faces, u):
    faces = np.asarray(faces).tolist()
    at_edge = incidence(faces)
    ring, border = rings(at_edge)
    points = []
    for v, x in enumerate(vertices):
        if v in border:
            points.append(0.75 * x + 0.125 * vertices[border[v]].sum(0))
        elif v in ring:
            points.append(x + u[v] * (vertices[ring[v]] - x).sum(0))
        else:
            points.append(x)
    for (a, b), at in at_edge.items():
        middle = (vertices[a] + vertices[b]) / 2
        if len(at) == 2:
            centres = sum(vertices[faces[f]].mean(0) for f in at) / 2
            middle = 0.25 * middle + 0.75 * centres
        points.append(middle)
    return np.array(points)


def loop_edge_rows(faces, edges, corner_edge):
    at_edge = defaultdict(list)
    for corner, edge in enumerate(corner_edge):
        at_edge[edge].append(corner)
    entries = []
    for e, ends in enumerate(edges):
        thirds = [faces[corner // 3][(corner + 2) % 3] for corner in at_edge[e]]
        inside = len(thirds) == 2
        entries += [(e, v, 3 / 8 if inside else 1 / 2) for v in ends]
        entries += [(e, v, 1 / 8) for v in thirds if inside]
    return as_entries(entries)


def loop_faces(faces, corner_edge, vertex_count):
    children = []
    for f, (a, b, c) in enumerate(faces):
        ab, bc, ca = (vertex_count + corner_edge[3 * f + k] for k in range(3))
        children += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.array(children)


def limit_weight(n, u):
    return 8 * u / (8 * n * u + 3)


def loop_surface_backward(grad_surface, faces, vertex_count, steps):
    """By one step, on the whole surface of each unit cage, and the rest by itself."""
    at_edge = incidence(np.asarray(faces).tolist())
    ring, border = rings(at_edge)
    n = np.array([len(ring[v]) for v in range(vertex_count)])
    u = np.where(n == 3, 3 / 16, 3 / (8 * np.maximum(n, 1)))
    if steps:
        edges = list(at_edge)
        corner_edge = [edges.index(side) for face in np.asarray(faces).tolist()
                       for side in sides(face)]
        children = loop_faces(faces, np.array(corner_edge), vertex_count)
        grad = loop_surface_backward(grad_surface, children, vertex_count + len(edges), steps - 1)
        return loop_slow(np.eye(vertex_count), faces, u).T @ grad
    limit = np.eye(vertex_count)
    for v in ring:
        near, m = (border[v], 1 / 6) if v in border else (ring[v], limit_weight(n[v], u[v]))
        limit[v, v], limit[v, near] = 1 - m * len(near), m
    return limit.T @ grad_surface
