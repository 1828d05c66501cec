"""What the extras of lab 6 must do that are about cube maps."""
import itertools

import numpy as np

from labkit.checks import assert_close, assert_equal, exercise

# One direction to each face, away from its middle, and where it is on the face.
DIRECTIONS = np.array([[4.0, 1, -2], [-4, 1, -2], [1, 4, -2], [1, -4, -2], [1, -2, 4], [1, -2, -4]])
PLACES = np.array([[0.75, 0.375], [0.25, 0.375], [0.625, 0.25], [0.625, 0.75], [0.625, 0.75],
                   [0.375, 0.75]])


def sides(d):
    """(m, right . d, down . d) of each face, as OpenGL's table has them."""
    x, y, z = d
    return [(x, -z, -y), (-x, z, -y), (y, x, z), (-y, x, -z), (z, x, -y), (-z, -x, -y)]


def place_of(d):
    """face and (u, v) of one direction."""
    face = max(range(6), key=lambda k: sides(d)[k][0])
    m, s, t = sides(d)[face]
    return face, [(1 + s / m) / 2, (1 + t / m) / 2]


def some_directions(rng, count=24):
    """Random directions of many lengths, away from the cube's edges."""
    directions = rng.uniform(-0.8, 0.8, (count, 3))
    directions[np.arange(count), np.arange(count) % 3] = rng.choice([-1.0, 1.0], count)
    return directions * rng.uniform(0.2, 5, (count, 1))


def point_on(face, column, row, size):
    """The cube's point at a texel's upper left corner, in units of 1/size, also beyond an edge."""
    axis, back = divmod(face, 2)
    right = [(0, 0, -1), (0, 0, 1), (1, 0, 0), (1, 0, 0), (1, 0, 0), (-1, 0, 0)][face]
    down = [(0, -1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (0, -1, 0), (0, -1, 0)][face]
    out = np.eye(3, dtype=int)[axis] * (1 - 2 * back) * size
    return tuple((out + (2 * column - size) * np.array(right)
                  + (2 * row - size) * np.array(down)).tolist())


def corners_of(face, column, row, size):
    return {point_on(face, column + i, row + j, size) for i in (0, 1) for j in (0, 1)}


def texels_beyond(size):
    """All texels one step beyond an edge (face, column, row), and those that stand for them: they
    share the piece of the cube's edge."""
    texels = {texel: corners_of(*texel, size) for texel in np.ndindex(6, size, size)}
    asked = [(face, *texel) for face, beyond, k in itertools.product(range(6), (-1, size),
                                                                      range(size))
             for texel in ((beyond, k), (k, beyond))]
    answers = []
    for face, column, row in asked:
        beside = face, *np.clip([column, row], 0, size - 1).tolist()
        piece = corners_of(face, column, row, size) & texels[beside]
        answers += [texel for texel, corners in texels.items()
                    if texel[0] != face and piece < corners]
    return np.array(asked), np.array(answers)


# --- directions and faces ------------------------------------------------------------------------

@exercise("6.13")
def test_an_axis_meets_the_middle_of_its_face(impl):
    """The faces are in another order, or the sign of the largest coordinate is left out."""
    directions = np.repeat(np.eye(3), 2, 0) * np.array([[3.0], [-3], [2], [-2], [5], [-5]])
    assert_close(impl.on_face(directions), (np.arange(6), np.full((6, 2), 0.5)))


@exercise("6.13")
def test_each_face_has_its_own_right_and_down(impl):
    """A face is mirrored or turned: right and down are exchanged, or those of another face. The
    division by m is left out, or is by m with its sign, or (u, v) goes from -1 to 1.
    """
    assert_close(impl.on_face(DIRECTIONS), (np.arange(6), PLACES))


@exercise("6.13")
def test_only_the_way_counts_and_not_the_length(impl, rng):
    """A direction is taken as if its length, or its largest coordinate, were 1."""
    directions = some_directions(rng)
    expected = [place_of(d) for d in directions]
    assert_close(impl.on_face(directions), ([face for face, _ in expected],
                                            [uv for _, uv in expected]))


@exercise("6.13", fine_print=True)
def test_on_an_edge_the_first_face_counts(impl):
    """The last of several largest coordinates is taken, or a random one."""
    directions = np.array([[1.0, 1, 1], [-1, 1, 1], [0.5, -1, 1], [-2, -2, 1], [0, 3, -3]])
    faces = [0, 1, 3, 1, 2]
    uv = [[0.0, 0], [1, 0], [0.75, 0], [0.75, 1], [0.5, 0]]
    assert_close(impl.on_face(directions), (faces, uv))


# --- seams ---------------------------------------------------------------------------------------

@exercise("6.14")
def test_around_the_belt_a_row_goes_on(impl):
    """Beyond an edge the same face begins again (wrap) or its border goes on (clamp). Left and
    right are exchanged, or the column is that of the far side.
    """
    face, column = np.array([4, 0, 5, 1, 4, 0, 5, 1]), np.array([-1] * 4 + [8] * 4)
    row = np.array([5, 0, 7, 2, 5, 0, 7, 2])
    got = impl.across_edge(face, column, row, np.full(8, 8))
    assert_equal(got, ([1, 4, 0, 5, 0, 5, 1, 4], np.array([7] * 4 + [0] * 4), row))


@exercise("6.14")
def test_above_and_below_it_may_turn(impl):
    """The column stays the column on all faces. On the top and on the bottom it becomes a row, or
    is counted from the other end.
    """
    face, column = np.array([4, 4, 0, 0, 5, 5]), np.array([2, 2, 2, 2, 2, 2])
    row = np.array([-1, 8, -1, 8, -1, 8])
    got = impl.across_edge(face, column, row, np.full(6, 8))
    assert_equal(got, ([2, 3, 2, 3, 2, 3], [2, 2, 7, 7, 5, 5], [7, 0, 5, 2, 0, 7]))


@exercise("6.14")
def test_the_texels_share_their_piece_of_the_edge(impl):
    """At one of the 12 edges, seen from one of its faces, the row of texels is turned or another.
    Or it is right for one size only.
    """
    for size in 1, 3, 4:
        asked, answers = texels_beyond(size)
        got = impl.across_edge(*asked.T, np.full(len(asked), size))
        assert_equal(got, tuple(answers.T), f"all texels beyond an edge, size={size}")


@exercise("6.14")
def test_each_texel_may_be_of_another_level(impl, rng):
    """One size is taken for all: in a pyramid they differ from pixel to pixel."""
    parts = [(size, *texels_beyond(size)) for size in (2, int(rng.integers(5, 30)), 1)]
    asked, answers = (np.concatenate([part[k] for part in parts]) for k in (1, 2))
    sizes = np.repeat([part[0] for part in parts], [len(part[1]) for part in parts])
    got = impl.across_edge(*asked.T, sizes)
    assert_equal(got, tuple(answers.T), f"all texels beyond an edge, of sizes 2, {parts[1][0]}, 1")
