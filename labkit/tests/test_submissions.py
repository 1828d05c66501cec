"""What was handed in: platforms' names, the newest of several, the files that are taken."""
import datetime
import os
import sys
import time
from pathlib import Path

import pytest
from submitted import put, zipped

from labkit import imports
from labkit.grading.handing import archives, contents, submissions

TOPICS = ("transforms", "rasterization")
MOODLE = "Ada Lovelace_1234_assignsubmission_file"
METADATA = Path(__file__).with_name("rosters") / "submission_metadata.yml"


@pytest.fixture
def read(tmp_path):
    """read({path: text, bytes, or {path in the zip: text}}) -> what submissions.read returns."""
    def put_and_read(files):
        for number, path in enumerate(put(tmp_path, files)):
            os.utime(path, (1e9 + number, 1e9 + number))
        return submissions.read(tmp_path, TOPICS)
    return put_and_read


@pytest.fixture
def handed_in(read):
    """handed_in(files) -> {student: Submission}, where everything is understood."""
    def understood(files):
        found, not_understood = read(files)
        assert not_understood == []
        return {one.student: one for one in found}
    return understood


# --- whose it is ------------------------------------------------------------------------------


NAMES = {
    "ada": ["ada/labs/transforms.py", "ada/transforms.py", "ada_transforms.py",
            "ada - Transforms (1).py", "ada/homework/ada s work/labs/transforms.py"],
    "lovelaceada_1234": [f"lovelaceada_{rest}" for rest in (
        "1234_56789_transforms.py", "LATE_1234_56789_transforms-1.py",
        "1234_56789_transforms (1).py", "1234_56789_Transforms.py")],
    "de_la_cruz_1234": ["de_la_cruz_1234_56789_12_34_transforms.py"],
    "anon_Ab3dE": ["anon_Ab3dE_56789_transforms.py", "LATE_anon_Ab3dE_56789_transforms.py"],
    "Ada_Lovelace_1234": [
        f"{MOODLE}_/transforms.py", f"{MOODLE}/labs/transforms.py", f"{MOODLE}_transforms.py"],
    "Grace_99_assignsubmission_file_Eve_105": [  # so she calls herself, to be in Grace's row
        "Grace_99_assignsubmission_file Eve_105_assignsubmission_file/transforms.py"],
    "ada_l_x.edu": ["ada_l@x.edu_1_handin.zip", "ada_l@x.edu_12_transforms.py"],
    "Group_7": ["Group 7_assignsubmission_file/ada_transforms.py"],
    "cmd": ["=cmd()/transforms.py"],
    "Zoë": ["Zoë/transforms.py", "Zoe\u0308/transforms.py"],
    "हिन्दी": ["हिन्दी/transforms.py"]}


@pytest.mark.parametrize(("name", "student"), [
    (name, student) for student, names in NAMES.items() for name in names])
def test_the_student_is_found_in_the_name(handed_in, name, student):
    """Half of a platform's name becomes the student, or a name is a formula in a table."""
    lab = "x = 1\n"
    found = handed_in({name: {"transforms.py": lab} if name.endswith("zip") else lab})
    assert list(found) == [student]
    assert found[student].texts == {"transforms": "x = 1\n"}
    assert found[student].missing == {
        "rasterization": "there is no labs/rasterization.py in what was handed in"}


@pytest.mark.parametrize(("name", "told"), [
    ("lovelaceada_LATE_1234_5_transforms.py", ("canvas", "1234", "lovelaceada", True)),
    ("anon_Ab3dE_5_transforms.py", ("canvas", "", "anon_Ab3dE", False)),
    (f"{MOODLE}/transforms.py", ("moodle", "1234", "Ada Lovelace", None)),
    (f"{MOODLE}_Eve_105_assignsubmission_file", ("moodle", "1234", "Ada Lovelace", None)),
    ("Ada L/transforms.py", ("", "", "Ada L", None))])
def test_what_the_platform_tells_of_a_student_is_kept(handed_in, name, told):
    """Points that cannot be brought back to the platform, late work that counts as in time."""
    one, = handed_in({name: "x"}).values()
    who = one.identity
    assert (who.platform, who.id, who.name, one.late) == told


