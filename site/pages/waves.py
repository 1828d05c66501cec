"""The waves of the figure `bunny_waves`: a small bunny, and the eigenvectors of its Laplacian."""
import numpy as np
import scipy.linalg

from course.given import mesh, plot_3d
from course.given.whose import Labs
from course.scenes import drawing

from . import put

FACE_COUNT = 700
LOOK = -30, 15         # azimuth and elevation: as lecture 13 looks at the bunny
WHOLE = 2**15          # a wave of length 1 in units of the file


def write(extra):
    """Write extra/waves/bunny.bin."""
    labs = Labs("reference")
    vertices, faces = labs.collapse_heap.simplify(*drawing.unit_bunny(), FACE_COUNT)[:2]
    vertices = vertices @ plot_3d.turn(*LOOK).T
    put(extra / "waves" / "bunny.bin", packed(faces, *waves_of(labs, vertices, faces)))


def waves_of(labs, vertices, faces):
    """The waves (V, V) of lecture 13, slow ones first, and their shares (V, 3) in the vertices.

    Weights are 1 and masses valences, so that vertices = waves @ shares.
    """
    edges, _ = mesh.edges(faces)
    valence = np.bincount(edges.ravel()).astype(float)
    L = labs.regularization.laplacian(edges, np.ones(len(edges)), len(vertices))
    _, waves = scipy.linalg.eigh(L.toarray(), np.diag(valence))
    return waves, waves.T @ (valence[:, None] * vertices)


def packed(faces, waves, shares):
    """The file: how many vertices and faces, faces, shares, and wave after wave.

    The numbers of faces and vertices must be even, so that each part begins where it may.
    """
    return b"".join(part.tobytes() for part in (
        np.array([len(shares), len(faces)], "<u2"), faces.astype("<u2"), shares.astype("<f4"),
        np.round(WHOLE * waves.T).astype("<i2")))
