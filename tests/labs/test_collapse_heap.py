"""What the exercise of lab 12's heap must do."""
import functools
import itertools

import numpy as np
import simplification_meshes as meshes

from course.given import mesh
from labkit.checks import assert_equal, exercise


def heap(impl, vertices, faces, face_count):
    q, pairs = meshes.quadrics_of(vertices, faces), meshes.edges_of(faces)
    return impl.simplify_heap(vertices, faces, q, pairs, face_count)[:2]


@exercise("12.13")
def test_nothing_to_do(impl, rng):
    """One collapse too many, where there are just as many faces as asked for: >= instead of >."""
    meshes.check_nothing_to_do(functools.partial(heap, impl), rng)


@exercise("12.13")
def test_only_faces_inside_are_counted(impl, rng):
    """The faces to `outside`, which close a boundary, are counted at first (the length of
    state.rows), so there are too many collapses. Or they are left in the result: open_faces is not
    asked."""
    vertices, faces = mesh.grid(32)
    vertices = vertices + 0.1 * rng.normal(size=vertices.shape) * [0, 0, 1]
    for face_count in 32, 33:
        assert_equal(heap(impl, vertices, faces, face_count), (vertices, faces))


@exercise("12.13")
def test_it_stops_at_the_first_count_that_is_low_enough(impl, rng):
    """The faces that went are not counted, or each collapse counts as one face. It stops one
    collapse too early or too late."""
    meshes.check_where_it_stops(functools.partial(heap, impl), rng)


@exercise("12.13")
def test_one_collapse(impl, rng):
    """It is another pair than the cheapest. The upper vertex stays, or the lower one stays where it
    was."""
    meshes.check_one_collapse(functools.partial(heap, impl), rng)


@exercise("12.13")
def test_all_collapses_are_those_of_the_slow_heap(impl, rng):
    """An entry that is refused is thrown away; it must `wait`, to be put back and tried again. It
    ends the loop. Out-of-date entries are not made anew
    before each pop."""
    meshes.check_all_collapses(functools.partial(heap, impl), rng)


@exercise("12.13")
def test_a_surface_stays_closed_and_keeps_its_holes(impl, rng):
    """why_refused is not asked: a torus becomes a sphere, an edge gets four faces or one, or a face
    comes twice."""
    meshes.check_it_stays_closed(functools.partial(heap, impl), rng)


@exercise("12.13")
def test_it_ends_with_a_tetrahedron(impl, rng):
    """The number of faces cannot be reached, since all pairs are refused: an endless loop, or
    nothing is left."""
    meshes.check_a_tetrahedron_is_left(functools.partial(heap, impl), rng)


@exercise("12.13")
def test_refused_pairs_are_counted_by_their_reason(impl):
    """refused is indexed by the reason, which starts at 1, and not by reason - 1: counts are one
    place off. It is not counted, or counted again though nothing around the pair has changed."""
    vertices = np.array([[0.0, 0, 3], [1, 0, 0], [-1, 2, 0], [-1, -2, 0], [0, 0, -2]])
    ring, q = np.array([[1, 2], [1, 3], [2, 3]]), meshes.quadrics_of(vertices, meshes.DOUBLE)
    got = impl.simplify_heap(vertices, meshes.DOUBLE, q, ring, 0)
    assert_equal(got[1:], (meshes.DOUBLE, [3, 0, 0]))
    four, faces = vertices[:4], meshes.TETRAHEDRON
    q, pairs = meshes.quadrics_of(four, faces), meshes.edges_of(faces)
    assert_equal(impl.simplify_heap(four, faces, q, pairs, 0)[1:], (faces, [0, 6, 0]))
    far = meshes.corner_at(np.array([0, 0, -9.0]))
    got = impl.simplify_heap(vertices, meshes.DOUBLE, np.repeat(far, 5, 0), np.array([[0, 1]]), 0)
    assert_equal(got[1:], (meshes.DOUBLE, [0, 0, 1]))


