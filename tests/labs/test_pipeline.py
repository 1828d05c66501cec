"""What the exercises of lab 9 that join the labs must do."""
import numpy as np
import pytest

from labkit import places
from labkit.checks import Mismatch, assert_close, assert_equal, assert_picture, exercise

GOLDEN = places.ROOT / "tests" / "golden" / "rasterize.npz"
EDGES = (1, 2), (2, 0), (0, 1)  # edge k, opposite to vertex k
WIDTH, HEIGHT = 9, 7
BACKGROUND = np.array([0.3, -0.2])
ALONE = np.array([[0, 1, 2]]), np.full((1, 3), -1)  # faces, opposite
CLIP = np.array([[-0.9, -0.75, 0.2, 1.0], [1.35, -0.8, -0.3, 1.6], [0.1, 0.9, 0.5, 1.2]])
COLOURS = np.array([[0.2, 1.0], [0.9, 0.1], [0.4, 0.7]])


def by_hand(impl, clip, colours):
    """One triangle on BACKGROUND, by a linear system and then pair by pair.

    -> picture, Buffers, and what was decided.
    """
    x, y = np.arange(WIDTH) + 0.5, np.arange(HEIGHT)[:, None] + 0.5
    rays = np.stack(np.broadcast_arrays(2 * x / WIDTH - 1, 2 * y / HEIGHT - 1, 1.0), -1)
    weights = rays @ np.linalg.inv(clip[:, [0, 1, 3]])
    covered = (weights > 0).all(-1)
    barycentric = np.where(covered[..., None], weights / weights.sum(-1, keepdims=True), 0)
    depth = np.where(covered, barycentric @ clip[:, 2] / (barycentric @ clip[:, 3] + ~covered),
                     np.inf)
    colour = np.where(covered[..., None], barycentric @ colours, BACKGROUND)
    corners = (clip[:, :2] / clip[:, 3:] + 1) / 2 * [WIDTH, HEIGHT]
    pairs, decided = pairs_by_hand(impl, covered, corners)
    picture, flat = colour.reshape(-1, 2).copy(), colour.reshape(-1, 2)
    for owner, other, c in zip(*pairs[:3], strict=True):
        picture[owner if c < 0.5 else other] += (0.5 - c) * (flat[other] - flat[owner])
    buffers = impl.Buffers(clip, covered - 1, depth, barycentric, colour, pairs)
    return picture.reshape(colour.shape), buffers, decided


def pairs_by_hand(impl, covered, corners):
    """The Pairs of one triangle that are blended, and what was decided, for each pixel and turn.

    covered (HEIGHT, WIDTH), corners (3, 2) on screen.
    """
    found, decided = [], np.zeros((HEIGHT, WIDTH, 4), int)
    for i, j in np.argwhere(covered):
        for turn, (right, up) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1))):
            k, m = i + up, j + right
            if 0 <= k < HEIGHT and 0 <= m < WIDTH and not covered[k, m]:
                ends = [(corners[[a, b]] - (j + 0.5, i + 0.5))
                        @ np.array([[right, abs(up)], [up, abs(right)]]) for a, b in EDGES]
                places = [crossing(*ends[edge]) for edge in range(3)]
                c = max(places)
                if 0 < c <= 1:
                    edge = places.index(c)
                    decided[i, j, turn] = 1 + 2 * edge + (c > 0.5)
                    found.append((i * WIDTH + j, k * WIDTH + m, c, EDGES[edge], ends[edge][:, 0],
                                  ends[edge][:, 1], 0, edge))
    return pairs_of(impl, found), decided


def pairs_of(impl, found):
    """Lab 8's Pairs, of one tuple for each: owner, other, c, ends, x, y, face, edge."""
    kinds = int, int, float, int, float, float, int, int
    if not found:
        return impl.outlines.Pairs(*(np.zeros((2, 0) if k in (3, 4, 5) else 0, kind)
                                     for k, kind in enumerate(kinds)))
    return impl.outlines.Pairs(*(np.array(values, kind).T for values, kind in
                                 zip(zip(*found, strict=True), kinds, strict=True)))


def crossing(one, other):
    """Where an edge crosses the way from (0, 0) to (1, 0). -1: not steep, or not at all."""
    (x0, y0), (x1, y1) = one, other
    if y0 * y1 >= 0 or abs(y1 - y0) < abs(x1 - x0):
        return -1.0
    return (x0 * y1 - x1 * y0) / (y1 - y0)


