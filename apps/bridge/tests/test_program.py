"""Programs as they are, in a process of their own: python3 -m course run, or all installed."""
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("torch", reason="PyTorch is not installed: requirements.txt")
ROOT = Path(__file__).parents[3]
WHOLE = '''
import sys, numpy as np, torch, nvdiffrast.torch as dr
from neural_renderer.rasterize import Rasterize
import beside
device = torch.device("cuda:0")
assert torch.cuda.is_available() and torch.zeros(2, device=device).cuda(0).is_cuda
numbers = np.ones(3, np.float32)
there = torch.from_numpy(numbers).to(device, torch.float32)
there.cpu().numpy()[:] = 5
numbers[:] = 7
assert (there == 1).all()
floats = torch.cuda.FloatTensor([1, 2])
assert isinstance(floats + there[:2], torch.cuda.FloatTensor) and floats.type(torch.float64).is_cuda
assert torch.ones(2).to(floats).is_cuda and torch.ones(2).type("torch.cuda.LongTensor").is_cuda
assert (floats.type(torch.FloatTensor) + torch.ones(2)).sum() == 5
known = torch.nn.Parameter(floats)
assert known.cuda() is known and not torch.ones(3, requires_grad=True).cuda().is_leaf
assert torch.zeros(2).cuda().requires_grad_().to(device).is_leaf
assert torch.nn.Linear(2, 3, device="cuda").cuda().weight.is_leaf
start, end = torch.cuda.Event(enable_timing=True), torch.cuda.Event(enable_timing=True)
start.record(), torch.optim.Adam([known]).step(), end.record(), torch.cuda.synchronize()
assert start.elapsed_time(end) >= 0
torch.save(there, "there.pt")
for place in "cuda", device, "cuda:0", torch.device("cuda"), {"cpu": "cuda:0"}, None:
    assert torch.equal(torch.load("there.pt", place), there)
    assert torch.equal(torch.load("there.pt", map_location=place), there)
with torch.cuda.device(there.get_device()), device:
    assert torch.ones(1).is_cuda and not isinstance(device, torch.cuda.device)
assert "cuda:%d" % there.device.index == "cuda:0" and there.to(there.device).is_cuda
torch.rand(2, generator=torch.Generator("cuda").manual_seed(1), device=device)
assert torch.cuda.get_device_properties(0).total_memory >= torch.cuda.mem_get_info()[0] > 0
torch.cuda.nvtx.range_push("here"), torch.cuda.Stream().wait_stream(torch.cuda.current_stream())
with (torch.cuda.stream(torch.cuda.Stream()), torch.random.fork_rng(), torch.cuda.nvtx.range("a"),
      torch.autocast("cuda", dtype=torch.bfloat16)):
    apart = torch.compile(torch.nn.DataParallel(torch.nn.Linear(3, 2).cuda()), mode="max-autotune")
    assert apart(torch.ones(1, 3, device="cuda")).shape == (1, 2) and apart.module.weight.is_leaf
clip = torch.tensor([[[-1, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 1.0]]], device="cuda")
torch.set_default_tensor_type(torch.cuda.FloatTensor), (tri := torch.tensor([[0, 1, 2]]).int())
torch.set_default_device(None), (context := dr.RasterizeGLContext(device=device))
rast, _ = dr.rasterize(context, clip, tri, (4, 6))
print("ARGS", sys.argv, beside.NUMBER, int(rast[..., 3].sum()))
sys.exit(3)
'''
REFUSED = {
    "dr.rasterize(context, clip.cpu(), tri, (4, 6))": "rasterize: pos must be on the card: give po",
    "dr.rasterize(context, 1.0 * clip.double(), tri, (4, 6))": "rasterize: pos is of torch.float64",
    "dr.rasterize(context, clip[0], tri, (4, 6), tri)": "rasterize: ranges must be on the process",
    "dr.texture(rast.cpu(), rast[..., :2].contiguous())": "texture: tex must be on the card: give",
    "Rasterize(4, 0, 9, 0, 0)(clip.cpu()[..., None].expand(1, 3, 4, 3))": "picture: faces must be",
    "clip + clip.cpu()": "add takes tensors on one device, and here one is on the card, another on",
    "clip.cpu() * clip.sum()": "mul takes tensors on one device, and here one is on the car",
    "torch.nn.Linear(4, 4)(clip)": "linear takes tensors on one device, and here one is on the car",
    "np.asarray(clip)": "NumPy takes no tensor that is on the card: give .cpu() of it"}
INSTALLED = '''
import multiprocessing, site, sys
site.addsitedir(sys.argv[1])  # as Python does with the folder that pip installs into
def made(_):
    import nvdiffrast.torch.ops as dr, torch
    if hasattr(dr, "DepthPeeler"):
        from neural_renderer.load_obj import load_obj
        pos = torch.tensor([[[-1.0, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 1]]])
        tri = torch.tensor([[0, 1, 2]], dtype=torch.int32)
        return int(dr.rasterize(dr.RasterizeCudaContext(), pos, tri, (4, 6))[0][..., 3].sum())
if __name__ == "__main__":
    print(made(0), multiprocessing.get_context("spawn").Pool(1).map(made, [0]))
'''
COMMAND = '''
import importlib.metadata, site, sys
site.addsitedir(sys.argv.pop(1))
command, = importlib.metadata.entry_points(name="rasterization-bridge")
sys.exit(command.load()())
'''


