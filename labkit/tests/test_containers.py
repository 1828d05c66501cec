"""The workflow, and the container of a grader: files that other programs read."""
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from click.testing import CliRunner
from submitted import put

from labkit.grading import autograder

ROOT = Path(__file__).parents[2]
FILES = ROOT / "labkit" / "grading" / "files"


def test_the_workflow_keeps_its_schema(tmp_path):
    """A misspelt key: the workflow does not start, and nobody sees it before the next push."""
    import check_jsonschema  # here, because that takes three seconds: every worker reads this file

    def keeps(text):
        path, = put(tmp_path, {"test.yml": text})  # the schema comes along: no network is needed
        return CliRunner().invoke(check_jsonschema.main, [
            "--builtin-schema", "vendor.github-workflows", str(path)]).exit_code == 0

    text = (ROOT / ".github/workflows/test.yml").read_text("utf-8")
    assert keeps(text) and not keeps(text.replace("runs-on:", "run-on:"))


def test_the_grader_s_image_has_all_that_grading_needs():
    """A folder that is new is not copied: the image is built, and no grading starts."""
    text = (FILES / "Dockerfile").read_text("utf-8")
    lines = [line.split()[1:-1] for line in re.findall(r"^COPY .*", text, re.MULTILINE)]
    copied = {name for line in lines for name in line}
    assert all((ROOT / name).exists() for name in copied)
    needed = {pattern.partition("/")[0] for pattern in autograder.NEEDED}
    assert needed <= copied


APT = """\
for package; do :; done  # the last one that is asked for
case "$package" in *-venv) [[ " {there} " = *" ${{package%-venv}} "* ]];; esac
"""
PYTHON = """\
echo "$(basename "$0") $2"
mkdir -p "$3/bin"
printf '#!/bin/bash\\necho "$@"\\n' > "$3/bin/pip"
chmod +x "$3/bin/pip"
"""


@pytest.mark.skipif(os.name == "nt", reason="it is a script of bash")
@pytest.mark.parametrize(("there", "chosen"), [
    (["python3", "python3.11"], "python3.11"), (["python3.12", "python3.13"], "python3.13")])
def test_the_set_up_takes_a_python_that_is_new_enough(there, chosen, tmp_path):
    """Gradescope's default image, Ubuntu 22.04, has Python 3.10 as python3: nothing starts."""
    shutil.copy(FILES / "setup.sh", tmp_path)
    shutil.copy(ROOT / "requirements.txt", tmp_path)
    programs = {"apt-get": APT.format(there=" ".join(there))} | dict.fromkeys(there, PYTHON)
    for path in put(tmp_path / "bin", {
            name: f"#!/bin/bash\n{text}\n" for name, text in programs.items()}):
        path.chmod(0o755)
    settings = {"PATH": f"{tmp_path / 'bin'}:/usr/bin:/bin", "GRADER": str(tmp_path / "grader")}
    done = subprocess.run(["bash", str(tmp_path / "setup.sh")], env=settings, cwd="/",
                          capture_output=True, encoding="utf-8")
    assert done.stdout.splitlines() == [
        f"{chosen} venv", "install --no-cache-dir -r requirements.txt"], done.stderr
