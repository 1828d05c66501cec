"""A teapot that is a mirror: each pixel looks up a direction in a cube map (extras of lab 6)."""
import numpy as np

from .drawing import SIZE, save, size_in_words
from .reflections import environment, teapot, unfolded, view
from .viewing import clip_from_world

EYE = np.array([0.55, 0.75, 2.6])
SAMPLES = 4  # along each side of a pixel, in the truth that filters are compared with


def mirror(labs):
    """A teapot as a mirror, and the cube map that it reflects (extras of lab 6)."""
    faces = environment(labs, 256)
    yield "6 x 256 x 256 texels", save("mirror", "surroundings", unfolded(faces))
    yield size_in_words(*teapot()), None
    camera = clip_from_world(labs, EYE, (0.0, -0.05, 0.0), fov_y=42)
    look = view(labs, camera, EYE, SIZE)
    yield "directions, and how they change", None
    truth = supersampled(labs, faces, camera, EYE, SIZE // 2)
    for name, filter in ("nearest", "nearest"), ("trilinear", "linear-mipmap-linear"):
        small = labs.cube_maps.cube_texture(faces, *view(labs, camera, EYE, SIZE // 2)[1:],
                                            filter=filter)
        error = np.sqrt(np.mean((small - truth)**2))
        picture = labs.cube_maps.cube_texture(faces, *look[1:], filter=filter)
        yield f"{name}: off by {error:.3f}", save("mirror", name, picture)


def supersampled(labs, faces, camera, eye, size):
    """The picture (size, size, 3) as a mean of SAMPLES x SAMPLES look-ups in each pixel."""
    _, *look = view(labs, camera, eye, SAMPLES * size)
    samples = labs.cube_maps.cube_texture(faces, *look)
    return samples.reshape(size, SAMPLES, size, SAMPLES, 3).mean((1, 3))
