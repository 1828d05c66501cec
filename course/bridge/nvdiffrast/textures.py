"""Textures and cube maps, filtered for the size of a pixel: texture."""
from typing import NamedTuple

import numpy as np
import torch
from scipy.sparse import sparray

from .. import tensors
from ..tensors import array, require, tensor

FILTERS = "nearest", "linear", "linear-mipmap-nearest", "linear-mipmap-linear"
BOUNDARIES = "wrap", "clamp", "zero", "cube"


class MipStack(NamedTuple):
    """A texture's levels from 1 on, made once: arrays (N or 1, rows, columns, C) of pictures."""

    levels: list[np.ndarray]


def texture(tex, uv, uv_da=None, mip_level_bias=None, mip=None, filter_mode="auto",
            boundary_mode="wrap", max_mip_level=None):
    """The colours (N, H, W, C) of tex at uv, filtered for the footprint uv_da and its bias.

    tex (N or 1, h, w, C), or (N or 1, 6, n, n, C) for "cube"; uv (N, H, W, 2), or directions
    (N, H, W, 3); uv_da (N, H, W, 4 or 6); mip_level_bias (N, H, W); mip: a list of tensors, the
    levels from 1 on, or a `texture_construct_mip`.
    """
    filter = filter_of(filter_mode, uv_da is not None or mip_level_bias is not None, max_mip_level)
    require(boundary_mode in BOUNDARIES, f"boundary_mode must be one of {', '.join(BOUNDARIES)}, "
            f"not {boundary_mode!r}")
    is_cube = boundary_mode == "cube"
    if "mipmap" not in filter:
        uv_da = mip_level_bias = None
        mip = MipStack([])
    elif mip is None:
        mip = texture_construct_mip(tex, max_mip_level, is_cube)
    require(isinstance(mip, MipStack | list), "mip must be a list of tensors or come from "
            "texture_construct_mip()")
    made, stack = (mip, []) if isinstance(mip, MipStack) else (None, mip)
    return Texture.apply(tex, uv, uv_da, mip_level_bias, filter, boundary_mode, made, *stack)


def filter_of(mode, has_level, max_level):
    """The filter that filter_mode means, where pixels know a level of the pyramid or not."""
    if mode == "auto":
        mode = "linear-mipmap-linear" if has_level else "linear"
    require(mode in FILTERS, f"filter_mode must be auto or one of {', '.join(FILTERS)}, not "
            f"{mode!r}")
    require("mipmap" not in mode or has_level, f"filter_mode {mode} needs uv_da or mip_level_bias")
    return "linear" if max_level == 0 and "mipmap" in mode else mode


def texture_construct_mip(tex, max_mip_level=None, cube_mode=False):
    """The levels of a texture that stays as it is, for mip of `texture`."""
    require(max_mip_level is None or max_mip_level >= 0, f"max_mip_level must be 0 or more, not "
            f"{max_mip_level}")
    pictures = pictures_of(tex, cube_mode)
    sides = pictures[0].shape[:2] if not cube_mode else 2 * tex.shape[2:3]
    top = last_level(*sides, max_mip_level)
    pyramids = [tensors.labs.mipmapping.pyramid(picture, top) for picture in pictures]
    return MipStack([np.stack(level) for level in list(zip(*pyramids, strict=True))[1:]])


