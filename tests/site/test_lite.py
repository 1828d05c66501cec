"""JupyterLite: what it holds runs where there are no processes, threads or timers of our own.

So it is in Pyodide, where tests/pyodide runs the lab checks. Here these are taken away from a
Python of our own.
"""
import importlib.util
import subprocess
import sys
import urllib.parse

import pytest
from pages import lite
from serving import ROOT, served

AS_IN_A_BROWSER = """
import json, os, signal, subprocess, sys, threading
from pathlib import Path

def taken(*_, **__):
    raise OSError("this is not there in a browser")

subprocess.Popen.__init__ = os.fork = os.posix_spawn = threading.Thread.start = taken
del signal.setitimer
sys.modules |= dict.fromkeys(["trimesh", "xatlas"])  # an import of these fails
sys.path.append("..")
"""
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


def test_the_board_is_that_of_a_process_of_its_own_and_reads_a_lab_anew(contents):
    """An exercise is written between two looks at the board: the second one says so."""
    told = as_in_a_browser(contents, """
from labkit import board
board.show("2.1")
solution = Path("../reference/rasterization.py").read_text("utf-8")
Path("../labs/rasterization.py").write_text(solution, "utf-8")
board.show("2.1")
""")
    before = subprocess.run([sys.executable, "-m", "course", "check", "2.1"], cwd=ROOT,
                            capture_output=True, encoding="utf-8").stdout
    assert "not started" in before and told.startswith(before)
    assert "2 of 2 points" in told.removeprefix(before)


def test_every_lecture_finds_what_it_imports(contents):
    """trimesh and xatlas are not there: no scene needs them when it is imported."""
    told = as_in_a_browser(contents, """
for path in sorted(Path(".").glob("[01]*.ipynb")):
    cells = json.loads(path.read_text("utf-8"))["cells"]
    exec("".join(next(cell["source"] for cell in cells if cell["cell_type"] == "code")))
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


def test_only_a_cell_that_is_run_asks_another_host(tmp_path, browser):
    """A lecture that is only read tells somebody else that it is; or the cell asks more hosts than
    the page has said."""
    if not importlib.util.find_spec("jupyterlite_pyodide_kernel"):
        pytest.skip("JupyterLite is not there: install site/requirements-lite.txt")
    lite.write(tmp_path / "lite")
    asked = set()

    def opened(file, part):
        page = browser.new_page()  # in a context of its own
        page.on("request", lambda request: asked.add(urllib.parse.urlsplit(request.url).hostname))
        page.goto(f"{address}/lite/lab/index.html?path={file}")
        page.locator(part).first.wait_for(timeout=60_000)
        return page

    with served(tmp_path) as address:
        opened("notebooks/02_rasterization.ipynb", ".jp-OutputArea-output img").close()
        page = opened("labs/transforms.py", ".jp-FileEditor .cm-line")
        assert "# exercise 1.2 (1 point)" in page.locator(".jp-FileEditor").inner_text()
        page.close()
        page = opened("notebooks/in_the_browser.ipynb", ".jp-Notebook .jp-CodeCell")
        page.wait_for_timeout(3000)  # a kernel that starts by itself would have asked by now
        assert asked == {"127.0.0.1"}
        page.locator(".jp-Notebook .jp-CodeCell").first.click()
        with page.expect_event("request", lambda request: "jsdelivr" in request.url):
            page.keyboard.press("Shift+Enter")
        assert asked == {"127.0.0.1", "cdn.jsdelivr.net"}
        page.close()
