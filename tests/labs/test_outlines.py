"""What the exercises of lab 8 that find the pairs of a picture must do."""
import edges_in_space
import numpy as np
from edges_in_space import EDGES

from labkit.checks import Mismatch, assert_close, assert_equal, exercise

FIELDS = "owner", "other", "c", "ends", "x", "y", "face", "edge"


def by_pixel(impl, returned):
    """The Pairs that a function returned, sorted by owner and other. Mismatch: they are none."""
    is_one = isinstance(returned, tuple)
    sizes = [np.shape(field)[-1:] for field in returned] if is_one else []
    if len(sizes) != len(FIELDS) or len(set(sizes)) != 1:
        raise Mismatch(("wrong", f"it must return Pairs: {', '.join(FIELDS)}, with a number or a "
                                 "column for each pair"))
    order = np.lexsort((returned[1], returned[0]))
    return impl.Pairs(*(np.asarray(field)[..., order] for field in returned))


def jumping(impl, *scene):
    return by_pixel(impl, impl.jumping_pairs(*scene))


def blended(impl, *scene):
    return by_pixel(impl, impl.blended_pairs(*scene))


# --- which neighbours, and where they look -----------------------------------------------------

CORNERS = np.array([[3.25, 0.5], [3.0, 2.75], [1.0, 1.25]])  # around (2.5, 1.5)


def seen(picture):
    """What `jumping_pairs` takes: face k is k tenths deep, each has CORNERS of its own, and all are
    outlined."""
    face_index = np.array(picture)
    count = face_index.max() + 1
    x, y = np.tile(CORNERS, (count, 1)).T
    return (face_index, np.where(face_index < 0, np.inf, face_index / 10),
            (x, y, np.linspace(0.5, 2, 3 * count)), np.arange(3 * count).reshape(-1, 3),
            np.ones(count, bool))


def assert_pixels(impl, picture, first, second):
    """jumping_pairs finds these pairs of pixels, whichever is the owner."""
    pairs = jumping(impl, *seen(picture))
    low, high = np.minimum(pairs.owner, pairs.other), np.maximum(pairs.owner, pairs.other)
    order = np.lexsort((high, low))
    assert_equal((low[order], high[order]), (first, second))


@exercise("8.10")
def test_neighbours_that_see_different_faces_are_pairs(impl):
    """Pairs with the background (-1, no face) are left out, pairs that see one face are not, or
    pixels above each other are. Rows and columns are swapped."""
    assert_pixels(impl, [[-1, 3, 3], [-1, -1, 3]], [0, 1, 4], [1, 4, 5])
    assert_pixels(impl, [[2, 2], [2, 2]], [], [])


@exercise("8.10")
def test_a_pair_does_not_go_over_the_end_of_a_row(impl):
    """Pixels are compared in a row that goes through the whole picture. No picture shows such
    pairs: they are found, and hardly ever blended."""
    assert_pixels(impl, [[0, 0, 0, 1], [0, 0, 0, 1], [0, 0, 0, 1]], [2, 6, 10], [3, 7, 11])


@exercise("8.10")
def test_the_nearer_face_owns_the_edge(impl):
    """The deeper one is the owner, or always the left or lower one. Or face is the other's."""
    pairs = jumping(impl, *seen([[-1, 1, 0], [2, 1, -1]]))
    assert_equal((pairs.owner, pairs.other, pairs.face),
                 ([1, 2, 2, 3, 4, 4], [0, 1, 5, 0, 3, 5], [1, 0, 0, 2, 1, 1]))


@exercise("8.10")
def test_the_owner_s_face_must_be_outlined(impl):
    """outlined is not looked at, or that of the other pixel's face is, or both must be."""
    for picture in [[0, 1, 2, 3, 4]], [[0], [1], [2], [3], [4]]:
        *scene, _ = seen(picture)
        pairs = jumping(impl, *scene, np.array([True, False, False, True, True]))
        assert_equal((pairs.owner, pairs.other), ([0, 3], [1, 4]))


# Its pairs run to below, left, right and above.
ALONE = [[-1, -1, -1, -1], [-1, -1, 0, -1], [-1, -1, -1, -1]]


@exercise("8.10")
def test_the_ends_of_an_edge_in_the_frame_of_its_pair(impl):
    """The other's centre is not at x = 1 where it lies to the left or below. Half a pixel is
    missing: the centre is not the corner. Rows and columns are swapped. y is mirrored with x, or x
    and y do not change places for pixels above each other."""
    pairs = jumping(impl, *seen(ALONE))
    assert_close((pairs.x, pairs.y), ([[0.25, -0.5, 0.75, 1.25], [1.0, 1.5, 0.5, -0.25]],
                                      [[-1.5, 1.25, -1.0, 0.5], [0.75, -0.25, 1.25, -1.5]]))


