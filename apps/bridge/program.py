"""Somebody's program, run as it is: python3 -m course run SCRIPT.py ARGS, or run -m PACKAGE ARGS.
Where the package is installed alone, rasterization-bridge stands for python3 -m course run.

In this process `import nvdiffrast.torch` and `import neural_renderer` find the interfaces of this
folder, and "cuda" means the processor.
"""
import contextlib
import dataclasses
import functools
import importlib.util
import os
import platform
import re
import runpy
import sys
import time
import traceback
import types
from pathlib import Path

os.environ["PYTORCH_JIT"] = "0"  # before the import: compiled code would ask for CUDA itself
import torch
from torch.overrides import _get_current_function_mode_stack as modes

from course.given.whose import Labs, Lacking, exercises_named

from . import card, tensors

TAKES_DEVICE = "device (:class:`torch.device`, optional)"  # documented of what makes tensors
ANSWERS = {"is_available": True, "device_count": 1, "current_device": 0, "synchronize": None,
           "empty_cache": None, "set_device": None, "is_current_stream_capturing": False,
           "get_device_name": platform.machine(), "get_device_capability": (0, 0),
           "get_device_properties": types.SimpleNamespace(
               name=platform.machine(), major=0, minor=0, total_memory=1 << 34,
               multi_processor_count=os.cpu_count()),
           "mem_get_info": (1 << 33, 1 << 34), "memory_summary": "", "is_bf16_supported": True,
           "ipc_collect": None, "reset_peak_memory_stats": None, **dict.fromkeys(
               ("memory_allocated", "max_memory_allocated", "memory_reserved"), 0)}
BEHIND = re.compile(r"^\| `(?:dr|nr)\.(\w+)` (.*)$", re.MULTILINE)  # README's row of a call
WRONG = {"not started": "not written", "failed": "failing"}
TENSORS = re.compile(r"(cuda\.|OnCard.*\.)?(\w+Tensor)")  # in the text of a type, or in its name
WANTS_MORE = re.compile("CUDA|NVIDIA|nvcc")
WANTS_KERNELS = re.compile("CUDA_HOME|nvcc")


def run(script, arguments, implementation=None, is_module=False, is_strict=False):
    """Run a program as `python SCRIPT ARGUMENTS` would, or `python -m SCRIPT ARGUMENTS`, by the
    reference or by labs/. is_strict: refuse what a graphics card refuses.

    Lacking, in one sentence: there is no such file, or it needs a package, more of CUDA or an
    exercise that is not written.
    """
    path = Path(script).resolve()
    if not is_module and not path.is_file():
        raise Lacking(f"there is no program {script}; give the path of a .py file")
    tensors.labs = Labs(implementation)
    print(f"course: cuda means the processor here, and {tensors.labs.package}/ does the work of "
          "nvdiffrast and neural_renderer", file=sys.stderr, flush=True)
    sys.argv[:] = str(script), *arguments
    first, here = Path.cwd() if is_module else path.parent, Path(__file__).parent
    sys.path[:] = str(first), str(here), *sys.path[1:], sys.path[0]  # the course itself comes last
    name_wrong("" if is_module else path.read_text("utf-8", "replace"))
    pretend()
    with needs_named(script), exercises_named():
        if is_strict:
            card.refuse()
        if is_module:
            runpy.run_module(script, run_name="__main__", alter_sys=True)
        else:
            runpy.run_path(str(path), run_name="__main__")
    return 0


