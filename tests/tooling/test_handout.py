"""The hand-out: what students need is there, and no solution but those released."""
import ast
import json
import re
import shutil
import zipfile

import pytest

from course import exercises
from course.grading.handing import handout

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
    asked = set(map(tidy, exercises.skeleton(text).splitlines()))
    lines = set(map(tidy, text.splitlines())) - asked
    return {line for line in lines if len(line) >= LEAST} - ELSEWHERE


def lines_of(path):
    """The lines of a file; of a notebook, those of its cells."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".ipynb":
        text = "\n".join("".join(cell["source"]) for cell in json.loads(text)["cells"])
    return set(map(tidy, text.splitlines()))


def first_exercise(labs):
    """The exercise of the core to begin with."""
    core = [exercise for topic in exercises.topics_of(labs)
            for exercise in exercises.topic_exercises(topic) if not exercise.is_extra]
    return min(core, key=lambda exercise: [int(part) for part in exercise.number.split(".")])


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
    assert {path.name for path in handed_out.glob("course/experiments/folder/fit_report.*")} == {
        "fit_report.py", "fit_report.html", "fit_report.js"}
    asking = ["transforms", "rasterization", "scanline", "sampling", "msaa"]
    assert sorted(path.stem for path in handed_out.glob("labs/*.py")) == sorted(
        ["arrays", *asking])
    assert sorted(path.stem for path in handed_out.glob("tests/labs/test_*.py")) == sorted(
        f"test_{name}" for name in asking)
    assert [path.stem[:2] for path in sorted(handed_out.glob("notebooks/*.ipynb"))] == [
        "00", "01", "02", "03", "04"]
    assert not (handed_out / "tests" / "project").exists()
    for path in handed_out.glob("labs/*.py"):
        text = exercises.read(exercises.reference(path.stem))
        assert path.read_text(encoding="utf-8") == exercises.skeleton(text)


def test_lectures_import_the_labs(handed_out):
    """A lecture imports a reference that is not there, or not one that is."""
    for path in handed_out.glob("notebooks/*.ipynb"):
        packages = {line.split()[1] for line in lines_of(path)
                    if re.match(r"from (labs|reference) import", line)}
        assert packages == {"00": set(), "01": {"reference"}}.get(path.stem[:2], {"labs"}), path


def test_its_checks_run_without_the_rest(handed_out, run_module):
    """A check, a golden file or a part of the course is missing."""
    done = run_module(handed_out, "course", "check")
    assert done.returncode == 1, done.stderr
    first = first_exercise("1")
    assert f"Next: {first.number} {first.name}" in done.stdout
    assert "cannot be collected" not in done.stdout
    shutil.copy(exercises.reference("msaa"), handed_out / "labs")
    done = run_module(handed_out, "course", "check", "msaa")
    assert done.returncode == 0 and "All that was asked for is done" in done.stdout, done.stdout


def test_a_mark_or_a_function_that_was_deleted_is_missed(tmp_path, run_module):
    """An exercise whose mark is gone is none, and the board says that all is done."""
    handout.run(tmp_path, "2")
    lab = tmp_path / "labs" / "rasterization.py"
    kept = [line.replace("  # exercise 2.1 (2 points)", "")
            for line in lab.read_text("utf-8").splitlines()]
    lab.write_text("\n".join(kept).replace("def is_top_left(", "def is_left("), "utf-8")
    done = run_module(tmp_path, "course", "check", "2.1")
    assert "Next: 2.1 edge_function, not started" in done.stdout, done.stdout
    done = run_module(tmp_path, "course", "check", "2.5")
    assert "labs/rasterization.py has no function is_top_left" in done.stdout, done.stdout


def test_the_whole_course_can_be_handed_out(tmp_path):
    """A module of given code has no checks, and stops the hand-out half way."""
    handout.run(tmp_path / "new")
    labs = {path.stem for path in tmp_path.glob("new/labs/*.py")}
    assert labs == set(exercises.topics())
    assert len(list(tmp_path.glob("new/notebooks/*.ipynb"))) == 17
    assert (tmp_path / "new" / "README.md").exists()


def test_what_a_lab_needs_comes_along_and_asks_nothing(tmp_path, capsys):
    """A lab that cannot be imported, for one that it needs is not there; a lecture that cannot be
    run, for its first cells need another lab; a board that asks for labs not handed out.
    """
    handout.run(tmp_path / "new", "8")
    given = ["transforms", "arrays", "rasterization", "scanline", "sampling"]
    for topic in given:
        text = exercises.read(tmp_path / "new" / "labs" / f"{topic}.py")
        assert exercises.text_exercises(text) == ()
        assert ast.dump(ast.parse(text)) == ast.dump(ast.parse(exercises.read(
            exercises.reference(topic))))
    assert sorted(path.stem for path in tmp_path.glob("new/labs/*.py")) == sorted(
        [*exercises.LABS[7], *given])
    assert {path.stem for path in tmp_path.glob("new/tests/labs/test_*.py")} == {
        f"test_{topic}" for topic in exercises.LABS[7] if topic in exercises.asking_topics()}
    assert not (tmp_path / "new" / "reference").exists()
    assert f"{', '.join(given)} came along, complete" in capsys.readouterr().out


def test_a_hand_out_of_the_first_labs_gives_nothing_away():
    """A lecture or an experiment of a lab uses a lab that comes later."""
    for lab in range(1, len(exercises.LABS) + 1):
        needed = handout.needed(exercises.topics_of(str(lab)))
        assert set(needed) <= set(exercises.topics_of(f"1-{lab}"))


def test_extras_are_handed_out_open(tmp_path):
    """--extra is lost on the way to the labs."""
    handout.run(tmp_path / "new", "2", extra=True)
    for topic in "rasterization", "scanline":
        text = exercises.read(exercises.reference(topic))
        lab = exercises.read(tmp_path / "new" / "labs" / f"{topic}.py")
        assert lab == exercises.skeleton(text, extra=True) != exercises.skeleton(text)


def test_solutions_of_labs_that_stay_here_are_refused(tmp_path):
    """The board asks for a lab without checks."""
    with pytest.raises(ValueError, match="transforms is not handed out"):
        handout.run(tmp_path / "new", "2", "1-2")
    assert not (tmp_path / "new").exists()


def test_solutions_that_are_released_later_can_be_put_in(tmp_path, run_module):
    """A zip that unpacks elsewhere, or whose answers the hand-out does not find."""
    handout.run(tmp_path / "new", "1-2")
    handout.release("1", tmp_path / "solutions.zip")
    with zipfile.ZipFile(tmp_path / "solutions.zip") as archive:
        assert archive.namelist() == ["reference/transforms.py"]
        archive.extractall(tmp_path / "new")
    done = run_module(tmp_path / "new", "course", "close", "1", "--core")
    assert done.returncode == 0, done.stderr
    lab = tmp_path / "new" / "labs" / "transforms.py"
    assert exercises.read(lab) == exercises.read(exercises.reference("transforms"))


COMMANDS = ["demo", "notebooks", "check", "open", "close", "pack"]
PROBE = """
import contextlib, functools, importlib, itertools, json
from pathlib import Path

