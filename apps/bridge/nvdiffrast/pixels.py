"""What each pixel sees: rasterize, layer by layer if need be."""
import operator
import sys

import numpy as np
import torch

from apps.bridge import tensors
from apps.bridge.tensors import EXACT, INTEGERS, array, joined, require
from course.given import inputs

EPSILON = 1e-6  # keeps the area of a face from 0, in nvdiffrast's backward pass
CODE = 0x4A800000  # a number above EXACT is the float32 whose bits are this and the number
GRID = tensors.GRID


class RasterizeCudaContext:
    """Where a CUDA program keeps its rasterizer. Here it only knows who peels."""

    def __init__(self, device=None):
        self.active_depth_peeler = None


class RasterizeGLContext(RasterizeCudaContext):
    """The context of older programs."""

    def __init__(self, output_db=True, mode="automatic", device=None):
        super().__init__(device)

    def set_context(self):
        """Nothing, as in nvdiffrast by now."""

    release_context = set_context


def rasterize(glctx, pos, tri, resolution, ranges=None, grad_db=True):
    """rast (N, H, W, 4) = u, v, z/w, face's number + 1; rast_db = du/dX, du/dY, dv/dX, dv/dY.

    pos (N, V, 4), or (V, 4) and ranges (N, 2): first face and count; tri (F, 3); resolution H, W.
    """
    given = asked(glctx, pos, tri, resolution, ranges, grad_db)
    require(glctx.active_depth_peeler is None, "a DepthPeeler has this context: call its "
            "rasterize_next_layer(), or rasterize() with another context")
    return Rasterize.apply(*given, None)


def asked(glctx, pos, tri, resolution, ranges, grad_db):
    """The arguments of `rasterize` but for its context, checked."""
    require(isinstance(glctx, RasterizeCudaContext), "glctx must be a RasterizeCudaContext")
    require(isinstance(grad_db, bool), f"grad_db must be True or False; it is {grad_db}")
    return pos, tri, size_of(resolution), ranges, grad_db


class DepthPeeler:
    """For `with`: a rasterizer of depth layers, the nearest first. Arguments as of `rasterize`."""

    def __init__(self, glctx, pos, tri, resolution, ranges=None, grad_db=True):
        self.context = glctx
        self.given = asked(glctx, pos, tri, resolution, ranges, grad_db)

    def __enter__(self):
        require(self.given, "this DepthPeeler has ended: make a new one")
        require(self.context.active_depth_peeler is None, "another DepthPeeler has this context")
        self.context.active_depth_peeler = self
        self.depths = {}  # picture -> depth of its last layer, as exact as it was found
        return self

    def __exit__(self, *_):
        self.context.active_depth_peeler = self.given = None

    def rasterize_next_layer(self):
        """What `rasterize` returns, of all that lies deeper than the last layer."""
        require(self.context.active_depth_peeler is self, "call this inside of the with block")
        return Rasterize.apply(*self.given, self.depths)


def size_of(resolution):
    """height, width."""
    try:
        height, width = map(operator.index, resolution)
    except (TypeError, ValueError):  # not whole, or not two
        height = width = 0
    require(height > 0 and width > 0, "resolution must be (height, width), whole numbers above 0; "
            f"it is {resolution}")
    return height, width


def pictures(pos, tri, ranges):
    """For each picture of a batch its vertices (V, 4), its faces, and the first face's number."""
    faces = array("tri", tri, "f 3", INTEGERS)
    if pos.ndim == 3:
        return [(clip, faces, 0) for clip in array("pos", pos, "n v 4")]
    require(ranges is not None, "pos must have the shape (n, v, 4), or ranges must be given")
    clip, rows = array("pos", pos, "v 4"), array("ranges", ranges, "n 2", INTEGERS).tolist()
    require(all(0 <= first <= first + count <= len(faces) for first, count in rows), "ranges must "
            f"be first faces and counts, within the {len(faces)} of tri; they are {rows}")
    return [(clip, faces[first:first + count], first) for first, count in rows]


class Rasterize(torch.autograd.Function):
    """Labs 2 and 7."""

    @staticmethod
    def forward(ctx, pos, tri, size, ranges, grad_db, depths):
        batch = pictures(pos, tri, ranges)
        rast, rast_db = np.zeros((2, len(batch), *size, 4), batch[0][0].dtype)
        ctx.seen, ctx.way = [], (not GRID and tensors.kernels(pos)) or sys.modules[__name__]
        for n, (clip, faces, first) in enumerate(batch):
            face_index, depth, *runs = ctx.way.draw_pixels(
                clip, faces, first, depths.get(n) if depths else None, rast[n], rast_db[n])
            if first + len(faces) > EXACT:
                rast[n, ..., 3] = coded(np.where(face_index < 0, 0, face_index + (first + 1)),
                                        rast.dtype)
            ctx.seen.append((face_index, *runs))
            if depths is not None:
                depths[n] = depth
        rast, rast_db = torch.from_numpy(rast), torch.from_numpy(rast_db)
        ctx.save_for_backward(pos, tri, rast)
        ctx.batch, ctx.grad_db = batch, grad_db
        ctx.set_materialize_grads(False)
        return rast, rast_db

    @staticmethod
    @tensors.first_order
    def backward(ctx, grad_rast, grad_rast_db):
        pos, *_ = ctx.saved_tensors
        grads_db = grad_rast_db if ctx.grad_db else None
        grads = [ctx.way.draw_pixels_backward(*(None if grad is None else grad[n].numpy()
                                         for grad in (grad_rast, grads_db)),
                                       *ctx.seen[n], clip, faces, EPSILON)
                 for n, (clip, faces, _) in enumerate(ctx.batch)]
        grad_pos = joined(grads if pos.ndim == 3 else [sum(grads)], pos)
        return grad_pos, None, None, None, None, None


