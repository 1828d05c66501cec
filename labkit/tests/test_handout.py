"""The hand-out: what students need is there, and no solution but those released."""
import ast
import re
import shutil
import zipfile
from pathlib import Path

import pytest

from labkit import board, exercises, lab_text
from labkit.grading.handing import handout

PROBES = Path(__file__).with_name("texts")
LEAST = 30  # characters of a line that somebody could copy
# Lines of answers that students may read elsewhere, as they stand in a check's own oracle, in a
# lecture, or in code that is given: `mesh.edges` is for triangles what 11.1 asks for polygons.
ELSEWHERE = {
    "a, b = triangle[i], triangle[j]", "face_index = np.full((height, width), -1)",
    "for f, corners in enumerate(faces):", "x, y = polygon[..., 0], polygon[..., 1]",
    "for k, (i, j) in enumerate(EDGES):", "x, y, w = screen_points(clip, width, height)",
    "key = np.minimum(start, end) * vertex_count + np.maximum(start, end)"}


def tidy(line):
    return " ".join(line.split())


def solution_lines(topic):
    """The lines of a topic's answers that are in none of its questions."""
    text = exercises.read(exercises.reference(topic))
    asked = set(map(tidy, lab_text.skeleton(text).splitlines()))
    lines = set(map(tidy, text.splitlines())) - asked
    return {line for line in lines if len(line) >= LEAST} - ELSEWHERE


def lines_of(path):
    """The lines of a file; of a notebook, those of its cells."""
    texts = ([*exercises.cells(path), *exercises.cells(path, "code")] if path.suffix == ".ipynb"
             else [exercises.read(path)])
    return set(map(tidy, "\n".join(texts).splitlines()))


def first_exercise(labs):
    """The exercise of the core to begin with: the first one that the lecture reaches."""
    core = {exercise.number: exercise for topic in exercises.topics_of(labs)
            for exercise in exercises.topic_exercises(topic) if not exercise.is_extra}
    reached = board.sections(*exercises.pages(exercises.topics_of(labs)[0]))
    return core[next(number for number in reached if number in core)]


def files(folder, pattern):
    return {path.relative_to(folder).as_posix() for path in folder.glob(pattern)}


@pytest.fixture(scope="module")
def handed_out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("handout") / "course"
    handout.run(folder, "1-4", "1")
    return folder


def test_no_solution_is_handed_out_but_those_released(handed_out):
    """The reference, or an answer in a lab, a lecture, a check or a file of the course."""
    secret = set().union(*(solution_lines(topic) for topic in exercises.topics()
                           if topic not in exercises.LABS[0]))
    texts = [path for path in handed_out.rglob("*") if path.suffix in (".py", ".ipynb", ".md")]
    assert {path.name: found for path in texts if (found := secret & lines_of(path))} == {}
    assert files(handed_out, "reference/*") == {"reference/__init__.py", "reference/transforms.py"}
    assert len(texts) > 40 and len(secret) > 300


BEFORE_8 = "transforms", "rasterization", "sampling", "interpolation"


ONCE = [topic for topic in exercises.topics() if topic not in exercises.lab_topics()]


@pytest.mark.parametrize(("labs", "given", "complete", "lectures"), [
    ("1-4", (), (), range(5)), ("8", BEFORE_8, ("diagnosis", "intersections"), (0, 8)),
    (None, (), ONCE, range(18))])