import matplotlib

matplotlib.use("agg")
from course import cli
from course.experiments.scenes import demo


def first_steps(scene):
    return functools.wraps(scene)(lambda labs: itertools.islice(scene(labs), 2))


for path in Path("labs").glob("*.py"):
    importlib.import_module(f"labs.{path.stem}")
for path in sorted(Path("notebooks").glob("*.ipynb")):
    cells = ["".join(cell["source"]) for cell in json.loads(path.read_text("utf-8"))["cells"]
             if cell["cell_type"] == "code"]
    whole = path.stem == "00_start_here" and Path("tests/labs/test_rasterization.py").exists()
    names = {}
    try:
        for cell in cells if whole else cells[:4]:
            exec(cell, names)
    except NotImplementedError as error:
        print(path.stem, "stops at", error)
demo.SCENES = {name: first_steps(scene) for name, scene in demo.SCENES.items() if name != "flight"}
print("DEMO", cli.main(["demo"]))
lab = Path("lab").read_text()
for command in "demo reconstruct", "demo bunny --impl reference", f"check {lab}", "pack", "":
    print("STATUS", cli.main(command.split()))
for command in "mistakes", "handout new", "skeleton --force", "grade --out":
    with contextlib.suppress(SystemExit):
        cli.main(command.split())
        print("STATUS of", command)
