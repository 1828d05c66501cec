"""Catmull-Clark once more: dictionaries and loops over vertices, edges and faces."""

import numpy as np

from .subdivision import face_lists, incidence, rings, sides


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
    quads, number = [], {edge: len(vertices) + e for e, edge in enumerate(at_edge)}
    for f, face in enumerate(faces):
        ahead = [number[side] for side in sides(face)]
        quads += [(v, ahead[k], len(points) + f, ahead[k - 1]) for k, v in enumerate(face)]
    return np.concatenate([points, centres]), np.array(quads)