def run(folder, program, *options, start=(ROOT / "course", "run")):
    """Run a program in a folder -> its exit status, and what it printed."""
    (folder / "program.py").write_text(program)
    (folder / "beside.py").write_text("NUMBER = 42")
    name = "program" if "-m" in options else "program.py"
    done = subprocess.run([sys.executable, *start, *options, name, "--impl", "its own"],
                          cwd=folder, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


@pytest.mark.parametrize("options", [(), ("-m",), ("--strict",)])
def test_a_cuda_program_runs_on_the_processor(options, tmp_path):
    """It needs a character changed, or what it moved to the card changes with what stayed."""
    status, said = run(tmp_path, WHOLE, *options)
    assert (status, "', '--impl', 'its own'] 42 12" in said) == (3, True), said
    assert "cuda means the processor here, and reference/ does the work" in said


@pytest.mark.parametrize(("program", "said"), [
    ("import tinycudann", "program.py needs the package tinycudann, which is not installed"),
    ("import torch; torch.cuda.CUDAGraph()", "program.py wants more of CUDA than that it means"),
    ("from torch.utils.cpp_extension import CUDAExtension; CUDAExtension('own', [])",
     "it compiles CUDA kernels of its own, which only a graphics card can run")])
def test_what_a_program_lacks_is_one_sentence(program, said, tmp_path):
    """It ends in a traceback."""
    status, printed = run(tmp_path, program)
    assert status == 2 and said in printed and "Traceback" not in printed


def test_strictly_what_a_card_refuses_is_refused(tmp_path):
    """A program ends there that ran here, or what it may do is refused."""
    calls = [f"try: {call}\nexcept RuntimeError as error: print(error)" for call in REFUSED]
    status, printed = run(tmp_path, WHOLE.replace("sys.exit(3)", "\n".join(calls)), "--strict")
    assert status == 0 and all(said in printed for said in REFUSED.values()), printed


@pytest.mark.parametrize("error", ["KeyError", "OSError", "ValueError", "RuntimeError"])
def test_an_error_of_the_program_is_its_own(error, tmp_path):
    """A defect is hidden behind a sentence of the course."""
    status, printed = run(tmp_path, f"def f(): raise {error}(12)\nf()")
    assert status == 1 and f"{error}: 12" in printed and "in f" in printed


def test_an_exercise_that_is_not_written_is_named(tmp_path):
    """--impl labs runs the reference."""
    status, printed = run(tmp_path, WHOLE, "--impl", "labs")
    assert status == 2 and "is not written yet; python3 -m course check 1." in printed


def test_an_exercise_that_is_wrong_is_named_at_the_start(tmp_path):
    """It leads the program astray in silence."""
    shutil.copytree(ROOT / "labs", tmp_path / "labs")  # they come before the course's own
    for topic in "transforms", "antialiasing":
        answers = (ROOT / "reference" / f"{topic}.py").read_text()
        answers = answers.replace("-grad_alpha,", "grad_alpha,")
        (tmp_path / "labs" / f"{topic}.py").write_text(answers)
    _, printed = run(tmp_path, "import nvdiffrast.torch as dr; dr.antialias", "--impl", "labs")
    assert "course: of what it may call, 8.11 failing, 8.6 not written, 8.7 not writt" in printed


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The folder that the package alone is installed into."""
    folder = tmp_path_factory.mktemp("installed")
    pytest.importorskip("setuptools", minversion="77", reason="the package's build needs it")
    install = sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation"
    subprocess.run([*install, "--target", folder, ROOT / "apps" / "bridge"], check=True)
    return folder


def test_installed_its_command_runs_programs_and_says_what_they_lack(site, tmp_path):
    """It needs what only a clone has, or ends in a traceback."""
    start = "-c", COMMAND, site
    status, said = run(tmp_path, WHOLE, "--strict", start=start)
    assert (status, "', '--impl', 'its own'] 42 12" in said) == (3, True), said
    status, said = run(tmp_path, "import tinycudann", start=start)
    assert status == 1 and "\nrasterization-bridge: program.py needs the package tinycu" in said


def test_installed_it_is_found_without_the_course_but_after_a_real_one(site, tmp_path):
    """A module is missing in the package, a spawned worker does not find it, or it hides the real
    nvdiffrast.
    """
    (tmp_path / "use.py").write_text(INSTALLED)
    use = sys.executable, "use.py", site
    assert subprocess.check_output(use, cwd=tmp_path, text=True).strip() == "12 [12]"
    (site / "nvdiffrast" / "torch").mkdir(parents=True)
    for file in "__init__", "torch/__init__", "torch/ops":
        (site / "nvdiffrast" / f"{file}.py").touch()
    assert subprocess.check_output(use, cwd=tmp_path, text=True).strip() == "None [None]"