@exercise("12.13")
def test_a_pair_that_is_refused_again_counts_again(impl, rng):
    """A pair is counted once only, though it went back to the heap and was refused again. Or all
    pairs go back, also far away."""
    vertices, faces = mesh.icosphere(80)
    vertices = vertices + 0.02 * rng.normal(size=vertices.shape)
    pairs, q = meshes.edges_of(faces), meshes.quadrics_of(vertices, faces)
    a, b = pairs[0]
    around = {*faces[((faces == a) | (faces == b)).any(1)].ravel().tolist()}
    near = next(pair for pair in pairs.tolist() if not {a, b} & {*pair} and around & {*pair})
    far = pairs[np.argmin((vertices[pairs] @ vertices[a]).max(1))]
    for pair in (a, b), far:  # they would like to be on the other side of the ball, far out
        q[list(pair)] = meshes.corner_at(-9 * vertices[pair[0]])
    asked = np.array(sorted([[a, b], near, far.tolist()]))
    _, left, refused = impl.simplify_heap(vertices, faces, q, asked, 0)
    assert_equal((len(left), refused), (78, [0, 0, 3]))


@exercise("12.13")
def test_a_refused_pair_has_its_turn_when_an_end_has_changed(impl, rng):
    """What was refused is thrown away and never comes back, not even where its own vertex has
    become another one."""
    vertices, faces = mesh.icosphere(320)
    vertices = vertices + 0.005 * rng.normal(size=vertices.shape)
    pairs, q = meshes.edges_of(faces), meshes.quadrics_of(vertices, faces)
    a, b = pairs[0].tolist()
    around = {*pairs[(pairs == a).any(1)].ravel().tolist()}
    c = next(v for pair in pairs.tolist() if b in pair for v in pair if v not in around)
    q[[a, b]] = meshes.corner_at(-9 * vertices[a])  # to be on the other side, at no cost,
    q[c] = 1e4 * meshes.corner_at(vertices[c])[0]   # and c to stay, at any cost
    asked = np.array(sorted([[a, b], sorted([b, c])]))
    _, left, refused = impl.simplify_heap(vertices, faces, q, asked, 0)
    assert_equal((len(left), refused), (316, [0, 0, 1]))


@exercise("12.13")
def test_an_open_surface_keeps_its_boundary(impl, rng):
    """Each collapse is counted as two faces, but at the boundary only one face goes: `collapse`
    returns how many. A flat disc loses a corner. An ear is torn off, a hole is sewn up, or the two
    sides of a ring touch."""
    vertices, faces = mesh.grid(72)
    hole = (np.abs(vertices[faces].mean(1)[:, :2] - 3) < 1).all(1)
    faces = faces[~hole]
    vertices = vertices + 0.1 * rng.normal(size=vertices.shape) * [0, 0, 1]
    boundary, edges = meshes.quadrics_of(vertices, faces), meshes.edges_of(faces)
    for a, b in edges:
        if ((faces == a) | (faces == b)).sum(1).tolist().count(2) == 1:
            n = np.array([vertices[b, 1] - vertices[a, 1], vertices[a, 0] - vertices[b, 0], 0])
            n /= np.linalg.norm(n)
            boundary[[a, b]] += 100 * meshes.planes_of(np.append(n, -n @ vertices[a]))[0]
    for face_count in 40, 0:
        place, left, _ = impl.simplify_heap(vertices, faces, boundary, edges, face_count)
        assert_equal("none left" if len(left) == 0 else "some left", "some left")
        assert_equal(meshes.euler(left), 0)                    # a disc with one hole
        sides = np.sort(left[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2))
        pairs, numbers = np.unique(sides, axis=0, return_counts=True)
        assert_equal(numbers.max(), 2)
        assert_equal("closed" if (numbers == 2).all() else "with a boundary", "with a boundary")
        ends = np.bincount(pairs[numbers == 1].ravel())
        assert_equal(np.unique(ends[ends > 0]), [2])    # two boundary edges at a boundary vertex
        if face_count:
            # A collapse takes two faces, at the boundary one: the last may take one too many.
            enough = face_count - 1 <= len(left) <= face_count
            assert_equal("40 or 39 faces" if enough else f"{len(left)} faces", "40 or 39 faces")
            corners = place[np.unique(left), :2]
            for corner in itertools.product((0, 6), (0, 6)):
                near = (np.abs(corners - corner).max(1) < 0.1).any()
                assert_equal(f"corner {corner} {'stays' if near else 'is lost'}",
                             f"corner {corner} stays")
