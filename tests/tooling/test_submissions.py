"""What was handed in: platforms' names, the latest of several, the files that are taken."""
import os
import zipfile

import pytest

from course import exercises
from course.grading import submissions

TOPICS = ("transforms", "rasterization")


@pytest.fixture
def handed_in(tmp_path):
    """handed_in({path: text, or {path in the zip: text}}) -> {student: Submission}."""
    def put(files):
        for time, (name, content) in enumerate(files.items()):
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            if isinstance(content, dict):
                with zipfile.ZipFile(path, "w") as archive:
                    for entry, text in content.items():
                        archive.writestr(entry, text)
            else:
                path.write_text(content, encoding="utf-8", newline="")
            os.utime(path, (1e9 + time, 1e9 + time))
        return {one.student: one for one in submissions.read(tmp_path, TOPICS)}
    return put


@pytest.mark.parametrize(("name", "student"), [
    ("ada/labs/transforms.py", "ada"),
    ("ada/transforms.py", "ada"),
    ("ada/homework/ada s work/labs/transforms.py", "ada"),
    ("ada_transforms.py", "ada"),
    ("lovelaceada_1234_56789_transforms.py", "lovelaceada"),
    ("lovelaceada_LATE_1234_56789_transforms-1.py", "lovelaceada"),
    ("Ada Lovelace_1234_assignsubmission_file_/transforms.py", "Ada_Lovelace_1234"),
    ("Ada Lovelace_1234_assignsubmission_file/labs/transforms.py", "Ada_Lovelace_1234"),
    ("=cmd()/transforms.py", "cmd"),
    ("Zoë/transforms.py", "Zoë"),
])
def test_the_student_is_found_in_the_name(handed_in, name, student):
    """A platform's numbers become part of the student, or a name is a formula in a table."""
    found = handed_in({name: "x = 1\n"})
    assert list(found) == [student]
    assert found[student].texts == {"transforms": "x = 1\n"}
    assert found[student].missing == {
        "rasterization": "there is no labs/rasterization.py in what was handed in"}


@pytest.mark.parametrize("name", ["ada.zip", "lovelaceada_1234_56789_labs.zip",
                                  "Ada Lovelace_1234_assignsubmission_file_/labs.zip"])
def test_archives_are_read(handed_in, name):
    """A zip in Moodle's folder is overlooked."""
    one, = handed_in({name: {"labs/transforms.py": "x = 1\n", "labs/notes.txt": ""}}).values()
    assert one.texts == {"transforms": "x = 1\n"}


def test_gradescope_s_export_names_its_submitters(handed_in):
    """Everybody is called submission_1234."""
    found = handed_in({
        "submission_metadata.yml": "---\nsubmission_11:\n  :submitters:\n  - :name: Ada L\n"
        "    :sid: 's77'\n    :email: ada@x.edu\n  :created_at: 2026-01-02 10:00:00 Z\n"
        "submission_12:\n  :submitters:\n  - :name: Bob\n    :email: bob@x.edu\n"
        "submission_13:\n  :submitters:\n  - :name: Ada L\n    :sid: 's77'\n"
        "  :created_at: 2026-01-01 10:00:00 Z\n",
        "submission_11/transforms.py": "later", "submission_12/transforms.py": "b",
        "submission_13/transforms.py": "earlier"})
    assert {name: one.texts["transforms"] for name, one in found.items()} == {
        "s77": "later", "bob_x.edu": "b"}


@pytest.mark.parametrize("files", [
    {"ada_12_500_labs.zip": {"transforms.py": "old"},
     "ada_12_700_labs.zip": {"transforms.py": "new"}},
    {"ada_12_700_labs-1.zip": {"transforms.py": "old"},
     "ada_12_600_labs-2.zip": {"transforms.py": "new"}},
    {"ada_12_700_transforms-2.py": "new", "ada_12_701_transforms-1.py": "old"},
    {"ada_12_5_transforms.py": "old", "ada_12_6_labs.zip": {"transforms.py": "older"},
     "ada_12_7_transforms.py": "new"},
])
def test_a_student_s_latest_wins(handed_in, files):
    """The first one is graded, or the one whose name sorts last."""
    assert handed_in(files)["ada"].texts == {"transforms": "new"}


def test_single_files_of_a_student_come_together(handed_in):
    """Of two labs handed in as two files, one is lost."""
    one = handed_in({"ada_12_5_transforms.py": "t", "ada_12_6_rasterization.py": "r"})["ada"]
    assert one.texts == {"transforms": "t", "rasterization": "r"}


def test_the_labs_folder_is_taken_and_nothing_of_ours(handed_in):
    """The reference that was released is graded, or a copy in a folder with old work."""
    one = handed_in({"ada/reference/transforms.py": "ours", "ada/old/transforms.py": "old",
                     "ada/course/labs/transforms.py": "no", "ada/my/labs/transforms.py": "mine",
                     "ada/__MACOSX/labs/transforms.py": "no"})["ada"]
    assert one.texts == {"transforms": "mine"}


def test_names_that_become_the_same_stay_two_students(handed_in):
    """One of two students gets the other's marks."""
    found = handed_in({"ada x/transforms.py": "1", "ada_x/transforms.py": "2"})
    assert sorted(one.texts["transforms"] for one in found.values()) == ["1", "2"]


def test_line_ends_and_a_mark_for_utf_8_do_not_matter(handed_in):
    """A file from Windows cannot be read, or has another hash."""
    found = handed_in({"ada/transforms.py": "\ufeffx = 1\r\n", "bob/transforms.py": "x = 1\n"})
    assert submissions.digest(found["ada"].texts) == submissions.digest(found["bob"].texts)


@pytest.mark.parametrize("name", ["nothing", "empty"])
def test_a_folder_without_submissions_is_a_sentence(tmp_path, name):
    """A table without rows."""
    (tmp_path / "empty").mkdir()
    with pytest.raises(ValueError, match=r"nothing was handed in|there is no folder"):
        submissions.read(tmp_path / name, TOPICS)


@pytest.mark.parametrize(("line", "found"), [
    ("import numpy as np, os", []), ("from . import transforms", []), ("x = (", []),
    ("from scipy.sparse import csr_array", []),
    ("import matplotlib.pyplot as plt", [(1, "matplotlib.pyplot")]),
    ("from course.given import mesh", []),
    ("from course.given.distances import closest_points", []),
    ("def f():\n    from course.given import gradcheck, mesh", [(2, "course.given.gradcheck")]),
    ("from course import checks", [(1, "course.checks")]),
])
def test_imports_that_a_worker_does_not_have(line, found):
    """A student learns only from the mark that matplotlib is not there."""
    assert exercises.foreign_imports(line) == found