def test_gradescope_s_export_names_all_submitters(read):
    """Everybody is called submission_11; of a group, one member gets points; 10:30 is later than
    10:00 in another zone; numbers lose their zeros; what a program printed is taken as a name."""
    found, not_understood = read({
        METADATA.name: METADATA.read_text(), "submission_11/transforms.py": "later",
        "submission_12/transforms.py": "b", "submission_13/transforms.py": "earlier"})
    assert {one.student: one.texts["transforms"] for one in found} == {
        "0077": "later", "78": "later", "bob_x.edu": "b"}
    assert found[0].handed_in == datetime.datetime(
        2026, 1, 2, 10, 0, 0, 418372, datetime.UTC).timestamp()
    assert found[0].identity == ("gradescope", "0077", "Ada L", "ada@x.edu", "")
    assert found[2].handed_in is None
    (name, sentence), = not_understood
    assert name == "submission_14" and "80's, and it is not there" in sentence


def test_metadata_that_cannot_be_read_is_a_sentence(read):
    """Everybody is called submission_11, and nobody says why."""
    with pytest.raises(ValueError, match=r"is not as Gradescope exports it \(.*download it again"):
        read({METADATA.name: "a: [", "submission_11/transforms.py": "x"})


def test_namesakes_are_two_people(handed_in):
    """One of two students gets the other's marks."""
    names = ["lovelaceada_1234_5_transforms.py", "lovelaceada_99_6_transforms.py",
             f"{MOODLE}/transforms.py", f"{MOODLE.replace('1', '9')}/transforms.py",
             "ada x/transforms.py", "ada_x/transforms.py", "ADA_X/transforms.py"]
    found = handed_in({name: name for name in names})
    assert sorted(one.texts["transforms"] for one in found.values()) == sorted(names)
    assert len({name.casefold() for name in found}) == 7


def test_names_are_safe_wherever_they_are_written(read, tmp_path):
    """A folder that cannot be made, a table that cannot be encoded, a cursor that moves."""
    long = "\N{LINEAR B SYLLABLE B008 A}" * 60  # 240 bytes
    names = [f"{long}/transforms.py", f"{long}B/transforms.py"]
    if sys.platform == "linux":
        names += ["a\x1b[2J\nb/transforms.py", b"ad\xe9/transforms.py", b"ad\xe8/transforms.py",
                  b"eve/ad\xe9.rar", b"eve/ad\xe9/transforms.py", b"fay\xe9_12_34_my\xe9.rar"]
    found, not_understood = read(dict.fromkeys(names, "x"))
    assert len(found) == (7 if sys.platform == "linux" else 2) and not_understood == []
    for one in found:
        (tmp_path / "out" / one.student).mkdir(parents=True)
        assert len(one.student.encode()) <= 100
        for text in (one.student, *one.notes, *one.missing.values(), *one.identity):
            assert text.isprintable(), text


# --- which files are taken --------------------------------------------------------------------


LAB = {"labs/transforms.py": "x = 1\n"}


@pytest.mark.parametrize(("name", "content"), [
    ("lovelaceada_1234_56789_labs.zip", LAB), (f"{MOODLE}_/labs.zip", LAB),
    ("ada.zip", {**LAB, "labs/notes.txt": ""}),
    ("ada.zip", {"course/labs/transforms.py": "x = 1\n", "course/reference/transforms.py": "no",
                 "course/tests/mistakes/transforms.py": "no", "course/labkit/cli.py": "no",
                 "course/labkit/handed_out/transforms.py": "no"}),
    *(("ada.zip", {name: "x = 1\n"}) for name in (
        "labs\\transforms.py", "labs/transforms (1).py", "labs/Transforms.py")),
    ("ada.rar", zipped(LAB.items())), ("ada/homework/labs.zip", LAB)])
def test_archives_are_read(handed_in, name, content):
    """A zip in Moodle's folder is overlooked, a whole course is refused."""
    one, = handed_in({name: content}).values()
    assert one.texts == {"transforms": "x = 1\n"}


