"""Wrong answers to pipeline, written without a look at the checks."""


def draw(clip, faces, opposite, material, width, height, background):
    """the colour in the buffers is the antialiased picture, not the one before antialiasing

    told by: buffers & before | colour & before | buffers & antialias | buffers.colour | colour & already | buffers & picture & same
    """
    buffers = shade(visible(clip, faces, width, height), faces, material, background)
    pairs = outlines.blended_pairs(buffers.face_index, buffers.depth, clip, faces, opposite)
    picture = antialiasing.blend_pairs(buffers.colour, pairs)
    return picture, buffers._replace(colour=picture, pairs=pairs)


def draw(clip, faces, opposite, material, width, height, background):
    """the picture is not antialiased: it is the shaded colour

    told by: not antialias | no antialias | without antialias | before antialias | antialias & miss | not blended | antialias & left out | shaded colour | unblended
    """
    seen = visible(clip, faces, width, height)
    buffers = shade(seen, faces, material, background)
    pairs = outlines.blended_pairs(seen.face_index, seen.depth, clip, faces, opposite)
    antialiasing.blend_pairs(buffers.colour, pairs)
    return buffers.colour.copy(), buffers._replace(pairs=pairs)


def draw(clip, faces, opposite, material, width, height, background):
    """width and height are exchanged

    told by: width & height | swap & size | height & swap | transpos | (W, H | rows & columns
    """
    seen = visible(clip, faces, height, width)
    buffers = shade(seen, faces, material, background)
    _, face_index, depth, *_ = buffers
    pairs = outlines.blended_pairs(face_index, depth, clip, faces, opposite)
    return antialiasing.blend_pairs(buffers.colour, pairs), buffers._replace(pairs=pairs)


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    """grad_clip lacks the path through the edges, that of antialiasing

    told by: through & edges | edges & path | edges & miss | outline | antialias & grad_clip | antialias & add | only & colours | first & grad_clip | silhouette
    """
    clip, face_index, depth, barycentric, weights, derivatives, colour, pairs = buffers
    grad_colour, _ = antialiasing.blend_pairs_backward(grad_picture, colour, pairs, clip)
    grad_material, grad_barycentric, grad_derivatives = shade_backward(grad_colour, buffers,
                                                                       faces, material)
    grad_clip = rasterizer_gradients.rasterize_backward(
        grad_barycentric, grad_derivatives, grad_depth, face_index, clip, faces)
    return grad_material, grad_clip


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    """the material gets grad_picture, not the grad_colour that comes out of antialiasing's backward

    told by: grad_picture & shade | grad_picture & instead | grad_colour & antialias | grad_colour & outline | before antialias | material & antialias | blend & material | skip & antialias | unblended
    """
    whole = Buffers(*buffers)
    grad_clip = antialiasing.blend_pairs_backward(grad_picture, whole.colour, whole.pairs,
                                                  whole.clip)[1]
    grad_material, by_weights, by_changes = shade_backward(grad_picture, buffers, faces, material)
    grad_clip = grad_clip + rasterizer_gradients.rasterize_backward(
        by_weights, by_changes, grad_depth, whole.face_index, whole.clip, faces)
    return grad_material, grad_clip


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    """grad_depth is not passed on: the depth's gradient is lost

    told by: grad_depth | depth & ignor | depth & lost | depth & path | depth & miss | depth & pass
    """
    b = Buffers(*buffers)
    grad_colour, grad_clip = antialiasing.blend_pairs_backward(grad_picture, b.colour, b.pairs, b.clip)
    grad_material, *rest = shade_backward(grad_colour, b, faces, material)
    grad_clip += rasterizer_gradients.rasterize_backward(*rest, None, b.face_index, b.clip, faces)
    return grad_material, grad_clip


def draw(clip, faces, opposite, material, width, height, background):
    """the buffers keep the antialiased picture as their colour, not the colour before antialiasing

    told by: before antialias | buffers & antialias | buffers.colour | colour & buffers | not yet antialias | without antialias | unblended
    """
    full = shade(visible(clip, faces, width, height), faces, material, background)
    found = outlines.blended_pairs(full.face_index, full.depth, clip, faces, opposite)
    full = full._replace(colour=antialiasing.blend_pairs(full.colour, found), pairs=found)
    return full.colour, full


def draw(clip, faces, opposite, material, width, height, background):
    """width and height are exchanged in the call that finds what is visible

    told by: width & height | exchanged | swapped | shape & (h, w | transposed | rows & columns | height, width
    """
    buf = shade(visible(clip, faces, height, width), faces, material, background)
    pairs = outlines.blended_pairs(buf.face_index, buf.depth, clip, faces, opposite)
    return antialiasing.blend_pairs(buf.colour, pairs), buf._replace(pairs=pairs)


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    """the material gets grad_picture, not the grad_colour that comes back through antialiasing

    told by: grad_picture & shade | grad_colour | through antialias | back through & antialias | antialias & material | antialias & colours | antialias & skip | blend & colour
    """
    b = Buffers(*buffers)
    _, outline_clip = antialiasing.blend_pairs_backward(grad_picture, b.colour, b.pairs, b.clip)
    grad_material, grad_bary, grad_deriv = shade_backward(grad_picture, b, faces, material)
    inner_clip = rasterizer_gradients.rasterize_backward(grad_bary, grad_deriv, grad_depth,
                                                         b.face_index, b.clip, faces)
    return grad_material, outline_clip + inner_clip


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    """grad_depth is not handed on: the depth has no gradient

    told by: grad_depth | depth & ignored | depth & left out | depth & lost | depth & no gradient | depth & passed | loss & depth
    """
    b = Buffers(*buffers)
    grad_colour, outline_clip = antialiasing.blend_pairs_backward(grad_picture, b.colour, b.pairs,
                                                                  b.clip)
    grad_material, grad_bary, grad_deriv = shade_backward(grad_colour, b, faces, material)
    inner_clip = rasterizer_gradients.rasterize_backward(grad_bary, grad_deriv, None,
                                                         b.face_index, b.clip, faces)
    return grad_material, outline_clip + inner_clip


def draw(clip, faces, opposite, material, width, height, background):
    """the picture is right, but the buffers are those of shade: the pairs are not in them

    told by: pairs & buffers | pairs & missing | pairs & left out | blended_pairs
    """
    full = shade(visible(clip, faces, width, height), faces, material, background)
    smooth = outlines.antialias(full.colour, full.face_index, full.depth, clip, faces, opposite)
    return smooth, full
