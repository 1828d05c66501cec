"""What the corners of a face know, seen at each pixel: interpolate."""
from typing import NamedTuple

import numpy as np
import torch

from apps.bridge import tensors
from apps.bridge.tensors import INTEGERS, array, require, tensor

from .pixels import faces_of


def interpolate(attr, rast, tri, rast_db=None, diff_attrs=None):
    """The corners' attributes at each pixel (N, H, W, A), and derivatives of D (N, H, W, 2 D).

    attr (N or 1, V, A), or (V, A) for pictures of ranges. diff_attrs: a list of the D attributes
    whose dA/dX and dA/dY are wanted, or "all". They need rast_db.
    """
    count = attr.shape[-1]
    chosen = chosen_of(diff_attrs, count)
    require(not len(chosen) or rast_db is not None, "diff_attrs needs rast_db, which rasterize() "
            "returned beside rast")
    return Interpolate.apply(attr, rast, tri, rast_db if len(chosen) else None, chosen)


def chosen_of(diff_attrs, count):
    """The numbers (D,), from 0 on, of those of count attributes that diff_attrs asks for."""
    if isinstance(diff_attrs, str) and diff_attrs == "all":
        return np.arange(count)
    chosen = np.asarray([] if diff_attrs is None else diff_attrs)
    require(chosen.ndim == 1 and (chosen.dtype.kind in "iu" or not len(chosen)), "diff_attrs must "
            f'be None, "all" or a list of whole numbers; it is {diff_attrs}')
    require((np.abs(chosen + 0.5) < count).all(), f"diff_attrs must number some of {count} "
            f"attributes; it is {diff_attrs}")
    return chosen.astype(int) % count


class Look(NamedTuple):
    """Pictures (H, W) of one array of attributes: which face a pixel sees, and how it mixes the
    corners' attributes: weights (H, W, 3) of the values and, for derivatives, those of x and y.
    """

    face_index: np.ndarray
    weights: list[np.ndarray]


def looks(attr, rast, tri, rast_db):
    """A Look for each array of attributes. If there is only one, all pictures are one, one above
    the other.
    """
    faces = array("tri", tri, "f 3", INTEGERS)
    count, width = 1 if attr.ndim == 2 else len(attr), rast.shape[2]
    require(count in (1, len(rast)), f"attr must have the attributes of 1 or of {len(rast)} "
            f"pictures, as rast has; it has those of {count}")
    pixels = array("rast", rast, "n h w 4").reshape(count, -1, width, 4)
    changes = [] if rast_db is None else array("rast_db", rast_db, f"{len(rast)} h w 4").reshape(
        count, -1, width, 2, 2)
    for k, pixel in enumerate(pixels):
        face_index = faces_of(pixel, len(faces))
        weights = [corner_weights(pixel[..., :2], 1)]
        if len(changes):
            weights += [corner_weights(changes[k, ..., axis], 0) for axis in (0, 1)]
        yield Look(face_index, weights)


def corner_weights(uv, total):
    """u and v (H, W, 2) of corners 0 and 1 -> the weights (H, W, 3), whose sum is total."""
    weights = np.empty((*uv.shape[:2], 3))
    weights[..., :2] = uv
    weights[..., 2] = total - weights[..., 0] - weights[..., 1]
    return weights


class Interpolate(torch.autograd.Function):
    """Lab 5: `interpolate` with each of a Look's weights, and `interpolate_backward`."""

    @staticmethod
    def forward(ctx, attr, rast, tri, rast_db, chosen):
        values = array("attr", attr, "n v a" if attr.ndim == 3 else "v a")
        values = values.reshape(-1, *values.shape[-2:])
        ctx.looks = list(looks(attr, rast, tri, rast_db))
        faces = array("tri", tri, "f 3", INTEGERS)
        ctx.lab5 = tensors.kernels(attr) or tensors.labs.interpolation
        mix = ctx.lab5.interpolate
        out = [mix(value, faces, look.face_index, look.weights[0])
               for look, value in zip(ctx.looks, values, strict=True)]
        out_da = [np.stack([mix(value[:, chosen], faces, look.face_index, weights)
                            for weights in look.weights[1:]], -1)
                  for look, value in zip(ctx.looks, values, strict=True) if len(chosen)]
        ctx.save_for_backward(attr, rast, tri)
        ctx.values, ctx.chosen = values, chosen
        ctx.set_materialize_grads(False)
        size = rast.shape[:3]
        return (tensor(np.stack(out), attr, (*size, attr.shape[-1])),
                tensor(np.stack(out_da), attr, (*size, 2 * len(chosen))) if out_da
                else attr.new_empty(*size, 0))

    @staticmethod
    @tensors.first_order
    def backward(ctx, grad_out, grad_out_da):
        attr, rast, tri = ctx.saved_tensors
        faces = array("tri", tri, "f 3", INTEGERS)
        grad_values = np.zeros(ctx.values.shape)
        kinds = 1 if grad_out_da is None else 3
        grad_weights = np.zeros((kinds, *np.shape([look.face_index for look in ctx.looks]), 3))
        for n, columns, grads in upstream(grad_out, grad_out_da, ctx.chosen, len(ctx.values)):
            for k, (look, value) in enumerate(zip(ctx.looks, ctx.values, strict=True)):
                by_corner, grad_weights[n, k] = ctx.lab5.interpolate_backward(
                    grads[k].reshape(*look.face_index.shape, -1), value[:, columns], faces,
                    look.face_index, look.weights[n])
                np.add.at(grad_values[k], (slice(None), columns), by_corner)
        grad_uv = grad_weights[..., :2] - grad_weights[..., 2:]  # as weight 2 is total - u - v
        grad_rast = torch.zeros_like(rast)
        grad_rast[..., :2] = tensor(grad_uv[0], rast, (*rast.shape[:3], 2))
        grad_rast_db = tensor(np.stack(grad_uv[1:], -1), rast) if kinds == 3 else None
        return tensor(grad_values, attr), grad_rast, None, grad_rast_db, None


def upstream(grad_out, grad_out_da, chosen, count):
    """What comes back: which matrix, the attributes' columns, the gradients (count, P, columns)."""
    if grad_out is not None:
        channels = grad_out.shape[-1]
        yield 0, np.arange(channels), grad_out.numpy().reshape(count, -1, channels)
    if grad_out_da is not None and len(chosen):
        by_axis = np.moveaxis(grad_out_da.numpy().reshape(count, -1, len(chosen), 2), -1, 0)
        yield from ((1 + axis, chosen, grads) for axis, grads in enumerate(by_axis))
