"""The workflow, and the container of a grader: files that other programs read."""
import re
from pathlib import Path

from click.testing import CliRunner
from submitted import put

from labkit.grading.apart import running

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
    needed = {pattern.partition("/")[0] for pattern in running.DECIDE}
    assert needed <= copied
