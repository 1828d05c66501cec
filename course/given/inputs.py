"""What functions of the labs expect: one sentence for what does not fit.

A shape, such as (V, 3), has a number for a length that is known, a letter for one that is free.
"""
import numbers

import numpy as np


def require(fits, expected, came):
    """ValueError, in one sentence, unless what came fits."""
    if not fits:
        raise ValueError(f"expected {expected}; got {came}")


def require_reals(name, array, *shape, hint=""):
    """An array of finite real numbers, of which there may be none."""
    if _fits(array, shape, "iuf") and np.isfinite(array).all():
        return
    expected = f"{_shown(name, shape)} of finite numbers{hint}"
    _require_array(array, shape, "iuf", expected)
    require(np.isfinite(array).all(), expected, "NaN or infinity")


def require_indices(name, array, *shape, first, count, of, hint=""):
    """An array of integers from first to below count: they number things of this name."""
    expected = f"{_shown(name, shape)} of integers from {first} to {count - 1}, {of}{hint}"
    _require_array(array, shape, "iu", expected)
    if array.size:
        low, high = array.min(), array.max()
        require(first <= low and high < count, expected, f"{low} to {high}")


def require_faces(faces, vertex_count):
    """Integers (F, 3), signed or not, from 0 to vertex_count - 1: rows of the vertices. F may be 0.

    ValueError, in one sentence, for anything else.
    """
    expected = f"faces (F, 3) must be integers from 0 to {vertex_count - 1}, rows of the vertices"
    if not isinstance(faces, np.ndarray):
        raise ValueError(f"{expected}; got a {type(faces).__name__}: give an array")
    if faces.ndim != 2 or faces.shape[1] != 3 or faces.dtype.kind not in "iu":
        raise ValueError(f"{expected}; got {faces.shape} of {faces.dtype}: give three integers for "
                         "each triangle")
    if faces.size and (faces.min() < 0 or faces.max() >= vertex_count):
        face, corner = np.argwhere((faces < 0) | (faces >= vertex_count))[0]
        raise ValueError(f"{expected}; got {faces.min()} to {faces.max()}: face {face} names "
                         f"vertex {faces[face, corner]}, but there are {vertex_count} vertices, "
                         "counted from 0; mend that face, or give all vertices")


def require_opposite(faces, opposite):
    """The corners across the edges of faces (F, 3), such as a Mesh has them.

    Each picture asks anew: for the bunny's 3,674 faces it takes 0.15 ms.
    """
    made = ", made by antialiasing.opposite_corners(faces)"
    require_indices("opposite", opposite, *faces.shape, first=-1, count=faces.size,
                    of="-1 for none", hint=made)
    require(_lie_across(faces, opposite), f"opposite{made}, of these faces in this order; "
            "make_mesh does that", "corners that do not lie across these edges")


def _lie_across(faces, opposite):
    """Is what lies across an edge a corner with the same edge, and another vertex?"""
    square = 2654435761 * np.asarray(faces, np.int64)**2
    edge = square.sum(1, keepdims=True) - square  # of its ends: the same from both sides
    shared = opposite >= 0
    across = opposite[shared]
    return ((edge[shared] == edge.ravel()[across]).all()
            and (faces[shared] != faces.ravel()[across]).all())


def require_count(name, count, least):
    """An integer, such as a side in pixels, of Python or NumPy. Multiply int(count), because those
    of NumPy may be narrow, and overflow.
    """
    is_integer = isinstance(count, numbers.Integral) and not isinstance(count, bool)
    require(is_integer and count >= least, f"{name}, an integer of {least} or more", repr(count))


def require_geometry(positions, faces, clip_from_model, width, height, opposite):
    """What every picture needs: a mesh, a camera, and a screen."""
    require_reals("positions", positions, "V", 3, hint=" (a fit that diverges wants a smaller "
                  "rate)")
    require_faces(faces, len(positions))
    require_opposite(faces, opposite)
    require_reals("clip_from_model", clip_from_model, 4, 4)
    require_count("width", width, 0)
    require_count("height", height, 0)


