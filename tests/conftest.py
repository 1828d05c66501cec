import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytest_plugins = ["course.checks.plugin"]

ROOT = Path(__file__).parent.parent


@pytest.fixture(scope="session")
def house(tmp_path_factory):
    """house({"labs/transforms.py": text, ...}) -> the root of a course with these files alone."""
    def build(files):
        root = tmp_path_factory.mktemp("house")
        # With what was compiled, which is of use as long as a file is as old as it was.
        given = (*ROOT.glob("course/**/*.py"), *ROOT.glob("course/**/__pycache__/*.pyc"),
                 *ROOT.glob("course/grading/files/*"))
        given = [path for path in given if path.parent != ROOT / "course" / "complete"]  # topics
        for path in (*given, *map(ROOT.joinpath, (
                "tests/conftest.py", "pyproject.toml", "requirements.txt"))):
            copy = root / path.relative_to(ROOT)
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, copy)
        for name, text in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        return root

    return build


@pytest.fixture(scope="session")
def run_module():
    """run_module(root, "pytest", "-x") -> the finished process of python -m pytest -x in root."""
    settings = {name: value for name, value in os.environ.items()
                if not name.startswith(("PYTEST_", "PYTHON", "COLUMNS", "FORCE_COLOR", "TTY_"))}
    settings["PYTHONIOENCODING"] = "utf-8"

    def run(root, *command, seconds=600):
        return subprocess.run([sys.executable, "-m", *map(str, command)], cwd=root, env=settings,
                              capture_output=True, encoding="utf-8", timeout=seconds)

    return run
