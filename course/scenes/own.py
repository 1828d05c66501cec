"""One's own mesh or photo, in the place of a scene's."""
from pathlib import Path

import numpy as np

from ..given import image, mesh, mesh_files

LEAST, MOST = 32, 1536  # pixels of a photo's side


def shape(path, most):
    """A mesh file of at most so many faces -> vertices in the unit sphere, faces."""
    vertices, faces = mesh_files.read(path)
    if len(faces) > most:
        raise ValueError(f"{path} has {len(faces):,} faces, and this scene takes {most:,} at most: "
                         "make it coarser first, in Blender by the modifier Decimate")
    return mesh.normalize(vertices / np.abs(vertices).max()), faces


def surface(path, most):
    """As `shape`, of a mesh with at most two faces at an edge."""
    vertices, faces = shape(path, most)
    pairs, face_edges = mesh.edges(faces)
    count = np.bincount(face_edges.ravel())
    if count.max() > 2:
        a, b = mesh_files.read(path)[0][pairs[count.argmax()]].tolist()
        raise ValueError(f"{path} has {count.max()} faces at the edge from {a} to {b}, and this "
                         "scene takes two at most: leave one of them out")
    return vertices, faces


def photo(path):
    """A picture file -> the middle of it as light (H, W, 3), at most MOST pixels on a side.

    What is transparent shows white.
    """
    picture = image.read(path, upright=True)
    height, width = picture.shape[:2]
    if min(height, width) < LEAST:
        raise ValueError(f"{path} has {width} x {height} pixels, and this scene needs {LEAST} x "
                         f"{LEAST} at least: give a larger picture")
    top, left = max(height - MOST, 0) // 2, max(width - MOST, 0) // 2
    picture = picture[top:top + MOST, left:left + MOST]
    alpha = picture[..., 3:] if picture.shape[2] == 4 else 1
    return alpha * image.to_linear(picture[..., :3]) + 1 - alpha


def folder(scene, path):
    """Where the pictures of one's own thing go, in out/demo: rounded/cow for cow.obj."""
    return f"{scene}/{Path(path).stem}"