def last_level(height, width, limit):
    """How often both sides can be halved. RuntimeError at odd ones, unless the limit comes first.
    """
    level, sides = 0, (height, width)
    while max(sides) > 1 and level != limit:
        require(all(side == 1 or side % 2 == 0 for side in sides), f"a texture {height} x {width} "
                f"has no mip level {level + 1}, as {sides[0]} x {sides[1]} cannot be halved: give "
                "it sides that are powers of two, or max_mip_level")
        level, sides = level + 1, tuple(max(side // 2, 1) for side in sides)
    return level


def pictures_of(tex, is_cube):
    """The pictures (N or 1, h, w, C) of textures. A cube's are 6 n high: a face above the other."""
    texels = array("tex", tex, "n 6 s s c" if is_cube else "n h w c")
    require(not is_cube or tex.shape[2] == tex.shape[3], "the faces of a cube must be square")
    return texels.reshape(len(texels), -1, *texels.shape[-2:])


class Look(NamedTuple):
    """Pixels that see one texture: its levels, and the matrix that takes texels to the pixels that
    see anything, lab 6's M.
    """

    levels: tuple
    footprint: tuple
    mipmap: tuple
    seen: np.ndarray
    matrix: sparray


def look(levels, footprint, sampler):
    """The Look of a Footprint at these levels."""
    labs = tensors.labs
    mipmap, seen = labs.mipmapping.pack(levels), np.ones(len(footprint.uv), bool)
    if sampler.boundary == "cube":
        seen, index, weight, _ = labs.cube_maps.cube_look_ups(labs.cube_maps.pack_cube(levels),
                                                              footprint, sampler.filter)
    else:
        index, weight, _ = labs.mipmapping.look_ups(mipmap, footprint, sampler)
    matrix = labs.texturing.look_up_matrix(len(mipmap.texels), index, weight)
    return Look(levels, footprint, mipmap, seen, matrix)


class Texture(torch.autograd.Function):
    """Lab 6. All pictures that share a texture are one, one above the other."""

    @staticmethod
    def forward(ctx, tex, uv, uv_da, bias, filter, boundary, made, *stack):
        texels = [pictures_of(level, boundary == "cube") for level in (tex, *stack)]
        levels = zip(*texels, *(made.levels if made else ()), strict=True)
        ctx.sampler, ctx.made = tensors.labs.texturing.Sampler(filter, boundary, None), made
        ctx.looks = [look(*each, ctx.sampler) for each in
                     zip(levels, footprints(uv, uv_da, bias, len(tex), boundary), strict=True)]
        ctx.save_for_backward(tex, uv, uv_da, bias, *stack)
        colours = [tensors.labs.arrays.masked_scatter(matrix @ mipmap.texels, seen)
                   for _, _, mipmap, seen, matrix in ctx.looks]
        return tensor(np.stack(colours), tex, (*uv.shape[:3], tex.shape[-1]))

    @staticmethod
    def backward(ctx, grad):
        tex, uv, uv_da, bias, *stack = ctx.saved_tensors
        rows = grad.numpy().reshape(len(tex), -1, tex.shape[-1])
        back = whole_backward if any(ctx.needs_input_grad[1:4]) else texels_backward
        levels, *pixels = zip(*(back(row, each, ctx.sampler) for row, each in
                                zip(rows, ctx.looks, strict=True)), strict=True)
        if ctx.made:  # of this texture: what a level gets goes down to it
            levels = [[tensors.labs.mipmapping.pyramid_backward(each)] for each in levels]
        grad_tex, *grad_stack = map(stacked, zip(*levels, strict=True), (tex, *stack))
        return grad_tex, *map(stacked, pixels, (uv, uv_da, bias)), None, None, None, *grad_stack


def whole_backward(grad, look, sampler):
    """The gradients (P, C) of pixels -> of each level, and of the Footprint's three parts."""
    labs = tensors.labs
    if sampler.boundary == "cube":
        return labs.cube_maps.cube_filtered_backward(grad, look.levels, look.footprint,
                                                     sampler.filter)
    return labs.mipmapping.filtered_backward(grad, look.levels, look.footprint, sampler)


def texels_backward(grad, look, sampler):
    """`whole_backward` where only texels are asked for: the matrix's transpose."""
    grad_texels = look.matrix.T @ grad[look.seen]
    return tensors.labs.mipmapping.unpack(grad_texels, look.mipmap), None, None, None


def stacked(grads, like):
    """Gradients of single pictures as one tensor, for what was given as a tensor."""
    if like is None or grads[0] is None:
        return None
    return tensor(np.stack(grads), like)


def footprints(uv, uv_da, bias, count, boundary):
    """Lab 6's Footprint of the pixels that see each of count textures.

    A direction on a cube map that is not finite counts as 0, which sees nothing.
    """
    axes = 3 if boundary == "cube" else 2
    require(count in (1, len(uv)), f"tex must have 1 or {len(uv)} textures, as many as uv has "
            f"pictures; it has {count}")
    n, height, width = uv.shape[:3]
    size = f"{n} {height} {width}"
    at = array("uv", uv, f"{size} {axes}").reshape(count, -1, axes)
    change = uv_da if uv_da is None else array("uv_da", uv_da, f"{size} {2 * axes}").reshape(
        count, -1, axes, 2)
    bias = bias if bias is None else array("mip_level_bias", bias, size).reshape(count, -1)
    if axes == 3 and not np.isfinite(at).all():
        sound = np.isfinite(at).all(-1)
        at = np.where(sound[..., None], at, 0)
        change = change if change is None else np.where(sound[..., None, None], change, 0)
    labs = tensors.labs.texturing
    for k in range(count):
        yield labs.require_footprint(labs.Footprint(
            at[k], None if change is None else change[k], 0.0 if bias is None else bias[k]), axes)