# --- there -------------------------------------------------------------------------------------

def bar(width, height, end):
    """A half plane that ends at x = end, in pixels: clip (3, 4)."""
    ndc = 2 * end / width - 1
    return np.array([[ndc, -30.0, 0.25, 1.0], [ndc, 30.0, 0.25, 1.0], [-30.0, 0.0, 0.25, 1.0]])


@pytest.fixture
def white(impl):
    """The Colours of a bar."""
    return impl.Colours(np.ones((3, 1)))


def form(value):
    """"4x6x1": the shape of what was returned. Of a tuple, those of its parts in brackets."""
    if isinstance(value, tuple):
        return f"({', '.join(map(form, value))})"
    return "None" if value is None else "x".join(map(str, np.shape(value))) or "number"


def drawn(impl, *scene):
    """The picture and the buffers that `draw` returns. Mismatch: it is something else."""
    returned = impl.draw(*scene)
    is_drawn = (isinstance(returned, tuple) and len(returned) == 2 and
                isinstance(returned[0], np.ndarray) and isinstance(returned[1], tuple))
    if not is_drawn or len(returned[1]) != 6:
        raise Mismatch(("wrong", "draw must return the picture, and then a tuple of six buffers"))
    return returned


def drawn_pairs(impl, *scene):
    """The pairs in the buffers that `draw` returns, sorted by pixel. Mismatch: there are none."""
    pairs = drawn(impl, *scene)[1][5]
    if not isinstance(pairs, tuple) or len(pairs) != 8:
        kind = "None" if pairs is None else type(pairs).__name__
        raise Mismatch(("wrong", "the last of the buffers must be the pairs that all_pairs "
                                 f"returns, which the way back needs; it is {kind}"))
    return by_pixel(pairs)


def by_pixel(pairs):
    """owner, other, c, ends (2, N), face and edge of pairs, in the order of their pixels."""
    owner, other, c, ends, _, _, face, edge = map(np.asarray, pairs)
    order = np.lexsort((other, owner))
    return tuple(values[..., order] for values in (owner, other, c, ends, face, edge))


@exercise("9.2")
def test_the_picture_comes_first_and_then_the_buffers(impl):
    """Width and height are swapped. The buffers come first and the picture second, or only the
    picture comes, without the buffers. They are those of `visible`, without the colour that `shade`
    adds.
    """
    got = impl.draw(bar(6, 5, 2.5), *ALONE, impl.Colours(np.ones((3, 2))), 6, 5, np.zeros(2))
    if isinstance(got, tuple) and len(got) == 2 and isinstance(got[1], tuple):
        got = got[0], got[1][:5]  # without the pairs
    assert_equal(form(got), "(5x6x2, (3x4, 5x6, 5x6, 5x6x3, 5x6x2))", "shapes of what was returned")


@exercise("9.2")
@pytest.mark.parametrize("end, row", [(1.75, [1.0, 0.75, 0.0, 0.0]), (2.25, [1.0, 1.0, 0.25, 0.0])],
                         ids=["1.75", "2.25"])
def test_the_edge_of_a_bar_is_antialiased(impl, white, end, row):
    """The picture is not antialiased, or is twice. The background is painted over it after
    antialiasing, so that it never blends with the outline. Width and height are swapped.
    """
    picture, _ = drawn(impl, bar(4, 3, end), *ALONE, white, 4, 3, np.zeros(1))
    assert_picture(picture, np.tile(np.array(row)[:, None], (3, 1, 1)), atol=1e-9)


@exercise("9.2")
@pytest.mark.parametrize("end", [1.75, 2.25])
def test_the_buffers_of_a_bar_are_those_before_antialiasing(impl, white, end):
    """The buffer colour is antialiased, too: the way back needs the colour of before. Or the
    buffers come in another order.
    """
    _, buffers = drawn(impl, bar(4, 3, end), *ALONE, white, 4, 3, np.zeros(1))
    _, face_index, depth, *_, colour, _ = buffers
    seen = np.tile(np.array([True, True, False, False]), (3, 1))
    assert_picture(colour, np.where(seen, 1.0, 0.0)[..., None], atol=1e-9)
    assert_picture(face_index, np.where(seen, 0, -1))
    assert_close(depth, np.where(seen, 0.25, np.inf))


