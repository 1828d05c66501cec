"""Catmull-Clark once more: dictionaries and loops over vertices, edges and faces."""
from collections import defaultdict

import numpy as np

from .subdivision import as_entries, face_lists, incidence, rings, vertex_rows


def catmull_clark_slow(vertices, corners, counts):
    faces = list(face_lists(corners, counts))
    centres = np.array([vertices[face].mean(0) for face in faces])
    at_edge = incidence(faces)
    ring, border = rings(at_edge)
    points = []
    for v, x in enumerate(vertices):
        n = len(ring[v])
        if v in border:
            points.append((6 * x + vertices[border[v]].sum(0)) / 8)
        elif n:
            around = [f for f, face in enumerate(faces) if v in face]
            middles = [(x + vertices[other]) / 2 for other in ring[v]]
            points.append((centres[around].mean(0) + 2 * np.mean(middles, 0) + (n - 3) * x) / n)
        else:
            points.append(x)
    for ends, at in at_edge.items():
        parts = [*vertices[list(ends)], *centres[at]] if len(at) == 2 else vertices[list(ends)]
        points.append(np.mean(parts, 0))
    return np.concatenate([points, centres])


def catmull_clark_edge_rows(edges, corner_edge, counts, vertex_count):
    owner = [f for f, count in enumerate(counts) for _ in range(count)]
    at_edge = defaultdict(list)
    for edge, f in zip(corner_edge, owner, strict=True):
        at_edge[edge].append(vertex_count + f)
    entries = []
    for e, ends in enumerate(edges):
        parts = [*ends, *at_edge[e]] if len(at_edge[e]) == 2 else [*ends]
        entries += [(e, part, 1 / len(parts)) for part in parts]
    return as_entries(entries)


def catmull_clark_vertex_rows(edges, is_boundary, corners, counts, n):
    weights = [0.0 if valence == 0 else 1 / valence**2 for valence in n]
    rows, columns, weight = vertex_rows(edges, is_boundary, weights, 1 / 8)
    at_border = set(np.asarray(edges)[is_boundary].ravel().tolist())
    entries = list(zip(rows, columns, weight, strict=True))
    for f, face in enumerate(face_lists(corners, counts)):
        for v in set(face) - at_border:
            entries += [(v, len(n) + f, weights[v]), (v, v, -weights[v])]
    return as_entries(entries)


def catmull_clark_faces(corners, counts, corner_edge, vertex_count):
    edge_count, quads, first = max(corner_edge) + 1, [], 0
    for f, face in enumerate(face_lists(corners, counts)):
        points = [vertex_count + corner_edge[first + k] for k in range(len(face))]
        quads += [(v, points[k], vertex_count + edge_count + f, points[k - 1])
                  for k, v in enumerate(face)]
        first += len(face)
    return np.array(quads)


def catmull_clark_limit_rows(edges, is_boundary, quads, n):
    at_border = set(np.asarray(edges)[is_boundary].ravel().tolist())
    entries = [(v, v, 2 / 3 if v in at_border else valence / (valence + 5) if valence else 1)
               for v, valence in enumerate(n)]
    for (a, b), outer in zip(np.asarray(edges).tolist(), is_boundary, strict=True):
        for v, other in ((a, b), (b, a)):
            if outer:
                entries.append((v, other, 1 / 6))
            elif v not in at_border:
                entries.append((v, other, 4 / (n[v] * (n[v] + 5))))
    for quad in np.asarray(quads).tolist():
        entries += [(v, quad[k - 2], 1 / (n[v] * (n[v] + 5)))
                    for k, v in enumerate(quad) if v not in at_border]
    return as_entries(entries)
