"""The bunny's silhouette with more and more samples in a pixel (lab 4)."""
import numpy as np

from ..given import image, mesh
from .drawing import BACKGROUND, SIZE, enlarged, lit, save, size_in_words, unit_bunny
from .portrait import BUNNY_EYE
from .viewing import clip_positions

EARS = slice(340, 420), slice(150, 230)  # rows and columns for a close up of the bunny


def msaa(labs):
    """The bunny's silhouette with 1, 4 and 16 samples in a pixel (lab 4)."""
    vertices, faces = unit_bunny()
    clip = clip_positions(labs, vertices, BUNNY_EYE)
    background = image.to_linear(BACKGROUND)
    yield size_in_words(vertices, faces), None

    pictures = []
    shade, shades = shader(labs, clip, vertices, faces)
    for count in 1, 4, 16:
        pattern = labs.msaa.standard_pattern(count)
        pictures.append(labs.msaa.msaa(clip, faces, SIZE, SIZE, pattern, shade, background))
        yield f"{count} in a pixel", None
        samples = count * SIZE * SIZE / 1e6
        yield (f"  {samples:.1f}M samples, {shades[-1] / 1e3:,.0f}k shades, {8 * samples:.0f} MB",
               save("msaa", f"{count}x", image.to_srgb(pictures[-1])))

    ears = np.hstack([image.to_srgb(picture[EARS]) for picture in pictures])
    yield "close up of all three", save("msaa", "close_up", enlarged(ears, 6))


def shader(labs, clip, vertices, faces):
    """-> shade(px, py, face), lab 4's, and a list of how many points each call shaded."""
    normals, shades = mesh.vertex_normals(vertices, faces), []

    def shade(px, py, face):
        shades.append(len(face))
        barycentric = labs.msaa.barycentric_at(px, py, face, clip, faces, SIZE, SIZE)
        return lit((barycentric[..., None] * normals[faces[face]]).sum(1))

    return shade, shades
