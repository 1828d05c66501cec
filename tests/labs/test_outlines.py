"""What the exercises of lab 8 that find the pairs of a picture must do."""
import itertools

import numpy as np
from edges_in_space import AROUND, CORNERS, FIELDS, LEFT, as_pairs, begun, pairs_around, soup

from labkit.checks import assert_close, assert_equal, exercise

# --- which neighbours ----------------------------------------------------------------------------

def pairs_of(impl, picture):
    """owner, other of `neighbours`, sorted: face k is k tenths deep."""
    face_index = np.array(picture)
    owner, other = impl.neighbours(face_index, np.where(face_index < 0, np.inf, face_index / 10))
    order = np.lexsort((other, owner))
    return np.asarray(owner)[order], np.asarray(other)[order]


def assert_pixels(impl, picture, first, second):
    """neighbours finds these pairs of pixels, whichever is the owner."""
    owner, other = pairs_of(impl, picture)
    low, high = np.minimum(owner, other), np.maximum(owner, other)
    order = np.lexsort((high, low))
    assert_equal((low[order], high[order]), (first, second))


@exercise("8.6")
def test_neighbours_that_see_different_faces_are_pairs(impl):
    """Pairs with the background (-1, no face) are left out, pairs that see one face are not, or
    pixels above each other are. A pair comes twice, or pixels meet at a corner alone. Rows and
    columns are swapped."""
    assert_pixels(impl, [[-1, 3, 3], [-1, -1, 3]], [0, 1, 4], [1, 4, 5])
    assert_pixels(impl, [[2, 2], [2, 2]], [], [])


@exercise("8.6")
def test_a_pair_does_not_go_over_the_end_of_a_row(impl):
    """Pixels are compared in a row that goes through the whole picture. No picture shows such
    pairs: they are found, and hardly ever blended."""
    assert_pixels(impl, [[0, 0, 0, 1], [0, 0, 0, 1], [0, 0, 0, 1]], [2, 6, 10], [3, 7, 11])


@exercise("8.6")
def test_the_nearer_face_owns_the_edge(impl):
    """The deeper one is the owner, or always the left or lower one."""
    assert_equal(pairs_of(impl, [[-1, 1, 0], [2, 1, -1]]), ([1, 2, 2, 3, 4, 4], [0, 1, 5, 0, 3, 5]))


@exercise("8.6")
def test_neighbours_are_those_of_a_search(impl, rng):
    """Of the pairs to the right and above some are left out, or come twice."""
    face_index = rng.integers(-1, 4, (9, 7))
    depth = np.where(face_index < 0, np.inf, rng.permutation(63).reshape(9, 7) / 99)
    found = sorted((i * 7 + j, k * 7 + m) for (i, j), (k, m) in itertools.product(
        np.ndindex(9, 7), repeat=2) if abs(i - k) + abs(j - m) == 1
        and face_index[i, j] != face_index[k, m] and depth[i, j] < depth[k, m])
    owner, other = impl.neighbours(face_index, depth)
    order = np.lexsort((other, owner))
    assert_equal((owner[order], other[order]), tuple(np.array(found).T))


@exercise("8.6", fine_print=True)
def test_of_equally_deep_pixels_the_second_is_the_owner(impl):
    """<= in place of <: the left or lower one is. Or what is nearly as deep counts as equally
    deep."""
    depth = np.array([[0.5, 0.5], [0.5 - 1e-12, 0.5]])
    owner, other = impl.neighbours(np.array([[0, 1], [2, 2]]), depth)
    order = np.argsort(owner)
    assert_equal((owner[order], other[order]), ([1, 2, 3], [0, 0, 1]))


# --- the edge by which a line leaves a face ----------------------------------------------------

def leaving(impl, face):
    """`leave_faces` for the pairs AROUND, of two faces that both have CORNERS."""
    x, y = np.tile(CORNERS, (2, 1)).T
    pairs = impl.leave_faces(*AROUND, np.full(4, face), (x, y, np.linspace(0.5, 2, 6)),
                             np.arange(6).reshape(2, 3), 4)
    return as_pairs(impl, pairs)


@exercise("8.7")
def test_the_ends_of_an_edge_in_the_frame_of_its_pair(impl):
    """The other's centre is not at x = 1 where it lies to the left or below. Half a pixel is
    missing: the centre is not the corner. Rows and columns are swapped. y is mirrored with x, or x
    and y do not change places for pixels above each other."""
    pairs = leaving(impl, 0)
    assert_close((pairs.x, pairs.y), LEFT[2:])


@exercise("8.7")
def test_the_line_leaves_by_the_last_edge_that_it_crosses(impl):
    """The first edge that crosses counts, or the least c. Edge k is numbered from corner k to
    k + 1; it lies opposite to corner k. ends are corners 0 to 2, not vertices of the mesh."""
    pairs = leaving(impl, 1)
    assert_equal((pairs.edge, pairs.ends, pairs.face),
                 (LEFT[0], [[5, 4, 3, 4], [3, 5, 4, 5]], [1, 1, 1, 1]))
    assert_close(pairs.c, LEFT[1])


