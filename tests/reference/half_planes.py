"""An oracle for lab 2's whole meshes: eq. (2) of scanline.py at every pixel, without its rows."""
import numpy as np

from reference.rasterization import bounding_box, is_top_left, screen_points
from reference.scanline import can_be_seen, outcodes, triangle_setup


def half_plane_loop(clip, faces, width, height):
    """Eq. (2), face by face, with all pixels at once and a z-buffer. Slow and obvious.

    clip (V, 4), faces (F, 3) -> face_index, depth (height, width), as `rasterize` gives them. A
    face in front of the camera covers only pixels of its `bounding_box`.
    """
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    px = np.arange(width) + 0.5
    py = np.arange(height)[:, None] + 0.5
    x, y, w = screen_points(clip, width, height)
    points = np.stack([x, y], -1)
    setup = triangle_setup(x, y, clip[:, 2] / w, w, faces.T)
    for f in np.flatnonzero(can_be_seen(outcodes(clip, x, y), faces.T)):
        x0, y0, x1, y1 = 0, 0, width, height
        if (w[faces[f]] > 0).all():
            x0, y0, x1, y1 = bounding_box(points[faces[f]], width, height)
        covered = np.zeros((height, width), bool)
        covered[y0:y1, x0:x1] = True
        for n_x, n_y, from_x, from_y in np.stack(setup.planes)[:, :, f].T:
            e = n_x * (px - from_x) + n_y * (py - from_y)
            covered &= (e > 0) | ((e == 0) & is_top_left(n_x, n_y))
        z = setup.dz_dx[f] * (px - setup.x[f]) + (setup.dz_dy[f] * (py - setup.y[f]) + setup.z[f])
        nearer = covered & (np.abs(z) <= 1) & (z < depth)
        face_index[nearer], depth[nearer] = f, z[nearer]
    return face_index, depth
