"""A heap for lab 12: the cheapest pair without looking at all of them, and `simplify` itself.

    v^T (Q_a + Q_b) v  >=  v^T Q_a v  for all v            quadrics only grow              (9)

So the least error of a pair never falls. A heap entry that is out of date comes to the top too
early, never too late. Its cost need not be computed again before it is there: a lazy update. If
(6) or (7) of simplification.py gave the position, a cost may fall, though seldom. Then the order
differs from that of `simplify_loop`.

An open surface is closed first: each boundary edge gets a face to one more vertex, `outside`. Then
the link condition protects holes and rims as well.

Sources: lecture "Geometry, advanced", Garland and Heckbert 1997.
"""
import heapq
import numbers
import warnings
from typing import NamedTuple

import numpy as np

from course.given import inputs, mesh

from .simplification import (
    REFUSALS,
    mesh_quadrics,
    pair_costs,
    valid_pairs,
    why_refused,
)


class Entry(NamedTuple):
    """A pair a, b on the heap, whose order is that of the costs.

    age is the pair's when the entry was made: the sum of its vertices' ages.
    """

    cost: float
    a: int
    b: int
    age: int
    position: list


class State(NamedTuple):
    """What changes in place from collapse to collapse."""

    vertices: np.ndarray  # (V, 3)
    quadrics: np.ndarray  # (V, 4, 4)
    became: list  # what each vertex has become, at first itself
    age: np.ndarray  # (V,) integers, at first 0
    rows: list  # the faces of the closed surface, [] for one that is gone
    rows_at: list  # for each vertex and `outside`, the set of its rows' numbers
    heap: list  # of Entries
    known: set  # (a, b, age) of the pairs that were brought up to date
    waiting: dict  # vertex -> the refused Entries there


def initial_state(vertices, faces, quadrics, pairs):
    """The state before the first collapse, with copies of vertices and quadrics."""
    rows, rows_at = incidence(close_boundary(faces, len(vertices)), len(vertices) + 1)
    state = State(vertices.copy(), quadrics.copy(), list(range(len(vertices))),
                  np.zeros(len(vertices), int), rows, rows_at, [], set(), {})
    state.heap.extend(entries(state, pairs))
    heapq.heapify(state.heap)
    return state


def close_boundary(faces, outside):
    """The faces, and after them one more for each boundary edge: from the edge to `outside`."""
    edges = mesh.boundary_edges(faces)
    return np.concatenate([faces, np.column_stack([edges, np.full(len(edges), outside)])])


def incidence(faces, vertex_count):
    """faces (F, 3) as lists, and for each vertex the set of its faces' numbers."""
    faces_at = [set() for _ in range(vertex_count)]
    for f, face in enumerate(faces.tolist()):
        for vertex in face:
            faces_at[vertex].add(f)
    return faces.tolist(), faces_at


def merge(state, a, b):
    """`collapse_faces` in rows and rows_at -> how many faces went, not counting those to outside.

    Two faces to outside that have become twins go, too: two boundaries are sewn together there.
    """
    rows, rows_at = state.rows, state.rows_at
    outside = len(state.vertices)
    gone = rows_at[a] & rows_at[b]
    count = sum(outside not in rows[f] for f in gone)
    for f in rows_at[b]:
        rows[f] = [a if vertex == b else vertex for vertex in rows[f]]
    rows_at[a] = rows_at[a] | rows_at[b]
    rows_at[b] = set()
    for f in gone | seam(state, rows_at[a] - gone):
        for vertex in rows[f]:
            rows_at[vertex].discard(f)
        rows[f] = []
    return count


def seam(state, numbers):
    """The numbers of those among these rows that go to outside and have a twin."""
    outside = len(state.vertices)
    sides = {f: set(state.rows[f]) for f in numbers if outside in state.rows[f]}
    return {f for f, side in sides.items() if list(sides.values()).count(side) == 2}


def entries(state, pairs):
    """The Entries of pairs (N, 2)."""
    a, b = pairs.T
    positions, costs = pair_costs(state.vertices, state.quadrics, pairs)
    columns = costs, a, b, state.age[a] + state.age[b], positions
    return [Entry(*row) for row in zip(*[column.tolist() for column in columns], strict=True)]


def root(became, vertex):
    """What a vertex has become in all collapses so far. This shortens the chain on the way."""
    while became[vertex] != vertex:
        became[vertex] = became[became[vertex]]
        vertex = became[vertex]
    return vertex


def out_of_date(state):
    """Take the out-of-date entries from the top of the heap -> pairs (N, 2) to make anew.

    An entry is out of date if one of its vertices has merged since it was made. It becomes the pair
    of what its vertices have become, once at each age (`known`).
    """
    pairs = []
    while state.heap:
        top = state.heap[0]
        a, b = sorted([root(state.became, top.a), root(state.became, top.b)])
        now = int(state.age[a] + state.age[b])
        if top.age == now:
            break
        heapq.heappop(state.heap)
        if a != b and (a, b, now) not in state.known:
            state.known.add((a, b, now))
            pairs.append((a, b))
    return np.array(pairs, int).reshape(-1, 2)


