"""Runs the lectures from a clean kernel, and writes back what has changed for a reader.

An author edits a notebook in Jupyter and then runs `python3 -m course notebooks 02`. What is
written holds no times, addresses, widgets or settings of the author. Where a cell prints and draws
the same as before, its outputs stay: see outcomes.py. So a run after a change that no reader sees
writes nothing.

A lecture is older than its code if that, or its own text, has changed since it ran. Which files it
loaded stands in notebooks/.made_from.json, with one digest of them all. Comments and docstrings do
not count. `test` says how many lectures are older, `test --all` runs all of them.

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

A lecture opens with its best picture or film, before any code. A cell that begins with `# opening:`
and what its picture shows, as `# figure:` does, draws it and nothing else. The picture is kept in
openings/NN_topic.png alone, so that no reader of the page sees it twice.
"""
import base64
import contextlib
import functools
import hashlib
import itertools
import json
import os
import re
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import matplotlib.font_manager  # noqa: F401  finds the fonts now: no kernel has to, and says so
import nbformat
from ipykernel.kernelspec import RESOURCES, get_kernel_dict
from jupyter_client import AsyncKernelManager
from jupyter_client.kernelspec import KernelSpec, KernelSpecManager
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, DeadKernelError

from labkit import places
from labkit.places import ROOT, read_whole, write_whole
from labkit.upkeep import errata, outcomes, pictures, weight

FOLDER = ROOT / "notebooks"
RECORD = FOLDER / ".made_from.json"
OURS = "course/", "labs/", "reference/"             # whose files make a lecture older
AT_A_TIME = 2
TIME_LIMIT = 180                                   # a processor's seconds for a notebook
PATIENCE = 600                                     # seconds until a kernel starts or says more
SIZE_LIMIT = 2_500_000                             # bytes of a notebook, its pictures included
FIRST = """
import contextlib, signal, sys, time
sys.modules["numba"] = None  # its sums have another order
with contextlib.suppress(ImportError):  # Windows knows no limit
    import resource
    signal.signal(signal.SIGXCPU, signal.default_int_handler)
    resource.setrlimit(resource.RLIMIT_CPU,
                       (int(time.process_time() + {}), resource.RLIM_INFINITY))
"""
LAST = """
import sys
print(*(getattr(module, "__file__", "") or "" for module in [*sys.modules.values()]), sep="\\n")
"""

KERNEL_ENVIRONMENT = {
    "PYTHONHASHSEED": "0",                         # one order of sets
    "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1",
    "VECLIB_MAXIMUM_THREADS": "1",                 # one order of sums
    "MPLBACKEND": "module://matplotlib_inline.backend_inline",
    "PYTHONWARNINGS": "", "PYDEVD_DISABLE_FILE_VALIDATION": "1",
}
METADATA = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
            "language_info": {"name": "python"}}
ONLY_OPENS = "# opening:"                          # how a cell begins that draws the top alone
FOLDED = {"jupyter": {"source_hidden": True}, "tags": ["hide-input"]}

# What the text of a lecture must not hold: a pattern, and what to say.
UNWANTED = [
    (r" at 0x[0-9a-fA-F]{4,}", "prints a memory address: print a name instead"),
    (r"\x1b\[", "prints terminal colours: print plain text"),
    (re.escape(str(ROOT)), "prints the folder of this copy of the course: print a relative path"),
]


# The command

def run(names, everything=False):
    """Execute notebooks and write them back -> exit status. names, ValueError: those of `find`.

    Without names: those that are older than their code, or everything. 0: all are written. 1: at
    least one was refused, with a sentence, and stays as it was.
    """
    paths, status = find(names), 0
    if not names and not everything:
        paths = older()
        print("older than their code:", ", ".join(path.stem for path in paths) or "none")
    with ThreadPoolExecutor(AT_A_TIME) as pool:
        for path, job in [(path, pool.submit(remade, path)) for path in paths]:
            try:
                write(path, *job.result())
            except (ValueError, OSError) as error:
                print(error, flush=True)
                status = 1
    if not places.is_handout():
        errata.write()
    return status


def find(names):
    """Numbers ("2", "02"), topics or paths -> paths. No name: all. ValueError: none fits."""
    lectures = sorted(FOLDER.glob("*.ipynb"))
    if not lectures and not names:
        raise ValueError(f"there are no notebooks in {FOLDER}: get a whole copy of the course")
    return list(dict.fromkeys(named(str(name), lectures) for name in names)) or lectures


