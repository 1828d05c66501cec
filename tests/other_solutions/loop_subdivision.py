"""Loop once more: dictionaries and loops over vertices, edges and faces."""
import numpy as np

from .subdivision import incidence, rings, sides


def loop_faces(faces, corner_edge, vertex_count):
    children = []
    for f, (a, b, c) in enumerate(faces):
        ab, bc, ca = (vertex_count + corner_edge[3 * f + k] for k in range(3))
        children += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.array(children)


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
    number = {edge: len(vertices) + e for e, edge in enumerate(at_edge)}
    children = []
    for a, b, c in faces:
        ab, bc, ca = (number[side] for side in sides([a, b, c]))
        children += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.array(points), np.array(children)


def loop_rows(faces, edges, corner_edge, u):
    """The slow step of each unit mesh is a column."""
    rows, columns = np.indices((len(u) + len(edges), len(u))).reshape(2, -1)
    return rows, columns, loop_slow(np.eye(len(u)), faces, u)[0].ravel()


def loop_surface_backward(grad_surface, faces, vertex_count, steps):
    """By one step, on the whole surface of each unit cage, and the rest by itself."""
    at_edge = incidence(np.asarray(faces).tolist())
    ring, border = rings(at_edge)
    n = np.array([len(ring[v]) for v in range(vertex_count)])
    u = np.where(n == 3, 3 / 16, 3 / (8 * np.maximum(n, 1)))
    if steps:
        points, children = loop_slow(np.eye(vertex_count), faces, u)
        return points.T @ loop_surface_backward(grad_surface, children, len(points), steps - 1)
    limit = np.eye(vertex_count)
    for v in ring:
        near, m = (border[v], 1 / 6) if v in border else (ring[v], 8 * u[v] / (8 * n[v] * u[v] + 3))
        limit[v, v], limit[v, near] = 1 - m * len(near), m
    return limit.T @ grad_surface