def put_back(state, around):
    """Put refused entries that wait at one of the vertices around back on the heap."""
    for vertex in around:
        for entry in state.waiting.pop(vertex, ()):
            for other in {entry.a, entry.b} & state.waiting.keys():
                state.waiting[other].remove(entry)
            heapq.heappush(state.heap, entry)


def rows_around(state, a, b):
    """The rows at a or b: (N, 3)."""
    return np.array([state.rows[f] for f in state.rows_at[a] | state.rows_at[b]])


def wait(state, entry):
    """Let a refused entry wait at both of its vertices, until `put_back`."""
    for vertex in entry.a, entry.b:
        state.waiting.setdefault(vertex, []).append(entry)


def collapse(state, entry):
    """Make one vertex, a, of an entry's pair a, b -> how many faces went, see `merge`."""
    a, b = entry.a, entry.b
    around = set(rows_around(state, a, b).ravel().tolist())
    count = merge(state, a, b)
    state.vertices[a] = entry.position
    state.quadrics[a] += state.quadrics[b]
    state.became[b] = a
    state.age[a] = entry.age + 1
    put_back(state, around)
    return count


def simplify_heap(vertices, faces, quadrics, pairs, face_count):  # exercise 12.13 (3 points)
    """`simplify_loop` by a heap -> vertices (V, 3), faces (F', 3), refused (3,).

    refused counts each reason. Begin with `initial_state`. While more than face_count faces are
    left: push new `entries` of the pairs that `out_of_date` returns, until it returns none. Pop the
    top, if any. `why_refused` asks about `rows_around`. Either count its reason and let the entry
    `wait`, or `collapse` it, which says how many faces went. End with `open_faces`.

    >>> vertices, faces = mesh.grid(32)
    >>> q, pairs = mesh_quadrics(vertices, faces), valid_pairs(vertices, faces, 0.0)
    >>> vertices, faces, refused = simplify_heap(vertices, faces, q, pairs, 2)
    >>> vertices[np.unique(faces)].round(9).astype(int).tolist()
    [[0, 0, 0], [4, 0, 0], [0, 4, 0], [4, 4, 0]]
    """
    raise NotImplementedError("exercise 12.13: simplify_heap")


def open_faces(state):
    """The rows that are left, except those to outside: (F, 3)."""
    outside = len(state.vertices)
    left = [row for row in state.rows if row and outside not in row]
    return np.array(left, int).reshape(-1, 3)


def plain_faces(faces):
    """The faces (F, 3) without repeated ones, and without those that name a vertex twice."""
    ascending = np.sort(faces, axis=1)
    first = np.unique(ascending, axis=0, return_index=True)[1]
    return faces[np.intersect1d(first, np.flatnonzero((np.diff(ascending) > 0).all(1)))]


def simplify(vertices, faces, face_count, t=0.0):
    """A mesh of at most face_count faces -> vertices (V', 3), faces (F', 3), refused (3,).

    Pairs nearer than t may become one as well, which closes cracks and joins parts. With t = 0, a
    manifold stays one, with its boundary and topology. If every pair that is left is refused, a
    warning says so, and the mesh has more faces. refused counts by REFUSALS.
    ValueError unless this is a mesh, and t and face_count are numbers of at least 0.
    """
    inputs.require_mesh(vertices, faces)
    faces = plain_faces(np.asarray(faces, int))
    if not all(isinstance(number, numbers.Real) and number >= 0 for number in (face_count, t)):
        raise ValueError("simplify needs face_count >= 0 and t >= 0, "
                         f"got face_count {face_count} and t {t}")
    if len(faces) == 0:
        raise ValueError("every face names a vertex twice: there is no surface to simplify")
    vertices, faces = without_unused(np.asarray(vertices, float), faces)
    # Near the origin and of size 1, the numbers of a quadric keep their digits.
    centre = vertices.mean(0)
    size = 2.0 ** np.frexp(np.abs(vertices - centre).max())[1]
    vertices = (vertices - centre) / size
    pairs = valid_pairs(vertices, faces, t / size)
    quadrics = mesh_quadrics(vertices, faces)
    vertices, faces, refused = simplify_heap(vertices, faces, quadrics, pairs, face_count)
    if len(faces) > face_count:
        counts = ", ".join(f"{n} for {reason}" for n, reason in zip(refused, REFUSALS, strict=True))
        warnings.warn(f"{len(faces)} faces are left, {face_count} were asked for: every other "
                      f"collapse would break the surface (refused: {counts})", stacklevel=2)
    vertices, faces = without_unused(vertices, faces)
    return vertices * size + centre, faces, refused


def without_unused(vertices, faces):
    """The mesh without unused vertices. The others keep their order."""
    used, faces = np.unique(faces, return_inverse=True)
    return vertices[used], faces.reshape(-1, 3)
