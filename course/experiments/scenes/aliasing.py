"""A zone plate made smaller in three ways, with its spectra (lab 3)."""
import numpy as np

from .drawing import SIZE, enlarged, save


def aliasing(labs):
    """A picture made smaller: sampled, filtered before, blurred afterwards (lab 3)."""
    sampling, step = labs.sampling, 3
    rings = np.arange(SIZE + 1) - SIZE // 2
    plate = 0.5 + 0.5 * np.cos(np.pi * (rings**2 + rings[:, None]**2) / len(rings))
    yield "zone plate", save("aliasing", "zone_plate", plate)

    for name, step_name, picture in (
            ("sampled", "every third pixel", plate[::step, ::step]),
            ("filtered", "filtered, then sampled", sampling.filter_then_sample(plate, step)),
            ("blurred", "sampled, then blurred", sampling.sample_then_blur(plate, step))):
        yield step_name, save("aliasing", name, enlarged(picture, step))
        size = np.abs(np.fft.fftshift(sampling.spectrum_of(picture)))
        decades = np.log10(np.maximum(size / size.max(), 1e-5))
        yield "its spectrum", save("aliasing", f"{name}_spectrum", enlarged(1 + decades / 5, step))

    corners = SIZE / 8 * np.array([[0.08, 0.15], [0.93, 0.31], [0.33, 0.9]])
    coverage = sampling.pixel_coverage_loop(corners, SIZE // 8, SIZE // 8)
    yield "exact coverage", save("aliasing", "coverage", enlarged(1 - coverage, 8))
