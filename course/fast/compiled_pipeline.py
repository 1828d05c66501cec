"""The compiled pipeline: what pipeline.py draws and differentiates, by kernels on all cores.

    project_vertices, draw_faces  ->  colour_rows    ->  find_pairs, blend      `draw`
    add_runs                      <-  gradient_rows  <-  blend_backward         `draw_backward`

Each function stands for the one of its name in another module. What it finds is the same to the
bit, and gradients to rounding. What is not of the expected shape, or names what is not there, is an
error before a kernel reads it, or when it comes upon it: compiled code reads on in memory. (Only an
opposite corner that is not there counts as none.)

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
    intersections,
    outlines,
    pair_kernels,
    pipeline,
    pixel_kernels,
    rasterizer_gradients,
    texel_kernels,
)
from .texel_kernels import constant

SMALL = 1 << 14   # pixels, or faces: for fewer, a second thread costs more than it gains
BAND = 1 << 15    # pixels, whose pairs or runs are found at once
CACHED = 1 << 18  # pixels, whose z-buffer stays in the cache


def on_all_cores(function, size, work):
    """function(first, end) for parts of size, one for each thread that so much work is worth."""
    threads = threads_for(work)
    if threads == 1:
        return [function(0, size)]
    return list(each_band(function, parts(size, threads), threads))


def threads_for(work):
    """As many as there are cores, unless the pixels or faces are few."""
    return 1 if work <= SMALL else compiled.cores()


def parts(size, count):
    """0 to size in count parts (first, end) of nearly one size."""
    return [(size * k // count, size * (k + 1) // count) for k in range(count)]


def in_bands(function, width, height, pixels=BAND):
    """function(bottom, top) for bands of about so many pixels, from bottom to top."""
    return each_band(function, parts(height, max(min(height, width * height // pixels), 1)))


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
    is_sound, buffer = draw(face_kernels.Faces(faces, points, outcode), width, height)
    if not is_sound:
        inputs.require_faces(faces, len(clip))
    return (points, buffer.face_index.reshape(height, width),
            buffer.depth.reshape(height, width))


def draw_bands(faces, width, height):
    """Bands of rows, each drawn by one thread -> whether the Faces are sound, and a ZBuffer.

    Each band looks at all faces. That is worth it where its pixels then stay in the cache.
    """
    size = width * height
    buffer = z_buffer(width, height)

    def band(*rows):
        return face_kernels.draw_faces(faces, (0, len(faces.corners)), rows, height, buffer)

    threads = threads_for(max(len(faces.corners), size))
    count = max(threads, min(size // CACHED, size // (8 * len(faces.corners) + 1)))
    return all(list(each_band(band, parts(height, count), threads))), buffer


def draw_shares(faces, width, height):
    """A share of the faces for each thread, with a z-buffer of its own: otherwise `draw_bands`."""
    def share(*part):
        buffer = z_buffer(width, height)
        return face_kernels.draw_faces(faces, part, (0, height), height, buffer), buffer

    (is_sound, nearest), *others = on_all_cores(share, len(faces.corners), len(faces.corners))
    for other_is_sound, other in others:
        is_sound &= other_is_sound
        face_kernels.keep_nearest(nearest, other)
    return is_sound, nearest


def z_buffer(width, height):
    """A ZBuffer of which nothing is written but the columns' centres."""
    size = width * height
    return face_kernels.ZBuffer(np.arange(width) + 0.5, np.empty(size, np.int32), np.empty(size))


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
    """`interpolation.barycentrics`, from the points of `screen_vertices`."""
    height, width = face_index.shape
    weights = np.empty((3, height * width))

    def band(*rows):
        pixel_kernels.barycentric_rows(grid_of(face_index), points, faces, rows, weights)

    on_all_cores(band, height, face_index.size)
    return weights.reshape(3, height, width).transpose(1, 2, 0)


