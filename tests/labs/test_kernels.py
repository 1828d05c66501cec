"""What the exercises of lab 17 must do: loops whose threads may come in any order."""
import numpy as np

from labkit.checks import assert_close, assert_equal, exercise, parts

BOXES = np.array([[0, 0, 3, 2], [2, 1, 5, 4], [1, 1, 2, 2], [4, 0, 4, 3]])  # the last has no column


@exercise("17.1")
def test_writers_on_paper(impl):
    """The right column or the top row is included. Rows and columns are exchanged."""
    assert_equal(impl.writers(BOXES, 5, 4), np.array([[1, 1, 1, 0, 0], [1, 2, 2, 1, 1],
                                                      [0, 0, 1, 1, 1], [0, 0, 1, 1, 1]]))


@exercise("17.1")
def test_all_writes_are_counted(impl, rng):
    """A pixel counts once, however many faces write to it."""
    low, sides = rng.integers(0, 6, (20, 2)), rng.integers(0, 5, (20, 2))
    count = impl.writers(np.hstack([low, low + sides]), 11, 10)
    assert_equal(count.sum(), sides.prod(1).sum())


def fragments(rng, pixels=7):
    """Of some pixels, none with two depths that the key takes for one: pixel, depth, face."""
    depth = rng.permutation(np.linspace(-1, 1, 40))
    return rng.integers(0, pixels - 1, 40), depth, rng.permutation(1000)[:40]


@exercise("17.2")
def test_the_nearest_of_each_pixel_is_seen(impl, rng):
    """The last fragment stays, or the farthest. The key has the face before the depth. Depths less
    than 0 come out in the wrong order. Faces are cut off at 255. A pixel without any sees face 0.
    """
    pixel, depth, face = fragments(rng)
    expected = [min(((z, f) for p, z, f in zip(pixel, depth, face, strict=True) if p == q),
                    default=(0, -1))[1] for q in range(8)]
    assert_equal(impl.nearest_faces(pixel, depth, face, 8), np.array(expected))


@exercise("17.2")
def test_the_order_of_the_fragments_makes_no_difference(impl):
    """Depth and face are compared and written in two steps, so that somebody comes between."""
    rng = np.random.default_rng(0)  # not drawn: what is always the same passes
    pixel, depth, face = fragments(rng)
    pixel = pixel.astype(np.intp)
    first, order = impl.nearest_faces(pixel, depth, face, 7), rng.permutation(40)
    assert_equal(impl.nearest_faces(pixel[order], depth[order], face[order], 7), first)


@exercise("17.2")
def test_of_equal_depths_the_lower_number_is_seen(impl):
    """The first or the last that comes is seen, so that the picture depends on the order. Depths
    that differ by less than the key can tell are not equal.
    """
    near = 0.25 + 2.0**-40
    found = impl.nearest_faces(np.array([0, 0, 1, 1]), np.array([0.25, 0.25, near, 0.25]),
                               np.array([5, 3, 2, 4]), 2)
    assert_equal(found, np.array([3, 2]))


@exercise("17.2")
def test_depths_are_rounded_down(impl):
    """They are rounded to the nearest key, or cut off towards a depth of 0."""
    unit = 2.0**-29
    found = impl.nearest_faces(np.array([0, 0, 1, 1]), np.array([0.6, 1.4, -0.6, 0.6]) * unit,
                               np.array([7, 2, 7, 2]), 2)
    assert_equal(found, np.array([7, 7]))


@exercise("17.2")
def test_the_ends_of_the_depth_are_seen(impl):
    """A depth of exactly 1 is taken for no fragment, or runs over into the sign."""
    found = impl.nearest_faces(np.array([0, 2]), np.array([1.0, -1.0]), np.array([6, 0]), 3)
    assert_equal(found, np.array([6, -1, 0]))


@exercise("17.3")
def test_a_mixture_on_paper(impl):
    """The weights are not divided by their sum, or by the sum of another pixel."""
    e = np.array([[1.0, 2.0, -1.0], [1.0, 0.0, -2.0], [2.0, 6.0, -1.0]])
    a = np.array([[4.0, 8.0, 4.0], [8.0, 5.0, 2.0], [2.0, 4.0, 0.0]])
    assert_close(impl.mixed_at_once(e, a), np.array([4.0, 5.0, 2.0]))