@pytest.mark.parametrize(("names", "newest"), [  # in the order of their files' times
    (["ada_12_500_labs.zip", "ada_12_700_labs.zip"], 1),
    (["ada_12_700_labs.zip", "ada_12_600_labs-2.zip"], 0),
    (["ada@x_2_handin.zip", "ada@x_10_handin.zip"], 1),
    (["ada_12_700_transforms-2.py", "ada_12_701_transforms-1.py"], 1),
    (["ada_12_5_transforms.py", "ada_12_6_labs.zip", "ada_12_7_transforms.py"], 2),
    (["ada_12_5_transforms.py", "ada_12_6_labs.zip"], 1),
    (["ada_transforms.py", "ada.zip"], 1), (["ada/transforms.py", "ada/transforms (1).py"], 1),
    (["ada/transforms.py", "ada/labs.zip"], 1), (["ada/labs (1).zip", "ada/labs.zip"], 1),
    ([f"{MOODLE}/2.zip", f"{MOODLE}/1.zip"], 1)])
def test_a_student_s_newest_wins(handed_in, names, newest):
    """The first one is graded, or the one whose name sorts last, or a file before any zip."""
    texts = {name: "new" if name == names[newest] else "old" for name in names}
    one, = handed_in({name: {"transforms.py": text} if name.endswith(".zip") else text
                      for name, text in texts.items()}).values()
    assert one.texts == {"transforms": "new"} and one.notes


def test_a_note_names_the_folders(handed_in):
    """"transforms.py is the newest; not looked at: transforms.py", and nobody knows which."""
    names = MOODLE, MOODLE.replace("file", "onlinetext")
    one, = handed_in({f"{name}/transforms.py": name for name in names}).values()
    assert one.notes == (f"transforms: {names[1]}/transforms.py is the newest; not looked at: "
                         f"{names[0]}/transforms.py",)


def test_what_is_broken_and_newer_counts_for_nothing(handed_in):
    """The labs of an hour ago are lost with the last upload, or nobody is told of it."""
    one, = handed_in({"ada_12_6_labs.zip": b"PK broken", "ada_12_5_labs.zip": LAB}).values()
    assert one.texts == {"transforms": "x = 1\n"} and one.notes


def test_the_newest_counts_for_each_lab(handed_in):
    """Of two labs handed in one after the other, one is lost."""
    for files in ({"ada_12_5_transforms.py": "t", "ada_12_6_rasterization.py": "r"},
                  {"bob_12_5_a.zip": {"labs/transforms.py": "t", "labs/rasterization.py": "old"},
                   "bob_12_6_b.zip": {"rasterization.py": "r"}},
                  {f"{MOODLE}/a.zip": {"transforms.py": "t"},
                   f"{MOODLE}/b.zip": {"rasterization.py": "r"}}):
        one = list(handed_in(files).values())[-1]
        assert one.texts == {"transforms": "t", "rasterization": "r"}


def test_late_is_what_is_graded(handed_in):
    """A report that is handed in after the end makes the labs late."""
    one, = handed_in({"ada_12_3_transforms.py": "x", "ada_LATE_12_5_report.pdf": "y"}).values()
    assert one.late is False


def test_the_labs_folder_is_taken_and_nothing_of_ours(handed_in):
    """The reference that was released is graded, or a copy in a folder with old work."""
    one = handed_in({"ada/my/labs/transforms.py": "mine", "ada/my/labs/transforms (1).py": "copy",
                     "ada/reference/transforms.py": "ours", "ada/old/transforms.py": "old",
                     "ada/labkit/handed_out/transforms.py": "no", "ada/.git/transforms.py": "no",
                     "ada/tests/labs/test_transforms.py": "no",
                     "ada/__MACOSX/labs/transforms.py": "no"})["ada"]
    assert one.texts == {"transforms": "mine"}
    assert one.notes == ("my/labs/transforms.py was taken, not my/labs/transforms (1).py, "
                         "old/transforms.py",)


@pytest.mark.parametrize("written", ["x = 1\r\ny = 2\r\n", "x = 1\ry = 2\r", "x = 1\ny = 2\r\n",
                                     "\ufeffx = 1\ny = 2\n"], ids=ascii)
def test_line_ends_and_a_mark_for_utf_8_do_not_matter(handed_in, written):
    """A file from Windows has another hash; or one hash, and so one seed, has many texts, whose
    line ends tell the code that reads them the answers of an earlier report.
    """
    found = handed_in({"ada/transforms.py": written, "bob/transforms.py": "x = 1\ny = 2\n"})
    assert found["ada"].texts == found["bob"].texts == {"transforms": "x = 1\ny = 2\n"}
    assert found["ada"].digest == found["bob"].digest


