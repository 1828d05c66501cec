"""What the tests of lab 14 share: two lights, and where their maps see a point."""
import numpy as np
import pytest

# Light from a point and from a direction; their maps are not square.
CONE = np.array([[1.5, 0, 0, 0], [0, 2.0, 0, 0], [0, 0, -1.5, -2.5], [0, 0, -1, 0]])
PARALLEL = np.array([[0.4, 0, 0, 0], [0, 0.7, 0, 0], [0, 0, -0.5, -2.0], [0, 0, 0, 1]])
EACH = {"cone": CONE, "parallel": PARALLEL, "any": CONE + np.diag([0, 0, 0, 0.3])}
each_light = pytest.mark.parametrize("light", EACH.values(), ids=EACH)


def projected(q, light, width, height):
    """By the whole matrix, point by point: x, y in texels (N, 2), depth from -1 to 1 (N,)."""
    clip = np.array([light @ [*point, 1.0] for point in q])
    ndc = clip[:, :3] / clip[:, 3:]
    return (ndc[:, :2] + 1) * [width / 2, height / 2], ndc[:, 2]


def point_at(x, y, distance, light, width, height):
    """The point of the light's frame that lies at (x, y) of the map, at this distance."""
    w = light[3, 3] - light[3, 2] * distance
    return np.array([(2 * x / width - 1) * w / light[0, 0], (2 * y / height - 1) * w / light[1, 1],
                     -distance])
