"""What the exercises of lab 7's whole meshes must do."""
import numpy as np
import pytest

from labkit.checks import assert_close, exercise

# --- whole meshes ------------------------------------------------------------------------------

@exercise("7.7")
def test_six_gradients_of_two_pixels_on_paper(impl):
    """A corner has the gradient of one of its two edges alone, as by = in place of +=. A sign: that
    of one of the two terms of e_k, or of all. x and y are exchanged, or grad_x and grad_y. Edge k
    is not across from corner k, or edge 1 is not that from 2 to 0.
    """
    x = np.array([[3.0, -1.0], [4.0, 6.0], [2.0, 0.5]])
    y = np.array([[2.0, 7.0], [1.0, -3.0], [5.0, 8.0]])
    grad_e = np.array([[1.0, 2.0], [3.0, -1.0], [-2.0, 4.0]])
    # The first pixel: x_0 is in e_1 by -y_2 and in e_2 by y_1, which is 3 (-5) + -2 (1).
    expected = ([[-17.0, -4.0], [9.0, -12.0], [5.0, -1.0]],
                [[14.0, -24.5], [-8.0, -5.0], [-5.0, 11.0]])
    assert_close(impl.edge_functions_at_backward(grad_e, x, y), expected)


@exercise("7.7")
def test_each_edge_alone_on_paper(impl):
    """An edge is that of other corners, or of one of its two only; a flipped sign. Or a pixel gets
    what is another's.
    """
    x = np.array([[1.0, 3.0, -1.0], [2.0, 4.0, 6.0], [5.0, 2.0, 0.5]])
    y = np.array([[3.0, 2.0, 7.0], [7.0, 1.0, -3.0], [4.0, 5.0, 8.0]])
    # e_0 = x_1 y_2 - y_1 x_2, then twice e_1 = x_2 y_0 - y_2 x_0, then -3 e_2, x_0 y_1 - y_0 x_1
    expected = ([[0.0, -10.0, 9.0], [4.0, 0.0, 21.0], [-7.0, 4.0, 0.0]],
                [[0.0, 4.0, 18.0], [-5.0, 0.0, 3.0], [2.0, -6.0, 0.0]])
    assert_close(impl.edge_functions_at_backward(np.diag([1.0, 2.0, -3.0]), x, y), expected)


@exercise("7.7")
@pytest.mark.parametrize("count", [1, 5])
def test_the_gradients_of_edges_at_pixels_are_central_differences(impl, rng, count, gradcheck):
    """A corner gets the gradient of one of its two edges alone, or another pixel's. Or it is right
    for as many pixels as there are corners.
    """
    def forward(x, y):
        return np.stack([x[i] * y[j] - y[i] * x[j] for i, j in [(1, 2), (2, 0), (0, 1)]])

    gradcheck(forward, impl.edge_functions_at_backward, tuple(rng.normal(size=(2, 3, count))),
              name=f"{count} pixels")


# --- pictures of weights -----------------------------------------------------------------------

# Seen from the middle, e = (3, 1, 4) by eq. (9), for any w.
CORNERS = np.array([[3.0, -2.0, 0.5, 2.0], [-1.0, 2.0, 0.25, 0.5], [-2.0, 1.0, -0.5, 3.0]])
FACE = np.array([[0, 1, 2]])
PULLED = np.array([[-4.5, -5.25, 0.0, 0.0], [-1.5, -1.75, 0.0, 0.0], [-6.0, -7.0, 0.0, 0.0]])

# Two faces that share an edge, with a vertex behind the camera, and two more vertices.
CLIP = np.array([[-0.7, -0.5, 0.1, 1.0], [2.1, 0.3, -0.4, 2.5], [0.4, 1.9, 0.6, 1.6],
                 [-1.4, 1.1, 0.3, -0.6], [0.2, 0.9, 0.7, 1.0]])
FACES = np.array([[0, 1, 2], [2, 1, 3]])
SEEN = np.array([0, -1, 0, 1, 0, 1, -1, 1, 1, 0])


def solved(seen, clip):
    """c (N, 3) of the N pixels that see a face, which solves M c = a."""
    height, width = seen.shape
    i, j = np.nonzero(seen >= 0)
    a = np.stack([(2 * j + 1) / width - 1, (2 * i + 1) / height - 1, 1 + 0 * i], -1)
    m = np.swapaxes(clip[FACES[seen[i, j]]][..., [0, 1, 3]], 1, 2)
    return np.linalg.solve(m, a[..., None])[..., 0]