def assert_searched(impl, rng, w):
    scene = *pairs_around(rng, 60), rng.integers(0, 7, 60), *soup(rng, w), 7
    pairs, expected = as_pairs(impl, impl.leave_faces(*scene)), begun(*scene)
    crossed = np.isfinite(expected[2])  # what the others have, the fine print says
    for field in "c", "x", "y", "ends", "face", "edge":
        compared = assert_close if field in "cxy" else assert_equal
        compared(getattr(pairs, field)[..., crossed],
                 expected[FIELDS.index(field)][..., crossed], given=field)


@exercise("8.7")
def test_pairs_are_those_of_a_search(impl, rng):
    """Columns of different pairs are mixed up, or corners of the mesh with those of a face."""
    for _ in range(3):
        assert_searched(impl, rng, rng.uniform(0.5, 2, 15))


@exercise("8.7", fine_print=True)
def test_faces_that_reach_behind_the_camera_are_crossed_in_front_of_it(impl, rng):
    """w is not used: a corner behind the camera is mirrored. Or crossings behind it count."""
    assert_searched(impl, rng, rng.uniform(0.5, 2, 15) * rng.choice([1, 1, -1], 15))


@exercise("8.7", fine_print=True)
def test_a_face_that_no_edge_leaves_has_edge_0(impl):
    """A division by 0, an error, or a pair that is left out."""
    x, y = CORNERS.T
    one = np.array([6]), np.array([7]), np.array([0])
    pairs = as_pairs(impl, impl.leave_faces(*one, (x, y + 9, np.ones(3)), np.array([[0, 1, 2]]), 4))
    assert_equal((pairs.owner, pairs.edge, pairs.c), ([6], [0], [-np.inf]))


# --- which pairs are blended -------------------------------------------------------------------

def is_blended(impl, ends):
    """Whether pairs of pixels are blended: edges (4,) x0, y0, x1, y1 in their frames -> (N,)."""
    x0, y0, x1, y1 = np.array(ends, float).T
    x, y, n = np.stack([x0, x1]), np.stack([y0, y1]), np.arange(len(ends))
    c = x0 - y0 * (x1 - x0) / (y1 - y0)
    pairs = impl.Pairs(n + 1, n, c, np.stack([n, n + 1]), x, y, n, n % 3)
    return np.isin(n, as_pairs(impl, impl.steep_pairs(pairs)).other)


@exercise("8.8")
def test_an_edge_at_45_degrees_is_steep(impl):
    """> in place of >=, the two lengths are swapped, or none is looked at. Without abs, an edge
    that falls or leans to the left is judged by its sign."""
    leans = np.array([2.0, -2.0, 2 + 1e-9, -2 - 1e-9, 2 - 1e-9, 0.0, 9.0])
    for turned in 1, -1:
        ends = [(0.25 - x / 2, -turned, 0.25 + x / 2, turned) for x in leans]
        assert_equal(is_blended(impl, ends), [True, True, False, False, True, True, False])


@exercise("8.8")
def test_the_crossing_lies_between_the_centres_or_less_than_the_window_outside(impl):
    """Edges beyond the pair blend. >= in place of >. The WINDOW of 1/16 is left out, or another
    one, or on one side only, or it makes the range of c smaller and not larger."""
    c = [0.0, 0.7, 1.0, -0.2, 1.2, 7.0, -1 / 16, 1 + 1 / 16, -0.0624, 1.0624, -0.0626, 1.0626]
    expected = np.array([1, 1, 1, 0, 0, 0, 0, 0, 1, 1, 0, 0], bool)
    assert_equal(is_blended(impl, [(x, -1.0, x, 2.0) for x in c]), expected)


@exercise("8.8")
def test_blended_pairs_are_those_of_a_search(impl, rng):
    """One of the conditions is left out. Or fields of other pairs come back."""
    x, y = rng.uniform(-1, 2, (2, 60)), rng.uniform([[-2], [0]], [[0], [2]], (2, 60))
    c = x[0] - y[0] * (x[1] - x[0]) / (y[1] - y[0])
    fields = rng.permutation(60), rng.permutation(60), c, rng.integers(0, 9, (2, 60)), x, y
    pairs = impl.Pairs(*fields, rng.integers(0, 9, 60), rng.integers(0, 3, 60))
    kept = [n for n in range(60) if abs(x[1, n] - x[0, n]) <= abs(y[1, n] - y[0, n])
            and abs(c[n] - 0.5) < 9 / 16]
    for field, got, given in zip(FIELDS, impl.steep_pairs(pairs), pairs, strict=True):
        assert_equal(got, given[..., kept], given=field)


@exercise("8.8", fine_print=True)
def test_half_of_the_pairs_without_weight_are_dropped(impl):
    """Where alpha = 0, nvdiffrast keeps the pairs that their second pixel owns, and no others."""
    x, y, n = np.full((2, 2), 0.5), np.array([[-1.0, -1.0], [1.0, 1.0]]), np.arange(2)
    pairs = impl.Pairs(n, 1 - n, np.array([0.5, 0.5]), x.astype(int), x, y, n, n)
    assert_equal(as_pairs(impl, impl.steep_pairs(pairs)).owner, [1])