def require_colours(positions, colours, background):
    """A colour for each vertex, and one for the background."""
    require_reals("colours", colours, len(positions), "C", hint=", one row for each vertex; give "
                  "grey ones as grey[:, None]")
    require_reals("background", background, _channels("colours", colours))


def require_texture(faces, uv, uv_faces, image, background):
    """The (u, v) of each face's corners, a texture, and a colour for the background."""
    require_reals("uv", uv, "T", 2)
    require_indices("uv_faces", uv_faces, *faces.shape, first=0, count=len(uv), of="rows of uv")
    require_reals("image", image, "h", "w", "C")
    require_reals("background", background, _channels("image", image))


def require_cubes(scene, view, samples):
    """What lab 10's `render` needs: faces with a cube each, three lights, a camera, a screen."""
    vertices, faces, textures, lights = scene
    require_reals("vertices", vertices, "V", 3)
    require_faces(faces, len(vertices))
    require_reals("textures", textures, len(faces), "T", "T", "T", "C", hint=", a cube per face")
    size = textures.shape[1]
    require(size >= 2 and textures.shape[1:4] == (size,) * 3, "textures (F, T, T, T, C) with one "
            "T, 2 or more", textures.shape)
    channels = _channels("textures", textures)
    require(len(lights) == 3, "lights (ambient, directional, towards)", f"{len(lights)} of them")
    for name, light, length in zip(("ambient", "directional", "towards"), lights,
                                   (channels, channels, 3), strict=True):
        require_reals(name, light, length)
    require_reals("clip_from_model", view.clip_from_model, 4, 4)
    require_reals("background", view.background, channels)
    for name, count in ("width", view.width), ("height", view.height), ("samples", samples):
        require_count(name, count, 1)


def require_shape(name, array, shape):
    """An array of this shape, such as a gradient has it of what it is with respect to."""
    if np.shape(array) != shape:  # asked in every step of a fit: the text only where it is needed
        require(False, f"{name} {shape}", np.shape(array))


def _fits(array, shape, kinds):
    return isinstance(array, np.ndarray) and len(array.shape) == len(shape) and all(
        isinstance(length, str) or length == came
        for length, came in zip(shape, array.shape, strict=True)) and array.dtype.kind in kinds


def _require_array(array, shape, kinds, expected):
    require(isinstance(array, np.ndarray), expected, f"a {type(array).__name__}")
    require(_fits(array, shape, array.dtype.kind), expected, array.shape)
    require(array.dtype.kind in kinds, expected, array.dtype)


def _channels(name, array):
    require(array.shape[-1] > 0, f"{name} of one channel or more", array.shape)
    return array.shape[-1]


def _shown(name, shape):
    inside = ", ".join(map(str, shape)) + ("," if len(shape) == 1 else "")
    return f"{name} ({inside})"


def require_mesh(vertices, faces):
    """Nothing for a sound mesh with at least one face, else a ValueError that says what is wrong.

    vertices (V, 3) finite floating point numbers, faces (F, 3) integers from 0 to V - 1. Faces may
    be degenerate, vertices unused or repeated.
    """
    vertices, faces = np.asarray(vertices), np.asarray(faces)
    if vertices.ndim != 2 or vertices.shape[1] != 3 or vertices.dtype.kind != "f":
        raise ValueError("vertices must be an array (V, 3) of floating point numbers, "
                         f"got {vertices.shape} of {vertices.dtype}: give one row for each vertex, "
                         "such as vertices.astype(float)")
    require_faces(faces, len(vertices))
    if len(faces) == 0:
        raise ValueError("a mesh needs at least one face, got none: give one or leave it out")
    if not np.isfinite(vertices).all():
        vertex = np.argmin(np.isfinite(vertices).all(axis=1))
        raise ValueError("vertices must be finite, "
                         f"vertex {vertex} is {vertices[vertex].tolist()}: mend it or leave it out")