def named(name, lectures):
    if name.endswith(".ipynb") and Path(name).is_file():
        return Path(name).resolve()
    for path in lectures:
        number, _, topic = path.stem.partition("_")
        if name in (path.name, path.stem, topic) or name.zfill(len(number)) == number:
            return path
    known = ", ".join(path.stem for path in lectures) or "none"
    raise ValueError(f"there is no notebook {name}: name one by its number, its topic or its path; "
                     f"there are {known}")


def write(path, before, notebook, differences, loaded):
    """Write what a run made of a notebook, and what it was made from. See `remade`."""
    opening = openings(notebook)
    content = f"{nbformat.writes(as_saved(notebook))}\n".encode()
    if len(content) > SIZE_LIMIT:
        raise ValueError(f"{path.name} would be {len(content) / 1000:.0f} kB, and the limit is "
                         f"{SIZE_LIMIT / 1000:.0f} kB: draw fewer or smaller pictures")
    if read_whole(path) != before:
        raise ValueError(f"{path.name} was saved while it ran: run the command again")
    if content != before:
        write_whole(path, content)
    for picture in opening:
        opening_of(path).parent.mkdir(exist_ok=True)
        write_whole(opening_of(path), picture)
    if path.parent == FOLDER:
        made = {**record(), path.stem: {"digest": digest(notebook, loaded), "loaded": loaded}}
        write_whole(RECORD, f"{json.dumps(made, indent=1, sort_keys=True)}\n".encode())
    print(*(differences or [f"{path.name}: nothing has changed"]), sep="\n", flush=True)


# Which lectures are older than their code

def older():
    """The paths of the lectures whose text, or whose code, is another one than when they ran."""
    known = record()
    return [path for path in sorted(FOLDER.glob("*.ipynb")) if path.stem not in known or
            digest(parsed(path), known[path.stem]["loaded"]) != known[path.stem]["digest"]]


def record():
    """{a lecture's name: its digest, and the files of the course that it loaded}."""
    return json.loads(RECORD.read_bytes()) if RECORD.exists() else {}


def digest(notebook, loaded):
    """Eight letters for a notebook's cells and the code of the files that it loads."""
    files = [ROOT / name for name in loaded]
    texts = [f"{cell.cell_type}\n{cell.source}" for cell in notebook.cells] + [
        code_of(path.read_text(encoding="utf-8")) for path in files if path.exists()]
    return hashlib.sha256("\n".join(texts).encode()).hexdigest()[:8]


@functools.cache
def code_of(text):
    return "\n".join(weight.lines_with_code(text))


# From a notebook to what it says

def remade(path, elsewhere=False):
    """Run a notebook -> (its bytes before, the notebook, how it differs, what it loaded).

    Outputs that say the same as those that are there stay: see outcomes.py, also for elsewhere.
    ValueError where a cell fails or leaves something that a lecture must not show, OSError where
    the file cannot be read.
    """
    before = read_whole(path)
    stored = {cell.source: cell.outputs for cell in parsed(path).cells if "outputs" in cell}
    notebook, loaded = executed(path)
    differences = []
    for cell in notebook.cells:
        was = stored.get(cell.source, [])
        if found := outcomes.difference(was, cell.get("outputs", []), elsewhere):
            differences.append(f"{path.name}, {cell.id} {found}")
        elif was:
            cell.outputs = was
    return before, notebook, differences, loaded


def parsed(path):
    """A notebook as the command writes it: its cells are cell-00, cell-01, ..., and numbered."""
    try:
        notebook = nbformat.reads(read_whole(path).decode(), as_version=4)
    except (ValueError, AttributeError, nbformat.ValidationError):
        raise ValueError(f"{path} is not a notebook of format 4: open it in Jupyter and save it, "
                         "or get it again") from None
    numbers = itertools.count(1)
    for index, cell in enumerate(notebook.cells):
        cell.id, cell.metadata = f"cell-{index:02}", {}
        if cell.source.startswith(("# figure:", ONLY_OPENS)):
            cell.metadata = FOLDED
        if cell.cell_type == "code":
            cell.execution_count = next(numbers) if is_run(cell) else None
            cell.outputs = cell.outputs if is_run(cell) else []
        if cell.source.startswith(ONLY_OPENS) and opening_of(path).exists():
            cell.outputs = [shown_at_the_top(cell, read_whole(opening_of(path)))]
    notebook.nbformat_minor, notebook.metadata = 5, METADATA
    return nbformat.from_dict(notebook)


