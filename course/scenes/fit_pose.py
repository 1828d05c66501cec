"""The pose of a known cube, from one picture (lab 9): random search, then Adam.

The cube has 24 vertices, so that each side has a colour of its own.
"""
import numpy as np

from .drawing import descended, on_black
from .fit_cube import CORNERS, HALVES, SQUARES, camera

BLOCK = CORNERS[SQUARES].reshape(24, 3) - 0.5
FACES = np.arange(24).reshape(6, 4)[:, HALVES].reshape(12, 3)
COLOURS = np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1],
                    [1, 1, 0], [1, 0, 1], [0, 1, 1]]).repeat(4, 0)


def fit(labs, seed, proposals=400, allowed=None, stages=((64, 40, 5e-3), (256, 40, 3e-4))):
    """A cube's rotation, from one picture: greedy random search, in pictures of 16 x 16, then Adam,
    in each stage (size, steps, first rate).

    allowed (K, 4) are rotations to try beside small ones, `symmetries` if None.
    -> rotations (proposals + all steps + 1, 4), quaternions from start to end, and the goal (4,).
    """
    rng = np.random.default_rng(seed)
    start, goal = (q / np.linalg.norm(q) for q in rng.normal(size=(2, 4)))
    allowed = symmetries() if allowed is None else allowed
    rotations = search(labs, rng, start, goal, proposals, allowed)
    for size, steps, rate in stages:
        rotations += descent(labs, rotations[-1], goal, size, steps, rate)
    return np.array(rotations), goal


def search(labs, rng, start, goal, proposals, allowed):
    """Greedy: a proposed rotation is taken if it brings the picture nearer to the goal's.

    Proposals become smaller and smaller. Every second one contains an allowed rotation as well.
    """
    lab9, rotations = labs.inverse_rendering, [start]
    target = seen(labs, goal, 16)[0]
    least, _ = lab9.squared_error(seen(labs, start, 16)[0], target)
    for n in range(proposals):
        half_angle = np.pi / 2 * rng.uniform() * 0.01**(n / proposals)
        axis = rng.normal(size=3)
        axis *= np.sin(half_angle) / np.linalg.norm(axis)
        proposal = lab9.quaternion_product(rotations[-1], np.append(np.cos(half_angle), axis))
        if n % 2:
            symmetry = allowed[rng.integers(len(allowed))]
            proposal = lab9.quaternion_product(proposal, symmetry)
        loss, _ = lab9.squared_error(seen(labs, proposal, 16)[0], target)
        rotations.append(proposal if loss < least else rotations[-1])
        least = min(loss, least)
    return rotations


def descent(labs, q, goal, size, steps, rate):
    """Adam on the quaternion, in pictures of size x size. The rate falls to a 50th."""
    lab9, target = labs.inverse_rendering, seen(labs, goal, size)[0]

    def gradient(q):
        picture, *given = seen(labs, q, size)
        loss, grad_picture = lab9.squared_error(picture, target)
        grad_matrix = labs.pipeline.render_backward(grad_picture, *given).clip_from_model
        return loss, lab9.quaternion_matrix_backward(camera(labs).T @ grad_matrix, q)

    path, _ = descended(labs, q, gradient, lab9.decay(rate, 0.02, steps),
                      project=lambda q: q / np.linalg.norm(q))
    return path[1:]


def seen(labs, q, size):
    """The cube with coloured sides, rotated by q: its picture, and what `render_backward` takes."""
    clip_from_model = camera(labs) @ labs.inverse_rendering.quaternion_matrix(q)
    return on_black(labs, labs.pipeline.make_mesh(BLOCK, FACES), COLOURS, clip_from_model, size)


def symmetries():
    """The 24 rotations that bring a cube back to itself, as quaternions (24, 4)."""
    signs = np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, -1).T
    thirds = np.concatenate([np.ones((8, 1)), signs], 1)  # about a diagonal
    pairs = [np.eye(4)[i] + sign * np.eye(4)[j] for i in range(4) for j in range(i) for sign in
             (-1, 1)]
    found = np.concatenate([np.eye(4), thirds, pairs])
    return found / np.linalg.norm(found, axis=1, keepdims=True)