def name_wrong(program):
    """Print which exercises in labs/ are not written or fail a check, in a line if any: of those
    behind the operations that a program's text names. If it names none, its modules do: of all.
    """
    if tensors.labs.package != "labs":
        return
    from labkit import exercises, verdicts  # and so pytest, and the course's own table
    from labkit.checks import runner
    rows = re.findall(BEHIND, Path(__file__).with_name("README.md").read_text("utf-8"))
    named = [row for name, row in rows if re.search(rf"\.{name}|import.*{name}", program)]
    labs, _ = exercises.asked_for(None)
    code, = importlib.util.find_spec("labs").submodule_search_locations
    numbers = {*re.findall(r"\d+\.\d+", str(named or rows))}
    checks, _ = runner.run_checks(labs, numbers - verdicts.closed_extras(labs, Path(code)), code, 0)
    wrong = dict.fromkeys(f"{check.exercise} {WRONG[check.verdict]}" for check in checks
                          if check.verdict in WRONG and not check.fine_print)
    if wrong:
        print(f"course: of what it may call, {', '.join(wrong)}; python3 -m course check NUMBER "
              "says more", file=sys.stderr, flush=True)


@contextlib.contextmanager
def needs_named(script):
    """What a program lacks, a package or a graphics card, becomes Lacking."""
    try:
        yield
    except ModuleNotFoundError as error:
        if not error.name:
            raise
        raise Lacking(f"{script} needs the package {error.name}, which is not installed beside "
                      f"{sys.executable}; if it works without CUDA, install it there") from error
    except (AssertionError, OSError, RuntimeError) as error:
        if not WANTS_MORE.search(str(error)):
            traceback.print_exc()  # raised, an OSError would be taken for the course's own
            sys.exit(1)
        said = ("it compiles CUDA kernels of its own, which only a graphics card can run"
                if WANTS_KERNELS.search(str(error)) else str(error).splitlines()[0])
        raise Lacking(f"{script} wants more of CUDA than that it means the processor: "
                      f"{said}") from error


class Generator(torch.Generator):
    """Random numbers, for whatever device."""

    def __new__(cls, device="cpu"):
        return super().__new__(cls, "cpu")


class DataParallel(torch.nn.DataParallel):
    """A module on all devices, of which there is one."""

    def __init__(self, module, *_, **__):
        torch.nn.Module.__init__(self)
        self.module, self.device_ids = module, []


@dataclasses.dataclass
class OnCard:
    """torch.cuda.FloatTensor and its like: a type of tensors that makes some, there."""

    kind: type

    def __call__(self, *given):
        return card.put(self.kind(*given))

    def __instancecheck__(self, value):
        return isinstance(value, self.kind) and value.is_cuda


class Idle:
    """A stream, an event or a profiler of the card. All is done in the program's own order, so
    nothing waits, and whatever is asked for is done.
    """

    def __init__(self, *_, **__):
        self.time = None

    def __getattr__(self, _):
        return lambda *_, **__: True

    def record(self, *_):
        self.time = time.perf_counter()

    def elapsed_time(self, end):
        """Milliseconds."""
        return 1000 * (end.time - self.time)


def pretend():
    """PyTorch makes and moves tensors to the processor, whatever device it is told, and torch.cuda
    answers as if that were its one device.
    """
    for name in dir(torch):
        made = getattr(torch, name)
        if not isinstance(made, type) and TAKES_DEVICE in str(made.__doc__):
            setattr(torch, name, on_processor(made))
    for name in "new_empty", "new_full", "new_ones", "new_tensor", "new_zeros":
        setattr(torch.Tensor, name, on_processor(getattr(torch.Tensor, name)))
    to = torch.Tensor.to
    torch.Tensor.to = lambda tensor, *args, **kwargs: moved(tensor, to, *args, **kwargs)
    torch.Tensor.cuda = lambda tensor, *_, **__: moved(tensor, to, "cuda")
    torch.Tensor.cpu = lambda tensor, *_, **__: moved(tensor, to, "cpu")
    torch.Tensor.pin_memory = lambda tensor, *_, **__: tensor
    torch.Tensor.device = property(lambda _: torch.device("cpu", 0))  # whose index is a number
    torch.Tensor.is_cuda = property(lambda _: True)
    torch.Tensor.get_device = lambda _: 0
    load = torch.load
    torch.load = lambda file, map_location=None, *args, **kwargs: card.put(
        load(file, "cpu", *args, **kwargs), str(map_location) != "cpu")
    torch.nn.DataParallel = torch.nn.parallel.DataParallel = DataParallel
    torch.compile = lambda function=None, **_: function or (lambda function: function)
    pretend_cuda()


