"""The pipeline: labs 1, 2, 5, 6 and 8 joined to a picture, and the way back to the scene.

    positions -> clip -> face_index, depth, barycentric -> colour -> picture   `render`
              1       2                                 5, 6      8            lab
    gradients <- grad_clip <- grad_barycentric <- grad_colour <- grad_picture  `render_backward`
              1            7                   5, 6           8                lab

All from clip on is `draw`, and all back to grad_clip is `draw_backward`. The gradient of a position
comes along two paths: through the colours inside of faces (lab 7, and with a texture lab 6 before
it), and through the edges between pixels (lab 8). A face of one colour has only the second path.

Where numba is installed, the functions below that are marked `has_kernels` never run: those of the
same names in course/fast/compiled_pipeline.py take their place. They return the same, pictures to
the bit and gradients to rounding.

Source: Laine et al. 2020 (nvdiffrast).
"""
from typing import NamedTuple

import numpy as np

from course.given import inputs
from course.given.arrays import masked_scatter
from course.given.compiled import has_kernels

from . import (
    antialiasing,
    interpolation,
    intersections,
    mipmapping,
    outlines,
    rasterization,
    rasterizer_gradients,
    transforms,
)


class Mesh(NamedTuple):
    """positions (V, 3), faces (F, 3), and opposite (F, 3) for the outline: `make_mesh` fills it."""

    positions: np.ndarray
    faces: np.ndarray
    opposite: np.ndarray


class Colours(NamedTuple):
    """A material of one colour for each vertex: colours (V, C)."""

    colours: np.ndarray


class Texture(NamedTuple):
    """A material with a texture, image (h, w, C), seen by one of lab 6's filters.

    uv (T, 2), uv_faces (F, 3): the (u, v) of each face's corners. Where there is no seam they can
    be one for each vertex, and uv_faces = faces.
    """

    uv: np.ndarray
    uv_faces: np.ndarray
    image: np.ndarray
    filter_mode: str = "linear-mipmap-linear"


class View(NamedTuple):
    """A camera, clip_from_model (4, 4), its screen in pixels, and the background's colour (C,)."""

    clip_from_model: np.ndarray
    width: int
    height: int
    background: np.ndarray


class Buffers(NamedTuple):
    """What was found on the way to a picture, which the way back needs.

    clip (V, 4), face_index and depth (H, W), and barycentric (H, W, 3) come first. `shade` adds
    colour (H, W, C), the picture before antialiasing. pairs are lab 8's, the blended ones.
    """

    clip: np.ndarray
    face_index: np.ndarray
    depth: np.ndarray
    barycentric: np.ndarray
    colour: np.ndarray | None = None
    pairs: outlines.Pairs | None = None


class Gradients(NamedTuple):
    """The gradients of a loss with respect to a scene: positions (V, 3), clip_from_model (4, 4).

    material is a Colours or a Texture of gradients, whose uv_faces and filter_mode are None.
    """

    positions: np.ndarray
    material: Colours | Texture
    clip_from_model: np.ndarray


def make_mesh(positions, faces):
    """A Mesh of positions (V, 3) and faces (F, 3). When it moves, `_replace` its positions."""
    inputs.require_faces(faces, len(positions))
    faces = faces.astype(np.intp)
    return Mesh(positions, faces, antialiasing.opposite_corners(faces))


def render(mesh, material, view):
    """The antialiased picture (H, W, C) of a Mesh with Colours or a Texture, and its Buffers.

    Your `draw` may return a plain tuple: here it gets its names, and nowhere else. ValueError, in
    one sentence, for what does not fit.
    """
    require_scene(mesh, material, view)
    clip = to_clip(mesh.positions, view.clip_from_model)
    picture, buffers = draw(clip, mesh.faces, mesh.opposite, material, int(view.width),
                            int(view.height), view.background)
    return picture, Buffers(*buffers)


def render_backward(grad_picture, buffers, mesh, material, view, grad_depth=None):
    """The backward pass of `render`: grad_picture (H, W, C) -> Gradients.

    A loss may look at the buffer depth, too: grad_depth (H, W) is its gradient.
    """
    require_way_back(grad_picture, buffers, mesh.faces, material)
    if grad_depth is not None:
        inputs.require_shape("grad_depth", grad_depth, buffers.depth.shape)
    grad_material, grad_clip = draw_backward(grad_picture, buffers, mesh.faces, material,
                                             grad_depth)
    grad_positions, grad_clip_from_model = to_clip_backward(grad_clip, mesh.positions,
                                                            view.clip_from_model)
    return Gradients(grad_positions, type(material)(*grad_material), grad_clip_from_model)


