"""What the tests of lab 12 share: meshes, and a slow greedy simplification."""
import itertools

import numpy as np

from course.given import mesh
from labkit.checks import assert_close, assert_equal

LEAST_CURVATURE, LEAST_COSINE, LEAST_SHAPE = 1e-6, 0.5**0.5, 0.01  # as in the module
TETRAHEDRON = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
# A double pyramid: 0 above, 4 below, and the ring 1 2 3, whose edges belong to no face inside.
DOUBLE = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [4, 2, 1], [4, 3, 2], [4, 1, 3]])


def planes_of(*rows):
    """The sum of the quadrics of planes, (1, 4, 4)."""
    return sum(np.outer(row, row) for row in np.array(rows, float))[None]


def corner_at(place):
    """The quadric of three planes that meet at right angles there, (1, 4, 4)."""
    return planes_of(*np.column_stack([np.eye(3), -place]))


def each_of(*groups):
    """The sum of the quadrics of each group of planes, (N, 4, 4)."""
    return np.concatenate([planes_of(*group) for group in groups])


def error(q, x):
    v = np.append(x, 1.0)
    return sum(v[i] * q[i, j] * v[j] for i in range(4) for j in range(4))


def quadrics_of(vertices, faces, weight=lambda a, b, c: 1):
    """Eq. (3), face by face, with a weight for each."""
    q = np.zeros((len(vertices), 4, 4))
    for face in faces:
        a, b, c = vertices[face]
        n = np.cross(b - a, c - a)
        n = n / np.linalg.norm(n)
        for vertex in face:
            q[vertex] += weight(a, b, c) * planes_of(np.append(n, -n @ a))[0]
    return q


def bumpy(face_count, rng, noise=0.05):
    """A closed mesh without symmetries: no two costs are equal."""
    vertices, faces = mesh.icosphere(face_count)
    return vertices + noise * rng.normal(size=vertices.shape), faces


def edges_of(faces):
    return np.array(sorted({tuple(sorted(pair)) for face in faces.tolist()
                            for pair in itertools.combinations(face, 2)}))


def normal_of(a, b, c):
    """(b - a) x (c - a): of two short vectors, np.cross takes ten times as long."""
    (x, y, z), (u, v, w) = b - a, c - a
    return np.array([y * w - z * v, z * u - x * w, x * v - y * u])


def shape(a, b, c):
    """Twice the area over the square of the longest edge."""
    longest = max((b - a) @ (b - a), (c - b) @ (c - b), (a - c) @ (a - c))
    return np.linalg.norm(normal_of(a, b, c)) / longest


def place_and_cost(q, a, b):
    """Eq. (5), or (6), or (7), for one pair."""
    A, offset, e = q[:3, :3], q[:3, 3], b - a
    spread = np.sort(np.linalg.eigvalsh(A))
    if spread[0] > LEAST_CURVATURE * spread[2]:
        x = -np.linalg.inv(A) @ offset
    elif e @ A @ e > LEAST_CURVATURE * np.trace(A) * (e @ e):
        x = a + np.clip(-e @ (A @ a + offset) / (e @ A @ e), 0, 1) * e
    else:
        x = min((a, b, (a + b) / 2), key=lambda x: error(q, x))
    return x, error(q, x)


def is_allowed(vertices, faces, a, b, x):
    return reason_of(vertices, faces, a, b, x) == 0


def reason_of(vertices, faces, a, b, x):
    """Of a closed surface, whose faces to vertex V have no place: 1 is no proper edge, 2 makes a
    face twice, 3 flips one, 0 does nothing of these.
    """
    faces = [face for face in faces if a in face or b in face]
    both = [face for face in faces if a in face and b in face]
    others = [face for face in faces if face not in both]
    shared = ({v for face in faces if a in face for v in face}
              & {v for face in faces if b in face for v in face}) - {a, b}
    if shared != {v for face in both for v in face} - {a, b}:
        return 1
    renamed = [{a if v == b else v for v in face} for face in others]
    if any(renamed.count(face) > 1 for face in renamed):
        return 2
    for face in others:
        if max(face) == len(vertices):
            continue
        p, q, r = vertices[face]
        p1, q1, r1 = (x if v in (a, b) else vertices[v] for v in face)
        n, n1 = normal_of(p, q, r), normal_of(p1, q1, r1)
        if n @ n1 < LEAST_COSINE * np.linalg.norm(n) * np.linalg.norm(n1) \
                or shape(p1, q1, r1) < LEAST_SHAPE * shape(p, q, r):
            return 3
    return 0


