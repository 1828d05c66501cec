"""Modules that students put beside the labs: handed in, hashed and graded with these."""
import html
from typing import NamedTuple

import pytest
from small_course import LAB, first_lab, grade_command, grades
from submitted import put, zipped

from course.given import whose
from labkit import exercises, imports, places
from labkit.grading.apart import sandbox
from labkit.grading.handing import contents, submissions

TWICE = "def twice(x):\n    return 2 * x\n"


class Own(NamedTuple):
    """How a lab imports, what it calls, and the files beside it."""

    line: str
    call: str = "twice(x)"
    files: tuple = (("norms.py", TWICE),)

    @property
    def lab(self):
        """The first lab, in which double comes from a module of the student's own."""
        return LAB.replace("2 * x", self.call).replace("\n\n\ndef d", f"\n{self.line}\n\n\ndef d")


TAKEN = {
    "name": Own("from .norms import twice"),
    "renamed": Own("from .norms import twice as t", "t(x)"),
    "absolute": Own("from labs.norms import twice"),
    "module": Own("from . import norms", "norms.twice(x)"),
    "absolute_module": Own("from labs import norms", "norms.twice(x)"),
    "with_its_package": Own("import labs.norms", "labs.norms.twice(x)"),
    "when_called": Own("def f(x):\n    from .norms import twice\n    return twice(x)", "f(x)"),
    "in_turn": Own("from .norms import twice", files=(
        ("norms.py", "from .more import twice\n"), ("more.py", f"import numpy as np\n{TWICE}"))),
    "in_a_circle": Own("from .norms import twice", files=(
        ("norms.py", f"from . import more, transforms\n{TWICE}"),
        ("more.py", "from . import norms\nfrom .norms import __name__ as its\n"))),
    "names_of_others": Own("import numpy as np\nfrom .numpy import twice\nfrom .reference import x",
                           "np.array(twice(x))", (("numpy.py", TWICE), ("reference.py", "x = 1\n"),
                                                  ("course.py", "1 / 0\n"), ("given.py", "-"))),
    "named_as_a_lab": Own("from .my_transforms import twice",
                          files=(("my_transforms.py", TWICE), ("transforms_2.py", ""))),
    "empty": Own("from . import nothing", "2 * x", (("nothing.py", ""),))}
UNTAKEN = {"names_of_others": {"course.py", "given.py"},  # nothing imports them
           "named_as_a_lab": {"transforms_2.py"}}


ABSENT = "labs/norms.py, which is imported, is not beside the lab that imports it"
REFUSED = {  # what lies beside a lab that gets no points, and what the notes or the report say
    "missing": (Own("from .norms import twice", files=()), ABSENT),
    "a_package": (Own("from .norms import twice", files=(("norms/__init__.py", TWICE),)), ABSENT),
    "elsewhere": (Own("from .norms import twice", files=(("../norms.py", TWICE),)), ABSENT),
    "of_the_package": (Own("from . import twice", files=(("__init__.py", TWICE),)),
                       ABSENT.replace("norms", "twice")),
    "the_package": (Own("from .__init__ import twice", files=(("__init__.py", TWICE),)),
                    "No module named 'labs.__init__'"),
    "another_lab": (Own("from .sampling import twice", files=(("sampling.py", TWICE),)),
                    "No module named 'labs.sampling'"),
    "not_of_labs": (Own("from norms import twice"), "No module named 'norms'"),
    "of_the_course": (Own("from course.given.norms import twice"),
                      "No module named 'course.given.norms'"),
    "huge": (Own("from .norms import twice", files=(("norms.py", TWICE + "#" * (1 << 15)),)),
             "labs/norms.py has more than 32 kB"),
    "not_utf8": (Own("from .norms import twice", files=(("norms.py", TWICE.encode() + b"#\xe9"),)),
                 "labs/norms.py is not UTF-8 text (line 3): save it as UTF-8"),
    "a_zero_byte": (Own("from .norms import twice", files=(("norms.py", f"{TWICE}\0"),)),
                    "source code string cannot contain null bytes"),
    "a_mistake": (Own("from .norms import twice", files=(("norms.py", f"{TWICE}\ndef (:\n"),)),
                  "labs/norms.py:4 in"),
    "many": (Own("\n".join(f"from .n{k:02} import twice" for k in range(17)),
                 files=tuple((f"n{k:02}.py", TWICE) for k in range(17))),
             "No module named 'labs.n16'"),
    "leaves": (Own("from .norms import twice", files=(("norms.py", "exit()\n"),)), "SystemExit"),
    "exits": (Own("from .norms import twice", files=(("norms.py", "import os\nos._exit(0)"),)),
              "the process ended with exit status 0")}
