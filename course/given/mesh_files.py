"""Triangle meshes from files, such as other programs write them."""
import io
import re
from pathlib import Path

import numpy as np

from labkit import places

from . import inputs, mesh

KINDS = ".obj", ".ply", ".stl", ".off"


def read(path):
    """A file -> vertices, faces: triangles, one vertex at each place, as large as in the file.

    Polygons are cut into triangles, from their first corner. Faces without three different corners,
    repeated ones and vertices of no face are left out. FileNotFoundError or OSError for a file that
    cannot be opened, ValueError for one that is no mesh.
    """
    kind = Path(path).suffix.lower()
    if kind not in KINDS:
        raise ValueError(f"cannot read {path} as a mesh: expected a file with the ending "
                         f"{', '.join(KINDS)}, export it as one of these")
    content = re.sub(rb"#.*", b"", places.read_whole(path)) if kind == ".obj" else (
        places.read_whole(path))  # trimesh knows no comment at a line's end
    import trimesh  # it is not there in a browser, where lectures import this room
    try:
        found = trimesh.load_mesh(io.BytesIO(content), kind[1:], process=False, skip_materials=True)
        vertices, faces = np.array(found.vertices, float), np.array(found.faces, int)
    except Exception:  # whatever a broken file makes the parser stumble over
        raise ValueError(f"cannot read {path} as a mesh: it is broken, cut short or something "
                         "else, export it again") from None
    try:
        inputs.require_mesh(vertices, faces)
        return plain(vertices, faces)
    except ValueError as error:
        raise ValueError(f"cannot use {path}: {error}") from None


def plain(vertices, faces):
    """A mesh with one vertex at each place, and no face or vertex that adds nothing."""
    vertices, faces = mesh.merge(vertices, faces)
    ascending = np.sort(faces, axis=1)
    _, first = np.unique(ascending, axis=0, return_index=True)
    faces = faces[np.intersect1d(first, np.flatnonzero((np.diff(ascending) > 0).all(1)))]
    if len(faces) == 0:
        raise ValueError("no face has three different corners: give a surface")
    used, faces = np.unique(faces, return_inverse=True)
    return vertices[used], faces.reshape(-1, 3)
