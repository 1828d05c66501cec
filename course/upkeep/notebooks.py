"""Runs the lectures from a clean kernel and writes them back: the same code, the same bytes.

An author edits a notebook in Jupyter and then runs `python3 -m course notebooks 02`. What is
written holds no times, addresses, widgets or settings of the author. Pictures and last digits
depend on the versions listed under "written_with". Where these agree, so do the bytes. What the
kernel had loaded of the course stands under "made_from". While none of it changes, the lecture
need not run again.

A lecture begins with these lines, which work in Jupyter and in the command alike:

    import sys; sys.path.append("..")  # finds the course from the folder notebooks/
    from reference import rasterization, transforms  # "labs": your own work
    from course.given import lecture, mesh, plot, sketch

    lecture.begin()

A code cell that begins with `# live` (a slider, say) is left for the reader to run. One that begins
with `# figure:` only draws: its code is folded away. What follows is told to those who do not see
the picture, in a sentence that may go on in comment lines. A cell with two pictures has two.

    # figure: a triangle over a pixel grid; the seven pixels whose centres
    # lie inside are blue

A lecture opens with its best picture or film, before any code. A cell with the line `# opening`
draws it, where the text reaches it. Its last picture is written to openings/NN_topic.png, too.
"""
import ast
import asyncio
import base64
import contextlib
import json
import os
import platform
import re
import tempfile
import time
import zlib
from importlib.metadata import version
from pathlib import Path

import matplotlib.font_manager  # noqa: F401  finds the fonts now: no kernel has to, and says so
import nbformat
import numpy as np
from ipykernel.kernelspec import RESOURCES, get_kernel_dict
from jupyter_client import AsyncKernelManager
from jupyter_client.kernelspec import KernelSpec, KernelSpecManager
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError

from course.given.places import ROOT, is_handout, read_whole, write_whole
from course.upkeep import errata, origins, pictures

FOLDER = ROOT / "notebooks"
AT_A_TIME = 2
TIME_LIMIT = 180                                   # a processor's seconds for a notebook
CLOCK = 5                                          # times as many may it take on a busy machine
SIZE_LIMIT = 2_500_000                             # bytes of a notebook, its pictures included
LINE_LIMIT = 88                                    # letters of a line of code
WITHOUT_NUMBA = "import sys; sys.modules['numba'] = None"  # its sums have another order
LIMITED = """
import contextlib, signal, time
with contextlib.suppress(ImportError):  # Windows has the limit on the clock alone
    import resource
    signal.signal(signal.SIGXCPU, signal.default_int_handler)
    resource.setrlimit(resource.RLIMIT_CPU,
                       (int(time.process_time() + TIME_LIMIT), resource.RLIM_INFINITY))
"""
TOO_LONG = "was running when the {} seconds of a notebook ended: let it do less"

KERNEL_ENVIRONMENT = {
    "PYTHONHASHSEED": "0",                         # one order of sets
    "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1",
    "VECLIB_MAXIMUM_THREADS": "1",                 # one order of sums
    "MPLBACKEND": "module://matplotlib_inline.backend_inline",
    "PYTHONWARNINGS": "", "PYDEVD_DISABLE_FILE_VALIDATION": "1",
}

# What the text of a lecture must not hold: a pattern, and what to say.
UNWANTED = [
    (r" at 0x[0-9a-fA-F]{4,}", "prints a memory address: print a name instead"),
    (r"\x1b\[", "prints terminal colours: print plain text"),
    (r"\r", "draws a progress bar: print a line at the end instead"),
    (re.escape(str(ROOT)), "prints the folder of this copy of the course: print a relative path"),
]


# The command

def run(names, everything=False):
    """Execute notebooks and write them back -> exit status. names, ValueError: those of `find`.

    Without names: those that are stale, or everything. 0: all are written. 1: at least one was
    refused, with a sentence, and stays as it was.
    """
    paths = find(names)
    if not names and not everything:
        paths = [path for path in paths if origins.stale(path)]
    refusals = wait_for(_run_all(paths))
    for refusal in refusals:
        print(refusal)
    if not is_handout():
        errata.write()
    return 1 if refusals else 0


def find(names):
    """Numbers ("2", "02"), topics or paths -> paths. No name: all. ValueError: none fits."""
    lectures = sorted(FOLDER.glob("*.ipynb"))
    if not lectures and not names:
        raise ValueError(f"there are no notebooks in {FOLDER}: get a whole copy of the course")
    return list(dict.fromkeys(_find(str(name), lectures) for name in names)) or lectures


def _find(name, lectures):
    if name.endswith(".ipynb") and Path(name).is_file():
        return Path(name).resolve()
    for path in lectures:
        number, _, topic = path.stem.partition("_")
        if name in (path.name, path.stem, topic) or name.zfill(len(number)) == number:
            return path
    known = ", ".join(path.stem for path in lectures) or "none"
    raise ValueError(f"there is no notebook {name}: name one by its number, its topic or its path; "
                     f"there are {known}")


