"""Textures and cube maps, filtered for the size of a pixel: texture."""
from typing import NamedTuple

import numpy as np
import torch
from scipy.sparse import sparray

from apps.bridge import tensors
from apps.bridge.tensors import array, joined, require
from course.given import arrays


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
    mode = filter_of(filter_mode, uv_da is not None or mip_level_bias is not None, max_mip_level)
    require_boundary(boundary_mode)
    is_cube = boundary_mode == "cube"
    if "mipmap" not in mode:
        uv_da = mip_level_bias = None
        mip = MipStack([])
    require(mip is None or (mip and isinstance(mip, MipStack | list)), "mip must be a list of "
            "tensors or come from texture_construct_mip()")
    stack, pixels = (mip if isinstance(mip, list) else []), (uv, uv_da, mip_level_bias)
    how = how_to_read(mode, boundary_mode, not isinstance(mip, list), (tex, *pixels))
    texels = [pictures_of(level, is_cube) for level in (tex, *stack)]
    if mip is None:  # kernels make levels of their own
        texels += levels_of(texels[0][..., :0] if how.is_compiled else texels[0], max_mip_level,
                            is_cube)
    else:
        texels += mip.levels if how.is_made else []
        require_halves([level.shape for level in texels], is_cube)
    levels = list(zip(*texels, strict=True))
    seen = list(places_in_all(*pixels, levels, how))
    return Texture.apply(tex, *pixels, Reading(levels, seen, how), *stack)


def require_boundary(boundary_mode):
    """RuntimeError if there is no such boundary."""
    boundaries = *tensors.labs.texturing.BOUNDARIES, "cube"
    require(boundary_mode in boundaries, f"boundary_mode must be one of {', '.join(boundaries)}, "
            f"not {boundary_mode!r}")


def how_to_read(mode, boundary, is_made, given):
    """How textures are read, of these tensors. On cube maps, NumPy goes back to directions."""
    is_known = boundary != "cube" or not any(each is not None and each.requires_grad
                                             for each in given[1:])
    is_compiled = is_made and is_known and tensors.kernels(*given) is not None
    return How(tensors.labs.texturing.Sampler(mode, boundary, None), is_made, is_compiled)


def filter_of(mode, has_level, max_level):
    """The filter that filter_mode means, where pixels know a level of the pyramid or not."""
    if mode == "auto":
        mode = "linear-mipmap-linear" if has_level else "linear"
    filters = tensors.labs.texturing.FILTERS
    require(mode in filters, f"filter_mode must be auto or one of {', '.join(filters)}, not "
            f"{mode!r}")
    require("mipmap" not in mode or has_level, f"filter_mode {mode} needs uv_da or mip_level_bias")
    is_one = max_level is not None and int(max_level) == 0
    return "linear" if is_one and "mipmap" in mode else mode


def texture_construct_mip(tex, max_mip_level=None, cube_mode=False):
    """The levels of a texture that stays as it is, for mip of `texture`."""
    return MipStack(levels_of(pictures_of(tex, cube_mode), max_mip_level, cube_mode))


def levels_of(pictures, max_mip_level, is_cube):
    """The levels from 1 on of pictures as of `pictures_of`."""
    max_mip_level = max_mip_level if max_mip_level is None else int(max_mip_level)
    require(max_mip_level is None or max_mip_level >= 0, f"max_mip_level must be 0 or more, not "
            f"{max_mip_level}")
    labs = tensors.labs
    pyramids = [labs.cube_maps.cube_pyramid(picture, "mipmap", max_mip_level) if is_cube
                else labs.mipmapping.pyramid(picture, max_mip_level) for picture in pictures]
    top, (height, width) = len(pyramids[0]) - 1, pyramids[0][-1].shape[:2]
    height = width if is_cube else height
    require(max(height, width) == 1 or top == max_mip_level, f"this texture has no mip level "
            f"{top + 1}, as {height} x {width} cannot be halved: give it sides that are powers of "
            "two, or max_mip_level")
    return [np.stack(level) for level in list(zip(*pyramids, strict=True))[1:]]


def pictures_of(tex, is_cube):
    """The pictures (N or 1, h, w, C) of textures. A cube's are 6 n high: a face above the other."""
    texels = array("tex", tex, "n 6 s s c" if is_cube else "n h w c")
    require(not is_cube or tex.shape[2] == tex.shape[3], "the faces of a cube must be square")
    return texels.reshape(len(texels), -1, *texels.shape[-2:])


def require_halves(shapes, is_cube):
    """RuntimeError unless each level (N or 1, h, w, C) has half the sides of the one before it."""
    count, height, width, channels = shapes[0]
    for level, shape in enumerate(shapes):
        sides = (6 if is_cube else 1) * max(1, (width if is_cube else height) >> level), max(
            1, width >> level)
        require(shape == (count, *sides, channels), f"mip level {level} must be of {sides[0]} x "
                f"{sides[1]} texels, and else like tex; it has {shape}")


class How(NamedTuple):
    """How textures are read. is_made: whether the levels were made of the texture here."""

    sampler: tuple
    is_made: bool
    is_compiled: bool


class Places(NamedTuple):
    """Where pixels look at one texture. Lab 6's M takes its texels to those that see any. Without
    it, texel_kernels.py or cube_kernels.py looks up.
    """

    footprint: tuple
    seen: np.ndarray | None
    matrix: sparray | None


class Reading(NamedTuple):
    """For each texture its levels and the Places in it, and how they are read."""

    levels: list[tuple]
    places: list[Places]
    how: How