@exercise("7.8")
def test_the_middle_pixel_pulls_at_its_corners_on_paper(impl):
    """A sign, or x and y exchanged. Edge k is not across from corner k, or a corner gets the
    gradient of one of its two edges alone. It is not divided by s, or twice. z gets a gradient.
    """
    # 3 * 8 + 1 * 16 - 4 * 10 = 0: s has no share, and grad_e = grad_b / 8
    grad_b = np.array([[[8.0, 16.0, -10.0]]])
    assert_close(impl.barycentrics_backward(grad_b, np.zeros((1, 1), int), CORNERS, FACE), PULLED)


@exercise("7.8")
def test_what_all_three_weights_gain_changes_nothing(impl):
    """The share of the sum s is left out: b sums to 1 wherever the corners are. Or its sign."""
    grad_b = np.array([[[32.0, 40.0, 14.0]]])  # 24 more for each
    assert_close(impl.barycentrics_backward(grad_b, np.zeros((1, 1), int), CORNERS, FACE), PULLED)


@exercise("7.8")
def test_a_clockwise_face_is_pulled_alike(impl):
    """The sign of s is lost, or c stands for b."""
    grad_b = np.array([[[14.0, 40.0, 32.0]]])  # corner 2 comes first
    got = impl.barycentrics_backward(grad_b, np.zeros((1, 1), int), CORNERS, FACE[:, ::-1])
    assert_close(got, PULLED)


@exercise("7.8")
def test_w_gets_a_share_of_x_and_of_y(impl):
    """w is taken for a constant, or only x - X w is remembered, or only y - Y w. The sign, or X and
    Y exchanged. A vertex's w moves its corner by -X and -Y.
    """
    grad_b, seen = np.zeros((2, 4, 3)), np.full((2, 4), -1)
    grad_b[1, 2], seen[1, 2] = [8.0, 16.0, -10.0], 0  # X = 1/4, Y = 1/2
    grad_x, grad_y, _, grad_w = np.transpose(
        impl.barycentrics_backward(grad_b, seen, CORNERS, FACE))
    assert (np.abs(grad_x + grad_y) > 0.1).all()
    assert_close(grad_w, -grad_x / 4 - grad_y / 2)


@exercise("7.8")
def test_a_vertex_sums_what_all_its_pixels_say(impl, rng):
    """A pixel overwrites what another one said, as by = or by grad[vertex] += for np.add.at."""
    grad_b, seen, pixels = rng.normal(size=(2, 5, 3)), SEEN.reshape(2, 5), np.arange(10)
    alone = [impl.barycentrics_backward(grad_b, np.where(pixels.reshape(2, 5) == one, seen, -1),
                                        CLIP, FACES) for one in pixels]
    together = impl.barycentrics_backward(grad_b, seen, CLIP, FACES)
    assert np.abs(together[:4, [0, 1, 3]]).min() > 1e-3
    assert_close(together, np.sum(alone, 0), atol=1e-9)


@exercise("7.8")
@pytest.mark.parametrize("height, width", [(2, 5), (5, 2)])
def test_the_gradients_of_pictures_are_central_differences(impl, height, width, gradcheck):
    """Rows and columns are exchanged, or grad_b is another pixel's. Right for one face, or for
    vertices before the camera alone.
    """
    seen = SEEN.reshape(height, width)

    def forward(clip):
        c = solved(seen, clip)
        return c / c.sum(-1, keepdims=True)

    def backward(grad, clip):
        picture = np.full((height, width, 3), 7.0)  # where no face is seen, it counts for nothing
        picture[seen >= 0] = grad
        return impl.barycentrics_backward(picture, seen, clip, FACES)

    gradcheck(forward, backward, (CLIP,), name="barycentrics")


@exercise("7.8")
@pytest.mark.parametrize("winding", [1, -1])
def test_epsilon_makes_the_divisor_larger(impl, winding):
    """epsilon is left out of b = e / d or of 1 / d, or it makes a negative sum smaller."""
    grad_b = np.array([[[32.0, 48.0, 24.0]]])[..., ::winding]
    got = impl.barycentrics_backward(grad_b, np.zeros((1, 1), int), CORNERS, FACE[:, ::winding], 8)
    # d = 16, b = (3, 1, 4) / 16, grad_b . b = 15, grad_e = (17, 33, 9) / 16
    grad_x, grad_y = [[-15, 35, -100], [-57, 61, -116]]
    assert_close(16 * got, np.transpose([grad_x, grad_y, [0, 0, 0], [0, 0, 0]]))
