"""Between PyTorch's tensors and arrays, without copies; and whose code does the work."""
import functools
import os

import numpy as np
import torch
from torch.autograd.function import once_differentiable

from course.given import compiled, whose

labs = whose.Labs()  # `program` says otherwise: python3 -m course run --impl labs
FLOATS = torch.float32, torch.float64  # CUDA's kernels take the first alone
INTEGERS = torch.int32,
GRID = os.environ.get("BRIDGE_GRID", "0")
if not GRID.isdecimal():
    raise whose.Lacking(f"BRIDGE_GRID must be a whole number, such as 16; it is {GRID}")
GRID = int(GRID)  # in a pixel, vertices have so many places; 0: all
EXACT = 2**24  # so far, float32 holds all whole numbers
DTYPES = {torch.float32: np.float32, torch.float64: np.float64}


def require(holds, sentence):
    """RuntimeError, as the CUDA extensions raise it, unless it holds."""
    if not holds:
        raise RuntimeError(sentence)


def kernels(*given, faces=()):
    """The module of compiled operations on such tensors. None: NumPy does the work."""
    fit = all(each is None or each.dtype == torch.float32 for each in given) and len(faces) <= EXACT
    if fit and labs.package == "reference" and compiled.is_installed():
        return labs.float_kernels
    return None


def first_order(backward):
    """A Function's backward pass, for numbers alone. PyTorch says so if it is differentiated."""
    def of_numbers(ctx, *grads):
        return backward(ctx, *(grad if grad is None else grad.detach().contiguous()
                               for grad in grads))

    once = once_differentiable(of_numbers)  # takes time: for create_graph=True alone
    return lambda *given: (once if torch.is_grad_enabled() else of_numbers)(*given)


def array(name, tensor, shape, types=FLOATS):
    """A tensor's numbers as an array that shares its memory.

    shape: as "n h w 4", letters for lengths that are free. RuntimeError for what does not fit.
    """
    if not isinstance(tensor, torch.Tensor):
        raise RuntimeError(f"{name} must be a tensor, not {type(tensor)}")
    if not tensor.is_cpu:
        raise RuntimeError(f"{name} is on {tensor.device}: this code works on the processor, so "
                           "give it tensors there, as .cpu() makes them")
    if tensor.dtype not in types:
        raise RuntimeError(f"{name} must be of {types[0]}, not {tensor.dtype}")
    if not tensor.is_contiguous():
        raise RuntimeError(f"{name} must be contiguous: give {name}.contiguous()")
    if not fits(tensor.shape, shape):
        raise RuntimeError(f"{name} must have the shape ({', '.join(shape.split())}), nothing of "
                           f"it empty; it has {tuple(tensor.shape)}")
    with torch._C.DisableTorchFunction():  # strictly, NumPy takes nothing that is on the card
        return tensor.detach().numpy()


@functools.lru_cache
def fits(lengths, shape):
    """Are a tensor's lengths those of a shape?"""
    wanted = shape.split()
    return len(lengths) == len(wanted) and all(
        length == int(name) if name.isdigit() else length > 0
        for length, name in zip(lengths, wanted, strict=True))


def joined(arrays, like, shape=None):
    """New arrays of single pictures as one tensor of the type, and unless a shape is given of the
    shape, of another one.
    """
    made = arrays[0] if len(arrays) == 1 else np.stack(arrays)
    made = np.ascontiguousarray(made, DTYPES[like.dtype])
    return torch.from_numpy(made.reshape(like.shape if shape is None else shape))
