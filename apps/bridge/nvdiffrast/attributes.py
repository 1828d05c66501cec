"""What the corners of a face know, seen at each pixel: interpolate."""
import sys

import numpy as np
import torch

from apps.bridge import tensors
from apps.bridge.tensors import INTEGERS, array, joined, require

from .pixels import faces_of, seen_in


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
    if diff_attrs is None:
        return np.arange(0)
    if isinstance(diff_attrs, str) and diff_attrs == "all":
        return np.arange(count)
    chosen = np.asarray(diff_attrs)
    require(chosen.ndim == 1 and (chosen.dtype.kind in "iu" or not len(chosen)), "diff_attrs must "
            f'be None, "all" or a list of whole numbers; it is {diff_attrs}')
    require((np.abs(chosen + 0.5) < count).all(), f"diff_attrs must number some of {count} "
            f"attributes; it is {diff_attrs}")
    return chosen.astype(int) % count


class Interpolate(torch.autograd.Function):
    """Lab 5. If there is one array of attributes, all pictures are one, one above the other."""

    @staticmethod
    def forward(ctx, attr, rast, tri, rast_db, chosen):
        values = array("attr", attr, "n v a" if attr.ndim == 3 else "v a")
        values = values.reshape(-1, *values.shape[-2:])
        faces, count = array("tri", tri, "f 3", INTEGERS), len(values)
        require(count in (1, len(rast)), f"attr must have the attributes of 1 or of {len(rast)} "
                f"pictures, as rast has; it has those of {count}")
        ctx.way = tensors.kernels(attr, rast, rast_db, faces=faces) or sys.modules[__name__]
        pictures = array("rast", rast, "n h w 4").reshape(count, -1, rast.shape[2], 4)
        changes = np.empty((count, 0, 4), np.float32) if rast_db is None else array(
            "rast_db", rast_db, f"{len(rast)} h w 4").reshape(pictures.shape)
        ctx.given = [(value, faces, pixels, change, chosen)
                     for value, pixels, change in zip(values, pictures, changes, strict=True)]
        out, out_da = zip(*(mixed(ctx.way, *given) for given in ctx.given), strict=True)
        ctx.save_for_backward(attr, rast, tri, rast_db)
        ctx.set_materialize_grads(False)
        return (joined(out, attr, (*rast.shape[:3], attr.shape[-1])),
                joined(out_da, attr, (*rast.shape[:3], 2 * len(chosen))))

    @staticmethod
    @tensors.first_order
    def backward(ctx, *grads):
        attr, rast, _, rast_db = ctx.saved_tensors
        rows = (len(ctx.given) * [None] if grad is None or not grad.shape[-1] else
                grad.numpy().reshape(len(ctx.given), -1, grad.shape[-1]) for grad in grads)
        found = [mixed_backward(ctx.way, grad_out, grad_da, *given)
                 for grad_out, grad_da, given in zip(*rows, ctx.given, strict=True)]
        by_attr, by_rast, by_db = zip(*found, strict=True)
        has_db = rast_db is not None and grads[1] is not None
        return (joined(by_attr, attr), joined(by_rast, rast), None,
                joined(by_db, rast_db) if has_db else None, None)


def columns(chosen, rast, rast_db, out, out_da):
    """Which attributes are mixed, with u and v (P, 2) of which corners' weights, whose sum is what,
    and where the result is: all attributes, then how those chosen (D,) change along x and along y.
    """
    yield slice(None), rast.reshape(-1, 4)[:, :2], 1.0, out
    for axis in (0, 1) if len(chosen) else ():
        yield (chosen, rast_db.reshape(-1, 4)[:, axis::2], 0.0,
               None if out_da is None else out_da[:, axis::2])


def mixed(way, values, faces, rast, rast_db, chosen):
    """Lab 5's `interpolate` of values (V, A) -> (P, A), and the derivatives of those chosen (D,),
    (P, 2 D). rast and rast_db (H, W, 4).
    """
    made = [np.zeros((rast.shape[0] * rast.shape[1], count), values.dtype)
            for count in (values.shape[1], 2 * len(chosen))]
    for of, uv, total, out in columns(chosen, rast, rast_db, *made):
        if not way.mix_attributes(values[:, of], faces, rast, uv, total, out):
            seen_in(rast, faces, len(values))  # says what is not there
    return made


def mixed_backward(way, grad_out, grad_da, values, faces, rast, rast_db, chosen):
    """Backward of `mixed` -> gradients of values, rast and rast_db. grad_out and grad_da may be
    None.
    """
    grads = np.zeros(values.shape), np.zeros_like(rast), np.zeros_like(rast_db)
    looks = columns(chosen, rast, rast_db, grad_out, grad_da)
    into = columns(chosen, *grads[1:], None, None)
    for (of, uv, total, grad), (_, grad_uv, *_) in zip(looks, into, strict=True):
        if grad is not None:
            by_corner = way.mix_attributes_backward(grad, values[:, of], faces, rast, uv, total,
                                                    grad_uv)
            for c, by in zip(np.arange(values.shape[1])[of], by_corner.T, strict=True):
                grads[0][:, c] += by  # one by one, as chosen may have a number twice
    return grads


def corner_weights(face_index, uv, total):
    """u and v (P, 2) of corners 0 and 1 -> the weights (H, W, 3), whose sum is total."""
    uv = uv.reshape(*face_index.shape, 2).astype(float)
    return np.concatenate([uv, total - uv.sum(-1, keepdims=True)], -1)


def mix_attributes(values, faces, rast, uv, total, out):
    """Writes `mixed` for one of `columns` to out (P, A) -> whether all is there."""
    face_index, _ = seen_in(rast, faces, len(values))
    weights = corner_weights(face_index, uv, total)
    out[...] = tensors.labs.interpolation.interpolate(values, faces, face_index,
                                                      weights).reshape(out.shape)
    return True


def mix_attributes_backward(grad_out, values, faces, rast, uv, total, grad_uv):
    """Backward of `mix_attributes`: writes to grad_uv (P, 2) -> grad_values (V, A)."""
    face_index = faces_of(rast)
    by_corner, by_weight = tensors.labs.interpolation.interpolate_backward(
        grad_out.reshape(*face_index.shape, -1), values, faces, face_index,
        corner_weights(face_index, uv, total))
    by_weight = by_weight.reshape(-1, 3)
    grad_uv[...] = by_weight[:, :2] - by_weight[:, 2:]  # as weight 2 is total - u - v
    return by_corner