def test_labs_what_they_need_their_checks_and_lectures_are_there(
        labs, given, complete, lectures, tmp_path, capsys):
    """A lab that cannot be imported, or that has no checks; a lecture of labs that come later; a
    board that asks for what only came along.
    """
    handout.run(tmp_path, labs)
    asked = exercises.topics_of(labs)
    assert files(tmp_path, "labs/*.py") == {
        f"labs/{name}.py" for name in ("__init__", *asked, *given)}
    assert files(tmp_path, "course/complete/*.py") == {
        f"course/complete/{name}.py" for name in complete}
    assert bool(files(tmp_path, "course/fast/*_kernels.py")) == (labs is None)
    linked = re.findall(r"\]\((\d\w+.ipynb)", (tmp_path / "notebooks/errata.md").read_text("utf-8"))
    assert linked and all((tmp_path / "notebooks" / name).exists() for name in linked)
    for topic in asked:
        text = exercises.read(exercises.reference(topic))
        assert exercises.read(tmp_path / f"labs/{topic}.py") == lab_text.skeleton(text)
    for topic in given:
        text = exercises.read(tmp_path / f"labs/{topic}.py")
        assert exercises.text_exercises(text) == () and ast.dump(ast.parse(text)) == ast.dump(
            ast.parse(exercises.read(exercises.reference(topic))))
    assert (f"{', '.join(given)} came along, complete" in capsys.readouterr().out) == bool(given)
    assert files(tmp_path, "tests/labs/test_*.py") == {
        f"tests/labs/test_{topic}.py" for topic in asked if topic in exercises.asking_topics()}
    assert {int(path.stem[:2]) for path in tmp_path.glob("notebooks/*.ipynb")} == set(lectures)
    there = files(tmp_path, "**/*")
    assert {"LICENSE", "README.md", "apps/bridge/requirements.txt", "apps/bridge/corners.png",
            "apps/reconstruct/README.md", "apps/reconstruct/command.py"} <= there
    assert not there & {"reference", "tests/project", "apps/bridge/tests"}


def test_lectures_import_the_labs_and_show_their_pictures(handed_out):
    """A lecture imports a reference that is not there, or not one that is; the still of a figure is
    missing, or leads to a site that no student has.
    """
    for path in handed_out.glob("notebooks/*.ipynb"):
        text = "\n".join(lines_of(path))
        assert all((path.parent / name).exists() for name in re.findall('<img src="([^"]+)"', text))
        assert "../site/" not in text
        packages = {line.split()[1] for line in lines_of(path)
                    if re.match(r"from (labs|reference) import", line)}
        assert packages == {"00": set(), "01": {"reference"}}.get(path.stem[:2], {"labs"}), path


def test_a_mark_or_a_function_that_was_deleted_is_missed(tmp_path, run_module):
    """An exercise whose mark is gone is none, and the board says that all is done."""
    handout.run(tmp_path, "2")
    lab = tmp_path / "labs" / "rasterization.py"
    kept = [line.replace("  # exercise 2.1 (2 points)", "")
            for line in lab.read_text("utf-8").splitlines()]
    lab.write_text("\n".join(kept).replace("def is_top_left(", "def is_left("), "utf-8")
    done = run_module(tmp_path, "course", "check", "2.1")
    assert "Next: 2.1 edge_function, not started" in done.stdout, done.stdout
    done = run_module(tmp_path, "course", "check", "2.2")
    assert "labs/rasterization.py has no function is_top_left" in done.stdout, done.stdout


def test_a_hand_out_of_the_first_labs_gives_nothing_away():
    """A lecture or an experiment of a lab uses a lab that comes later."""
    for lab in range(1, len(exercises.LABS) + 1):
        needed = handout.needed(exercises.topics_of(str(lab)))
        assert max(map(exercises.lab_number, needed)) == lab


def test_extras_are_handed_out_open(tmp_path):
    """--extra is lost on the way to the labs."""
    handout.run(tmp_path / "new", "2", extra=True)
    text = exercises.read(exercises.reference("rasterization"))
    lab = exercises.read(tmp_path / "new/labs/rasterization.py")
    assert lab == lab_text.skeleton(text, extra=True) != lab_text.skeleton(text)


def test_solutions_that_are_released_later_can_be_put_in(tmp_path, run_module):
    """A zip that unpacks elsewhere, or whose answers the hand-out does not find."""
    handout.run(tmp_path / "new", "1-2")
    handout.release("1", tmp_path / "solutions.zip")
    with zipfile.ZipFile(tmp_path / "solutions.zip") as archive:
        assert archive.namelist() == ["reference/__init__.py", "reference/transforms.py"]
        archive.extractall(tmp_path / "new")
    done = run_module(tmp_path / "new", "course", "close", "1", "--core")
    assert done.returncode == 0, done.stderr
    lab = tmp_path / "new" / "labs" / "transforms.py"
    assert exercises.read(lab) == exercises.read(exercises.reference("transforms"))


COMMANDS = ["demo", "notebooks", "reconstruct", "run", "check", "open", "close", "pack"]


