"""What the tests of lab 11 share: meshes, and slow ways to say who is near whom. And entries of a
matrix, as lab 13 has them, too.
"""
from pathlib import Path

import numpy as np
import pytest

from course.given import mesh
from labkit.checks import Mismatch, assert_equal, parts

# A hub of valence 5 inside, and one of 4 on the boundary; vertices 3 and 9 belong to no face.
FAN = np.array([[0, 1, 2], [0, 2, 4], [0, 4, 5], [0, 5, 6], [0, 6, 1], [7, 6, 5], [8, 6, 7]])
# A band with one twist: 10 triangles, one boundary, no way to wind all of them alike.
MOEBIUS = np.array([[k, (k + 1) % 10, (k + 2) % 10] for k in range(10)])
TETRAHEDRON = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [3, 2, 1]])

TRIANGLES = {  # name -> vertex count, faces
    "one triangle": (3, np.array([[2, 0, 1]])),
    "tetrahedron": (4, TETRAHEDRON),
    "fan, open": (10, FAN),
    "octahedron and fan": (16, np.concatenate([FAN[:, [1, 2, 0]], 10 + np.array(
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4],
         [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])])),
    "torus": (18, mesh.torus(36)[1]),
    "band with a twist": (10, MOEBIUS),
    "wound either way": (4, np.array([[0, 1, 2], [0, 3, 2], [0, 3, 1], [1, 2, 3]]))}
CUBE = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
CUBE_VERTICES = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
POLYGONS = {  # name -> vertex count, the faces
    "one pentagon": (6, [[4, 0, 3, 1, 5]]),
    "tetrahedron": (4, TETRAHEDRON.tolist()),
    "cube": (8, CUBE),
    "pyramid": (5, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1], [4, 3, 2, 1]]),
    "house": (10, [[0, 1, 2, 3], [3, 2, 6, 9, 7], [1, 0, 4, 8, 5], [2, 1, 5, 6], [0, 3, 7, 4],
                   [6, 5, 8], [6, 8, 9], [7, 9, 8, 4]]),
    "house, open": (12, [[0, 1, 2, 3], [3, 2, 4, 5, 6], [2, 1, 7], [7, 8, 4, 2], [6, 5, 10]]),
    "cube and pentagon": (15, [*CUBE, [14, 13, 12, 11, 9]])}
each_mesh = pytest.mark.parametrize("count, faces", TRIANGLES.values(), ids=TRIANGLES)
each_polygon_mesh = pytest.mark.parametrize("count, faces", POLYGONS.values(), ids=POLYGONS)


def flat(faces):
    """Lists of corners -> corners, counts."""
    return np.concatenate([np.array(face) for face in faces]), np.array([len(f) for f in faces])


def renumbered(rng, count, faces):
    """The same faces, with the vertices numbered at random; also if faces are lists."""
    number = rng.permutation(count)
    return number[faces] if isinstance(faces, np.ndarray) else [number[face] for face in faces]


def sides(face):
    """A face's edges, low < high, each from a corner to the next."""
    face = [int(v) for v in face]
    return [tuple(sorted(pair)) for pair in zip(face, face[1:] + face[:1], strict=True)]


def topology(faces):
    """edges (E, 2), corner_edge (C,), is_boundary (E,), by a dictionary."""
    every = [side for face in faces for side in sides(face)]
    number = {edge: k for k, edge in enumerate(sorted(set(every)))}
    return (np.array(list(number)), np.array([number[side] for side in every]),
            np.array([every.count(edge) == 1 for edge in number]))


def neighbours(v, edges):
    return [int(other) for other in edges[(edges == v).any(1)].sum(1) - v]


def valence_of(count, edges):
    return np.bincount(edges.ravel(), minlength=count)


def dense(entries, shape):
    """The matrix that entries (rows, columns, weights) add up to."""
    matrix = np.zeros(shape)
    rows, columns, weights = map(np.asarray, parts(entries, "rows", "columns", "weights"))
    if not rows.shape == columns.shape == weights.shape == (rows.size,):
        raise Mismatch(("wrong", "rows, columns and weights must be rows of numbers, equally long; "
                        f"got {rows.shape}, {columns.shape}, {weights.shape}"))
    if not {rows.dtype.kind, columns.dtype.kind} <= {*"iu"}:
        raise Mismatch(("wrong", "rows and columns must be integers; got "
                        f"{rows.dtype} and {columns.dtype}"))
    require_inside(rows, columns, shape)
    np.add.at(matrix, (rows, columns), weights)
    return matrix


def both(answer):
    """What a whole step returns."""
    return parts(answer, "the vertices", "the new faces")


def require_inside(rows, columns, shape):
    """Mismatch where an entry lies outside of the matrix."""
    height, width = shape
    outside = (rows < 0) | (rows >= height) | (columns < 0) | (columns >= width)
    if outside.any():
        k = outside.argmax()
        turned = not np.any((rows < 0) | (rows >= width) | (columns < 0) | (columns >= height))
        asked = ": are rows and columns exchanged?" if turned else ""
        raise Mismatch(("expected", f"entries of a matrix of {height} rows and {width} columns"),
                       ("got", f"an entry in row {rows[k]}, column {columns[k]}"),
                       ("differs", f"it lies outside{asked}"))


def old_vertices(count, edges, is_boundary, u, w):
    """Eq. (3) as a matrix (V, V), row by row."""
    matrix, boundary = np.eye(count), edges[is_boundary]
    for v in range(count):
        along = neighbours(v, boundary)
        for other in along or neighbours(v, edges):
            matrix[v, other] += w if along else u[v]
        matrix[v, v] = 2 - matrix[v].sum()
    return matrix


def published(name, *keys):
    """OpenSubdiv's arrays of a mesh, see tests/golden/README.md."""
    with np.load(Path(__file__).parents[1] / "golden" / "subdivision.npz") as arrays:
        return [arrays[f"{name}/{key}"] for key in keys]


def farthest(points, expected):
    """How far the farthest point of either set is from the other set; in any order."""
    assert_equal(np.shape(points), expected.shape)
    distance = np.linalg.norm(np.asarray(points)[:, None] - expected, axis=-1)
    return max(distance.min(0).max(), distance.min(1).max())
