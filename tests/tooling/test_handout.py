"""The hand-out: what students need is there, and no solution but those released."""
import json
import re
import shutil

import pytest

from course import exercises
from course.grading import handout
from course.upkeep.skeleton import skeleton

LEAST = 30  # characters of a line that somebody could copy
# Lines of answers that students may read elsewhere, as they stand in a check's own oracle, in a
# lecture, or in code that is given: `mesh.edges` is for triangles what 11.1 asks for polygons.
ELSEWHERE = {
    "a, b = triangle[i], triangle[j]", "for k, (i, j) in enumerate(EDGES):",
    "face_index = np.full((height, width), -1)", "depth = np.full((height, width), np.inf)",
    "for f, corners in enumerate(faces):", "x, y = polygon[..., 0], polygon[..., 1]",
    "return (x * np.roll(y, -1, -1) - np.roll(x, -1, -1) * y).sum(-1) / 2",
    "for i, j in np.argwhere(face_index >= 0):", "seen = np.flatnonzero(face_index >= 0)",
    "return output.reshape(colour.shape)", "opposite = np.full(faces.shape, -1)",
    "edges, face_edges = mesh.edges(faces)",
    "key = np.minimum(start, end) * vertex_count + np.maximum(start, end)",
    "face_index, depth = np.full((height, width), -1), np.full((height, width), np.inf)",
}


def tidy(line):
    return " ".join(line.split())


def solution_lines(topic):
    """The lines of a topic's answers that are in none of its questions."""
    text = exercises.read(exercises.reference(topic))
    asked = set(map(tidy, skeleton(text).splitlines()))
    lines = set(map(tidy, text.splitlines())) - asked
    return {line for line in lines if len(line) >= LEAST} - ELSEWHERE


def lines_of(path):
    """The lines of a file; of a notebook, those of its cells."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".ipynb":
        text = "\n".join("".join(cell["source"]) for cell in json.loads(text)["cells"])
    return set(map(tidy, text.splitlines()))


@pytest.fixture(scope="module")
def handed_out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("handout") / "course"
    handout.run(folder, "1-4", "1")
    return folder


def test_no_solution_is_handed_out_but_those_released(handed_out):
    """The reference, or an answer in a lab, a lecture, a check or a file of the course."""
    secret = set().union(*(solution_lines(topic) for topic in exercises.topics()
                           if topic != "transforms"))
    texts = [path for path in handed_out.rglob("*") if path.suffix in (".py", ".ipynb", ".md")]
    assert {path.name: found for path in texts if (found := secret & lines_of(path))} == {}
    assert [path.name for path in (handed_out / "reference").iterdir()] == ["transforms.py"]
    assert len(texts) > 40 and len(secret) > 300


def test_labs_lectures_and_checks_are_there(handed_out):
    """A lab without its checks, lectures of labs that come later, or no licence."""
    assert "MIT License" in (handed_out / "LICENSE").read_text(encoding="utf-8")
    names = ["transforms", "rasterization", "scanline", "sampling", "msaa"]
    assert sorted(path.stem for path in handed_out.glob("labs/*.py")) == sorted(names)
    assert sorted(path.stem for path in handed_out.glob("tests/labs/test_*.py")) == sorted(
        f"test_{name}" for name in names)
    assert [path.stem[:2] for path in sorted(handed_out.glob("notebooks/*"))] == [
        "00", "01", "02", "03", "04"]
    assert not (handed_out / "tests" / "project").exists()
    for path in handed_out.glob("labs/*.py"):
        text = exercises.read(exercises.reference(path.stem))
        assert path.read_text(encoding="utf-8") == skeleton(text)


def test_lectures_import_the_labs(handed_out):
    """A lecture shows the reference's pictures, whatever the student has written."""
    lines = lines_of(handed_out / "notebooks" / "02_rasterization.ipynb")
    assert {"from labs import rasterization, scanline", "from reference import transforms"} <= lines
    for path in handed_out.glob("notebooks/*.ipynb"):
        imported = [line for line in lines_of(path) if re.match(r"from reference import", line)]
        assert set(imported) <= {"from reference import transforms"}, path


def test_its_checks_run_without_the_rest(handed_out, run_module):
    """A check, a golden file or a part of the course is missing."""
    done = run_module(handed_out, "course", "check")
    assert done.returncode == 1, done.stderr
    assert "Next: 1.1" in done.stdout and "cannot be collected" not in done.stdout
    shutil.copy(exercises.reference("msaa"), handed_out / "labs")
    done = run_module(handed_out, "course", "check", "msaa")
    assert done.returncode == 0 and "All that was asked for is done" in done.stdout, done.stdout


def test_the_whole_course_can_be_handed_out(tmp_path):
    """A module of given code has no checks, and stops the hand-out half way."""
    handout.run(tmp_path / "new")
    labs = {path.stem for path in tmp_path.glob("new/labs/*.py")}
    assert labs == set(exercises.topics())
    assert len(list(tmp_path.glob("new/notebooks/*.ipynb"))) == 17
    assert (tmp_path / "new" / "README.md").exists()


def test_labs_that_are_imported_come_along(tmp_path, capsys):
    """A lab that cannot be imported, for one that it needs is not there; or a module without
    exercises, and so without checks, is an error.
    """
    handout.run(tmp_path / "new", "8")
    assert sorted(path.stem for path in tmp_path.glob("new/labs/*.py")) == [
        "antialiasing", "diagnosis", "outlines", "rasterization", "transforms"]
    assert not (tmp_path / "new" / "reference").exists()
    assert "transforms, rasterization was added" in capsys.readouterr().out


def test_nothing_is_overwritten(tmp_path):
    """A hand-out into a folder with a student's work."""
    (tmp_path / "mine.py").write_text("x")
    with pytest.raises(ValueError, match="is not empty"):
        handout.run(tmp_path)
