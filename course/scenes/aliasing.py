"""A zone plate or a photo made smaller in three ways, with its spectra (lab 3)."""
import numpy as np

from ..given import image
from .drawing import SIZE, enlarged, save


def aliasing(labs, out="aliasing", photo=None):
    """A picture, or FILE, made smaller: sampled, filtered before, blurred afterwards (lab 3)."""
    sampling, step = labs.sampling, 3
    whole = zone_plate() if photo is None else photo
    yield "{1} x {0} pixels".format(*whole.shape), save(out, "whole", image.to_srgb(whole))

    for name, step_name, smaller in (
            ("sampled", "every third pixel", lambda channel: channel[::step, ::step]),
            ("filtered", "filtered, then sampled",
             lambda channel: sampling.filter_then_sample(channel, step)),
            ("blurred", "sampled, then blurred",
             lambda channel: sampling.sample_then_blur(channel, step))):
        picture = np.stack([smaller(channel) for channel in np.moveaxis(whole, -1, 0)], -1)
        yield step_name, save(out, name, enlarged(image.to_srgb(picture), step))
        size = np.abs(np.fft.fftshift(sampling.spectrum_of(picture.mean(-1))))
        decades = np.log10(np.maximum(size / (size.max() or 1), 1e-5))
        yield "its spectrum", save(out, f"{name}_spectrum", enlarged(1 + decades / 5, step))

    if photo is not None:
        return
    corners = SIZE / 8 * np.array([[0.08, 0.15], [0.93, 0.31], [0.33, 0.9]])
    coverage = sampling.pixel_coverage_loop(corners, SIZE // 8, SIZE // 8)
    yield "exact coverage", save(out, "coverage", enlarged(image.to_srgb(1 - coverage), 8))


def zone_plate():
    """Rings that are finer the farther out they are: (SIZE + 1, SIZE + 1, 1)."""
    rings = np.arange(SIZE + 1) - SIZE // 2
    return 0.5 + 0.5 * np.cos(np.pi * (rings**2 + rings[:, None]**2) / len(rings))[..., None]
