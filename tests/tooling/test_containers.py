"""Containers, workflows and the machine of a grader: files that other programs read."""
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from click.testing import CliRunner
from submitted import put

from course.grading import autograder

ROOT = Path(__file__).parents[2]
FILES = ROOT / "course" / "grading" / "files"


def keeps(schema, path):
    """Whether a file keeps a schema that comes with check-jsonschema. No network is needed."""
    import check_jsonschema  # here, because that takes three seconds: every worker reads this file
    done = CliRunner().invoke(check_jsonschema.main, ["--builtin-schema", f"vendor.{schema}",
                                                      str(path)])
    return done.exit_code == 0


@pytest.mark.parametrize(("schema", "path", "right", "wrong"), [
    ("github-workflows", ROOT / ".github/workflows/test.yml", "runs-on:", "run-on:"),
    ("github-workflows", FILES / "labs.yml", "- run: python", "- runs: python"),
    ("compose-spec", FILES / "compose.yml", "depends_on: [worker]", "depend_on: [worker]"),
], ids=["tests", "labs", "compose"])
def test_what_others_read_keeps_its_schema(schema, path, right, wrong, tmp_path):
    """A misspelt key: the workflow does not start, and nobody sees it before the next push."""
    assert keeps(schema, path)
    text = path.read_text("utf-8")
    (tmp_path / path.name).write_text(text.replace(right, wrong), "utf-8")
    assert right in text and not keeps(schema, tmp_path / path.name)


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