def pretend_cuda():
    """torch.cuda answers."""
    torch.cuda.device = contextlib.nullcontext  # PyTorch asks whether something is one
    torch._C._accelerator_getAccelerator = lambda: None  # what is built for CUDA would ask the card
    for name, answer in ANSWERS.items():
        setattr(torch.cuda, name, lambda *_, answer=answer, **__: answer)
    for kind in "Float", "Double", "Half", "Int", "Long", "Short", "Byte", "Bool":
        setattr(torch.cuda, f"{kind}Tensor", OnCard(getattr(torch, f"{kind}Tensor")))
    typed, torch.set_default_tensor_type = torch.Tensor.type, default_type
    torch.Tensor.type = lambda tensor, dtype=None, *_, **__: of_type(tensor, typed, dtype)
    torch.Generator, torch.cuda.stream = Generator, contextlib.nullcontext
    for name in "Event", "Stream", "current_stream", "default_stream":
        setattr(torch.cuda, name, Idle)
    torch.cuda.get_rng_state = lambda *_: torch.get_rng_state()
    torch.cuda.set_rng_state = lambda state, *_: torch.set_rng_state(state)
    torch.cuda.nvtx = Idle()
    torch.cuda.nvtx.range = contextlib.nullcontext


def on_processor(function):
    """A function of PyTorch that makes tensors, on the processor."""
    @functools.wraps(function)
    def made(*args, **kwargs):
        # And those of torch.device and set_default_device:
        devices = kwargs.get("device"), *(getattr(mode, "device", None) for mode in modes()[::-1])
        if not is_cuda(next((device for device in devices if device is not None), None)):
            return function(*args, **kwargs)
        return card.put(function(*args, **{**kwargs, "device": "cpu"}))

    return made


def moved(tensor, to, device=None, *others, **named):
    """Tensor.to, which takes a device or a tensor first or by name; or a type of numbers, first.

    What is moved shares no memory with what stays, as between processor and graphics card. A leaf
    that is there already, as Parameters are taken to be, stays the one that an optimizer knows.
    """
    if isinstance(device, torch.Tensor):  # to its place, and to its type
        device, others = device.device, (device.dtype, *others)
    is_there = is_cuda(device)
    if not is_there and not isinstance(device, str | torch.device):
        return to(tensor, device, *others, **named)
    with torch._C.DisableTorchFunction():  # else Strict would come here again
        made = to(tensor, "cpu" if is_there else device, *others, **named)
    if made is tensor and not (is_there and tensor.requires_grad and (
            card.has(tensor) or isinstance(tensor, torch.nn.Parameter))):
        made = made.clone()
    card.place(made).is_on_card = is_there
    return made


def of_type(tensor, typed, dtype):
    """Tensor.type, which moves what it takes to a type of tensors elsewhere."""
    named = TENSORS.search(str(dtype))
    if not named or not (named[1] or card.has(tensor)):
        return typed(tensor, dtype)
    return tensor.to("cuda" if named[1] else "cpu", getattr(torch, named[2]).dtype)


def default_type(kind):
    """Tensors are of this type, as OnCard, unless something else is asked for."""
    is_there, name = TENSORS.search(str(kind)).groups()
    torch.set_default_dtype(getattr(torch, name).dtype)
    torch.set_default_device("cuda" if is_there else None)


def is_cuda(device):
    """Does this argument of PyTorch name a graphics card? A number does, and so does cpu:0, which
    tensors say here.
    """
    if isinstance(device, torch.device):
        return device.type == "cuda" or device.index == 0
    return type(device) is int or (isinstance(device, str) and device.startswith(("cuda", "cpu:")))