@exercise("8.10")
def test_the_line_leaves_by_the_last_edge_that_it_crosses(impl):
    """The first edge that crosses counts, or the least c. Edge k is numbered from corner k to
    k + 1; it lies opposite to corner k. ends are corners 0 to 2, not vertices of the mesh."""
    pairs = jumping(impl, *seen(2 * np.array(ALONE) + 1))  # face 1 in the place of 0
    assert_equal((pairs.edge, pairs.ends), ([1, 0, 2, 0], [[5, 4, 3, 4], [3, 5, 4, 5]]))
    assert_close(pairs.c, [0.75, 7 / 6, 23 / 36, 0.875])


def by_search(face_index, depth, screen, faces, outlined):
    """jumping_pairs pair by pair, in space: corners (along, across, 1) times w."""
    x, y, w = screen
    height, width = face_index.shape
    found = []
    for i, j in np.ndindex(height, width):
        for right, up in (1, 0), (-1, 0), (0, 1), (0, -1):
            k, m = i + up, j + right
            face = face_index[i, j]
            is_pair = 0 <= k < height and 0 <= m < width and face != face_index[k, m]
            if not is_pair or depth[i, j] >= depth[k, m] or not outlined[face]:
                continue
            points = np.stack([x, y], -1)[faces[face]] - [j + 0.5, i + 0.5]
            points = np.column_stack([points @ [right, up], points @ [abs(up), abs(right)]])
            corners = w[faces[face], None] * np.insert(points, 2, 1, 1)
            edge, c = edges_in_space.last_crossing(corners)
            ends = list(EDGES[edge])
            found.append((i * width + j, k * width + m, c, faces[face, ends],
                          points[ends, 0], points[ends, 1], face, edge))
    return [np.array(field).T for field in zip(*sorted(found, key=lambda one: one[:2]),
                                                 strict=True)]


def soup(rng, w):
    """What `jumping_pairs` takes: 7 faces of random corners, seen in random pixels."""
    face_index = rng.integers(-1, 7, (9, 7))
    depth = np.where(face_index < 0, np.inf, rng.permutation(63).reshape(9, 7) / 99)
    x, y = rng.uniform(-2, [[9], [11]], (2, 15))
    return face_index, depth, (x, y, w), rng.permuted(np.tile(np.arange(15), (7, 1)), axis=1)[:, :3]


def assert_searched(impl, *scene):
    pairs, expected = jumping(impl, *scene), by_search(*scene)
    assert_equal(pairs[:2], expected[:2])
    crossed = np.isfinite(expected[2])  # what the others have, the fine print says
    for field in "c", "x", "y", "ends", "face", "edge":
        compared = assert_close if field in "cxy" else assert_equal
        compared(getattr(pairs, field)[..., crossed],
                 expected[FIELDS.index(field)][..., crossed], given=field)


@exercise("8.10")
def test_pairs_are_those_of_a_search(impl, rng):
    """Columns of different pairs are mixed up, or corners of the mesh with those of a face."""
    for _ in range(3):
        scene = soup(rng, rng.uniform(0.5, 2, 15))
        assert_searched(impl, *scene, rng.random(7) < 0.7)


@exercise("8.10", fine_print=True)
def test_of_equally_deep_pixels_the_second_is_the_owner(impl):
    """<= for <: the left or lower one is. Or what is nearly as deep counts as equally deep."""
    face_index, _, *rest = seen([[0, 1], [2, 2]])
    depth = np.array([[0.5, 0.5], [0.5 - 1e-12, 0.5]])
    pairs = jumping(impl, face_index, depth, *rest)
    assert_equal((pairs.owner, pairs.other), ([1, 2, 3], [0, 0, 1]))


@exercise("8.10", fine_print=True)
def test_faces_that_reach_behind_the_camera_are_crossed_in_front_of_it(impl, rng):
    """w is not used: a corner behind the camera is mirrored. Or crossings behind it count."""
    scene = soup(rng, rng.uniform(0.5, 2, 15) * rng.choice([1, 1, -1], 15))
    assert_searched(impl, *scene, np.ones(7, bool))


@exercise("8.10", fine_print=True)
def test_a_face_that_no_edge_leaves_has_edge_0(impl):
    """A division by 0, an error, or a pair that is left out."""
    face_index, depth, (x, y, w), *rest = seen([[0, -1]])
    pairs = jumping(impl, face_index, depth, (x, y + 9, w), *rest)
    assert_equal((pairs.owner, pairs.edge, pairs.c), ([0], [0], [-np.inf]))


# --- which pairs are blended -------------------------------------------------------------------

NONE = np.full((1, 3), -1)


def is_blended(impl, ends, opposite=NONE):
    """Whether two pixels are blended: edges (4,) x0, y0, x1, y1 in the frame of the first, which
    sees the face to the left of it -> bool (N,)."""
    found = []
    for x0, y0, x1, y1 in ends:
        clip = np.zeros((4, 4)) + [-0.5, 0, 0, 1]  # pixel 0 is at (-0.5, 0), pixel 1 at (0.5, 0)
        clip[:, 0] += [x0, x1, -9.0, 9.0]
        clip[:2, 1] = 2 * y0, 2 * y1
        pairs = blended(impl, np.array([[0, -1]]), np.array([[0.5, np.inf]]), clip,
                        np.array([[2, 0, 1]]), opposite)
        found.append(len(pairs.owner) == 1)
    return np.array(found)