def coloured(face_index, points, faces, colours, background):
    """The barycentrics (H, W, 3) and the colour (H, W, C) at each pixel's centre, from the points
    of `screen_vertices`.
    """
    height, width = face_index.shape
    weights, colour = np.empty((3, height * width)), np.empty((height, width, len(background)))
    shape = pixel_kernels.Shape(points, faces, colours)

    def band(*rows):
        pixel_kernels.colour_rows(grid_of(face_index), shape, rows, background, weights,
                                  colour.ravel())

    on_all_cores(band, height, face_index.size)
    return weights.reshape(3, height, width).transpose(1, 2, 0), colour


def all_pairs(face_index, depth, clip, points, faces, opposite, walks=True):
    """`intersections.all_pairs`, or `outlines.blended_pairs` if nothing walks. points: screen."""
    height, width = face_index.shape
    screen = pair_kernels.Screen(face_index.ravel(), depth.ravel(), width, height)
    surface = pair_kernels.Surface(points, faces, opposite)

    def band(*rows):
        room = 2 * (rows[1] - rows[0]) * width
        pairs, through = room_for_pairs(room), np.empty((3, room), np.intp)
        beside, count = pair_kernels.find_pairs(screen, surface, rows, pairs, through, walks)
        found = *(part[..., :count[0]].copy() for part in pairs), through[:, :count[1]].copy()
        return found, [beside[0]] * len(pairs) + [beside[1]]

    pixels = BAND // 8 if len(faces) > width * height else BAND  # whose faces stay in the cache
    found, beside = zip(*in_bands(band, width, height, pixels), strict=True)
    *pairs, (owner, other, face) = found[0] if len(found) == 1 else map(
        in_order, zip(*found, strict=True), zip(*beside, strict=True))
    through = outlines.Pairs(owner, other, *[None] * 4, face, None)
    return intersections.with_meetings(outlines.Pairs(*pairs), through, face_index, clip, faces,
                                       opposite)


def room_for_pairs(count):
    """Pairs of which nothing is written yet."""
    owner, other, face, edge = np.empty((4, count), np.intp)
    x, y = np.empty((2, 2, count))
    return outlines.Pairs(owner, other, np.empty(count), np.empty((2, count), np.intp), x, y, face,
                          edge)


def in_order(parts, beside):
    """A field of bands, of which the first k pairs are beside each other -> that of all."""
    return np.concatenate([part[..., :k] for part, k in zip(parts, beside, strict=True)]
                          + [part[..., k:] for part, k in zip(parts, beside, strict=True)], -1)


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
        colour = textured(clip, face_index, material, faces)
        colour[face_index < 0] = background
    else:
        barycentric, colour = coloured(face_index, points, faces,
                                       np.ascontiguousarray(material.colours, float),
                                       tuple(map(float, background)))
    pairs = all_pairs(face_index, depth, clip, points, faces, np.asarray(opposite, np.intp))
    buffers = pipeline.Buffers(clip, face_index, depth, barycentric, colour, pairs)
    return blend_pairs(colour, pairs), buffers


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


def textured(clip, face_index, material, faces):
    """`pipeline.textured` without other Buffers: the colour (H, W, C), 0 where no face is seen."""
    at, footprint = footprint_kernels.footprints(*looked_up(clip, face_index, material, faces))
    picture = np.zeros((*face_index.shape, material.image.shape[2]))
    picture[face_index >= 0] = texel_kernels.texture(material.image, at, footprint,
                                                     filter_mode=material.filter_mode)
    return picture


def textured_backward(grad_colour, clip, face_index, material, faces):
    """Backward of `textured`: grad_colour (H, W, C) -> Texture of gradients, grad_clip (V, 4)."""
    where = looked_up(clip, face_index, material, faces)
    at, footprint = footprint_kernels.footprints(*where)
    grad_image, grad_at, grad_footprint, _ = texel_kernels.texture_backward(
        grad_colour[face_index >= 0], material.image, at, footprint,
        filter_mode=material.filter_mode)
    grad_uv, grad_clip = footprint_kernels.footprints_backward(grad_at, grad_footprint, *where)
    return pipeline.Texture(grad_uv, None, grad_image, None), grad_clip


def looked_up(clip, face_index, material, faces):
    """What `footprints` takes."""
    return (clip, face_index, faces, np.asarray(material.uv, float), material.uv_faces,
            footprint_kernels.runs_in_bands(face_index))