@exercise("17.3")
def test_it_is_what_the_passes_find(impl, rng):
    """It is right for positive weights alone, or for few pixels."""
    e, a = rng.uniform(1, 2, (3, 50)) * rng.choice([-1, 1], 50), rng.normal(size=(3, 50))
    assert_close(impl.mixed_at_once(e, a), (e * a).sum(0) / e.sum(0))


def two(returned):
    return parts(returned, "start", "item")


@exercise("17.4")
def test_bins_on_paper(impl):
    """start counts from the end, lacks its last number, or is moved on, as it is not copied. Items
    are in the wrong order.
    """
    start, item = two(impl.bins(np.array([3, 1, 3, 0, 1, 3]), 5))
    assert_equal(start, np.array([0, 1, 3, 3, 6, 6]))
    assert_equal(item, np.array([3, 1, 4, 0, 2, 5]))


@exercise("17.4")
def test_each_bin_has_its_items_in_their_order(impl, rng):
    """The items of a bin stand in reverse order, or one is written over another."""
    bin_of = rng.integers(0, 6, 60)
    start, item = two(impl.bins(bin_of, 7))
    assert_equal(start, np.searchsorted(np.sort(bin_of), np.arange(8)))
    assert_equal(item, np.argsort(bin_of, kind="stable"))


@exercise("17.4")
def test_no_items_fill_no_bins(impl):
    """The last bin, or the first item, is taken for granted."""
    start, item = two(impl.bins(np.zeros(0, int), 3))
    assert_equal((start, item.shape), (np.zeros(4), (0,)))


def boxes_of(rng, count=30, width=22, height=15):
    """Boxes with a pixel each, in a picture of this size."""
    low = rng.integers(0, [width, height], (count, 2))
    return np.hstack([low, rng.integers(low + 1, [width + 1, height + 1])])


@exercise("17.5")
def test_a_box_in_one_tile_is_in_its_list(impl, rng):
    """Rows and columns of tiles are exchanged. Coordinates are not divided by a tile's size."""
    row, column = rng.permutation(3)[:2].tolist()
    low = 8 * np.array([column, row]) + rng.integers(0, 4, 2)
    start, item = two(impl.tile_lists(np.array([[*low, *low + 4]]), 8, 4, 3))
    assert_equal(start, (np.arange(13) > 4 * row + column).astype(int))
    assert_equal(item, np.array([0]))


@exercise("17.5")
def test_tiles_on_paper(impl):
    """A box that ends at a tile's first column, or row, is in that tile, too. Only the tiles at its
    corners have it, or the one where it begins. The lists hold numbers of pairs, and not of faces.
    """
    boxes = np.array([[1, 1, 3, 2], [0, 0, 4, 4], [3, 3, 5, 5], [8, 1, 12, 7], [5, 0, 12, 8]])
    start, item = two(impl.tile_lists(boxes, 4, 3, 2))
    assert_equal(start, np.array([0, 3, 5, 7, 8, 10, 12]))
    assert_equal(item, np.array([0, 1, 2, 2, 4, 3, 4, 2, 2, 4, 3, 4]))


@exercise("17.5")
def test_each_tile_has_the_faces_that_share_a_pixel_with_it(impl, rng):
    """A face is in a list twice, or missing there; or a tile's faces are not in their order."""
    boxes, size, across, down = boxes_of(rng), 5, 5, 3
    start, item = two(impl.tile_lists(boxes, size, across, down))
    assert_equal(np.shape(start), (across * down + 1,))
    for tile in range(across * down):
        row, column = divmod(tile, across)
        left, bottom = size * column, size * row
        meets = ((boxes[:, 0] < left + size) & (boxes[:, 2] > left)
                 & (boxes[:, 1] < bottom + size) & (boxes[:, 3] > bottom))
        assert_equal(item[start[tile]:start[tile + 1]], np.flatnonzero(meets),
                     given=f"the list of tile {tile}")


