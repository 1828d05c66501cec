"""The compiled pipeline: what pipeline.py draws and differentiates, by kernels on all cores.

    project_vertices, draw_faces  ->  colour_rows    ->  find_pairs, blend      `draw`
    add_runs                      <-  gradient_rows  <-  blend_backward         `draw_backward`

Each function stands for the one of its name in another module. What it finds is the same to the
bit, and gradients to rounding. Barycentrics, and colours before antialiasing, are not kept: the way
back finds them again, and so does whoever asks for them.

A picture is cut into bands of rows, one for each thread, or the faces into shares where they are
more than the pixels. What the threads find is put together in the order of the bands. So no result
depends on how many there are.
"""
import functools

import numpy as np

from course.given import compiled, inputs
from course.given.compiled import each_band

from . import (
    face_kernels,
    footprint_kernels,
    interpolation,
    outlines,
    pair_kernels,
    pipeline,
    pixel_kernels,
    rasterization,
    rasterizer_gradients,
)

SMALL = 1 << 14   # pixels, or faces: for fewer, a second thread costs more than it gains
BAND = 1 << 15    # pixels, whose pairs or runs are found at once
CACHED = 1 << 18  # pixels, whose z-buffer stays in the cache


class Drawn:
    """The `pipeline.Buffers` of a picture. What is not kept is found again when asked for."""

    def __init__(self, clip, screen, faces, material, background):
        self.clip, self.faces, self.material, self.background = clip, faces, material, background
        self.points, self.face_index, self.depth = screen

    def __iter__(self):
        return (getattr(self, name) for name in pipeline.Buffers._fields)

    @functools.cached_property
    def barycentric(self):
        return barycentrics(self.face_index, self.points, self.faces)

    @functools.cached_property
    def weights(self):
        if isinstance(self.material, pipeline.Texture):
            return None
        return interpolation.weight_rows(self.faces, self.face_index, self.barycentric)

    @functools.cached_property
    def derivatives(self):
        if not isinstance(self.material, pipeline.Texture):
            return None
        return rasterization.barycentrics_derivatives(self.face_index, self.clip, self.faces)

    @functools.cached_property
    def colour(self):
        return shaded(self)

    @property
    def pairs(self):
        owner, other, start, end, face, edge, _ = self.numbers.T
        return outlines.Pairs(owner, other, self.places[:, 0], np.stack([start, end]),
                              self.places[:, 1:3].T, self.places[:, 3:].T, face, edge)


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
    """clip and faces as kernels take them. ValueError for faces that are not integers."""
    if faces.dtype != np.intp:
        inputs.require_faces(faces, len(clip))
    return np.ascontiguousarray(clip, float), np.ascontiguousarray(faces, np.intp)


def barycentrics(face_index, points, faces):
    """`rasterization.barycentrics`, from the points of `screen_vertices`."""
    height, width = face_index.shape
    barycentric = np.empty((height, width, 3))

    def band(bottom, top):
        pixel_kernels.barycentric_rows(face_index.ravel(), points, faces, width, bottom, top,
                                       barycentric.reshape(-1, 3))

    on_all_cores(band, height, face_index.size)
    return barycentric


def coloured(face_index, points, faces, colours, background):
    """The colour (H, W, C) at each pixel's centre, from the points of `screen_vertices`."""
    height, width = face_index.shape
    picture = np.empty((height, width, len(background)))

    def band(bottom, top):
        pixel_kernels.colour_rows(face_index.ravel(), points, faces, colours, background, width,
                                  bottom, top, picture.ravel())

    on_all_cores(band, height, face_index.size)
    return picture


def blended_pairs(face_index, depth, points, faces, opposite):
    """`outlines.blended_pairs` as numbers (N, 7) and places (N, 5) of pair_kernels.py."""
    height, width = face_index.shape
    face_index, depth = face_index.ravel(), depth.ravel()
    silhouettes = np.zeros(len(faces), np.uint8)

    def band(bottom, top):
        room = 2 * (top - bottom) * width
        numbers, places = np.empty((room, 7), np.intp), np.empty((room, 5))
        beside, count = pair_kernels.find_pairs(face_index, depth, points, faces, opposite,
                                                silhouettes, width, bottom, top, numbers, places)
        return numbers[:count].copy(), places[:count].copy(), beside

    found = list(in_bands(band, width, height))
    if len(found) == 1:
        return found[0][:2]
    numbers = [numbers[:k] for numbers, _, k in found] + [numbers[k:] for numbers, _, k in found]
    places = [places[:k] for _, places, k in found] + [places[k:] for _, places, k in found]
    return np.concatenate(numbers), np.concatenate(places)


def visible(clip, faces, width, height):
    """`pipeline.visible`."""
    clip, faces = contiguous(clip, faces)
    points, face_index, depth = seen(clip, faces, width, height)
    return pipeline.Buffers(clip, face_index, depth, barycentrics(face_index, points, faces))