def through_texture(grad_picture, buffers, faces, material):
    """The way back through a texture, and through the blended pairs."""
    grad_colour, grad_edges = pairs_backward(grad_picture, buffers, faces)
    grad_material, grad_clip = textured_backward(
        grad_colour, buffers.clip, buffers.face_index, material, faces)
    return grad_material, grad_clip + grad_edges


def pairs_backward(grad_picture, buffers, faces):
    """The way back through the blended pairs: grad_colour (H, W, C), grad_clip (V, 4)."""
    pairs = outlines.Pairs(*map(np.ascontiguousarray, buffers.pairs))
    where = pairs, grad_picture.shape[:2], buffers.clip, faces
    grad_colour, grad_points = blend_pairs_backward(grad_picture, buffers.colour, pairs,
                                                    intersections.points(*where))
    return grad_colour, intersections.points_backward(grad_points, *where)


def blend_pairs(colour, pairs):
    """`antialiasing.blend_pairs`."""
    picture = colour.copy()
    pair_kernels.blend(picture.reshape(-1), colour.ravel(), pairs, constant(colour.shape[2]))
    return picture


def blend_pairs_backward(grad_picture, colour, pairs, clip, epsilon=0.0):
    """`antialiasing.blend_pairs_backward`."""
    (height, width, channels), grad_clip = grad_picture.shape, np.zeros(clip.shape)
    grad_colour, sides = grad_picture.copy(), pair_kernels.Sides(width, height, epsilon)
    if not pair_kernels.blend_backward(grad_picture.ravel(), colour.ravel(), pairs,
                                       constant(channels), clip, sides, grad_clip,
                                       grad_colour.reshape(-1)):
        raise IndexError("pairs name pixels or vertices that are not there: give the Buffers of "
                         "this picture")
    return grad_colour, grad_clip


def through_colours(grad_picture, buffers, faces, material):
    """The way back through colours of the vertices, and through the blended pairs."""
    shape = pixel_kernels.Shape(buffers.clip, faces, np.ascontiguousarray(material.colours, float))
    grad_colour, grad_edges = pairs_backward(grad_picture, buffers, faces)
    grad_clip, grad_colours = through_pixels(grad_colour, buffers.face_index, shape)
    return pipeline.Colours(grad_colours), grad_clip + grad_edges


def through_pixels(grad_picture, face_index, shape):
    """The way back through the pixels' own colours: grad_clip (V, 4), grad_colours (V, C)."""
    height, width, channels = grad_picture.shape
    grads = np.zeros(shape.vertices.shape), np.zeros(shape.colours.shape)

    def band(*rows):
        records = room_for((rows[1] - rows[0]) * width, channels)
        return pixel_kernels.gradient_rows(grad_picture.ravel(), grid_of(face_index), shape, rows,
                                           constant(channels), records), records

    for count, records in in_bands(band, width, height):
        if count < 0:
            raise IndexError("face_index names faces that are not there, or faces name vertices "
                             "that are not there: give the faces of this picture")
        pixel_kernels.add_runs(shape.faces, count, records, *grads)
    return grads


def grid_of(face_index):
    """A picture (H, W) as kernels take it."""
    height, width = face_index.shape
    return pixel_kernels.Grid(face_index.ravel(), width, height)


def room_for(count, channels):
    """Room for the records of so many runs."""
    return pixel_kernels.Records(np.empty(count, np.int32), np.empty((count, 3, 3)),
                                 np.empty((count, 3, channels)))


def to_vertices(grad_pixels, buffers, faces):
    """`pipeline.to_vertices`."""
    clip, faces = contiguous(buffers.clip, faces)
    channels = grad_pixels.shape[-1]
    inputs.require_shape("grad_pixels", grad_pixels, (*buffers.face_index.shape, channels))
    shape = pixel_kernels.Shape(clip, faces, np.zeros((len(clip), channels)))
    return through_pixels(np.ascontiguousarray(grad_pixels, float), buffers.face_index, shape)[1]
