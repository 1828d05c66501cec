"""JupyterLite: JupyterLab, the lectures and the labs as files, to be run in the browser.

Python and its packages are not among the files. They come from Pyodide's CDN when a cell is run.
One that the CDN does not have, comm, is among them, so that no other host is asked.
"""
import json
import shutil
import subprocess
import sys
import tempfile
import zipfile
from importlib.metadata import distribution
from pathlib import Path

from labkit.places import ROOT

from . import put

CONTENTS = (
    "notebooks/*.ipynb", "notebooks/errata.md", "notebooks/openings/*.png", "labs/*.py",
    "reference/*.py", "course/*.py", "course/given/**/*.py", "course/given/data/**/*.*",
    "course/complete/*.py", "course/fast/*.py", "course/scenes/*.py",
    "labkit/*.py", "labkit/checks/*.*", "labkit/upkeep/__init__.py", "labkit/upkeep/extras.py",
    "labs.toml", "conftest.py",
    "tests/labs/*.*", "tests/golden/*", "pyproject.toml", "README.md", "LICENSE")
KERNEL = "@jupyterlite/pyodide-kernel-extension"
# What modules import that a cell imports. What a cell itself imports, Pyodide loads without this.
PACKAGES = ["numpy", "scipy", "matplotlib", "pillow", "pytest", "rich"]
SETTINGS = {"jupyter-lite-schema-version": 0, "jupyter-config-data": {
    "notebookStartsKernel": "false",  # the first cell that is run starts it
    "litePluginSettings": {f"{KERNEL}:kernel": {"loadPyodideOptions": {"packages": PACKAGES}}}}}
OVERRIDES = {"@jupyterlab/notebook-extension:tracker": {"autoStartDefaultKernel": True}}


def write(folder):
    """Write JupyterLite with the course's files to a folder, which is made anew.

    subprocess.CalledProcessError: JupyterLite could not be built, and has said why.
    """
    with tempfile.TemporaryDirectory() as source:
        contents = Path(source) / "contents"
        collect(contents)
        pack("comm", contents.parent / "pypi")
        for name, content in (("jupyter-lite.json", SETTINGS), ("overrides.json", OVERRIDES)):
            put(contents.parent / name, json.dumps(content))
        shutil.rmtree(folder, ignore_errors=True)
        extension = Path(sys.prefix) / "share" / "jupyter" / "labextensions" / KERNEL
        subprocess.run(
            [sys.executable, "-m", "jupyterlite_core", "build", "--lite-dir", source,
             "--contents", contents, "--output-dir", Path(folder).resolve(), "--apps", "lab",
             "--ignore-sys-prefix", f"--LiteBuildConfig.federated_extensions={extension}",
             "--no-sourcemaps", "--no-unused-shared-packages"],
            cwd=source, stdout=subprocess.DEVNULL, check=True)


def collect(folder):
    """Copy what a student needs: lectures, labs, checks, and the complete code."""
    for pattern in CONTENTS:
        for path in ROOT.glob(pattern):
            put(folder / path.relative_to(ROOT), path.read_bytes())
    shutil.copy2(ROOT / "site" / "texts" / "in_the_browser.ipynb", folder / "notebooks")


def pack(name, folder):
    """Write the wheel of an installed package of pure Python."""
    found = distribution(name)
    folder.mkdir()
    with zipfile.ZipFile(folder / f"{name}-{found.version}-py3-none-any.whl", "w") as wheel:
        for file in found.files:
            if file.suffix != ".pyc" and file.name not in ("INSTALLER", "REQUESTED"):
                wheel.write(file.locate(), file)
