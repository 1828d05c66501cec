"""Pictures so small that each pixel counts: what larger ones do not show of a rasterizer."""
import numpy as np

from ..given import mesh, plot
from .drawing import enlarged, save
from .viewing import BUNNY_EYE, clip_from_world

WIDTH, HEIGHT = 18, 14
PIXELS = [29, 28, 10, 18, 28, 36]  # left and lower edges, the first of equally deep faces


def ties(labs):
    """Squares with corners on pixels' centres: each centre belongs to one face (lab 2)."""
    corners, faces = squares()
    face_index, _ = labs.rasterization.rasterize(on_screen(corners), faces, WIDTH, HEIGHT)
    counts = np.bincount(face_index[face_index >= 0], minlength=6).tolist()
    yield (f"each face has its pixels: {counts}",
           save("ties", "face_index", enlarged(plot.face_colours(face_index), 16)),
           (f"{PIXELS}", counts == PIXELS))


def borders(labs):
    """Squares and a fine ball: blended at open borders and outlines, and not within (lab 8)."""
    corners, faces = squares()
    shades = np.array([1.0, 0.8, 0.4, 0.5, 0.7, 0.6, 0.0])
    picture = blended(labs, on_screen(corners + [0.3, 0.2, 0]), faces, shades, (WIDTH, HEIGHT))
    left = picture[5, 1:3]
    yield (f"borders are blended, diagonals are not: {left[0]:.2f} and {left[1]:.2f} at the left",
           save("borders", "blended", enlarged(picture, 16)),
           ("0.16 and 0.80", np.allclose(left, [0.16, 0.8])))
    vertices, faces = mesh.icosphere(5000)
    clip = np.column_stack([vertices, np.ones(len(vertices))]) @ camera(labs).T
    picture = blended(labs, clip, faces, np.append(np.ones(len(faces)), 0), (40, 40))
    yield ("a ball of 5,120 faces, smooth all around",
           save("borders", "ball", enlarged(picture, 8)))


def blended(labs, clip, faces, shades, size):
    """A picture of a shade for each face, and one for none, antialiased."""
    face_index, depth = labs.rasterization.rasterize(clip, faces, *size)
    pairs = labs.outline_walk.walked_pairs(face_index, depth, clip, faces,
                                           labs.antialiasing.opposite_corners(faces))
    return labs.antialiasing.blend_pairs(shades[face_index][..., None], pairs)[..., 0]


def cut(labs):
    """A ball that the near plane cuts and the far plane closes: one sees into it (lab 2)."""
    vertices, faces = mesh.icosphere(1280)
    clip = np.column_stack([vertices, np.ones(len(vertices))]) @ camera(labs, aspect=1.25).T
    face_index, depth = labs.rasterization.rasterize(clip, faces, 160, 128)
    yield ("inside of the hole one sees the back of the ball",
           save("cut", "face_index", enlarged(plot.face_colours(face_index), 4)))
    yield ("depth", save("cut", "depth", enlarged(plot.depth_colours(depth), 4)),
           ("from -1 to 1", (np.abs(depth[face_index >= 0]) <= 1).all()))


def on_screen(corners):
    """corners (V, 3) in pixels and depth -> clip (V, 4)."""
    return np.insert(corners / [WIDTH / 2, HEIGHT / 2, 1] - [1, 1, 0], 3, 1, axis=1)


def squares():
    """corners (12, 3) in pixels and depth, faces (6, 3): the second square lies upon the first, as
    deep, and the third, clockwise, before both.
    """
    x, y = np.array([[1.5, 9.5, 9.5, 1.5], [1.5, 1.5, 9.5, 9.5]])
    depth = np.repeat([0.5, 0.5, -0.5], 4)
    corners = np.column_stack([np.concatenate([x, x + 4, x[::-1] + 7]),
                               np.concatenate([y, y + 3, y[::-1] - 1]), depth])
    return corners, np.concatenate([[[0, 1, 2], [0, 2, 3]]] * 3) + np.repeat([0, 4, 8], 2)[:, None]


def camera(labs, aspect=1.0):
    """clip_from_world (4, 4) of a camera whose near plane cuts the unit ball."""
    return clip_from_world(labs, BUNNY_EYE, near=1.85, aspect=aspect)