def is_run(cell):
    source = cell.source.strip()
    return cell.cell_type == "code" and source and not source.startswith("# live")


def executed(path):
    """The notebook, run in the course's folder, and the course's files that its kernel loaded."""
    notebook, ask = parsed(path), nbformat.v4.new_code_cell(LAST)
    notebook.cells.append(ask)
    with kernel(notebook) as client:
        for index, cell in enumerate(notebook.cells[:-1]):
            if is_run(cell):
                objection = unfinished(client, cell, index) or objection_to(cell)
                if objection:
                    raise ValueError(f"{path.name}, code cell [{cell.execution_count}] {objection}")
                pictures.finish(cell)
                if cell.source.startswith(ONLY_OPENS):  # one that waits has drawn nothing
                    cell.outputs = [shown_at_the_top(cell, picture) for picture in openings(
                        nbformat.from_dict({"cells": [cell]}))]
        client.execute_cell(ask, len(notebook.cells) - 1)
    notebook.cells.remove(ask)
    files = map(places.shown_path, ask.outputs[0].text.splitlines())
    return notebook, sorted(file for file in files if file.startswith(OURS))


class ThisInterpreter(KernelSpecManager):
    """Finds one kernel: the Python that runs this, whatever kernels the reader has installed."""

    def get_kernel_spec(self, kernel_name):
        return KernelSpec(resource_dir=RESOURCES, **get_kernel_dict(["--log-level=40"]))


@contextlib.contextmanager
def kernel(notebook):
    """A client of a new kernel that knows no settings of the reader, and ends with the block."""
    client = NotebookClient(
        notebook, km=AsyncKernelManager(kernel_spec_manager=ThisInterpreter()),
        record_timing=False, coalesce_streams=True, startup_timeout=PATIENCE, timeout=None,
        iopub_timeout=PATIENCE,
        extra_arguments=[f"--IPKernelApp.exec_lines=exec({FIRST.format(TIME_LIMIT)!r}, {{}})"])
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as settings:
        environment = {**os.environ, **KERNEL_ENVIRONMENT, "IPYTHONDIR": settings}
        if places.is_handout():  # a student's answer may warn
            environment["PYTHONWARNINGS"] = "ignore"
        with client.setup_kernel(cwd=str(ROOT), env=environment, cleanup_kc=True):
            yield client


def unfinished(client, cell, index):
    """Fill the cell's outputs -> None, or what kept it from coming to its end."""
    try:
        client.execute_cell(cell, index)
    except CellExecutionError as error:
        if error.ename == "KeyboardInterrupt":  # see FIRST
            return (f"was running when the {TIME_LIMIT} seconds of a notebook ended: "
                    "let it do less")
        return f"failed with {error.ename}: {error.evalue}".splitlines()[0]
    except DeadKernelError:
        return "ended the kernel: look for too much memory, or an exit()"


# What a lecture must not show

def objection_to(cell):
    """The first thing in the cell's outputs that must not be written, as a clause, or None."""
    shown = []
    for output in cell.outputs:
        parts = outcomes.contents(output)
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


def opening_of(path):
    return path.parent / "openings" / f"{path.stem}.png"


def as_saved(notebook):
    """The notebook, without the picture that is kept in openings/ alone."""
    for cell in notebook.cells:
        if cell.source.startswith(ONLY_OPENS):
            cell.outputs = []
    return notebook


def shown_at_the_top(cell, content):
    """What a cell that only opens its lecture has drawn, a PNG file's bytes, as its output."""
    return nbformat.v4.new_output(
        "display_data", {"image/png": base64.b64encode(content).decode()},
        metadata={"image/png": {"alt": pictures.told(cell.source)[0]}})


def openings(notebook):
    """The picture with which a lecture opens, as a list of one PNG file's bytes, or of none."""
    return [base64.b64decode(output.data["image/png"]) for cell in notebook.cells
            if cell.source.startswith(ONLY_OPENS) for output in pictures.pictures_of(cell)[-1:]]
