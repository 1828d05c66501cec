"""The compiled pipeline: what pipeline.py draws and differentiates, by kernels, on all cores.

    project, draw_faces   ->  colour_rows    ->  find_pairs, blend         `draw`
    add_runs              <-  gradient_rows  <-  blend_backward            `draw_backward`

Each function stands for the one of its name in pipeline.py. What it finds is the same to the bit,
gradients to rounding. Barycentrics and colours before antialiasing are not kept: the way back finds
them again, and so does whoever asks for them.

The rows of a picture are cut into bands, and each thread draws some. What they find is put together
in the order of the bands, so that a result does not depend on the number of threads.
"""
import functools

import numpy as np

from course.given.compiled import cores, each_band

from . import face_kernels, interpolation, outlines, pair_kernels, pipeline, pixel_kernels

BAND = 1 << 15  # pixels, about: enough work for a thread


class Drawn(pipeline.Buffers):
    """The Buffers of a picture of Colours. What is not kept is found again when asked for."""

    def __new__(cls, clip, points, face_index, depth, faces, colours, background):
        drawn = super().__new__(cls, clip, face_index, depth, None)
        drawn.points, drawn.faces, drawn.colours = points, faces, colours
        drawn.background = background
        return drawn

    @functools.cached_property
    def barycentric(self):
        return barycentrics(self.points, self.face_index, self.faces)

    @functools.cached_property
    def weights(self):
        return interpolation.weight_rows(self.faces, self.face_index, self.barycentric)

    @functools.cached_property
    def colour(self):
        return coloured(self.points, self.face_index, self.faces, self.colours, self.background)

    @property
    def pairs(self):
        owner, other, *ends, face, edge, _ = self.numbers.T
        return outlines.Pairs(owner, other, self.places[:, 0], np.stack(ends),
                              self.places[:, 1:3].T, self.places[:, 3:].T, face, edge)


def bands_of(width, height):
    """The rows of a picture as bands (bottom, top) of about BAND pixels."""
    rows = max(1, BAND // width)
    return [(bottom, min(bottom + rows, height)) for bottom in range(0, height, rows)]


def project(clip, width, height):
    """points (V, 4): x, y, z / w and w of `screen_points`; outcode (V,)."""
    points, outcode = np.empty((len(clip), 4)), np.empty(len(clip), np.uint8)
    face_kernels.project(clip, width, height, 0, len(clip), points, outcode)
    return points, outcode


def seen_faces(points, outcode, faces, width, height):
    """`rasterize` of the vertices of `project` -> face_index, depth (H W,)."""
    face_index, depth = np.empty(width * height, np.int32), np.empty(width * height)

    def draw_band(bottom, top):
        face_kernels.draw_faces(faces, points, outcode, width, height, bottom, top, face_index,
                                depth)

    for _ in each_band(draw_band, thread_bands(width, height), cores()):
        pass
    return face_index, depth


def thread_bands(width, height):
    return [(height * i // cores(), height * (i + 1) // cores()) for i in range(cores())]


def barycentrics(points, face_index, faces):
    height, width = face_index.shape
    barycentric = np.empty((height, width, 3))
    pixel_kernels.barycentric_rows(face_index.ravel(), points, faces, width, 0, height,
                                   barycentric.reshape(-1, 3))
    return barycentric


def coloured(points, face_index, faces, colours, background):
    height, width = face_index.shape
    picture = np.empty((height, width, len(background)))
    def colour_band(bottom, top):
        pixel_kernels.colour_rows(face_index.ravel(), points, faces, colours, background, width,
                                  bottom, top, picture.ravel())
    for _ in each_band(colour_band, thread_bands(width, height), cores()):
        pass
    return picture


def find_pairs(points, face_index, depth, faces, opposite):
    height, width = face_index.shape
    face_index, depth = face_index.ravel(), depth.ravel()
    silhouettes = np.zeros(len(faces), np.uint8)
    bands = [(axis, bottom, top - (axis == 1 and top == height))
             for axis in (0, 1) for bottom, top in thread_bands(width, height)]

    def find(axis, bottom, top):
        size = (top - bottom) * width
        numbers, places = np.empty((size, 7), np.intp), np.empty((size, 5))
        count = pair_kernels.find_pairs(axis, face_index, depth, points, faces, opposite,
                                        silhouettes, width, bottom, top, numbers, places)
        return numbers[:count].copy(), places[:count].copy()

    found = list(each_band(find, bands, cores()))
    return tuple(map(np.concatenate, zip(*found)))


def draw(clip, faces, opposite, material, width, height, background):
    """`pipeline.draw`."""
    clip = np.ascontiguousarray(clip, float)
    points, outcode = project(clip, width, height)
    face_index, depth = seen_faces(points, outcode, faces, width, height)
    face_index, depth = face_index.reshape(height, width), depth.reshape(height, width)
    background = tuple(map(float, background))
    colours = np.ascontiguousarray(material.colours, float)
    picture = coloured(points, face_index, faces, colours, background)
    drawn = Drawn(clip, points, face_index, depth, faces, colours, background)
    drawn.numbers, drawn.places = find_pairs(points, face_index, depth, faces, opposite)
    drawn.jump = np.empty((len(drawn.places), len(background)))
    pair_kernels.blend(picture.ravel(), drawn.numbers, drawn.places, background, drawn.jump)
    return picture, drawn


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    height, width = buffers.face_index.shape
    clip, background, channels = buffers.clip, buffers.background, len(buffers.background)
    grad_picture = np.ascontiguousarray(grad_picture, float).ravel()
    grad = np.zeros((len(clip), 4 + channels))
    face_index = buffers.face_index.ravel()

    def gradients(bottom, top):
        size = (top - bottom) * width
        run_face, record = np.empty(size, np.int32), np.empty((size, 9 + 3 * channels))
        runs = pixel_kernels.gradient_rows(grad_picture, face_index, clip, faces, buffers.colours,
                                           background, width, height, bottom, top, run_face, record)
        return runs, run_face, record

    for found in each_band(gradients, bands_of(width, height), cores()):
        pixel_kernels.add_runs(faces, *found, grad)
    count = len(buffers.jump)
    pixels, grad_pixels = np.empty(2 * count, np.intp), np.empty(2 * count * channels)
    pair_kernels.blend_backward(grad_picture, buffers.numbers, buffers.places, buffers.jump,
                                background, clip, width, height, grad, pixels, grad_pixels)
    run_face, record = np.empty(2 * count, np.int32), np.empty((2 * count, 9 + 3 * channels))
    runs = pixel_kernels.gradient_pixels(grad_pixels, pixels, face_index, clip, faces,
                                         buffers.colours, background, width, height, run_face,
                                         record)
    pixel_kernels.add_runs(faces, runs, run_face, record, grad)
    return pipeline.Colours(grad[:, 4:]), grad[:, :4]
