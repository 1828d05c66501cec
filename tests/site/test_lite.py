"""JupyterLite: what it holds runs where there are no processes, threads or timers of our own.

So it is in Pyodide, where tests/pyodide runs the lab checks. Here these are taken away from a
Python of our own.
"""
import contextlib
import importlib.util
import socket
import subprocess
import sys
import threading

import pytest
from pages import lite
from serving import ROOT, served

AS_IN_A_BROWSER = """
import json, os, signal, subprocess, sys, threading, types

def taken(kind):
    def call(*_, **__):
        raise kind("this is not there in a browser")
    return call

subprocess.Popen.__init__ = taken(OSError)
os.fork = os.posix_spawn = taken(OSError)
threading.Thread.start = taken(RuntimeError)
del signal.setitimer
sys.modules |= dict.fromkeys(["trimesh", "xatlas"])  # an import of these fails
sys.path.append("..")
"""
LECTURES = """
from pathlib import Path
import matplotlib
matplotlib.use("agg")
from IPython.core.interactiveshell import InteractiveShell

shell = InteractiveShell.instance()

def run(path, most=None):
    cells = ["".join(cell["source"]) for cell in json.loads(path.read_text("utf-8"))["cells"]
             if cell["cell_type"] == "code"]
    for source in cells[:most]:
        if "%timeit" not in source:
            shell.run_cell(source).raise_error()
"""
OWN_HOSTS = ("content-autofill.googleapis.com",)  # which Chromium asks by itself


@pytest.fixture(scope="module")
def contents(tmp_path_factory):
    """A copy of the files in JupyterLite."""
    folder = tmp_path_factory.mktemp("contents")
    lite.collect(folder)
    return folder


def as_in_a_browser(folder, code):
    """-> what this code prints, started in the folder's notebooks/. It has to succeed."""
    done = subprocess.run([sys.executable, "-I", "-c", AS_IN_A_BROWSER + code],
                          cwd=folder / "notebooks", capture_output=True, encoding="utf-8",
                          timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_board_is_that_of_a_process_of_its_own(contents):
    code = "from course import board\nboard.show('2.1')\nboard.show('2.1', 'reference')"
    told = as_in_a_browser(contents, code)
    expected = "".join(subprocess.run(
        [sys.executable, "-m", "course", "check", "2.1", "--impl", implementation], cwd=ROOT,
        capture_output=True, encoding="utf-8").stdout for implementation in ("labs", "reference"))
    assert told == expected
    assert "not started" in told
    assert "2 of 2 points" in told


def test_the_board_reads_a_lab_anew(contents):
    """An exercise is written between two looks at the board: the second one says so."""
    lab, solution = contents / "labs" / "transforms.py", contents / "reference" / "transforms.py"
    before = lab.read_text("utf-8")
    code = ("from pathlib import Path\nfrom course import board\nboard.show('1.2')\n"
            f"Path({str(lab)!r}).write_text(Path({str(solution)!r}).read_text())\n"
            "board.show('1.2')")
    try:
        told = as_in_a_browser(contents, code)
    finally:
        lab.write_text(before, "utf-8")
    assert told.index("not started") < told.index("All that was asked for is done")


def test_a_lecture_runs_from_its_first_cell_to_its_last(contents):
    told = as_in_a_browser(contents, f"{LECTURES}\nrun(Path('02_rasterization.ipynb'))")
    assert "the same depth, bit for bit: True" in told
    assert "Lab 2" in told  # its boards


def test_every_lecture_finds_what_it_imports(contents):
    """trimesh and xatlas are not there: no scene needs them when it is imported."""
    told = as_in_a_browser(contents, LECTURES + """
for path in sorted(Path(".").glob("[01]*.ipynb")):
    run(path, most=1)
    print(path.name)
""")
    assert len(told.split()) == len([*ROOT.glob("notebooks/*.ipynb")])


def test_what_is_collected_is_small_and_has_nothing_for_teachers(tmp_path):
    lite.collect(tmp_path)
    files = [path for path in tmp_path.rglob("*") if path.is_file()]
    outside = [path for path in files if "notebooks" not in path.parts]
    assert sum(path.stat().st_size for path in outside) < 6e6
    assert sum(path.stat().st_size for path in files) < 50e6
    assert not [path for path in files if "grading" in path.parts or path.name.startswith(".")]


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The address of JupyterLite, beside nothing else."""
    for name in ("jupyterlite_core", "jupyterlite_pyodide_kernel", "jupyter_server"):
        if not importlib.util.find_spec(name):
            pytest.skip("JupyterLite is not there: install site/requirements-lite.txt")
    folder = tmp_path_factory.mktemp("site")
    lite.write(folder / "lite")
    with served(folder) as address:
        yield f"{address}/lite/lab/index.html"


@pytest.fixture
def alone(browser):
    """A page whose proxy lets nothing through, and the other hosts that it asked for."""
    asked = []

    def listen(server):
        with contextlib.suppress(OSError):  # it was closed
            while True:
                with server.accept()[0] as caller:
                    host = caller.recv(1000).split()[1].decode().partition(":")[0]
                    if host not in OWN_HOSTS:
                        asked.append(host)

    with socket.create_server(("127.0.0.1", 0)) as server:
        threading.Thread(target=listen, args=[server], daemon=True).start()
        way_out = f"http://127.0.0.1:{server.getsockname()[1]}"
        context = browser.new_context(proxy={"server": way_out, "bypass": "127.0.0.1"})
        yield context.new_page(), asked
        context.close()
        server.shutdown(socket.SHUT_RDWR)


def test_a_lecture_opens_with_its_figures_and_a_lab_and_they_ask_no_other_host(built, alone):
    page, asked = alone
    page.goto(f"{built}?path=notebooks/02_rasterization.ipynb")
    page.wait_for_selector(".jp-OutputArea-output img", timeout=60_000)
    page.wait_for_timeout(3000)  # a kernel that starts by itself would have asked by now
    names = page.locator(".jp-DirListing-itemText").all_inner_texts()
    assert "02_rasterization.ipynb" in names and "in_the_browser.ipynb" in names
    assert "No Kernel" in page.locator(".jp-NotebookPanel-toolbar").inner_text()
    page.goto(f"{built}?path=labs/transforms.py")
    page.wait_for_selector(".jp-FileEditor .cm-line", timeout=60_000)
    assert "# exercise 1.2 (1 point)" in page.locator(".jp-FileEditor").inner_text()
    assert not asked


def test_python_is_asked_for_when_a_cell_is_run_and_a_page_says_that_it_does_not_come(built, alone):
    """The cell waits for ever, and nobody says for what."""
    page, asked = alone
    page.goto(f"{built}?path=notebooks/in_the_browser.ipynb")
    page.wait_for_selector(".jp-Notebook .jp-CodeCell", timeout=60_000)
    page.wait_for_timeout(3000)
    assert not asked
    page.locator(".jp-CodeCell").first.click()
    page.keyboard.press("Shift+Enter")
    for _ in range(100):
        page.wait_for_timeout(200)
        if asked:
            break
    assert set(asked) == {"cdn.jsdelivr.net"}
    page.get_by_role("alert").get_by_text("cdn.jsdelivr.net cannot be reached").wait_for()