def places(levels, footprint, how):
    """The Places of a Footprint in a texture of these levels."""
    if how.is_compiled:
        return Places(footprint, None, None)
    labs, sampler = tensors.labs, how.sampler
    mipmap, seen = labs.mipmapping.pack(levels), np.ones(len(footprint.uv), bool)
    if sampler.boundary == "cube":
        mipmap = labs.cube_maps.pack_cube(levels)
        seen, index, weight, _ = labs.cube_maps.all_cube_taps(mipmap, footprint,
                                                              sampler.filter_mode)
    else:
        index, weight, _ = labs.mipmapping.all_taps(mipmap, footprint, sampler)
    return Places(footprint, seen, labs.texturing.look_up_matrix(len(mipmap.texels), index, weight))


class Texture(torch.autograd.Function):
    """Lab 6. All pictures that share a texture are one, one above the other."""

    @staticmethod
    def forward(ctx, tex, uv, uv_da, mip_level_bias, reading, *mip):
        ctx.reading = reading
        ctx.save_for_backward(tex, uv, uv_da, mip_level_bias, *mip)
        colours = [looked_up(*each, reading.how.sampler)
                   for each in zip(reading.levels, reading.places, strict=True)]
        found = joined(colours, tex, (*uv.shape[:3], tex.shape[-1]))
        if reading.how.sampler.boundary in ("wrap", "zero"):
            found[~uv.isfinite().all(-1)] = torch.nan
        return found

    @staticmethod
    @tensors.first_order
    def backward(ctx, grad):
        tex, uv, uv_da, bias, *stack = ctx.saved_tensors
        levels, places, how = ctx.reading
        rows = grad.numpy().reshape(len(tex), -1, tex.shape[-1])
        is_whole = how.is_compiled or any(ctx.needs_input_grad[1:4])
        back = whole_backward if is_whole else texels_backward
        grads = [back(*each, how.sampler) for each in zip(rows, levels, places, strict=True)]
        levels, *pixels = zip(*grads, strict=True)
        uv = None if how.sampler.filter_mode == "nearest" else uv
        if how.sampler.filter_mode != "linear-mipmap-linear":
            uv_da = bias = None
        if how.is_made:  # what a level gets goes down to the texture
            levels = [[tensors.labs.mipmapping.pyramid_backward(each)] for each in levels]
        grad_tex, *grad_stack = map(stacked, zip(*levels, strict=True), (tex, *stack))
        return grad_tex, *map(stacked, pixels, (uv, uv_da, bias)), None, *grad_stack


def kernels_for(sampler):
    """The compiled look-up, there and back."""
    if sampler.boundary == "cube":
        kernels = tensors.labs.cube_kernels
        return kernels.cube_colours, kernels.cube_colours_backward
    return tensors.labs.texel_kernels.texture, tensors.labs.texel_kernels.texture_backward


def looked_up(levels, place, sampler):
    """The colours (P, C) of pixels."""
    labs = tensors.labs
    if place.matrix is None:
        return kernels_for(sampler)[0](levels[0], *place.footprint, *sampler[:2],
                                       len(levels) - 1)
    found = place.matrix @ labs.mipmapping.pack(levels).texels
    return arrays.masked_scatter(found, place.seen)


def whole_backward(grad, levels, place, sampler):
    """The gradients (P, C) of pixels -> of each level, and of the Footprint's three parts."""
    if place.matrix is None:
        image, *pixels = kernels_for(sampler)[1](
            grad, levels[0], *place.footprint, *sampler[:2], len(levels) - 1)
        return (image,), *pixels
    given = grad, levels, place.footprint
    if sampler.boundary == "cube":
        return tensors.labs.cube_maps.cube_filtered_backward(*given, sampler.filter_mode)
    return tensors.labs.mipmapping.filtered_backward(*given, sampler)


def texels_backward(grad, levels, place, sampler):
    """`whole_backward` where only texels are asked for: the matrix's transpose."""
    labs = tensors.labs.mipmapping
    return labs.unpack(place.matrix.T @ grad[place.seen], labs.pack(levels)), None, None, None


def stacked(grads, like):
    """Gradients of single pictures as one tensor, for what was given as a tensor."""
    if like is None or grads[0] is None:
        return None
    return joined(grads, like)


def places_in_all(uv, uv_da, bias, levels, how):
    """The Places in each texture, of which these are the levels. Compiled cube maps take the parts
    of a Footprint as they are.
    """
    count, is_cube = len(levels), how.sampler.boundary == "cube"
    axes = 3 if is_cube else 2
    uv = array("uv", uv, f"n h w {axes}")
    require(count in (1, len(uv)), f"tex must have 1 or {len(uv)} textures, as many as uv has "
            f"pictures; it has {count}")
    size = "{} {} {}".format(*uv.shape[:3])
    at = uv.reshape(count, -1, axes)
    change = count * [None] if uv_da is None else array(
        "uv_da", uv_da, f"{size} {2 * axes}").reshape(count, -1, axes, 2)
    bias = count * [None] if bias is None else array("mip_level_bias", bias, size).reshape(
        count, -1)
    for texture_levels, *look in zip(levels, at, change, bias, strict=True):
        yield places(texture_levels, look if is_cube and how.is_compiled else cleaned(*look), how)


def cleaned(at, change, bias):
    """A Footprint. A direction on a cube map that is not finite counts as 0, which sees nothing.
    Else, what is no number counts as 0, and infinity as far.
    """
    labs, axes = tensors.labs.texturing, at.shape[-1]
    change = change if change is None else np.nan_to_num(change)
    if axes == 2:
        at = np.nan_to_num(at, posinf=1, neginf=0)
    elif not np.isfinite(at).all():
        sound = np.isfinite(at).all(-1)
        at = np.where(sound[..., None], at, 0)
        change = change if change is None else np.where(sound[..., None, None], change, 0)
    return labs.require_footprint(
        labs.Footprint(at, change, 0.0 if bias is None else np.nan_to_num(bias)), axes)
