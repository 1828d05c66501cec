"""JupyterLite: JupyterLab, the lectures and the labs as files, to be run in the browser.

Python and its packages are not among the files. They come from Pyodide's CDN when a cell is run.
One that the CDN does not have, comm, is among them, so that no other host is asked.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from importlib.metadata import distribution
from pathlib import Path

from course.given.places import ROOT

from . import put

CONTENTS = (
    "notebooks/*.ipynb", "notebooks/errata.md", "notebooks/openings/*.png", "labs/*.py",
    "reference/*.py", "course/*.py", "course/given/**/*.py", "course/given/data/**/*.*",
    "course/complete/*.py", "course/fast/*.py",
    "course/experiments/**/*.*", "course/checks/*.*", "course/upkeep/__init__.py",
    "course/upkeep/extras.py", "tests/conftest.py",
    "tests/labs/*.py", "tests/golden/*", "pyproject.toml", "README.md", "LICENSE")
TEXTS = Path(__file__).parents[1] / "texts"
GUIDE, NO_PYTHON = TEXTS / "in_the_browser.ipynb", TEXTS / "no_python.js"
KERNEL = "@jupyterlite/pyodide-kernel-extension"
# What modules import that a cell imports. What a cell itself imports, Pyodide loads without this.
PACKAGES = ["numpy", "scipy", "matplotlib", "pillow", "pytest", "rich"]
SETTINGS = {"jupyter-lite-schema-version": 0, "jupyter-config-data": {
    "notebookStartsKernel": "false",  # the first cell that is run starts it
    "litePluginSettings": {f"{KERNEL}:kernel": {"loadPyodideOptions": {"packages": PACKAGES}}}}}
OVERRIDES = {"@jupyterlab/notebook-extension:tracker": {"autoStartDefaultKernel": True}}


def write(folder):
    """Write JupyterLite with the course's files to a folder, which is made anew.

    OSError: JupyterLite could not be built.
    """
    with tempfile.TemporaryDirectory() as source:
        contents = Path(source) / "contents"
        collect(contents)
        pack("comm", contents.parent / "pypi")
        for name, content in (("jupyter-lite.json", SETTINGS), ("overrides.json", OVERRIDES)):
            put(contents.parent / name, json.dumps(content))
        shutil.rmtree(folder, ignore_errors=True)
        extension = Path(sys.prefix) / "share" / "jupyter" / "labextensions" / KERNEL
        built = subprocess.run(
            [sys.executable, "-m", "jupyterlite_core", "build", "--lite-dir", source,
             "--contents", contents, "--output-dir", Path(folder).resolve(), "--apps", "lab",
             "--ignore-sys-prefix", f"--LiteBuildConfig.federated_extensions={extension}",
             "--no-sourcemaps", "--no-unused-shared-packages"],
            cwd=source, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8")
    if built.returncode:
        raise OSError(f"cannot build JupyterLite: {built.stdout[-2000:]}")
    watch(Path(folder), extension)


def watch(folder, extension):
    """Have JupyterLab say so when its kernel cannot load Python."""
    python, = {address for file in (extension / "static").glob("*.js")
               for address in re.findall(r'"(https:[^"]+/pyodide\.mjs)"', file.read_text("utf-8"))}
    shutil.copy2(NO_PYTHON, folder)
    page = folder / "lab" / "index.html"
    script = f'<head><script src="../{NO_PYTHON.name}" data-python="{python}"></script>'
    page.write_text(page.read_text("utf-8").replace("<head>", script, 1), "utf-8")


def collect(folder):
    """Copy what a student needs: lectures, labs, checks, and the complete code."""
    for pattern in CONTENTS:
        for path in ROOT.glob(pattern):
            put(folder / path.relative_to(ROOT), path.read_bytes())
    shutil.copy2(GUIDE, folder / "notebooks")


def pack(name, folder):
    """Write the wheel of an installed package of pure Python."""
    found = distribution(name)
    folder.mkdir()
    with zipfile.ZipFile(folder / f"{name}-{found.version}-py3-none-any.whl", "w") as wheel:
        for file in found.files:
            if file.suffix != ".pyc" and file.name not in ("INSTALLER", "REQUESTED"):
                wheel.write(file.locate(), file)
