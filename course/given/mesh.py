"""Triangle meshes as two plain arrays: simple shapes, normals and edges.

vertices (V, 3) float64   positions, one row per vertex
faces    (F, 3) np.intp   three vertex indices from 0, counter-clockwise seen from outside

Functions that make a mesh return the tuple `vertices, faces`. Functions that measure one expect
what `inputs.require_mesh` accepts.
"""
import math
import re
from pathlib import Path

import numpy as np

DATA = Path(__file__).parent / "data"

# The given meshes


def bunny():
    """The Stanford bunny: 3674 faces, closed, y up, looking along -x. -> vertices, faces"""
    return _read("bunny.ply")


def teapot():
    """The Utah teapot: 992 faces in 32 open patches, y up, spout along +x. -> vertices, faces"""
    return _read("teapot.ply")


def _read(name):
    """A PLY file as trimesh writes it: binary, of float32 and triangles. -> vertices, faces"""
    header, _, rows = (DATA / name).read_bytes().partition(b"end_header\n")
    vertex_count, face_count = map(int, re.findall(rb"element \w+ (\d+)", header))
    vertices = np.frombuffer(rows, "<f4", 3 * vertex_count).reshape(-1, 3)
    row = [("length", "u1"), ("corners", "<i4", 3)]
    faces = np.frombuffer(rows, row, face_count, offset=vertices.nbytes)
    return vertices.astype(np.float64), faces["corners"].astype(np.intp)


# Shapes


def cube(face_count):
    """The closed surface of [-1, 1]^3. -> vertices, faces

    12 n^2 faces, the fewest that are at least face_count. ValueError if face_count < 1.
    """
    n = _steps(face_count, 12)
    x, y, side = _lattice(n, n)
    # In integers from -n to n: the side at z = n, the same turned to z = -n, and both again
    # with the axes cycled once and twice.
    front = np.stack([2 * x - n, 2 * y - n, np.full_like(x, n)], axis=1)
    back = front * [-1, 1, -1]
    sides = [np.roll(points, k, axis=1) for points in (front, back) for k in range(3)]
    faces = np.concatenate([side + k * len(front) for k in range(6)])
    vertices, faces = merge(np.concatenate(sides), faces)
    return vertices / n, faces


def icosphere(face_count):
    """The unit sphere, closed: an icosahedron's faces cut into n^2 and pushed out.
    -> vertices, faces

    20 n^2 faces, the fewest that are at least face_count. ValueError if face_count < 1.
    """
    n = _steps(face_count, 20)
    corners, triangles = _icosahedron()
    i, j, small = _triangle_lattice(n)
    # A lattice point is a sum of corners with whole weights: the same 12 numbers on both sides of
    # a shared edge, so that equal points merge exactly.
    weights = np.zeros((20, len(i), 12), dtype=np.intp)
    for k, weight in enumerate((n - i - j, i, j)):
        weights[np.arange(20)[:, None], np.arange(len(i)), triangles[:, k, None]] = weight
    faces = np.concatenate([small + k * len(i) for k in range(20)])
    weights, faces = merge(weights.reshape(-1, 12), faces)
    vertices = weights @ corners
    return unit(vertices), faces


def torus(face_count, radius=1.0, tube=0.4):
    """A closed ring around the y axis: a circle of radius `tube` in n >= 3 steps, led around one
    of `radius` in 2 n. -> vertices, faces

    4 n^2 faces, the fewest that are at least face_count. ValueError if face_count < 1, and unless
    0 < tube < radius.
    """
    if not 0 < tube < radius < math.inf:
        raise ValueError(f"a torus needs 0 < tube < radius, got tube {tube} and radius {radius}")
    n = max(_steps(face_count, 4), 3)
    x, y, faces = _lattice(2 * n, n)
    faces = (y % n * 2 * n + x % (2 * n))[faces]  # the last column is the first, likewise rows
    y, x = np.divmod(np.arange(2 * n * n), 2 * n)
    around, across = x * (math.pi / n), y * (2 * math.pi / n)
    distance = radius + tube * np.cos(across)
    vertices = [distance * np.sin(around), tube * np.sin(across), distance * np.cos(around)]
    return np.stack(vertices, axis=1), faces


def plane(face_count):
    """The ground [-1, 1]^2 in x and z, facing +y. -> vertices, faces

    2 n^2 faces, the fewest that are at least face_count. ValueError if face_count < 1.
    """
    vertices, faces = grid(face_count)
    x, y, z = vertices.T
    n = x.max()
    return np.stack([2 * x / n - 1, z, 1 - 2 * y / n], axis=1), faces


