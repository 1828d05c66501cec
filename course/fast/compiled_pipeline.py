"""The compiled pipeline: what pipeline.py draws and differentiates, by kernels on all cores.

    project_vertices, draw_faces  ->  colour_rows    ->  find_pairs, blend      `draw`
    add_runs                      <-  gradient_rows  <-  blend_backward         `draw_backward`

Each function stands for the one of its name in another module. What it finds is the same to the
bit, and gradients to rounding. What is not of the expected shape, or names what is not there, is an
error before a kernel reads it, or when it comes upon it: compiled code reads on in memory. (Only an
opposite vertex that is not there counts as none.)

A picture is cut into bands of rows, one for each thread, or the faces into shares where they are
more than the pixels. What the threads find is put together in the order of the bands. So no result
depends on how many there are.
"""
import numpy as np

from course.given import compiled, inputs
from course.given.compiled import each_band

from . import (
    face_kernels,
    footprint_kernels,
    outlines,
    pair_kernels,
    pipeline,
    pixel_kernels,
    rasterizer_gradients,
)
from .texel_kernels import constant

SMALL = 1 << 14   # pixels, or faces: for fewer, a second thread costs more than it gains
BAND = 1 << 15    # pixels, whose pairs or runs are found at once
CACHED = 1 << 18  # pixels, whose z-buffer stays in the cache


def on_all_cores(function, size, work):
    """function(first, end) for parts of size, one for each thread that so much work is worth."""
    threads = threads_for(work)
    return list(each_band(function, parts(size, threads), threads))


def threads_for(work):
    """As many as there are cores, unless the pixels or faces are few."""
    return 1 if work <= SMALL else compiled.cores()


