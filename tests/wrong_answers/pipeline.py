"""Wrong answers to pipeline, written without a look at the checks."""


def draw(clip, faces, opposite, material, width, height, background):
    """the picture is right, but the buffers are those of shade: the pairs are not in them

    told by: pairs & buffers | pairs & missing | pairs & left out | blended_pairs
    """
    full = shade(visible(clip, faces, width, height), faces, material, background)
    smooth = outlines.antialias(full.colour, full.face_index, full.depth, clip, faces, opposite)
    return smooth, full


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    """the surface gets grad_picture, not the grad_colour that comes out of antialiasing's backward

    told by: grad_picture & surface | grad_picture & shade | grad_picture & instead | grad_colour & antialias | grad_colour & outline | before antialias | surface & antialias | blend & surface | skip & antialias | unblended
    """
    whole = Buffers(*buffers)
    grad_clip = antialiasing.blend_pairs_backward(grad_picture, whole.colour, whole.pairs,
                                              whole.clip)[1]
    grad_material, by_weights, by_changes = shade_backward(grad_picture, buffers, faces, material)
    grad_clip = grad_clip + rasterizer_gradients.rasterize_backward(
        by_weights, by_changes, grad_depth, whole.face_index, whole.clip, faces)
    return grad_material, grad_clip