def shaded(drawn):
    """The colour (H, W, C) at each pixel's centre."""
    if not isinstance(drawn.material, pipeline.Texture):
        return coloured(drawn.face_index, drawn.points, drawn.faces, drawn.material.colours,
                        drawn.background)
    colour = footprint_kernels.textured(drawn.clip, drawn.face_index, drawn.material, drawn.faces)
    colour[drawn.face_index < 0] = drawn.background
    return colour


def draw(clip, faces, opposite, material, width, height, background):
    """`pipeline.draw`."""
    clip, faces = contiguous(clip, faces)
    if isinstance(material, pipeline.Colours):
        material = pipeline.Colours(np.ascontiguousarray(material.colours, float))
    screen = points, face_index, depth = seen(clip, faces, width, height)
    drawn = Drawn(clip, screen, faces, material, tuple(map(float, background)))
    picture = shaded(drawn)
    drawn.numbers, drawn.places = blended_pairs(face_index, depth, points, faces, opposite)
    drawn.jump = np.empty((len(drawn.places), len(drawn.background)))
    pair_kernels.blend(picture.ravel(), drawn.numbers, drawn.places, drawn.background, drawn.jump)
    return picture, drawn


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    """`pipeline.draw_backward`."""
    if not isinstance(buffers, Drawn):
        return NotImplemented
    grad_picture = np.ascontiguousarray(grad_picture, float)
    way = through_texture if isinstance(buffers.material, pipeline.Texture) else through_colours
    grad_material, grad_clip = way(grad_picture, buffers)
    if grad_depth is not None:
        grad_clip += rasterizer_gradients.depth_backward(grad_depth, buffers.face_index,
                                                         buffers.clip, buffers.faces)
    return grad_material, grad_clip


def through_texture(grad_picture, buffers):
    """The way back through a texture, and through the blended pairs."""
    grad_edges = np.zeros(buffers.clip.shape)
    pixels, grad_pixels = pairs_backward(grad_picture, buffers, grad_edges)
    grad_colour = grad_picture.copy()
    channels = grad_picture.shape[2]
    np.add.at(grad_colour.reshape(-1, channels), pixels, grad_pixels.reshape(-1, channels))
    grad_material, grad_clip = footprint_kernels.textured_backward(
        grad_colour, buffers.clip, buffers.face_index, buffers.material, buffers.faces)
    return grad_material, grad_clip + grad_edges


def pairs_backward(grad_picture, buffers, grad):
    """Adds the gradients of the blended edges to grad (V, 4 or more), and finds those of their
    pixels' colours, beside grad_picture: pixels (2 N,), grad_pixels, C numbers for each.
    """
    height, width = buffers.face_index.shape
    count, channels = buffers.jump.shape
    pixels, grad_pixels = np.empty(2 * count, np.intp), np.empty(2 * count * channels)
    pair_kernels.blend_backward(grad_picture.ravel(), buffers.numbers, buffers.places,
                                buffers.jump, buffers.background, buffers.clip, width, height,
                                grad, pixels, grad_pixels)
    return pixels, grad_pixels


def through_colours(grad_picture, buffers):
    """The way back through colours of the vertices, and through the blended pairs."""
    height, width = buffers.face_index.shape
    colours, background = buffers.material.colours, buffers.background
    grad = through_pixels(grad_picture, buffers, colours, background)
    pixels, grad_pixels = pairs_backward(grad_picture, buffers, grad)
    found = room(len(pixels), len(background))
    runs = pixel_kernels.gradient_pixels(grad_pixels, pixels, buffers.face_index.ravel(),
                                         buffers.clip, buffers.faces, colours, background, width,
                                         height, *found)
    pixel_kernels.add_runs(buffers.faces, runs, *found, grad)
    return pipeline.Colours(grad[:, 4:]), grad[:, :4]


def through_pixels(grad_picture, buffers, colours, background):
    """The way back through the pixels' own colours: grad (V, 4 + C), of clip and of colours."""
    height, width = buffers.face_index.shape
    face_index, grad_picture = buffers.face_index.ravel(), grad_picture.ravel()
    grad = np.zeros((len(buffers.clip), 4 + len(background)))

    def band(bottom, top):
        found = room((top - bottom) * width, len(background))
        return pixel_kernels.gradient_rows(
            grad_picture, face_index, buffers.clip, buffers.faces, colours, background, width,
            height, bottom, top, *found), *found

    for runs in in_bands(band, width, height):
        pixel_kernels.add_runs(buffers.faces, *runs, grad)
    return grad


def room(size, channels):
    """Room for the faces and the records of so many runs."""
    return np.empty(size, np.int32), np.empty((size, 9 + 3 * channels))


def to_vertices(grad_pixels, buffers, vertex_count):
    """`pipeline.to_vertices`."""
    if not isinstance(buffers, Drawn) or vertex_count != len(buffers.clip):
        return NotImplemented
    channels = grad_pixels.shape[-1]
    return through_pixels(np.ascontiguousarray(grad_pixels, float), buffers,
                          np.zeros((vertex_count, channels)), (0.0,) * channels)[:, 4:]