def test_of_two_entries_with_one_name_the_last_counts(handed_in):
    """The grader takes one, and whoever unpacks the zip sees the other."""
    with pytest.warns(UserWarning, match="Duplicate name"):
        content = zipped([*LAB.items(), ("labs/transforms.py", "x = 2\n")])
    one, = handed_in({"ada.zip": content}).values()
    assert one.texts == {"transforms": "x = 2\n"}


def test_the_hash_is_of_all_labs_that_were_handed_in(handed_in):
    """`pack` prints the hash of labs 1-4. Lab 2 is graded, and the table has another hash."""
    every = {"transforms": "x = 1\n", "reconstruction": "y = 2\n"}
    assert "reconstruction" not in TOPICS
    one = handed_in({f"ada/{topic}.py": text for topic, text in every.items()})["ada"]
    assert one.texts.keys() == {"transforms"} and one.digest == contents.digest(every)


# --- what cannot be taken ---------------------------------------------------------------------


@pytest.mark.parametrize(("name", "content", "sentence"), [
    *((name, content, "cannot be read (File is not a zip file): pack it again as a zip")
      for name, content in (("ada.rar", b"Rar!\x1a\x07"), ("ada.zip", b"PK broken"),
                            ("ada_12_34_my.tar.gz", b"\x1f\x8b"), ("ada.tar", bytes(10240)))),
    ("ada.zip", {"all.zip": "", "report.pdf": ""}, "holds no lab, only all.zip, report.pdf"),
    ("ada_12_34_work.ipynb", "{}", "is neither a lab nor an archive"),
    ("ada_12_text.html", "I did it", "is neither a lab nor an archive"),
    (f"{MOODLE.replace('file', 'onlinetext')}/onlinetext.html", "x", "only onlinetext.html"),
    (f"{MOODLE.replace('submission_', 'feedback_')}/report.html", "x", "only report.html"),
    ("ada/readme.txt", "x", "ada holds no lab, only readme.txt"),
    ("ada.zip", {"labs/transforms.py": b"#\n#\n\xe9"}, "is not UTF-8 text (line 3): save"),
    ("ada.zip", {"labs/transforms.py": "#" * (1 << 19)}, "has more than 256 kB"),
])
def test_who_handed_in_what_cannot_be_read_has_a_row(handed_in, name, content, sentence):
    """A student without a row, and without a word on what to do."""
    one, = handed_in({name: content}).values()
    assert one.texts == {} and sentence in one.missing["transforms"]


def test_a_lab_below_itself_is_told(handed_in):
    """"not started", seven times, to who has written all of it."""
    lab = "def f():\n    return 1\n\ndef g():\n    return 1\n"
    empty = lab.replace("return 1", '"""?"""\n    raise NotImplementedError("exercise 1.1: f")')
    found = handed_in({"ada/transforms.py": lab + empty, "bob/transforms.py": empty + lab,
                       "eve/transforms.py": lab + lab})
    assert {name: one.notes for name, one in found.items() if one.notes} == {
        "ada": ("labs/transforms.py has f and 1 more twice, and the last one counts, which is not "
                "written: take out what was pasted below",)}


def test_a_file_that_becomes_a_link_is_not_followed(tmp_path, monkeypatch):
    """Somebody exchanges it after it was looked at, and before it is opened."""
    (path,) = put(tmp_path, {"secret.py": "secret"})
    link, regular = tmp_path / "transforms.py", os.lstat(path)
    link.symlink_to(path)
    with monkeypatch.context() as patch, pytest.raises(OSError, match="symbolic link"):
        patch.setattr(archives.os, "lstat", lambda path: regular)
        archives.opened(link, archives.Budget())