@exercise("8.12")
def test_a_bar_is_blended_along_its_edge(impl):
    """Nothing is blended, or each pair of one face. Fields of other pairs come back."""
    clip = np.array([[-0.125, -9.0, 0.0, 1.0], [-0.125, 9.0, 0.0, 1.0], [-9.0, 0.0, 0.0, 1.0]])
    face_index = np.tile([0, 0, -1, -1], (3, 1))
    pairs = blended(impl, face_index, np.where(face_index < 0, np.inf, 0.0), clip,
                    np.array([[0, 1, 2]]), NONE)
    assert_close(pairs[:3], ([1, 5, 9], [2, 6, 10], [0.25, 0.25, 0.25]))
    assert_equal((np.sort(pairs.ends, 0), *pairs[6:]), ([[0, 0, 0], [1, 1, 1]], [0] * 3, [2] * 3))


@exercise("8.12")
def test_only_a_silhouette_is_blended(impl):
    """Inner edges blend, which are no silhouette. Or it is asked whether the face has a silhouette
    anywhere, and not whether the edge that is crossed is one."""
    edge = [(0.4, -1.0, 0.3, 2.0)]
    for across, expected in ([-1, -1, -1], True), ([3, -1, -1], False), ([2, -1, -1], True), \
            ([3, 3, 3], False), ([-1, 0, 1], True):
        assert_equal(is_blended(impl, edge, np.array([across])), [expected], given=f"{across}")


@exercise("8.12")
def test_an_edge_at_45_degrees_is_steep(impl):
    """> for >=, the two lengths are swapped, or none is looked at. Without abs, an edge that falls
    or leans to the left is judged by its sign."""
    leans = np.array([2.0, -2.0, 2 + 1e-9, -2 - 1e-9, 2 - 1e-9, 0.0, 9.0])
    for turned in 1, -1:
        ends = [(0.25 - x / 2, -turned, 0.25 + x / 2, turned) for x in leans]
        assert_equal(is_blended(impl, ends), [True, True, False, False, True, True, False])


@exercise("8.12")
def test_the_crossing_lies_between_the_centres_or_less_than_the_window_outside(impl):
    """Edges beyond the pair blend. >= for >. The WINDOW of 1/16 is left out, or another one, or on
    one side only, or it makes the range of c smaller and not larger."""
    c = [0.0, 0.7, 1.0, -0.2, 1.2, 7.0, -1 / 16, 1 + 1 / 16, -0.0624, 1.0624, -0.0626, 1.0626]
    expected = np.array([1, 1, 1, 0, 0, 0, 0, 0, 1, 1, 0, 0], bool)
    assert_equal(is_blended(impl, [(x, -1.0, x, 2.0) for x in c]), expected)


def may_blend(pair, x, y, faces, opposite):
    """Is a pair of `by_search` blended?"""
    _, _, c, _, along, across, face, edge = pair
    own, i, j = faces[face, [edge, *EDGES[edge]]]

    def side(p):
        return (x[j] - x[i]) * (y[p] - y[i]) - (x[p] - x[i]) * (y[j] - y[i])

    beyond = opposite[face, edge]
    return ((beyond < 0 or side(own) * side(beyond) > 0) and abs(c - 0.5) < 9 / 16
            and abs(along[1] - along[0]) <= abs(across[1] - across[0]))


@exercise("8.12")
def test_blended_pairs_are_those_of_a_search(impl, rng):
    """One of the three conditions is left out. Or pairs of one direction alone are blended."""
    for _ in range(8):
        face_index, depth, (x, y, w), faces = soup(rng, np.ones(15))
        opposite = np.where(rng.random((7, 3)) < 0.5, -1, rng.integers(0, 15, (7, 3)))
        opposite[(opposite[..., None] == faces[:, None]).any(-1)] = -1
        clip = np.stack([2 * x / 7 - 1, 2 * y / 9 - 1, 0 * x, w], -1)
        found = by_search(face_index, depth, (x, y, w), faces, np.ones(7, bool))
        expected = [pair[:2] for pair in zip(*(field.T for field in found), strict=True)
                    if may_blend(pair, x, y, faces, opposite)]
        pairs = blended(impl, face_index, depth, clip, faces, opposite)
        assert_equal((pairs.owner, pairs.other), tuple(np.array(expected, int).reshape(-1, 2).T))


@exercise("8.12", fine_print=True)
def test_half_of_the_pairs_without_weight_are_dropped(impl):
    """Where alpha = 0, nvdiffrast keeps the pairs that their second pixel owns, and no others."""
    clip = np.array([[0.0, -9.0, 0.0, 1.0], [0.0, 9.0, 0.0, 1.0], [-9.0, 0.0, 0.0, 1.0]])
    for face_index, count in (np.array([[0, -1]]), 0), (np.array([[-1, 0]]), 1):
        depth = np.where(face_index < 0, np.inf, 0.0)
        turned = clip * [1 - 2 * count, 1, 1, 1]  # the face lies to the left, then to the right
        pairs = blended(impl, face_index, depth, turned, np.array([[0, 1, 2]]), NONE)
        assert_equal(len(pairs.owner), count)