@pytest.mark.parametrize("labs", [*map(str, range(1, len(exercises.LABS) + 1)), "1-4", None])
def test_a_hand_out_is_whole(labs, tmp_path, run_module):
    """An import, a check, a lecture, a scene or a command needs a file that students do not have.
    """
    handout.run(tmp_path, labs)
    first = first_exercise(labs)
    shutil.copy(PROBES / "probe_of_a_handout.py", tmp_path / "probe.py")
    (tmp_path / "lab").write_text(first.number.partition(".")[0])
    hints = (tmp_path / "tests" / "labs" / "hints.json").read_bytes()
    done = run_module(tmp_path, "probe")
    assert done.returncode == 0, done.stderr
    assert "cannot be collected" not in done.stdout
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
    assert (tmp_path / "tests" / "labs" / "hints.json").read_bytes() == hints
    if labs in ("2", "1-4", None):  # the mistake that notebook 00 makes, in a copy
        assert re.search(r"Next: [\d.]+ rasterize, failing", done.stdout)


def test_nothing_is_overwritten(tmp_path):
    """A hand-out into a folder with a student's work."""
    (tmp_path / "mine.py").write_text("x")
    with pytest.raises(ValueError, match="is not empty"):
        handout.run(tmp_path)


@pytest.mark.parametrize(("after", "labs"), [("1", "2"), ("1-2", "3"), ("1", "8"), ("8", "10")])
def test_what_labs_add_to_an_earlier_hand_out_replaces_nothing_of_it(after, labs, tmp_path):
    """A student's work is written over; or a check, a lecture or given code is left out."""
    for folder, *asked in ("old", after), ("new", labs), ("whole", f"{after},{labs}"):
        handout.run(tmp_path / folder, *asked, after=after if folder == "new" else None)
    old, new, whole = ({path.relative_to(folder).as_posix(): path.read_bytes()
                        for path in folder.rglob("*") if path.is_file()}
                       for folder in (tmp_path / name for name in ("old", "new", "whole")))
    assert f"labs/{exercises.LABS[int(labs) - 1][0]}.py" in new and not old.keys() & new.keys()
    assert (old | new).keys() == whole.keys()
    with_links = {name for name in old if name.endswith((".md", ".ipynb"))}
    assert {name for name, part in (old | new).items() if part != whole[name]} <= with_links


def test_who_has_done_lab_1_goes_on_in_the_same_folder_with_lab_2(tmp_path, run_module):
    """What was done is open again, or what came later is not found."""
    handout.run(tmp_path / "course", "1")
    lab = tmp_path / "course" / "labs" / "transforms.py"
    shutil.copy(exercises.reference("transforms"), lab)
    handout.run(tmp_path / "week2", "2", after="1")
    shutil.copytree(tmp_path / "week2", tmp_path / "course", dirs_exist_ok=True)
    assert exercises.read(lab) == exercises.read(exercises.reference("transforms"))
    done = run_module(tmp_path / "course", "course", "check", "1")
    assert "14 of 14 points. Next: lab 2, rasterization" in done.stdout, done.stdout
    done = run_module(tmp_path / "course", "course", "check")
    assert "Next: 2.1 edge_function, not started" in done.stdout, done.stdout


@pytest.mark.parametrize(("labs", "solutions", "after", "sentence"), [
    ("2", "1-2", None, "transforms is not handed out"),
    ("2", None, "3",
     "of labs 3 has labs/rasterization.py already, complete, as its labs use it: name"),
    ("1-2", None, "1",
     "of labs 1 has labs/transforms.py already: name in --labs only labs that it"),
    (None, None, "1", "of labs 1 has labs/transforms.py already: name")])
def test_a_lab_that_stays_here_or_is_there_already_is_refused(
        labs, solutions, after, sentence, tmp_path):
    """The board asks for a lab without checks. Or empty answers replace what was done, or what came
    complete.
    """
    with pytest.raises(ValueError, match=sentence):
        handout.run(tmp_path / "new", labs, solutions, after=after)
    assert not (tmp_path / "new").exists()


@pytest.fixture(scope="module")
def worked_on(tmp_path_factory):
    """A hand-out of labs 1 to 9 whose core is written, and nothing else."""
    root = tmp_path_factory.mktemp("core")
    handout.run(root, "1-9")
    for path in root.glob("labs/[!_]*.py"):
        shutil.copy(exercises.reference(path.stem), path)
    shutil.copy(PROBES / "probe_of_a_fit.py", root / "probe.py")
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
    done = run_module(worked_on, *command)
    assert done.returncode == 0 and said in done.stdout, done.stdout + done.stderr
