"""The bunny by one's own kernels: fragments, tiles, and colours that are gathered (lab 17)."""
import time

import numpy as np

from ..given import compiled, image, mesh, plot
from .drawing import enlarged, lit, painted, save, unit_bunny
from .portrait import BUNNY_EYE
from .viewing import clip_positions

SIZE, TILE = 128, 8
ASIDE = np.array([2.2, 0.9, 1.3])  # an eye that sees a half of what BUNNY_EYE sees
UNSEEN = 0.2                       # the colour of vertices that no pixel sees


def tiles(labs):
    """The bunny by one's own kernels, beside one's own NumPy of lab 2 (lab 17)."""
    vertices, faces = unit_bunny()
    clip = clip_positions(labs, vertices, BUNNY_EYE)
    rasterize = labs.rasterization.rasterize
    took, (face_index, _) = timed(getattr(rasterize, "written", rasterize), clip, faces, SIZE, SIZE)
    yield f"your lab 2, NumPy for each face: {took:.0f} ms", None

    found = by_fragments(labs, clip, faces, SIZE)
    off = np.count_nonzero(found != face_index)
    yield (f"fragments in any order: {off} pixels see another face than in lab 2",
           save("tiles", "fragments", enlarged(plot.face_colours(found), 4)), ("0", off == 0))

    colours = image.to_srgb(lit(mesh.vertex_normals(vertices, faces)))
    by_tiles(labs, clip, faces, colours, TILE)  # compiles, where numba is installed
    took, picture = timed(by_tiles, labs, clip, faces, colours, SIZE)
    how = "compiled" if compiled.is_installed() else "in plain Python, as numba is not installed"
    yield (f"your tiles, {how}: {took:.0f} ms", save("tiles", "bunny", shown(picture)))

    again = by_tiles(labs, clip_positions(labs, vertices, ASIDE), faces,
                     vertex_colours(labs, picture, clip, faces), SIZE)
    yield ("the picture's colours at the vertices, from another side",
           save("tiles", "aside", shown(again)))


def timed(function, *args):
    """-> milliseconds of a processor that a call takes, and what it returns."""
    start = time.process_time()
    found = function(*args)
    return 1000 * (time.process_time() - start), found


def shown(picture):
    """Colours on the background, enlarged."""
    seen = picture.any(-1)
    return enlarged(painted(seen, np.clip(picture[seen], 0, 1)), 4)


def by_fragments(labs, clip, faces, size):
    """The face that each pixel sees (size, size), by fragments in a random order."""
    parts = zip(*labs.scanline.fragments(clip, faces, size, size), strict=True)
    pixel, depth, face = map(np.concatenate, parts)
    order = np.random.default_rng(0).permutation(len(pixel))
    return labs.kernels.nearest_faces(pixel[order], depth[order], face[order],
                                      size * size).reshape(size, size)


def by_tiles(labs, clip, faces, colours, size):
    """A mesh with colours (V, C), its faces in front of the camera: a picture (size, size, C)."""
    x, y, w = labs.rasterization.screen_points(clip, size, size)
    triangles = np.stack([x, y], -1)[faces]
    boxes = np.array([labs.rasterization.bounding_box(corners, size, size)
                      for corners in triangles])
    has_pixels = (boxes[:, :2] < boxes[:, 2:]).all(1)
    across = -(-size // TILE)
    lists = labs.kernels.tile_lists(boxes[has_pixels], TILE, across, across)
    return labs.kernels.three_passes(triangles[has_pixels], w[faces[has_pixels]],
                                     colours[faces[has_pixels]], lists, TILE, size, size)


def vertex_colours(labs, picture, clip, faces):
    """What a picture (H, W, C) says of each vertex's colour (V, C): the mean of the pixels that see
    its faces, by their weights, or UNSEEN.
    """
    height, width, _ = picture.shape
    seen = labs.pipeline.visible(clip, faces, width, height)
    at = seen.face_index >= 0
    weight = seen.barycentric[at].ravel()
    start, item = labs.kernels.bins(faces[seen.face_index[at]].ravel(), len(clip))
    values = np.column_stack([picture[at].repeat(3, 0), np.ones(len(weight))]) * weight[:, None]
    total = labs.kernels.gathered(start, item, values)
    mean = total[:, :-1] / np.maximum(total[:, -1:], 1e-9)
    return np.where(total[:, -1:] > 0, mean, UNSEEN)