@exercise("17.6")
def test_sums_on_paper(impl):
    """The place in the list is taken for the item's number. Only the last item counts."""
    start, item = np.array([0, 0, 2, 3]), np.array([2, 0, 1])
    values = np.array([[1.0, 2.0], [10.0, 30.0], [100.0, 500.0]])
    assert_equal(impl.gathered(start, item, values), np.array([[0, 0], [101.0, 502], [10, 30]]))


@exercise("17.6")
def test_items_are_added_in_their_order(impl):
    """Another order of the same numbers has another sum: 1e16 swallows a 1."""
    values = np.array([[1e16], [1.0], [-1e16], [1.0]])
    for item, total in ([0, 1, 2, 3], 1.0), ([0, 2, 1, 3], 2.0), ([1, 3, 0, 2], 2.0):
        found = impl.gathered(np.array([0, 4]), np.array(item), values)
        assert_equal(found, np.array([[total]]))


@exercise("17.6")
def test_a_gather_is_the_scatter(impl, rng):
    """An item is left out, counted twice, or added to another bin."""
    bin_of, values = rng.integers(0, 9, 40), rng.normal(size=(40, 3))
    start, item = np.searchsorted(np.sort(bin_of), np.arange(11)), np.argsort(bin_of, kind="stable")
    expected = np.zeros((10, 3))
    np.add.at(expected, bin_of, values)
    assert_close(impl.gathered(start, item, values), expected)


RIGHT = np.array([[[0.0, 0.0], [6.0, 0.0], [0.0, 4.0]]])  # c = (1 - x / 6 - y / 4, x / 6, y / 4)


def in_one_tile(impl, triangles, z, colours, width, height):
    """By a single list of all faces, in a tile as large as the picture."""
    lists = np.array([0, len(triangles)]), np.arange(len(triangles))
    return impl.three_passes(triangles, z, colours, lists, max(width, height), width, height)


@exercise("17.7")
def test_one_face_on_paper(impl):
    """Pixels are sampled at their corners, or x and y are exchanged. Colours are mixed on the
    screen: c_k A_k is not divided by z_k, or the sum is not multiplied by the depth.
    """
    colours = np.array([[[8.0], [4.0], [2.0]]])
    flat = in_one_tile(impl, RIGHT, np.ones((1, 3)), colours, 3, 2)[..., 0]
    assert_close(flat, np.array([[83, 75, 67], [65, 57, 49]]) / 12)
    slanted = in_one_tile(impl, RIGHT, np.array([[1.0, 2.0, 4.0]]), colours, 3, 2)[..., 0]
    by_hand = (np.array([[76, 60, 44], [52, 36, 20]]) * 8 + np.array([[8, 24, 40], [8, 24, 40]]) * 2
               + np.array([[12, 12, 12], [36, 36, 36]]) * 0.5)
    by_hand /= (np.array([[76, 60, 44], [52, 36, 20]]) + np.array([[8, 24, 40], [8, 24, 40]]) / 2
                + np.array([[12, 12, 12], [36, 36, 36]]) / 4)
    assert_close(slanted, by_hand)


@exercise("17.7")
def test_a_sample_on_an_edge_is_covered(impl):
    """c_k > 0 is asked for, so that pixels on an edge or a corner see nothing."""
    screen = np.array([[[0.5, 0.5], [2.5, 0.5], [0.5, 4.5]]])  # no rounding: its area is 4
    picture = in_one_tile(impl, screen, np.ones((1, 3)), np.full((1, 3, 1), 2.0), 3, 5)
    assert_close(picture[..., 0], np.array([[2.0, 2.0, 2.0], [2.0, 2.0, 0.0], [2.0, 2.0, 0.0],
                                            [2.0, 0.0, 0.0], [2.0, 0.0, 0.0]]))


@exercise("17.7")
def test_the_nearest_face_is_seen(impl):
    """The last face is seen, or the farthest. Of two equally deep ones it is not the first. The
    depth is that of the corners, not of the pixel.
    """
    screen = np.concatenate([RIGHT] * 4)
    z = np.array([[3.0, 3, 3], [1.0, 9, 9], [2.0, 2, 2], [2.0, 2, 2]])
    colours = np.array([1.0, 2, 3, 4])[:, None, None] * np.ones((1, 3, 2))
    picture = in_one_tile(impl, screen, z, colours, 5, 4)
    c1, c2 = (np.arange(5) + 0.5) / 6, (np.arange(4)[:, None] + 0.5) / 4
    c0 = 1 - c1 - c2
    second = np.where(c0 + (c1 + c2) / 9 > 0.5, 2.0, 3.0)
    assert_close(picture, np.where(c0 >= 0, second, 0.0)[..., None] * np.ones(2))


