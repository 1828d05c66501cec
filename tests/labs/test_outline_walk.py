"""What the exercises of lab 8 that walk on to an outline must do."""
import edges_in_space
import numpy as np
from edges_in_space import AROUND, CORNERS, EDGES, LEFT, as_pairs, begun, in_space, opposite_corners

from course.scenes.relaxation import split_in_four
from labkit.checks import assert_close, assert_equal, exercise

# --- one step ------------------------------------------------------------------------------------

def entering(impl, corner):
    """`enter_faces` for the pairs AROUND, of two faces that both have CORNERS."""
    x, y = np.tile(CORNERS, (2, 1)).T
    screen, faces = (x, y, np.linspace(0.5, 2, 6)), np.arange(6).reshape(2, 3)
    return as_pairs(impl, impl.enter_faces(*AROUND, np.array(corner), screen, faces, 4))


@exercise("8.12")
def test_the_line_goes_out_between_the_corner_and_the_end_on_the_other_side(impl):
    """Between the corner and the end on its own side: no edge crosses the line there. Or it goes
    out where it came in."""
    pairs = entering(impl, [0, 2, 0, 1])
    assert_equal(pairs.edge, LEFT[0])
    assert_close(pairs.c, LEFT[1])


@exercise("8.12")
def test_the_corner_s_number_names_its_face(impl):
    """Faces are numbered by their corners, or ends are corners 0 to 2, not vertices of the mesh."""
    pairs = entering(impl, [3, 5, 0, 1])
    assert_equal((pairs.face, pairs.ends), ([1, 1, 0, 0], [[5, 4, 0, 1], [3, 5, 1, 2]]))
    assert_equal((pairs.owner, pairs.other), AROUND)


@exercise("8.12")
def test_the_ends_of_an_edge_in_the_frame_of_its_pair(impl):
    """x and y are those of the screen, or of another pair."""
    pairs = entering(impl, [0, 2, 0, 1])
    assert_close((pairs.x, pairs.y), LEFT[2:])


def crossed_edges(owner, other, face, screen, faces, width):
    """The edges of a face whose ends lie on different sides of the pair's line, in space."""
    y = in_space(owner, other, screen, width)[faces[face], 1]
    return [k for k, (i, j) in enumerate(EDGES) if (y[i] < 0) != (y[j] < 0)]