@exercise("9.2")
@pytest.mark.parametrize("end", [1.75, 2.25])
def test_the_last_buffer_holds_the_pairs_of_a_bar(impl, white, end):
    """The pairs are left out of the buffers, as those of `shade` are returned. Or they are not the
    blended ones.
    """
    found = drawn_pairs(impl, bar(4, 3, end), *ALONE, white, 4, 3, np.zeros(1))
    # In each row pixel 1 sees the bar, and pixel 2 does not. Edge 2 runs between vertices 0 and 1.
    assert_close(found[:3], ([1, 5, 9], [2, 6, 10], np.full(3, end - 1.5)))
    assert_equal((np.sort(found[3], 0), *found[4:]), (np.repeat([[0], [1]], 3, 1), np.zeros(3, int),
                                                      np.full(3, 2)))


# Two faces at a diagonal, larger than the picture and parallel to the screen.
QUAD = np.array([[-2.0, -1.7, 0.3, 1.0], [2.2, -2.0, 0.1, 1.0], [1.9, 2.3, 0.2, 1.0],
                 [-2.1, 2.0, 0.4, 1.0]])
QUAD_MESH = np.array([[0, 1, 2], [0, 2, 3]]), np.array([[-1, 5, -1], [-1, -1, 1]])
SHADES = np.array([[0.5, 0.3], [0.2, 0.0], [0.0, -0.1]])  # 0.5 + 0.2 x and 0.3 - 0.1 y, in ndc
QUAD_COLOURS = np.column_stack([np.ones(4), QUAD[:, :2]]) @ SHADES


def centres():
    """(1, x, y) of each pixel's centre, in ndc: (HEIGHT, WIDTH, 3)."""
    x, y = 2 * (np.arange(WIDTH) + 0.5) / WIDTH - 1, 2 * (np.arange(HEIGHT) + 0.5) / HEIGHT - 1
    return np.stack(np.broadcast_arrays(1.0, x, y[:, None]), -1)


@exercise("9.2")
def test_inside_of_a_mesh_nothing_is_blended(impl):
    """Each edge is taken for an outline: opposite is not passed on to all_pairs, or all -1."""
    colours = impl.Colours(QUAD_COLOURS)
    picture, _ = drawn(impl, QUAD, *QUAD_MESH, colours, WIDTH, HEIGHT, BACKGROUND)
    assert_picture(picture, centres() @ SHADES, atol=1e-9)


@exercise("9.2")
def test_a_triangle_is_that_of_a_search(impl, rng):
    """Perspective is left out, or the background is another one."""
    colours = rng.uniform(size=(3, 2))
    picture, _ = drawn(impl, CLIP, *ALONE, impl.Colours(colours), WIDTH, HEIGHT, BACKGROUND)
    assert_picture(picture, by_hand(impl, CLIP, colours)[0], atol=1e-9)


@exercise("9.2")
@pytest.mark.parametrize("number", [0, 1, 2, 3, 4],
                         ids=["clip", "face_index", "depth", "barycentric", "colour"])
def test_each_buffer_of_a_triangle_is_that_of_a_search(impl, number):
    """This buffer holds something else, or the buffers come in another order."""
    _, buffers = drawn(impl, CLIP, *ALONE, impl.Colours(COLOURS), WIDTH, HEIGHT, BACKGROUND)
    assert_close(buffers[number], by_hand(impl, CLIP, COLOURS)[1][number])


@exercise("9.2")
def test_the_pairs_of_a_triangle_are_those_of_a_search(impl):
    """They are all neighbours that see different faces, not those that are blended. Or an edge
    inside of a mesh has pairs: opposite is left out.
    """
    found = drawn_pairs(impl, CLIP, *ALONE, impl.Colours(COLOURS), WIDTH, HEIGHT, BACKGROUND)
    expected = by_pixel(by_hand(impl, CLIP, COLOURS)[1].pairs)
    assert_equal((*found[:2], *found[4:]), (*expected[:2], *expected[4:]))
    assert_close(found[2], expected[2])
    colours = impl.Colours(QUAD_COLOURS)
    inside = drawn_pairs(impl, QUAD, *QUAD_MESH, colours, WIDTH, HEIGHT, BACKGROUND)
    assert_equal(len(inside[0]), 0)