KEEPS = """\
seen = []


def twice(x):
    return seen.append(x) or 2 * x


def half(x):
    return None if seen else (x / 2, x > 0)
"""
GRADED = {  # labs, what norms.py is, and their points
    "a_process_for_each_exercise": (Own("from . import norms", "norms.twice(x)").lab.replace(
        "x / 2, x > 0", "norms.half(x)"), KEEPS, 7),
    "an_earlier_one_is_wrong": (Own("from . import norms", "3 * x").lab.replace(
        "double(double(x))", "norms.four(x)"),
        "from . import transforms\n\n\ndef four(x):\n"
        "    from .transforms import double\n    return transforms.double(double(x))\n", 6),
    "not_imported": (Own("", "2 * x").lab, "1 / 0", 7)}


@pytest.fixture(scope="module")
def classroom(house, run_here, run_module, tmp_path_factory):
    """(the folder with results, {student: what pack printed}): zips, some made by pack, graded."""
    folder, said = tmp_path_factory.mktemp("class"), {}
    zips = {student: zipped([("a/labs/transforms.py", own.lab), *(
        (f"a/labs/{name}", text) for name, text in own.files)])
        for student, (own, _) in REFUSED.items()}
    zips |= {student: zipped([("transforms.py", lab), ("norms.py", text)])
             for student, (lab, text, _) in GRADED.items()}
    put(folder, {f"in/{student}.zip": content for student, content in zips.items()})
    for student, own in TAKEN.items():
        root = house(first_lab() | {f"labs/{name}": text for name, text in own.files}
                     | {"labs/__init__.py": "", "labs/transforms.py": own.lab})
        run = run_module if "labs" in own.line else run_here  # which does not import from root
        done = run(root, "course", "pack", folder / "in" / f"{student}.zip")
        assert done.returncode == 0 and not done.stderr, done.stdout + done.stderr
        said[student] = done.stdout
    done = run_module(root, *grade_command(folder, "--seconds", 2,
                                           isolation=sandbox.available()[0]))
    assert done.returncode == 0, done.stdout + done.stderr
    return folder / "out", said


@pytest.mark.parametrize("student", TAKEN)
def test_what_a_lab_imports_from_beside_it_is_packed_and_graded(classroom, student):
    """All is done at home, and the mark is 0."""
    out, said = classroom
    row = grades(out)[student]
    assert (row["total"], row["notes"]) == ("7", "")
    assert "7 of 7 points" in said[student] and row["hash"] in said[student]
    kept = {path.name: path.read_text() for path in (out / "code" / student).iterdir()}
    taken = {name: text for name, text in TAKEN[student].files
             if name not in UNTAKEN.get(student, ())}
    assert kept == {"transforms.py": TAKEN[student].lab, **taken}


def test_what_cannot_be_taken_costs_its_own_points_and_is_told(classroom):
    """A student's file takes the place of the course's, or the report does not say why it does not.
    One exercise sees what another one left in a module; or a mistake costs the next one's points.
    """
    out, _ = classroom
    rows = grades(out)
    assert {student: int(rows[student]["total"]) for student in (*REFUSED, *GRADED)} == {
        student: 0 for student in REFUSED} | {
        student: points for student, (*_, points) in GRADED.items()}
    for student, (_, said) in REFUSED.items():
        page = (out / "students" / student / "report.html").read_text("utf-8")
        assert said in html.unescape(page) and "cannot be imported" in page, student


READS = 'from pathlib import Path\nTABLE = Path(__file__).with_name("table.txt").read_text()\n'
LOST = "is not there when your labs are graded, so transforms.py would lose all its 7 points; numpy"


