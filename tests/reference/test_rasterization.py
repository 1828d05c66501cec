"""Whole pictures of lab 2: the textbook's rasterizer beside the exact one."""
from pathlib import Path

import numpy as np
import pytest

from labkit.checks import assert_close
from reference import rasterization

GOLDEN = np.load(Path(__file__).parents[1] / "golden" / "rasterize.npz")


@pytest.mark.parametrize("scene", ["single_tri_64x64", "cube_64x64"])
def test_the_textbooks_picture_is_that_of_nvdiffrast(scene):
    """Another face or depth than nvdiffrast's kernels give."""
    clip, faces = GOLDEN[f"{scene}/clip"].astype(float), GOLDEN[f"{scene}/faces"].astype(int)
    expected = GOLDEN[f"{scene}/face_index"]
    face_index, depth = rasterization.rasterize.written(clip, faces, *expected.shape[::-1])
    np.testing.assert_array_equal(face_index, expected)
    seen = expected >= 0
    np.testing.assert_allclose(depth[seen], GOLDEN[f"{scene}/depth"][seen], rtol=0, atol=2e-5)


def test_a_vertex_in_the_camera_plane_lies_far_out(impl):
    """A division by zero, or a least w that does not go with the unit of clip space."""
    clip = np.array([[1.0, -1.0, 0.0, 0.0], [0.5, -1.0, 0.0, 1e-12], [1.0, -0.2, 0.0, -1e-12],
                     [-1.0, 0.3, 0.0, 0.0]])
    for unit in 1e-13, 1.0, 1e5:
        x, y, w = impl.screen_points(unit * clip, 8, 4)
        assert_close(w / unit, [1e-10, 1e-10, -1e-10, 1e-10], given=f"clip scaled by {unit}")
        assert_close(x, [4e10, 2e10, -4e10, -4e10], rtol=1e-6)
        assert_close(y, [-2e10, -2e10, 4e9, 6e9], rtol=1e-6)