@exercise("9.2")
def test_a_texture_of_one_colour_gives_the_picture_of_that_colour(impl):
    """Colours are taken for granted: a texture is not drawn."""
    shade, uv = np.array([0.2, 0.9]), np.array([[0.1, 0.2], [0.8, 0.3], [0.4, 0.9]])
    texture = impl.Texture(uv, ALONE[0], np.tile(shade, (4, 8, 1)), "linear")
    picture, _ = drawn(impl, CLIP, *ALONE, texture, WIDTH, HEIGHT, BACKGROUND)
    assert_picture(picture, by_hand(impl, CLIP, np.tile(shade, (3, 1)))[0], atol=1e-9)


@exercise("9.2")
def test_the_buffers_of_a_cube_are_those_of_nvdiffrast(impl):
    """It is right for a single face alone, or for faces that do not hide each other."""
    golden = np.load(GOLDEN)
    clip, uv = golden["cube_64x64/clip"].astype(float), golden["cube_64x64/uv"].astype(float)
    faces, seen = golden["cube_64x64/faces"].astype(int), golden["cube_64x64/face_index"] >= 0
    expected = np.dstack([uv, 1 - uv.sum(-1)])
    colours = np.array([[0, 1, 2], [3, 5, 4], [6, 1, 9], [2, 8, 0], [5, 5, 1], [7, 0, 3], [1, 4, 4],
                        [9, 2, 6]]) / 9
    # No vertex across: all edges are outlines, and what is inside of a face stays as it is.
    no_opposite = np.full(faces.shape, -1)
    _, buffers = drawn(impl, clip, faces, no_opposite, impl.Colours(colours), 64, 64, np.zeros(3))
    face_index, depth, barycentric, colour = (np.asarray(buffers[k]) for k in (1, 2, 3, 4))
    assert_picture(face_index, golden["cube_64x64/face_index"].astype(int))
    assert_close(depth[seen], golden["cube_64x64/depth"][seen], rtol=0, atol=2e-5)
    assert_close(barycentric[seen], expected[seen], rtol=0, atol=1e-4)
    corners = colours[faces[face_index[seen]]]
    assert_close(colour[seen], (expected[seen][..., None] * corners).sum(1), rtol=0, atol=2e-4)


# --- and back ----------------------------------------------------------------------------------

def gradients(impl, *given):
    """grad_material, grad_clip of `draw_backward`, by default with a grad_depth of 0. Mismatch: it
    returns something else.
    """
    no_depth = [np.zeros(given[0].shape[:2])] if len(given) < 5 else []
    returned = impl.draw_backward(*given, *no_depth)
    if not (isinstance(returned, tuple) and len(returned) == 2 and isinstance(returned[0], tuple)):
        raise Mismatch(("wrong", "draw_backward must return grad_material, and then grad_clip"))
    return returned


def buffers_of_bar(impl, end):
    """`draw`'s buffers of a bar of 4 x 3 pixels, with barycentrics that are easy to add up."""
    seen = np.tile(np.array([True, True, False, False]), (3, 1))
    barycentric = np.where(seen[..., None], [0.5, 0.3, 0.2], 0.0)
    face_index, colour = np.where(seen, 0, -1), np.where(seen, 1.0, 0.0)[..., None]
    # In each row edge 2, from vertex 0 to 1, is end - 1.5 to the right of pixel 1's centre.
    pairs = pairs_of(impl, [
        (4 * row + 1, 4 * row + 2, end - 1.5, (0, 1), (end - 1.5, end - 1.5),
         (-43.5 - row - 0.5, 46.5 - row - 0.5), 0, 2) for row in range(3)])
    return impl.Buffers(bar(4, 3, end), face_index, np.where(seen, 0.25, np.inf), barycentric,
                        colour, pairs)


@exercise("9.3")
def test_the_surfaces_gradient_comes_first_and_then_that_of_clip(impl):
    """The results come in the other order, grad_clip first. grad_material is not the tuple that
    shade_backward returns first. Of grad_clip there are two, not their sum.
    """
    got = impl.draw_backward(np.ones((HEIGHT, WIDTH, 2)), by_hand(impl, CLIP, COLOURS)[1],
                             ALONE[0], impl.Colours(COLOURS), np.zeros((HEIGHT, WIDTH)))
    assert_equal(form(got), "((3x2), 3x4)", "shapes of what was returned")


