"""A floor to the horizon through lab 6's filters, and a texture that finds its place (lab 6).

What moves is three numbers: where the texture begins, u and v, and the bias of its levels.
"""
import numpy as np

from ..given import image as pictures
from .drawing import enlarged, painted, save

CORNERS = np.array([[-90.0, -1, 5], [90, -1, 5], [90, -1, -90], [-90, -1, -90]])
FACES = np.array([[0, 1, 2], [0, 2, 3]])
MOVED = np.array([0.04, -0.03, 0.6])  # u, v and the bias that are looked for
RATES = np.array([0.1, 0.1, 20])
FILTERS = "nearest", "linear", "linear-mipmap-linear"


def floor(labs):
    """A floor to the horizon in three filters, and a texture that finds its place (lab 6)."""
    image, (seen, uv, jacobian) = tiles(), looked_at(labs, 220, 124)
    for filter_mode in FILTERS:
        colour = labs.mipmapping.texture(image, uv, jacobian, filter_mode=filter_mode)
        picture = enlarged(pictures.to_srgb(painted(seen, colour)), 3)
        yield filter_mode, save("floor", filter_mode, picture)
    x = fit(labs, 48, 27)[-1]
    off = 64 * np.abs(x - MOVED)[:2].max()
    yield (f"its texture, moved and blurred, is found: {off:.2f} texels off, bias {x[2]:.2f}", None,
           ("0.05 and 0.60", off < 0.05 and abs(x[2] - MOVED[2]) < 0.01))


def fit(labs, width, height, steps=100):
    """u, v and bias (3,) from 0 to MOVED, as pictures of the floor say: all that were tried."""
    image, (_, uv, jacobian) = tiles(), looked_at(labs, width, height)

    def look(x):
        return image, uv + x[:2], jacobian, x[2], FILTERS[2]

    goal, path = labs.mipmapping.texture(*look(MOVED)), [np.zeros(3)]
    for _ in range(steps):
        colour = labs.mipmapping.texture(*look(path[-1]))
        _, by_uv, _, by_bias = labs.mipmapping.texture_backward(colour - goal, *look(path[-1]))
        grad = np.append(by_uv.sum(0), by_bias)
        path.append(path[-1] - RATES * grad / len(uv))
    return path


def looked_at(labs, width, height):
    """Which pixels see the floor (H, W), and of these uv (N, 2) and jacobian (N, 2, 2)."""
    eye, up = np.array([0.3, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
    view = labs.transforms.look_at(eye, eye + [0.0, -0.23, -1.0], up)
    lens = labs.transforms.perspective(np.radians(44), width / height, 0.05, 200.0)
    clip = labs.transforms.transform(labs.transforms.to_homogeneous(CORNERS), lens @ view)
    face_index, _ = labs.rasterization.rasterize(clip, FACES, width, height)
    b = labs.interpolation.barycentrics(face_index, clip, FACES)
    change = labs.interpolation.barycentrics_derivatives(face_index, clip, FACES)
    seen, at = face_index >= 0, (face_index, b)
    uv = labs.interpolation.interpolate(0.4 * CORNERS[:, ::2], FACES, *at)
    jacobian = labs.interpolation.interpolate_derivatives(0.4 * CORNERS[:, ::2], FACES, face_index,
                                                          change)
    return seen, uv[seen], jacobian[seen]


def tiles(size=64):
    """A texture (size, size, 3) of a checkerboard with a ring in each field."""
    y, x = 4 * (np.indices((size, size)) + 0.5) / size
    ring = np.abs(np.hypot(x % 1 - 0.5, y % 1 - 0.5) - 0.3) < 0.08
    light = ((np.floor(x) + np.floor(y)) % 2 == 0) ^ ring
    return np.where(light[..., None], [1.0, 0.74, 0.52], [0.1, 0.16, 0.3])