async def _run_all(paths):
    free = asyncio.Semaphore(AT_A_TIME)
    refusals = await asyncio.gather(*[_run_one(path, free) for path in paths])
    return [refusal for refusal in refusals if refusal]


async def _run_one(path, free):
    """Execute and write one notebook -> None, or the sentence that says why it was refused."""
    async with free:
        try:
            before = read_whole(path)
            content = await execute(path)
            if read_whole(path) != before:
                raise ValueError(f"{path.name} was saved while it ran: run the command again")
            if content != before:
                write_whole(path, content)
            for picture in openings(content.decode()):
                (path.parent / "openings").mkdir(exist_ok=True)
                write_whole(path.parent / "openings" / f"{path.stem}.png", picture)
        except (ValueError, OSError) as error:
            return str(error)
    state = "unchanged" if content == before else "written"
    print(f"{path.stem}: {state}, {len(content) / 1000:.0f} kB", flush=True)


def wait_for(work):
    # The selector's loop, because the one that Windows prefers does not serve Jupyter's sockets.
    with asyncio.Runner(loop_factory=asyncio.SelectorEventLoop) as runner:
        return runner.run(work)


# From a notebook to its bytes

async def execute(path):
    """The notebook, run from a clean kernel in the course's folder -> the bytes to write.

    ValueError where a cell fails or leaves something that a lecture must not show, OSError where
    the file cannot be read.
    """
    notebook = _read(path)
    cells = [(index, cell) for index, cell in enumerate(notebook.cells) if _is_run(cell)]
    for number, (_, cell) in enumerate(cells, start=1):
        if long := [line for line in cell.source.splitlines() if len(line) > LINE_LIMIT]:
            raise ValueError(f"{path.name}, code cell [{number}] has a line of more than "
                             f"{LINE_LIMIT} letters: {long[0].strip()[:40]}...")
    async with _kernel(notebook) as client:
        for number, (index, cell) in enumerate(cells, start=1):
            objection = await _run_cell(client, cell, index) or _objection(cell)
            if objection:
                raise ValueError(f"{path.name}, code cell [{number}] {objection}")
            _join_streams(cell)
            pictures.finish(cell)
        loaded = await _loaded(client)
    notebook.metadata["made_from"] = origins.made_from(_text(notebook), loaded)
    return _content(notebook, path)


def _read(path):
    """A notebook without outputs, its cells named cell-00, cell-01, ..., as it goes to a kernel."""
    try:
        notebook = nbformat.from_dict(json.loads(read_whole(path)))
        if notebook.nbformat != 4:
            raise ValueError
        for index, cell in enumerate(notebook.cells):
            cell.id, cell.metadata, cell.source = f"cell-{index:02}", {}, "".join(cell.source)
            if cell.cell_type == "code":
                cell.outputs, cell.execution_count = [], None
                if cell.source.startswith("# figure:"):
                    cell.metadata = {"jupyter": {"source_hidden": True}, "tags": ["hide-input"]}
    except (ValueError, KeyError, TypeError, AttributeError):
        raise ValueError(f"{path} is not a notebook of format 4: open it in Jupyter and save it, "
                         "or get it again") from None
    notebook.nbformat_minor = 5                    # the first one whose cells have names
    notebook.metadata = _metadata()
    return notebook


def _metadata():
    return nbformat.from_dict({
        "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
        "language_info": {"name": "python"},
        "written_with": _written_with(),
        "made_from": {},
    })


def _written_with():
    """What the bytes of numbers and pictures depend on, apart from the code.

    Two processors round differently with the same versions: "rounding" is a sum of such results.
    """
    versions = {name: version(name) for name in ("numpy", "scipy", "matplotlib", "pillow")}
    numbers = np.random.default_rng(0).normal(size=(40, 40))
    results = (numbers @ numbers, np.linalg.inv(numbers), np.fft.fft2(numbers), numbers.sum(0),
               *(function(numbers) for function in (np.exp, np.sin, np.arctan, np.cbrt)))
    return {**versions, "platform": f"{platform.system()} {platform.machine()}",
            "rounding": f"{zlib.crc32(b''.join(result.tobytes() for result in results)):08x}"}


def _is_run(cell):
    source = cell.source.strip()
    return cell.cell_type == "code" and source and not source.startswith("# live")


class ThisInterpreter(KernelSpecManager):
    """Finds one kernel: the Python that runs this, whatever kernels the reader has installed."""

    def get_kernel_spec(self, kernel_name):
        return KernelSpec(resource_dir=RESOURCES, **get_kernel_dict(["--log-level=40"]))