@exercise("9.3")
@pytest.mark.parametrize("end", [1.75, 2.25])
def test_moving_a_bar_changes_what_it_covers(impl, white, end):
    """grad_clip lacks the path through the edges: a face of one colour has no other gradient. Or it
    is subtracted, not added.
    """
    _, grad_clip = gradients(impl, np.full((3, 4, 1), 5.0), buffers_of_bar(impl, end), ALONE[0],
                             white)
    # Each of the 3 rows covers as much more as the edge moves, and a pixel is 1/2 in clip. Each end
    # moves it by half. x / w falls by x as w grows from 1.
    x = 2 * end / 4 - 1
    assert_close(grad_clip, np.array([[15.0, 0.0, 0.0, -15 * x]] * 2 + [[0.0] * 4]))


@exercise("9.3")
@pytest.mark.parametrize("end", [1.75, 2.25])
def test_a_bar__s_colours_pull_by_how_much_they_cover(impl, white, end):
    """grad_picture goes on to shade_backward: it is grad_colour, after the blend."""
    (grad_colours,), _ = gradients(impl, np.full((3, 4, 1), 5.0), buffers_of_bar(impl, end),
                                   ALONE[0], white)
    assert_close(grad_colours, 5.0 * 3 * end * np.array([[0.5], [0.3], [0.2]]))


# Larger than the picture, parallel to the screen: what is seen is linear in x and y.
WALL = np.array([[-3.0, -2.0, 0.1, 1.0], [4.0, -3.0, 0.4, 1.0], [-1.0, 5.0, -0.2, 1.0]])


def slopes(values):
    """By x and y of clip, how do values (3, C) change on the WALL? (C, 2)"""
    return (np.linalg.inv(WALL[:, [0, 1, 3]])[:2] @ values).T


@exercise("9.3")
def test_moving_a_wall_moves_the_colours_on_it(impl, rng):
    """grad_clip lacks the path through the colours: that of rasterize_backward. No edge is seen
    here.
    """
    grad_picture, buffers = rng.normal(size=(HEIGHT, WIDTH, 2)), by_hand(impl, WALL, COLOURS)[1]
    _, grad_clip = gradients(impl, grad_picture, buffers, ALONE[0], impl.Colours(COLOURS))
    # Where a corner goes, each point goes by its share, and it was there less by the slope.
    pulls = np.einsum("hwc,hwk->kc", grad_picture, buffers.barycentric)
    assert_close(grad_clip[:, :2], -pulls @ slopes(COLOURS))


@exercise("9.3")
def test_inside_of_a_mesh_edges_do_not_pull(impl, rng):
    """Each edge is taken for an outline: not the pairs of the buffers are taken, but others, made
    with an opposite of all -1.
    """
    faces, _ = QUAD_MESH
    ndc, grad_picture = centres(), rng.normal(size=(HEIGHT, WIDTH, 2))
    weights = ndc @ np.linalg.inv(QUAD[faces][..., [3, 0, 1]])[:, None]  # of both faces
    face_index = (weights[1] > 0).all(-1).astype(int)
    barycentric = np.where(face_index[..., None], weights[1], weights[0])
    buffers = impl.Buffers(
        QUAD, face_index, np.full((HEIGHT, WIDTH), 0.2), barycentric, ndc @ SHADES,
        pairs_of(impl, []))
    _, grad_clip = gradients(impl, grad_picture, buffers, faces, impl.Colours(QUAD_COLOURS))
    pulls = np.zeros((4, 2))
    np.add.at(pulls, faces[face_index], barycentric[..., None] * grad_picture[..., None, :])
    assert_close(grad_clip[:, :2], -pulls @ SHADES[1:].T)


@exercise("9.3")
def test_the_depth__s_gradient_reaches_the_vertices(impl, rng):
    """grad_depth is left out, or is not passed on to rasterize_backward."""
    grad_depth, buffers = rng.normal(size=(HEIGHT, WIDTH)), by_hand(impl, WALL, COLOURS)[1]
    _, grad_clip = gradients(impl, np.zeros((HEIGHT, WIDTH, 2)), buffers, ALONE[0],
                             impl.Colours(COLOURS), grad_depth)
    pulls = np.einsum("hw,hwk->k", grad_depth, buffers.barycentric)[:, None]
    assert_close(grad_clip[:, :3], np.hstack([-pulls @ slopes(WALL[:, 2:3]), pulls]))