@has_kernels("compiled_pipeline")
def draw(clip, faces, opposite, material,  # exercise 9.2 (3 points)
         width, height, background):
    """Your own picture: your `rasterize` and barycentrics, then shade, and antialias.

    clip (V, 4), faces, opposite (F, 3), background (C,) -> picture (H, W, C), Buffers. These begin
    with clip, face_index, depth and barycentric, and the given `shade` adds the colour. pairs are
    those of the given `intersections.all_pairs(face_index, depth, clip, faces, opposite)`, of which
    `antialiasing.blend_pairs` makes the picture. See `demo bunny`.

    >>> clip = np.array([[-0.125, -9.0, 0.0, 1.0], [-0.125, 9.0, 0.0, 1.0], [-9.0, 0.0, 0.0, 1.0]])
    >>> mesh = clip, np.array([[0, 1, 2]]), np.full((1, 3), -1)
    >>> picture, buffers = draw(*mesh, Colours(np.ones((3, 1))), 4, 1, np.zeros(1))
    >>> picture[0, :, 0], buffers.colour[0, :, 0]
    (array([1.  , 0.75, 0.  , 0.  ]), array([1., 1., 0., 0.]))
    """
    face_index, depth = rasterization.rasterize(clip, faces, width, height)                # lab 2
    barycentric = interpolation.barycentrics(face_index, clip, faces)                      # lab 5
    seen = Buffers(clip, face_index, depth, barycentric)
    buffers = shade(seen, faces, material, background)                                # labs 5, 6
    pairs = intersections.all_pairs(face_index, depth, clip, faces, opposite)            # lab 8
    return antialiasing.blend_pairs(buffers.colour, pairs), buffers._replace(pairs=pairs)


@has_kernels("compiled_pipeline")
def draw_backward(grad_picture, buffers, faces, material,  # exercise 9.3 (3 points)
                  grad_depth=None):
    """Backward of `draw`, in reverse: grad_picture (H, W, C) -> grad_material, grad_clip (V, 4).

    The given `intersections.all_pairs_backward(grad_picture, colour, pairs, clip, faces)`, then
    `shade_backward`, then lab 7's `rasterize_backward`, which takes grad_depth. The first and the
    last give a grad_clip: add them. buffers, such as buffers.clip, are those of `draw`.

    >>> clip = np.array([[-0.125, -9.0, 0.0, 1.0], [-0.125, 9.0, 0.0, 1.0], [-9.0, 0.0, 0.0, 1.0]])
    >>> faces, colours = np.array([[0, 1, 2]]), Colours(np.ones((3, 1)))
    >>> picture, buffers = draw(clip, faces, np.full((1, 3), -1), colours, 4, 1, np.zeros(1))
    >>> buffers = Buffers(*buffers)  # whatever tuple your `draw` returns
    >>> grad_material, grad_clip = draw_backward(np.ones((1, 4, 1)), buffers, faces, colours)
    >>> grad_material.colours.sum().round(9), grad_clip[:, 0].round(9)
    (np.float64(1.75), array([1., 1., 0.]))
    """
    # What is decided, the face of each pixel and the blended edges, is taken as given.
    grad_colour, through_edges = intersections.all_pairs_backward(                        # lab 8
        grad_picture, buffers.colour, buffers.pairs, buffers.clip, faces)
    grad_material, *grad_weights = shade_backward(grad_colour, buffers, faces, material)  # 6, 5
    through_colours = rasterizer_gradients.rasterize_backward(                            # lab 7
        *grad_weights, grad_depth, buffers.face_index, buffers.clip, faces)
    return grad_material, through_edges + through_colours


def to_clip(positions, clip_from_model):
    """positions (V, 3), clip_from_model (4, 4) -> clip (V, 4)."""
    return transforms.transform(transforms.to_homogeneous(positions), clip_from_model)


def to_clip_backward(grad_clip, positions, clip_from_model):
    """grad_clip (V, 4) -> grad_positions (V, 3), grad_clip_from_model (4, 4)."""
    grad_points, grad_clip_from_model = transforms.transform_backward(
        grad_clip, transforms.to_homogeneous(positions), clip_from_model)
    return grad_points[:, :3], grad_clip_from_model


@has_kernels("compiled_pipeline")
def visible(clip, faces, width, height):
    """What each pixel sees at its centre: Buffers without colour and pairs.

    clip (V, 4), faces (F, 3). It checks nothing, and most drawings need no more.
    """
    face_index, depth = rasterization.rasterize(clip, faces, width, height)
    return Buffers(clip, face_index, depth, interpolation.barycentrics(face_index, clip, faces))


def shade(seen, faces, material, background):
    """The Buffers of `visible`, completed by the colour (H, W, C) at each pixel's centre."""
    if isinstance(material, Texture):
        colour = textured(seen, faces, material)
    else:
        colour = interpolation.interpolate(material.colours, faces, seen.face_index,
                                           seen.barycentric)
    outside = seen.face_index < 0
    for channel, value in enumerate(background):
        colour[..., channel][outside] = value
    return seen._replace(colour=colour)


def shade_backward(grad_colour, buffers, faces, material):
    """Backward of `shade`: grad_colour (H, W, C) -> grad_material, grad_barycentric (H, W, 3),
    grad_derivatives (H, W, 3, 2) or None.
    """
    if isinstance(material, Texture):
        return textured_backward(grad_colour, buffers, faces, material)
    return coloured_backward(grad_colour, buffers, faces, material)