def greedy(vertices, faces, face_counts):
    """The whole algorithm, slowly: yields positions (V, 3) and faces (F', 3) at each face count."""
    vertices, quadrics, faces = vertices.copy(), quadrics_of(vertices, faces), faces.tolist()
    known = {}
    for face_count in face_counts:
        while face_count < len(faces):
            for a, b in map(tuple, edges_of(np.array(faces)).tolist()):
                if (a, b) not in known:
                    x, cost = place_and_cost(quadrics[a] + quadrics[b], vertices[a], vertices[b])
                    known[a, b] = cost, a, b, x
            asked = sorted(known.values(), key=lambda pair: pair[0])
            allowed = (pair for pair in asked if is_allowed(vertices, faces, *pair[1:]))
            _, a, b, x = next(allowed, [None] * 4)
            if x is None:
                break
            vertices[a], quadrics[a] = x, quadrics[a] + quadrics[b]
            faces = [[a if v == b else v for v in face] for face in faces if not {a, b} <= {*face}]
            known = {pair: cost for pair, cost in known.items() if not {a, b} & {*pair}}
        yield vertices.copy(), np.array(faces)


def euler(faces):
    return len(np.unique(faces)) - len(edges_of(faces)) + len(faces)


def rows(faces):
    """Faces (F, 3), in their order, each from its lowest vertex on."""
    return np.array([np.roll(face, -int(np.argmin(face))) for face in np.asarray(faces)])


def assert_left(left, before, expected, given):
    """These faces are left. If they are not, first of all: which vertices are gone?"""
    assert_equal(gone(before, left), gone(before, expected), given)
    assert_equal(rows(left), rows(expected), given)


def gone(before, after):
    """In words, which vertices the last collapse took."""
    return f"gone from the faces: {np.setdiff1d(before, after).tolist()}"


# --- what both ways to choose a pair must do: simplify(vertices, faces, face_count) -------------

def check_nothing_to_do(simplify, rng):
    vertices, faces = bumpy(20, rng)
    for face_count in 20, 21:
        assert_equal(simplify(vertices, faces, face_count), (vertices, faces))


def check_where_it_stops(simplify, rng):
    vertices, faces = bumpy(80, rng)
    counts = [80, 79, 78, 77, 74]
    left = np.array([len(simplify(vertices, faces, face_count)[1]) for face_count in counts])
    assert_equal(left, [80, 78, 78, 76, 74],
                 f"a ball of 80 faces, and face_count={counts}: how many faces are left of each?")


def check_one_collapse(simplify, rng):
    vertices, faces = bumpy(20, rng, 0.2)
    [(expected, left)] = greedy(vertices, faces, [19])
    got, got_left = simplify(vertices, faces, 19)
    assert_equal(rows(got_left), rows(left))
    assert_close(got, expected, atol=1e-9)


def check_all_collapses(simplify, rng):
    """They are those of the slow algorithm. The first collapse that differs is shown."""
    for noise in 0.05, 0.3:
        vertices, faces = bumpy(45, rng, noise)
        face_counts = range(len(faces), 3, -2)
        slow = dict(zip(face_counts, greedy(vertices, faces, face_counts), strict=True))
        fast = {n: simplify(vertices, faces, n) for n in (60, 34, 16, 4)}
        if any(not np.array_equal(rows(left), rows(slow[n][1])) for n, (_, left) in fast.items()):
            for face_count in face_counts:
                left, expected = simplify(vertices, faces, face_count)[1], slow[face_count][1]
                before = slow[min(face_count + 2, len(faces))][1]
                ball = (f"a ball of {len(faces)} faces, down to {face_count}; down to "
                        f"{face_count + 2} it was right")
                assert_left(left, before, expected, ball)
        for face_count, (got, left) in fast.items():
            used = np.unique(left)
            assert_close(got[used], slow[face_count][0][used], rtol=1e-6, atol=1e-6)


def check_a_tetrahedron_is_left(simplify, rng):
    left = simplify(*bumpy(20, rng), 0)[1]
    assert_equal((len(left), len(np.unique(left))), (4, 4))


def check_it_stays_closed(simplify, rng):
    for vertices, faces in mesh.torus(100), mesh.torus(36):
        vertices = vertices + 0.01 * rng.normal(size=vertices.shape)
        left = simplify(vertices, faces, 0)[1]
        assert_equal("none left" if len(left) == 0 else "some left", "some left")
        assert_equal("as many faces as before" if len(left) == len(faces) else "fewer", "fewer")
        assert_equal(euler(left), 0)
        faces_at_edge = np.bincount(mesh.edges(left)[1].ravel())
        assert_equal(faces_at_edge, np.full(len(faces_at_edge), 2))
        assert_equal(len({frozenset(face) for face in left.tolist()}), len(left))
