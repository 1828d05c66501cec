"""Pictures without the distortion of their lens: as a pinhole would have taken them.

A lens shows the ray (x, y, 1), where x is right and y is down, in the place of a pinhole's
(x', y', 1). As OpenCV and COLMAP write it, with r^2 = x^2 + y^2 and s = 1 + k1 r^2 + k2 r^4:

    x' = s x + 2 p1 x y + p2 (r^2 + 2 x^2)
    y' = s y + 2 p2 x y + p1 (r^2 + 2 y^2)

So each pixel of the new picture has its place in the old one. The inverse is only needed for the
new one's frame, in which all of the old one must be.
"""
import numpy as np
from scipy import ndimage

from .camera_files import NO_BEND, require

FINE = 4      # so many times more pixels a side has the picture that is looked up
ROUNDS = 100  # of the inverse's fixed point
NEAR = 0.05   # pixels: how exact the inverse must be


def straight(shot, picture):
    """A Shot and its picture (H, W, 4), which is finer -> those of a pinhole that shows all of it.

    Beside it, the picture goes on as at its border. A pixel is a mean of FINE^2 places.
    ValueError for a lens without an inverse in the picture.
    """
    focal, middle = np.array([[shot.fx, shot.fy], [shot.cx, shot.cy]])[..., None, None]
    size = np.reshape([shot.width, shot.height], (2, 1, 1))
    shown = unbent(shot, (np.mgrid[:1:33j, :1:33j] * size - middle) / focal)
    low = np.floor((shown * focal + middle).min((1, 2))).astype(int)
    width, height = np.ceil((shown * focal + middle).max((1, 2))).astype(int) - low
    ray = (low[:, None, None] + (np.mgrid[:width * FINE, :height * FINE] + 0.5) / FINE
           - middle) / focal
    within = np.minimum(1, np.hypot(*shown).max() / np.hypot(*ray))  # far out, lenses fold back
    finer = np.reshape(picture.shape[1::-1], (2, 1, 1)) / size
    place = (bent(within * ray, shot.bend) * focal + middle) * finer - 0.5
    seen = np.array([ndimage.map_coordinates(channel, place, order=1, mode="nearest")
                     for channel in picture[::-1].T]).T[::-1]
    return (shot._replace(width=width, height=height, cx=shot.cx - low[0], cy=shot.cy - low[1],
                          bend=NO_BEND),
            seen.reshape(height, FINE, width, FINE, -1).mean((1, 3)))


def bent(ray, bend):
    """Where a lens with k1, k2, p1, p2 shows the ray (2, ...)."""
    (x, y), (k1, k2, p1, p2) = ray, bend
    r2 = x * x + y * y
    s = 1 + k1 * r2 + k2 * r2**2
    return np.array([s * x + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                     s * y + 2 * p2 * x * y + p1 * (r2 + 2 * y * y)])


def unbent(shot, place):
    """The ray (2, ...) that a Shot's lens shows in each place."""
    ray = place
    with np.errstate(all="ignore"):
        for _ in range(ROUNDS):
            ray = ray + place - bent(ray, shot.bend)
        missed = np.abs(bent(ray, shot.bend) - place).max() * max(shot.fx, shot.fy)
    require(missed < NEAR, f"the lens of {shot.name} bends too much for a picture without "
            f"distortion: are {', '.join(f'{number:g}' for number in shot.bend)} its k1, k2, p1, "
            "p2?")
    return ray
