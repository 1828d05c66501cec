"""Outlines that are smooth, and pull at the vertices: antialias."""
import functools

import numpy as np
import torch

from apps.bridge import tensors
from apps.bridge.tensors import INTEGERS, array, joined, require

from .pixels import seen_in

EPSILON = 1e-3  # pixels; keeps edges from 0 height, in nvdiffrast's backward pass


def antialias_construct_topology_hash(tri):
    """The vertices (F, 3) across each edge of each face, kept for a mesh in any case."""
    return opposite_corners(array("tri", tri, "f 3", INTEGERS).tobytes(), tensors.labs.package)


@functools.lru_cache(maxsize=16)
def opposite_corners(faces, package):
    """Lab 8's `opposite_corners` of faces as bytes, by the labs of this package."""
    faces = np.frombuffer(faces, np.int32).reshape(-1, 3)
    return tensors.labs.antialiasing.opposite_corners(faces.astype(np.intp))


def antialias(color, rast, pos, tri, topology_hash=None, pos_gradient_boost=1.0):
    """The pictures color (N, H, W, C), blended where a silhouette runs between two pixels.

    rast, pos and tri as of `rasterize`. pos_gradient_boost multiplies the gradient of pos.
    """
    if topology_hash is None:
        topology_hash = antialias_construct_topology_hash(tri)
    require(isinstance(topology_hash, np.ndarray) and topology_hash.shape == tri.shape,
            "topology_hash must come from antialias_construct_topology_hash(tri)")
    require(color.shape[:3] == rast.shape[:3], f"color and rast must be of the same pictures; they "
            f"have {tuple(color.shape)} and {tuple(rast.shape)}")
    return Antialias.apply(color, rast, pos, tri, topology_hash, pos_gradient_boost)


class Antialias(torch.autograd.Function):
    """Lab 8."""

    @staticmethod
    def forward(ctx, color, rast, pos, tri, opposite, boost):
        faces = array("tri", tri, "f 3", INTEGERS)
        colours = array("color", color, "n h w c")
        seen = array("rast", rast, f"{len(color)} h w 4")
        out, ctx.pairs = [], []
        kernels = tensors.kernels(color, rast, pos, faces=faces)
        unpacked = kernels.unpacked if kernels else seen_in
        ctx.lab8 = tensors.labs.compiled_pipeline if kernels else tensors.labs.outlines
        for n, clip in enumerate(vertices(pos, len(color))):
            given = seen[n], faces, len(clip)
            face_index, depth = unpacked(*given) or seen_in(*given)
            ctx.pairs.append((kernels or ctx.lab8).blended_pairs(face_index, depth, clip, faces,
                                                                 opposite))
            out.append(ctx.lab8.blend_pairs(colours[n], ctx.pairs[n]))
        ctx.save_for_backward(color, pos)
        ctx.boost = boost
        return joined(out, color)

    @staticmethod
    @tensors.first_order
    def backward(ctx, grad):
        color, pos = ctx.saved_tensors
        given = grad.numpy(), color.detach().numpy(), ctx.pairs, vertices(pos, len(color))
        grads = (ctx.lab8.blend_pairs_backward(*each, EPSILON)
                 for each in zip(*given, strict=True))
        grad_color, grad_clip = zip(*grads, strict=True)
        grad_pos = ctx.boost * joined(grad_clip if pos.ndim == 3 else [sum(grad_clip)], pos)
        return joined(grad_color, color), None, grad_pos, None, None, None


def vertices(pos, count):
    """The clip positions (V, 4) of each of count pictures."""
    if pos.ndim == 3:
        return array("pos", pos, f"{count} v 4")
    return count * [array("pos", pos, "v 4")]
