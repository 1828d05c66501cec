"""Lab 9's joined labs once more: a sum over the channels, and each path of the way back alone."""
import numpy as np

from reference import antialiasing, intersections, pipeline, rasterizer_gradients
from reference.pipeline import Buffers, Colours, Texture  # noqa: F401, for the checks


def draw(clip, faces, opposite, material, width, height, background):
    clip = np.asarray(clip, float)
    seen = pipeline.visible(clip, faces, width, height)
    buffers = pipeline.shade(seen, faces, material, background)
    channels = np.moveaxis(buffers.colour, -1, 0)
    pairs = intersections.all_pairs(seen.face_index, seen.depth, clip, faces, opposite)
    picture = [antialiasing.blend_pairs(channel[..., None], pairs)[..., 0] for channel in channels]
    backwards = tuple(np.asarray(values)[..., ::-1] for values in pairs)
    return np.stack(picture, -1), (*buffers[:5], backwards)


def draw_backward(grad_picture, buffers, faces, material, grad_depth=None):
    clip, face_index, depth, *_, colour, pairs = buffers
    grad_clip = np.zeros(np.shape(clip))
    grad_colour = np.empty(np.shape(colour))
    for k in range(grad_colour.shape[2]):  # the way back is linear: channel by channel
        part, through_edges = intersections.all_pairs_backward(
            grad_picture[..., k:k + 1], colour[..., k:k + 1], pairs, clip, faces)
        grad_colour[..., k:k + 1] = part
        grad_clip += through_edges
    grad_material, *grad_weights = pipeline.shade_backward(grad_colour, buffers, faces, material)
    if grad_depth is not None:
        grad_clip += rasterizer_gradients.rasterize_backward(
            np.zeros((*np.shape(depth), 3)), None, grad_depth, face_index, clip, faces)
    grad_clip += rasterizer_gradients.rasterize_backward(*grad_weights, None, face_index, clip,
                                                         faces)
    return grad_material, grad_clip