def grid(face_count):
    """A square lattice in x and y, facing +z. -> vertices, faces

    The vertices have the integer coordinates 0 to n, which are the corners of n x n pixels. Shifted
    by 0.5 they lie on pixel centres. 2 n^2 faces, the fewest that are at least face_count.
    ValueError if face_count < 1.
    """
    n = _steps(face_count, 2)
    x, y, faces = _lattice(n, n)
    return np.stack([x, y, np.zeros_like(x)], axis=1).astype(np.float64), faces


def _steps(face_count, faces_per_square):
    """The smallest whole n with faces_per_square n^2 >= face_count."""
    if not 1 <= face_count < math.inf:
        raise ValueError(f"face_count must be at least 1, got {face_count}")
    return math.isqrt((math.ceil(face_count) - 1) // faces_per_square) + 1


def _lattice(columns, rows):
    """Points 0 <= x <= columns, 0 <= y <= rows, row by row, and each square as two faces."""
    y, x = np.divmod(np.arange((columns + 1) * (rows + 1)), columns + 1)
    corner = np.flatnonzero((x < columns) & (y < rows))[:, None]
    right, above = 1, columns + 1
    square = np.array([0, right, right + above, 0, right + above, above])
    return x, y, (corner + square).reshape(-1, 3)


def _triangle_lattice(n):
    """Points 0 <= i, j and i + j <= n of a triangle cut into n^2, and its faces."""
    i, j = np.divmod(np.arange((n + 1) ** 2), n + 1)
    inside = i + j <= n
    number = np.cumsum(inside) - 1
    next_i, next_j = n + 1, 1
    upright = np.flatnonzero(i + j < n)[:, None] + np.array([0, next_i, next_j])
    flipped = np.flatnonzero(i + j < n - 1)[:, None] + np.array([next_i, next_i + next_j, next_j])
    return i[inside], j[inside], number[np.concatenate([upright, flipped])]


def _icosahedron():
    """corners (12, 3) with edges of length 2, triangles (20, 3)."""
    g = (1 + math.sqrt(5)) / 2  # the golden ratio
    corners = np.array([[-1,  g,  0], [ 1,  g,  0], [-1, -g,  0], [ 1, -g,  0],
                        [ 0, -1,  g], [ 0,  1,  g], [ 0, -1, -g], [ 0,  1, -g],
                        [ g,  0, -1], [ g,  0,  1], [-g,  0, -1], [-g,  0,  1]])
    distance = np.linalg.norm(corners[:, None] - corners, axis=-1)
    near = np.abs(distance - 2) < 0.1
    triangles = np.argwhere(near[:, :, None] & near[:, None, :] & near)
    counterclockwise = np.linalg.det(corners[triangles]) > 0
    starts_lowest = triangles[:, 0] == triangles.min(axis=1)
    return corners, triangles[counterclockwise & starts_lowest]


def merge(points, faces):
    """Equal rows of points (N, C) become one. -> distinct points, faces"""
    points, index = np.unique(points, axis=0, return_inverse=True)
    return points, index.reshape(-1)[faces]


# Size


def normalize(vertices):
    """Moved and scaled alike in x, y and z: bounding box centred at 0, farthest vertex at 1.

    ValueError where all vertices are in one place, or there are none.
    """
    if len(vertices) == 0:
        raise ValueError("there are no vertices to scale: give at least two")
    centred = vertices - (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    farthest = np.linalg.norm(centred, axis=1).max()
    if farthest == 0:
        raise ValueError("all vertices are in one place: there is no size to scale to 1")
    return centred / farthest


# Normals


def face_normals(vertices, faces):
    """-> (F, 3) of unit length, to the side that sees the face counter-clockwise.

    Zero for a degenerate face.
    """
    return unit(area_vectors(vertices, faces))


def vertex_normals(vertices, faces):
    """-> (V, 3) of unit length: the mean over the faces at a vertex, weighted by their area.

    Zero for a vertex of no face.
    """
    corner = faces.ravel().astype(np.intp)  # in a browser, bincount takes no wider one
    columns = area_vectors(vertices, faces).repeat(3, 0).T  # each face's, at its three corners
    return unit(np.stack([np.bincount(corner, column, len(vertices)) for column in columns], -1))


def area_vectors(vertices, faces):
    """-> (F, 3) normals whose length is twice the face's area. A degenerate face has exactly 0."""
    a, b, c = vertices[faces.T]
    area = np.cross(b - a, c - a)
    # Three points on a line give a product of the size of its rounding, in any direction.
    rounding = 4 * np.finfo(np.float64).eps
    scale = length(b - a) * length(c - a)
    return area * (length(area) > rounding * scale)[:, None]


def unit(vectors):
    """Vectors (..., 3) divided by their length -> (..., 3). 0 stays 0."""
    divisor = length(vectors)[..., None]
    return vectors / np.where(divisor > 0, divisor, 1)


def length(vectors):
    """The lengths of vectors (..., 3) -> (...), in a third of the time of `np.linalg.norm`."""
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    return np.sqrt(x * x + y * y + z * z)


# Edges


def edges(faces):
    """-> edges (E, 2), face_edges (F, 3)

    An edge is a pair of vertices, low < high. Edges ascend. face_edges[f, k] is the number of the
    edge opposite to vertex k of face f. ValueError for a face that names a vertex twice.
    """
    faces = np.asarray(faces, dtype=np.intp)
    start, end = np.roll(faces, -1, axis=1), np.roll(faces, -2, axis=1)
    if (start == end).any():
        face = np.argmax((start == end).any(axis=1))
        raise ValueError(f"face {face} names a vertex twice ({faces[face].tolist()}): "
                         "leave such faces out before asking for edges")
    vertex_count = np.int64(faces.max(initial=0)) + 1
    key = np.minimum(start, end) * vertex_count + np.maximum(start, end)
    key, face_edges = np.unique(key, return_inverse=True)
    pairs = np.stack(np.divmod(key, vertex_count), axis=1).astype(np.intp)
    return pairs, face_edges.reshape(faces.shape)


def edge_faces(faces):
    """-> (E, 2) the faces at each edge of `edges(faces)`, the lower first, -1 for none.

    ValueError for an edge of more than two faces.
    """
    pairs, face_edges = edges(faces)
    count = np.bincount(face_edges.ravel(), minlength=len(pairs))
    if (count > 2).any():
        edge = np.argmax(count > 2)
        raise ValueError(f"the edge between vertices {pairs[edge, 0]} and {pairs[edge, 1]} has "
                         f"{count[edge]} faces: at most two may meet at an edge")
    by_edge = np.argsort(face_edges.ravel(), kind="stable") // 3
    first = np.cumsum(count) - count
    both = count == 2
    neighbours = np.full((len(pairs), 2), -1)
    neighbours[:, 0] = by_edge[first]
    neighbours[both, 1] = by_edge[first[both] + 1]
    return neighbours


def boundary_edges(faces):
    """-> (B, 2) the edges of one face only, as in `edges`."""
    pairs, face_edges = edges(faces)
    return pairs[np.bincount(face_edges.ravel(), minlength=len(pairs)) == 1]


def adjacency(faces, vertex_count):
    """-> sparse (V, V), symmetric: 1 where an edge joins two vertices, else 0."""
    import scipy.sparse  # so large that only who needs it loads it: in a browser it takes seconds

    low, high = edges(faces)[0].T
    rows, columns = np.concatenate([low, high]), np.concatenate([high, low])
    ones = np.ones(len(rows))
    return scipy.sparse.csr_array((ones, (rows, columns)), shape=(vertex_count, vertex_count))

# Finer


def split_longest(vertices, faces, face_count):
    """A mesh of at least face_count faces, at most one more. -> vertices, faces

    Again and again, edges that are the longest of all their faces are halved with these faces, the
    longest first. On the chord the new vertices would cost nothing, and chance would order them.
    """
    faces = np.asarray(faces, dtype=np.intp)
    while len(faces) < face_count:
        pairs, face_edges = edges(faces)
        length = np.linalg.norm(vertices[pairs[:, 0]] - vertices[pairs[:, 1]], axis=1)
        by_length = np.argsort(-length, kind="stable")
        rank = np.argsort(by_length)                    # 0 for the longest edge of all
        longest = face_edges[np.arange(len(faces)), rank[face_edges].argmin(1)]
        agreed = np.bincount(longest, minlength=len(pairs)) == np.bincount(face_edges.ravel())
        chosen = by_length[agreed[by_length]][:(face_count - len(faces) + 1) // 2]
        middle = np.full(len(pairs), -1)
        middle[chosen] = len(vertices) + np.arange(len(chosen))
        split = middle[longest] >= 0
        whole = faces[split]
        ends = pairs[longest[split]]
        m = middle[longest[split], None]
        vertices = np.concatenate([vertices, _rounded_middles(vertices, faces, pairs[chosen])])
        faces = np.concatenate([faces[~split], np.where(whole == ends[:, :1], m, whole),
                                np.where(whole == ends[:, 1:], m, whole)])
    return vertices, faces


def _rounded_middles(vertices, faces, pairs):
    """Middles of edges (N, 2), `pairs` of vertices, on a rounded surface: (N, 3).

    They are those of the cubic edges of Vlachos et al. 2001, "Curved PN triangles": the middle goes
    half as far as the two tangent planes at its ends are away from it, on average.
    """
    ends = vertices[pairs]
    n = vertex_normals(vertices, faces)[pairs]
    middles = ends.mean(1, keepdims=True)
    away = ((ends - middles) * n).sum(2, keepdims=True) * n
    return (middles + away.mean(1, keepdims=True) / 2)[:, 0]
