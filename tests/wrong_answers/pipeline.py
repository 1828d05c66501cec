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
    """the picture is not antialiased: the shaded colour is returned

    told by: antialias | edges & blend | not smoothed | blend
    """
    seen = visible(clip, faces, width, height)
    buffers = shade(seen, faces, surface, background)
    return buffers.colour, buffers


def draw(clip, faces, opposite, surface, width, height, background):
    """the buffers hold the antialiased picture as their colour, where the colour before antialiasing belongs

    told by: colour before antialias | before antialias | buffers & colour | buffers.colour | antialiased & colour & buffers
    """
    buffers = shade(visible(clip, faces, width, height), faces, surface, background)
    picture = outlines.antialias(buffers.colour, buffers.face_index, buffers.depth, clip, faces,
                                 opposite)
    return picture, buffers._replace(colour=picture)


def draw(clip, faces, opposite, surface, width, height, background):
    """the background is black: the argument is not passed on to shade

    told by: background & black | background & ignored | background & not used | background & passed | background & zero
    """
    seen = visible(clip, faces, width, height)
    buffers = shade(seen, faces, surface, np.zeros_like(background))
    picture = outlines.antialias(buffers.colour, *buffers[1:3], clip, faces, opposite)
    return picture, buffers


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """the path through the edges is left out: antialiasing's grad_clip is not added

    told by: through the edges | antialiasing's grad_clip | edges & missing | edges & left out | path & edges | only & colours
    """
    clip, face_index, depth, *_, colour = buffers
    grad_colour, _ = outlines.antialias_backward(grad_picture, colour, face_index, depth, clip,
                                                 faces, opposite)
    grad_surface, grad_b, grad_db = surface_backward(grad_colour, buffers, faces, surface)
    grad_clip = rasterizer_gradients.rasterize_backward(grad_b, grad_db, grad_depth, face_index,
                                                        clip, faces)
    return grad_surface, grad_clip


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """the surface gets grad_picture, not the grad_colour that comes back from antialiasing

    told by: not the grad_colour | gets grad_picture | instead of grad_colour | before antialias | skips & antialias | grad_picture & surface
    """
    clip, face_index, depth, *_, colour = buffers
    _, through_edges = outlines.antialias_backward(
        grad_picture, colour, face_index, depth, clip, faces, opposite)
    grad_surface, *grads = surface_backward(grad_picture, buffers, faces, surface)
    through_colours = rasterizer_gradients.rasterize_backward(*grads, grad_depth, face_index, clip,
                                                              faces)
    return grad_surface, through_edges + through_colours


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """the two grad_clips are averaged, not added

    told by: averag | mean | half | 0.5 | added | 1/2
    """
    clip, face_index, depth, *_, colour = buffers
    grad_colour, g1 = outlines.antialias_backward(
        grad_picture, colour, face_index, depth, clip, faces, opposite)
    grad_surface, *grads = surface_backward(grad_colour, buffers, faces, surface)
    g2 = rasterizer_gradients.rasterize_backward(*grads, grad_depth, face_index, clip, faces)
    return grad_surface, (g1 + g2) / 2


def draw_backward(grad_picture, buffers, faces, opposite, surface, grad_depth=None):
    """buffers is used like the named tuple, though it is a plain one: buffers.clip does not exist

    told by: plain tuple | named | NamedTuple | attribute | buffers.clip | no attribute
    """
    grad_colour, through_edges = outlines.antialias_backward(
        grad_picture, buffers.colour, buffers.face_index, buffers.depth, buffers.clip, faces,
        opposite)
    grad_surface, *grad_weights = surface_backward(grad_colour, buffers, faces, surface)
    through_colours = rasterizer_gradients.rasterize_backward(
        *grad_weights, grad_depth, buffers.face_index, buffers.clip, faces)
    return grad_surface, through_edges + through_colours
