"""The bunny with more and more samples in a pixel, and colours found in mixed pixels (lab 4)."""
import numpy as np

from ..given import image, mesh
from .drawing import BACKGROUND, SIZE, enlarged, lit, save, size_in_words, unit_bunny
from .mixed import colours_found, painted, sampled_ball
from .viewing import BUNNY_EYE, clip_positions

EARS = slice(340, 420), slice(150, 230)  # rows and columns for a close up of the bunny


def msaa(labs):
    """The bunny with 1, 4 and 16 samples in a pixel, and a ball's colours from 24 x 24 (lab 4)."""
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
    yield from recoloured(labs, *mesh.icosphere(320), 24)


def recoloured(labs, vertices, faces, size):
    """The colours of a ball's faces, and behind it, from size x size pixels that mix them."""
    colours = np.append(0.5 + 0.5 * np.sin(9 * vertices[faces].mean(1)), [BACKGROUND], 0)
    seen, large = (sampled_ball(labs, vertices, faces, side) for side in (size, 16 * size))
    goal = painted(labs, seen, colours)
    yield (f"a ball of {len(faces)} faces in {size} x {size} pixels",
           save("msaa", "ball", enlarged(image.to_srgb(goal), 16)))
    for step, found in enumerate(colours_found(labs, seen, goal, len(faces), 300)):
        if step in (0, 10, 300):
            off = np.abs(found - colours)[np.unique(seen[1])].mean()
            yield (f"step {step}: the colours that are seen are off by {off:.3f}",
                   save("msaa", f"step_{step}", image.to_srgb(painted(labs, large, found))))
    yield "colours found in mixed pixels", None, ("0.01", off < 0.01)


def shader(labs, clip, vertices, faces):
    """-> shade(px, py, face), lab 4's, and a list of how many points each call shaded."""
    normals, shades = mesh.vertex_normals(vertices, faces), []

    def shade(px, py, face):
        shades.append(len(face))
        barycentric = labs.msaa.barycentric_at(px, py, face, clip, faces, SIZE, SIZE)
        return lit((barycentric[..., None] * normals[faces[face]]).sum(1))

    return shade, shades
