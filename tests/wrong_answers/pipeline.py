"""Wrong answers to pipeline, written without a look at the checks."""


def draw(clip, faces, opposite, surface, width, height, background):
    """the colour in the buffers is the antialiased picture, not the one before antialiasing

    told by: buffers & before | colour & before | buffers & antialias | buffers.colour | colour & already | buffers & picture & same
    """
    buffers = shade(visible(clip, faces, width, height), faces, surface, background)
    picture = outlines.antialias(buffers.colour, buffers.face_index, buffers.depth, clip, faces,
                                 opposite)
    return picture, buffers._replace(colour=picture)


def draw(clip, faces, opposite, surface, width, height, background):
    """the picture is not antialiased: it is the shaded colour

    told by: not antialias | no antialias | without antialias | before antialias | antialias & miss | not blended | antialias & left out | shaded colour | unblended
    """
    seen = visible(clip, faces, width, height)
    buffers = shade(seen, faces, surface, background)
    outlines.antialias(buffers.colour, seen.face_index, seen.depth, clip, faces, opposite)
    return buffers.colour.copy(), buffers


def draw(clip, faces, opposite, surface, width, height, background):
    """width and height are exchanged

    told by: width & height | swap & size | height & swap | transpos | (W, H | rows & columns
    """
    seen = visible(clip, faces, height, width)
    buffers = shade(seen, faces, surface, background)
    _, face_index, depth, *_ = buffers
    picture = outlines.antialias(buffers.colour, face_index, depth, clip, faces, opposite)
    return picture, buffers


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """grad_clip lacks the path through the edges, that of antialiasing

    told by: through & edges | edges & path | edges & miss | outline | antialias & grad_clip | antialias & add | only & colours | first & grad_clip | silhouette
    """
    clip, face_index, depth, barycentric, derivatives, colour = buffers
    grad_colour, _ = outlines.antialias_backward(grad_picture, colour, face_index, depth, clip,
                                                 faces, opposite)
    grad_surface, grad_barycentric, grad_derivatives = surface_backward(grad_colour, buffers,
                                                                        faces, surface)
    grad_clip = rasterizer_gradients.rasterize_backward(
        grad_barycentric, grad_derivatives, grad_depth, face_index, clip, faces)
    return grad_surface, grad_clip


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """the surface gets grad_picture, not the grad_colour that comes out of antialiasing's backward

    told by: grad_picture & surface | grad_picture & instead | grad_colour & antialias | grad_colour & outline | before antialias | surface & antialias | blend & surface | skip & antialias | unblended
    """
    whole = Buffers(*buffers)
    grad_clip = outlines.antialias_backward(grad_picture, whole.colour, whole.face_index,
                                            whole.depth, whole.clip, faces, opposite)[1]
    grad_surface, by_weights, by_changes = surface_backward(grad_picture, buffers, faces, surface)
    grad_clip = grad_clip + rasterizer_gradients.rasterize_backward(
        by_weights, by_changes, grad_depth, whole.face_index, whole.clip, faces)
    return grad_surface, grad_clip


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """grad_depth is not passed on: the depth's gradient is lost

    told by: grad_depth | depth & ignor | depth & lost | depth & path | depth & miss | depth & pass
    """
    b = Buffers(*buffers)
    grad_colour, grad_clip = outlines.antialias_backward(
        grad_picture, b.colour, b.face_index, b.depth, b.clip, faces, opposite)
    grad_surface, *rest = surface_backward(grad_colour, b, faces, surface)
    grad_clip += rasterizer_gradients.rasterize_backward(*rest, None, b.face_index, b.clip, faces)
    return grad_surface, grad_clip


def draw(clip, faces, opposite, surface, width, height, background):
    """the buffers keep the antialiased picture as their colour, not the colour before antialiasing

    told by: before antialias | buffers & antialias | buffers.colour | colour & buffers | not yet antialias | without antialias | unblended
    """
    full = shade(visible(clip, faces, width, height), faces, surface, background)
    smooth = outlines.antialias(full.colour, full.face_index, full.depth, clip, faces, opposite)
    return smooth, full._replace(colour=smooth)


def draw(clip, faces, opposite, surface, width, height, background):
    """width and height are exchanged in the call that finds what is visible

    told by: width & height | exchanged | swapped | shape & (h, w | transposed | rows & columns | height, width
    """
    buf = shade(visible(clip, faces, height, width), faces, surface, background)
    image = outlines.antialias(buf.colour, buf.face_index, buf.depth, clip, faces, opposite)
    return image, buf


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """the surface gets grad_picture, not the grad_colour that comes back through antialiasing

    told by: grad_picture & surface | grad_colour | through antialias | back through & antialias | antialias & surface | antialias & colours | antialias & skip | blend & colour
    """
    b = Buffers(*buffers)
    _, outline_clip = outlines.antialias_backward(grad_picture, b.colour, b.face_index, b.depth,
                                                  b.clip, faces, opposite)
    grad_surface, grad_bary, grad_deriv = surface_backward(grad_picture, b, faces, surface)
    inner_clip = rasterizer_gradients.rasterize_backward(grad_bary, grad_deriv, grad_depth,
                                                         b.face_index, b.clip, faces)
    return grad_surface, outline_clip + inner_clip


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """grad_depth is not handed on: the depth has no gradient

    told by: grad_depth | depth & ignored | depth & left out | depth & lost | depth & no gradient | depth & passed | loss & depth
    """
    b = Buffers(*buffers)
    grad_colour, outline_clip = outlines.antialias_backward(grad_picture, b.colour, b.face_index,
                                                            b.depth, b.clip, faces, opposite)
    grad_surface, grad_bary, grad_deriv = surface_backward(grad_colour, b, faces, surface)
    inner_clip = rasterizer_gradients.rasterize_backward(grad_bary, grad_deriv, None,
                                                         b.face_index, b.clip, faces)
    return grad_surface, outline_clip + inner_clip