def parts(size, count):
    """0 to size in count parts (first, end) of nearly one size."""
    return [(size * k // count, size * (k + 1) // count) for k in range(count)]


def in_bands(function, width, height):
    """function(bottom, top) for bands of about BAND pixels, from bottom to top."""
    return each_band(function, parts(height, max(min(height, width * height // BAND), 1)))


def screen_vertices(clip, width, height):
    """x, y, z / w and w of `screen_points` as points (V, 4), and outcode (V,)."""
    points, outcode = np.empty((len(clip), 4)), np.empty(len(clip), np.uint8)

    def some(first, end):
        face_kernels.project_vertices(clip, width, height, first, end, points, outcode)

    on_all_cores(some, len(clip), len(clip))
    return points, outcode


def seen(clip, faces, width, height):
    """points of `screen_vertices`, and face_index, depth (height, width) of `rasterize`.

    ValueError for faces that name vertices that are not there.
    """
    points, outcode = screen_vertices(clip, width, height)
    draw = draw_shares if len(faces) > width * height else draw_bands
    is_sound, face_index, depth = draw(faces, points, outcode, width, height)
    if not is_sound:
        inputs.require_faces(faces, len(clip))
    return points, face_index.reshape(height, width), depth.reshape(height, width)


def draw_bands(faces, points, outcode, width, height):
    """Bands of rows, each drawn by one thread -> whether the faces are sound, face_index, depth.

    Each band looks at all faces. That is worth it where its pixels then stay in the cache.
    """
    size = width * height
    face_index, depth = np.empty(size, np.int32), np.empty(size)

    def band(bottom, top):
        return face_kernels.draw_faces(faces, points, outcode, width, height, 0, len(faces),
                                       bottom, top, face_index, depth)

    threads = threads_for(max(len(faces), size))
    count = max(threads, min(size // CACHED, size // (8 * len(faces) + 1)))
    return all(list(each_band(band, parts(height, count), threads))), face_index, depth


def draw_shares(faces, points, outcode, width, height):
    """A share of the faces for each thread, with a z-buffer of its own: otherwise `draw_bands`."""
    def share(first, end):
        face_index, depth = np.empty(width * height, np.int32), np.empty(width * height)
        is_sound = face_kernels.draw_faces(faces, points, outcode, width, height, first, end,
                                           0, height, face_index, depth)
        return is_sound, face_index, depth

    (is_sound, *nearest), *others = on_all_cores(share, len(faces), len(faces))
    for other_is_sound, *other in others:
        is_sound &= other_is_sound
        face_kernels.keep_nearest(*nearest, *other)
    return is_sound, *nearest


def rasterize(clip, faces, width, height):
    """`scanline.rasterize`."""
    clip, faces = contiguous(clip, faces)
    return seen(clip, faces, width, height)[1:]


def contiguous(clip, faces):
    """clip (V, 4) and faces (F, 3) as kernels take them. ValueError for other shapes, and for faces
    that are not integers.
    """
    inputs.require_shape("clip", clip, (len(clip), 4))
    if faces.dtype != np.intp or faces.shape != (len(faces), 3):
        inputs.require_faces(faces, len(clip))
    return np.ascontiguousarray(clip, float), np.ascontiguousarray(faces, np.intp)


def barycentrics(face_index, points, faces):
    """`rasterization.barycentrics`, from the points of `screen_vertices`."""
    height, width = face_index.shape
    weights = np.empty((3, height * width))

    def band(bottom, top):
        pixel_kernels.barycentric_rows(face_index.ravel(), points, faces, width, bottom, top,
                                       tuple(weights))

    on_all_cores(band, height, face_index.size)
    return weights.reshape(3, height, width).transpose(1, 2, 0)


def coloured(face_index, points, faces, colours, background):
    """The barycentrics (H, W, 3) and the colour (H, W, C) at each pixel's centre, from the points
    of `screen_vertices`.
    """
    height, width = face_index.shape
    weights, colour = np.empty((3, height * width)), np.empty((height, width, len(background)))

    def band(bottom, top):
        pixel_kernels.colour_rows(face_index.ravel(), points, faces, colours, background, width,
                                  bottom, top, tuple(weights), colour.ravel())

    on_all_cores(band, height, face_index.size)
    return weights.reshape(3, height, width).transpose(1, 2, 0), colour


def blended_pairs(face_index, depth, points, faces, opposite):
    """`outlines.blended_pairs`, from the points of `screen_vertices`."""
    height, width = face_index.shape
    face_index, depth = face_index.ravel(), depth.ravel()
    silhouettes = np.zeros(len(faces), np.uint8)

    def band(bottom, top):
        room = 2 * (top - bottom) * width
        numbers, places = np.empty((6, room), np.intp), np.empty((5, room))
        beside, count = pair_kernels.find_pairs(face_index, depth, points, faces, opposite,
                                                silhouettes, width, (bottom, top, height),
                                                numbers, places)
        return numbers[:, :count].copy(), places[:, :count].copy(), beside

    numbers, places = in_order(list(in_bands(band, width, height)))
    owner, other, *_, face, edge = numbers
    return outlines.Pairs(owner, other, places[0], numbers[2:4], places[1:3], places[3:], face,
                          edge)


def in_order(found):
    """numbers and places of bands, of which the first k are beside each other -> those of all."""
    numbers, places, counts = zip(*found, strict=True)
    if len(found) == 1:
        return numbers[0], places[0]
    return tuple(np.concatenate([part[:, :k] for part, k in zip(parts, counts, strict=True)]
                                + [part[:, k:] for part, k in zip(parts, counts, strict=True)], 1)
                 for parts in (numbers, places))


def visible(clip, faces, width, height):
    """`pipeline.visible`."""
    clip, faces = contiguous(clip, faces)
    points, face_index, depth = seen(clip, faces, width, height)
    return pipeline.Buffers(clip, face_index, depth, barycentrics(face_index, points, faces))


def draw(clip, faces, opposite, material, width, height, background):
    """`pipeline.draw`."""
    clip, faces = contiguous(clip, faces)
    inputs.require_shape("opposite", opposite, faces.shape)
    pipeline.require_material(material, faces, len(clip), len(background))
    points, face_index, depth = seen(clip, faces, width, height)
    if isinstance(material, pipeline.Texture):
        barycentric = barycentrics(face_index, points, faces)
        colour = footprint_kernels.textured(clip, face_index, material, faces)
        colour[face_index < 0] = background
    else:
        barycentric, colour = coloured(face_index, points, faces,
                                       np.ascontiguousarray(material.colours, float),
                                       tuple(map(float, background)))
    pairs = blended_pairs(face_index, depth, points, faces, np.asarray(opposite, np.intp))
    picture = colour.copy()
    pair_kernels.blend(picture.ravel(), colour.ravel(), pairs, constant(len(background)))
    return picture, pipeline.Buffers(clip, face_index, depth, barycentric, colour, pairs)


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    """`pipeline.draw_backward`."""
    clip, faces = contiguous(buffers.clip, faces)
    pipeline.require_way_back(grad_picture, buffers, faces, material)
    grad_picture = np.ascontiguousarray(grad_picture, float)
    way = through_texture if isinstance(material, pipeline.Texture) else through_colours
    grad_material, grad_clip = way(grad_picture, buffers._replace(clip=clip), faces, material)
    if grad_depth is not None:
        grad_clip += rasterizer_gradients.depth_backward(grad_depth, buffers.face_index, clip,
                                                         faces)
    return grad_material, grad_clip


def through_texture(grad_picture, buffers, faces, material):
    """The way back through a texture, and through the blended pairs."""
    grad_edges = np.zeros(buffers.clip.shape)
    pixels, grad_pixels = pairs_backward(grad_picture, buffers, grad_edges)
    grad_colour = grad_picture.copy()
    channels = grad_picture.shape[2]
    np.add.at(grad_colour.reshape(-1, channels), pixels, grad_pixels.reshape(-1, channels))
    grad_material, grad_clip = footprint_kernels.textured_backward(
        grad_colour, buffers.clip, buffers.face_index, material, faces)
    return grad_material, grad_clip + grad_edges


def pairs_backward(grad_picture, buffers, grad):
    """Adds the gradients of the blended edges to grad (V, 4 or more), and finds those of their
    pixels' colours, beside grad_picture: pixels (2 N,), grad_pixels, C numbers for each.
    """
    height, width, channels = grad_picture.shape
    pairs = outlines.Pairs(*map(np.ascontiguousarray, buffers.pairs))
    pixels = np.empty(2 * len(pairs.c), np.intp)
    grad_pixels = np.empty(len(pixels) * channels)
    are_there = pair_kernels.blend_backward(
        grad_picture.ravel(), buffers.colour.ravel(), pairs, constant(channels), buffers.clip,
        width, height, grad, pixels, grad_pixels)
    if not are_there:
        raise IndexError("pairs name pixels or vertices that are not there: give the Buffers of "
                         "this picture")
    return pixels, grad_pixels


def through_colours(grad_picture, buffers, faces, material):
    """The way back through colours of the vertices, and through the blended pairs."""
    height, width, channels = grad_picture.shape
    colours = np.ascontiguousarray(material.colours, float)
    grad = through_pixels(grad_picture, buffers, faces, colours)
    pixels, grad_pixels = pairs_backward(grad_picture, buffers, grad)
    found = room(len(pixels), channels)
    runs = pixel_kernels.gradient_pixels(grad_pixels, pixels, buffers.face_index.ravel(),
                                         buffers.clip, faces, colours, constant(channels), width,
                                         height, *found)
    pixel_kernels.add_runs(faces, runs, *found, grad)
    return pipeline.Colours(grad[:, 4:]), grad[:, :4]


def through_pixels(grad_picture, buffers, faces, colours):
    """The way back through the pixels' own colours: grad (V, 4 + C), of clip and of colours."""
    height, width, channels = grad_picture.shape
    face_index, grad_picture = buffers.face_index.ravel(), grad_picture.ravel()
    grad = np.zeros((len(buffers.clip), 4 + channels))

    def band(bottom, top):
        found = room((top - bottom) * width, channels)
        return pixel_kernels.gradient_rows(
            grad_picture, face_index, buffers.clip, faces, colours, constant(channels), width,
            height, bottom, top, *found), *found

    for runs, *found in in_bands(band, width, height):
        if runs < 0:
            raise IndexError("face_index names faces that are not there, or faces name vertices "
                             "that are not there: give the faces of this picture")
        pixel_kernels.add_runs(faces, runs, *found, grad)
    return grad


def room(size, channels):
    """Room for the faces and the records of so many runs."""
    return np.empty(size, np.int32), np.empty((size, 9 + 3 * channels))


def to_vertices(grad_pixels, buffers, faces):
    """`pipeline.to_vertices`."""
    clip, faces = contiguous(buffers.clip, faces)
    channels = grad_pixels.shape[-1]
    inputs.require_shape("grad_pixels", grad_pixels, (*buffers.face_index.shape, channels))
    return through_pixels(np.ascontiguousarray(grad_pixels, float), buffers._replace(clip=clip),
                          faces, np.zeros((len(clip), channels)))[:, 4:]
