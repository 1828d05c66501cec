"""What is given in lab 2: where vertices are on the screen."""
import numpy as np

from labkit.checks import assert_close


def test_a_vertex_in_the_camera_plane_lies_far_out(impl):
    """A division by zero, or a least w that does not go with the unit of clip space."""
    clip = np.array([[1.0, -1.0, 0.0, 0.0], [0.5, -1.0, 0.0, 1e-12], [1.0, -0.2, 0.0, -1e-12],
                     [-1.0, 0.3, 0.0, 0.0]])
    for unit in 1e-13, 1.0, 1e5:
        x, y, w = impl.screen_points(unit * clip, 8, 4)
        assert_close(w / unit, [1e-10, 1e-10, -1e-10, 1e-10], given=f"clip scaled by {unit}")
        assert_close(x, [4e10, 2e10, -4e10, -4e10], rtol=1e-6)
        assert_close(y, [-2e10, -2e10, 4e9, 6e9], rtol=1e-6)