def test_an_empty_folder_and_a_link_have_a_row(tmp_path):
    """A student without a row; a link that leads to other work."""
    (tmp_path / "in" / "ada").mkdir(parents=True)
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "transforms.py").write_text("x")
    if os.name != "nt":
        (tmp_path / "in" / "bob").symlink_to(tmp_path / "other")
        (tmp_path / "in" / "eve.zip").symlink_to(tmp_path / "other" / "transforms.py")
        (tmp_path / "in" / "ada" / "labs").symlink_to(tmp_path / "other")
        (tmp_path / "in" / "ada" / "transforms.py").symlink_to(tmp_path / "other/transforms.py")
    found, _ = submissions.read(tmp_path / "in", TOPICS)
    assert len(found) == (1 if os.name == "nt" else 3)
    assert not any(one.texts for one in found) and all(one.missing for one in found)


@pytest.mark.parametrize("name", ["transforms.py", "transforms (1).py", "labs.zip", "labs (1).zip",
                                  "notes.txt", "ada_homework.py", ".hidden", "report.pdf"])
def test_what_is_nobody_s_is_told(read, name):
    """A file without a word, or a student called transforms."""
    found, not_understood = read({name: "x", "ada/transforms.py": "x", ".DS_Store": "",
                                  "__MACOSX/._ada": "", "._ada.zip": ""})
    assert [one.student for one in found] == ["ada"]
    (told, sentence), = not_understood
    assert told == name and "call it ada.zip or ada_transforms.py, and grade again" in sentence


@pytest.mark.parametrize("files", [{"ada.zip": {"a" * 5000: "", **LAB}},
                                   {f"ada/{number}.py": "" for number in range(30)}],
                         ids=["a long list of files", "many files"])
def test_what_never_ends_is_refused(handed_in, monkeypatch, files):
    """Minutes, or all of the memory, for a few bytes that one student has sent."""
    monkeypatch.setattr(archives, "BUDGET", archives.EACH_FILE * 25)
    monkeypatch.setattr(archives, "EACH_ARCHIVE", 0)
    one, = handed_in(files).values()
    assert "holds too many files, or comes after too many" in one.missing["transforms"]


@pytest.mark.parametrize("form", ["ada/{}.zip", "ada_12_{}_labs.zip"])
def test_of_many_archives_the_newest_are_read(handed_in, form):
    """Minutes for each student who hands in a hundred of them; or only the oldest are read."""
    one, = handed_in({form.format(number): {"transforms.py": f"x = {number}"}
                      for number in range(100)}).values()
    assert one.texts == {"transforms": "x = 99"}
    assert ["what is older was read" in note for note in one.notes] == [True, False]


def test_no_name_takes_long():
    """A zip of 20,000 such names takes a quarter of an hour."""
    began = time.process_time()
    assert not any(archives.named_lab("_" * 250)[1] for _ in range(100))
    assert time.process_time() - began < 1


@pytest.mark.parametrize("name", ["nothing", "empty"])
def test_a_folder_without_submissions_is_a_sentence(tmp_path, name):
    """A table without rows."""
    (tmp_path / "empty").mkdir()
    (tmp_path / "empty" / "labs.zip").write_bytes(b"")
    with pytest.raises(ValueError, match=r"nothing was handed in.*\nlabs.zip: no|there is no fold"):
        submissions.read(tmp_path / name, TOPICS)


@pytest.mark.parametrize(("line", "found"), [
    *((line, []) for line in (
        "import numpy as np, os", "from . import transforms", "x = (",
        "import matplotlib.pyplot as plt", "from mpl_toolkits.mplot3d import Axes3D",
        "from scipy.sparse import csr_array", "from course.given import mesh",
        "from course.given.distances import closest_points")),
    ("import torch.nn as nn", [(1, "torch.nn", True)]),
    ("from cv2 import imread", [(1, "cv2", True)]),
    ("try:\n    import tqdm\nexcept ImportError:\n    pass", [(2, "tqdm", False)]),
    ("def f():\n    from course.given import gradcheck, mesh",
     [(2, "course.given.gradcheck", False)]),
    ("from labkit import checks", [(1, "labkit", True)]),
    ("from . import sampling, transforms", [(1, "labs.sampling", True)])])
def test_imports_that_a_worker_does_not_have(line, found, tmp_path):
    """A student learns only from the mark that torch is not there."""
    put(tmp_path, {"rasterization.py": line})
    assert [(need.line, need.shown, need.at_the_top)
            for _, need in imports.not_there("rasterization", tmp_path)] == found