@contextlib.asynccontextmanager
async def _kernel(notebook):
    """A client of a new kernel that knows no settings of the reader, and ends with the block."""
    manager = AsyncKernelManager(kernel_spec_manager=ThisInterpreter())
    end = time.monotonic() + CLOCK * TIME_LIMIT
    client = NotebookClient(notebook, km=manager, record_timing=False, iopub_timeout=TIME_LIMIT,
                            timeout_func=lambda cell: max(end - time.monotonic(), 0.1))
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as settings:
        environment = {**os.environ, **KERNEL_ENVIRONMENT, "IPYTHONDIR": settings}
        if is_handout():  # a student's answer may warn
            environment["PYTHONWARNINGS"] = "ignore"
        try:
            await client.async_start_new_kernel(cwd=str(ROOT), env=environment)
            await client.async_start_new_kernel_client()
            for line in WITHOUT_NUMBA, f"exec({LIMITED!r}, {{'TIME_LIMIT': {TIME_LIMIT}}})":
                await client.kc.execute_interactive(line, silent=True, store_history=False)
            yield client
        finally:
            if client.kc is not None:
                client.kc.stop_channels()
            if manager.has_kernel:
                await manager.shutdown_kernel(now=True)


async def _run_cell(client, cell, index):
    """Fill the cell's outputs -> None, or what kept it from coming to its end."""
    try:
        await client.async_execute_cell(cell, index)
    except CellExecutionError:
        error = next(output for output in cell.outputs if output.output_type == "error")
        message = f"{error.ename}: {error.evalue}".splitlines()[0]
        out_of_time = error.ename == "KeyboardInterrupt"  # see LIMITED
        return TOO_LONG.format(TIME_LIMIT) if out_of_time else f"failed with {message}"
    except CellTimeoutError:
        return TOO_LONG.format(CLOCK * TIME_LIMIT) + ", or let nothing else run"
    except DeadKernelError:
        return "ended the kernel: look for too much memory, or an exit()"


async def _loaded(client):
    """The files of all modules that a kernel has loaded."""
    files = "[getattr(one, '__file__', None) or '' for one in [*sys.modules.values()]]"
    reply = await client.kc.execute_interactive(
        "import sys", silent=True, user_expressions={"files": f"'\\n'.join({files})"})
    shown = reply["content"]["user_expressions"]["files"]["data"]["text/plain"]
    return ast.literal_eval(shown).split("\n")


def _join_streams(cell):
    """Printed text arrives in pieces, by chance: make neighbouring pieces one output."""
    outputs = []
    for output in cell.outputs:
        if outputs and output.output_type == outputs[-1].output_type == "stream":
            outputs[-1].text += output.text
        else:
            outputs.append(output)
    cell.outputs = outputs


# What a lecture must not show

def _objection(cell):
    """The first thing in the cell that must not be written, as a clause, or None."""
    shown = []
    for output in cell.outputs:
        parts = contents(output)
        text = "\n".join(parts[kind] for kind in parts if kind.startswith("text/"))
        if output.get("name") == "stderr":
            line = text.strip().split("\n")[0]
            return f"warns on stderr ({line}): mend the cause, a lecture shows no warnings"
        for kind in parts:
            if not kind.startswith(("text/", "image/")):
                return f'shows {kind}, which a page cannot: begin the cell with "# live"'
        for pattern, clause in UNWANTED:
            if re.search(pattern, text):
                return clause
        shown += [parts[kind] for kind in parts if kind.startswith("image/")]
    if len(set(shown)) < len(shown):
        return "shows one picture twice: end its last line with a semicolon"
    return pictures.objection(cell)


def openings(content):
    """The picture with which a lecture opens, as a list of one PNG file's bytes, or of none."""
    cells = [cell for cell in nbformat.reads(content, as_version=4).cells
             if re.search(r"^# opening$", cell.source, re.MULTILINE)]
    return [base64.b64decode(output.data["image/png"])
            for cell in cells for output in pictures.pictures_of(cell)[-1:]]


def contents(output):
    """What an output shows, by its kind: {"text/plain": ..., "image/png": in base64, ...}."""
    contents = output.get("data", {"text/plain": output.get("text", "")})
    return {kind: "".join(content) for kind, content in contents.items()}


def _text(notebook):
    return nbformat.writes(notebook) + "\n"


def _content(notebook, path):
    content = _text(notebook).encode()
    if len(content) > SIZE_LIMIT:
        sizes = [len(json.dumps(cell.get("outputs", []))) for cell in notebook.cells]
        largest = notebook.cells[np.argmax(sizes)]
        raise ValueError(
            f"{path.name} would be {len(content) / 1000:.0f} kB, and {SIZE_LIMIT / 1000:.0f} kB is "
            f"the limit: draw fewer or smaller pictures, first in code cell "
            f"[{largest.get('execution_count')}], whose outputs are {max(sizes) / 1000:.0f} kB")
    return content