def interior_backward(grad_colour, buffers, faces, material):
    """The way back without antialiasing: grad_colour (H, W, C) -> grad_material, grad_clip."""
    grad_material, *grad_weights = shade_backward(grad_colour, buffers, faces, material)
    grad_clip = rasterizer_gradients.rasterize_backward(
        *grad_weights, None, buffers.face_index, buffers.clip, faces)
    return grad_material, grad_clip


def coloured_backward(grad_colour, buffers, faces, material):
    """grad_colour (H, W, C) -> Colours of gradients, grad_barycentric (H, W, 3) less the value at
    corner 0, and None for the derivatives.
    """
    grad_colours, grad_barycentric = interpolation.interpolate_backward(
        grad_colour, material.colours, faces, buffers.face_index, buffers.barycentric)
    # The weights sum to 1, so only differences matter: a face of one colour gets exactly 0.
    return Colours(grad_colours), grad_barycentric - grad_barycentric[..., :1], None


@has_kernels("compiled_pipeline")
def to_vertices(grad_pixels, buffers, faces):
    """Back from pixels to vertices alone: grad_pixels (H, W, C) -> grad_attributes (V, C)."""
    any_attributes = np.zeros((len(buffers.clip), grad_pixels.shape[-1]))
    return interpolation.interpolate_backward(grad_pixels, any_attributes, faces,
                                              buffers.face_index, buffers.barycentric)[0]


def footprints(uv, uv_faces, seen, derivatives):
    """Where the N pixels that see a face look up its texture: (u, v) (N, 2), change (N, 2, 2).

    derivatives (H, W, 3, 2): of the barycentrics.
    """
    is_seen = seen.face_index >= 0
    at = interpolation.interpolate(uv, uv_faces, seen.face_index, seen.barycentric)
    change = interpolation.interpolate_derivatives(uv, uv_faces, seen.face_index, derivatives)
    return at[is_seen], change[is_seen]


def textured(seen, faces, material):
    """The texture's colour (H, W, C), filtered for the footprint of each pixel, 0 outside."""
    derivatives = interpolation.barycentrics_derivatives(seen.face_index, seen.clip, faces)
    at, footprint = footprints(material.uv, material.uv_faces, seen, derivatives)
    colour = mipmapping.texture(material.image, at, footprint, filter_mode=material.filter_mode)
    return masked_scatter(colour, seen.face_index >= 0)


def textured_backward(grad_colour, buffers, faces, material):
    """grad_colour (H, W, C) -> Texture of gradients, grad_barycentric (H, W, 3),
    grad_derivatives (H, W, 3, 2).
    """
    is_seen = buffers.face_index >= 0
    derivatives = interpolation.barycentrics_derivatives(buffers.face_index, buffers.clip, faces)
    at, footprint = footprints(material.uv, material.uv_faces, buffers, derivatives)
    grad_image, grad_at, grad_footprint, _ = mipmapping.texture_backward(
        grad_colour[is_seen], material.image, at, footprint, filter_mode=material.filter_mode)
    # `footprints` gathers the seen pixels: its transpose puts them back, 0 elsewhere.
    uv_at = material.uv, material.uv_faces, buffers.face_index
    by_place, grad_barycentric = interpolation.interpolate_backward(
        masked_scatter(grad_at, is_seen), *uv_at, buffers.barycentric)
    by_change, grad_derivatives = interpolation.interpolate_derivatives_backward(
        masked_scatter(grad_footprint, is_seen), *uv_at, derivatives)
    grad_texture = Texture(by_place + by_change, None, grad_image, None)
    return grad_texture, grad_barycentric, grad_derivatives


def require_scene(mesh, material, view):
    """ValueError, in one sentence, for what `render` cannot take."""
    inputs.require_geometry(mesh.positions, mesh.faces, view.clip_from_model, view.width,
                            view.height, mesh.opposite)
    if isinstance(material, Texture):
        inputs.require_texture(mesh.faces, material.uv, material.uv_faces, material.image,
                               view.background)
    else:
        inputs.require(isinstance(material, Colours), "a material, Colours or a Texture",
                       f"a {type(material).__name__}")
        inputs.require_colours(mesh.positions, material.colours, view.background)


def require_way_back(grad_picture, buffers, faces, material):
    """ValueError, in one sentence, for what `render_backward` cannot take."""
    inputs.require_shape("grad_picture", grad_picture, buffers.colour.shape)
    inputs.require_shape("face_index", buffers.face_index, buffers.colour.shape[:2])
    require_material(material, faces, len(buffers.clip), buffers.colour.shape[2])


def require_material(material, faces, vertex_count, channels):
    """ValueError, in one sentence, unless it has the shapes for such a mesh and picture."""
    if isinstance(material, Texture):
        inputs.require_shape("uv_faces", material.uv_faces, faces.shape)
        inputs.require_shape("uv", material.uv, (len(material.uv), 2))
        inputs.require_shape("image", material.image, (*material.image.shape[:2], channels))
    else:
        inputs.require_shape("colours", material.colours, (vertex_count, channels))