def draw_pixels(clip, faces, first, beyond, rast, rast_db):
    """Writes to rast and rast_db (H, W, 4), 0 before -> face_index, depth (H, W). Faces are
    numbered from first on. beyond: a depth (H, W), of which only what lies deeper is seen, or None.
    """
    height, width, _ = rast.shape
    lab5 = tensors.labs.interpolation
    if beyond is None and not GRID:
        clip, face_index, depth, weights, *_ = tensors.labs.pipeline.visible(clip, faces, width,
                                                                             height)
    else:
        drawn = rounded(clip, width, height) if GRID else clip
        face_index, depth = tensors.labs.scanline.rasterize(drawn, faces, width, height, beyond)
        weights = lab5.barycentrics(face_index, clip, faces)
    seen = face_index >= 0
    uv = weights[..., :2].clip(0, 1)  # rounded vertices may leave a pixel outside of its face
    rast[..., :2] = uv / np.maximum(uv.sum(-1, keepdims=True), 1)
    rast[seen, 2], rast[seen, 3] = depth[seen], face_index[seen] + (first + 1)
    derivatives = lab5.barycentrics_derivatives(face_index, clip, faces)
    rast_db[...] = derivatives[..., :2, :].reshape(rast_db.shape)
    return face_index, depth


def rounded(clip, width, height):
    """clip (V, 4) with vertices in front of the camera rounded to 1/GRID pixel, in 32 bits as CUDA
    does it. Then many edges meet a pixel's centre. So all move a little, to where rounding decides
    no tie, and the pixel is on the side that the top-left rule gives it to.
    """
    w, half = clip[:, 3:], (GRID / 2 * np.array([width, height])).astype(clip.dtype)
    divisor = np.where(w > 0, w, 1)
    place = np.rint(clip[:, :2] * (1 / divisor) * half) - (1e-6, 1e-11)
    return np.hstack([np.where(w > 0, place / half, clip[:, :2]), clip[:, 2:] / divisor])


def draw_pixels_backward(grad_rast, grad_rast_db, face_index, clip, faces, epsilon):
    """Backward of `draw_pixels` -> grad_clip (V, 4). A gradient that is None is 0."""
    grad_weights, grad_derivatives = np.zeros((*face_index.shape, 3)), None
    if grad_rast is not None:
        grad_weights[..., :2] = grad_rast[..., :2]
    if grad_rast_db is not None:
        grad_derivatives = np.zeros((*face_index.shape, 3, 2))
        grad_derivatives[..., :2, :] = grad_rast_db.reshape(*face_index.shape, 2, 2)
    return tensors.labs.rasterizer_gradients.rasterize_backward(
        grad_weights, grad_derivatives, None, face_index, clip, faces, epsilon)


def coded(numbers, dtype):
    """Whole numbers from 0 on as floats of this dtype, each as another one: see CODE."""
    floats = numbers.astype(dtype)
    if dtype == np.float32 and numbers.max() > EXACT:
        return np.where(numbers <= EXACT, floats, (numbers + CODE).astype(np.int32).view(dtype))
    return floats


def faces_of(rast):
    """The face that each pixel of an array rast (..., 4) sees, -1 for none."""
    numbers = np.ascontiguousarray(rast[..., 3])
    if rast.dtype == np.float32 and not numbers.max() <= EXACT:
        numbers = np.where(numbers <= EXACT, numbers, numbers.view(np.int32) - float(CODE))
    return numbers.astype(np.int32) - np.int32(1)


def seen_in(rast, faces, vertex_count):
    """The face that each pixel of an array rast (H, W, 4) sees, -1 for none, and its depth, inf
    for none: (H, W) each. An error says what of faces or of their vertices is not there.
    """
    face_index = faces_of(rast)
    require(face_index.max() < len(faces), f"rast sees face {face_index.max(initial=-1)}, and tri "
            f"has {len(faces)}: give the faces that rast was made of")
    inputs.require_faces(faces, vertex_count)
    return face_index, np.where(face_index < 0, np.inf, rast[..., 2])
