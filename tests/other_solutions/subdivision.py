"""Lab 11 once more: dictionaries and loops over vertices, edges and faces."""
import math
from collections import defaultdict

import numpy as np


def face_lists(corners, counts):
    corners, end = np.asarray(corners).tolist(), 0
    for count in np.asarray(counts).tolist():
        yield corners[end:end + count]
        end += count


def sides(face):
    """The edges of a face, each from low to high, in the order of its corners."""
    return [tuple(sorted(pair)) for pair in zip(face, face[1:] + face[:1], strict=True)]


def edges_of(corners, counts):
    along = [side for face in face_lists(corners, counts) for side in sides(face)]
    edges = sorted(set(along))
    number = {edge: e for e, edge in enumerate(edges)}
    return np.array(edges), np.array([number[side] for side in along])


def is_extraordinary(valence, at_boundary, regular):
    wanted = np.where(at_boundary, regular // 2 + 1, regular)
    return np.array([n not in (0, right) for n, right in zip(valence, wanted, strict=True)])


def euler_characteristic(corners, counts):
    edges = {side for face in face_lists(corners, counts) for side in sides(face)}
    return len({vertex for edge in edges for vertex in edge}) - len(edges) + len(counts)


def loop_weight(n):
    n = np.asarray(n, float)
    near = 0.375 + 0.25 * np.cos(2 * math.pi / n)
    return 0.625 / n - near * near / n


def incidence(faces):
    """{edge: its faces' numbers}, edges ascending."""
    at_edge = defaultdict(list)
    for f, face in enumerate(faces):
        for side in sides(face):
            at_edge[side].append(f)
    return dict(sorted(at_edge.items()))


def rings(at_edge):
    """{vertex: its neighbours}, and {vertex: those along boundary edges}."""
    ring, border = defaultdict(list), defaultdict(list)
    for (a, b), at in at_edge.items():
        for v, other in ((a, b), (b, a)):
            ring[v].append(other)
            if len(at) == 1:
                border[v].append(other)
    return ring, border


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


def pull_entries(rows, columns, u):
    entries = [entry for row, column, weight in zip(rows, columns, u, strict=True)
               for entry in ((row, row, -weight), (row, column, weight))]
    return as_entries(entries)


def as_entries(entries):
    rows, columns, weights = ([entry[k] for entry in entries] for k in range(3))
    return np.array(rows, int), np.array(columns, int), np.array(weights, float)


def vertex_rows(edges, is_boundary, u, beside):
    ring, border = defaultdict(list), defaultdict(list)
    for (a, b), outer in zip(np.asarray(edges).tolist(), is_boundary, strict=True):
        for v, other in ((a, b), (b, a)):
            (border if outer else ring)[v].append(other)
    entries = []
    for v in range(len(u)):
        near, share = (border[v], beside) if v in border else (ring.get(v, []), u[v])
        entries += [(v, v, 1 - len(near) * share), *((v, other, share) for other in near)]
    return as_entries(entries)


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


def limit_weight(n, u):
    return 8 * u / (8 * n * u + 3)


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