@pytest.mark.parametrize(("own", "said"), [
    (Own("from .norms import twice", files=(("norms/__init__.py", TWICE),)),
     f"labs/transforms.py, line 2: labs.norms {LOST}"),
    (Own("from .norms.of import twice", files=(("norms/__init__.py", ""), ("norms/of.py", TWICE))),
     f"labs/transforms.py, line 2: labs.norms.of {LOST}"),
    (Own("from .norms import twice", files=(("norms.py", f"import pandas\n{TWICE}"),
                                            ("../pandas.py", ""))),
     f"labs/norms.py, line 1: pandas {LOST}"),
    (Own("from .sampling import twice", files=(("sampling.py", TWICE),)),
     f"labs/transforms.py, line 2: labs.sampling {LOST}"),
    (Own('TABLE = open("labs/table.txt").read()', "2 * x", (("table.txt", "x"),)),
     "labs/transforms.py, line 2: labs/table.txt is not there when your labs are graded; numpy"),
    (Own("from .norms import twice", files=(("norms.py", READS + TWICE), ("table.txt", "x"))),
     "labs/norms.py, line 2: table.txt is not there when your labs are graded; numpy"),
    *((REFUSED[name][0], said) for name, said in (
        ("huge", f"labs/transforms.py, line 2: labs.norms {LOST}"),
        ("many", f"labs/transforms.py, line 18: labs.n16 {LOST}")))],
    ids=["a package", "in a package", "in turn", "another lab's", "a file", "a file in turn",
         "long", "too many"])
def test_what_works_at_home_alone_is_told_there(own, said, house, run_here, monkeypatch):
    """On the board all is done, and the mark is 0."""
    root = house(first_lab() | {f"labs/{name}": text for name, text in own.files}
                 | {"labs/transforms.py": own.lab})
    monkeypatch.syspath_prepend(root)
    for command in ("check", "1"), ("pack", root / "labs.zip"):
        done = run_here(root, "course", *command)
        printed = " ".join(done.stdout.split())
        assert done.returncode == 1 and said in printed and printed.count("graded") == 1
        assert "is done, 7 of 7 points" in printed or command[0] == "pack", done.stdout


def test_a_module_that_is_not_there_is_called_as_it_was_written(house, run_here):
    """"No module named 'implementation.norms'", and nobody wrote that."""
    own = Own("from .norms import twice")
    done = run_here(house(first_lab() | {"labs/transforms.py": own.lab}), "course", "check", "1")
    assert done.returncode == 1 and "No module named 'labs.norms'" in " ".join(done.stdout.split())
    assert "implementation" not in done.stdout


def test_an_edited_module_is_read_anew(house, run_here, monkeypatch):
    """In a notebook, what was mended stays wrong."""
    own = Own("from labs.norms import twice")
    root = house(first_lab() | {"labs/__init__.py": "", "labs/transforms.py": own.lab})
    monkeypatch.syspath_prepend(root)
    for text, status in (TWICE.replace("2", "3"), 1), (TWICE, 0):
        (root / "labs" / "norms.py").write_text(text)
        assert run_here(root, "course", "check", "1").returncode == status


def test_a_module_beside_the_labs_does_not_change_who_draws(house, monkeypatch):
    """demo draws by labs, which are empty, because reference/ has no norms.py."""
    root = house({"reference/transforms.py": LAB, "labs/transforms.py": LAB,
                  "labs/norms.py": TWICE})
    monkeypatch.setattr(places, "ROOT", root)
    assert whose.preferred() == "reference"


def test_the_course_itself_needs_nothing_that_is_not_there():
    """Every student is told of a loss by what was handed out. Or a topic imports one that comes
    after it: the grader loads modules in their order, no exercise ends, and nothing says why.
    """
    for topic in exercises.topics():
        for folder in places.ROOT / "labs", exercises.reference(topic).parent:
            assert imports.not_there(topic, folder) == []


# --- from several things that were handed in --------------------------------------------------


def test_the_newest_module_counts_and_only_what_is_used(tmp_path):
    """An old module meets a new lab; or lab 2, which is late and not graded, makes lab 1 late."""
    lab = Own("from .norms import twice").lab
    put(tmp_path, {
        "a_1_1_labs.zip": {"labs/transforms.py": lab, "labs/norms.py": "old"},
        "a_1_2_labs.zip": {"labs/transforms.py": lab, "labs/norms.py": "new"},
        "a_LATE_1_3_labs.zip": {"labs/rasterization.py": "from . import more",
                                "labs/more.py": "x"}})
    (one,), _ = submissions.read(tmp_path, ("transforms",))
    assert one.texts == {"transforms": lab, "norms": "new"} and not one.late
    assert one.digest == contents.digest({
        **one.texts, "rasterization": "from . import more", "more": "x"})