def assert_searched(impl, rng, w):
    """enter_faces pair by pair, in space: of two crossed edges it goes out by the other one."""
    screen, faces = edges_in_space.soup(rng, w)
    found = []
    for owner, other in zip(*edges_in_space.pairs_around(rng, 60), strict=True):
        face = rng.integers(0, 7)
        crossed = rng.permuted(crossed_edges(owner, other, face, screen, faces, 7))
        if len(crossed) == 2:
            entered, left = map(int, crossed)
            ends = faces[face, list(EDGES[left])]
            place = edges_in_space.crossing(*in_space(owner, other, screen, 7)[ends])
            found.append((owner, other, 3 * face + entered, left,
                          place if place > -np.inf else np.inf))
    owner, other, corner, edge, c = (np.array(field) for field in zip(*found, strict=True))
    pairs = as_pairs(impl, impl.enter_faces(owner, other, corner, screen, faces, 7))
    assert_equal((pairs.face, pairs.edge), (corner // 3, edge))
    assert_close(pairs.c, c)


@exercise("8.12")
def test_steps_are_those_of_a_search(impl, rng):
    """Columns of different pairs are mixed up, or corners of the mesh with those of a face."""
    assert_searched(impl, rng, rng.uniform(0.5, 2, 15))


@exercise("8.12", fine_print=True)
def test_faces_that_reach_behind_the_camera_are_left_in_front_of_it(impl, rng):
    """w is not used: a corner behind the camera is mirrored. Or the crossing there counts, which is
    behind the other's centre: c is np.inf."""
    for _ in range(3):
        assert_searched(impl, rng, rng.uniform(0.5, 2, 15) * rng.choice([1, 1, -1], 15))


@exercise("8.12", fine_print=True)
def test_a_corner_on_the_line_counts_as_above(impl):
    """<= in place of <: a line through a corner goes back where it came from."""
    x, y = np.array([0.0, 0.0, 2.0, 4.0]), np.array([-1.0, 3.0, 0.5, 1.0])
    faces = np.array([[0, 1, 2], [2, 1, 3], [0, 2, 3]])
    one = np.array([0]), np.array([1])
    pairs = as_pairs(impl, impl.enter_faces(*one, np.array([2]), (x, y, np.ones(4)), faces, 4))
    assert_equal((pairs.edge, pairs.ends[:, 0]), ([1], [2, 0]))


# --- the walk ------------------------------------------------------------------------------------

def ribbon(*x):
    """A strip along the first row of a picture, from vertices below it and above it in turn:
    screen, faces. Edge by edge, y = 1/2 is crossed in the middle."""
    k = np.arange(len(x) - 2)
    faces = np.stack([k, k + 1 + k % 2, k + 2 - k % 2], 1)[:, [0, 2, 1]]
    return (np.array(x) + 0.5, np.where(np.arange(len(x)) % 2, 2.5, -1.5), np.ones(len(x))), faces


def patch(rng, n=6, size=7.0):
    """A bumpless sheet of 2 n^2 faces over a picture of this size: screen, faces."""
    i, j = np.divmod(np.arange((n + 1)**2), n + 1)
    places = np.stack([j, i], 1) * (size / n) + rng.uniform(-0.3, 0.3, ((n + 1)**2, 2))
    low = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    faces = np.concatenate([np.stack([low, low + 1, low + n + 2], 1),
                            np.stack([low, low + n + 2, low + n + 1], 1)])
    return (*places.T, rng.uniform(0.5, 2, len(places))), rng.permutation(faces)


def covers(corners, x, y):
    """Is (x, y) in a triangle (3, 2)?"""
    e = [(b - a)[0] * (y - a[1]) - (b - a)[1] * (x - a[0])
         for a, b in zip(corners, np.roll(corners, -1, 0), strict=True)]
    return min(e) > 0 or max(e) < 0


def by_search(owner, other, face, goal, screen, faces, opposite, silhouette, width):
    """The walk of one pair, face by face: face, edge, c where it stops."""
    entered = None
    while True:
        corners = in_space(owner, other, screen, width)[faces[face]]
        places = {k: edges_in_space.crossing(corners[i], corners[j])
                  for k, (i, j) in enumerate(EDGES) if k != entered}
        edge = max(places, key=places.get)
        across, corner = divmod(int(opposite[face, edge]), 3)
        if places[edge] >= 1 or silhouette[face, edge] or across == goal:
            return face, edge, places[edge]
        face, entered = across, corner


def walkers(rng, screen, faces, count, width=7):
    """Pairs whose owner's centre is on the sheet: owner, other, face (N,)."""
    found = []
    for owner, other in zip(*edges_in_space.pairs_around(rng, count), strict=True):
        centre = owner % width + 0.5, owner // width + 0.5
        seen = [f for f, face in enumerate(faces) if covers(np.stack(screen[:2], 1)[face], *centre)]
        if len(seen) == 1:
            found.append((owner, other, seen[0]))
    return np.array(found).T


def walked(impl, owner, other, face, screen, faces, opposite, silhouette, width, goal=-1):
    """`walk` from the edges by which the lines leave the first faces, found in space, to a goal
    that is nowhere."""
    pairs = impl.Pairs(*begun(owner, other, face, screen, faces, width))
    goals = goal + np.zeros(len(owner), int)
    return as_pairs(impl, impl.walk(pairs, goals, screen, faces, opposite, silhouette, width))


# The owner's centre is on face 1, and the line leaves faces 1 to 3 at 0.375, 0.75 and 1.25.
RIBBON = ribbon(-0.75, -0.25, 0.0, 0.75, 0.75, 1.75, 2.0)


@exercise("8.13")
def test_a_walk_goes_on_to_a_silhouette(impl):
    """It stops after its first step, or takes one step alone. Or it goes over the silhouette."""
    screen, faces = RIBBON
    opposite = opposite_corners(faces)
    for last, c in (1, 0.375), (2, 0.75):
        silhouette = opposite // 3 == last + 1
        pairs = walked(impl, *np.array([[0], [1], [1]]), screen, faces, opposite, silhouette, 2)
        assert_equal((pairs.face, silhouette[pairs.face, pairs.edge]), ([last], [True]))
        assert_close(pairs.c, [c])


@exercise("8.13")
def test_a_walk_ends_at_the_other_s_centre(impl):
    """It goes on after c >= 1, to a silhouette far away, or over the border of the mesh."""
    opposite = opposite_corners(RIBBON[1])
    pairs = walked(impl, *np.array([[0], [1], [1]]), *RIBBON, opposite, opposite < 0, 2)
    assert_equal(pairs.face, [3])
    assert_close(pairs.c, [1.25])


@exercise("8.13")
def test_a_walk_ends_before_the_face_that_the_other_sees(impl):
    """It goes on over it, and what lies behind counts."""
    screen, faces = RIBBON
    opposite = opposite_corners(faces)
    scene = *np.array([[0], [1], [1]]), screen, faces, opposite, opposite < 0, 2
    for goal in 2, 3:
        assert_equal(walked(impl, *scene, goal).face, [goal - 1])


@exercise("8.13")
def test_walks_are_those_of_a_search(impl, rng):
    """Walks of different lengths are mixed up: those that are over go on, or all stop with the
    first. Or the result is that of the first face."""
    for _ in range(3):
        screen, faces = patch(rng)
        opposite = opposite_corners(faces)
        silhouette = (rng.random(faces.shape) < 0.15) | (opposite < 0)
        scene = screen, faces, opposite, silhouette, 7
        owner, other, face = walkers(rng, screen, faces, 40)
        goal = rng.integers(0, len(faces), len(face))
        goal[goal == face] = -1
        pairs = walked(impl, owner, other, face, *scene, goal)
        expected = [by_search(*one, *scene) for one in zip(owner, other, face, goal, strict=True)]
        for got, wanted in zip((pairs.face, pairs.edge), np.array(expected).T[:2], strict=True):
            assert_equal(got, wanted.astype(int))
        assert_close(pairs.c, np.array(expected).T[2])


@exercise("8.13")
def test_all_that_belongs_to_the_edge_comes_along(impl, rng):
    """ends, x and y are still those of the first face, or owner and other change."""
    screen, faces = patch(rng)
    opposite = opposite_corners(faces)
    owner, other, face = walkers(rng, screen, faces, 40)
    pairs = walked(impl, owner, other, face, screen, faces, opposite, opposite < 0, 7)
    assert_equal((pairs.owner, pairs.other), (owner, other))
    assert_equal(pairs.ends, faces[pairs.face[:, None], np.array(EDGES)[pairs.edge]].T)
    for n, (a, b) in enumerate(zip(owner, other, strict=True)):
        ends = in_space(a, b, screen, 7)[pairs.ends[:, n]]
        assert_close((pairs.x[:, n], pairs.y[:, n]), tuple((ends[:, :2] / ends[:, 2:]).T))


@exercise("8.13", fine_print=True)
def test_a_walk_that_no_edge_begins_is_over(impl):
    """A division by 0, an error, or a pair that is left out."""
    (x, y, w), faces = RIBBON
    opposite = opposite_corners(faces)
    one = np.array([[0], [1], [0]])
    pairs = walked(impl, *one, (x, y + 9, w), faces, opposite, opposite < 0, 2)
    assert_equal(pairs.c, [-np.inf])


# --- who walks -----------------------------------------------------------------------------------

def outlines_of(impl, *scene):
    """owner, other, c of `outline_pairs`, sorted."""
    return both_of(impl, *scene)[0]


def both_of(impl, *scene):
    """owner, other, c of both Pairs of `outline_pairs`, sorted."""
    both = [as_pairs(impl, pairs) for pairs in impl.outline_pairs(*scene)]
    orders = [np.lexsort((pairs.other, pairs.owner)) for pairs in both]
    return [tuple(field[order] for field in pairs[:3])
            for pairs, order in zip(both, orders, strict=True)]


def ndc(x, y, z, size):
    """Points on screen -> clip (V, 4) with w = 1."""
    width, height = size
    return np.stack([2 * np.array(x) / width - 1, 2 * np.array(y) / height - 1,
                     np.array(z, float), np.ones(len(x))], 1)


def seen(clip, faces, size):
    """face_index, depth (H, W), by a search: z / w is linear on the screen."""
    width, height = size
    points = (clip[:, :2] / clip[:, 3:] + 1) / 2 * [width, height]
    deep = clip[:, 2] / clip[:, 3]
    face_index, depth = np.full((height, width), -1), np.full((height, width), np.inf)
    for i, j in np.ndindex(height, width):
        for f, face in enumerate(faces):
            if covers(points[face], j + 0.5, i + 0.5):
                plane = np.column_stack([points[face], np.ones(3)])
                z = np.linalg.solve(plane, deep[face]) @ [j + 0.5, i + 0.5, 1]
                if z < depth[i, j]:
                    face_index[i, j], depth[i, j] = f, z
    return face_index, depth


def beside(impl, clip, faces):
    """The outlines of a scene of two pixels."""
    faces = np.array(faces)
    return outlines_of(impl, *seen(clip, faces, (2, 1)), clip, faces, opposite_corners(faces))


@exercise("8.14")
def test_an_outline_before_the_background(impl):
    """Nothing is found, or owner and other are exchanged, or each pair counts."""
    clip = ndc([0.75, 0.75, -9.0], [-9.0, 9.0, 0.5], [0, 0, 0], (2, 1))
    assert_close(beside(impl, clip, [[0, 1, 2]]), ([0], [1], [0.25]))
    assert_close(beside(impl, clip * [-1, 1, 1, 1], [[0, 1, 2]]), ([1], [0], [0.25]))


@exercise("8.14")
def test_where_the_surface_goes_on_there_is_no_outline(impl):
    """An edge between two faces of one surface counts, or a walk that arrived does."""
    clip = ndc([-9, 1.0, 1.0, 9], [0.5, -9, 9, 0.5], [0, 0, 0, 0], (2, 1))
    assert_equal(beside(impl, clip, [[0, 1, 2], [2, 1, 3]])[0].shape, (0,))


@exercise("8.14")
def test_an_outline_through_the_other_s_centre_counts(impl):
    """c < 1 for c <= 1: where it passes the centre, half of the pixel is covered."""
    clip = ndc([1.5, 1.5, -9.0], [9.0, -9.0, 0.5], [0, 0, 0], (2, 1))
    assert_close(beside(impl, clip, [[0, 1, 2]]), ([0], [1], [1.0]))


@exercise("8.14")
def test_what_hides_the_owner_s_surface_walks_in_its_place(impl):
    """A slope is nearer at the left centre, and lies behind another face at the right one: the
    border of that face is the outline. Nobody looks for it, or the slope's own border counts."""
    slope = ndc([-9, 9, 9], [0.5, -9, 9], [-0.5 - 9.5, -0.5 + 8.5, -0.5 + 8.5], (2, 1))
    wall = ndc([1.25, 9, 1.25], [-9, 0.5, 9], [0, 0, 0], (2, 1))
    clip = np.concatenate([slope * [1, 1, 0.1, 1], wall])
    assert_close(beside(impl, clip, [[0, 1, 2], [3, 4, 5]]), ([1], [0], [0.25]))


@exercise("8.14")
def test_surfaces_that_pass_through_each_other_are_the_others(impl):
    """Nobody says that both surfaces pass the other's centre, or only the first walk is told: the
    second one begins where the deeper face is seen."""
    x, y = [-9, 9, 9], [0.5, -9, 9]
    clip = np.concatenate([ndc(x, y, np.array(x) * 0.1 - 0.1, (2, 1)),
                           ndc(x, y, 0.08 - np.array(x) * 0.08, (2, 1))])
    faces = np.array([[0, 1, 2], [3, 4, 5]])
    picture = seen(clip, faces, (2, 1))
    outlines, others = both_of(impl, *picture, clip, faces, opposite_corners(faces))
    assert_equal((outlines[0].shape, others[:2]), ((0,), ([1], [0])))


@exercise("8.14")
def test_where_surfaces_do_not_pass_through_each_other_there_are_no_others(impl):
    """Each pair without an outline is one of the others, or one with an outline. Or the surface
    goes on where no face is seen, as it lies beyond the greatest depth there."""
    clip = ndc([-9, 1.0, 1.0, 9], [0.5, -9, 9, 0.5], [0, 0, 0, 0], (2, 1))
    faces = np.array([[0, 1, 2], [2, 1, 3]])
    for face_index in [[0, 1]], [[0, -1]], [[-1, 1]]:
        picture = np.array(face_index), np.where(np.array(face_index) < 0, np.inf, 0.5)
        _, others = both_of(impl, *picture, clip, faces, opposite_corners(faces))
        assert_equal(others[0].shape, (0,))


def expected_outlines(face_index, depth, clip, faces):
    """By search, for faces that share no edge: each has borders alone."""
    height, width = face_index.shape
    screen = *(((clip[:, :2] / clip[:, 3:] + 1) / 2 * [width, height]).T), clip[:, 3]
    found = []
    for i, j in np.ndindex(height, width):
        for k, m in (i, j + 1), (i, j - 1), (i + 1, j), (i - 1, j):
            if not (0 <= k < height and 0 <= m < width) or depth[i, j] >= depth[k, m]:
                continue
            a, b = i * width + j, k * width + m
            for owner, other, f in (a, b, face_index[i, j]), (b, a, face_index[k, m]):
                if f < 0 or face_index[i, j] == face_index[k, m]:
                    break
                _, c = edges_in_space.last_crossing(in_space(owner, other, screen, width)[faces[f]])
                if c < 1:
                    found.append((owner, other, c))
                    break
    return tuple(np.array(field) for field in zip(*sorted(found), strict=True))


@exercise("8.14")
def test_faces_of_any_size_have_the_outlines_of_the_whole(impl, rng):
    """Cut into 16 faces each, the same triangles lose outlines: a walk stops too early."""
    for _ in range(2):
        x, y = rng.uniform(-1, [[10], [8]], (2, 18))
        clip, faces = ndc(x, y, rng.uniform(-0.9, 0.9, 18), (9, 7)), np.arange(18).reshape(6, 3)
        expected = expected_outlines(*seen(clip, faces, (9, 7)), clip, faces)
        for _ in range(2):
            clip, faces = split_in_four(clip, faces)
        got = outlines_of(impl, *seen(clip, faces, (9, 7)), clip, faces, opposite_corners(faces))
        assert_close(got, expected)


# --- what moves when an outline does -------------------------------------------------------------

def pulled(impl, grad_picture, colour, ends, x, y, owner=0, other=1):
    """outline_pull_backward of one pair: the edge from vertex 0 to 1, in the pair's frame."""
    pairs = impl.Pairs(np.array([owner]), np.array([other]), np.array([0.25]), np.array(ends),
                       np.array(x), np.array(y), np.array([0]), np.array([2]))
    height, width, _ = colour.shape
    clip = np.zeros((3, 4)) + [0, 0, 0, 1]
    pull = impl.outline_pull_backward(grad_picture, colour, pairs, clip)
    return pull[:, :2] * 2 / [width, height]


TWO = np.array([[[10.0, 1.0], [100.0, 2.0]]]), np.array([[[1.0, 0.5], [0.0, 4.0]]])


@exercise("8.15")
def test_the_point_pulls_at_the_ends_of_its_edge(impl):
    """Each end is pulled by half of it, or by the other one's share."""
    expected = (110 * 1 + 3 * -3.5) / 2 * np.array([[0.75, 0], [0.25, 0], [0, 0]])
    assert_close(pulled(impl, *TWO, [[0], [1]], [[0.0], [1.0]], [[-1.0], [3.0]]), expected)
    assert_close(pulled(impl, *TWO, [[1], [0]], [[0.0], [1.0]], [[3.0], [-1.0]]), expected)


@exercise("8.15")
def test_it_pulls_from_the_owner_to_the_other(impl):
    """The pull is always to the right or upwards, or x and y are swapped for pixels above each
    other."""
    grad_picture, colour = np.zeros((2, 2, 1)), np.zeros((2, 2, 1))
    grad_picture[1, 0], colour[1, 0] = 2.0, 1.0
    for other, way in (3, [1, 0]), (0, [0, -1]):
        edge = [[0], [1]], [[0.0], [0.0]], [[-1.0], [1.0]]
        got = pulled(impl, grad_picture, colour, *edge, 2, other)
        assert_close(got, np.outer([0.5, 0.5, 0], way))


@exercise("8.15")
def test_pulls_are_those_of_a_search(impl, rng):
    """Pulls of several pairs at one vertex do not add up, or w is left out on the way to clip."""
    owner, other = edges_in_space.pairs_around(rng, 30)
    (x, _), (low, high) = rng.normal(size=(2, 2, 30)), rng.uniform(0.1, 2, (2, 30))
    ends, clip = rng.permuted(np.tile(np.arange(9), (30, 1)), axis=1).T[:2], rng.normal(size=(9, 4))
    clip[:, 3] = rng.uniform(0.5, 2, 9)
    grad_picture, colour = rng.normal(size=(2, 9, 7, 3))
    places = np.stack([x, x]), np.stack([-low, high])
    pairs = impl.Pairs(owner, other, x, ends, *places, owner, ends[0])
    expected = np.zeros((9, 4))
    for n, (a, b) in enumerate(zip(owner, other, strict=True)):
        g, shade = (values.reshape(-1, 3)[[a, b]] for values in (grad_picture, colour))
        force = g.mean(0) @ (shade[0] - shade[1])
        way = np.array([b % 7 - a % 7, b // 7 - a // 7]) * [7 / 2, 9 / 2]  # pixels to ndc
        for vertex, share in zip(ends[:, n], (high[n], low[n]), strict=True):
            part = way * force * share / (low[n] + high[n]) / clip[vertex, 3]
            expected[vertex, :2] += part
            expected[vertex, 3] -= part @ clip[vertex, :2] / clip[vertex, 3]
    assert_close(impl.outline_pull_backward(grad_picture, colour, pairs, clip), expected)


def around_a_triangle(impl, triangle, size):
    """Its coverage (H, W, 1), and all pairs of a centre in it with one outside."""
    corners = np.column_stack([triangle, np.ones(3)])
    at = np.arange(size) + 0.5
    e = np.array([np.cross(corners[i], corners[j]) for i, j in EDGES])
    inside = np.all(e[:, :1, None] * at + (e[:, 1:2] * at + e[:, 2:])[..., None] > 0, 0)
    owner = np.flatnonzero(inside).repeat(4).reshape(-1, 4)
    other = owner + [1, size, -1, -size]
    out = ~inside.ravel()[other]
    pairs = begun(owner[out], other[out], 0 * owner[out], corners.T, np.array([[0, 1, 2]]), size)
    return inside[..., None].astype(float), impl.Pairs(*pairs)


@exercise("8.15")
def test_the_mean_over_shifts_is_the_gradient_of_the_area(impl, rng):
    """No factor 1/2, a share of steep outlines alone, or the owner's gradient alone. One picture's
    pull is off by some per cent, as the picture jumps; the mean over shifts is not."""
    triangle, size, shifts = np.array([[4.0, 5.0], [20.0, 7.0], [9.0, 19.0]]), 24, 60
    mean = np.zeros((3, 2))
    for shift in rng.uniform(-0.5, 0.5, (shifts, 2)):
        clip = ndc(*(triangle + shift).T, np.zeros(3), (size, size))
        colour, pairs = around_a_triangle(impl, triangle + shift, size)
        grad_clip = impl.outline_pull_backward(np.ones_like(colour), colour, pairs, clip)
        mean += grad_clip[:, :2] * 2 / size / shifts
    across = np.roll(triangle, -1, 0) - np.roll(triangle, -2, 0)
    assert_close(mean, np.stack([-across[:, 1], across[:, 0]], 1) / -2, atol=0.3, rtol=0)
