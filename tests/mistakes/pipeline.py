"""Mistakes of lab 9's joined labs; each docstring goes on after "this is what comes out when"."""


def draw(clip, faces, opposite, material, width, height, background):
    """the buffer colour is antialiased, too; the way back needs the colour before antialiasing"""
    face_index, depth = scanline.rasterize(clip, faces, width, height)
    barycentric = rasterization.barycentrics(face_index, clip, faces)
    seen = Buffers(clip, face_index, depth, barycentric)
    buffers = shade(seen, faces, material, background)
    pairs = outlines.blended_pairs(face_index, depth, clip, faces, opposite)
    picture = antialiasing.blend_pairs(buffers.colour, pairs)
    return picture, buffers._replace(colour=picture, pairs=pairs)


def draw(clip, faces, opposite, material, width, height, background):
    """the background is painted over after antialiasing; it must blend with the outline"""
    buffers = shade(visible(clip, faces, width, height), faces, material, background)
    pairs = outlines.blended_pairs(buffers.face_index, buffers.depth, clip, faces, opposite)
    picture = antialiasing.blend_pairs(buffers.colour, pairs)
    picture[buffers.face_index < 0] = background
    return picture, buffers._replace(pairs=pairs)


def draw(clip, faces, opposite, material, width, height, background):
    """each edge is taken for an outline, inner edges too: blended_pairs is not given opposite"""
    buffers = shade(visible(clip, faces, width, height), faces, material, background)
    pairs = outlines.blended_pairs(buffers.face_index, buffers.depth, clip, faces,
                                   np.full(faces.shape, -1))
    return antialiasing.blend_pairs(buffers.colour, pairs), buffers._replace(pairs=pairs)


def draw(clip, faces, opposite, material, width, height, background):
    """the background is not passed on to shade: it is black"""
    buffers = shade(visible(clip, faces, width, height), faces, material, 0 * background)
    pairs = outlines.blended_pairs(buffers.face_index, buffers.depth, clip, faces, opposite)
    return antialiasing.blend_pairs(buffers.colour, pairs), buffers._replace(pairs=pairs)


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    """the path through the colours is left out of grad_clip"""
    clip, *_, colour, pairs = buffers
    grad_colour, through_edges = antialiasing.blend_pairs_backward(
        grad_picture, colour, pairs, clip)
    grad_material, *_ = shade_backward(grad_colour, buffers, faces, material)
    return grad_material, through_edges


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    """grad_derivatives is left out: a texture's footprint has no gradient"""
    clip, face_index, *_, colour, pairs = buffers
    grad_colour, through_edges = antialiasing.blend_pairs_backward(
        grad_picture, colour, pairs, clip)
    grad_material, grad_barycentric, _ = shade_backward(grad_colour, buffers, faces, material)
    through_colours = rasterizer_gradients.rasterize_backward(
        grad_barycentric, None, grad_depth, face_index, clip, faces)
    return grad_material, through_edges + through_colours


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    """the way back through antialiasing is left out: of the blend and of the edges"""
    grad_material, *grad_weights = shade_backward(grad_picture, buffers, faces, material)
    return grad_material, rasterizer_gradients.rasterize_backward(
        *grad_weights, grad_depth, buffers[1], buffers[0], faces)
