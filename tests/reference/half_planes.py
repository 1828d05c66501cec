"""An oracle for lab 2's whole meshes: each face at every pixel, by the definition of its planes."""
import numpy as np

from reference.rasterization import bounding_box, is_top_left, screen_points
from reference.scanline import can_be_seen, outcodes


def half_plane_loop(clip, faces, width, height):
    """Eq. (2) of scanline.py, face by face, with a z-buffer, and without rows. Slow and obvious.

    clip (V, 4), faces (F, 3) -> face_index, depth (height, width), as `rasterize` gives them. A
    face in front of the camera covers only pixels of its `bounding_box`.
    """
    face_index = np.full((height, width), -1)
    depth = np.full((height, width), np.inf)
    px, py = np.arange(width) + 0.5, np.arange(height)[:, None] + 0.5
    x, y, w = screen_points(clip, width, height)
    z = clip[:, 2] / w
    for f in np.flatnonzero(can_be_seen(outcodes(clip, x, y), faces.T)):
        p, q, r = np.roll(faces[f], -np.argmax(np.abs(w[faces[f]])))
        x1, y1, z1, x2, y2, z2 = (v[k] - v[p] for k in (q, r) for v in (x, y, z))
        area = x1 * y2 - x2 * y1
        x_min, y_min, x_max, y_max = 0, 0, width, height
        if (w[faces[f]] > 0).all():
            x_min, y_min, x_max, y_max = bounding_box(np.stack([x, y], -1)[faces[f]], width, height)
        covered = np.zeros((height, width), bool)
        covered[y_min:y_max, x_min:x_max] = True
        for s, t, other in (q, r, p), (r, p, q), (p, q, r):
            base = max((s, t), key=lambda v: (abs(w[v]), -x[v], -y[v]))  # both faces' end
            sign = np.sign(area) * np.sign(w[other])
            n_x, n_y = sign * (y[s] - y[t]), sign * (x[t] - x[s])
            e = n_x * (px - x[base]) + n_y * (py - y[base])
            covered &= (e > 0) | ((e == 0) & is_top_left(n_x, n_y))
        d = (z1 * y2 - z2 * y1) / area * (px - x[p]) \
            + ((x1 * z2 - x2 * z1) / area * (py - y[p]) + z[p])
        nearer = covered & (np.abs(d) <= 1) & (d < depth)
        face_index[nearer], depth[nearer] = f, d[nearer]
    return face_index, depth
