"""What the site adds to the lectures: figures that answer, pairs of pictures, meshes to turn.

Each has its place below a cell. Words of it, or of its picture, say which.
"""
from . import comparisons, meshes

ANSWERS = {  # a figure that answers: its lecture, and words of the cell above it
    "edge_functions": ("02_rasterization", "a point p in a triangle and the three smaller"),
    "alias": ("03_sampling", "a wave with 4 periods in one second and a wave with 1 period"),
    "perspective": ("05_interpolation", "two pictures of a checkerboard floor of two faces"),
    "mip_level": ("06_texturing", "left, a pixel with its circle"),
    "antialias": ("08_antialiasing", "\\tag{7}"),
}


def write(extra):
    """Write their files -> [(lecture, words, HTML)]."""
    turned, paired = meshes.write(extra), comparisons.write(extra)
    return [
        *((lecture, words, f'<div class="answers" data-figure="{name}"></div>')
          for name, (lecture, words) in ANSWERS.items()),
        *((*meshes.MESHES[name][:2], shown) for name, shown in turned.items()),
        *((*comparisons.PAIRS[name][:2], shown) for name, shown in paired.items()),
    ]
