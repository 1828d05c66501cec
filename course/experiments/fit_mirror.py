"""The surroundings of a mirror, found from nothing but their reflections in it (extras of lab 6).

The teapot and the cameras are known. The texels of the cube map are not: they start grey, and the
gradients that reach them from the pictures are all that moves them.
"""
import numpy as np

from .drawing import cameras_at, directions, enlarged, save
from .mirror import environment, unfolded, view

PICTURES = 12
SAMPLES = 3   # along each side of a pixel, in the pictures that are given
SIZE = 192    # of a picture
TEXELS = 64   # along each side of a face
GREY = 0.5    # of all texels at the start; those that nothing reflects stay so


def fit_mirror(labs):
    """A cube map from 12 pictures of a teapot that reflects it (extras of lab 6)."""
    truth = environment(labs, TEXELS)
    looks = views(labs)
    given = reflections(labs, truth)
    yield (f"{PICTURES} pictures, {SIZE} x {SIZE} pixels",
           save("fit_mirror", "given", sheet(given)))
    yield "the truth", save("fit_mirror", "truth", enlarged(unfolded(truth), 4))
    for count, goal in (1, 18), (PICTURES, 23):
        seen = weights(labs, looks[:count]) > 0
        faces = fit(labs, np.full(truth.shape, GREY), looks[:count], given)
        decibels = psnr(faces, truth, seen)
        yield (f"from {count}: {seen.mean():.0%} seen, {decibels:.1f} dB there",
               save("fit_mirror", f"from_{count}", enlarged(unfolded(faces), 4)),
               (f"{goal}", decibels >= goal))


def cameras(labs):
    """Cameras around the teapot, from a little below to far above it: [(clip_from_world, eye)]."""
    k = np.arange(PICTURES)
    sides = directions(k * (np.sqrt(5) - 1) / 2, 0.42 + 0.5 * (k + 0.5) / PICTURES)
    return list(zip(cameras_at(labs, sides), 3 * sides, strict=True))


def views(labs, size=SIZE):
    """Where the pixels of each camera look: a list of what `mirror.view` returns."""
    return [view(labs, camera, eye, size) for camera, eye in cameras(labs)]


def reflections(labs, truth, size=SIZE):
    """What each camera sees of truth in the teapot: pictures (size, size, 3).

    A pixel is a mean of samples. Where one of them looks past the teapot, it is left out: NaN.
    """
    found = []
    for camera, eye in cameras(labs):
        on_teapot, *look = view(labs, camera, eye, SAMPLES * size)
        look[0][~on_teapot] = 0
        colour = labs.cube_maps.cube_texture(truth, *look, filter="linear-mipmap-linear")
        colour[~on_teapot] = np.nan
        found.append(colour.reshape(size, SAMPLES, size, SAMPLES, 3).mean((1, 3)))
    return found


def fit(labs, faces, looks, given, steps=100, seed=0):
    """Faces (6, n, n, 3), fitted to the given pictures by Adam, up to three of them in each step.
    """
    lab6, lab9, rng = labs.cube_maps, labs.inverse_rendering, np.random.default_rng(seed)

    def gradient(x):
        loss, grad_x = 0.0, np.zeros(x.shape)
        for k in rng.permutation(len(looks))[:3]:
            *look, colour = known(looks[k], given[k])
            seen = lab6.cube_texture(x, *look, filter="linear-mipmap-linear")
            grad_seen = 2 * (seen - colour) / colour.size
            loss += ((seen - colour)**2).mean()
            grad_x += lab6.cube_texture_backward(grad_seen, x, *look,
                                                 filter="linear-mipmap-linear")[0]
        return loss, grad_x

    for x, _ in lab9.descend(faces, gradient, lab9.decay(0.02, 0.05, steps),
                             project=lambda x: np.clip(x, 0, 1)):
        faces = x
    return faces


def known(look, picture):
    """Of the pixels that see the teapot alone: directions (N, 3), their change, colours (N, 3)."""
    _, directions, change = look
    whole = np.isfinite(picture[..., 0])
    return directions[whole], change[whole], picture[whole]


def weights(labs, looks, texels=TEXELS):
    """How many pixels show a texel: each pixel's weights, added up for each texel (6, n, n)."""
    total = np.zeros((6, texels, texels, 1))
    for on_teapot, at, change in looks:
        one = np.ones((on_teapot.sum(), 1))
        total += labs.cube_maps.cube_texture_backward(one, total, at[on_teapot], change[on_teapot],
                                                      filter="linear-mipmap-linear")[0]
    return total[..., 0]


def psnr(faces, truth, seen):
    """Peak signal-to-noise ratio in decibels, over the texels that are seen."""
    return -10 * np.log10(((faces - truth)[seen]**2).mean())


def sheet(given, columns=4):
    """All pictures side by side: what is not given is white."""
    pictures = [np.where(np.isfinite(picture), picture, 1.0) for picture in given]
    rows = [np.hstack(pictures[k:k + columns]) for k in range(0, len(pictures), columns)]
    return np.vstack(rows[::-1])
