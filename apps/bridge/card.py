"""Whether a tensor would be on a graphics card, and what one refuses: course run --strict.

There, PyTorch takes the tensors of an operation from one device, and NumPy those of the processor.
The kernels take float32 on the card, and `ranges` on the processor: NVDR_CHECK in nvdiffrast's
csrc/torch at 253ac4f, CHECK_INPUT in neural_renderer's cuda/ at b2a1e6c.
"""
import inspect

import torch
from torch.overrides import TorchFunctionMode
from torch.utils._pytree import tree_leaves

from .tensors import require

MAY_MIX = "copy_", "to", "type_as", "__getitem__", "__setitem__", "__set__"  # two devices
APPLY = vars(torch.autograd.Function)["apply"]


def place(tensor):
    """What remembers where a tensor is: its memory, which its views share, or itself if sparse."""
    try:
        return tensor.untyped_storage()
    except NotImplementedError:
        return tensor


def has(tensor):
    """Was a tensor moved to the card, or made there? Of what is computed, only Strict knows."""
    return getattr(place(tensor), "is_on_card", False)


def put(value, is_there=True):
    """A tensor, or a tuple or dict of such, which from now on counts as there."""
    for tensor in tensors_in(value):
        place(tensor).is_on_card = is_there
    return value


def tensors_in(value):
    return [each for each in tree_leaves(value) if isinstance(each, torch.Tensor)]


class Strict(TorchFunctionMode):
    """What PyTorch computes of tensors on the card is there, too, and devices may not mix."""

    def __torch_function__(self, function, _, args=(), kwargs=None):
        given, name = tensors_in((args, kwargs)), getattr(function, "__name__", "")
        places = {has(each) for each in given if each.ndim or has(each)}  # others go anywhere
        require(len(places) < 2 or name in MAY_MIX, f"{name} takes tensors on one device, and here "
                "one is on the card, another on the processor: give .cuda() of that")
        is_there = any(map(has, given))
        require(not (is_there and name in ("numpy", "__array__")),
                "NumPy takes no tensor that is on the card: give .cpu() of it")
        made = function(*args, **kwargs or {})
        return put(made) if is_there else made


def applied(function, *given):
    """What a Function returns, on the card if it is given what is. The interfaces' own ones refuse
    what their kernels refuse.
    """
    if function.__module__.startswith(("nvdiffrast.", "neural_renderer.")):
        named = inspect.signature(function.forward).bind(None, *given).arguments
        for name, value in named.items():
            title, is_there = f"{function.__name__.lower()}: {name}", name != "ranges"
            for tensor in tensors_in(value):
                require(tensor.dtype != torch.float64, f"{title} is of torch.float64, and a card "
                        f"takes torch.float32: give {name}.float()")
                require(has(tensor) == is_there, f"{title} must be on the card: give {name}.cuda()"
                        if is_there else f"{title} must be on the processor: give ranges.cpu()")
    made = APPLY.__get__(None, function)(*given)
    return put(made) if any(map(has, tensors_in(given))) else made


def refuse():
    """From now on, PyTorch and the interfaces do, and tensors say where they are: cpu:0 stands for
    the card.
    """
    torch.autograd.Function.apply = classmethod(applied)
    torch.Tensor.is_cuda = property(has)
    torch.Tensor.device = property(lambda tensor: torch.device("cpu", 0 if has(tensor) else None))
    Strict().__enter__()
