"""The bunny's silhouette with more and more samples in a pixel (lab 4), and by exact areas."""
import numpy as np

from ..given import image, mesh
from .drawing import BACKGROUND, SIZE, enlarged, lit, save, size_in_words, unit_bunny
from .portrait import BUNNY_EYE
from .viewing import clip_positions

EARS = slice(340, 420), slice(150, 230)  # rows and columns for a close up of the bunny


def msaa(labs):
    """The bunny's silhouette with 1, 4 and 16 samples in a pixel, and by exact areas."""
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

    exact, area = by_area(labs, clip, faces, shade, background)
    layers = area > 1 + 1e-9
    exact[layers] = pictures[-1][layers]
    yield (f"exact areas ({layers.mean():.1%} have several layers: from 16x)",
           save("msaa", "exact", image.to_srgb(exact)))
    ears = np.hstack([image.to_srgb(picture[EARS]) for picture in (*pictures, exact)])
    yield "close up of all four", save("msaa", "close_up", enlarged(ears, 6))


def shader(labs, clip, vertices, faces):
    """-> shade(px, py, face), lab 4's, and a list of how many points each call shaded."""
    normals, shades = mesh.vertex_normals(vertices, faces), []

    def shade(px, py, face):
        shades.append(len(face))
        barycentric = labs.msaa.barycentric_at(px, py, face, clip, faces, SIZE, SIZE)
        return lit(barycentric, normals[faces[face]])

    return shade, shades


def by_area(labs, clip, faces, shade, background):
    """Each front face by its exact area in every pixel: picture (SIZE, SIZE, 3), sum of areas.

    Right where the faces in a pixel lie side by side. Where some hide others, the sum is above 1.
    """
    x, y, _ = labs.rasterization.screen_points(clip, SIZE, SIZE)
    corners, parts = np.stack([x, y], -1)[faces], []
    for face in np.flatnonzero(labs.rasterization.signed_area(corners) > 0):
        low = np.floor(corners[face].min(0)).astype(int)
        width, height = np.floor(corners[face].max(0)).astype(int) + 1 - low
        coverage = labs.sampling.pixel_coverage(corners[face] - low, width, height)
        row, column = np.nonzero(coverage)
        parts.append((row + low[1], column + low[0], 0 * row + face, coverage[row, column]))
    row, column, face, part = (np.concatenate(values) for values in zip(*parts, strict=True))
    picture, area = np.zeros((SIZE, SIZE, 3)), np.zeros((SIZE, SIZE))
    colour = shade(column + 0.5, row + 0.5, face)
    np.add.at(picture, (row, column), part[:, None] * colour)
    np.add.at(area, (row, column), part)
    return picture + (1 - area)[..., None] * background, area
