"""Mistakes of lab 9's joined labs; each docstring goes on after "this is what comes out when"."""


def draw(clip, faces, opposite, surface, width, height, background):
    """the picture is not antialiased"""
    face_index, depth = scanline.rasterize(clip, faces, width, height)
    barycentric = rasterization.barycentrics(face_index, clip, faces)
    seen = Buffers(clip, face_index, depth, barycentric)
    buffers = shade(seen, faces, surface, background)
    return buffers.colour, buffers


def draw(clip, faces, opposite, surface, width, height, background):
    """the buffer colour is antialiased, too; the way back needs the colour of before"""
    face_index, depth = scanline.rasterize(clip, faces, width, height)
    barycentric = rasterization.barycentrics(face_index, clip, faces)
    seen = Buffers(clip, face_index, depth, barycentric)
    buffers = shade(seen, faces, surface, background)
    picture = outlines.antialias(buffers.colour, face_index, depth, clip, faces, opposite)
    return picture, buffers._replace(colour=picture)


def draw(clip, faces, opposite, surface, width, height, background):
    """width and height are swapped"""
    face_index, depth = scanline.rasterize(clip, faces, height, width)
    barycentric = rasterization.barycentrics(face_index, clip, faces)
    seen = Buffers(clip, face_index, depth, barycentric)
    buffers = shade(seen, faces, surface, background)
    picture = outlines.antialias(buffers.colour, face_index, depth, clip, faces, opposite)
    return picture, buffers


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """the path through the edges is left out of grad_clip"""
    clip, face_index, depth, *_, colour = buffers
    grad_colour, _ = outlines.antialias_backward(
        grad_picture, colour, face_index, depth, clip, faces, opposite)
    grad_surface, *grad_weights = surface_backward(grad_colour, buffers, faces, surface)
    through_colours = rasterizer_gradients.rasterize_backward(
        *grad_weights, grad_depth, face_index, clip, faces)
    return grad_surface, through_colours


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """the path through the colours is left out of grad_clip"""
    clip, face_index, depth, *_, colour = buffers
    grad_colour, through_edges = outlines.antialias_backward(
        grad_picture, colour, face_index, depth, clip, faces, opposite)
    grad_surface, *_ = surface_backward(grad_colour, buffers, faces, surface)
    return grad_surface, through_edges


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """grad_picture goes on to the colours; it is grad_colour, after the blend"""
    clip, face_index, depth, *_, colour = buffers
    _, through_edges = outlines.antialias_backward(
        grad_picture, colour, face_index, depth, clip, faces, opposite)
    grad_surface, *grad_weights = surface_backward(grad_picture, buffers, faces, surface)
    through_colours = rasterizer_gradients.rasterize_backward(
        *grad_weights, grad_depth, face_index, clip, faces)
    return grad_surface, through_edges + through_colours
