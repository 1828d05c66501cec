"""A zone plate or a photo made smaller in five ways, with its spectra, and a triangle (lab 3)."""
import numpy as np

from ..given import image
from .drawing import SIZE, enlarged, save

STEP = 3  # of nine pixels one stays
STREAK = np.diag([0.5, 0.3, 0.1, 0.07, 0.03])[::-1]  # as a camera smears that moves
START = np.array([[0.35, 0.7], [0.6, 0.2], [0.1, 0.15]])  # of a triangle in the unit square
GOAL = np.array([[0.33, 0.9], [0.93, 0.31], [0.08, 0.15]])


def aliasing(labs, out="aliasing", photo=None):
    """A picture, or FILE, made smaller: with aliases, and filtered (lab 3)."""
    whole = zone_plate(SIZE + 1) if photo is None else photo
    yield "{1} x {0} pixels".format(*whole.shape), save(out, "whole", image.to_srgb(whole))

    height, width = (STEP * (side // STEP) for side in whole.shape[:2])
    channels = [smaller(labs.sampling, channel)
                for channel in np.moveaxis(whole[:height, :width], -1, 0)]
    for name in channels[0]:
        picture = np.stack([channel[name] for channel in channels], -1)
        yield name.replace("_", " "), save(out, name, enlarged(image.to_srgb(picture), STEP))
        size = np.abs(np.fft.fftshift(labs.sampling.spectrum_of(picture.mean(-1))))
        decades = np.log10(np.maximum(size / (size.max() or 1), 1e-5))
        yield "its spectrum", save(out, f"{name}_spectrum", enlarged(1 + decades / 5, STEP))

    if photo is None:
        yield from found_again(labs.sampling, 64)


def found_again(lab3, size):
    """A triangle's exact coverage of size x size pixels, and how it pulls another one to it."""
    coverage = lab3.pixel_coverage_loop(size * GOAL, size, size)
    yield "exact coverage", save("aliasing", "coverage", enlarged(image.to_srgb(1 - coverage), 8))
    for step, triangle in enumerate(pulled(lab3, size * START, coverage, 120)):
        if step % 40 == 0:
            missing = np.abs(lab3.pixel_coverage(triangle, size, size) - coverage)
            light = np.stack([1 - missing, 1 - coverage, 1 - coverage], -1)
            off = np.linalg.norm(triangle - size * GOAL, axis=1).max()
            yield (f"step {step}: red is right, black is missing, a vertex is {off:.3f} pixels off",
                   save("aliasing", f"step_{step}", enlarged(image.to_srgb(light), 8)))
    yield "the pixels pulled the vertices to their places", None, ("0.01 pixels", off < 0.01)


def zone_plate(side):
    """Rings that are finer the farther out they are: (side, side, 1), side odd."""
    rings = np.arange(side) - side // 2
    return 0.5 + 0.5 * np.cos(np.pi * (rings**2 + rings[:, None]**2) / side)[..., None]


def smaller(lab3, channel):
    """A channel (H, W) made smaller in five ways: {name: (H / STEP, W / STEP)}."""
    spectrum = lab3.sampled_spectrum(lab3.spectrum_of(channel), STEP, 0.5 / STEP)
    return {"sampled": channel[::STEP, ::STEP],
            "smeared": lab3.convolve(channel, STREAK)[::STEP, ::STEP],
            "filtered": lab3.filter_then_sample(channel, STEP),
            "filtered_in_its_spectrum": lab3.picture_of(spectrum),
            "blurred_too_late": lab3.sample_then_blur(channel, STEP)}


def pulled(lab3, triangle, coverage, steps):
    """Yields a triangle (3, 2) before each step of descent to a coverage, and at the end."""
    for _ in range(steps):
        yield triangle
        missing = lab3.pixel_coverage(triangle, *coverage.shape[::-1]) - coverage
        pull = lab3.pixel_coverage_backward(missing, triangle)
        triangle = triangle - pull / 32  # less than one over the length of an edge
    yield triangle