@exercise("17.7")
def test_both_windings_and_faces_without_area(impl, rng):
    """A clockwise face is left out. A face without area is seen, or stops the others."""
    turned = RIGHT[:, ::-1]
    line = np.array([[[0.0, 0.0], [3.0, 3.0], [6.0, 6.0]]])
    z, colours = np.full((2, 3), 2.0), rng.uniform(1, 2, (2, 3, 1))
    found = in_one_tile(impl, np.concatenate([line, turned]), z, colours, 6, 5)
    expected = in_one_tile(impl, RIGHT, z[:1], colours[1:, ::-1], 6, 5)
    assert_close(found, expected)
    assert_equal((found > 0).sum(), 12)


@exercise("17.7")
def test_a_mesh_is_what_planes_and_a_minimum_say(impl, rng):
    """A face takes the weights of another, or a pixel those of its neighbour."""
    screen, z = rng.uniform(-2, 12, (9, 3, 2)), rng.uniform(1, 3, (9, 3))
    colours = rng.normal(size=(9, 3, 2))
    y, x = np.mgrid[:9, :10] + 0.5
    corners = np.concatenate([screen, np.ones((9, 3, 1))], -1).transpose(0, 2, 1)
    c = np.einsum("fkc,chw->fkhw", np.linalg.inv(corners), np.stack([x, y, np.ones_like(x)]))
    parts = c / z[:, :, None, None]
    depth = np.where((c >= 0).all(1), 1 / parts.sum(1), np.inf)
    face = depth.argmin(0)
    q = np.take_along_axis(parts, face[None, None], 0)[0]
    mixed = np.einsum("khw,hwkc->hwc", q / q.sum(0), colours[face])
    seen = np.isfinite(depth.min(0))
    assert_close(in_one_tile(impl, screen, z, colours, 10, 9), np.where(seen[..., None], mixed, 0))


@exercise("17.7")
def test_a_pixel_looks_at_the_list_of_its_tile_alone(impl, rng):
    """All faces are asked, or those of one tile. Rows and columns of tiles are exchanged, or the
    last tile of a row, which the picture cuts, is not counted.
    """
    shown = rng.permutation(6)  # of 3 x 2 tiles: each has a face of its own, before all of it
    screen = np.tile([[-9.0, -9.0], [40.0, -9.0], [-9.0, 40.0]], (6, 1, 1))
    colours = np.tile(np.arange(1.0, 7)[:, None, None], (1, 3, 1))
    picture = impl.three_passes(screen, np.ones((6, 3)), colours, (np.arange(7), shown), 4, 10, 7)
    i, j = np.mgrid[:7, :10] // 4
    assert_close(picture[..., 0], 1.0 + shown[3 * i + j])


@exercise("17.7")
def test_tiles_of_any_size_draw_the_same(impl):
    """The picture has seams between tiles; or a face's place in the list is taken for its number.
    """
    rng = np.random.default_rng(0)  # not drawn: what is always the same passes
    low = rng.uniform(0, 12, (9, 1, 2))
    screen, z = low + rng.uniform(-5, 5, (9, 3, 2)), rng.uniform(1, 3, (9, 3))
    colours = rng.uniform(1, 2, (9, 3, 2))
    whole = in_one_tile(impl, screen, z, colours, 13, 11)
    for size in 3, 5:
        across, down = -(-13 // size), -(-11 // size)
        tile = size * np.array(list(np.ndindex(down, across)))[:, ::-1]
        meets = ((screen.min(1) < tile[:, None] + size) & (screen.max(1) > tile[:, None])).all(-1)
        lists = np.append(0, np.cumsum(meets.sum(1))), np.nonzero(meets)[1]
        assert_close(impl.three_passes(screen, z, colours, lists, size, 13, 11), whole)
