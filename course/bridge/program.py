"""Somebody's program, run as it is: python3 -m course run SCRIPT.py ARGS.

In this process `import nvdiffrast.torch` and `import neural_renderer` find the interfaces of this
room, and "cuda" means the processor: PyTorch hands each call that names a device to `OnProcessor`.
"""
import contextlib
import functools
import importlib
import platform
import re
import runpy
import sys
import time
from pathlib import Path

import torch
from torch.overrides import TorchFunctionMode

from ..given import whose
from . import tensors

ANSWERED = "nvdiffrast", "nvdiffrast.torch"
WANTS_MORE = re.compile("CUDA|NVIDIA|nvcc")


def run(script, arguments, implementation=None):
    """Run a program as `python SCRIPT ARGUMENTS` would, by the reference or by labs/.

    ValueError, in one sentence: there is no such file, or it needs a package or more of CUDA.
    Lacking: it needs an exercise that is not written.
    """
    path = Path(script).resolve()
    if not path.is_file():
        raise ValueError(f"there is no program {script}; give the path of a .py file")
    tensors.labs = whose.Labs(implementation)
    for name in ANSWERED:
        sys.modules[name] = importlib.import_module(f"{__package__}.{name}")
    print(f"course: cuda means the processor here, and {tensors.labs.package}/ does the work of "
          "nvdiffrast and neural_renderer", file=sys.stderr, flush=True)
    pretend()
    sys.argv[:] = str(script), *arguments
    sys.path[:] = str(path.parent), *sys.path[1:], sys.path[0]  # the course itself comes last
    with OnProcessor(), whose.exercises_named(), needs_named(script):
        runpy.run_path(str(path), run_name="__main__")
    return 0


@contextlib.contextmanager
def needs_named(script):
    """What a program lacks, a package or a graphics card, becomes a ValueError."""
    try:
        yield
    except ModuleNotFoundError as error:
        raise ValueError(f"{script} needs the package {error.name}, which is not installed beside "
                         f"{sys.executable}; if it works without CUDA, install it there") from error
    except (AssertionError, OSError, RuntimeError) as error:
        if not WANTS_MORE.search(str(error)):
            raise
        raise ValueError(f"{script} wants more of CUDA than that it means the processor: "
                         f"{str(error).splitlines()[0]}") from error


class OnProcessor(TorchFunctionMode):
    """Each call of PyTorch with "cuda" for a device is made for the processor."""

    def __torch_function__(self, func, types, args=(), kwargs=None):
        kwargs = kwargs or {}
        if func in (torch.Tensor.cuda, torch.Tensor.cpu):
            return moved(args[0], args[0], to_cuda=func is torch.Tensor.cuda)
        if func is torch.Tensor.pin_memory:
            return args[0]
        if func is torch.Tensor.is_cuda.__get__:
            return True
        to = func is torch.Tensor.to
        device = kwargs.get("device", args[1] if to and len(args) > 1 else None)
        if is_cuda(device):
            args = (args[0], "cpu", *args[2:]) if to and "device" not in kwargs else args
            kwargs = {**kwargs, "device": "cpu"} if "device" in kwargs else kwargs
        made = func(*args, **kwargs)
        return moved(args[0], made, is_cuda(device)) if to else made


def is_cuda(device):
    """Does this argument of PyTorch name a graphics card? A number does, too."""
    return type(device) is int or str(device).startswith("cuda")


def moved(tensor, made, to_cuda):
    """What was made of a tensor by moving it. CUDA's would not share its memory. A leaf stays what
    an optimizer may move.
    """
    shares = made.data_ptr() == tensor.data_ptr()
    return made.clone() if shares and not (to_cuda and made.requires_grad) else made


class Event:
    """A moment, as torch.cuda.Event keeps it."""

    def __init__(self, *_, **__):
        self.time = None

    def record(self, *_):
        self.time = time.perf_counter()

    def elapsed_time(self, end):
        """Milliseconds."""
        return 1000 * (end.time - self.time)

    def synchronize(self):
        """Nothing runs beside the program."""


def pretend():
    """torch.cuda answers as if the processor were its one device."""
    answers = {"is_available": True, "device_count": 1, "current_device": 0, "synchronize": None,
               "empty_cache": None, "set_device": None, "is_current_stream_capturing": False,
               "get_device_name": platform.processor() or platform.machine(),
               "memory_allocated": 0, "max_memory_allocated": 0, "reset_peak_memory_stats": None}
    for name, answer in answers.items():
        setattr(torch.cuda, name, lambda *_, answer=answer, **__: answer)
    for kind in "Float", "Double", "Half", "Int", "Long", "Short", "Byte", "Bool":
        setattr(torch.cuda, f"{kind}Tensor", getattr(torch, f"{kind}Tensor"))
    torch.cuda.Event = Event
    torch.load = functools.partial(torch.load, map_location="cpu")
