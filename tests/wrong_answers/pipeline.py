"""Wrong answers to pipeline, written without a look at the checks."""


def draw(clip, faces, opposite, surface, width, height, background):
    """width and height are exchanged

    told by: width | height | transpos | rows & columns
    """
    seen = visible(clip, faces, height, width)
    buffers = shade(seen, faces, surface, background)
    picture = outlines.antialias(buffers.colour, seen.face_index, seen.depth, clip, faces, opposite)
    return picture, buffers


def draw(clip, faces, opposite, surface, width, height, background):
    """the buffers come first and the picture second

    told by: order & results | picture & second | buffers & first | exchanged | swapped | other order
    """
    seen = visible(clip, faces, width, height)
    buffers = shade(seen, faces, surface, background)
    picture = outlines.antialias(buffers.colour, seen.face_index, seen.depth, clip, faces, opposite)
    return buffers, picture


def draw(clip, faces, opposite, surface, width, height, background):
    """the background is painted over after antialiasing, so that it never blends with the outline

    told by: background & after | background & outline | background & over | background & blend | outer edge | background & antialias
    """
    buffers = shade(visible(clip, faces, width, height), faces, surface, background)
    picture = outlines.antialias(buffers.colour, buffers.face_index, buffers.depth, clip, faces,
                                 opposite)
    picture[buffers.face_index < 0] = background
    return picture, buffers


def draw(clip, faces, opposite, surface, width, height, background):
    """only the picture is returned, without the buffers

    told by: only the picture | without the buffers | buffers & missing | two results | buffers are not | no buffers
    """
    seen = visible(clip, faces, width, height)
    colour = shade(seen, faces, surface, background).colour
    return outlines.antialias(colour, seen.face_index, seen.depth, clip, faces, opposite)


def draw(clip, faces, opposite, surface, width, height, background):
    """all edges are taken for outlines: antialias gets -1 for each opposite vertex

    told by: opposite | silhouette | inner edges | all edges | every edge | interior
    """
    face_index, depth = scanline.rasterize(clip, faces, width, height)
    weights = rasterization.barycentrics(face_index, clip, faces)
    buffers = shade(Buffers(clip, face_index, depth, weights), faces, surface, background)
    picture = outlines.antialias(buffers.colour, face_index, depth, clip, faces,
                                 np.full(faces.shape, -1))
    return picture, buffers


def draw(clip, faces, opposite, surface, width, height, background):
    """the buffers of visible are returned, without the colour and derivatives that shade adds

    told by: shade adds | buffers & without & colour | before shad | buffers of visible | colour is None | buffers & colour & missing
    """
    seen = visible(clip, faces, width, height)
    shaded = shade(seen, faces, surface, background)
    picture = outlines.antialias(shaded.colour, seen.face_index, seen.depth, clip, faces, opposite)
    return picture, seen


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """the path through the colours is left out: rasterize_backward's grad_clip is not added

    told by: through the colours | rasterize_backward & missing | colours & left out | inside of faces | only & edges | rasterize_backward & not added
    """
    clip, face_index, depth, *_, colour = buffers
    grad_colour, grad_clip = outlines.antialias_backward(
        grad_picture, colour, face_index, depth, clip, faces, opposite)
    grad_surface = surface_backward(grad_colour, buffers, faces, surface)[0]
    return grad_surface, grad_clip


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """grad_depth is ignored: None is passed to rasterize_backward

    told by: grad_depth | depth & ignored | depth & missing | depth & left out | depth
    """
    clip, face_index, depth = buffers[0], buffers[1], buffers[2]
    colour = buffers[-1]
    grad_colour, grad_1 = outlines.antialias_backward(grad_picture, colour, face_index, depth, clip,
                                                      faces, opposite)
    grad_surface, grad_weights, grad_change = surface_backward(grad_colour, buffers, faces, surface)
    grad_2 = rasterizer_gradients.rasterize_backward(grad_weights, grad_change, None, face_index,
                                                     clip, faces)
    return grad_surface, grad_1 + grad_2


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """grad_derivatives is dropped, so that a texture's footprint has no gradient

    told by: grad_derivatives | footprint | derivatives & missing | derivatives & left out | derivatives | texture
    """
    clip, face_index, depth, *_, colour = buffers
    grad_colour, through_edges = outlines.antialias_backward(
        grad_picture, colour, face_index, depth, clip, faces, opposite)
    grad_surface, grad_barycentric, _ = surface_backward(grad_colour, buffers, faces, surface)
    through_colours = rasterizer_gradients.rasterize_backward(
        grad_barycentric, None, grad_depth, face_index, clip, faces)
    return grad_surface, through_edges + through_colours


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """the gradient of edges is subtracted from that of the colours

    told by: subtract | sign | minus | added | negat
    """
    clip, face_index, depth, *_, colour = buffers
    grad_colour, grad_edges = outlines.antialias_backward(
        grad_picture, colour, face_index, depth, clip, faces, opposite)
    grad_surface, *grads = surface_backward(grad_colour, buffers, faces, surface)
    grad_clip = rasterizer_gradients.rasterize_backward(*grads, grad_depth, face_index, clip, faces)
    grad_clip -= grad_edges
    return grad_surface, grad_clip


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """the results are returned in the other order: grad_clip, grad_surface

    told by: order | exchanged | swapped | grad_clip & first | grad_surface & second
    """
    clip, face_index, depth, *_, colour = buffers
    grad_colour, through_edges = outlines.antialias_backward(
        grad_picture, colour, face_index, depth, clip, faces, opposite)
    grad_surface, grad_b, grad_d = surface_backward(grad_colour, buffers, faces, surface)
    through_colours = rasterizer_gradients.rasterize_backward(
        grad_b, grad_d, grad_depth, face_index, clip, faces)
    return through_edges + through_colours, grad_surface
