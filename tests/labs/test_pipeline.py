"""What the exercises of lab 9 that join the labs must do."""
import numpy as np

from course.checks import assert_close, assert_equal, assert_picture, exercise
from course.given import places
from course.given.gradcheck import gradcheck

GOLDEN = places.ROOT / "tests" / "golden" / "rasterize.npz"
EDGES = (1, 2), (2, 0), (0, 1)  # edge k, opposite to vertex k
WIDTH, HEIGHT = 9, 7
BACKGROUND = np.array([0.3, -0.2])
ALONE = np.array([[0, 1, 2]]), np.full((1, 3), -1)  # faces, opposite
CLIP = np.array([[-0.9, -0.75, 0.2, 1.0], [1.35, -0.8, -0.3, 1.6], [0.1, 0.9, 0.5, 1.2]])
COLOURS = np.array([[0.2, 1.0], [0.9, 0.1], [0.4, 0.7]])


def by_hand(clip, colours):
    """One triangle on BACKGROUND, by a linear system and then pair by pair.

    -> picture, Buffers as a tuple, and what was decided.
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
    picture, decided = colour.copy(), np.zeros((HEIGHT, WIDTH, 4), int)
    for i, j in np.argwhere(covered):
        for turn, (right, up) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1))):
            k, m = i + up, j + right
            if 0 <= k < HEIGHT and 0 <= m < WIDTH and not covered[k, m]:
                found = [crossing(corners[[a, b]] - (j + 0.5, i + 0.5), right, up)
                         for a, b in EDGES]
                c = max(found)
                if 0 < c <= 1:
                    decided[i, j, turn] = 1 + 2 * found.index(c) + (c > 0.5)
                    target = (i, j) if c < 0.5 else (k, m)
                    picture[target] += (0.5 - c) * (colour[k, m] - colour[i, j])
    return picture, (clip, covered - 1, depth, barycentric, None, colour), decided


def crossing(ends, right, up):
    """Where an edge crosses the way from (0, 0) to (right, up). -1: not steep, or not at all."""
    (x0, y0), (x1, y1) = ends @ np.array([[right, abs(up)], [up, abs(right)]])
    if y0 * y1 >= 0 or abs(y1 - y0) < abs(x1 - x0):
        return -1.0
    return (x0 * y1 - x1 * y0) / (y1 - y0)


# --- there -------------------------------------------------------------------------------------

def bar(width, height, end):
    """A half plane that ends at x = end, in pixels: clip (3, 4)."""
    ndc = 2 * end / width - 1
    return np.array([[ndc, -30.0, 0.25, 1.0], [ndc, 30.0, 0.25, 1.0], [-30.0, 0.0, 0.25, 1.0]])


@exercise("9.12")
def test_a_bar_on_paper(impl):
    """The picture is not antialiased, or the buffer colour is; width and height are swapped."""
    for end, expected in (1.75, [1.0, 0.75, 0.0, 0.0]), (2.25, [1.0, 1.0, 0.25, 0.0]):
        picture, buffers = impl.draw(bar(4, 3, end), *ALONE, (np.ones((3, 1)),), 4, 3, np.zeros(1))
        assert_picture(picture, np.tile(np.array(expected)[:, None], (3, 1, 1)), atol=1e-9)
        _, face_index, depth, _, _, colour = buffers
        seen = np.tile(np.array([True, True, False, False]), (3, 1))
        assert_picture(face_index, np.where(seen, 0, -1))
        assert_close(depth, np.where(seen, 0.25, np.inf))
        assert_picture(colour, np.where(seen, 1.0, 0.0)[..., None], atol=1e-9)


@exercise("9.12")
def test_a_triangle_is_that_of_a_search(impl):
    """Perspective is left out, or the background, or the order of the buffers is another one."""
    picture, buffers = impl.draw(CLIP, *ALONE, (COLOURS,), WIDTH, HEIGHT, BACKGROUND)
    expected, buffers_expected, _ = by_hand(CLIP, COLOURS)
    assert_picture(picture, expected, atol=1e-9)
    assert_equal(len(buffers), 6)
    for k in 0, 1, 2, 3, 5:
        assert_close(buffers[k], buffers_expected[k])


@exercise("9.12")
def test_a_texture_of_one_colour_gives_the_picture_of_that_colour(impl):
    """Colours are taken for granted: a texture is not drawn."""
    shade, uv = np.array([0.2, 0.9]), np.array([[0.1, 0.2], [0.8, 0.3], [0.4, 0.9]])
    texture = uv, ALONE[0], np.tile(shade, (4, 8, 1)), "linear"
    picture, buffers = impl.draw(CLIP, *ALONE, texture, WIDTH, HEIGHT, BACKGROUND)
    assert_picture(picture, by_hand(CLIP, np.tile(shade, (3, 1)))[0], atol=1e-9)
    assert_equal(np.shape(buffers[4]), (HEIGHT, WIDTH, 3, 2))


@exercise("9.12")
def test_the_buffers_of_a_cube_are_those_of_nvdiffrast(impl):
    """Right for a single face alone."""
    golden = np.load(GOLDEN)
    clip, uv = golden["cube_64x64/clip"].astype(float), golden["cube_64x64/uv"].astype(float)
    faces, seen = golden["cube_64x64/faces"].astype(int), golden["cube_64x64/face_index"] >= 0
    expected = np.dstack([uv, 1 - uv.sum(-1)])
    colours = np.array([[0, 1, 2], [3, 5, 4], [6, 1, 9], [2, 8, 0], [5, 5, 1], [7, 0, 3], [1, 4, 4],
                        [9, 2, 6]]) / 9
    # No vertex across: all edges are outlines, and what is inside of a face stays as it is.
    _, buffers = impl.draw(clip, faces, np.full(faces.shape, -1), (colours,), 64, 64, np.zeros(3))
    _, face_index, depth, barycentric, _, colour = map(np.asarray, buffers)
    assert_picture(face_index, golden["cube_64x64/face_index"].astype(int))
    assert_close(depth[seen], golden["cube_64x64/depth"][seen], rtol=0, atol=2e-5)
    assert_close(barycentric[seen], expected[seen], rtol=0, atol=1e-4)
    corners = colours[faces[face_index[seen]]]
    assert_close(colour[seen], (expected[seen][..., None] * corners).sum(1), rtol=0, atol=2e-4)


# --- and back ----------------------------------------------------------------------------------

@exercise("9.13")
def test_moving_a_bar_changes_what_it_covers(impl):
    """The path through the edges is left out: a face of one colour has no other gradient."""
    for end in 1.75, 2.25:
        seen = np.tile(np.array([True, True, False, False]), (3, 1))
        barycentric = np.where(seen[..., None], np.full(3, 1 / 3), 0.0)
        buffers = (bar(4, 3, end), np.where(seen, 0, -1), np.where(seen, 0.25, np.inf), barycentric,
                   None, np.where(seen, 1.0, 0.0)[..., None])
        grad_surface, grad_clip = impl.draw_backward(
            np.full((3, 4, 1), 5.0), buffers, *ALONE, (np.ones((3, 1)),))
        # Each of the 3 rows covers as much more as the edge moves, and a pixel is 1/2 in clip.
        assert_close(np.asarray(grad_clip)[:2, 0].sum(), 5.0 * 3 * 2)
        assert_close(np.asarray(grad_surface[0]).sum(), 5.0 * 3 * end)


@exercise("9.13")
def test_the_gradients_of_a_picture_and_its_depth_are_central_differences(impl):
    """One of the two paths is left out, or the picture's gradient is shaded where the colour's
    should be; grad_depth is dropped.
    """
    def forward(clip, colours):
        picture, buffers, _ = by_hand(clip, colours)
        return picture, np.where(buffers[1] == 0, buffers[2], 0.0)

    def backward(grad_picture, grad_depth, clip, colours):
        grad_surface, grad_clip = impl.draw_backward(
            grad_picture, by_hand(clip, colours)[1], *ALONE, (colours,), grad_depth)
        return grad_clip, grad_surface[0]

    def decisions(clip, colours):
        _, buffers, decided = by_hand(clip, colours)
        return buffers[1], decided

    gradcheck(forward, backward, (CLIP, COLOURS), decisions=decisions, name="draw")


@exercise("9.13")
def test_without_a_depth_there_is_its_gradient_of_0(impl, rng):
    """grad_depth is needed, or its default is not None."""
    grad_picture, buffers = rng.normal(size=(HEIGHT, WIDTH, 2)), by_hand(CLIP, COLOURS)[1]
    given = grad_picture, buffers, *ALONE, (COLOURS,)
    _, expected = impl.draw_backward(*given, np.zeros((HEIGHT, WIDTH)))
    _, grad_clip = impl.draw_backward(*given)
    assert_close(grad_clip, expected)


@exercise("9.13")
def test_all_that_a_colour_covers_comes_back_to_its_texture(impl, rng):
    """Colours are taken for granted: a texture has no way back."""
    ones, uv = np.ones((3, 2)), np.array([[0.1, 0.2], [0.8, 0.3], [0.4, 0.9]])
    _, (*seen, _, colour), _ = by_hand(CLIP, ones)
    picture_of_one = by_hand(CLIP, ones)[0]
    picture_of_zero = by_hand(CLIP, 0 * ones)[0]
    grad_picture = rng.normal(size=(HEIGHT, WIDTH, 2))
    texture = uv, ALONE[0], np.ones((4, 8, 2)), "linear"
    derivatives = np.zeros((HEIGHT, WIDTH, 3, 2))  # the filter "linear" does not look at them
    grad_surface, _ = impl.draw_backward(grad_picture, (*seen, derivatives, colour), *ALONE,
                                         texture)
    assert_close(np.asarray(grad_surface[2]).sum((0, 1)),
                 (grad_picture * (picture_of_one - picture_of_zero)).sum((0, 1)))