"""


@pytest.mark.parametrize("labs", [*map(str, range(1, len(exercises.LABS) + 1)), "1-4", None])
def test_a_hand_out_is_whole(labs, tmp_path, run_module):
    """An import, a lecture, a scene or a command needs a file that students do not have."""
    handout.run(tmp_path, labs)
    first = first_exercise(labs)
    (tmp_path / "probe.py").write_text(PROBE, "utf-8")
    (tmp_path / "lab").write_text(first.number.partition(".")[0])
    hints = (tmp_path / "course" / "checks" / "hints.json").read_bytes()
    done = run_module(tmp_path, "probe")
    assert done.returncode == 0, done.stderr
    assert done.stdout.count(f"Next: {first.number} {first.name}, not started") == 2  # and packed
    assert re.search(r"^.*left out: (exercise|labs/).*\nDEMO 1$|asked for by name: .*\nDEMO 0$",
                     done.stdout, re.MULTILINE), done.stdout
    assert re.findall(r"^STATUS (.*)", done.stdout, re.MULTILINE) == ["2", "2", "1", "0", "0"]
    assert "/tmp" not in done.stdout.partition("STATUS 1")[2].replace(str(tmp_path), "")
    told = done.stderr.splitlines()
    assert re.match(r"course: (exercise [\d.]+, \w+, is not written yet; python3 -m course check "
                    r"[\d.]+|labs/\w+.py is not in this copy)", told[0])
    assert told[1] == "course: reference/transforms.py is not in this copy of the course"
    assert all("is for teachers, and this is a copy for students" in line for line in told[2:])
    assert len(told) == 6
    assert re.findall(r"^  ([a-z]+)(?:  +\S| [\[A-Z])", done.stdout, re.MULTILINE) == COMMANDS
    assert (tmp_path / "course" / "checks" / "hints.json").read_bytes() == hints
    if labs in ("2", "1-4", None):  # the mistake that notebook 00 makes, in a copy
        assert re.search(r"Next: [\d.]+ rasterize_loop, failing in", done.stdout)


def test_nothing_is_overwritten(tmp_path):
    """A hand-out into a folder with a student's work."""
    (tmp_path / "mine.py").write_text("x")
    with pytest.raises(ValueError, match="is not empty"):
        handout.run(tmp_path)


def with_core(topic, text):
    """A lab with the reference's answers in the place of its core's TODOs; extras stay."""
    lines = exercises.text_lines(text)
    known = {answer.exercise.number: answer.text for answer in exercises.answers(
        exercises.read(exercises.reference(topic)))}
    for answer in reversed(exercises.answers(text)):
        if not answer.exercise.is_extra:
            exercises.put(lines, answer, known[answer.exercise.number], is_open=True)
    return "".join(lines)


@pytest.fixture(scope="module")
def worked_on(tmp_path_factory):
    """A hand-out of labs 1 to 9 whose core is written, and nothing else."""
    root = tmp_path_factory.mktemp("core")
    handout.run(root, "1-9")
    for path in root.glob("labs/*.py"):
        path.write_text(with_core(path.stem, exercises.read(path)), "utf-8", newline="")
    (root / "probe.py").write_text(FIT, "utf-8")
    return root


@pytest.mark.parametrize(("command", "said"), [
    (("probe",), "labs 3"),
    (("course", "demo", "--impl", "labs", "bunny", "fit_triangle"), "px off"),
    (("course", "check"), "All that was asked for is done"),
    pytest.param(("course", "notebooks", "00", "02", "09"), "", marks=pytest.mark.weekly),
], ids=["fit", "demo", "check", "notebooks"])
def test_with_the_core_of_labs_1_to_9_everything_runs_on_the_students_code(
        worked_on, run_module, command, said):
    """A fit, a lecture or the board needs an extra, a later lab, or the reference."""
    assert not (worked_on / "reference").exists()
    done = run_module(worked_on, *command, seconds=300)
    assert done.returncode == 0 and said in done.stdout, done.stdout + done.stderr


FIT = """
from course.experiments.scenes import demo, fit_bunny

labs = demo.Labs()
path, _ = fit_bunny.fit(labs, 0.02, steps=3, size=32)
list(fit_bunny.seen_anew(labs, path))
print(labs.package, len(path) - 1)
"""
