"""An exam on paper: `.venv/bin/python -m teaching.exam 7` prints it, its answers and its rubric.

Another seed gives other numbers. What exam.md has in braces are the variables of the two functions
below, and the reference computes what comes out.
"""
import sys
from pathlib import Path

import numpy as np

from course.given.whose import Labs

TEXT = Path(__file__).with_name("exam.md")
labs = Labs("reference")


def early(rng):
    """{name: value} of labs 1 to 4."""
    point = rng.integers([1, -2, -5], [4, 0, -1]) * 1.0
    view = labs.transforms.perspective(np.pi / 2, 2.0, 1.0, 10.0)
    screen = labs.transforms.project(point[None], view, 200, 100)[0]
    clip, pull = rng.integers(1, [7, 7, 7, 3]) * [1.0, 1, 1, 2], 4.0 * rng.integers(1, 4)
    to_clip = labs.transforms.to_screen_backward(np.array([pull, 0, 0]), clip, 2, 2)
    a, way = rng.integers(0, 6, 2), 2 * rng.integers(1, 5, 2) * rng.choice([-1, 1], 2)
    b, p = a + way, a + way // 2 + [0, rng.integers(1, 5)]
    e = labs.rasterization.edge_function(p, a, b)
    owner = "A" if labs.rasterization.is_top_left(-way[1], way[0]) else "B"
    spokes, turns = rng.integers([4, 2], [9, 6])
    seen = labs.sampling.alias_frequency(spokes * turns, 25) / spokes
    light, slope = rng.permutation(np.arange(1, 9))[:3, None] / 10, 4.0 * rng.integers(1, 6)
    samples = light[:2], np.array([0, 0, 1, -1]).reshape(4, 1, 1), light[2]
    pixel = labs.msaa.resolve(*samples)[0, 0, 0]
    to_shade, to_back = labs.msaa.resolve_backward(np.full((1, 1, 1), slope), *samples)
    return locals()


def late(rng):
    """{name: value} of labs 5 to 8."""
    near, far = rng.integers([1, 4], [4, 10])
    share = labs.interpolation.fraction_in_space(0.5, near, far)
    jacobian = np.array([[3.0, 0], [4, 5]]) * 2.0 ** rng.integers(-1, 3)
    level = labs.mipmapping.mip_level(jacobian[None], 1, 1)[0]
    (right, up), values = rng.integers(3, 7, 2), 12.0 * rng.permutation(6)[:3]
    matrix = labs.vertex_gradients.vertex_matrix(np.array([[0, 0], [right, 0], [0, up]]))
    weights, to_matrix, to_pixel, _ = labs.vertex_gradients.residual_backward(
        1.0, values, matrix, np.ones(3), 0.0)
    fast = np.hypot(*to_pixel[:2])
    ends = rng.choice([0.0, 0.1, 0.6, 0.7]) + [0, 0.2], rng.integers(3, 9, 2) * [0.1, -0.1]
    (x_0, x_1), (y_0, y_1) = ends
    c = labs.antialiasing.crossing(x_0, y_0, x_1, y_1)
    shades, pulls = rng.permutation(np.arange(1, 10))[:2] / 10, rng.integers(1, 6, 2)
    changed, difference = int(c > 0.5), shades[1] - shades[0]  # 0 is the owner
    blended, to_c = shades[changed] + (0.5 - c) * difference, -pulls[changed] * difference
    return locals()


def paper(seed):
    """The text of exam.md, with the numbers of this seed."""
    rng = np.random.default_rng(seed)
    return TEXT.read_text("utf-8").format(**{"seed": seed} | early(rng) | late(rng))


if __name__ == "__main__":
    print(paper(int(sys.argv[1])))
