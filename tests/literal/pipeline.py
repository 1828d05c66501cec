"""Lab 9 as printed, where it joins the labs."""


def draw(clip, faces, opposite, material, width, height, background):
    face_index, depth = scanline.rasterize(clip, faces, width, height)
    barycentric = rasterization.barycentrics(face_index, clip, faces)
    seen = Buffers(clip, face_index, depth, barycentric)
    buffers = shade(seen, faces, material, background)
    pairs = outlines.blended_pairs(face_index, depth, clip, faces, opposite)
    picture = antialiasing.blend_pairs(buffers.colour, pairs)
    return picture, (*buffers[:-1], pairs)


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    clip, face_index, _, _, colour, pairs = buffers
    grad_colour, grad_clip = antialiasing.blend_pairs_backward(grad_picture, colour, pairs, clip)
    grad_material, grad_barycentric, grad_derivatives = shade_backward(grad_colour, buffers, faces,
                                                                       material)
    grad_clip = grad_clip + rasterizer_gradients.rasterize_backward(
        grad_barycentric, grad_derivatives, grad_depth, face_index, clip, faces)
    return grad_material, grad_clip
