"""The texture of a known globe, from views so far away that most pixels hold many texels (lab 9).
"""
import numpy as np

from ..given import image
from .viewing import directions, random_pose

SAMPLES = 4  # along each side of a pixel, in the views that are given


def fit(labs, truth, views, filter_mode, size=64, first_rate=1e-2):
    """A grey texture becomes the globe's: a step of Adam for each of the views, seen through one of
    lab 6's filters. The rate falls to a tenth.

    -> psnr (steps,) after each step, and the texture, like truth.
    """
    lab6, lab9, coming = labs.mipmapping, labs.inverse_rendering, iter(views)

    def gradient(x):
        at, footprint, colour = next(coming)
        seen = lab6.texture(x, at, footprint, filter_mode=filter_mode)
        grad_seen = 2 * (seen - colour) / (3 * size**2)  # squared error, the rest of it is black
        grad_x, *_ = lab6.texture_backward(grad_seen, x, at, footprint, filter_mode=filter_mode)
        return ((seen - colour)**2).sum() / (3 * size**2), grad_x

    rates, course = lab9.decay(first_rate, 0.1, len(views)), []
    for x, _ in lab9.descend(np.full(truth.shape, 0.5), gradient, rates):
        course.append(psnr(x, truth))
    return np.array(course), x


def psnr(texture, truth):
    """Peak signal-to-noise ratio in decibels, for colours from 0 to 1.

    A texel counts by its area on the globe: a row at a pole has as many texels as the equator, and
    covers nearly nothing.
    """
    area = np.cos(np.pi * ((np.arange(len(truth)) + 0.5) / len(truth) - 0.5))
    return image.decibels(np.average(((texture - truth)**2).mean((1, 2)), weights=area))


def globe(steps=16):
    """A unit sphere in steps of latitude and twice as many of longitude: vertices, faces, uv."""
    v, u = np.divmod(np.arange((steps + 1) * (2 * steps + 1)), 2 * steps + 1)
    u, v = u / (2 * steps), v / steps
    corner = np.flatnonzero((u < 1) & (v < 1))[:, None]
    south, north = corner[corner[:, 0] > 2 * steps], corner[corner[:, 0] < corner.max() - 2 * steps]
    up = 2 * steps + 1
    faces = np.concatenate([south + [0, 1, up + 1], north + [0, up + 1, up]])
    return directions(u, v), faces, np.stack([u, v], -1)


def planet(rows, seed=3):
    """A texture (rows, 2 rows, 3) for the globe: sea, land and ice, out of random waves."""
    rng, height = np.random.default_rng(seed), 0
    v, u = np.meshgrid((np.arange(rows) + 0.5) / rows, (np.arange(2 * rows) + 0.5) / (2 * rows),
                       indexing="ij")
    for octave in np.arange(6).repeat(6):
        wave = directions(u, v) @ rng.normal(size=3) * 1.7 * 2**octave
        height = height + np.sin(wave + rng.uniform(0, 7)) / 1.7**octave
    relief = np.clip(height / 4, -1, 1)[..., None]
    sea = np.array([0.2, 0.3, 0.55]) + 0.15 * relief
    land = np.array([0.25, 0.45, 0.15]) + relief * np.array([0.6, 0.3, 0.3])
    colour = np.where(height[..., None] > 0.6, land, sea)
    colour[np.abs(v - 0.5) + relief[..., 0] * 0.04 > 0.38] = 0.95
    return np.clip(colour, 0, 1)


def views(labs, texture, count, seed=0, size=64):
    """The globe from count random sides, 1.5 to 50 away: for each, of the pixels that see it, uv
    (N, 2), their change (N, 2, 2), and the colour (N, 3): a mean of samples, each trilinear.
    """
    rng, found = np.random.default_rng(seed), []
    for _ in range(count):
        pose = random_pose(labs, rng)
        clip_from_view = labs.transforms.frustum(-0.04, 0.04, -0.04, 0.04, 0.1, 100.0)
        away = labs.transforms.translate(np.array([0.0, 0.0, -rng.uniform(1.5, 50)]))
        clip_from_model = clip_from_view @ away @ pose
        samples = sampled(labs, texture, clip_from_model, SAMPLES * size)
        samples = samples.reshape(size, SAMPLES, size, SAMPLES, 4).mean((1, 3))
        seen, at, footprint = footprints(labs, clip_from_model, size)
        known = samples[seen, 3] > 0
        colour = samples[seen][known]
        found.append((at[known], footprint[known], colour[:, :3] / colour[:, 3:]))
    return found


def sampled(labs, texture, clip_from_model, size):
    """The globe at the centres of size x size pixels: colour, and 1 where it is seen, else 0."""
    seen, *where = footprints(labs, clip_from_model, size)
    samples = np.zeros((size, size, 4))
    samples[seen, 3] = 1
    samples[seen, :3] = labs.mipmapping.texture(texture, *where, filter_mode="linear-mipmap-linear")
    return samples


def footprints(labs, clip_from_model, size):
    """seen (size, size), and of the seen pixels (u, v) (N, 2) and its change (N, 2, 2)."""
    vertices, faces, uv = globe()
    clip = labs.pipeline.to_clip(vertices, clip_from_model)
    seen = labs.pipeline.visible(clip, faces, size, size)
    derivatives = labs.interpolation.barycentrics_derivatives(seen.face_index, clip, faces)
    return seen.face_index >= 0, *labs.pipeline.footprints(uv, faces, seen, derivatives)