@exercise("9.3")
def test_the_gradients_of_a_picture_and_its_depth_are_central_differences(impl, gradcheck):
    """One of the two paths is left out, or counts twice. They meet where outlines cut colours.
    """
    def forward(clip, colours):
        picture, buffers, _ = by_hand(impl, clip, colours)
        return picture, np.where(buffers.face_index == 0, buffers.depth, 0.0)

    def backward(grad_picture, grad_depth, clip, colours):
        (grad_colours,), grad_clip = gradients(impl, grad_picture, by_hand(impl, clip, colours)[1],
                                               ALONE[0], impl.Colours(colours), grad_depth)
        return grad_clip, grad_colours

    def decisions(clip, colours):
        _, buffers, decided = by_hand(impl, clip, colours)
        return buffers.face_index, decided

    gradcheck(forward, backward, (CLIP, COLOURS), decisions=decisions, name="draw")


@exercise("9.3")
def test_without_a_depth_there_is_its_gradient_of_0(impl):
    """A grad_depth of None, the default, is not allowed for, or counts as another one than 0."""
    rng = np.random.default_rng(0)  # not drawn: what is always the same passes
    grad_picture, buffers = rng.normal(size=(HEIGHT, WIDTH, 2)), by_hand(impl, CLIP, COLOURS)[1]
    given = grad_picture, buffers, ALONE[0], impl.Colours(COLOURS)
    _, expected = gradients(impl, *given, np.zeros((HEIGHT, WIDTH)))
    _, grad_clip = impl.draw_backward(*given)
    assert_close(grad_clip, expected)


@exercise("9.3")
def test_all_that_a_colour_covers_comes_back_to_its_texture(impl, rng):
    """Colours are taken for granted: a texture has no way back."""
    ones, uv = np.ones((3, 2)), np.array([[0.1, 0.2], [0.8, 0.3], [0.4, 0.9]])
    picture_of_one, buffers, _ = by_hand(impl, CLIP, ones)
    picture_of_zero = by_hand(impl, CLIP, 0 * ones)[0]
    grad_picture = rng.normal(size=(HEIGHT, WIDTH, 2))
    texture = impl.Texture(uv, ALONE[0], np.ones((4, 8, 2)), "linear")
    grad_material, _ = gradients(impl, grad_picture, buffers, ALONE[0], texture)
    assert_close(np.asarray(grad_material[2]).sum((0, 1)),
                 (grad_picture * (picture_of_one - picture_of_zero)).sum((0, 1)))


@exercise("9.3")
def test_a_larger_face_has_a_smaller_footprint(impl):
    """grad_derivatives is dropped on its way from shade_backward to rasterize_backward: the path
    through the footprint of a pixel on its texture.
    """
    width, height = 5, 3
    image = np.array([[1.0, 0.0], [0.0, 0.0]])  # 1/4 on average, and so is all of the next level
    x, y = np.meshgrid((np.arange(width) - 2) * 2 / width, (np.arange(height) - 1) * 2 / height)
    inverse = np.linalg.inv(WALL[:, [0, 1, 3]])
    barycentric = np.stack([x, y, np.ones_like(x)], -1) @ inverse
    # A pixel is 0.3 x 0.2 of 4 x 4 texels: 1.2 texels wide. The middle one sees the first texel.
    uv = WALL[:, :2] * [0.3 * width / 2, 0.2 * height / 2] + 1 / 8
    texture = impl.Texture(uv, ALONE[0], np.tile(image, (2, 2))[..., None], "linear-mipmap-linear")
    level = np.log2(1.2)
    colour = np.full((height, width, 1), 1 - level * 3 / 4)  # right in the middle
    buffers = impl.Buffers(WALL, np.zeros((height, width), int), barycentric @ WALL[:, 2],
                           barycentric, colour, pairs_of(impl, []))
    grad_picture = np.zeros((height, width, 1))
    grad_picture[1, 2] = 8.0
    _, grad_clip = gradients(impl, grad_picture, buffers, ALONE[0], texture)
    # Twice as large about the middle, the wall is seen a level lower: 3/4 more of the texel.
    assert_close((grad_clip * WALL)[:, :2].sum(), 8 * 3 / 4 / np.log(2))
