"""The surroundings of a mirror, found from nothing but their reflections in it (extras of lab 6).

The teapot and the cameras are known. The texels of the cube map are not: they start grey, and the
gradients that reach them from the pictures are all that moves them.
"""
import numpy as np

from ...given import image
from .drawing import descended, enlarged, save
from .reflections import environment, known, reflections, unfolded, views, weights

PICTURES = 12
SIZE = 192    # of a picture
TEXELS = 64   # along each side of a face
GREY = 0.5    # of all texels at the start; those that nothing reflects stay so


def fit_mirror(labs):
    """A cube map from 12 pictures of a teapot that reflects it (extras of lab 6)."""
    truth = environment(labs, TEXELS)
    pictures = reflections(labs, truth, SIZE, PICTURES)
    given = known(views(labs, SIZE, PICTURES), pictures)
    yield (f"{PICTURES} pictures, {SIZE} x {SIZE} pixels",
           save("fit_mirror", "given", sheet(pictures)))
    yield "the truth", save("fit_mirror", "truth", enlarged(unfolded(truth), 4))
    for count, goal in (1, 18), (PICTURES, 23):
        seen = weights(labs, given[:count], TEXELS) > 0
        faces = fit(labs, np.full(truth.shape, GREY), given[:count])
        decibels = psnr(faces, truth, seen)
        yield (f"from {count}: {seen.mean():.0%} seen, {decibels:.1f} dB there",
               save("fit_mirror", f"from_{count}", enlarged(unfolded(faces), 4)),
               (f"{goal}", decibels >= goal))


def fit(labs, faces, given, steps=100, seed=0):
    """Faces (6, n, n, 3), fitted to what is `known` by Adam, up to three pictures in each step."""
    lab6, lab9, rng = labs.cube_maps, labs.inverse_rendering, np.random.default_rng(seed)

    def gradient(x):
        loss, grad_x = 0.0, np.zeros(x.shape)
        for k in rng.permutation(len(given))[:3]:
            *look, colour = given[k]
            seen = lab6.cube_texture(x, *look, filter="linear-mipmap-linear")
            grad_seen = 2 * (seen - colour) / colour.size
            loss += ((seen - colour)**2).mean()
            grad_x += lab6.cube_texture_backward(grad_seen, x, *look,
                                                 filter="linear-mipmap-linear")[0]
        return loss, grad_x

    path, _ = descended(labs, faces, gradient, lab9.decay(0.02, 0.05, steps),
                      project=lambda x: np.clip(x, 0, 1))
    return path[-1]


def psnr(faces, truth, seen):
    """Peak signal-to-noise ratio in decibels, over the texels that are seen."""
    return image.decibels(((faces - truth)[seen]**2).mean())


def sheet(pictures, columns=4):
    """All pictures side by side: what is not given is white."""
    pictures = [np.where(np.isfinite(picture), picture, 1.0) for picture in pictures]
    rows = [np.hstack(pictures[k:k + columns]) for k in range(0, len(pictures), columns)]
    return np.vstack(rows[::-1])
